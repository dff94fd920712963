# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies on bodies: glued joints, meshes that do not match, a shrink fit."""
import itertools
import math

from support.scenes import SHIPPED, beam, box, joint, load, stack, support
from support.tables import REACTION, in_space
from support.vectors import cross, dot, plus, scaled


def pairs(laws):
    for dim in (2, 3):
        half, whole = ((10, 5), (10, 10)) if dim == 2 else ((4, 3, 2), (4, 3, 4))
        two = laws.run(stack(dim, (half, half), (1.0, 1.0), .3, 100.0))
        one = laws.run(stack(dim, (whole,), (2.0,), .3, 0))
        laws.demand(f"{dim}D: the joint sticks", all(row["state"] == "stick" for row in two.rows if row["contact"] == "joint 1"))
        two.rows = [row for row in two.rows if row["contact"] == "bottom"]
        laws.same(f"{dim}D: two blocks glued by friction are one", one, two)

        # meshes that do not match, flat: the sums are exact, single values of node to face are not
        fine = ((10, 5), (7, 4), (9, 6)) if dim == 2 else ((4, 3, 2), (3, 4, 2), (4, 4, 2))
        worst = action = 0.0
        for mu in (.05, .2, .5, 1.0, 2.0):
            run = laws.run(stack(dim, fine, (1.0, .7, .9), .4, mu))
            last = run.increments[-1]
            size = max(abs(last[f"joint_1_f_{c}"]) for c in "xyz")
            worst = max([worst] + [row[f"balance_block_{i}"] for row in run.increments for i in range(3)])
            action = max([action] + [abs(last[f"joint_{j}_f_{c}"] + last[f"joint_{j}_master_f_{c}"]) / size
                                     for j in (1, 2) for c in "xyz"])
        laws.check(f"{dim}D: balance of each body of a stack", worst, 1e-10)
        laws.check(f"{dim}D: action is reaction", action, 1e-12)

        # uniform pressure through a joint, matching and not
        # nodal values of node to face swing where meshes do not match: figures of doc/contacts.md
        for name, upper, pairing, bound in (("matching", half, "mortar", 1e-12), ("matching", half, "node to face", 1e-12),
                                            ("not matching", fine[1], "mortar", 1e-10),
                                            ("not matching", fine[1], "node to face", (.145, .215)[dim - 2])):
            scene = stack(dim, (half, upper), (1.0, 1.0), 0, 0)
            roller = {"Support low": support((0, 2) if dim == 3 else 0, "normal", body="block 0"),
                      "Support high": support((0, 2) if dim == 3 else 0, "normal", body="block 1")}
            if dim == 3:
                for key in ("Support low", "Support high"):
                    roller[key]["Boundary ids"] = "0, 2"
            scene.pop("Support top")
            scene["Contact joint 1"]["Pairing"] = pairing
            run = laws.run({**scene, **roller, "Load top": load("pressure", "2", 3 if dim == 2 else 5, "block 1"),
                            "Time": {"End": 1, "Increments": 1}})
            for what, found in joint_errors(run, dim, 2.0).items():
                laws.check(f"{dim}D: {what} of a flat joint, {name} meshes, {pairing}", found, 1e-10)
            error = max(abs(row["r_n"] / share - 2) / 2 for row, share in joint_shares(run, dim, upper))
            laws.check(f"{dim}D: pressure in a flat joint, {name} meshes, {pairing}", error, bound)

    ring = laws.run(SHIPPED / "shrink-fit.prm", "-s", "Output/VTU=0")
    mean = sum(row["r_n"] for row in ring.rows if row["contact"] == "joint") / math.pi
    laws.check("shrink fit: mean pressure against Lame", abs(mean / .234375 - 1), 1e-3)
    rails(laws)
    slot(laws)
    seams(laws)
    seams_of_laws(laws)
    seams_of_prestress(laws)
    sliding_seams(laws)
    recesses(laws)
    borders(laws)
    half_tied(laws)


