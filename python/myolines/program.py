# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program `myolines`, for what starts processes of its own: studies and plots."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from typing import Dict, List

from . import _core
from .errors import InputError, Interrupted, SolveError, SystemRefused

# As in source/study/processes.cc: with these a process would take itself for a rank of the job that started this one.
_OF_MPI = ("OMPI_COMM_", "OMPI_UNIVERSE", "OMPI_MCA_ess", "OMPI_MCA_orte", "OMPI_MCA_pmix", "PMIX_", "PMI_", "ORTE_", "PRTE_LAUNCHED")


def find() -> str:
    """The program: that of MYOLINES_PROGRAM, else that of the same build or installation, else the one in PATH."""
    here = os.path.dirname(os.path.abspath(__file__))
    links = os.path.dirname(os.path.abspath(_core.__file__))
    for place in (os.environ.get("MYOLINES_PROGRAM", ""), os.path.join(links, "..", "..", "myolines"),
                  os.path.join(here, _core.folder_of_program, "myolines"), shutil.which("myolines") or ""):
        if place and os.path.isfile(place) and os.access(place, os.X_OK):
            return os.path.normpath(place)
    _core.refuse("MYOLINES_PROGRAM", "there is no program \"myolines\"", "the program beside the package, in PATH, or named by this variable")


def environment() -> Dict[str, str]:
    """That of this process, less what makes a process a rank of a job."""
    return {name: value for name, value in os.environ.items() if not name.startswith(_OF_MPI)}


def call(words: List[str], quiet: bool = True) -> str:
    """Runs the program and returns what it prints; not quiet, it prints to the terminal. Its exit codes become the errors of this package.
    Ctrl-C lets it end in its own way, with what is done saved."""
    process = subprocess.Popen([find(), *words], env=environment(), stdout=subprocess.PIPE if quiet else None, stderr=subprocess.PIPE, text=True)
    interrupted = False
    while True:
        try:
            out, err = process.communicate()
            break
        except KeyboardInterrupt:
            if not interrupted and not (sys.stdin and sys.stdin.isatty()):
                process.send_signal(signal.SIGINT)  # a terminal has sent it already
            interrupted = True
    code, text = process.returncode, err.strip()
    if code == 0:
        return out or ""
    if interrupted or text.startswith("The run was ") or "was stopped" in text:
        raise Interrupted(text)
    if code == 2:
        raise InputError(text)
    if code == 3:
        raise SolveError(text)
    if code == 4:
        raise SystemRefused(text)
    raise RuntimeError(f"myolines {' '.join(words)}: exit code {code}\n{text}")
