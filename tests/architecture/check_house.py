#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks that the sources keep to the house of doc/architecture.md.

check_house.py ROOT                       every violation is one line, exit 1 if there is any
check_house.py --self-test ROOT SCRATCH   plants one violation of each kind in a copy below SCRATCH, expects each to be found

Only modules of python3-minimal.
"""

import os
import re
import sys

LONGEST_FILE = 400
LARGEST_ROOM = 0.12  # of the lines of all rooms
SCANNED = ("include", "source", "integrators", "boundary", "outputs", "profiles", "python")
ROOM_OF_REGISTRY = {"integrators": "integrators", "boundary": "boundary", "outputs": "observers", "profiles": "system"}
ROOM_OF_FOLDER = {**ROOM_OF_REGISTRY, "python": "python"}
# Linked with all rooms at once: the program and what is made of the library.
NO_TARGETS = ("main", "python")
CODE = (".h", ".cc", ".py", ".sh")
LICENCE = "SPDX-License-Identifier: LGPL-2.1-or-later"

# (what, names in the code, folders that may use them)
FENCES = (
    ("Epetra and Thyra", r"\b(Epetra_\w+|Thyra(::|_)|EpetraExt\w*)", ("include/myolines/algebra", "source/algebra", "source/solve")),
    ("NOX, Belos, Anasazi, ML and Amesos", r"\bNOX(::|_)|\b(Belos|Anasazi)(::|\w*\.hpp)|\bML_(Epetra|\w+\.h)|\bml_\w+\.h|\bAmesos\w*[:.]", ("source/solve",)),
    ("XML of Teuchos", r"\bTeuchos_XML\w*|\bTeuchos::XML\w*|Xml(File|String|Stream)\b", ("source/scene",)),
    ("SQLite", r"\bsqlite3_\w+|[<\"]sqlite3\.h", ("source/study",)),
    ("pybind11", r"[<\"]pybind11/|\bpybind11::|\bPYBIND11_", ("python/source",)),
    ("SUNDIALS", r"[<\"](sundials|arkode|cvodes?|idas?|kinsol|nvector)/", ("integrators/sundials_", "source/integrators/sundials_", "include/myolines/integrators/sundials_")),
)

# The translator names the methods of the program that it translates from.
MAY_NAME_METHODS = ("source/cli/flexodeal.cc", "source/cli/flexodeal_parameters.cc")


def read(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def floors(root):
    """The table of doc/architecture.md: room -> rooms directly below."""
    table = {}
    for line in read(os.path.join(root, "doc/architecture.md")).splitlines():
        row = re.match(r"\| `(\w+)` \|([^|]*)\|", line)
        if row:
            table[row.group(1)] = re.findall(r"`(\w+)`", row.group(2))
    return table


def reachable(table, room):
    """Everything @p room may include: itself and all below it."""
    seen = set()
    todo = [room]
    while todo:
        next_room = todo.pop()
        if next_room not in seen:
            seen.add(next_room)
            todo += table.get(next_room, [])
    return seen


def room_of(path):
    parts = path.split("/")
    if parts[0] in ROOM_OF_FOLDER:
        return ROOM_OF_FOLDER[parts[0]]
    inside = parts[2:] if parts[0] == "include" else parts[1:]
    return inside[0] if len(inside) > 1 else os.path.splitext(inside[0])[0]


def files(root, folders):
    for folder in folders:
        for place, _, names in os.walk(os.path.join(root, folder)):
            for name in sorted(names):
                yield os.path.relpath(os.path.join(place, name), root).replace(os.sep, "/")


def without_comments(text):
    """Line numbers stay."""
    text = re.sub(r"/\*.*?\*/", lambda comment: "\n" * comment.group(0).count("\n"), text, flags=re.S)
    return re.sub(r"//[^\n]*", "", text)


def include_violations(root, path, text, table):
    room = room_of(path)
    if room == "pch":  # third-party headers only; a header of ours in it would rebuild the world
        return [f"{path}: the precompiled header includes {name}" for name in re.findall(r"#\s*include <myolines/(?!pch)([^>]*)>", text)]
    if room not in table:
        return [f"{path}: the room {room} is not in the table of doc/architecture.md"]
    found = []
    allowed = reachable(table, room)
    for number, line in enumerate(text.splitlines(), 1):
        ours = re.search(r"#\s*include\s*<myolines/(\w+)/", line)
        if ours and ours.group(1) not in allowed:
            found.append(f"{path}:{number}: {room} includes {ours.group(1)}, which is not below it")
        quoted = re.search(r'#\s*include\s*"([^"]*)"', line)
        if quoted and "list.def" not in quoted.group(1) and "/" in quoted.group(1):
            found.append(f"{path}:{number}: a quoted include leaves its folder: {quoted.group(1)}")
    return found


def fence_violations(path, text):
    found = []
    for what, names, places in FENCES:
        if any(path.startswith(place) for place in places):
            continue
        for number, line in enumerate(text.splitlines(), 1):
            if re.search(names, line):
                found.append(f"{path}:{number}: {what} may be named only in {', '.join(places)}")
    return found


def cmake_violations(root, table):
    """The targets link what the table says."""
    found = []
    declared = {}
    for name, rest in re.findall(r"^myolines_room\((\w+)([^)]*)\)", read(os.path.join(root, "CMakeLists.txt")), flags=re.M):
        below = re.search(r"BELOW ([\w ]*?)(?: SOURCES|$)", rest)
        declared[name] = below.group(1).split() if below else []
    for room in sorted(set(table) | set(declared)):
        if room not in NO_TARGETS and sorted(table.get(room, [])) != sorted(declared.get(room, [])):
            found.append(f"CMakeLists.txt: the room {room} links {declared.get(room)}, doc/architecture.md says {table.get(room)}")
    return found


# (list, its lines, ending of the files beside it)
REGISTRIES = (
    *((folder + "/list.def", r"^MYOLINES_\w+\((\w+)\)", ".cc") for folder in ROOM_OF_REGISTRY),
    ("include/myolines/materials/laws/list.def", r"^MYOLINES_LAW\((\w+), [^)]+\)", ".h"),
)


def registry_violations(root):
    found = []
    for path, line, ending in REGISTRIES:
        folder = os.path.dirname(path)
        listed = re.findall(line, read(os.path.join(root, path)), flags=re.M)
        present = [name[: -len(ending)] for name in os.listdir(os.path.join(root, folder)) if name.endswith(ending)]
        found += [f"{path}: {name} has no file {folder}/{name}{ending}" for name in listed if name not in present]
        found += [f"{folder}/{name}{ending} has no line in {path}" for name in present if name not in listed]
        found += [f"{path}: {name} is listed twice" for name in sorted(set(listed)) if listed.count(name) > 1]
    return found


def method_names(root):
    """As scenes spell them."""
    names = []
    for path in files(root, ("integrators",)):
        if path.endswith(".cc"):
            names += re.findall(r'facts\.name\s*=\s*"([^"]+)"', read(os.path.join(root, path)))
    return names


def method_violations(path, text, methods):
    """Only the file of a method names it: others ask the registry."""
    if room_of(path) == "integrators" or path in MAY_NAME_METHODS:
        return []
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        for constant in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
            found += [
                f"{path}:{number}: the constant names the integrator {name}"
                for name in methods
                if re.search(r"(?<![\w-])" + re.escape(name) + r"(?![\w-])", constant)
            ]
    return found


def length_violations(root):
    found = []
    for path in files(root, SCANNED + ("tests",)):
        if path.endswith(CODE):
            lines = read(os.path.join(root, path)).count("\n")
            if lines > LONGEST_FILE:
                found.append(f"{path}: {lines} lines, more than {LONGEST_FILE}")
    return found


def size_violations(root):
    """Named by its longest file, where to begin."""
    rooms = {}
    for path in files(root, SCANNED):
        if path.endswith((".h", ".cc")):
            rooms.setdefault(room_of(path), {})[path] = read(os.path.join(root, path)).count("\n")
    limit = LARGEST_ROOM * sum(sum(room.values()) for room in rooms.values())
    return [
        f"{max(room, key=room.get)}: the room {name} has {sum(room.values())} lines, more than {LARGEST_ROOM:.0%} of all"
        for name, room in rooms.items()
        if sum(room.values()) > limit
    ]


def licence_violations(root):
    return [
        f"{path}: no line {LICENCE}"
        for path in files(root, SCANNED + ("tests", "doc", "examples"))
        if path.endswith(CODE) and LICENCE not in read(os.path.join(root, path))
    ]


def violations(root):
    table = floors(root)
    methods = method_names(root)
    found = cmake_violations(root, table) + registry_violations(root) + length_violations(root) + size_violations(root) + licence_violations(root)
    for path in files(root, SCANNED):
        if path.endswith((".h", ".cc")):
            text = without_comments(read(os.path.join(root, path)))
            found += include_violations(root, path, text, table) + fence_violations(path, text)
            found += method_violations(path, text, methods)
    return found


# (file, text to plant, part of the complaint expected)
PLANTED = (
    ("source/base/planted.cc", "#include <myolines/time/loop.h>\n", "base includes time"),
    ("source/time/planted.cc", "#include <myolines/muscle3d/parameters.h>\n", "time includes muscle3d"),
    ("include/myolines/materials/planted.h", "# include <myolines/fem/element.h>\n", "materials includes fem"),
    ("source/output/planted.cc", "#include <myolines/cli/cli.h>\n", "output includes cli"),
    ("source/study/planted.cc", "#include <myolines/cli/commands.h>\n", "study includes cli"),
    ("integrators/planted.cc", "#include <myolines/oscillator/oscillator_system.h>\n", "integrators includes oscillator"),
    ("source/fem/planted.cc", "Epetra_Map map;\n", "Epetra and Thyra may be named only"),
    ("include/myolines/solve/planted.h", "#include <NOX.H>\n#include <BelosTypes.hpp>\n", "NOX, Belos, Anasazi, ML and Amesos may be named only"),
    ("source/cli/planted4.cc", "#include <AnasaziConfigDefs.hpp>\n", "NOX, Belos, Anasazi, ML and Amesos may be named only"),
    ("source/cli/planted.cc", "Teuchos::XMLObject object;\n", "XML of Teuchos may be named only"),
    ("source/cli/planted3.cc", "#include <sqlite3.h>\n", "SQLite may be named only"),
    ("source/time/planted2.cc", "#include <arkode/arkode.h>\n", "SUNDIALS may be named only"),
    ("source/cli/planted5.cc", "#include <pybind11/pybind11.h>\n", "pybind11 may be named only"),
    ("source/attic/planted.cc", "int x;\n", "the room attic is not in the table"),
    ("source/scene/planted.cc", '#include "../time/loop.h"\n', "a quoted include leaves its folder"),
    ("tests/base/planted.cc", "\n" * (LONGEST_FILE + 1), f"more than {LONGEST_FILE}"),
    ("source/base/planted2.cc", "int x;\n", "no line SPDX"),
    ("source/attic/planted2.cc", "int x;\n" * 20000, "more than 12% of all"),
    ("integrators/planted2.cc", "\n", "has no line in integrators/list.def"),
    ("boundary/planted.cc", "#include <myolines/output/manifest.h>\n", "boundary includes output"),
    ("boundary/planted2.cc", "\n", "has no line in boundary/list.def"),
    ("outputs/planted.cc", "\n", "has no line in outputs/list.def"),
    ("include/myolines/materials/laws/planted2.h", "\n", "has no line in include/myolines/materials/laws/list.def"),
    ("source/cli/planted2.cc", 'const char *advice = "bdf2 and sdirk2 do";\n', "the constant names the integrator bdf2"),
)
INNOCENT = (
    ("source/cli/innocent.cc", 'const char *words = "quasi-static"; // unlike "bdf2"\n', ""),
    ("source/fem/innocent.cc", "// Epetra_Map is named here only in words\n#include <myolines/base/error.h>\n", ""),
    ("source/solve/innocent.cc", "#include <Epetra_Map.h>\n#include <NOX.H>\n#include <myolines/algebra/vector.h>\n", ""),
)


def plant(root, path, text):
    full = os.path.join(root, path)
    os.makedirs(os.path.dirname(full), exist_ok=True)
    with open(full, "w", encoding="utf-8") as stream:
        stream.write(text)


def empty(folder):
    for place, folders, names in os.walk(folder, topdown=False):
        for name in names:
            os.remove(os.path.join(place, name))
        for name in folders:
            os.rmdir(os.path.join(place, name))


def self_test(root, scratch):
    copy = os.path.join(scratch, "planted_house")
    empty(copy)
    texts = [path for path in files(root, SCANNED + ("doc", "tests")) if path.endswith(CODE + (".md", ".def"))]
    for path in texts + ["CMakeLists.txt"]:
        plant(copy, path, read(os.path.join(root, path)))
    before = violations(copy)
    for path, text, _ in PLANTED:
        plant(copy, path, text)
    for path, text, _ in INNOCENT:
        plant(copy, path, f"// {LICENCE}\n{text}")
    plant(copy, "integrators/list.def", read(os.path.join(root, "integrators/list.def")) + "MYOLINES_INTEGRATOR(ghost)\n")
    after = [line for line in violations(copy) if line not in before]

    problems = []
    for path, _, complaint in PLANTED + (("integrators/list.def", "", "ghost has no file"),):
        if not any(line.startswith(path) and complaint in line for line in after):
            problems.append(f"planted in {path}, not found: {complaint}")
    return problems + [f"innocent, but found: {line}" for line in after if "innocent" in line]


def main(arguments):
    if arguments[:1] == ["--self-test"]:
        found = self_test(arguments[1], arguments[2])
    else:
        found = violations(arguments[0])
    for line in found:
        print(line)
    print(f"{len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
