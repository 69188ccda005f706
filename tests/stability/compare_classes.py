#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a stability map and compares the class of every case with the one expected.

compare_classes.py PROGRAM STUDY EXPECTED FOLDER

EXPECTED is a table "case,class". Every difference is one line, with the reason of the run if it has one; exit 1 if there is any.
The class `failed` is compared like the others; what failed and why is in study.csv of FOLDER.
"""

import csv
import shutil
import subprocess
import sys


def rows(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def main(program, study, expected, folder):
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([program, "study", study, "--out", folder, "--jobs", "1"], check=True)
    found = {row["case"]: row for row in rows(folder + "/study.csv") if row["role"] == "case"}
    wanted = {row["case"]: row["class"] for row in rows(expected)}
    problems = [f"{case}: not in the study" for case in wanted if case not in found]
    problems += [f"{case}: {row['class']}, but no class is expected" for case, row in found.items() if case not in wanted]
    problems += [
        f"{case}: {found[case]['class']} instead of {which} ({found[case]['status']} {found[case]['reason']})"
        for case, which in wanted.items()
        if case in found and found[case]["class"] != which
    ]
    for line in problems:
        print(line)
    print(f"{len(wanted)} classes expected, {len(problems)} problems")
    return 1 if problems or not wanted else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