def borders(laws):
    """A block across the border of two masters, its nodes over it, too: areas and pressures are those of its faces on each."""
    for dim, kinematics in itertools.product((2, 3), ("small", "finite sliding")):
        across = (1,) * (dim - 2)
        rest, zeros = tuple(1.0 for _ in across) + (1.0,), tuple(0.0 for _ in across)
        flat = {"Young modulus": 1e4, "Poisson ratio": 0}
        scene = {"Dimension": dim, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 1},
                 "Body block": {**box((4, *across, 2), (2.0, *rest), (*zeros, 0.0, 0.0)), "Material": flat},
                 "Load press": load("pressure", "2*t", 2 * dim - 1, "block"),
                 "Support guide": support("0" if dim == 2 else "0, 2", "normal", body="block")}
        for name, x, length, cells in (("left", 0.0, 1.0, 2), ("right", 1.0, 1.0, 2)):
            scene[f"Body {name}"] = {**box((cells, *across, 2), (length, *rest), (x, *zeros, -1.0)), "Material": flat}
            scene[f"Support {name}"] = support(2 * dim - 2, ", ".join("xyz"[:dim]), body=name)
            scene[f"Contact on {name}"] = joint("block", 2 * dim - 2, name, 2 * dim - 1, Pairing="node to face", Kinematics=kinematics)
        run = laws.run(scene)
        sides = [[r for r in run.last() if r["contact"] == f"on {name}" and abs(r["gap"]) < .5] for name in ("left", "right")]
        what = f"{dim}D, {kinematics}: a block on two masters"
        laws.check(f"{what}: areas", max(abs(sum(r["area"] for r in rows) - 1) for rows in sides), 1e-9)
        laws.check("  forces", max(abs(sum(r["r_n"] for r in rows) - 2) for rows in sides), 1e-9)
        shared = [r for rows in sides for r in rows if abs(r["x"] - 1) < 1e-9]
        laws.check("  mean pressure over the border", abs(sum(r["r_n"] for r in shared) / sum(r["area"] for r in shared) - 2), 1e-3)


def half_tied(laws):
    """A block that is tied on one half and touches on the other is pressed evenly, at the seam, too."""
    for pairing in ("node to face", "mortar"):
        flat = {"Young modulus": 1e4, "Poisson ratio": 0}
        scene = {"Dimension": 2, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 1},
                 "Body block": {**box((4, 2), (2.0, 1.0), (0.0, 0.0), **{"Boundary ids": "10: y < 1e-9 && x < 1 ; 11: y < 1e-9 && x > 1"}),
                                "Material": flat},
                 "Body base": {**box((4, 2), (2.0, 1.0), (0.0, -1.0)), "Material": flat}, "Support base": support(2, "x, y", body="base"),
                 "Load press": load("pressure", "2*t", 3, "block"),
                 "Contact weld": joint("block", 10, "base", 3, Kind="tie", Pairing=pairing),
                 "Contact joint": joint("block", 11, "base", 3, Pairing=pairing)}
        rows = [row for row in laws.run(scene).last() if row["contact"] in ("weld", "joint") and row["area"] > 0 and row["r_n"] != 0]
        laws.check(f"half tied, {pairing}: pressures", max(abs(row["pressure"] - 2) for row in rows), 1e-9)
        laws.check("  areas", sum(row["area"] for row in rows) - 2, 1e-9)


