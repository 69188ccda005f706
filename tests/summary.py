#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the time of a build and of its tests went: summary.py BUILD_FOLDER...

Prints the ten slowest steps of each build (ninja's log), the ten slowest tests, and totals. Test cases are counted and timed from the
tables that the test programs write; tests that are scripts count as one. The last line is "N passed, N failed".
"""

import json
import pathlib
import re
import sys


def build_steps(folder):
    """{output: seconds} of the last time each was made; a step of several outputs is named by its first."""
    steps = {}
    seen = {}
    log = folder / ".ninja_log"
    for line in log.read_text(encoding="utf-8").splitlines()[1:] if log.exists() else []:
        begin, end, _, output, command = line.split("\t")
        seen[command] = seen.get(command, output)
        steps[seen[command]] = (int(end) - int(begin)) / 1000
    return steps


def test_cases(folder):
    """(name, seconds, passed) of every case of the test programs."""
    for file in sorted((folder / "tests" / "results").glob("*.json")):
        name = file.stem.rsplit(".", 1)[0]
        for suite in json.loads(file.read_text(encoding="utf-8"))["testsuites"]:
            for case in suite["testsuite"]:
                if case["result"] == "COMPLETED":
                    yield f"{name}.{suite['name']}.{case['name']}", float(case["time"].rstrip("s")), "failures" not in case


def scripts(folder):
    """(name, seconds, passed) of every other test, from CTest's own log."""
    log = folder / "Testing" / "Temporary" / "LastTest.log"
    text = log.read_text(encoding="utf-8", errors="replace") if log.exists() else ""
    for block in re.split(r"^\d+/\d+ Testing: ", text, flags=re.M)[1:]:
        seconds = re.search(r"^Test time = +([0-9.]+) sec", block, flags=re.M)
        skipped = re.search(r"^(Test Skipped|Skip regular expression found|Skip return code)", block, flags=re.M)
        if seconds and not skipped and "--gtest_output=json" not in block:
            yield block.split("\n", 1)[0], float(seconds.group(1)), re.search(r"^Test Passed\.", block, flags=re.M) is not None


def print_slowest(what, timed):
    timed = sorted(timed, key=lambda item: -item[1])
    print(f"{what}: {len(timed)} in {sum(item[1] for item in timed):.0f} s; the slowest:")
    for name, seconds, *_ in timed[:10]:
        print(f"{seconds:8.1f} s  {name}")


def main(folders):
    folders = [pathlib.Path(folder) for folder in folders]
    tests = []
    for folder in folders:
        print_slowest(f"build steps of {folder.name}", build_steps(folder).items())
        tests += [*test_cases(folder), *scripts(folder)]
    print_slowest("tests", tests)
    failed = [name for name, _, passed in tests if not passed]
    for name in failed:
        print("failed:", name)
    print(f"{len(tests) - len(failed)} passed, {len(failed)} failed")


if __name__ == "__main__":
    main(sys.argv[1:])
