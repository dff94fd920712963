# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contacts that the program finds by itself."""
import math
import re
import shutil

from support.logs import dry_run, log_of, work_of
from support.scenes import LISTS, beam, box, floor, lines, load, merge, simplices, support
from support.vectors import apply, rotation


def found(run_or_text):
    """Names that the log tells, each a set of two sides."""
    text = run_or_text if isinstance(run_or_text, str) else log_of(run_or_text)
    told = re.search(r"Contacts = automatic: \d+ pairs?: (.*)", text)
    return [frozenset(name.split()) for name in told[1].split(", ")] if told else []


def pairs(*names):
    return {frozenset(name.split()) for name in names}


def demand_pairs(laws, what, run_or_text, expected):
    names = found(run_or_text)
    laws.demand(f"{what}: {len(expected)} pairs" + ("" if set(names) == expected else f"; found {sorted(map(sorted, names))}"),
                set(names) == expected and len(names) == len(expected))


def wall(dim, bond, cut=lambda body: body):
    """Three courses of bricks, every other one moved by half a brick (bond .5), or none (0)."""
    scene = {"Dimension": dim, "Obstacle ground": floor(dim), "Contacts": "automatic",
             "Automatic contact": {"Friction coefficient": .6}, "Output": {"VTU": 0}}
    for course in range(3):
        for k in range(3):
            x, z = 2.0 * k + bond * 2 * (course % 2), float(course)
            cells = (3 + (k + course) % 2, 2) if dim == 2 else (3 + (k + course) % 2, 2, 2)
            origin = (x, z) if dim == 2 else (x, 0.0, z)
            name = f"b{course}{k}"
            scene[f"Body {name}"] = cut(box(cells, (2.0, 1.0) if dim == 2 else (2.0, 1.0, 1.0), origin))
            scene[f"Load {name}"] = load("body force", "0 ; -0.01*t" if dim == 2 else "0 ; 0 ; -0.01*t", body=name)
    return scene


def expected_of_wall(bond):
    names = [f"b0{k} ground" for k in range(3)]
    names += [f"b{course}{k} b{course}{k + 1}" for course in range(3) for k in range(2)]
    for course in (0, 1):
        for k in range(3):
            over = [k] if bond == 0 else [k, k - 1] if course == 0 else [k, k + 1]
            names += [f"b{course}{k} b{course + 1}{other}" for other in over if 0 <= other <= 2]
    return pairs(*names)


def walls(laws):
    """Neighbours that share a face are pairs, those that share an edge are none; weights reach the ground."""
    for dim in (2, 3):
        for bond in (0, .5):
            for what, scene in (("boxes", wall(dim, bond)), ("simplices", wall(dim, bond, simplices))):
                run = laws.run(scene)
                what = f"{dim}D, bond {bond}, {what}"
                demand_pairs(laws, what, run, expected_of_wall(bond))
                up = "y" if dim == 2 else "z"
                ground = sum(value for name, value in run.increments[-1].items()
                             if name.endswith(f"_ground_f_{up}"))
                laws.check("  weight of nine bricks", abs(ground - 9 * 2 * .01) / .18, 1e-10)


def written(laws):
    """What is written beside the results gives the same tables, and so does a turned scene."""
    scene = wall(2, .5)
    run = laws.run(scene)
    text = (run.folder / "contacts.prm").read_text()
    laws.demand("a subsection for each pair", text.count("subsection Contact ") == len(expected_of_wall(.5)))
    shutil.copy(run.folder / "contacts.prm", laws.folder / "contacts.prm")
    by_hand = merge(scene, {"Contacts": None, "Automatic contact": None})
    file = laws.folder / "by_hand.prm"
    head = {plural: ", ".join(key[len(kind) + 1:] for key in by_hand if key.startswith(kind + " "))
            for kind, plural in LISTS.items() if kind != "Contact"}
    file.write_text("include contacts.prm\n" + "\n".join(lines({**head, **by_hand})) + "\n")
    again = laws.run(file)
    laws.demand("reactions.csv is the same, byte for byte",
                (run.folder / "reactions.csv").read_bytes() == (again.folder / "reactions.csv").read_bytes())
    m = rotation((0, 0, 1), 37.3)
    turned = merge(scene, {"Obstacle ground": {"Normal": apply(m, (0, 1, 0))[:2]}})
    for name in list(turned):
        if name.startswith("Body"):
            turned[name] = merge(turned[name], {"Mesh": {"Rotation": 37.3}})
        if name.startswith("Load"):
            turned[name] = merge(turned[name], {"Value": " ; ".join(f"({c!r})*t" for c in apply(m, (0, -.01, 0))[:2])})
    other = laws.run(turned)
    demand_pairs(laws, "turned", other, set(found(run)))


