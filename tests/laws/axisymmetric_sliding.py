# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of revolution that slide far along each other and along obstacles."""
import math

from laws.axisymmetric import POISSON, YOUNG, scene, section
from laws.sliding import FAR, energy_error, touching
from support.scenes import contact, joint, merge, support
from support.tables import MOTION, in_space

MU = .1


def lame(inner, middle, outer, interference):
    """Pressure between two tubes of one material, of which one is pressed on the other."""
    return interference / (middle / YOUNG * ((outer**2 + middle**2) / (outer**2 - middle**2) +
                                             (middle**2 + inner**2) / (middle**2 - inner**2)))


def axisymmetric_sliding(laws):
    fit_pushed_off(laws)
    pressed_along(laws)
    planes(laws)
    drawn_over_ball(laws)
    stretched_joint(laws)
    chamfers(laws)


CHAMFERS = """Point(1) = {0, 0, 0}; Point(2) = {9.5, 0, 0}; Point(3) = {10.02, 1.5, 0}; Point(4) = {10.02, 20, 0}; Point(5) = {0, 20, 0};
Point(11) = {10.5, -.5, 0}; Point(12) = {20, -.5, 0}; Point(13) = {20, -15, 0}; Point(14) = {10, -15, 0}; Point(15) = {10, -1.5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15}; Line(15) = {15, 11};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Curve Loop(2) = {11:15}; Plane Surface(2) = {2};
Physical Surface("shaft") = {1}; Physical Surface("hub") = {2}; Physical Curve("outside") = {2, 3}; Physical Curve("top") = {4};
Physical Curve("bore") = {14, 15}; Physical Curve("base") = {12}; Mesh.RecombineAll = 1; Mesh.MeshSizeMax = .8;
"""


def chamfers(laws):
    """A shaft with a chamfer is pushed into a bore with one, without friction: no edge holds it back, and its work is its energy."""
    (laws.folder / "chamfers.geo").write_text(CHAMFERS)

    def part(name):
        return {"Mesh": {"File": "chamfers.geo", "Group": name},
                "Material": {"Young modulus": 210e3, "Poisson ratio": .3, "Plane": "axisymmetric"}}
    pressure, rise = 157.5, .02  # Lame's of the fit, and its interference
    for slave, master in ((("shaft", "outside"), ("hub", "bore")), (("hub", "bore"), ("shaft", "outside"))):
        run = laws.run({"Dimension": 2, "Body shaft": part("shaft"), "Body hub": part("hub"),
                        "Contact fit": joint(*slave, *master, **{"Friction coefficient": 0, **FAR}),
                        "Support base": support("base", "y", body="hub"), "Support top": support("top", "y", "-t", "shaft"),
                        "Time": {"End": 12, "Increments": 48}, "Output": {"VTU": 0}})
        inside = [row for row in run.increments if row["time"] > 6]
        push = sum(abs(row["support_top_f_y"]) for row in inside) / len(inside)
        laws.check(f"{slave[0]} as slave: push over that of the energy", push / (pressure * rise * math.pi * 10) / 4, 1)
        work = sum(row["contact_work_normal"] for row in run.increments) / len(run.increments)
        laws.check("  work of contact over that of friction .1", abs(work) / (.1 * pressure * math.pi * 10 * 6**2), .02)


