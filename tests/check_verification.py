#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the benchmarks of the verification manual, doc/site/verification.md, and compares them with published numbers.

usage: check_verification.py PROGRAM [--refresh] [CASE...]

--refresh writes the tables of the page anew.
"""
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from support.page_tables import Row, faults_of_rows, faults_of_table, number, percent, write
from support.result_sums import Tables
from support.tables import Events

TOP = Path(__file__).resolve().parent.parent
PAGE = TOP / "doc/site/verification.md"
sys.path.insert(0, str(TOP / "python"))


def mean_pressure(rows):
    return sum(rows["r_n"]) / sum(rows["area"])


def spread(rows, middle=None):
    """Half width of the ellipse of Hertz whose forces have the same second moment; its middle is known by symmetry."""
    middle = sum(rows["r_n"] * rows["x"]) / sum(rows["r_n"]) if middle is None else middle
    return 2 * math.sqrt(sum(rows["r_n"] * (rows["x"] - middle)**2) / sum(rows["r_n"]))


def stress(tables, body, place, component):
    """Of the node at a place, at the end."""
    increment = int(tables.increments["increment"][-1])
    mesh = tables.result.bodies(increment)[body]
    return mesh.arrays["stress"][((mesh.points - place)**2).sum(axis=1).argmin(), component]


def hertz_line(tables):
    half = math.sqrt(4 * 10 * 10 * (1 - .3**2) / (math.pi * 1000))
    rows = tables.rows("bottom")
    yield Row("largest pressure", 2 * 10 / (math.pi * half), max(rows["pressure"]), .02)
    yield Row("half width", half, spread(rows), .02)


def hertz_ball(tables):
    a, R, modulus = .5, 10, 1000 / (1 - .3**2)
    force = 4 / 3 * modulus * math.sqrt(R) * (a * a / R)**1.5
    yield Row("force under a way of 0.025", force, sum(tables.rows("bottom")["r_n"]), .04)


def nafems_1(tables):
    half = math.sqrt(4 * 35000 * 50 / (math.pi / ((1 - .3**2) / 210e3 + (1 - .3**2) / 70e3)))
    rows = tables.rows("line")
    yield Row("largest pressure [MPa]", 2 * 35000 / (math.pi * half), max(rows["pressure"]), .005)
    yield Row("half width [mm]", half, spread(rows, 0), .005)


def nafems_le1(tables):
    yield Row("stress yy at D [MPa]", 92.7, stress(tables, "membrane", (2, 0, 0), 4), .01)


def ssnv128(tables):
    rows = tables.rows("bottom")
    for x, published in ((0, 2.86e-5), (1.25, 2.72e-5), (5, 2.28e-5), (7.5, 1.98e-5), (11.25, 1.50e-5)):
        row = rows[abs(rows["x"] - x).argmin()]
        yield Row(f"displacement at x = {x:g} mm [m]", published, abs(row["u_t1"]) / 1000, .06)


def lame(tables):
    yield Row("pressure", .002 * 1000 / (2 * (13 / 5 + 5 / 3)), mean_pressure(tables.rows("joint")), 1e-3)


def along_axis(rows):
    """Force along y of the reactions of nodes."""
    return sum(rows["r_n"] * rows["n_y"] - rows["r_t1"] * rows["n_x"])


def vdi_2230(tables):
    young, shank, sleeves = 210e3, 25 * math.pi, (9**2 - 5.5**2) * math.pi
    k_b, k_c = young * shank / 50, young * sleeves / 40
    bolt = [abs(along_axis(tables.rows("seat of head", t))) for t in (1, 2)]
    yield Row("preload of a bolt that is too short by 0.04 mm [N]", .04 / (1 / k_b + 1 / k_c), bolt[0], .08)
    yield Row("share of the bolt in the pull", 38 / 40 * k_b / (k_b + k_c), (bolt[1] - bolt[0]) / 2000, .06)


def cattaneo(tables):
    modulus = 1000 / (2 * (1 - .3**2))
    force, shear = tables.value("joint_f_y"), abs(tables.value("joint_f_x"))
    half = math.sqrt(4 * force * 100 / (math.pi * modulus))
    rows = tables.rows("joint")
    yield Row("half width", half, spread(rows), .02)
    yield Row("largest pressure", 2 * force / (math.pi * half), max(rows["pressure"]), .02)
    stick = sum(row["area"] for row in rows if row["state"] == "stick") / 2
    yield Row("half width that sticks", half * math.sqrt(1 - shear / (.5 * force)), stick, .08)


def mindlin(tables):
    modulus, mu = 1000 / (2 * (1 - .3**2)), .5
    force, shear = tables.value("joint_f_y", 2), abs(tables.value("joint_f_x", 2))
    q = shear / (mu * force)
    cycle = 4 * (mu * force)**2 / (math.pi * modulus) * (
        q * ((1 - q) * (math.log(1 - q) - 1) - 1) + 1.5 + (1 - q)**2 * (math.log(1 - q) - 1.5))
    yield Row("energy of a cycle", cycle, sum(tables.increments["dissipation"][tables.increments["time"] > 2.001]), .03)


def limit_of(tables):
    return Events(tables.result.folder).parameter


def stays(x):
    """Displacement of a node at x of the discrete bar on its base, Popov and Lovtsov's Example 2, with 160 nodes."""
    length, q, mu, force, stiffness, h = 260, 3975, .3, 243750, 1.95e9 * .09361946107697598, 260 / 159
    end = length - force / (mu * q)
    last = max(i for i in range(160) if i * h <= end + h / 2) * h
    return mu * q / (2 * stiffness) * ((x - end)**2 - (last - end)**2) if x > last else 0


