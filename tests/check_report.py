#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reports of runs: pages that stand alone, in a browser too, where there is one.

usage: check_report.py PROGRAM CASE

  pages    reports in the plane, in space, of frames, of cells of second degree, without pictures, of runs that stopped
  browser  they are drawn, turn when they are dragged, have sections and films, and say nothing on the console
  parts    those of a flange, a pair of gears and a disc brake on a wide and a narrow screen, by size and colours; the
           pictures stay in the folder screenshots
"""
import html.parser
import json
import re
import resource
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
from support.browser import Browser, chromium  # noqa: E402
from support.checks import run_families  # noqa: E402
from support.gears import pair as gears  # noqa: E402
from support.scenes import merge, press_and_shear, pushed_block, simplices, stack, with_element  # noqa: E402

REPORT = TOP / "scripts" / "conetact-report"
GRID, FLOATING = (TOP / "parameter-files" / f"{name}.prm" for name in ("double-layer-grid-04", "floating-block"))
DRAWN = {"Output": {"VTU": 1}}
LIMIT = 40e6  # bytes of a page
LOOKED_AT = ("plane", "two bodies", "frame", "P2")
# Of what is coloured on the reports of parts, at least: teeth have high stresses only where they touch
GREEN = {"flange": .02, "brake": .03, "gears": .002}
EMPTY = {"meta", "link", "input", "br", "line", "path", "circle"}


class Page(html.parser.HTMLParser):
    """Whether what is opened is closed, what it would load, and the data of its view."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.loads, self.data, self.words = [], [], [], "", ""
        self.feed(text)
        self.faults += self.open

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.loads += [attributes[name] for name in ("src", "href", "data", "action") if name in attributes]
        if tag not in EMPTY:
            self.open.append((tag, attributes.get("id")))

    def handle_endtag(self, tag):
        if tag in EMPTY:
            return
        if not self.open or self.open[-1][0] != tag:
            self.faults.append(f"</{tag}> after {self.open[-1:]}")
        else:
            self.open.pop()

    def handle_data(self, text):
        if self.open and self.open[-1] == ("script", "data"):
            self.data += text
        elif self.open and self.open[-1][0] not in ("script", "style"):
            self.words += text


def report(folder, *arguments):
    return subprocess.run([REPORT, folder, *arguments], capture_output=True, text=True)


def page_of(laws, what, scene, code=0, *arguments):
    """Of a run that ends with this exit code; None where there is no report."""
    done, folder = laws.start(scene, *arguments)
    laws.demand(f"{what}: exit code {done.returncode} {done.stderr.strip()[-100:]}", done.returncode == code)
    file = laws.folder / f"{what}.html"
    made = report(folder, "-o", file)
    laws.demand(f"{what}: a report {made.stderr.strip()[-200:]}", made.returncode == 0 and file.exists())
    return file


def read(laws, what, file):
    text = file.read_text()
    page = Page(text)
    laws.demand(f"{what}: tags are closed {page.faults[:3]}", not page.faults)
    outside = [name for name in page.loads if not name.startswith(("data:", "#"))]
    laws.demand(f"{what}: nothing is loaded {outside}",
                not outside and not re.search(r"https?://|@import|url\(|import\s*\(", text))
    laws.demand(f"{what}: {len(text) / 1e6:.2g} MB", 5e3 < len(text) < LIMIT)
    return page


def demand_view(laws, what, page, **counts):
    """Its data: increments, bodies, fields with finite ranges."""
    data = json.loads(page.data)
    names = [field["name"] for field in data["fields"]]
    laws.demand(f"{what}: fields {', '.join(names)[:120]}", "displacement" in names and all(
        abs(field["low"]) < 1e300 and field["low"] <= field["high"] for field in data["fields"]))
    found = {"increments": len(data["increments"]), "bodies": len({shape["name"] for shape in data["shapes"]})}
    laws.demand(f"{what}: {found}", all(found[name] == n for name, n in counts.items()))