def recesses(laws):
    """A block in a corner of its master: one contact of all its sides is as one for each side, and carries what presses it."""
    for dim, mu, kinematics in ((2, 0.0, "small"), (2, .2, "small"), (2, .2, "finite sliding"), (3, 0.0, "small"), (3, .2, "finite sliding")):
        axes = "xyz"[:dim]
        cells = (4,) * dim if dim == 2 else (2,) * dim
        block = box(cells, (1.0,) * dim)
        corner = {"Mesh": {"Generator": "hyper_L", "Arguments": "-1 : 1 : false", "Global refinements": 3 - dim + 1, "Boundary ids": " ; ".join(
            [f"{10 + i}: abs({axis}) < 1e-9 && " + " && ".join(f"{other} > 0" for other in axes if other != axis) for i, axis in enumerate(axes)]
            + [f"{20 + i}: {axis} < -.999" for i, axis in enumerate(axes)])}, "Material": dict(block["Material"])}
        walls = ", ".join(str(10 + i) for i in range(dim))
        entries = {"Pairing": "node to face", "Friction coefficient": mu, "Kinematics": kinematics}
        common = {"Dimension": dim, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 2}, "Body block": block, "Body corner": corner,
                  "Support ground": support(", ".join(str(20 + i) for i in range(dim)), ", ".join(axes), body="corner")}
        forces = (.003, .005, .004)[:dim]
        for i, force in enumerate(forces):
            push = " ; ".join(f"-{force}*t" if j == i else "0" for j in range(dim))
            common[f"Load {axes[i]}"] = load("traction", push, 2 * i + 1, "block")
        one = laws.run({**common, "Contact all": joint("block", ", ".join(str(2 * i) for i in range(dim)), "corner", walls, **entries)})
        two = laws.run({**common, **{f"Contact {axis}": joint("block", 2 * i, "corner", walls, **entries) for i, axis in enumerate(axes)}})
        for run in (one, two):
            run.nodes = {}
            for r in run.last():
                if not r["contact"].endswith("_master") and math.isfinite(r["gap"]) and abs(r["gap"]) < .5:
                    run.nodes[tuple(round(r[c], 6) for c in ("x", "y", "z")) + tuple(round(r[c]) for c in ("n_x", "n_y", "n_z"))] = r
        what = f"{dim}D, mu {mu}, {kinematics}: a block in a corner of its master"
        laws.demand(f"{what}: rows of one contact for each side", set(one.nodes) == set(two.nodes))
        laws.demand("  and its corner has them all", sum(at[:3] == (0, 0, 0) for at in one.nodes) == dim)
        largest = max(r["r_n"] for r in two.nodes.values())
        if not mu:  # friction at the corner leaves open which side carries what
            laws.check("  the same reactions", max(abs(one.nodes[at]["r_n"] - r["r_n"]) / largest for at, r in two.nodes.items()), 1e-9)
        laws.check("  the same areas", max(abs(one.nodes[at]["area"] - r["area"]) for at, r in two.nodes.items()), 1e-5)
        total = plus((0, 0, 0), *(in_space(r, dim, REACTION) for r in one.nodes.values()))
        laws.check("  forces of the walls", max(abs(total[i] - force) / force for i, force in enumerate(forces)), 1e-9)
        laws.check("  areas of the walls", abs(sum(r["area"] for r in one.nodes.values()) - dim), 1e-9)
        laws.demand("  no node goes into a wall", all(r["gap"] > -1e-9 for r in one.nodes.values()))


def seams_of_laws(laws):
    """A node that stands in a contact with a law and in one without obeys the one of the first: no mean of both is a law."""
    for pairing in ("node to face", "mortar"):
        for names in (("rough", "smooth"), ("smooth", "rough")):
            met = {"Body": "slave", "Master body": "master", "Master boundary ids": 3, "Pairing": pairing, "Kinematics": "small"}
            faces = {"rough": {"Boundary ids": 2, "Friction coefficient": .2}, "smooth": {"Boundary ids": 7, "Compliance": 1e-9}}
            run = laws.run({"Dimension": 2, "Body slave": box((8, 4), (2.0, 1.0), **{"Boundary ids": "7: y < 1e-6 && x > 1"}),
                            "Body master": box((12, 4), (3.0, 1.0), (-.5, -1.0)),
                            **{f"Contact {name}": {**met, **faces[name]} for name in names},
                            "Support top": support(3, "x, y", "0.02*max(t - 1, 0) ; -0.002*min(t, 1)", "slave"),
                            "Support ground": support(2, "x, y", body="master"), "Time": {"End": 2, "Increments": 4}, "Output": {"VTU": 0}})
            for name, mu in (("rough", .2), ("smooth", 0)):
                most = max(abs(row["r_t1"]) / row["r_n"] for row in run.rows if row["contact"] == name and row["r_n"] > 1e-9)
                laws.check(f"seam of {names[0]} and {names[1]}, {pairing}: friction of {name}", most, mu + 1e-9)


