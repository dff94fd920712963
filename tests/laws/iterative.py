# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Both backends give the same tables; linear iterations are bounded on any mesh."""
import re

from support.scenes import (ELEMENTS, SHIPPED, beam, box, contact, floor, joint, load, merge, press_and_shear, simplices, stack, support,
                            with_element)

SHIPPED_SCENES = ("block-press-shear", "inclined-obstacle", "partial-slip", "shrink-fit", "sphere-on-layer")


def backend(name):
    return "-s", f"Solver/Backend={name}"


def compare(laws, what, scene, *arguments, bound=1e-8):
    condensed, iterative = (laws.run(scene, *backend(name), *arguments) for name in ("condensed", "iterative"))
    laws.same(what, condensed, iterative, bound)
    laws.demand(f"{what}: solved by the backend asked for", all(r["solver"] != "iterative" for r in condensed.increments)
                and all(r["solver"] in ("iterative", "linear") for r in iterative.increments))
    return iterative


def iterations(run):
    return int(re.search(r"(\d+) linear iterations", (run.folder / "log.txt").read_text())[1])


def obstacles(laws):
    """Bodies on obstacles, in the plane and in space."""
    for name in SHIPPED_SCENES:
        compare(laws, name, SHIPPED / f"{name}.prm", "-s", "Output/VTU=0")
    # slips that are short beside the forces still have their direction
    compare(laws, "plate", SHIPPED / "block-press-shear.prm", "-s", "Output/VTU=0",
            "-s", "Body block/Mesh/Arguments=40, 40, 2 : 0, 0, 0 : 4, 4, 0.2 : true")
    for dim in (2, 3):
        scene = press_and_shear(dim)
        for element in ELEMENTS:
            compare(laws, f"{dim}D, {element}", with_element(scene, element))
        compare(laws, f"{dim}D, without friction", merge(scene, {"Contact bottom": {"Friction coefficient": 0}}))
        compare(laws, f"{dim}D, much friction", merge(scene, {"Contact bottom": {"Friction coefficient": 2}}))
        compare(laws, f"{dim}D, nearly incompressible",
                with_element(merge(scene, {"Body block": {"Material": {"Poisson ratio": .49}}}), "Q1 B-bar"))
        compare(laws, f"{dim}D, foundation and loads", merge(scene, {
            "Support side": support(1, "x", Stiffness=300),
            "Load weight": load("body force", "0 ; -2" if dim == 2 else "0 ; 0 ; -2")}))
        compare(laws, f"{dim}D, opened again", merge(scene, {
            "Support top": {"Displacement": " ; ".join(["0.002*t"] + ["0"] * (dim - 2) + ["-0.01*sin(t)"])},
            "Time": {"End": 6, "Increments": 6}}))
    compare(laws, "anisotropic friction", merge(press_and_shear(3), {
        "Contact bottom": {"Second friction coefficient": .1, "Friction angle": 30}}))


def preconditioners(laws):
    """Trilinos' levels and those of the program lead to the same tables."""
    scenes = {"a block": press_and_shear(3, cells=(8, 8, 8)), "in the plane": press_and_shear(2, cells=(40, 20)),
              "tetrahedra": merge(press_and_shear(3, cells=(6, 6, 6)), {"Body block": simplices(box((6, 6, 6), (1.5, 1.0, 1.0)))}),
              "a ball on a layer": SHIPPED / "sphere-on-layer.prm", "stacked": stack(3, ((6, 4, 4), (5, 4, 3)), (1.0, .6), .4, .3)}
    for what, scene in scenes.items():
        own, ml = (laws.run(scene, *backend("iterative"), "-s", f"Solver/Preconditioner={kind}", "-s", "Output/VTU=0")
                   for kind in ("aggregation", "trilinos ml"))
        laws.same(f"trilinos ml, {what}", own, ml, 1e-8)
        laws.check("  its iterations over those of aggregation", iterations(ml) / iterations(own), 4)