def popov_2(tables):
    rows = tables.rows("base")
    for x in (260, 130):
        row = rows[abs(rows["x"] - x).argmin()]
        yield Row(f"displacement at x = {row['x']:.4g} m [m]", stays(row["x"]), row["u_t1"] if row["n_y"] > 0 else -row["u_t1"], 1e-9)


def released(tables):
    """Loads at which nodes begin to slip, pulled and let go."""
    first = .3 * 3975 * 260 / 9 / 243750 * .5
    events = events_of(tables)
    yield Row("load over F at which the last node slips", first, events[0], 1e-9)
    yield Row("load over F at which it slips back", 1 - 2 * first, 2 - next(p for p in events if p > 1), 1e-9)


def events_of(tables):
    with (tables.result.folder / "events.csv").open() as stream:
        return [float(line.split(",")[1]) for line in list(stream)[1:-1]]


def tipping(tables):
    yield Row("push over weight at which it tips", 1 / .9, limit_of(tables), 1e-6)


def tipping_in_space(tables):
    yield Row("push over weight at which it tips", 1 / (.9 * math.cos(math.pi / 6)), limit_of(tables), 1e-5)


def sliding(tables):
    yield Row("push over weight at which it slides", .5, limit_of(tables), 1e-6)


def grid(*counts):
    def measure(tables):
        states = [str(state) for state in tables.rows("feet")["state"]]
        for state, count in zip(("stick", "slip", "open"), counts):
            yield Row(f"nodes that {state}" if state != "open" else "open nodes", count, states.count(state), 0)
    return measure


def worn_punch(tables):
    rows, modulus = tables.rows("joint"), 1000 / (2 * (1 - .3**2))
    force, stuck = tables.value("joint_f_y"), [abs(row["x"]) for row in rows if row["state"] == "stick"]
    edge = (max(stuck) + min(abs(row["x"]) for row in rows if row["state"] == "slip")) / 2
    convex = math.pi * modulus * edge**2 / (4 * 100)
    middle = rows[abs(rows["x"]).argmin()]
    yield Row("pressure in the centre, of the width that sticks", 2 * convex / (math.pi * edge) + (force - convex) / (math.pi * edge),
              middle["pressure"], .04)


def torque(tables):
    each = sum(.4 * row["r_n"] * math.hypot(row["x"], row["y"]) for side in ("upper", "lower") for row in tables.rows(side))
    yield Row("torque of an even pressure", .4 * 2400 * 77.8678, each, .01)


def gasket(tables):
    area, stiff, bolts, start = math.pi * (100**2 - 50**2), math.pi * (100**2 - 50**2) / .02, 106.1 * 4712, .5698
    pretension, share = start / (1 / bolts + 1 / stiff), bolts / (bolts + stiff)
    for t in (1, 21):
        pressed = (pretension - (1 - share) * .25 * (t - 1) * math.pi * 50**2) / area
        yield Row(f"mean pressure of the gasket at {.25 * (t - 1):g} MPa [MPa]", pressed, mean_pressure(tables.rows("gasket", t)), .02)


def fading(tables):
    for t, expected, state in ((1, 648, "cold"), (5, 324, "hot"), (6, 576, "hot, pressed twice as hard")):
        yield Row(f"friction of an even pressure, {state} [N]", expected, abs(tables.value("lining_f_x", t)), .035)


def mortar_joint(tables):
    yield Row("last force of the bed joint [N]", 15000, abs(tables.value("middle_high_f_x")), 1e-6)
    yield Row("work of its fracture [N mm]", 500 * 100 * .4 * .05 / 2, tables.value("middle_high_fracture"), 1e-3)