def seams_of_prestress(laws):
    """A prestress moves nothing, so that each node reacts with its own, which is the mean of both on a seam, whichever comes first."""
    forces = {"left": 3, "right": 1}
    for pairing, names in itertools.product(("node to face", "mortar"), (("left", "right"), ("right", "left"))):
        met = {"Body": "slave", "Master body": "master", "Master boundary ids": 3, "Pairing": pairing}
        ids = {"left": 2, "right": 7}
        run = laws.run({"Dimension": 2, "Body slave": box((4, 1), (4.0, 1.0), **{"Boundary ids": "7: y < 1e-6 && x > 2"}),
                        "Body master": box((4, 1), (4.0, 1.0), (0.0, -1.0)),
                        **{f"Contact {name}": {**met, "Boundary ids": ids[name], "Prestress": forces[name]} for name in names},
                        "Support top": support(3, "x, y", body="slave"), "Support ground": support(2, "x, y", body="master"),
                        "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}})
        laws.check(f"prestress on a seam, {pairing}, {names[0]} first",
                   max(abs(row["r_n"] - (2 if row["x"] == 2 else forces[row["contact"]])) for row in run.last()
                       if not row["contact"].endswith("_master")), 1e-10)


def sliding_seams(laws):
    """A sole in two contacts that slides over its master and its rim is one all the way."""
    for dim, pairing in itertools.product((2, 3), ("mortar", "node to face")):
        across = (1,) * (dim - 2)
        side = "y" if dim == 2 else "z"
        parts = [f"abs({side} - 1) < 1e-9 && x {sign} .5" for sign in "<>"]
        upper = box((6, *across, 2), (1.0, *(1.0 for _ in across), .5), (*(0.0 for _ in range(dim - 1)), 1.0))
        upper["Mesh"]["Boundary ids"] = f"7: {parts[0]} ; 8: {parts[1]}"
        upper["Material"] = {**upper.get("Material", {}), "Young modulus": 1e4}
        top, bottom = 2 * dim - 1, 2 * dim - 2
        lower = box((5, *across, 2), (1.3, *(1.0 for _ in across), 1.0))
        lower["Material"] = {**lower.get("Material", {}), "Young modulus": 1e4}
        common = {"Dimension": dim, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 4}, "Body upper": upper, "Body lower": lower,
                  "Support floor": support(bottom, ", ".join("xyz"[:dim]), body="lower"),
                  "Support drive": {**support(top, ", ".join("xyz"[:dim]), body="upper"),
                                    "Displacement": " ; ".join((".45*t", *("0" for _ in across), "-1e-4"))}}
        far = {"Pairing": pairing, "Friction coefficient": .3, "Kinematics": "finite sliding"}
        one = laws.run({**common, "Contact sole": joint("upper", "7, 8", "lower", top, **far)})
        two = laws.run({**common, "Contact left": joint("upper", 7, "lower", top, **far),
                        "Contact right": joint("upper", 8, "lower", top, **far)})
        for run in (one, two):
            run.nodes = {(r["increment"], r["x"], r["y"], r["z"]): r for r in run.rows if not r["contact"].endswith("_master")}
        what = f"{dim}D, {pairing}, a seam that slides"
        laws.demand(f"{what}: the same nodes", set(one.nodes) == set(two.nodes) and len(two.nodes) == len(
            [r for r in two.rows if not r["contact"].endswith("_master")]))
        for value, bound in (("r_n", 1e-5), ("r_t1", 1e-5), ("area", 1e-3), ("pressure", 1e-3)):
            largest = max(abs(r["r_n" if value == "r_t1" else value]) for r in one.nodes.values())
            laws.check(f"  {value} of one contact", max(abs(r[value] - two.nodes[at][value]) / largest for at, r in one.nodes.items()), bound)


def seams(laws):
    """The sole of a block that is cut in two, as faces from CAD are, is one: a node at the seam is held once."""
    for dim, pairing, x, mu in itertools.product((2, 3), ("mortar", "node to face"), (.75, 1.0), (0.0, .3)):
        across = (1,) * (dim - 2)
        side = "y" if dim == 2 else "z"
        parts = [f"abs({side} - 1) < 1e-9 && x {sign} {x}" for sign in "<>"]
        upper = box((8, *across, 2), (2.0, *(1.0 for _ in across), 1.0), (*(0.0 for _ in range(dim - 1)), 1.0))
        upper["Mesh"]["Boundary ids"] = f"7: {parts[0]} ; 8: {parts[1]}"
        top, bottom = 2 * dim - 1, 2 * dim - 2
        common = {"Dimension": dim, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 2}, "Body upper": upper,
                  "Body lower": box((3, *across, 2), (2.0, *(1.0 for _ in across), 1.0)),
                  "Support floor": support(bottom, ", ".join("xyz"[:dim]), body="lower"),
                  "Load press": load("traction", " ; ".join(("2*t" if mu else "0", *("0" for _ in across), "-10*t*(1 + .2*x)")),
                                     top, "upper")}
        if not mu:
            common["Support guide"] = support(0, "x", body="upper")
        if dim == 3:
            common["Support sides"] = support("2, 3", "y", body="upper")
        friction = {"Pairing": pairing, "Friction coefficient": mu}
        one = laws.run({**common, "Contact sole": joint("upper", "7, 8", "lower", top, **friction)})
        two = laws.run({**common, "Contact left": joint("upper", 7, "lower", top, **friction),
                        "Contact right": joint("upper", 8, "lower", top, **friction)})
        what = f"{dim}D, {pairing}, cut at {x}, mu {mu}"
        for run in (one, two):
            run.nodes = {(r["x"], r["y"], r["z"]): r for r in run.last() if not r["contact"].endswith("_master")}
        largest = max(r["r_n"] for r in one.nodes.values())
        laws.demand(f"{what}: the same nodes", set(one.nodes) == set(two.nodes))
        laws.check("  reactions of one contact", max(abs(r[c] - two.nodes[at][c]) / largest for at, r in one.nodes.items()
                                                     for c in ("r_n", "area") + ("r_t1",)), 1e-9)