def distances(laws):
    """A gap counts up to the largest one; an overlap as well; exceptions and contacts of their own do not."""
    for gap, largest, near in ((.2, None, False), (.1, None, True), (.2, .25, True), (.2, .15, False), (-.05, None, True),
                               (-.05, .001, True)):
        scene = {"Dimension": 2, "Body one": box((4, 2), (2.0, 1.0)), "Body two": box((4, 2), (2.0, 1.0), (.3, 1 + gap)),
                 "Support low": support(2, "x, y", body="one"),
                 "Support high": support(3, "x, y", f"0 ; {-gap - .01!r}*t", body="two"),
                 "Contacts": "automatic", "Automatic contact": {} if largest is None else {"Largest gap": largest}}
        demand_pairs(laws, f"gap {gap}, largest {largest}", dry_run(laws, scene), pairs("one two") if near else set())
    scene = {"Dimension": 2, "Body one": box((4, 2), (2.0, 1.0)), "Body two": box((4, 2), (2.0, 1.0), (.3, .6)),
             "Support low": support(2, "x, y", body="one"), "Support high": support(3, "x, y", body="two"),
             "Contacts": "automatic"}
    done, _ = laws.start(scene)
    laws.demand("bodies deep in each other are refused", done.returncode == 1 and "deep in body" in done.stderr)
    scene = {**wall(2, .5), "Support side": support(1, "x, y", body="b02")}
    expected = expected_of_wall(.5)
    for exceptions, gone in (("b00 : b01", ["b00 b01"]), ("ground : b01", ["b01 ground"]),
                             ("b00 : b01 ; b02", ["b00 b01", "b02 b01", "b02 ground", "b02 b11", "b02 b12"])):
        text = dry_run(laws, merge(scene, {"Automatic contact": {"Exceptions": exceptions}}))
        demand_pairs(laws, f"without {exceptions}", text, expected - pairs(*gone))
    own = merge(scene, {"Contacts": "own, automatic",
                        "Contact own": {"Body": "b00", "Boundary ids": 1, "Master body": "b01", "Master boundary ids": 0,
                                        "Kind": "tie"}})
    demand_pairs(laws, "beside one with a name", dry_run(laws, own), expected - pairs("b00 b01"))


def hidden(laws):
    """What stands between two bodies hides one from the other, however thin it is."""
    for dim in (2, 3):
        def size(height, dim=dim):
            return (2.0, height) if dim == 2 else (2.0, 1.0, height)

        def at(height, dim=dim):
            return (0.0, height) if dim == 2 else (0.0, 0.0, height)
        coarse, fine = ((4, 2), (40, 2)) if dim == 2 else ((4, 2, 2), (12, 6, 2))
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        scene = {"Dimension": dim, "Body low": box(coarse, size(1.0)), "Body gasket": box(fine, size(.05), at(1.0), young=1.0, poisson=0.0),
                 "Body high": box(coarse, size(1.0), at(1.05)), "Obstacle ground": floor(dim), "Contacts": "automatic",
                 "Automatic contact": {"Kind": "tie"}, "Support low": support(bottom, "", body="low"),
                 "Load press": load("pressure", .1, top, body="high"), "Output": {"VTU": 0}}
        run = laws.run(merge(scene, {"Automatic contact": {"Exceptions": "ground"}}))
        demand_pairs(laws, f"{dim}D, a gasket between", run, pairs("gasket low", "gasket high"))
        demand_pairs(laws, f"{dim}D, and on the ground", dry_run(laws, scene), pairs("gasket low", "gasket high", "low ground"))


