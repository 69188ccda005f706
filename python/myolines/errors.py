# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can go wrong, with the words and the exit codes of the program.

InputError     something given is wrong: what, where, what was expected, how to mend it (2)
SolveError     a solve cannot go on (3)
Interrupted    a run was asked to stop, and its state is saved: a KeyboardInterrupt (3)
SystemRefused  the system refused what was needed: disk, memory, permission (4)
"""

from __future__ import annotations

import sys
import types
from typing import NamedTuple, Optional, Sequence, Type


class Problem(NamedTuple):
    """One thing that is wrong with what was given."""

    where: str
    """File, and path of the parameter in it: "scene.xml: time/step"."""
    what: str
    expected: str = ""
    hint: str = ""


class Error(Exception):
    """Of this package; `exit_code` is that of the program."""

    exit_code = 1


class InputError(Error, ValueError):
    """Something that was given is wrong; `problems` has all of it."""

    exit_code = 2

    def __init__(self, message: str, problems: Optional[Sequence[Problem]] = None):
        super().__init__(message)
        self.problems = list(problems) if problems is not None else [Problem("", message)]


class SolveError(Error, ArithmeticError):
    """A solve cannot go on. `on_one_rank`: others may not know of it and wait."""

    exit_code = 3

    def __init__(self, message: str, on_one_rank: bool = False):
        super().__init__(message)
        self.on_one_rank = on_one_rank


class Interrupted(KeyboardInterrupt):
    """A run was asked to stop before its end. Its state is saved: `resume=True` goes on."""

    exit_code = 3

    def __init__(self, message: str = "", on_one_rank: bool = False):
        super().__init__(message)
        self.on_one_rank = on_one_rank


class SystemRefused(Error, OSError):
    """The system refused what was needed; `errno` says why, 0 if it did not say."""

    exit_code = 4

    def __init__(self, message: str, error_number: int = 0):
        super().__init__(message)
        self.errno = error_number


_hook_before = sys.excepthook


def _end_all_ranks(kind: Type[BaseException], value: BaseException, trace: Optional[types.TracebackType]) -> None:
    """Where one of several ranks fails and others may wait for it, all of them end."""
    from . import _core

    _hook_before(kind, value, trace)
    known_to_all = isinstance(value, (InputError, SolveError, Interrupted)) and not getattr(value, "on_one_rank", False)
    if not known_to_all:
        sys.stderr.flush()
        _core.abort_all(getattr(value, "exit_code", 1))


def guard_ranks() -> None:
    """Lets an error that no one catches end all ranks."""
    sys.excepthook = _end_all_ranks
