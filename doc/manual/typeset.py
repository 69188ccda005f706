# SPDX-License-Identifier: LGPL-2.1-or-later
"""Equations as SVG inside the pages, set by matplotlib: the site needs no script and no network, and the book the same files.

The TeX that matplotlib knows: https://matplotlib.org/stable/tutorials/text/mathtext.html. Rows of a displayed equation are separated by \\\\;
an ampersand has no meaning there.
"""

import base64
import functools
import glob
import html
import io
import os
import re

import matplotlib
from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser, math_to_image
from sphinx.errors import ExtensionError

matplotlib.rcParams.update({"mathtext.fontset": "stix", "svg.fonttype": "path", "svg.hashsalt": "myolines"})
SIZE = 11  # of letters, in points; an em of the page is as large


@functools.lru_cache(maxsize=None)
def image(tex, display):
    """The SVG of one row as data, and height and depth below the line of the text, in em."""
    text = re.sub(r"\\(ln|exp|det|tr|dev|max|min)\b(?!_)", r"\\mathrm{\1}\\,", tex)
    if display:
        text = text.replace(r"\frac", r"\dfrac")
    buffer = io.BytesIO()
    try:
        depth = math_to_image(f"${text}$", buffer, prop=FontProperties(size=SIZE), format="svg")
        height = MathTextParser("path").parse(f"${text}$", 72, FontProperties(size=SIZE))[1]
    except ValueError as error:
        raise ExtensionError(f"matplotlib cannot set ${tex}$: {error}") from error
    data = base64.b64encode(re.sub(rb"<metadata>.*?</metadata>", b"", buffer.getvalue(), flags=re.S)).decode()
    return data, height / SIZE, depth / SIZE


def img(tex, display):
    data, height, depth = image(" ".join(tex.split()), display)
    return (f'<img class="tex" alt="{html.escape(tex, quote=True)}" style="height: {height:.3f}em; vertical-align: {-depth:.3f}em" '
            f'src="data:image/svg+xml;base64,{data}"/>')


def inline(translator, node):
    translator.body.append(img(node.astext(), False))
    raise translator_skip()


def block(translator, node):
    rows = [row for row in re.split(r"\\\\", node.astext()) if row.strip()]
    translator.body.append('<div class="tex">' + "<br/>".join(img(row, True) for row in rows) + "</div>\n")
    raise translator_skip()


def translator_skip():
    from docutils import nodes
    return nodes.SkipNode()


def without_current_colour(svg):
    """A drawing of gnuplot for WeasyPrint, which does not know the colour currentColor: marks have a copy for every colour instead."""
    svg = re.sub(r"""(<g\b[^>]*\bcolor=(["'])([^"']*)\2[^>]*\bstroke=)(["'])currentColor\4""", r"\1\4\3\4", svg)
    marks = re.findall(r"^\s*<[^>]*\bid='gp\w+'[^>]*/>\n", svg, re.M)
    mark = re.compile(r"(<use xlink:href='#gp\w+)('[^>]*\bcolor=')([^']*)'")
    colours = sorted({match.group(3) for match in mark.finditer(svg)})
    copies = "".join(re.sub(r"((?:id='|#)gp\w+)'", rf"\1_{number}'", line).replace("currentColor", colour)
                     for number, colour in enumerate(colours) for line in marks)
    svg = mark.sub(lambda match: f"{match.group(1)}_{colours.index(match.group(3))}{match.group(2)}{match.group(3)}'", svg)
    return svg.replace(marks[0], copies + marks[0], 1).replace("currentColor", "black") if marks else svg


def with_widths(table):
    """A table whose columns share the sheet by their text, for WeasyPrint takes several pieces of code in a cell for one word. Nothing of a table is
    broken by letters unless a word has more of them than a column bears."""
    def texts(row):
        for cell in re.findall(r"<t[dh]\b.*?</t[dh]>", row, re.S):
            cell = re.sub(r"<svg\b.*?</svg>|<img\b[^>]*\btex\b[^>]*>", "formula.", cell, flags=re.S)
            cell = re.sub(r"<img\b[^>]*>", "picture, " * 6, cell)
            yield html.unescape(re.sub(r"<[^>]*>", "", cell)).strip()

    rows = [list(texts(row)) for row in re.findall(r"<tr\b.*?</tr>", table.group(0), re.S)]
    columns = list(zip(*rows))
    wide = len(columns) > 8
    room = 150 if wide else 112  # letters that a line of a sheet has, of the sizes in book.css
    least = [3 + 1.15 * min(26, max(len(word) for text in column for word in text.split() or [""])) for column in columns]
    wanted = [max(low, 3 + min(80, max(map(len, column)))) for low, column in zip(least, columns)]
    spare = max(0, room - sum(least))
    share = min(1, spare / max(1, sum(wanted) - sum(least)))
    widths = [low + share * (high - low) for low, high in zip(least, wanted)]
    group = "".join(f'<col style="width: {100 * width / sum(widths):.1f}%">' for width in widths)
    return (f'<table class="{table.group(1)}{" wide" if wide else ""}" style="width: {min(100, 100 * sum(widths) / room):.0f}%">'
            f"<colgroup>{group}</colgroup>{table.group(2)}")


def prepare_book(app, exception):
    if exception is None and app.builder.name == "singlehtml":
        book = os.path.join(app.outdir, "index.html")
        with open(book, encoding="utf-8") as file:
            page = file.read()
        with open(book, "w", encoding="utf-8") as file:
            file.write(re.sub(r'<table class="(docutils [^"]*)">(.*?</table>)', with_widths, page, flags=re.S))
        for path in glob.glob(os.path.join(app.outdir, "_images", "*.svg")):
            with open(path, encoding="utf-8") as file:
                svg = file.read()
            with open(path, "w", encoding="utf-8") as file:
                file.write(without_current_colour(svg))


def setup(app):
    app.connect("build-finished", prepare_book)
    app.add_html_math_renderer("matplotlib", (inline, None), (block, None))
    app.config.html_math_renderer = "matplotlib"
    return {"version": "1", "parallel_read_safe": True}