def strangers(laws):
    """Bodies that are apart at the start and come into each other without a contact: refused, until they have one."""
    scene = {"Dimension": 2, "Body one": box((8, 4), (2.0, 1.0)), "Body two": box((6, 3), (2.0, 1.0), (.3, 1.3)),
             "Body three": box((4, 2), (2.0, 1.0), (.3, 2.3)),
             "Support low": support(2, "x, y", body="one"), "Support high": support(3, "x, y", "0 ; -0.4*t", body="three"),
             "Contacts": "automatic", "Time": {"End": 1, "Increments": 8}, "Output": {"VTU": 0}}
    done, folder = laws.start(scene)
    laws.demand("strangers come into each other", done.returncode == 2 and "and have no contact" in done.stderr
                and "'one'" in done.stderr and "Increment 7" in done.stderr)
    run = laws.run(merge(scene, {"Automatic contact": {"Largest gap": .3}}))
    laws.demand("with a contact they press", max(abs(value) for name, value in run.increments[-1].items() if name in ("two_one_f_y", "one_two_f_y")) > 1)
    ring = {"Mesh": {"Generator": "hyper_shell", "Arguments": "0, 0 : 1.3 : 2 : 48 : true"},
            "Material": {"Young modulus": 1000, "Poisson ratio": .3}}
    pin = {"Mesh": {"Generator": "hyper_ball", "Arguments": "0, 0 : 1 : false", "Global refinements": 3,
                    "Boundary ids": "9: abs(x) < 0.3 && y > 0"},
           "Material": {"Young modulus": 1000, "Poisson ratio": .3}}
    scene = {"Dimension": 2, "Body lug": ring, "Body pin": pin, "Support lug": support(1, "x, y", body="lug"),
             "Support pin": support(9, "x, y", "0 ; -0.5*t", body="pin"), "Contacts": "automatic",
             "Automatic contact": {"Largest gap": .01}, "Time": {"End": 1, "Increments": 10}, "Output": {"VTU": 0}}
    done, _ = laws.start(scene)
    laws.demand("a pin comes through its lug", done.returncode == 2 and "and have no contact" in done.stderr)
    turned = wall(2, .5)
    for angle in (7, 21, 56, 83):
        m = rotation((0, 0, 1), angle)
        scene = merge(turned, {"Obstacle ground": {"Normal": apply(m, (0, 1, 0))[:2]}, "Automatic contact": {"Largest gap": 0}})
        for name in list(scene):
            if name.startswith("Body"):
                scene[name] = merge(scene[name], {"Mesh": {"Rotation": angle}})
        demand_pairs(laws, f"a largest gap of 0, turned by {angle}", dry_run(laws, scene), expected_of_wall(.5))
    plate = {"Dimension": 2, "Body disc": merge(box((6, 3), (2.0, 1.0)), {"Material": {"Plane": "axisymmetric"}}),
             "Obstacle ground": floor(2), "Contacts": "automatic", "Load press": load("pressure", 1, 3, body="disc"), "Output": {"VTU": 0}}
    laws.demand("a body with its axis on the ground", (laws.run(plate).folder / "contacts.prm").read_text().count("Boundary ids = 2") == 1)


def frames(laws):
    """A block on a beam: the block is the slave, whichever stands first."""
    for names in (("bar", "block"), ("block", "bar")):
        bodies = {"bar": beam((0.0, 0.0), (4.0, 0.0), 8, 1e6, .2), "block": box((4, 2), (1.0, .5), (1.5, 0.0))}
        scene = {"Dimension": 2, **{f"Body {name}": bodies[name] for name in names}, "Contacts": "automatic",
                 "Support left": support(1, "x, y", body="bar"), "Support right": support(2, "y", body="bar"),
                 "Support side": support(0, "x", body="block"),
                 "Load press": load("traction", "0 ; -1*t", 3), "Output": {"VTU": 0}}
        run = laws.run(scene)
        laws.demand(f"{names}: the block meets the beam", "block_bar_f_y" in run.increments[-1])
        laws.check("  with all of its load", abs(run.increments[-1]["block_bar_f_y"] - 1), 1e-10)


