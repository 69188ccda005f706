# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of results: columns with units."""

from __future__ import annotations

import csv
import html
import os
import re
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from .errors import InputError

_UNIT = re.compile(r"^(?P<quantity>.*?)\s*[\[(](?P<unit>[^\])]*)[\])]\s*$")


def split_column(name: str) -> "tuple[str, str]":
    """Quantity and unit of the name of a column: "Force [N]" is ("Force", "N")."""
    match = _UNIT.match(name)
    return (match["quantity"], match["unit"]) if match else (name, "")


class Table(Mapping[str, np.ndarray]):
    """Columns by name, with or without the unit in brackets: table["Force"] and table["Force [N]"] are the same array.

    `units` has the unit of every column. Numbers that are not defined are NaN; columns that hold words are arrays of objects.
    """

    def __init__(self, columns: Mapping[str, Union[Sequence[Any], np.ndarray]], name: str = ""):
        self.name = name
        self._columns: Dict[str, np.ndarray] = {key: np.asarray(values) for key, values in columns.items()}

    @classmethod
    def read(cls, file: Union[str, "os.PathLike[str]"]) -> "Table":
        """A table that the program wrote. A last line that was not finished is left out."""
        with open(file, newline="", encoding="utf-8") as stream:
            rows = [row for row in csv.reader(line for line in stream if line.endswith("\n"))]
        header, rows = (rows[0], rows[1:]) if rows else ([], [])
        rows = [row for row in rows if len(row) == len(header)]
        return cls({key: _numbers([row[i] for row in rows]) for i, key in enumerate(header)}, os.path.basename(file))

    @property
    def units(self) -> Dict[str, str]:
        """Column to unit, "" where there is none."""
        return {key: split_column(key)[1] for key in self._columns}

    def column(self, name: str) -> str:
        """The whole name of a column that is called by it or by its quantity alone. Raises InputError with the nearest one."""
        if name in self._columns:
            return name
        meant = [key for key in self._columns if split_column(key)[0] == name]
        meant = meant or [key for key in self._columns if split_column(key)[0].lower() == split_column(name)[0].lower()]
        if len(meant) == 1:
            return meant[0]
        known = [*self._columns, *(split_column(key)[0] for key in self._columns)]
        hint = f'it may be any of {", ".join(meant)}' if meant else _core.nearest_hint(name, known, "nearest")
        _core.refuse(self.name or "table", f'no column "{name}"', "one of " + ", ".join(self._columns), hint)

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[self.column(name)]

    def __contains__(self, name: object) -> bool:
        try:
            self.column(str(name))
        except InputError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def n_rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def array(self) -> np.ndarray:
        """A structured array: one record a row."""
        kinds = [(key, values.dtype) for key, values in self._columns.items()]
        out = np.empty(self.n_rows, dtype=kinds)
        for key, values in self._columns.items():
            out[key] = values
        return out

    def pandas(self) -> Any:
        """The same as a DataFrame of pandas, which must be installed."""
        import pandas

        return pandas.DataFrame(dict(self._columns))

    def __repr__(self) -> str:
        return f"<Table {self.name!r}: {self.n_rows} rows, {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        shown: List[Optional[int]] = list(range(self.n_rows)) if self.n_rows <= 12 else [*range(6), None, *range(self.n_rows - 6, self.n_rows)]
        lines = ["<table><tr>" + "".join(f"<th>{html.escape(key)}</th>" for key in self._columns) + "</tr>"]
        for row in shown:
            cells = ["…" if row is None else _shown(values[row]) for values in self._columns.values()]
            lines.append("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>")
        return "\n".join(lines) + "</table>"


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)


def _numbers(texts: List[str]) -> np.ndarray:
    numbers = [_number(text) for text in texts]
    if any(number is None for number in numbers):
        return np.array(texts, dtype=object)
    return np.array(numbers, dtype=float)


def _number(text: str) -> Optional[float]:
    if not text:
        return float("nan")
    try:
        return float(text)
    except ValueError:
        return None