def coulomb(tables):
    yield Row("surcharge at which the wall slides [kPa]", 56.16, limit_of(tables), 1e-6)


def groove(tables):
    yield Row("push over weight at which it slides", .3 / math.sin(math.pi / 4), limit_of(tables), 1e-6)


def popov_1(tables):
    rows = sorted(tables.rows("supports"), key=lambda row: row["x"])
    yield Row("lift of the left support over P", .5, rows[0]["gap"], 1e-9)
    yield Row("force on the middle support over P", .5, rows[1]["r_n"], 1e-9)
    yield Row("force on the right support over P", .5, rows[2]["r_n"], 1e-9)


def wedge(tables):
    yield Row("force on the flank, pulled by 450", 450 / (.6 + .8 * .25), sum(tables.rows("flank", 4)["r_n"]), 1e-6)
    yield Row("force on the flank, let go to 180", 180 / (.6 - .8 * .25), sum(tables.rows("flank", 7)["r_n"]), 1e-6)


def johnson_ring(tables):
    rows = tables.rows("lid", 2)
    plane, f = 2 * (1 - .499**2) / math.pi, sum(rows["r_n"]) / (math.pi * 50 * 5 * 5)
    half = math.sqrt(plane * f)
    yield Row("squeeze under the force of the program", f * (plane * (2 * math.log(2 / half) - 1) + 4 * .499**2 / math.pi), .02, .005)
    yield Row("half width of contact [mm]", 5 * half, spread(rows), .01)


SCENES, HERE = "parameter-files", "doc/site"
CASES = {  # what the page calls it, scene, other values of entries, what is compared
    "hertz-line": ("Hertz, line: K. L. Johnson, Contact Mechanics, 1985, 4.2", f"{SCENES}/cylinder-on-plane.prm", {}, hertz_line),
    "hertz-ball": ("Hertz, ball: Johnson 4.2", f"{SCENES}/ball-on-plane.prm", {}, hertz_ball),
    "nafems-contact-1": ("NAFEMS, Konter 2006, benchmark 1 (Code_Aster SSNP154), without friction",
                         f"{HERE}/tutorials/hertz/hertz.prm", {}, nafems_1),
    "nafems-le1": ("NAFEMS LE1, elliptic membrane", f"{HERE}/verification/le1.prm", {}, nafems_le1),
    "ssnv128": ("Code_Aster SSNV128", f"{SCENES}/square-greco-ssnv128.prm", {}, ssnv128),
    "lame": ("Lamé, shrink fit of two rings", f"{SCENES}/shrink-fit.prm", {}, lame),
    "vdi-2230": ("VDI 2230, springs of bolt and sleeves", f"{SCENES}/bolt-joint.prm", {}, vdi_2230),
    "cattaneo": ("Cattaneo, partial slip: Johnson 7.2", f"{SCENES}/partial-slip.prm", {}, cattaneo),
    "mindlin": ("Mindlin and Deresiewicz, energy of a cycle", f"{SCENES}/fretting-loop.prm", {}, mindlin),
    "johnson-ring": ("Johnson 5.57, cylinder between plates, with the hoop of a ring", f"{SCENES}/o-ring.prm", {}, johnson_ring),
    "coulomb": ("Coulomb 1776, earth pressure", f"{SCENES}/retaining-wall.prm", {}, coulomb),
    "groove": ("Statics, block in a V groove", f"{SCENES}/block-in-groove.prm", {}, groove),
    "wedge": ("Statics, wedge with friction, pulled and let go", f"{SCENES}/dovetail.prm", {}, wedge),
    "block-slides": ("Statics, block that is pushed low", f"{SCENES}/pushed-block.prm", {}, sliding),
    "block-tips": ("the same, pushed high", f"{SCENES}/pushed-block.prm",
                   {"Load push/Point": "0, 0.9", "Contact bottom/Friction coefficient": "1.5"}, tipping),
    "block-tips-3d": ("the same in space, at 30 degrees to an edge", f"{SCENES}/pushed-block-3d.prm",
                      {"Load push/Point": "0, 0, 0.9", "Contact bottom/Friction coefficient": "1.5"}, tipping_in_space),
    "popov-1": ("Popov and Lovtsov 2023, Example 1", f"{SCENES}/beam-three-supports.prm", {}, popov_1),
    "popov-2": ("Popov and Lovtsov 2023, Example 2, 160 nodes", f"{SCENES}/bar-on-rigid-base.prm",
                {"Body bar/Frame/Arguments": "0, 0 : 260, 0 : 159"}, popov_2),
    "popov-2-released": ("the same with 10 nodes, pulled and let go", f"{SCENES}/bar-pull-release.prm", {}, released),
    "kanno-10": ("Kanno, Martins, Pinto da Costa 2004, Example 5.3, grid of 10 x 10", f"{SCENES}/double-layer-grid-10.prm", {},
                     grid(43, 52, 5)),
    "kanno-12": ("the same, grid of 12 x 12", f"{SCENES}/double-layer-grid-12.prm", {}, grid(78, 62, 4)),
    "goryacheva": ("Goryacheva, Rajeev, Farris 2001, contact worn by fretting", f"{SCENES}/fretting-wear.prm", {}, worn_punch),
    "disc-brake": ("Statics, torque of a disc brake", f"{SCENES}/disc-brake.prm", {}, torque),
    "brake-fade": ("Statics, friction that falls with temperature and pressure", f"{SCENES}/brake-fade.prm", {}, fading),
    "gasket": ("Springs of bolts and gasket under a rigid flange", f"{SCENES}/gasket-flange.prm", {}, gasket),
    "mortar-joint": ("Statics, bed joint of a pier that is pushed", f"{SCENES}/masonry-pier.prm", {}, mortar_joint)}
