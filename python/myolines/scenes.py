# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes as objects: what the program reads from XML, with its names, units, defaults and checks."""

from __future__ import annotations

import html
import os
import warnings
from typing import Any, Callable, Dict, Iterator, Mapping, Optional, Tuple, Union

import numpy as np

from . import _core
from .errors import InputError

Path = Union[str, "os.PathLike[str]"]
_VALUES: Dict[str, Callable[[str], Any]] = {"number": float, "integer": int, "boolean": lambda text: text == "true"}


def _text(value: Any) -> str:
    """A value as scenes spell it. Rows of numbers are "t x; t x", numbers in a row "x y z"."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    rows = np.asarray(value, dtype=float)
    if rows.ndim == 2:
        return "; ".join(_text(row) for row in rows)
    return " ".join(repr(float(number)) for number in rows)


class List:
    """A list of a scene: parameters by name, and the lists in it, as items or as attributes with underscores for blanks.

    An empty place is None, or an empty list: setting something in it writes it. Values are floats, ints, bools and words.
    """

    def __init__(self, scene: "Scene", path: str):
        object.__setattr__(self, "_scene", scene)
        object.__setattr__(self, "_path", path)

    def _below(self, name: str) -> str:
        return f"{self._path}/{name}" if self._path else name

    def _contents(self) -> Dict[str, Any]:
        return self._scene._document.contents(self._path)

    def keys(self) -> "list[str]":
        """Names of the parameters and lists that may stand here."""
        return [item["name"] for item in self._contents()["items"]]

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def __contains__(self, name: str) -> bool:
        """Whether there is a value, or a list, at a path."""
        try:
            return bool(self._scene._item(self._below(name))["present"])
        except InputError:
            return False

    def __getitem__(self, path: str) -> Any:
        return self._scene._value(self._below(path))

    def __setitem__(self, path: str, value: Any) -> None:
        self._scene.update({self._below(path): value})

    def __delitem__(self, path: str) -> None:
        self._scene._remove(self._below(path))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self[self._scene._spelt(self._path, name)]

    def __setattr__(self, name: str, value: Any) -> None:
        self[self._scene._spelt(self._path, name)] = value

    def __dir__(self) -> "list[str]":
        return [*super().__dir__(), *(name.replace(" ", "_") for name in self.keys() if name.replace(" ", "_").isidentifier())]

    def unit(self, name: str) -> str:
        """Unit of a parameter: "m", "-" for none."""
        return str(self._scene._item(self._below(name)).get("unit", ""))

    def help(self, name: str = "") -> str:
        """What a parameter or list is, in words; of this list with all that may stand in it."""
        if name:
            item = self._scene._item(self._below(name))
            return str(item["doc"]) if item["list"] else _declared(item)
        contents = self._contents()
        lines = [contents["doc"]]
        lines += [f'{item["name"]}: {item["doc"] if item["list"] else _declared(item)}' for item in contents["items"]]
        return "\n".join(lines)

    def __repr__(self) -> str:
        try:
            items = self._contents()["items"]
        except InputError as error:
            return f"<{self._path or 'scene'}: not valid\n{error}>"
        words = []
        for item in items:
            if item["present"]:
                words.append(f'  {item["name"]} {{...}}' if item["list"] else f'  {item["name"]} = {item["text"]} {_unit(item)}'.rstrip())
        return f"<{self._path or 'scene'}\n" + "\n".join(words) + ">"

    def _repr_html_(self) -> str:
        try:
            return "<table><tr><th>name</th><th>value</th><th>unit</th><th>meaning</th></tr>" + _rows(self._scene, self._path, 0) + "</table>"
        except InputError as error:
            return f"<pre>{html.escape(str(error))}</pre>"


def _declared(item: Mapping[str, Any]) -> str:
    default = f', default {item["default"]}' if item["default"] is not None else ""
    return f'{item["expected"]}{default}. {item["doc"]}'


def _unit(item: Mapping[str, Any]) -> str:
    return "" if item.get("unit") in ("", "-", None) else f'[{item["unit"]}]'


def _rows(scene: "Scene", path: str, depth: int) -> str:
    """Rows of what is present; what the scene itself writes is bold."""
    lines = []
    for item in scene._document.contents(path)["items"]:
        if not item["present"]:
            continue
        below = f'{path}/{item["name"]}' if path else item["name"]
        name = "&emsp;" * depth + html.escape(item["name"])
        if item["list"]:
            lines.append(f"<tr><th style='text-align:left' colspan=4>{name}</th></tr>" + _rows(scene, below, depth + 1))
            continue
        value = html.escape(item["text"])
        value = f"<b>{value}</b>" if item["written"] else value
        lines.append(f"<tr><td style='text-align:left'>{name}</td><td>{value}</td><td>{html.escape(_unit(item))}</td>"
                     f"<td style='text-align:left'>{html.escape(item['doc'])}</td></tr>")
    return "".join(lines)


class Scene(List):
    """A scene: Scene("input/oscillator.xml"), Scene.template("oscillator", "bdf2"), Scene.from_xml(text).

        scene["system/mass"] = 2          # or scene.system.mass = 2
        scene["system/geometry/length"] = (30, "mm")
        scene.update({"time/end": 1, "system/boundary/pull": {"face": "x+", "type": "traction", ...}})
        del scene["output/fields"]

    A name or value that is wrong is an InputError at once, with the words of the program and the nearest valid name, and changes nothing.
    What is missing is told by check(), and by whatever uses the scene. Choosing another alternative ("integrator/type") takes away what
    the file has for the former one, as `--set` of the program does; `notes` tells.
    """

    def __init__(self, file: Optional[Path] = None, *, _document: Any = None):
        if _document is None and file is None:
            raise TypeError("a scene is of a file, of a text (from_xml), or an example (template)")
        document = _document if file is None else _core.Document.from_file(os.fspath(file))
        object.__setattr__(self, "_document", document)
        super().__init__(self, "")

    @classmethod
    def from_xml(cls, xml: str, name: str = "scene", folder: Path = ".") -> "Scene":
        """A scene from its text; name stands for the file in messages, relative paths start from the folder."""
        return cls(_document=_core.Document(xml, name, os.fspath(folder)))

    @classmethod
    def template(cls, system: str, integrator: str = "") -> "Scene":
        """The example of a system, as `myolines template` prints it: without an integrator with the one to begin with."""
        return cls(_document=_core.Document(_core.template_text(system, integrator), system, "."))

    def copy(self) -> "Scene":
        """Another scene with the same values."""
        return Scene(_document=self._document.copy())

    def update(self, values: Mapping[str, Any]) -> "Scene":
        """Sets several values by their paths, all or none; a mapping as a value stands for a list. Returns the scene."""
        self._document.set(list(self._settings("", values)))
        return self

    def with_values(self, values: Mapping[str, Any]) -> "Scene":
        """A copy with these values."""
        return self.copy().update(values)

    def add_list(self, path: str) -> List:
        """Writes a list that has no values of its own."""
        self._document.add_list(path)
        return List(self, path)

    @property
    def name(self) -> str:
        """The file, or what stands for it in messages."""
        return str(self._document.name)

    @property
    def notes(self) -> "list[str]":
        """What changes have left out of the file, a sentence each."""
        return list(self._document.notes())

    def check(self) -> "list[str]":
        """Makes everything that a run needs, and runs nothing. Raises InputError for what is wrong; returns warnings."""
        return list(self._document.check())

    def plan(self) -> "list[str]":
        """What a run computes, what it skips and why, how it solves: lines."""
        return list(self._document.plan())

    def xml(self, all_values: bool = False) -> str:
        """XML of what is written, or of all values in force."""
        return str(self._document.resolved_xml() if all_values else self._document.written_xml())

    def save(self, file: Path) -> None:
        """Writes xml() to a file. Paths of other files in it are absolute."""
        text = self.xml()
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)

    def __getstate__(self) -> Tuple[str, str]:
        return self.xml(), self.name

    def __setstate__(self, state: Tuple[str, str]) -> None:
        self.__init__(_document=_core.Document(state[0], state[1], "."))  # type: ignore[misc]

    def _settings(self, path: str, values: Mapping[str, Any]) -> Iterator[Tuple[str, str]]:
        for name, value in values.items():
            below = f"{path}/{name}" if path else name
            if isinstance(value, Mapping):
                yield from self._settings(below, value)
            elif isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str):
                yield below, _text(self._converted(below, *value))
            elif value is None:
                raise TypeError(f"{below}: None is no value; `del scene[...]` takes away what is written")
            else:
                yield below, _text(value)

    def _converted(self, path: str, value: Any, unit: str) -> Any:
        wanted = self._item(path).get("unit", "")
        factor = _core.unit_factor(unit, wanted)
        if factor is None:
            _core.refuse(f"{self.name}: {path}", f"{value} {unit} cannot be converted", f"a number in a unit like [{wanted}]")
        return np.asarray(value, dtype=float) * factor if np.ndim(value) else float(value) * factor

    def _item(self, path: str) -> Dict[str, Any]:
        """What is known of the parameter or list at a path. Raises InputError with the nearest name."""
        parent, _, name = path.rpartition("/")
        contents = self._document.contents(parent)
        for item in contents["items"]:
            if item["name"] == name:
                return dict(item)
        names = [item["name"] for item in contents["items"]]
        hint = _core.nearest_hint(name, names, "nearest valid name") or "valid names: " + ", ".join(names)
        _core.refuse(f"{self.name}: {path}", f'unknown parameter "{name}"', "a name that is declared here", hint)

    def _value(self, path: str) -> Any:
        item = self._item(path)
        if item["list"]:
            return List(self, path)
        return None if item["text"] is None else _VALUES.get(item["kind"], str)(item["text"])

    def _spelt(self, path: str, name: str) -> str:
        """The name that an attribute stands for: that with blanks where there is one."""
        try:
            names = [item["name"] for item in self._document.contents(path)["items"]]
        except InputError:
            names = []
        for known in names:
            if known.replace(" ", "_").replace("-", "_") == name:
                return str(known)
        return name

    def _remove(self, path: str) -> None:
        self._document.remove(path)


def load(file: Path) -> Scene:
    """The scene in a file."""
    return Scene(file)


def tell(scene: Scene, told: "list[str]") -> None:
    """Warnings of a run of a scene as those of Python; its notes are no surprise to who has changed it."""
    notes = scene.notes
    for text in told:
        if text not in notes:
            warnings.warn(text, stacklevel=3)


def describe(topic: str, name: str = "") -> str:
    """What `myolines list TOPIC [NAME]` prints: describe("integrators"), describe("systems", "rod 1d")."""
    return str(_core.list_text(topic, name))


def topics() -> "list[str]":
    """The topics of describe()."""
    return list(_core.list_topics())