def sizes(laws):
    """A bound on linear iterations of the same history that does not know the mesh."""
    for n in (8, 16):
        run = laws.run(press_and_shear(3, cells=(n, n, n)), *backend("iterative"))
        laws.check(f"linear iterations an increment, {n}^3", iterations(run) / len(run.increments), 45)


def pairs(laws):
    """Bodies on bodies, all of them held."""
    for dim in (2, 3):
        cells = ((6, 3), (9, 3)) if dim == 2 else ((3, 3, 2), (4, 4, 2))
        size = (2.0, 1.0) if dim == 2 else (1.0, 1.0, .7)
        low, high = (2, 3) if dim == 2 else (4, 5)
        top = (0.0,) * (dim - 1) + (size[-1],)
        every = "x, y" if dim == 2 else "x, y, z"
        moved = " ; ".join(["0.004*max(t - 1, 0)"] + ["0"] * (dim - 2) + ["-0.01*min(t, 1)"])
        for pairing in ("node to face", "mortar"):
            for young in (1000.0, 1e6):
                compare(laws, f"{dim}D, {pairing}, E {young:g}", {
                    "Dimension": dim, "Body lower": box(cells[0], size), "Body upper": box(cells[1], size, top, young=young),
                    "Contact joint": joint("upper", low, "lower", high,
                                           **{"Pairing": pairing, "Friction coefficient": .3}),
                    "Support ground": support(low, every, body="lower"),
                    "Support top": support(high, every, moved, body="upper"),
                    "Time": {"End": 4, "Increments": 4}, "Output": {"VTU": 0}})


