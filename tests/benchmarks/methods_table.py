#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of methods and systems, in Markdown, from what `list methods` says.

methods_table.py PROGRAM
"""

import string
import subprocess
import sys


def listed(program):
    """For each method the systems it runs, and the reason for each of the others."""
    lines = subprocess.run([program, "list", "methods"], capture_output=True, text=True, check=True).stdout.splitlines()
    methods = {}
    for line in lines:
        if not line.startswith(" "):
            runs, refused = [], {}
            methods[line] = (runs, refused)
        elif line.startswith("    runs "):
            runs += line[len("    runs "):].split("; ")
        elif line.startswith("    not "):
            names, reason = line[len("    not "):].split(": ", 1)
            refused.update({system: reason for system in names.split("; ")})
    return methods


def main():
    methods = listed(sys.argv[1])
    systems = max((runs for runs, _ in methods.values()), key=len)
    letters = {}
    print("| method | " + " | ".join(systems) + " |")
    print("|---" * (len(systems) + 1) + "|")
    for method, (_, refused) in methods.items():
        cells = []
        for system in systems:
            reason = refused.get(system, "").replace(f'"{method}"', "it")
            if reason and reason not in letters:
                letters[reason] = string.ascii_lowercase[len(letters)]
            cells.append(letters[reason] if reason else "yes")
        print(f"| `{method}` | " + " | ".join(cells) + " |")
    print()
    for reason, letter in letters.items():
        print(f"- {letter}: {reason}")


if __name__ == "__main__":
    main()