REFERENCES = {  # tables of an independent program, compared number by number
    "5.1": ("Kanno, Martins, Pinto da Costa 2004, Example 5.1", "square-greco"),
    "5.2": ("the same, Example 5.2, 23 increments", "inclined-obstacle"),
    "5.3-04": ("the same, Example 5.3, grid of 4 x 4", "double-layer-grid-04"),
    "5.3-07": ("the same, Example 5.3, grid of 7 x 7", "double-layer-grid-07"),
    "5.4": ("the same, Example 5.4", "double-layer-grid-unloading"),
    "sheet-pile": ("Popov and Lovtsov 2023, Example 3, 68 events", "sheet-pile")}


def command_of(scene, changes):
    return f"./conetact {scene}" + "".join(f' -s "{entry}={value}"' for entry, value in changes.items())


def lines_of_cases(found):
    lines = ["| source | quantity | published | Conetact | difference |", "|---|---|--:|--:|--:|"]
    for name, rows in found.items():
        title = f"[{CASES[name][0]}](#{name})"
        for row in rows:
            lines.append(f"| {title} | {row.quantity} | {number(row.expected)} | {number(row.found)} | {percent(row.error)} |")
            title = ""
    return lines


def run_case(name):
    import conetact
    _, scene, changes, measure = CASES[name]
    with tempfile.TemporaryDirectory() as folder:
        return list(measure(Tables(conetact.run(TOP / scene, changes, folder))))


def difference_of(example):
    """What compare_reference.py prints of a run."""
    import conetact
    with tempfile.TemporaryDirectory() as folder:
        conetact.run(TOP / f"{SCENES}/{REFERENCES[example][1]}.prm", folder=folder)
        return subprocess.run(["/usr/bin/python3", TOP / "tests/compare_reference.py", example, folder], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def lines_of_references(runs):
    lines = ["| source | largest difference, of the largest value of a column | commands |", "|---|---|---|"]
    for example, run in runs.items():
        title, scene = REFERENCES[example]
        errors = [float(word) for word in re.findall(r"error ([\d.e+-]+)", run.stdout)]
        lines.append(f"| {title} | below 1e{math.ceil(math.log10(max(errors)))}, {len(errors)} columns "
                     f"| `./conetact {SCENES}/{scene}.prm`, then "
                     f"`/usr/bin/python3 tests/compare_reference.py {example} output/{scene}` |")
    return lines


def lines_of_commands():
    lines = []
    for name, (title, scene, changes, _) in CASES.items():
        lines += [f"### {name}", "", f"{title}:", "", "```sh", command_of(scene, changes), "```", ""]
    return lines[:-1]


def main(program, *words):
    os.environ["CONETACT"] = str(Path(program).resolve())
    asked = [word for word in words if word != "--refresh"]
    found = {name: run_case(name) for name in asked or CASES}
    faults = [fault for name, rows in found.items() for fault in faults_of_rows(name, rows)]
    references = {} if asked else {example: difference_of(example) for example in REFERENCES}
    faults += [f"{example}: {run.stdout}" for example, run in references.items() if run.returncode]
    tables = {} if asked else {"cases": lines_of_cases(found), "references": lines_of_references(references)}
    if "--refresh" in words:
        for name, lines in {**tables, "commands": lines_of_commands()}.items():
            write(PAGE, name, lines)
    if not asked:
        faults += faults_of_table(PAGE, "cases", tables["cases"])
    print("\n".join(faults or lines_of_cases(found)))
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