def carried(laws):
    """A body that a support moves without touching anything: what strains it is rounding, and counts as nothing."""
    for way in ("0 ; 0 ; if(t > 1.5, -0.01, 0.02*t)", "0.02*sin(pi/2*t) ; 0 ; 0.001"):
        compare(laws, f"3D, a ram moved by {way}", {
            "Dimension": 3, "Body block": box((8, 8, 8), (1.0, 1.0, 1.0), young=100.0),
            "Body ram": box((4, 4, 4), (.5, .5, .5), (.25, .25, 1.0)),
            "Contact top": joint("block", 5, "ram", 4, **{"Friction coefficient": .3}),
            "Support ground": support(4, "x, y, z", body="block"),
            "Support grip": support(5, "x, y, z", way, body="ram"),
            "Load weight": load("body force", "0 ; 0 ; -0.5", body="block"),
            "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}})


def hard_slaves(laws):
    """Slaves that are hard on a soft master: masters that they hardly see are smoothed with them."""
    for dim, mu in ((2, .3), (3, 0.0), (3, .3)):
        low, high = (2, 3) if dim == 2 else (4, 5)
        below, above = ((41, 12), (30, 10)) if dim == 2 else ((10, 9, 4), (9, 8, 4))
        size = (2.0, 1.0) if dim == 2 else (1.0, 1.0, .5)
        top = (0.0,) * (dim - 1) + (size[-1],)
        every = "x, y, z"[:3 * dim - 2]
        moved = " ; ".join(["0.004*max(t - 1, 0)"] + ["0"] * (dim - 2) + ["-0.01*min(t, 1)"])
        for young in (1e5, 1e6):
            run = compare(laws, f"{dim}D, mu {mu:g}, a slave {young / 1e3:g} times as hard", {
                "Dimension": dim, "Body lower": box(below, size), "Body upper": box(above, size, top, young=young),
                "Contact joint": joint("upper", low, "lower", high, **{"Friction coefficient": mu}),
                "Support ground": support(low, every, body="lower"), "Support top": support(high, every, moved, body="upper"),
                "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}})
            solves = sum(row["iterations"] for row in run.increments)
            laws.demand(f"  {iterations(run)} linear iterations in {solves:g} steps", iterations(run) < 30 * solves)
    # fine meshes that do not match: what contacts carry is little beside the forces of moved supports
    run = compare(laws, "12^3 cells, a slave of 14^3 1000 times as hard", {
        "Dimension": 3, "Body lower": box((12, 12, 12), (1.0, 1.0, 1.0), young=1.0), "Body upper": box((14, 14, 14), (1.0, 1.0, 1.0), (0.0, 0.0, 1.0)),
        "Contact joint": joint("upper", 4, "lower", 5, **{"Friction coefficient": .3}),
        "Support ground": support(4, "x, y, z", body="lower"), "Support top": support(5, "x, y, z", moved, body="upper"),
        "Time": {"End": 3, "Increments": 6}, "Output": {"VTU": 0}})
    laws.check("  linear iterations", iterations(run), 800)


def floating(laws):
    """Bodies that friction alone holds, on a floor and on one another, at eight tenths of what it can."""
    # with flat cells slip begins node by node
    for cells in ((), ("-s", "Body block/Mesh/Arguments=40, 4 : 0, 0 : 2, 1 : true")):
        compare(laws, "floating-block", SHIPPED / "floating-block.prm", "-s", "Output/VTU=0", *cells)
    for dim in (2, 3):
        low, high = (2, 3) if dim == 2 else (4, 5)
        cells, size = ((10, 10), (1.0, 1.0)) if dim == 2 else ((5, 5, 5), (1.0, 1.0, 1.0))
        weight = {"Load weight": load("body force", " ; ".join(["0"] * (dim - 1) + ["-min(t, 1)"])),
                  "Load push": load("body force", " ; ".join(["0.08*max(t - 1, 0)"] + ["0"] * (dim - 1)))}
        for height in (0.0, -.01):
            point = (0.0,) * (dim - 1) + (height,)
            compare(laws, f"{dim}D, on a floor {-height:g} below", {
                "Dimension": dim, "Body block": box(cells, size), "Obstacle floor": floor(dim, Point=point),
                "Contact bottom": contact(ids=low, mu=.3), **weight, "Time": {"End": 4, "Increments": 4}, "Output": {"VTU": 0}})
        under = tuple(1.4 for _ in size[:-1]) + (.6,)
        corner = tuple(-.2 for _ in size[:-1]) + (-.6,)
        for pairing in ("node to face", "mortar"):
            for young in (1.0, 1e3, 1e6):
                compare(laws, f"{dim}D, on a block, {pairing}, E {young:g} on 1000", {
                    "Dimension": dim, "Body block": box(cells, size, young=young),
                    "Body base": box((7,) * (dim - 1) + (3,), under, corner),
                    "Contact joint": joint("block", low, "base", high, **{"Pairing": pairing, "Friction coefficient": .3,
                                                                           "Kinematics": "small"}),
                    "Support ground": support(low, "x, y, z"[:3 * dim - 2], body="base"), **weight,
                    "Time": {"End": 4, "Increments": 4}, "Output": {"VTU": 0}})


def pressed(laws):
    """Bodies that float, without friction: contacts alone hold them against what presses them on."""
    for dim in (2, 3):
        low, high = (2, 3) if dim == 2 else (4, 5)
        cells, size = ((6, 5), (1.3, 1.0)) if dim == 2 else ((4, 3, 3), (1.3, .8, 1.0))
        sides = "x, y"[:3 * dim - 5]
        for young in (1e3, 2.1e11):
            for gap in (0.0, .03):
                scene = {"Dimension": dim, "Body block": box(cells, size, young=young), "Output": {"VTU": 0},
                         "Obstacle floor": floor(dim, Point=(0.0,) * (dim - 1) + (-gap,)), "Contact bottom": contact(ids=low),
                         "Support side": support(0, sides), "Time": {"End": 2, "Increments": 2},
                         "Load press": load("traction", " ; ".join(["0"] * (dim - 1) + [f"{-young / 1e3!r}*t*(1 + x)"]), ids=high)}
                compare(laws, f"{dim}D, E {young:g}, pressed on a floor {gap:g} below", scene)
                compare(laws, "  held by springs aside", merge(scene, {"Support side": {"Stiffness": young / 10}}))
                # the lid presses, or comes near while the load presses
                lid = {"Shape": "half space", "Normal": (0,) * (dim - 1) + (-1,), "Point": (0.0,) * (dim - 1) + (size[-1] + gap / 3,),
                       "Displacement": " ; ".join(["0"] * (dim - 1) + ["-0.02*t"])}
                compare(laws, "  and a lid", merge(scene, {
                    "Obstacle lid": lid, "Contact lid": contact(ids=high, obstacle="lid", mu=0.0 if gap == 0 else .3),
                    **({"Load press": None} if gap == 0 else {"Time": {"Increments": 1}})}))


def feet(laws):
    """Bridges on two feet, of which one sticks and one slips: where both would slip nothing holds them."""
    bridge = {"Dimension": 2, "Body bridge": box((12, 3), (4.0, 1.0), young=1e4), "Obstacle floor": floor(2),
              "Contact feet": contact("bridge", 7), "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
    bridge["Body bridge"]["Mesh"]["Boundary ids"] = "7: y < 1e-9 && (x < 0.4 || x > 3.6)"
    table = {"Dimension": 3, "Body table": box((8, 6, 2), (4.0, 3.0, .5), young=1e4), "Obstacle floor": floor(3),
             "Contact feet": contact("table", 7), "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    table["Body table"]["Mesh"]["Boundary ids"] = "7: z < 1e-9 && (x < 0.5 || x > 3.5) && (y < 0.5 || y > 2.5)"
    for mu in (.02, .1, .3):
        for place in (.5, 1.0):
            compare(laws, f"on two feet, mu {mu:g}, loaded at {place:g}", merge(bridge, {
                "Contact feet": {"Friction coefficient": mu},
                "Load weight": {"Body": "bridge", "Kind": "point force", "Point": (place, 1), "Value": "0 ; -t"}}))
        compare(laws, f"on four feet, mu {mu:g}", merge(table, {
            "Contact feet": {"Friction coefficient": mu},
            "Load weight": {"Body": "table", "Kind": "point force", "Point": (1, 1, .5), "Value": "0 ; 0 ; -t"}}))


def given_up(laws):
    """What Newton's method in all unknowns does not solve is condensed from there on."""
    soft = {"Dimension": 2, "Body block": box((20, 4), (4.0, 1.0), young=1e4), "Obstacle floor": floor(2),
            "Contact bottom": contact(), "Support spring": support(1, "x", Stiffness=1e-3),
            "Load pull": {"Body": "block", "Kind": "point force", "Point": (2, 1), "Value": "0.0005*t ; -2*t"},
            "Time": {"End": 1, "Increments": 2}, "Output": {"VTU": 0}}
    hard = {"Dimension": 2, "Body lower": box((12, 4), (2.0, 1.0), young=1.0), "Body upper": box((9, 3), (2.0, 1.0), (0.0, 1.0), young=1e6),
            "Contact joint": joint("upper", 2, "lower", 3, **{"Friction coefficient": .3}), "Support ground": support(2, "x, y", body="lower"),
            "Support top": support(3, "x, y", "0.004*max(t - 1, 0) ; -0.01*min(t, 1)", body="upper"),
            "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    for what, scene in (("on springs softer by 1e7", soft), ("a slave harder by 1e6", hard)):
        condensed, iterative = (laws.run(scene, *backend(name)) for name in ("condensed", "iterative"))
        laws.same(what, condensed, iterative, 1e-8)
        how = [row["solver"] == "iterative" for row in iterative.increments]
        said = (iterative.folder / "log.txt").read_text().count("From here on bodies are condensed")
        laws.demand(f"  by the one backend, then by the other: {how}", how == sorted(how, reverse=True) and said == 1 and not how[-1])


def frames(laws):
    """Beams beside blocks: on a floor of their own, and as masters; few unknowns, and more than are factorised as a whole."""
    for dim in (2, 3):
        low, high = (2, 3) if dim == 2 else (4, 5)
        every, zeros = "x, y, z"[:3 * dim - 2], (0.0,) * (dim - 1)
        down = " ; ".join(["0.001*t"] + ["0"] * (dim - 2) + ["-0.002*t"])
        clamped = {"Support clamp": support(1, "clamped", body="beam"), "Support end": support(2, every, body="beam"),
                   "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        for young, mu, n, height in ((1e3, 0.0, 10, .1), (2.1e11, .3, 30, .02)):
            force = young * height**4 / 40 / n
            push = load("nodal force", " ; ".join([f"{.05 * force!r}*t"] + ["0"] * (dim - 2) + [f"{-force!r}*t"]), 0, "beam")
            compare(laws, f"{dim}D, a beam on a floor, {n} members", {
                "Dimension": dim, "Body beam": beam(zeros + (0.0,), (2.0,) + zeros, n, young, height), **clamped,
                "Body block": box((6, 4) if dim == 2 else (6, 3, 3), (2.0, .5, .5)[:dim], zeros + (2.0,), young=young),
                "Obstacle floor": floor(dim, Point=zeros + (-.1 * height,)), "Obstacle table": floor(dim, Point=zeros + (2.0,)),
                "Contact bottom": contact("beam", 0, mu=mu), "Contact table": contact(ids=low, obstacle="table", mu=.3),
                "Support top": support(high, every, down), "Load push": push})
    for cells in ((10, 4), (120, 50)):
        compare(laws, f"a block of {cells[0]} x {cells[1]} cells on a beam", {
            "Dimension": 2, "Body beam": beam((0.0, 0.0), (2.0, 0.0), 10, 1e4, .3), **clamped,
            "Body block": box(cells, (2.0, .5)), "Support top": support(3, "x, y", "0.001*t ; -0.002*t"),
            "Support clamp": support(1, "clamped", body="beam"), "Support end": support(2, "x, y", body="beam"),
            "Contact joint": {"Body": "block", "Boundary ids": 2, "Master body": "beam", "Master boundary ids": 0,
                              "Pairing": "node to face", "Friction coefficient": .3}})
    compare(laws, "a block tied to a beam, another one on it", {
        "Dimension": 2, "Body beam": beam((0.0, 0.0), (2.0, 0.0), 10, 1e4, .3), **clamped,
        "Body block": box((7, 4), (2.0, .5)), "Body upper": box((5, 3), (2.0, .5), (0.0, .5)),
        "Support clamp": support(1, "clamped", body="beam"), "Support end": support(2, "x, y", body="beam"),
        "Support top": support(3, "x, y", "0.001*t ; -0.002*t", body="upper"),
        "Contact tied": {"Body": "block", "Boundary ids": 2, "Master body": "beam", "Master boundary ids": 0, "Kind": "tie",
                         "Pairing": "node to face"},
        "Contact joint": joint("upper", 2, "block", 3, **{"Friction coefficient": .3})})


def tied(laws):
    """Ties and bilateral contacts, with bodies and obstacles that move; interferences; held by nothing else, or by nothing at all."""
    for dim in (2, 3):
        low, high = (2, 3) if dim == 2 else (4, 5)
        below, above = ((7, 4), (5, 3)) if dim == 2 else ((4, 3, 2), (3, 4, 2))
        size = (2.0, 1.0) if dim == 2 else (1.0, 1.0, .7)
        every, zeros = "x, y, z"[:3 * dim - 2], (0.0,) * (dim - 1)
        top = zeros + (size[-1],)
        down = " ; ".join(["0"] * (dim - 1) + ["-min(t, 1)"])
        blocks = {"Dimension": dim, "Body lower": box(below, size), "Body upper": box(above, size, top, young=1e4),
                  "Obstacle floor": floor(dim, Displacement=" ; ".join(["0"] * (dim - 1) + ["0.002*t"])),
                  "Load weight": load("body force", down, body="upper"), "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0},
                  "Load push": load("body force", " ; ".join(["0.1*max(t - 1, 0)"] + ["0"] * (dim - 1)), body="upper")}
        for pairing in ("node to face", "mortar"):
            def bound(kind):
                return {"Contact joint": {**joint("upper", low, "lower", high, Pairing=pairing), "Kind": kind}}
            ground = {"Contact ground": contact("lower", low, mu=.3)}
            compare(laws, f"{dim}D, {pairing}, tied, on a floor", {**blocks, **ground, **bound("tie")})
            compare(laws, f"{dim}D, {pairing}, a slider", {
                **blocks, **ground, **bound("bilateral"), "Support far": support(high, every[:-3], " ; ".join(["0.01*t"] + ["0"] * (dim - 2)), body="upper", Stiffness=100)})
            compare(laws, f"{dim}D, {pairing}, a tie across a gap that closes", {
                **blocks, **ground, "Contact joint": {**bound("tie")["Contact joint"], "Gap": -.001}})
        glued = {"Dimension": dim, "Body block": box(below, size), "Output": {"VTU": 0}, "Load up": load("pressure", "-2 - x", high),
                 "Obstacle floor": floor(dim, Displacement="0.1*t ; 0.2*t" + " ; 0.3*t" * (dim - 2)),
                 "Contact joint": {"Body": "block", "Boundary ids": low, "Obstacle": "floor", "Kind": "tie"},
                 "Obstacle wall": {"Shape": "half space", "Normal": (-1, 0, 0)[:dim], "Point": (2.3, 0, 0)[:dim]},
                 "Contact wall": contact(ids=high, obstacle="wall")}
        compare(laws, f"{dim}D, glued to a floor that moves", glued)
        compare(laws, "  and beside a wall that comes near", merge(glued, {
            "Obstacle wall": {"Displacement": "-2*t" + " ; 0" * (dim - 1)}, "Contact wall": {"Kinematics": "small"}}))
        # reactions are determined, the place is not
        loose = {"Dimension": dim, "Body block": box(below, size), "Obstacle floor": floor(dim), "Contact bottom": contact(ids=low),
                 "Load press": load("pressure", "2", high), "Output": {"VTU": 0}}
        slider = {"Dimension": dim, "Body block": box(below, size), "Body upper": box(above, size, top, young=1e4), "Output": {"VTU": 0},
                  "Obstacle floor": floor(dim), "Contact bottom": contact(ids=low),
                  "Contact joint": {**joint("block", high, "upper", low), "Kind": "bilateral"},
                  "Support top": support(high, every, " ; ".join(["0"] * (dim - 1) + ["-0.01*t"]), body="upper")}
        for what, scene in (("nothing opposes sliding", loose), ("a slider on a floor", slider)):
            runs = [laws.run(scene, *backend(name)) for name in ("condensed", "iterative")]
            force = runs[0].largest("r_n")
            laws.check(f"{dim}D, {what}: reactions", max(
                abs(a["r_n"] - b["r_n"]) for a, b in zip(*(sorted(run.rows, key=lambda row: (row["contact"], row["x"], row["y"], row["z"]))
                                                           for run in runs))) / force, 1e-8)


def iterative(laws):
    obstacles(laws)
    sizes(laws)
    preconditioners(laws)


def iterative_pairs(laws):
    pairs(laws)
    carried(laws)
    hard_slaves(laws)


def iterative_floating(laws):
    floating(laws)
    pressed(laws)
    feet(laws)
    given_up(laws)


def floating_frames(laws):
    """A beam and a truss that only lie on a floor: along it nothing holds them but friction."""
    triangle = {"Nodes": "a: 0, 0 ; b: 1, 0 ; d: 0.5, 0.8", "Members": "a-b: s ; a-d: s ; b-d: s", "Boundary ids": "1: y < 0.1 ; 2: y > 0.7"}
    truss = {"Kind": "frame", "Sections": "s", "Frame": triangle, "Section s": {"Young modulus": 1000, "Area": .1}}
    for what, body, top, all_mu in (("beam", beam((0.0, 0.0), (1.0, 0.0), 6, 1000.0, .1), 0, (0, .3)), ("truss", truss, 2, (0,))):
        for mu in all_mu:
            run = compare(laws, f"{what} on a floor, mu {mu}", {
                "Dimension": 2, f"Body {what}": body, "Obstacle floor": floor(2), "Contact feet": contact(what, 1 if top else 0, mu=mu),
                "Load weight": load("nodal force", "0 ; -0.5*t", top, what), "Output": {"VTU": 0}})
            laws.demand("  positions are open without friction", (run.increments[-1]["determinate"] == "no") == (mu == 0))


def iterative_frames(laws):
    frames(laws)
    floating_frames(laws)
    tied(laws)