def arch(laws):
    """Twelve stones on two abutments: thirteen contacts; a symmetric arch has half of its weight on each side."""
    n, inner, outer = 12, 2.0, 2.6
    scene = {"Dimension": 2, "Obstacle ground": floor(2), "Contacts": "automatic",
             "Automatic contact": {"Friction coefficient": .7}, "Output": {"VTU": 0}}
    names = [f"s{k}" for k in range(n)]
    for k, name in enumerate(names):
        corners = [(r * math.cos(math.pi * j / n), r * math.sin(math.pi * j / n))
                   for j, r in ((k, inner), (k, outer), (k + 1, inner), (k + 1, outer))]
        scene[f"Body {name}"] = {"Mesh": {"Generator": "general_cell",
                                          "Arguments": " ; ".join(f"{x!r}, {y!r}" for x, y in corners) + " : true",
                                          "Global refinements": 2},
                                 "Material": {"Young modulus": 1e6, "Poisson ratio": .2}}
        scene[f"Load {name}"] = load("body force", "0 ; -20*t", body=name)
    run = laws.run(scene)
    demand_pairs(laws, "arch", run, pairs(*(f"{a} {b}" for a, b in zip(names, names[1:])), "s0 ground", f"s{n - 1} ground"))
    area = n * .5 * (outer**2 - inner**2) * math.sin(math.pi / n)
    last = run.increments[-1]
    for side, sign in (("s0_ground", 1), (f"s{n - 1}_ground", -1)):
        laws.check(f"  {side}: half of the weight", abs(last[f"{side}_f_y"] / (10 * area) - 1), 1e-9)
        laws.demand("  thrust inwards", sign * last[f"{side}_f_x"] < 0)
    laws.check("  thrusts are opposite", abs(last["s0_ground_f_x"] + last[f"s{n - 1}_ground_f_x"]) / area, 1e-9)
    laws.demand("  all joints press", all(max(row["r_n"] for row in run.last() if row["contact"] == name) > 0
                                          for name in {row["contact"] for row in run.last()}))


PIN_IN_LUG = """SetFactory("OpenCASCADE");
Box(1) = {-20, -20, 0, 40, 40, 8};
Cylinder(2) = {0, 0, -1, 0, 0, 10, 10};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -4, 0, 0, 16, 10};
Physical Volume("lug") = {3};
Physical Volume("pin") = {4};
"""


def pin_in_lug(laws):
    """Faces of whole bodies meet where those of the bore alone do: nothing is seen through the lug, whose bent faces
    leave slivers between their outlines."""
    (laws.folder / "lug.geo").write_text(PIN_IN_LUG)
    steel = {"Young modulus": 210e3, "Poisson ratio": .3}

    def drawn(group, size, tags):
        return {"Mesh": {"File": "lug.geo", "Group": group, "Size": size, "Order": 2, "Boundary ids": tags}, "Material": steel}
    scene = {"Dimension": 3, "Body lug": drawn("lug", 5.0, "901: x > 19.99"),
             "Body pin": drawn("pin", 4.0, "901: z < -3.99 ; 902: z > 11.99"),
             "Support far": support(901, "x, y, z", body="lug"), "Support axis": support(901, "y, z", body="pin"),
             "Support side": support(902, "y", body="pin"),
             "Load pull": load("traction", "-10*t ; 0 ; 0", "901, 902", body="pin"), "Output": {"VTU": 0}}
    whole = laws.run({**scene, "Contacts": "automatic", "Automatic contact": {"Friction coefficient": .2}})
    on_bore = merge(scene, {"Body lug": drawn("lug", 5.0, "901: x > 19.99 ; 7: x^2 + y^2 < 101 && abs(z - 4) < 3.99"),
                            "Body pin": drawn("pin", 4.0, "901: z < -3.99 ; 902: z > 11.99 ; "
                                              "7: x^2 + y^2 > 70 && z > -3.9 && z < 11.9"),
                            "Contact joint": {"Body": "pin", "Boundary ids": 7, "Master body": "lug",
                                              "Master boundary ids": 7, "Friction coefficient": .2}})
    bore = laws.run(on_bore)
    first, second = ([row for row in run.last() if not row["contact"].endswith("_master")] for run in (whole, bore))
    laws.check("pin in lug: whole bodies, and bore alone",
               max(abs(a["r_n"] - b["r_n"]) for a, b in zip(first, second)) / bore.largest("r_n"), 1e-10)
    mean = bore.increments[-1]["joint_f_x"] / (2 * 10 * 8)
    laws.check("  largest pressure over that of a cosine", abs(max(row["pressure"] for row in first) / (4 / math.pi * mean) - 1), .25)
    masters = [row["pressure"] for row in whole.last() if row["contact"].endswith("_master")]
    slaves = [row["pressure"] for row in first]
    laws.demand("  pressures of masters are within those of slaves",
                min(slaves) - 1e-9 < min(masters) and .8 * max(slaves) < max(masters) < max(slaves))


