#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study as a table in Markdown: study_table.py PROGRAM STUDY.xml --rows AXES [--columns AXES] [--only AXIS=POINT] --values NAMES ...

Runs the study, one case at a time, and prints its quantities: a row for every point of the axes of --rows, a column for every point of those of --columns
and every quantity, or with --together all quantities in one. Cases at the same points of both stand side by side in one cell. Quantities
are those of study.csv and seconds.csv; "fails" stands where a run did. Of values below --rounding in size no digit means anything: "0" stands there. --initials prints words as their first letters. --equal-error WORKS prints instead what these cost at the target of a
work-precision study, as equal_error.csv has it.
$MYOLINES_RESULTS, if set, is where the study's folder is kept: called again with it, nothing is run again.
"""

import argparse
import csv
import os
import subprocess
import sys
import tempfile

from block import ENVIRONMENT

SECONDS = "[s]"


def run_study(program, study, results, *settings):
    """Rows of study.csv with those of seconds.csv, and of equal_error.csv where there is one, as dictionaries."""
    folder = os.path.join(results, os.path.splitext(os.path.basename(study))[0])
    command = [program, "study", study, "--out", folder, "--quiet", "--jobs", "1", *settings]
    if subprocess.run(command, env=ENVIRONMENT, stdout=sys.stderr, check=False).returncode != 0:
        raise SystemExit(1)

    def rows(name):
        if not os.path.exists(os.path.join(folder, name)):
            return []
        with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    seconds = {row["case"]: row for row in rows("seconds.csv")}
    return [dict(row, **seconds.get(row["case"], {})) for row in rows("study.csv")], rows("equal_error.csv")


def written(text, name, digits, rounding=0):
    """A value as it is printed: counts whole, all else with so many digits, and nothing of what is rounding."""
    if text == "":
        return ""
    value = float(text)
    if abs(value) < rounding:
        return "0"
    if name.endswith(SECONDS):
        return f"{float(f'{value:.{digits}g}'):g}"
    if value == int(value) and "." not in text and "e" not in text:
        return str(int(value))
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def head_of(name, row):
    """The column of an axis or a quantity, which has a unit where these have: "step [s]"."""
    return next((head for head in row if head == name or head.startswith(name + " [")), name)


def labels(rows, axes):
    """The points of the axes in the order in which they appear."""
    heads = [head_of(axis, rows[0]) for axis in axes]
    return heads, list(dict.fromkeys(tuple(row[head] for head in heads) for row in rows))


def entry(rows, names, given):
    """One cell: quantities together, cases side by side."""
    if given.initials:
        return " ".join((row[name] if row["status"] == "done" else row["status"])[:1] for row in rows for name in names)
    parts = []
    for row in rows:
        if row["status"] != "done":
            parts.append("fails" if row["status"] == "failed" else row["status"])
        else:
            parts.append(", ".join(written(row[name], name, given.digits, given.rounding) for name in names))
    return " / ".join(parts)


def print_table(heads, lines):
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for line in lines:
        print("| " + " | ".join(line) + " |")


def print_cases(rows, given):
    for condition in given.only:
        axis, allowed = condition.split("=", 1)
        head = head_of(axis, rows[0])
        rows = [row for row in rows if row.get(head) in allowed.split("|")]
    if not rows:
        raise SystemExit("no case is left by --only")
    given.values = [head_of(name, rows[0]) for name in given.values]
    missing = [name for name in given.values if name not in rows[0]]
    if missing:
        raise SystemExit(f"the study has no {missing[0]}; it has " + ", ".join(rows[0]))
    row_heads, row_points = labels(rows, given.rows)
    column_heads, column_points = labels(rows, given.columns)
    groups = [given.values] if given.together else [[name] for name in given.values]
    heads = row_heads + [": ".join([", ".join(point)] * bool(point) + [", ".join(names)] * (not given.together or not point))
                         for names in groups for point in column_points]
    lines = []
    for row_point in row_points:
        line = list(row_point)
        for names in groups:
            for column_point in column_points:
                line.append(entry([row for row in rows if tuple(row[head] for head in row_heads) == row_point
                                   and tuple(row[head] for head in column_heads) == column_point], names, given))
        lines.append(line)
    print_table(heads, lines)


def print_equal_error(given, results):
    """What each of the works costs, methods in the order of the study; "-" where no two neighbouring runs of a method enclose the target,
    a bound where all are more accurate."""
    costs = {}
    for work in given.equal_error:
        rows = run_study(given.program, given.study, results, "--set", f"work={work}")[1]
        if not rows:
            raise SystemExit("the study has no target: its kind is not work-precision")
        costs[work] = {next(iter(row.values())): row for row in rows}
    lines = []
    for method in next(iter(costs.values())):
        rows = [(work, costs[work][method]) for work in costs]
        lines.append([method])
        for work, row in rows:
            number, bound = (row[work], "") if row[work] else (row["at most"], "<= ")
            lines[-1].append(bound + f"{float(number):.{2 if work.startswith('CPU') else 1}f}" if number else "-")
    print_table(["method"] + [work + (" [s]" if work.startswith("CPU") else "") for work in costs], lines)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("study")
    arguments.add_argument("--rows", nargs="+", default=[], metavar="AXIS")
    arguments.add_argument("--columns", nargs="+", default=[], metavar="AXIS")
    arguments.add_argument("--values", nargs="+", default=[], metavar="QUANTITY")
    arguments.add_argument("--together", action="store_true")
    arguments.add_argument("--only", nargs="+", default=[], metavar="AXIS=POINT|POINT")
    arguments.add_argument("--initials", action="store_true")
    arguments.add_argument("--digits", type=int, default=2)
    arguments.add_argument("--rounding", type=float, default=0, metavar="SIZE")
    arguments.add_argument("--equal-error", nargs="+", default=[], metavar="WORK")
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        results = os.environ.get("MYOLINES_RESULTS", scratch)
        if given.equal_error:
            print_equal_error(given, results)
        else:
            print_cases([row for row in run_study(given.program, given.study, results)[0] if row["role"] == "case"], given)


if __name__ == "__main__":
    main()
