# SPDX-License-Identifier: LGPL-2.1-or-later
"""How Sphinx makes site and book of the pages in doc/. doc/manual/build calls it."""

import fnmatch
import os
import re
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True  # the folder is the repository's
sys.path.insert(0, here)

project = "Myolines"
author = "The Myolines developers"
with open(os.path.join(here, "../../CMakeLists.txt"), encoding="utf-8") as file:
    release = version = re.search(r"project\(myolines VERSION (\S+)", file.read()).group(1)
language = "en"
smartquotes = False  # quotes are code more often than not, primes are derivatives

root_doc = "index"
source_suffix = {".md": "markdown"}
exclude_patterns = ["manual/_static"]
extensions = ["myst_parser", "typeset"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 4
nitpicky = True

html_theme = "alabaster"
html_title = "Myolines"
html_static_path = ["_static"]
html_css_files = ["site.css", ("book.css", {"media": "print"})]
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_theme_options = {
    "description": "a laboratory for muscle dynamics",
    "fixed_sidebar": True,
    "page_width": "1180px",
    "sidebar_width": "260px",
    "show_relbars": True,
    "sidebar_collapse": True,
}


def add_pages_of_no_list(app, docname, source):
    """A new page need not be named in index.md: those that no list there names stand behind the others."""
    if docname != root_doc:
        return
    lists = re.findall(r"^```\{toctree\}\n(.*?)^```", source[0], re.S | re.M)
    named = [line.strip() for text in lists for line in text.split("\n") if line.strip() and not line.startswith(":")]
    below = [page for page in app.env.found_docs if page.startswith("manual/reference/") and page != "manual/reference/index"]
    others = sorted(page for page in app.env.found_docs
                    if page not in [root_doc] + named + below and not any(fnmatch.fnmatch(page, name) for name in named))
    if others:
        source[0] += "\n```{toctree}\n:caption: More\n:maxdepth: 1\n\n" + "\n".join(others) + "\n```\n"


# What a reader meets first on any page leads to what it is.
NAMES = (r"[Tt]hesis", r"Flexodeal(?: Lite)?", r"errata \d+", r"independent program")


def say_who_is_meant(app, docname, source):
    """Of each of the NAMES the first one in the prose of a page is a link to the glossary."""
    if docname == root_doc or docname == "manual/glossary" or docname.startswith("manual/reference/"):
        return
    target = "../" * docname.count("/") + "manual/glossary.md#names"
    lines, fenced, commented = source[0].split("\n"), False, False
    for name in NAMES:
        for i, line in enumerate(lines):
            fenced ^= line.startswith("```")
            commented = (commented or line.startswith("<!--")) and "-->" not in line
            if fenced or commented or line.startswith(("#", "|", "    ", "```", "<!--", "!")) or re.search(r"`[^`]*$", re.sub(r"`[^`]*`", "", line)):
                continue
            code = [match.span() for match in re.finditer(r"`[^`]*`|\[[^\]]*\]\([^)]*\)|\[[^\]]*$|^[^\[]*\]\(|\*[^*]*\*|https?:\S+", line)]
            match = next((m for m in re.finditer(rf"\b{name}\b", line) if not any(a <= m.start() < b for a, b in code)), None)
            if match:
                lines[i] = line[:match.start()] + f"[{match.group()}]({target})" + line[match.end():]
                break
        fenced = commented = False
    source[0] = "\n".join(lines)


def say_how_it_was_made(app, docname, source):
    """Below a table that doc/check compares stands what makes it: in the source that is a comment. Tutorials have their commands above."""
    if not docname.startswith("manual/"):
        source[0] = re.sub(r"<!-- made by (.*?)\n(.*?)-->(.*?<!-- end of .*? -->)",
                           lambda match: f"{match.group(0)}\n\n*Made by* `{match.group(1)}`"
                           + "".join(f", {line[6:]}" for line in match.group(2).split("\n") if line.startswith("made: ")) + ".\n", source[0], flags=re.S)


def setup(app):
    app.connect("source-read", add_pages_of_no_list)
    app.connect("source-read", say_who_is_meant)
    app.connect("source-read", say_how_it_was_made)