def slot(laws):
    """A beam in the slot of one body, which meets it from below and from above: its rows are numbers, and it is held by the upper side."""
    frame = {"Kind": "frame", "Sections": "s", "Frame": {"Nodes": "1: 1, 1.5 : 1 ; 2: 2, 1.5 : 1", "Members": "1-2: s"},
             "Section s": {"Young modulus": 1000, "Area": .1, "Moment of inertia": .001}}
    slotted = {"Mesh": {"Generator": "cheese", "Arguments": "1, 1", "Global refinements": 2,
                        "Boundary ids": "7: (abs(y - 1) < 1e-6 || abs(y - 2) < 1e-6) && x > 1 && x < 2 ; 8: x < 1e-6"},
               "Material": {"Young modulus": 1000, "Poisson ratio": .3}}
    run = laws.run({"Dimension": 2, "Body ring": slotted, "Body beam": frame, "Output": {"VTU": 0},
                    "Contact c": {"Body": "ring", "Boundary ids": 7, "Master body": "beam", "Master boundary ids": 1, "Kinematics": "small"},
                    "Support ring": support(8, "x, y", body="ring"), "Support beam": support(1, "x, y", "0 ; 0.51*t", "beam")})
    end = run.increments[-1]
    laws.demand("a beam in a slot: it presses up", end["c_f_y"] > 0)
    laws.check("  action is reaction", abs(end["c_f_y"] + end["c_master_f_y"]) / end["c_f_y"], 1e-12)
    laws.check("  normals of its rows have length 1", max(abs(math.hypot(row["n_x"], row["n_y"]) - 1) for row in run.last()), 1e-12)


