#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: reports work in a browser, from a file and without a network.

chromium.py PROGRAM SCENES FOLDER   runs a muscle and a study in FOLDER, makes their reports and tries them in a headless Chromium
chromium.py --open REPORT [PICTURE] tries one report that is there; a screenshot in PICTURE

Exit code 77 where there is no Chromium, or no packages with the scripts of reports.
"""

import os
import shutil
import subprocess
import sys

from browser import Browser

LIMIT = 6e6
PACKAGES = {"libjs-three": "/usr/share/javascript/three/three.min.js", "libjs-chart.js": "/usr/share/javascript/chart.js/chart.min.js"}

MUSCLE = ["system/geometry/refinement=1", "time/end=0.05", "time/step=0.025",
          "output/fields/what=displacement, stretch, pressure, tissue, fibre direction"]

EVIL = "</title></script><script>window.injected = 1</script><img src=x onerror='window.injected = 2'>"

problems = []


def require(right, what):
    print(("ok      " if right else "WRONG   ") + what, flush=True)
    if not right:
        problems.append(what)


PIXELS = """(() => { const c = report.view.canvas, g = c.getContext('webgl2') || c.getContext('webgl');
  const p = new Uint8Array(4 * c.width * c.height); g.readPixels(0, 0, c.width, c.height, g.RGBA, g.UNSIGNED_BYTE, p);
  let n = 0, h = 0; const colours = new Set();
  for (let i = 0; i < p.length; i += 4) if (p[i + 3] > 0) { ++n; h = (h * 31 + p[i] + 7 * p[i + 1] + 13 * p[i + 2] + i) % 1000000007;
    colours.add(p[i] >> 4 << 8 | p[i + 1] >> 4 << 4 | p[i + 2] >> 4); }
  return { part: n / (c.width * c.height), hash: h, colours: colours.size }; })()"""


def try_charts(browser, name):
    count = browser.ask("report.data.charts.length")
    require(count > 0, f"{name}: there are diagrams ({count})")
    browser.ask("document.querySelectorAll('details').forEach(d => d.open = true)")
    for figure in range(browser.ask("document.querySelectorAll('figure.chart').length")):
        browser.ask(f"document.querySelectorAll('figure.chart')[{figure}].scrollIntoView()")
        browser.becomes(f"document.querySelectorAll('figure.chart')[{figure}].querySelector('canvas') !== null")
    require(browser.ask("report.charts.filter(c => c).length") == count, f"{name}: all diagrams are drawn with the script")
    data = browser.ask("report.charts.map(c => c.data.datasets.reduce((n, d) => n + d.data.length, 0))")
    require(all(n > 0 for n in data), f"{name}: all of them have data ({sum(data)} points)")
    inked = browser.ask("""report.charts.map(c => { const p = c.canvas.getContext('2d').getImageData(0, 0, c.canvas.width, c.canvas.height).data;
      let n = 0; for (let i = 3; i < p.length; i += 4) n += p[i] > 0; return n; })""")
    require(all(n > 500 for n in inked), f"{name}: none of them is blank")
    box = browser.ask("""(() => { const c = report.charts[0], m = c.getDatasetMeta(0).data[0];
      c.canvas.scrollIntoView({ block: 'center' }); const b = c.canvas.getBoundingClientRect(); return [b.left + m.x, b.top + m.y]; })()""")
    browser.wait(0.2)
    browser.mouse("mouseMoved", *box)
    browser.wait(0.3)
    told = browser.ask("(report.charts[0].tooltip.opacity > 0 && report.charts[0].tooltip.body || []).flatMap(part => part.lines).join('; ')")
    curves = browser.ask("report.data.charts[0].curves.map(curve => curve.title)")
    require(any(told.startswith(curve + ": ") and told[len(curve) + 2:].strip("-")[:1].isdigit() for curve in curves),
            f"{name}: a point tells its curve and value ({told})")


def try_body(browser, name):
    require(browser.ask("report.view !== undefined"), f"{name}: there is a body to turn")
    if problems and "body to turn" in problems[-1]:
        return
    browser.ask("report.view.canvas.scrollIntoView({ block: 'center' })")
    browser.wait(0.3)
    first = browser.ask(PIXELS)
    require(first["part"] > 0.02 and first["colours"] > 8, f"{name}: it is not blank ({100 * first['part']:.0f} % of the canvas, {first['colours']} colours)")
    browser.ask("report.view.canvas.focus()")
    browser.key("ArrowRight")
    turned = browser.ask(PIXELS)
    require(turned["hash"] != first["hash"] and turned["part"] > 0.02, f"{name}: an arrow key turns it")
    browser.key("Home")
    require(browser.ask(PIXELS)["hash"] == first["hash"], f"{name}: Home turns it back")
    x, y = browser.ask("(() => { const b = report.view.canvas.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]; })()")
    browser.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
    browser.mouse("mouseMoved", x + 60, y + 10, button="left", buttons=1)
    browser.mouse("mouseReleased", x + 60, y + 10, button="left", clickCount=1)
    require(browser.ask(PIXELS)["hash"] != first["hash"], f"{name}: the mouse turns it")
    browser.key("Home")
    browser.mouse("mouseMoved", x, y)
    browser.wait(0.2)
    require("=" in browser.ask("document.getElementById('pointed').textContent"), f"{name}: the body tells the value that is pointed at: "
            + browser.ask("document.getElementById('pointed').textContent"))
    if browser.ask("report.data.body.times.length") > 1:
        browser.key("PageUp")
        require(browser.ask(PIXELS)["hash"] != first["hash"], f"{name}: another time looks otherwise")
        browser.key("PageDown")
    if browser.ask("report.data.body.fields.length") > 1:
        browser.ask("(() => { const c = document.getElementById('field'); c.value = 1; c.dispatchEvent(new Event('change')); })()")
        require(browser.ask(PIXELS)["hash"] != first["hash"], f"{name}: another field looks otherwise")


def try_page(browser, name):
    browser.viewport(380, 800, mobile=True)
    browser.becomes("document.documentElement.scrollWidth <= 380")  # diagrams follow the screen when they come to it
    wide = browser.ask("document.documentElement.scrollWidth")
    require(wide <= 380, f"{name}: a narrow screen holds it ({wide} px of 380)")
    browser.viewport(1200, 900)
    seen = []
    for scheme in ("light", "dark"):
        browser.scheme(scheme)
        browser.wait(0.3)
        seen.append(browser.ask("getComputedStyle(document.body).backgroundColor"))
    require(seen[0] == "rgb(255, 255, 255)" and seen[1] != seen[0], f"{name}: light and dark ({seen[0]}, {seen[1]})")
    browser.scheme("light")
    browser.ask("window.scrollTo(0, 0); document.activeElement.blur()")
    focused = set()
    for _ in range(12):
        browser.key("Tab")
        focused.add(browser.ask("[...document.querySelectorAll('*')].indexOf(document.activeElement)"))
    require(len(focused) > 6, f"{name}: Tab goes from control to control")
    copied = browser.ask("(() => { const b = [...document.querySelectorAll('button')].find(b => b.textContent === 'Copy table'); if (!b) return ''; "
                         "let got = ''; document.execCommand = () => { got = document.activeElement.value; return true; }; b.click(); return got; })()")
    require("\t" in copied and "\n" in copied, f"{name}: tables can be copied")


def try_report(program, path, body, screenshot=None, title=None):
    name = os.path.basename(os.path.dirname(path)) or path
    require(os.path.getsize(path) < LIMIT, f"{name}: {os.path.getsize(path) / 1e6:.1f} MB, below {LIMIT / 1e6:.0f}")
    browser = Browser(program)
    try:
        browser.open(path)
        if title:
            require(browser.ask("document.title") == title and browser.ask("window.injected === undefined"), f"{name}: markup in the title is text")
        if screenshot:
            browser.ask("(document.getElementById('body') || document.body).scrollIntoView()")
            browser.wait(0.5)
            browser.screenshot(screenshot)
        if body:
            try_body(browser, name)
        try_charts(browser, name)
        try_page(browser, name)
        require(not browser.problems, f"{name}: no error, and nothing asked of the network " + "; ".join(browser.problems[:5]))
    finally:
        browser.close()
    plain = Browser(program)  # without scripts
    try:
        plain.call("Emulation.setScriptExecutionDisabled", value=True)
        plain.open(path)
        root = plain.call("DOM.getDocument", depth=1)["root"]["nodeId"]
        images = plain.call("DOM.querySelectorAll", nodeId=root, selector="figure img")["nodeIds"]
        require(len(images) > 0, f"{name}: without scripts there are {len(images)} drawings")
    finally:
        plain.close()


def run(*words, cwd):
    done = subprocess.run(words, cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}\n{done.stdout}\n{done.stderr}")


def main(arguments):
    program = shutil.which("chromium")
    missing = [package for package, file in PACKAGES.items() if not os.path.exists(file)] + ([] if program else ["chromium"])
    if missing:
        print("skipped, without the packages " + ", ".join(missing))
        return 77
    if arguments[0] == "--open":
        try_report(program, arguments[1], "id=\"body\"" in open(arguments[1], encoding="utf-8").read(), *arguments[2:3])
    else:
        myolines, scenes, folder = (os.path.abspath(path) for path in arguments)
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        settings = [word for setting in MUSCLE for word in ("--set", setting)]
        run(myolines, "run", os.path.join(scenes, "isometric_block.xml"), "--quiet", "--out", "run", *settings, cwd=folder)
        run(myolines, "report", "run", cwd=folder)
        run(myolines, "run", os.path.join(scenes, "isometric_block.xml"), "--quiet", "--out", "surface", *settings, "--set",
            "output/fields/surface only=true", "--set", "title=" + EVIL, cwd=folder)
        run(myolines, "report", "surface", cwd=folder)
        run(myolines, "study", os.path.join(scenes, "studies/work_precision_oscillator.xml"), "--quiet", "--out", "study", cwd=folder)
        run(myolines, "report", "study", cwd=folder)
        try_report(program, os.path.join(folder, "run/report.html"), body=True)
        try_report(program, os.path.join(folder, "surface/report.html"), body=True, title=EVIL)
        try_report(program, os.path.join(folder, "study/report.html"), body=False)
    print(f"{len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
