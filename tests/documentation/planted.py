#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/check against pages with planted faults: planted.py ROOT SCRATCH

Each page is right but for one fault, which must be found with page and line; pages without fault must pass, and --write must mend what differs
and nothing else. The commands of the pages print fixed tables, so that no program is run.
"""

import contextlib
import importlib.machinery
import importlib.util
import io
import os
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True

TABLE = """\
| method | steps | error | CPU [s] |
|---|---|---|---|
| one | 10 | 1.23e-4 | 0.5 |
| two of 3 | 20 + 1, 44 | -0.056 | 1.5 |"""

PAGE = """\
# A page

Text with 5 numbers, and a fence in which nothing is looked at:

```
<!-- made by
```

<!-- made by tests/print_table.py build/release/myolines 'a word'
name: table
digits: 2
not compared: CPU [s]
made: 2026-01-31, commit abc1234, load 0.5
-->
{table}
<!-- end of table -->
Between.
<!-- made by tests/print_table.py
name: exact
not compared: [s]
long: an hour
made: 2026-01-31, commit abc1234, load 0.5, on a cluster
-->
{long}
<!-- end of exact -->
The end.
"""

COMMAND = f'''#!/usr/bin/env python3
import sys
if sys.argv[1:] not in ([], [{{program!r}}, "a word"]):
    sys.exit("arguments: " + repr(sys.argv))
print("""{TABLE}""")
'''

PROGRAM = """#!/usr/bin/env python3
import os, sys
folder = sys.argv[sys.argv.index("--out") + 1]
os.makedirs(folder)
open(os.path.join(folder, "manifest.json"), "w").write('{"git hash": "fedcba9"}')
"""


class Pages:
    """A repository of one page."""

    def __init__(self, check, scratch):
        self.check, self.root = check, scratch
        loader = importlib.machinery.SourceFileLoader("check", check)  # it has no ending
        module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check", loader))
        loader.exec_module(module)
        self.main = module.main
        shutil.rmtree(scratch, ignore_errors=True)
        for folder in ("doc/deep", "tests", "bin"):
            os.makedirs(os.path.join(scratch, folder))
        self.program = os.path.join(scratch, "bin", "myolines")
        self.put("tests/print_table.py", COMMAND.format(program=self.program), 0o755)
        self.put("tests/fails.py", "#!/usr/bin/env python3\nraise SystemExit('no such scene')\n", 0o755)
        self.put("tests/not_executable.py", "", 0o644)
        self.put("bin/myolines", PROGRAM, 0o755)

    def put(self, name, text, mode=0o644):
        path = os.path.join(self.root, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, mode)

    def page(self):
        with open(os.path.join(self.root, "doc/deep/page.md"), encoding="utf-8") as file:
            return file.read()

    def run(self, text, *options):
        """Exit code and all that is said of a page."""
        self.put("doc/deep/page.md", text)
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = self.main(["--root", self.root, "--program", self.program, *options])
        return code, said.getvalue()

    def exit_code(self, text):
        """Of the program itself."""
        self.put("doc/deep/page.md", text)
        return subprocess.run([self.check, "--root", self.root, "--program", self.program], capture_output=True, check=False).returncode


def page(table=TABLE, long=TABLE):
    return PAGE.format(table=table, long=long)


def changed(old, new, text=None):
    text = page() if text is None else text
    assert old in text, old
    return text.replace(old, new, 1)


CLUSTER = "made: 2026-01-31, commit abc1234, load 0.5, on a cluster\n"


def needing(table=TABLE, made=CLUSTER):
    """The page, on which the second block needs something instead of being long."""
    return changed(CLUSTER, made, changed("long: an hour", "needs: another program", page(long=table)))


RIGHT = (
    ("as printed", page(), []),
    ("within the digits", page(TABLE.replace("1.23e-4", "1.3e-4").replace("-0.056", "-5.5e-2")), []),
    ("other seconds", page(TABLE.replace("0.5", "99.5")), []),
    ("a long block, which is not run", page(long=TABLE.replace("1.23e-4", "9e-4")), []),
    ("a long block, run", page(), ["--all"]),
    ("a block that needs something, which is not run", needing(TABLE.replace("1.23e-4", "9e-4")), ["--all"]),
    ("a block that needs something, run", needing(), ["exact"]),
)

# (what, page, options, line of the page, part of the complaint)
DIFFERENT = (
    ("a wrong number", page(TABLE.replace("1.23e-4", "1.4e-4")), [], 17, '"1.4e-4" is printed, the command has "1.23e-4"'),
    ("a wrong sign", page(TABLE.replace("-0.056", "0.056")), [], 18, 'error: "0.056" is printed'),
    ("a stale count", page(TABLE.replace("| 10 |", "| 11 |")), [], 17, 'steps: "11" is printed, the command has "10"'),
    ("a stale count in a long cell", page(TABLE.replace("44", "45")), [], 18, '"20 + 1, 45" is printed'),
    ("another word", page(TABLE.replace("one", "three")), [], 17, 'method: "three" is printed'),
    ("another number in words", page(TABLE.replace("two of 3", "two of 4")), [], 18, '"two of 4" is printed'),
    ("a row too few", page(TABLE.replace("| one | 10 | 1.23e-4 | 0.5 |\n", "")), [], 15, "3 lines are printed, the command has 4"),
    ("a column too few", page(TABLE.replace(" 10 |", "")), [], 17, "is printed, the command has"),
    ("another head", page(TABLE.replace("CPU [s]", "wall [s]")), [], 15, 'wall [s]: "wall [s]" is printed'),
    ("a number without digits", page(long=TABLE.replace("1.23e-4", "1.24e-4")), ["exact"], 29, 'error: "1.24e-4" is printed'),
    ("all blocks", page(long=TABLE.replace("20 + 1", "21 + 1")), ["--all"], 30, "21 + 1"),
    ("a block that needs something", needing(TABLE.replace("20 + 1", "21 + 1")), ["exact"], 30, "21 + 1"),
    ("a command that fails", changed("print_table.py build/release/myolines 'a word'", "fails.py"), [], 9, "no such scene"),
)

BROKEN = (
    ("no end", changed("<!-- end of table -->\n", ""), 20, 'a block begins before "<!-- end of table -->"'),
    ("no end on the page", changed("<!-- end of exact -->\n", ""), 21, '"<!-- end of exact -->" is missing'),
    ("no beginning", changed("# A page", "<!-- end of table -->"), 1, "has not begun"),
    ("the end of another", changed("end of table", "end of exact"), 19, "has not begun"),
    ("an end without name", changed("<!-- end of table -->", "<!-- end -->"), 19, 'ends with "<!-- end of NAME -->"'),
    ("an unknown key", changed("digits: 2", "digit: 2"), 9, '"digit: 2" is not one of'),
    ("a key twice", changed("digits: 2", "digits: 2\ndigits: 3"), 9, '"digits" is there twice'),
    ("digits in words", changed("digits: 2", "digits: few"), 9, "is not a number"),
    ("no name", changed("name: table\n", ""), 9, 'no "name: ..."'),
    ("a name twice", changed("name: exact", "name: table", changed("end of exact", "end of table")), 21, "the name table is there 2 times"),
    ("no command", changed("<!-- made by tests/print_table.py\n", "<!-- made\n"), 21, 'begins with "<!-- made by COMMAND"'),
    ("a quotation that does not end", changed("'a word'", "'a word"), 9, "quotation"),
    ("a program that is not there", changed("tests/print_table.py build", "tests/nothing.py build"), 9, "tests/nothing.py is neither"),
    ("a file that is no program", changed("tests/print_table.py build", "tests/not_executable.py build"), 9, "is neither"),
    ("a program from elsewhere", changed("tests/print_table.py build", "/bin/echo build"), 9, "/bin/echo is neither"),
    ("a shell", changed("'a word'", "| sort"), 9, "without a shell"),
    ("no date of seconds", changed("made: 2026-01-31, commit abc1234, load 0.5\n", ""), 9, 'has no "made:'),
    ("no date where something is needed", changed("not compared: [s]\n", "", needing(made="")), 21, 'has no "made:'),
    ("a date of another form", changed("commit abc1234, load 0.5\n", "some day\n"), 9, "is not of the form"),
)


def failures(pages):
    found = []

    def expect(what, held, said):
        if not held:
            found.append(f"{what}: {said}")

    for what, text, options in RIGHT:
        code, said = pages.run(text, *options)
        expect(what, code == 0, said)
    for what, text, options, line, complaint in DIFFERENT:
        code, said = pages.run(text, *options)
        expect(what, code == 1 and f"doc/deep/page.md:{line}: " in said and complaint in said, f"exit code {code}, {said}")
    for what, text, line, complaint in BROKEN:
        for options in (["--markers"], []):
            code, said = pages.run(text, *options)
            expect(what, code == 2 and f"doc/deep/page.md:{line}: " in said and complaint in said, f"exit code {code}, {said}")
    codes = [pages.exit_code(text) for text in (RIGHT[0][1], DIFFERENT[0][1], BROKEN[0][1])]
    expect("exit codes", codes == [0, 1, 2], codes)
    code, said = pages.run(page(), "no such block")
    expect("an unknown name", code == 2 and "there are exact, table" in said, said)

    today = r"made: \d{4}-\d\d-\d\d, commit fedcba9, load [\d.]+\n"
    code, said = pages.run(page("", TABLE + "\nstale"), "--write", "--all")
    mended = re.fullmatch(re.escape(page()).replace(re.escape("made: 2026-01-31, commit abc1234, load 0.5\n"), today, 1)
                          .replace(re.escape("made: 2026-01-31, commit abc1234, load 0.5, on a cluster\n"), today, 1), pages.page())
    expect("both mended", code == 0 and mended, said + pages.page())
    code, said = pages.run(page(TABLE.replace("44", "45"), TABLE.replace("44", "46")), "--write")
    expect("only what runs mended", code == 0 and "46" in pages.page() and "45" not in pages.page() and "a cluster" in pages.page(), pages.page())
    text = changed("print_table.py build/release/myolines 'a word'", "fails.py")
    code, said = pages.run(text, "--write")
    expect("nothing written by a command that fails", code == 1 and pages.page() == text, pages.page())
    return found


def main():
    root, scratch = (os.path.abspath(path) for path in sys.argv[1:])
    found = failures(Pages(os.path.join(root, "doc", "check"), scratch))
    for text in found:
        print(text)
    print(f"{len(RIGHT) + len(DIFFERENT) + 2 * len(BROKEN) + 5 - len(found)} cases as they should be, {len(found)} not")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
