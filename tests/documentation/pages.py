#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks at the language, the links, the paths and the commands of all pages: README.md, CONTRIBUTING.md and doc/**/*.md.

pages.py ROOT [--program MYOLINES] [--list]

- Words and turns of FORBIDDEN occur nowhere outside code; those of DEFINED only if the glossary defines them.
- Sentences of a page have at most 25 words on average, tables and code aside. --list prints the averages.
- Links lead to files that exist, and behind a # to a heading there.
- Paths in backticks that begin with a folder of the repository exist, and so do the headers of doc/interface.md.
- A page of doc/results says on top when and from which commit it was measured, and the table of doc/results/index.md has it. If it is about an experiment
  it begins with a picture: one stands before the second of its chapters.
- Files and names of the code do not have the word peer, which was Flexodeal, and comments none of the FORBIDDEN.
- Numbers in the table of doc/which_method.md stand on the pages that it names.
- With a program: commands and options that a page names are known to it.

Prints what is wrong, one line each; exit code 1 if there is anything.
"""

import argparse
import functools
import glob
import os
import re
import subprocess
import sys

# Turns of no language, private words, and what they are called in the field.
FORBIDDEN = {
    r"\bpeers?\b": "Flexodeal, or an independent program",
    r"\bdear(er|est)?\b": "expensive",
    r"\btold apart\b": "distinguished",
    r"\bthereof\b|\bhereby\b|\bwherein\b": "plain words",
    r"\bbefore our eyes\b": "in view",
    r"\bof one's own of\b": "own",
    r"\bwithout tax\b": "without overhead",
    r"\bNothing to tell\b": "nothing to report",
    r"\bfork in the road\b|\bforks in the road\b": "decision",
    r"\bof use to everyone\b": "useful",
    r"\bup to now\b": "so far",
    r"\bmake good for\b": "make up for",
    r"\bis of avail\b|\bhas a say\b": "matters",
    r"\bvery\b": "nothing, or a number",
    r"(?<!\")\bsimply\b|\bobviously\b|\bof course\b|\bjust\b(?! (after|before|met|meet|come))": "nothing",
    r"\be\.g\.|\bi\.e\.": "for example, that is",
}
# Private words of this project: terms of the glossary, or not used.
DEFINED = ["kink", "waist", "ledger", "lift", "land on", "slab", "overshoot", "ringing", "drift", "event", "restart", "case", "setting", "scene", "study", "profile",
           "room", "registry", "plug-in", "manifest", "checkpoint", "cut", "independent program", "errata N", "the thesis", "rank"]
AVERAGE = 25
FOLDERS = ("input", "integrators", "boundary", "outputs", "profiles", "source", "include", "tests", "examples", "doc", "cmake")
MEASURED = re.compile(r"^\*(Measured|Counted|Drawn) \d{4}-\d\d-\d\d[^*]*\bcommits? [0-9a-f]{7}\b[^*]*\b(commands?|tests)\b[^*]*\*$", re.M)
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


@functools.lru_cache(maxsize=None)
def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def without_code(text):
    """Prose: no comments, fences, indented blocks, formulas or code."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^(```+|~~~+).*?^\1", "", text, flags=re.S | re.M)
    text = re.sub(r"\$\$.*?\$\$", " Formula ", text, flags=re.S)
    text = re.sub(r"^    .*$", "", text, flags=re.M)
    text = re.sub(r"`[^`\n]*`", "Code", text)
    text = re.sub(r"\$[^$\n]+\$", "X", text)
    return re.sub(r"\]\([^)]*\)", "]", text)


def sentences(text):
    """Numbers of words of the sentences, without those of tables and headings."""
    counts, paragraph = [], []

    def close():
        for sentence in re.split(r"(?<=[.?!])[)\"*]*\s+", " ".join(paragraph)):
            words = re.findall(r"[A-Za-z][\w'-]*", sentence)
            if len(words) > 2:
                counts.append(len(words))
        paragraph.clear()

    for line in without_code(text).split("\n"):
        if not line.strip() or line.startswith(("|", "#")):
            close()
            continue
        if re.match(r"\s*([-*]|\d+\.)\s", line):
            close()
        paragraph.append(line.strip())
    close()
    return counts