def fit_pushed_off(laws):
    """A hub shrunk on a sleeve of its length: its push-off force is mu p pi d L, where friction strains neither."""
    length, overlap, way, mu = 2.0, .0002, .002, .01
    pressure = lame(1.0, 2.0, 3.0, overlap)
    force = mu * pressure * 2 * math.pi * 2.0 * (length - way)
    runs = {}
    for pairing, backend, up in (("mortar", "condensed", 0.0), ("mortar", "iterative", 0.0), ("node to face", "condensed", 0.0),
                                 ("mortar", "condensed", 7.0)):
        ends = {name: {"Boundary ids": f"7: y < {up + 1e-6!r} && {side}"} for name, side in (("sleeve", "x < 1.8"), ("hub", "x > 2.2"))}
        run = laws.run({**scene(), "Body sleeve": section((6, 12), (1.0, length), (1.0, up), **ends["sleeve"]),
                        "Body hub": section((6, 14), (1.0, length), (2.0 - overlap, up), **ends["hub"]),
                        "Contact fit": joint("hub", 0, "sleeve", 1, **{"Friction coefficient": mu, **FAR, "Pairing": pairing}),
                        "Support ground": support(7, "y", body="sleeve"),
                        "Support pusher": support(7, "y", f"{way!r}*max(t - 1, 0)", "hub"),
                        "Time": {"Times": "1, 1.5, 2"}, "Solver": {"Backend": backend}})
        runs[pairing, backend, up] = run
        what = f"push-off force, {pairing}, {backend}, moved by {up:g}"
        last = run.increments[-1]
        laws.check(what, abs(last["support_pusher_f_y"] / force - 1), 3e-3)
        laws.check(f"{what}: both sides", abs(last["fit_f_y"] + last["fit_master_f_y"]) / force, 1e-12)
        laws.check("  radial forces of both sides", abs(last["fit_f_x"] / last["fit_master_f_x"] + 1), 1e-10)
        laws.check("  energies", energy_error(run), 1e-9)
        if pairing == "node to face":
            continue  # areas of all nodes, also of those beyond the sleeve
        rows = [row for row in run.last() if row["contact"] == "fit" and row["state"] != "open"]
        laws.check("  areas are those of the cylinder where the nodes are",
                   abs(sum(row["area"] for row in rows) / (2 * math.pi * 2.0 * (length - way)) - 1), 2e-4)
    forces = [run.increments[-1]["support_pusher_f_y"] for run in runs.values()]
    laws.check("both backends", abs(forces[1] / forces[0] - 1), 1e-8)
    laws.check("both pairings", abs(forces[2] / forces[0] - 1), 2e-3)
    laws.check("moved along the axis", abs(forces[3] / forces[0] - 1), 1e-9)


def pressed_along(laws):
    """A short hub slides along a long shaft by several cells: the shaft is the same everywhere."""
    overlap = .0005
    for pairing in ("mortar", "node to face"):
        run = laws.run({**scene(), "Body shaft": section((4, 40), (1.0, 10.0), (1.0, 0.0)),
                        "Body hub": section((4, 8), (1.0, 2.0), (2.0 - overlap, 3.0)),
                        "Contact fit": joint("hub", 0, "shaft", 1, **{"Friction coefficient": MU, **FAR, "Pairing": pairing}),
                        "Support ground": support(2, "y", body="shaft"),
                        "Support pusher": support(2, "y", "0.5*max(t - 1, 0)", "hub"),
                        "Time": {"End": 6, "Increments": 6}})
        forces = [row["support_pusher_f_y"] for row in run.increments if row["time"] > 2]
        pressures = [row["fit_f_x"] for row in run.increments if row["time"] > 2]
        laws.check(f"pressed along a shaft, {pairing}: force from place to place", max(forces) / min(forces) - 1, 2e-3)
        laws.check("  it is mu times that of the pressure", max(abs(f / (MU * p) - 1) for f, p in zip(forces, pressures)), 2e-4)
        way = [row for row in run.last() if row["contact"] == "fit"]
        laws.check("  it has slid by 10 cells", abs(max(abs(row["u_t1"]) for row in way) / 2.5 - 1), 1e-2)
        laws.check("  energies", energy_error(run), 1e-9)