def bodies():
    """Scenes with what their views hold."""
    return {"plane": (merge(press_and_shear(2, increments=3), DRAWN), {"increments": 3, "bodies": 1}),
            "space": (merge(press_and_shear(3, increments=2), DRAWN), {"increments": 2, "bodies": 1}),
            "two bodies": (merge(stack(3, [(3, 2, 2), (2, 2, 2)], (1.0, 1.0), .3, .3), DRAWN), {"bodies": 2}),
            "frame": (GRID, {"increments": 1, "bodies": 1}),
            "Q2": (merge(with_element(press_and_shear(3, increments=2), "Q2"), DRAWN), {"increments": 2}),
            **{f"P2{where}": (merge(with_element(simplices_of(press_and_shear(dim, increments=2)), "P2"), DRAWN),
                              {"increments": 2}) for dim, where in ((3, ""), (2, " in the plane"))}}


def simplices_of(scene):
    return merge(scene, {"Body block": simplices(scene["Body block"])})


def pages(laws):
    for what, (scene, counts) in bodies().items():
        demand_view(laws, what, read(laws, what, page_of(laws, what, scene)), **counts)
    without = read(laws, "without pictures", page_of(laws, "without pictures", FLOATING, 0, "-s", "Output/VTU=0"))
    laws.demand("without pictures: a sentence says so", "There is no view" in without.words and not without.data)
    stopped_runs(laws)
    ways(laws)
    wrong_calls(laws)
    full_disk(laws)
    rounding(laws)


def rounding(laws):
    """What is rounding beside the size of the scene or its forces is 0, and columns of nothing else are left out."""
    sys.path.append(str(TOP / "python"))
    import numpy as np
    from conetact.report import tables
    from conetact.units import Units
    rows = np.array([(1, 1., 2e-3, 50., -1.366e-14, 1e3, 3e-10, 2e-10, 4e-12, 1e-13), (2, 2., 4e-3, 50., 1e-6, 2e3, 1e-10, 5e-9, 8e-12, 2e-13)],
                    dtype=[("increment", int), *((name, float) for name in (
                        "time", "largest_displacement", "largest_displacement_x", "largest_displacement_y", "loads_f_x", "loads_f_y",
                        "loads_m_z", "strain_energy", "residual"))])
    found = tables.rounded(rows, tables.scales_of(rows))
    laws.demand("a coordinate of rounding is 0, a small one is not", list(found["largest_displacement_y"]) == [0, 1e-6])
    laws.demand("forces and moments", not found["loads_f_y"].any() and not found["loads_m_z"].any() and list(found["loads_f_x"]) == [1e3, 2e3])
    laws.demand("energies and residuals have scales of their own", list(found["strain_energy"]) == [4e-12, 8e-12]
                and list(found["residual"]) == [1e-13, 2e-13] and rows["largest_displacement_y"][0] != 0)
    written = tables.resultants_table(found, Units("N, mm"))
    laws.demand("columns of rounding are left out", "loads_f_x [N]" in written and "loads_f_y" not in written)


def stopped_runs(laws):
    """One slides after five increments, one at once."""
    arguments = ("-s", "Load push/Value=0.4*t*t", "-s", "Time/End=2", "-s", "Time/Increments=8")
    stopped = read(laws, "stopped", page_of(laws, "stopped", FLOATING, 2, *arguments, "-s", "Output/VTU=1"))
    laws.demand("stopped: what was solved, and the sentence of the program",
                all(words in stopped.words for words in ("Stopped early", "5 of 8", "no equilibrium")))
    demand_view(laws, "stopped", stopped, increments=5)
    at_once = read(laws, "at once", page_of(laws, "at once", FLOATING, 2, "-s", "Load push/Value=9*t"))
    laws.demand("at once: no increment", "No increment is solved" in at_once.words)
    bare = read(laws, "at once, undeformed", page_of(laws, "at once, undeformed", FLOATING, 2, "-s", "Load push/Value=9*t", "-s", "Output/VTU=1"))
    demand_view(laws, "at once, undeformed", bare, increments=1, bodies=1)
    laws.demand("  it says so", "The bodies are undeformed" in bare.words and "There is no view" not in bare.words)