def slug(heading):
    heading = re.sub(r"[`*$]", "", re.sub(r"\]\([^)]*\)", "", heading.strip())).replace("[", "").lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")


def anchors(path):
    return {slug(heading) for heading in re.findall(r"^#{1,6} +(.*)$", re.sub(r"^```.*?^```", "", read(path), flags=re.S | re.M), re.M)}


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def look_at_words(page, text, defined):
    found = []
    prose = without_code(text)
    for turn, instead in FORBIDDEN.items():
        for match in re.finditer(turn, prose, re.I):
            found.append(f'{page}: "{" ".join(prose[max(0, match.start() - 30):match.end() + 20].split())}": {match.group()}; say: {instead}')
    found += [f'doc/manual/glossary.md: "{word}" is not defined' for word in DEFINED if page == "doc/manual/glossary.md" and word not in defined]
    counts = sentences(text)
    if counts and sum(counts) / len(counts) > AVERAGE:
        found.append(f"{page}: {sum(counts) / len(counts):.1f} words in a sentence on average, at most {AVERAGE}")
    return found


def look_at_code(root):
    """Names of files and what stands in them, where readers of the code meet it."""
    files = [path for folder in FOLDERS for path in glob.glob(os.path.join(root, folder, "**/*"), recursive=True)]
    texts = {path: read(path) if path.endswith((".h", ".cc")) else "" for path in files}
    found = [f'{os.path.relpath(path, root)}: "peer"; say: Flexodeal' for path, text in texts.items()
             if re.search("peer", os.path.relpath(path, root) + text, re.I)]
    for path, text in texts.items():
        if not os.path.relpath(path, root).startswith("tests"):
            comments = "\n".join(re.findall(r"//(.*)", text))
            found += [f'{os.path.relpath(path, root)}: "{match.group()}" in a comment; say: {instead}'
                      for turn, instead in FORBIDDEN.items() for match in [re.search(turn, comments, re.I)] if match]
    return found


def look_at_links(root, page, text):
    found, folder = [], os.path.dirname(os.path.join(root, page))
    for match in re.finditer(r"\]\(([^)\s]+)\)", re.sub(r"^```.*?^```", lambda m: "\n" * m.group().count("\n"), text, flags=re.S | re.M)):
        target, _, anchor = match.group(1).partition("#")
        if target.startswith(("http:", "https:")):
            continue
        path = os.path.normpath(os.path.join(folder, target)) if target else os.path.join(root, page)
        if not os.path.exists(path):
            found.append(f"{page}:{line_of(text, match.start())}: there is no {target}")
        elif anchor and path.endswith(".md") and anchor not in anchors(path):
            found.append(f"{page}:{line_of(text, match.start())}: {target} has no heading #{anchor}")
    for match in re.finditer(r"`([\w./-]+)`", text):
        path = match.group(1)
        file_or_folder = "." in os.path.basename(path) or path.endswith("/")
        header = re.fullmatch(r"\w+/\w+\.h", path) and os.path.exists(os.path.join(root, "include/myolines", path))
        if file_or_folder and path.split("/")[0] in FOLDERS and "/" in path and not header and not glob.glob(os.path.join(root, path) + "*") and "my_" not in path:
            found.append(f"{page}:{line_of(text, match.start())}: there is no {path}")
        if page == "doc/interface.md" and re.fullmatch(r"\w+/\w+\.h", path) and not header:
            found.append(f"{page}:{line_of(text, match.start())}: there is no header {path}")
    return found


OF_THE_PROGRAM = ("attacks.md", "performance.md")  # pages of doc/results about no experiment


