#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Follows pages of doc/ to the letter: types their commands, in their order, where a reader does.

follow.py [--installed SCENES] PAGE ...

Every block ``` sh of the pages is run by bash in the present folder, as one who copies it. It ends with 0, and leaves every file and folder that it names
behind `--out`, and every output that it sets in gnuplot. In blocks without a language a line "$ COMMAND" is typed too: it prints what follows it, and its exit
code is that of README: 2 where that is a refusal. The present folder is that of the sources, with build/release/myolines. With --installed it may be any folder:
the commands are changed as the first tutorial tells who has the package installed, `myolines` in place of build/release/myolines and SCENES in place of
input/, and ./myolines.sh build is left out.

Every stumble is a line: page, line, command, what came instead. Exit code 1 if there is any. Only modules of python3-minimal.
"""

import os
import re
import subprocess
import sys

REFUSED = 2


class Reader:
    def __init__(self, scenes):
        self.scenes = scenes
        self.stumbles = 0

    def as_typed(self, text):
        if not self.scenes:
            return text
        text = re.sub(r"^\./myolines\.sh build$", ":", text, flags=re.M)
        text = text.replace("build/release/myolines", "myolines")
        return re.sub(r"(?<![\w./])input/", self.scenes.rstrip("/") + "/", text)

    def stumble(self, page, line, command, what):
        self.stumbles += 1
        print(f"{page}:{line}: {command.strip()}\n  {what}", flush=True)

    def run(self, command):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)

    def follow_commands(self, page, line, block):
        command = self.as_typed(block)
        print(f"$ {command.rstrip()}", flush=True)
        done = self.run(command)
        print(done.stdout, end="", flush=True)
        if done.returncode != 0:
            self.stumble(page, line, block, f"exit code {done.returncode}")
        for left in re.findall(r"--out (\S+)", command) + re.findall(r"^set output '([^']+)'", command, flags=re.M):
            if not os.path.isdir(left) and not (os.path.exists(left) and os.path.getsize(left) > 0):
                self.stumble(page, line, block, f"{left} is not there, or empty")

    def follow_session(self, page, line, block):
        """$ COMMAND, and what it prints."""
        for typed, expected in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n?)*)", block, flags=re.M):
            command = self.as_typed(typed)
            print(f"$ {command}", flush=True)
            done = self.run(command)
            if done.stdout.strip() != self.as_typed(expected).strip():
                self.stumble(page, line, typed, f"prints\n{done.stdout}")
            if done.returncode != (REFUSED if "\n  expected: " in expected else 0):
                self.stumble(page, line, typed, f"exit code {done.returncode}")

    def follow(self, page):
        with open(page, encoding="utf-8") as file:
            text = file.read()
        commands = 0
        for block in re.finditer(r"^```([^\n]*)\n(.*?)^```$", text, flags=re.M | re.S):
            line = text.count("\n", 0, block.start()) + 1
            if block.group(1) == "sh":
                self.follow_commands(page, line, block.group(2))
            elif block.group(1) == "" and block.group(2).startswith("$ "):
                self.follow_session(page, line, block.group(2))
            else:
                continue
            commands += 1
        if commands == 0:
            self.stumble(page, 1, "", "the page has no commands")


def main():
    arguments = sys.argv[1:]
    scenes = ""
    if len(arguments) > 1 and arguments[0] == "--installed":
        scenes, arguments = arguments[1], arguments[2:]
    if not arguments or arguments[0].startswith("-"):
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    reader = Reader(scenes)
    for page in arguments:
        reader.follow(page)
    print(f"{reader.stumbles} stumbles")
    return 1 if reader.stumbles else 0


if __name__ == "__main__":
    sys.exit(main())