def ways(laws):
    """Events of a load path and meshes of an adaptive run are tables, row by row."""
    path = read(laws, "path", page_of(laws, "path", pushed_block(2, .6, .5)))
    laws.demand("path: events and its end", all(words in path.words for words in ("Events", "slip+", "rises", "limit load", "The path ends at p = 0.5")))
    adaptive = read(laws, "adaptive", page_of(laws, "adaptive", merge(press_and_shear(2, increments=1), {"Adaptive refinement": 1})))
    laws.demand("adaptive: a row for each mesh", all(words in adaptive.words for words in ("Meshes", "contact_nodes", "estimate")))


def wrong_calls(laws):
    no_place = [str(laws.folder / "1"), "-o", str(laws.folder / "none" / "x.html")]
    for words in (["nowhere"], [str(laws.folder)], no_place):
        done = subprocess.run([REPORT, *words], cwd=laws.folder, capture_output=True, text=True)
        laws.demand(f"one sentence: {done.stderr.strip()[-120:]}", done.returncode == 1 and
                    len(done.stderr.splitlines()) == 1 and "Traceback" not in done.stderr)
    laws.demand("nothing is written",
                not (laws.folder / "report.html").exists() and not list(laws.folder.glob("*.tmp")))


def full_disk(laws):
    """What is not whole does not stay."""
    folder, kept = laws.start(merge(press_and_shear(2, increments=1), DRAWN))[1], laws.folder / "full"
    kept.mkdir()

    def little_place():
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
    for script, file in (("conetact-report", "x.html"), ("picture.py", "x.png")):
        done = subprocess.run([REPORT.with_name(script), folder, "-o", kept / file], capture_output=True, text=True, preexec_fn=little_place)
        laws.demand(f"{script}: {done.stderr.strip()[-120:]}", done.returncode == 1 and "cannot be written" in done.stderr
                    and not list(kept.iterdir()))


def coloured(pixels):
    """The part that is neither grey nor nearly so."""
    return ((pixels.max(axis=2).astype(int) - pixels.min(axis=2)) > 40).mean()


def stage_of(browser):
    """The picture of the view alone."""
    left, top, right, bottom = browser.run("""(() => {
      document.getElementById("stage").scrollIntoView();
      const r = document.getElementById("stage").getBoundingClientRect();
      return [r.left, r.top, r.right, r.bottom].map(Math.round); })()""")
    browser.settle()
    return browser.picture()[max(top, 0):bottom, left:right], ((left + right) / 2, (top + bottom) / 2)


def choose(browser, name, value):
    """Moves a control as a hand does."""
    browser.run(f"""(() => {{ const e = document.getElementById("{name}");
      if (e.type === "checkbox") e.checked = {json.dumps(value)}; else e.value = {json.dumps(value)};
      e.dispatchEvent(new Event("input")); }})()""")
    return stage_of(browser)[0]


def changed(a, b):
    return (abs(a.astype(int) - b) > 12).any(axis=2).mean()


def look_at(laws, browser, what, file):
    browser.said.clear()
    browser.open(file)
    first, middle = stage_of(browser)
    laws.demand(f"{what}: {coloured(first):.1%} of the view is coloured", coloured(first) > .005)
    browser.drag(middle, (middle[0] + 90, middle[1] + 40))
    part = changed(first, stage_of(browser)[0])
    laws.demand(f"{what}: a drag changes {part:.1%}", part > .005)
    browser.run("""document.querySelector("#stage canvas").dispatchEvent(new Event("dblclick"))""")
    wide, inner = browser.run("[document.documentElement.scrollWidth, innerWidth]")
    laws.demand(f"{what}: {wide} of {inner} pixels wide", wide <= inner)