def look_at_results(root, page, text):
    name = os.path.basename(page)
    if os.path.dirname(page) != "doc/results" or name == "index.md":
        return []
    found = []
    if not MEASURED.search("\n".join(text.split("\n")[:8])):
        found.append(f"{page}: does not say on top when, from which commit and by which command it was measured")
    if name not in OF_THE_PROGRAM and "![" not in "\n## ".join(re.split(r"\n## ", text)[:2]):
        found.append(f"{page}: does not begin with a picture")
    if f"]({name})" not in read(os.path.join(root, "doc/results/index.md")):
        found.append(f"doc/results/index.md: has no row for {name}")
    return found


def look_at_numbers(root, page, text):
    """The table of doc/which_method.md: every number stands on the page that is named behind it."""
    found = []
    if page != "doc/which_method.md":
        return found
    for row in re.findall(r"^\|.*\|$", text, re.M):
        for claim, target in re.findall(r"([^()|]*)\(\[[^\]]*\]\(([^)#]+)[^)]*\)\)", row):
            source = read(os.path.join(root, "doc", target))
            for number in re.findall(r"(?<![\w.])\d[\d,]*(?:\.\d+)?(?:e-?\d+)?(?![\w])", claim):
                if not re.search(rf"(?<![\w.]){re.escape(number)}(?![\w.]*\d)", source):
                    found.append(f"{page}: {target} does not have the number {number} of \"{claim.strip()}\"")
    return found


def known_commands(program):
    """Options by command, as the program says."""
    pages = subprocess.run([program, "list", "commands", "--markdown"], check=True, capture_output=True, text=True).stdout
    return {heading: set(OPTION.findall(body)) | {"--help"} for heading, body in re.findall(r"^## (.*?)$(.*?)(?=^## |\Z)", pages, re.S | re.M)}


def look_at_commands(page, text, known):
    found = []
    for block in re.finditer(r"^```(?:sh|)\n(.*?)^```|`(myolines [^`\n]+)`", text, re.S | re.M):
        for line in (block.group(1) or block.group(2)).replace("\\\n", " ").split("\n"):
            match = re.search(r"(?:^|[ /;])(?:myolines|myolines\.sh) +((?:import )?[a-z]+)\b(.*)", line.split("  #")[0])
            if not match or "myolines.sh" in line and match.group(1) in ("test", "build", "package", "install", "manual"):
                continue
            if match.group(1) not in known:
                found.append(f"{page}:{line_of(text, block.start())}: there is no command {match.group(1)}")
                continue
            arguments = re.sub(r"\"[^\"]*\"|'[^']*'|\$\(.*?\)", "X", match.group(2)).split(" && ")[0].split(";")[0].split("|")[0]
            for option in set(OPTION.findall(arguments)) - known[match.group(1)]:
                found.append(f"{page}:{line_of(text, block.start())}: {match.group(1)} has no option {option}")
    return found


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("root")
    arguments.add_argument("--program")
    arguments.add_argument("--list", action="store_true")
    given = arguments.parse_args()
    pages = ["README.md", "CONTRIBUTING.md"] + sorted(glob.glob("doc/**/*.md", root_dir=given.root, recursive=True))
    glossary = read(os.path.join(given.root, "doc/manual/glossary.md"))
    defined = {word.strip() for entry in re.findall(r"^- \*\*(.*?)\*\*", glossary, re.M) for word in entry.split(",")}
    known = known_commands(given.program) if given.program else None
    found = look_at_code(given.root)
    for page in pages:
        text = read(os.path.join(given.root, page))
        if given.list:
            counts = sentences(text)
            print(f"{sum(counts) / max(1, len(counts)):5.1f} {max(counts, default=0):4d} {page}")
        found += look_at_words(page, text, defined) + look_at_links(given.root, page, text) + look_at_results(given.root, page, text) + look_at_numbers(given.root, page, text)
        if known:
            found += look_at_commands(page, text, known)
    for line in found:
        print(line)
    print(f"{len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