def rails(laws):
    """A block across two beams in space, whose nodes it does not meet: on them, or a little above."""
    for along, across, up in ("xyz", "yxz", "xzy", "zyx"):
        for height in (0.0, .005):
            def at(a, b, c):
                return tuple({along: a, across: b, up: c}[axis] for axis in "xyz")
            size, corner = (1.1, 1.0, .5), at(.55, 0.0, height)
            block = box(at(5, 4, 2), at(*size), corner)
            block["Mesh"]["Boundary ids"] = " ; ".join(f"{i}: {up} < {height} + 1e-9 && {side}" for i, side in (
                (7, f"{across} < 0.25"), (8, f"{across} > 0.75")))
            scene = {"Dimension": 3, "Body block": block, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 2},
                     "Load weight": load("body force", " ; ".join(at("0", "0", "-t")), body="block")}
            for i, place in ((7, 0.0), (8, 1.0)):
                name = f"rail {i}"
                scene |= {f"Body {name}": beam(at(0.0, place, 0.0), at(2.0, place, 0.0), 8, 1e6, .1),
                          f"Support {name} 1": support(1, "clamped", body=name), f"Support {name} 2": support(2, "clamped", body=name),
                          f"Contact {i}": {**joint("block", i, name, 0, Pairing="node to face", Reach=.01), "Friction coefficient": .5}}
            run = laws.run(scene)
            weight, totals = size[0] * size[1] * size[2], {}
            moment = 0.0
            for row in run.last():
                if not row["contact"].endswith("_master"):
                    force = in_space(row, 3, REACTION)["xyz".index(up)]
                    totals[row["contact"]] = totals.get(row["contact"], 0) + force
                    moment += force * (row[along] - corner["xyz".index(along)] - size[0] / 2)
            what = f"rails along {along}, {height:g} below"
            laws.check(f"{what}: half of the weight on each", max(abs(f - weight / 2) for f in totals.values()) / weight, 1e-9)
            laws.check("  and its moment", abs(moment) / weight, 1e-9)


def joint_errors(run, dim, pressure):
    """Forces of both sides of joint 1 against those of a uniform pressure, and the sum of their moments.

    The moment of one side alone is not known: rollers take what the swinging nodal forces leave."""
    area = 2.0 if dim == 2 else 1.5
    up = (0.0,) * (dim - 1) + (1.0,) + (0.0,) * (3 - dim)
    totals, moment = {}, (0, 0, 0)
    for contact in ("joint 1", "joint 1_master"):
        rows = [row for row in run.last() if row["contact"] == contact]
        forces = [in_space(row, dim, REACTION) for row in rows]
        totals[contact] = plus((0, 0, 0), *forces)
        moment = plus(moment, *(cross((row["x"], row["y"], row["z"]), f) for row, f in zip(rows, forces)))
    size = pressure * area
    return {"force on the body": math.dist(totals["joint 1"], scaled(size, up)) / size,
            "force on the master": math.dist(totals["joint 1_master"], scaled(-size, up)) / size,
            "moments of both sides": math.sqrt(dot(moment, moment)) / (2 * size)}


def joint_shares(run, dim, cells):
    """Rows of joint 1 with the nodes' shares of its area."""
    size = (2.0,) if dim == 2 else (1.5, 1.0)
    for row in run.rows:
        if row["contact"] == "joint 1":
            share = 1.0
            for c, length, n in zip("xy", size, cells):
                rim = min(row[c], length - row[c]) < 1e-9
                share *= length / n * (.5 if rim else 1)
            yield row, share