def use_controls(laws, browser, what):
    """Each of these changes what is seen."""
    n = browser.run("DATA.increments.length")
    for name, value in (("mesh", True), ("before", True), ("amplify", "200"), ("field", "0"), ("range", "now"),
                        *((("increment", "0"),) if n > 1 else ()), *((("cut", "0"), ("depth", "300"), ("flip", True))
                                                                     if browser.run("DATA.dimension") == 3 else ())):
        before = stage_of(browser)[0]
        part = changed(before, choose(browser, name, value))
        laws.demand(f"{what}: {name} = {value} changes {part:.2%}", part > 1e-4 or name == "range")
    browser.run("""document.getElementById("largest").click()""")
    laws.demand(f"{what}: {browser.run('document.getElementById(`told`).textContent')[:80]!r}",
                "displacement" in browser.run("document.getElementById('told').textContent"))


def browser(laws):
    if not chromium():
        print("skipped: chromium is not installed (Debian: chromium)")
        return
    files = {what: page_of(laws, what, scene) for what, (scene, _) in bodies().items() if what in LOOKED_AT}
    files["without pictures"] = page_of(laws, "without pictures", FLOATING, 0, "-s", "Output/VTU=0")
    for width in (1280, 400):
        seen = Browser(width, 900)
        try:
            for what in (files if width > 1000 else ("two bodies", "without pictures")):
                look_at_page(laws, seen, what, files[what], width)
        finally:
            seen.close()


def hues(pixels):
    """The part of the view in each of six hues from red on, of what is coloured."""
    import numpy as np
    from matplotlib.colors import rgb_to_hsv
    hsv = rgb_to_hsv(pixels.reshape(-1, 3) / 255)
    found = (hsv[:, 0][hsv[:, 1] * hsv[:, 2] > .15] * 6 + .5).astype(int) % 6
    return np.bincount(found, minlength=6) / max(len(found), 1)


def save(pixels, name):
    from matplotlib.image import imsave
    Path("screenshots").mkdir(exist_ok=True)
    imsave(f"screenshots/{name}.png", pixels)


def parts(laws):
    """Fields of stress reach from dark violet over blue to green at least; legends, curves and tables fit both screens."""
    if not chromium():
        print("skipped: chromium is not installed (Debian: chromium)")
        return
    tutorials = TOP / "doc" / "site" / "tutorials"
    scenes = {"flange": tutorials / "flange" / "flange.prm", "brake": tutorials / "brake" / "brake.prm", "gears": gears(laws.folder)}
    files = {what: page_of(laws, what, scene) for what, scene in scenes.items()}
    for width in (1280, 400):
        seen = Browser(width, 900)
        try:
            for what, file in files.items():
                look_at(laws, seen, f"{what}, {width}", file)
                seen.open(file)
                stage, _ = stage_of(seen)
                save(seen.picture(), f"report-{what}-{width}")
                violet_and_blue, green = hues(stage)[4:6].sum(), hues(stage)[2:4].sum()
                laws.demand(f"{what}, {width}: {coloured(stage):.1%} coloured, {violet_and_blue:.0%} of it violet and blue, {green:.1%} green",
                            coloured(stage) > .05 and violet_and_blue > .5 and green > GREEN[what])
                high, wide = stage.shape[:2]
                laws.demand(f"{what}, {width}: the view has {wide} x {high}", .6 * width < wide + (width > 1000) * 320 <= width + 320
                            and high > 200)
                laws.demand(f"{what}, {width}: {seen.run('document.querySelectorAll(`svg polyline, svg path`).length')} lines are drawn",
                            seen.run("document.querySelectorAll('svg polyline, svg path').length") >= 5)
                laws.demand(f"{what}, {width}: nothing on the console {seen.said[:2]}", not seen.said)
        finally:
            seen.close()


def look_at_page(laws, seen, what, file, width):
    if what == "without pictures":
        seen.said.clear()
        seen.open(file)
    else:
        look_at(laws, seen, f"{what}, {width}", file)
        if width > 1000 and what != "frame":
            use_controls(laws, seen, what)
    laws.demand(f"{what}, {width}: nothing on the console {seen.said[:2]}", not seen.said)


if __name__ == "__main__":
    sys.exit(run_families({"pages": pages, "browser": browser, "parts": parts}, *sys.argv[1:]))