FORK = """SetFactory("OpenCASCADE");
Box(1) = {-12, -30, 0, 24, 42, 8}; Cylinder(2) = {0, 0, -1, 0, 0, 10, 5.02};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-12, -12, 8.2, 24, 42, 8}; Cylinder(5) = {0, 0, 7, 0, 0, 11, 5.02};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };
Cylinder(7) = {0, 0, 0, 0, 0, 16.2, 5};
Physical Volume("lug") = {3}; Physical Volume("eye") = {6}; Physical Volume("pin") = {7};
Mesh.MeshSizeMax = 6; Mesh.MeshSizeFromCurvature = 14;
"""


def fork(laws):
    """A pin in the bores of two plates. Nodes of one bore look across it at the rim of the other one, 500 times as far away as the
    pin: the start, where near nodes stick, is no worse for them."""
    (laws.folder / "fork.geo").write_text(FORK)

    def drawn(group, tags, size=8, young=70e3, poisson=.33):
        return {"Mesh": {"File": "fork.geo", "Group": group, "Size": size, "Boundary ids": tags},
                "Material": {"Young modulus": young, "Poisson ratio": poisson}}
    run = laws.run({"Dimension": 3, "Contacts": "automatic", "Automatic contact": {"Friction coefficient": .15, "Largest gap": .25},
                    "Body lug": drawn("lug", "101: y < -29.99 ; 102: z < 1e-3"), "Body eye": drawn("eye", "103: y > 29.99 ; 104: z > 16.199"),
                    "Body pin": drawn("pin", "105: z < 1e-3 ; 106: z > 16.199", 6, 210e3, .3), "Support base": support(101, "x, y, z", body="lug"),
                    "Support low": support(102, "z", body="lug"), "Support eye": support(104, "z", body="eye"),
                    "Support pin": support(106, "z", body="pin"), "Load pull": load("force", "0 ; 2000 ; 0", 103, body="eye"),
                    "Output": {"VTU": 0}})
    end = run.increments[-1]
    laws.check("fork: the pin bears the force on either side", max(abs(end["pin_lug_f_y"] + 2000), abs(end["pin_eye_f_y"] - 2000)), 1e-6)
    steps = work_of(run)["linear solves of contact"]
    laws.demand(f"  {steps} linear solves, at most 100", steps <= 100)
    laws.demand("  no slower method is tried", "slower ones are tried" not in log_of(run))


def disc_in_a_bore(laws):
    """A quarter of a disc has a node in the centre of the bore, which is near to none of it."""
    run = laws.run({"Dimension": 2, "Contacts": "automatic", "Obstacle bore": {"Shape": "sphere", "Radius": 1.001, "Side": "inside"},
                    "Body disc": {"Mesh": {"Generator": "quarter_hyper_ball", "Arguments": "0, 0 : 1", "Global refinements": 2},
                                  "Material": {"Young modulus": 1000, "Poisson ratio": .3}},
                    "Support left": support(1, "x, y", body="disc"), "Output": {"VTU": 0}})
    demand_pairs(laws, "a disc in a bore", run, pairs("disc bore"))


def going_on(laws):
    """A run that is continued finds the same contacts, and may not change their law."""
    scene = merge(wall(2, .5), {"Time": {"End": 2, "Increments": 2}, "Output": {"Checkpoint": 1}})
    whole = laws.run(scene)
    half = laws.run(scene, "-s", "Time/End=1", "-s", "Time/Increments=1")
    rest = laws.run(scene, "--restart", half.folder)
    laws.same("continued", whole, rest, 1e-10)
    done, _ = laws.start(scene, "--restart", half.folder, "-s", "Automatic contact/Friction coefficient=.5")
    laws.demand("another coefficient is refused", done.returncode == 1 and "Automatic contact/Friction" in done.stderr)


def automatic(laws):
    walls(laws)
    written(laws)
    hidden(laws)
    strangers(laws)
    distances(laws)
    frames(laws)
    arch(laws)
    pin_in_lug(laws)
    fork(laws)
    disc_in_a_bore(laws)
    going_on(laws)
