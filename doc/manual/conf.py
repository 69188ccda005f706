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


def setup(app):
    app.connect("source-read", add_pages_of_no_list)