def planes(laws):
    """A flat floor and a cone are planes in the section: small sliding is exact there."""
    disc = {**scene(), "Body block": section((10, 4), (2.0, 1.0), (1.0, 0.0)), "Obstacle floor": {"Shape": "half space", "Normal": (0, 1)},
            "Contact bottom": contact(mu=.2), "Support top": support(3, "y", "-0.02*min(t, 1)"),
            "Support rim": support(1, "x", "0.01*max(t - 1, 0)"), "Time": {"End": 4, "Increments": 4}}
    angle = math.radians(10)
    cone = {**scene(), "Body block": section((3, 12), (.5, 2.0), (2.0, 0.0), **{"Boundary ids": "7: y > 1.99 && x > 2.2"}),
            "Obstacle floor": {"Shape": "half space", "Normal": (math.cos(angle), math.sin(angle)), "Point": (2.0, 0.0),
                               "Displacement": "0 ; 0.05*t"},
            "Contact bottom": contact(ids=0, mu=.2), "Support top": support(7, "y"), "Time": {"End": 4, "Increments": 4}}
    for name, plane in (("floor", disc), ("cone", cone)):
        laws.same(f"round the axis, {name}", laws.run(plane), laws.run(merge(plane, {"Contact bottom": FAR})), 1e-9)


def drawn_over_ball(laws):
    """A thin ring is pushed over a rigid ball as large as its bore: it widens, and narrows behind the equator."""
    run = laws.run({**scene(), "Body ring": section((3, 6), (.1, .4), (.96, .5)),
                    "Obstacle ball": {"Shape": "sphere", "Center": (0, 0), "Radius": 1.0},
                    "Contact bore": contact("ring", 0, "ball", 0.0, **FAR),
                    "Support hold": {**support(7, "y", "-1.2*t", "ring")},
                    "Time": {"End": 1, "Increments": 24}}
                   | {"Body ring": merge(section((3, 6), (.1, .4), (.96, .5)), {"Mesh": {"Boundary ids": "7: x > 1.059 && y > 0.65 && y < 0.7"}})})
    rows = touching(run)
    off = [math.hypot(row["x"] + in_space(row, 2, MOTION)[0], row["y"] + in_space(row, 2, MOTION)[1]) - 1 for row in rows]
    laws.check(f"ring over a ball: {len(rows)} rows are on it", max(map(abs, off)), 1e-9)
    work = sum(row["external_work"] for row in run.increments)
    laws.check("ring over a ball: work without friction is what is stored, to the increments",
               abs(work - run.increments[-1]["strain_energy"]) / max(row["strain_energy"] for row in run.increments), .1)


def stretched_joint(laws):
    """A soft ring is stretched on a plate: its pressure passes where it is then, over the areas that it has then."""
    stretch, p = .05, 2.0
    for pairing in ("mortar", "node to face"):
        run = laws.run({**scene(), "Body plate": section((14, 2), (4.0, .5), (.5, -.5), young=1e6),
                        "Body ring": section((9, 2), (1.0, .5), (2.0, 0.0)),
                        "Contact joint": joint("ring", 2, "plate", 3, **{"Friction coefficient": 0, **FAR, "Pairing": pairing}),
                        "Support ground": support(2, "y", body="plate"),
                        "Support inside": support(0, "x", f"{2 * stretch!r}*t", "ring"),
                        "Load top": {"Body": "ring", "Boundary ids": 3, "Kind": "pressure", "Value": f"{p!r}"},
                        "Time": {"End": 1, "Increments": 4}})
        last = run.increments[-1]
        what = f"stretched ring, {pairing}"
        laws.check(f"{what}: the plate carries the load", abs(last["joint_f_y"] / -last["load_top_f_y"] - 1), 1e-10)
        laws.check(f"{what}: both sides", abs(last["joint_f_y"] + last["joint_master_f_y"]) / last["joint_f_y"], 1e-12)
        rows = [row for row in run.last() if row["contact"] == "joint"]
        ends = sorted((row["x"] + in_space(row, 2, MOTION)[0] for row in rows))
        if pairing == "mortar":
            area = math.pi * (ends[-1]**2 - ends[0]**2)
            laws.check(f"{what}: areas", abs(sum(row["area"] for row in rows) / area - 1), 1e-3)
