#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""pages.py against pages with planted faults: planted_pages.py SCRATCH"""

import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = """#!/bin/sh
printf '## run\\n\\n| `--out DIR` | Where |  |\\n'
"""
LONG = "This sentence goes on " + "and on " * 30 + "until it ends."
FAULTS = [
    ("README.md", "The peer has it too.", "say: Flexodeal"),
    ("README.md", "It is very fast.", "say: nothing, or a number"),
    ("README.md", LONG, "words in a sentence on average"),
    ("README.md", "See [that](doc/nowhere.md).", "there is no doc/nowhere.md"),
    ("README.md", "See [that](doc/manual/glossary.md#nothing).", "has no heading #nothing"),
    ("README.md", "See `source/nothing.cc`.", "there is no source/nothing.cc"),
    ("README.md", "```sh\nmyolines run scene.xml --nothing\n```", "run has no option --nothing"),
    ("README.md", "```sh\nmyolines walk scene.xml\n```", "there is no command walk"),
    ("doc/manual/glossary.md", None, '"kink" is not defined'),
    ("source/peer.cc", "", '"peer"'),
    ("source/dear.cc", "int x; // a dear one\n", '"dear" in a comment'),
    ("doc/interface.md", "See `room/header.h`.", "there is no header room/header.h"),
    ("doc/which_method.md", "| a | b | costs 7 steps ([one](results/one.md)) |\n", "does not have the number 7"),
    ("doc/results/one.md", "# One\n\nA number: 1.\n", "does not say on top when"),
    ("doc/results/one.md", "# One\n\n*Measured 2026-01-01, commit 1234567, by the command below.*\n\n## A\n\n## B\n\n![a curve](../pictures/one.svg)\n",
     "does not begin with a picture"),
    ("doc/results/two.md", "# Two\n\n*Measured 2026-01-01, commit 1234567, by the command below.*\n", "has no row for two.md"),
]
MEASURED = "# One\n\n*Measured 2026-01-01, commit 1234567, by the command below.*\n"
PICTURE = "\n![a curve](../pictures/one.svg)\n"
SOUND = "A page.\n\n```sh\nmyolines run scene.xml --out results   # very\n```\n\nSee [words](doc/manual/glossary.md#words) and `source/main.cc`.\n"


def write(root, path, text):
    os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
    with open(os.path.join(root, path), "w", encoding="utf-8") as file:
        file.write(text)


def look(root):
    done = subprocess.run([sys.executable, "-B", os.path.join(HERE, "pages.py"), root, "--program", os.path.join(root, "program")],
                          capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def plant(root, path, text):
    """A sound repository with one fault; without a path with none, without a text with an empty file."""
    shutil.rmtree(root, ignore_errors=True)
    sys.path.insert(0, HERE)
    import pages
    write(root, "README.md", SOUND)
    write(root, "CONTRIBUTING.md", "A page.\n")
    write(root, "doc/results/index.md", "# Results\n\n[One](one.md).\n")
    write(root, "doc/pictures/one.svg", "")
    write(root, "doc/results/one.md", MEASURED + PICTURE)
    write(root, "source/main.cc", "")
    write(root, "doc/manual/glossary.md", "# Words\n\n" + "".join(f"- **{word}**: a word.\n" for word in pages.DEFINED))
    write(root, "program", PROGRAM)
    os.chmod(os.path.join(root, "program"), 0o755)
    if path == "README.md":
        write(root, path, SOUND + "\n" + text + "\n")
    elif path:
        write(root, path, text or "")


def main():
    sys.dont_write_bytecode = True
    root, wrong = os.path.join(sys.argv[1], "pages"), 0
    plant(root, None, None)
    if look(root) != (0, "0 problems\n"):
        print("sound pages:", look(root))
        wrong += 1
    for path, text, message in FAULTS:
        plant(root, path, text)
        status, said = look(root)
        if status != 1 or message not in said:
            print(f"{path}: {text!r} is not found: {status} {said}")
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
