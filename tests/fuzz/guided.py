#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fuzzing led by coverage, with libFuzzer: guided.py FUZZ_PROGRAM SOURCE_FOLDER GUIDED_BUILD_FOLDER SCRATCH_FOLDER [--seconds N] [--target NAME]...

FUZZ_PROGRAM is that of any build, which makes seeds as fuzz.py does. The programs guided_NAME are built with clang and sanitizers:

  cmake -S . -B build/guided -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DMYOLINES_GUIDED_FUZZING=ON && cmake --build build/guided --target guided

Each reads its seeds and then what libFuzzer makes of them, for so many seconds. What a fault was found with is kept in SCRATCH_FOLDER/faults;
what reaches new lines is kept in SCRATCH_FOLDER/NAME and taken up again by the next call.
"""

import argparse
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import fuzz  # noqa: E402
from command_server import CommandServer  # noqa: E402

# Reader: the target of fuzz.py whose seeds it takes, and which of these.
READERS = {
    "scene": ("scenes", ".*"),
    "table": ("tables", ".*"),
    "mesh": ("meshes", ".*"),
    "fields": ("meshes", r".*\.vtu"),
    "prm": ("flexodeal", ".*"),
    "checkpoint": ("runs", ".*/checkpoint"),
    "formula": (None, ""),
}
FORMULAS = ["sin(2*pi*t)", "x < 0.1 ? 1 : 2", "exp(-x^2)*sqrt(y)", "rint(z) + pow(x,2) && t >= 1"]
LONGEST = {"formula": 200}  # [bytes], of others 20,000


def write_seeds(readers, source, scratch, server):
    for reader in readers:
        (scratch / reader).mkdir(parents=True, exist_ok=True)
    for target in fuzz.targets(source, scratch / "seeds", server):
        for reader in readers:
            origin, pattern = READERS[reader]
            for i, (name, data) in enumerate(target.seeds):
                if target.name == origin and re.fullmatch(pattern, name):
                    (scratch / reader / f"seed-{i}").write_bytes(data)
    if "formula" in readers:
        for i, text in enumerate(FORMULAS):
            (scratch / "formula" / f"seed-{i}").write_text(text)


def run(program, reader, scratch, seconds):
    """(inputs, lines reached as libFuzzer counts them, faults)."""
    faults = scratch / "faults"
    faults.mkdir(exist_ok=True)
    before = set(faults.iterdir())
    words = [program, scratch / reader, f"-max_total_time={seconds}", "-timeout=10", "-rss_limit_mb=2048", f"-artifact_prefix={faults}/{reader}-",
             f"-max_len={LONGEST.get(reader, 20000)}", "-seed=1", "-print_final_stats=1", "-detect_leaks=0"]
    log = scratch / f"{reader}.log"
    with log.open("w") as stream:
        subprocess.run([str(word) for word in words], stdout=stream, stderr=subprocess.STDOUT, check=False)
    text = log.read_text(errors="replace")
    covered = re.findall(r"cov: (\d+)", text)
    executed = re.findall(r"number_of_executed_units:\s*(\d+)", text)
    if not covered:
        sys.exit(f"{reader} does not run, see {log}")
    return int(executed[-1]) if executed else 0, int(covered[-1]), sorted(set(faults.iterdir()) - before)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fuzz_program")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=120, help="for each reader")
    parser.add_argument("--target", action="append", choices=list(READERS), help="only this one; may be repeated")
    arguments = parser.parse_args()
    scratch = arguments.scratch.resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    readers = arguments.target or list(READERS)
    server = CommandServer(arguments.fuzz_program)
    write_seeds(readers, arguments.source.resolve(), scratch, server)
    server.close()
    n_faults = 0
    for reader in readers:
        inputs, covered, faults = run(arguments.build.resolve() / "tests" / f"guided_{reader}", reader, scratch, arguments.seconds)
        n_faults += len(faults)
        print(f"{reader}: {inputs} inputs, {covered} edges reached, {len(faults)} faults", flush=True)
        for fault in faults:
            print(f"  {fault}")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())
