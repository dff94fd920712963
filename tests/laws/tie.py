# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that are tied, or slide without lifting off; interferences that grow with time."""
import itertools
import math

from laws.mortar import turned_on_wider
from support.logs import log_of
from support.scenes import box, contact, floor, load, merge, simplices, support
from support.tables import Events

E, PULL = 1000.0, 2.0
JOINT = "joint"


def tie(slave, slave_ids, master, master_ids, **entries):
    return {"Body": slave, "Boundary ids": slave_ids, "Master body": master, "Master boundary ids": master_ids,
            "Kind": "tie", **entries}


def bar(dim, cells, origin=0.0, length=1.0, **mesh):
    size = (length, 1.0) if dim == 2 else (length, 1.0, 1.0)
    return box(cells, size, (origin,) + (0.0,) * (dim - 1), **mesh)


def bars(dim, left, right, exchanged=False, **contact_entries):
    """Two bars tied end to end along x, held at the left end."""
    pair = (("left", 1), ("right", 0))
    slave, master = pair[::-1] if exchanged else pair
    return {"Dimension": dim, "Body left": left, "Body right": right,
            f"Contact {JOINT}": tie(*slave, *master, **contact_entries), "Output": {"VTU": 0}}


def pulled(scene, dim):
    """Uniform tension: the left end on rollers, one side as well."""
    sides = "2" if dim == 2 else "2, 4"
    return {**scene, "Support end": support(0, "normal", body="left"),
            **{f"Support side {body}": support(sides, "normal", body=body) for body in ("left", "right")},
            "Load pull": load("pressure", repr(-PULL), 1, "right")}


def joint_rows(run):
    return [row for row in run.last() if row["contact"] == JOINT]


def stress_error(run):
    """Of nodal stresses of the joint: tension along the normal, nothing across."""
    return max(abs(row["r_n"] / row["area"] + PULL) + (abs(row["r_t1"]) + abs(row["r_t2"])) / row["area"]
               for row in joint_rows(run)) / PULL


def both_sides(run):
    """Sums of forces and moments of both sides of the joint, over the force on one."""
    last = run.increments[-1]
    force = math.hypot(*(last[f"{JOINT}_f_{c}"] for c in "xyz"))
    return max(math.hypot(*(last[f"{JOINT}_{what}_{c}"] + last[f"{JOINT}_master_{what}_{c}"] for c in "xyz"))
               for what in "fm") / force


def tension(laws):
    plane = [((2, n), (2, m)) for n, m in ((2, 3), (5, 7), (4, 4))]
    space = [((2, 2, 3), (2, 3, 2)), ((1, 3, 3), (1, 4, 5)), ((2, 3, 3), (2, 3, 3))]
    for dim, meshes in ((2, plane), (3, space)):
        stretch = PULL / E * (1 - .3**2 if dim == 2 else 1)
        for (left, right), exchanged in itertools.product(meshes, (False, True)):
            what = f"{dim}D: {left} tied to {right}{', exchanged' * exchanged}"
            scene = pulled(bars(dim, bar(dim, left), bar(dim, right, 1.0), exchanged), dim)
            # a contact at the end of the bar measures how far it went
            scene["Obstacle wall"] = {"Shape": "half space", "Normal": (-1, 0, 0)[:dim], "Point": (3.0, 0, 0)[:dim]}
            scene["Contact end"] = contact("right", 1, "wall")
            run = laws.run(scene)
            laws.check(f"{what}: stress", stress_error(run), 1e-10)
            laws.check("  both sides", both_sides(run), 1e-10)
            laws.demand("  all stick", all(row["state"] == "stick" for row in joint_rows(run)))
            laws.check("  elongation", max(abs(1 - row["gap"] - 2 * stretch) / stretch
                                           for row in run.last() if row["contact"] == "end"), 1e-10)


def turned(laws):
    """A block turned about the axis of the joint, within a wider one that is pulled beside it as well."""
    for angle, exchanged in itertools.product((0.0, 30.0), (False, True)):
        pair = (("lower", 5), ("upper", 4))
        slave, master = pair[::-1] if exchanged else pair
        scene = {"Dimension": 3, "Body lower": box((4, 5, 2), (2.0, 2.0, 1.0), (-1.0, -1.0, -1.0)),
                 "Body upper": box((3, 2, 2), (.9, .9, 1.0), (-.45, -.45, 0.0), Rotation=(0, 0, 1, angle)),
                 f"Contact {JOINT}": tie(*slave, *master),
                 "Support ground": support(4, "x, y, z", body="lower"),
                 "Load up": load("pressure", repr(-PULL), 5, "upper"), "Load side": load("traction", "0.3 ; 0.1 ; 0", 5, "upper"),
                 "Output": {"VTU": 0}}
        run = laws.run(scene)
        last = run.increments[-1]
        sign = -1 if exchanged else 1
        laws.check(f"turned by {angle:g} degrees{', exchanged' * exchanged}: the whole force",
                   math.dist([sign * last[f"{JOINT}_f_{c}"] for c in "xyz"], (.3 * .81, .1 * .81, PULL * .81)) / PULL, 1e-10)
        laws.check("  both sides", both_sides(run), 1e-10)


def turned_and_uniform(laws):
    """The same under a stress that is uniform."""
    for angle, exchanged, is_cut in ((0.0, False, False), (30.0, False, False), (30.0, True, False), (45.0, False, True),
                                     (45.0, True, True)):
        run = laws.run(merge(turned_on_wider(angle, exchanged, is_cut, -PULL), {
            f"Contact {JOINT}": {"Kind": "tie", "Friction coefficient": None}}))
        what = f"{'tetrahedra ' * is_cut}turned by {angle:g} degrees{', exchanged' * exchanged}"
        laws.check(f"{what}: stress", stress_error(run), 1e-10)
        laws.check("  both sides", both_sides(run), 1e-10)


def cut(laws):
    """Bars of triangles or tetrahedra."""
    for dim, meshes in ((2, ((2, 3), (2, 5))), (3, ((2, 2, 3), (2, 3, 2)))):
        for which in ((True, False), (False, True), (True, True)):
            left, right = (simplices(bar(dim, n, x)) if is_cut else bar(dim, n, x) for n, x, is_cut in zip(meshes, (0.0, 1.0), which))
            run = laws.run(pulled(bars(dim, left, right), dim))
            names = [("triangles" if dim == 2 else "tetrahedra") if is_cut else "whole cells" for is_cut in which]
            laws.check(f"{dim}D: {names[0]} tied to {names[1]}: stress", stress_error(run), 1e-10)
            laws.check("  both sides", both_sides(run), 1e-10)


def one_mesh(laws):
    for dim in (2, 3):
        cells, whole = ((4, 3), (8, 3)) if dim == 2 else ((3, 2, 2), (6, 2, 2))
        load_of = {"Load down": load("traction", "0.1 ; -0.3" if dim == 2 else "0.1 ; -0.3 ; 0.2", 1)}
        one = {"Dimension": dim, "Body block": bar(dim, whole, 0.0, 2.0),
               "Support end": support(0, "x, y" if dim == 2 else "x, y, z"), "Output": {"VTU": 0}}
        wall = {"Obstacle wall": {"Shape": "half space", "Normal": (0, 1, 0)[:dim], "Point": (0, -.001, 0)[:dim]}}
        mu = {"mu": .3}
        a = laws.run({**one, **load_of, **wall, "Contact under": contact("block", 2, "wall", **mu)})
        for exchanged in (False, True):
            two = bars(dim, bar(dim, cells), bar(dim, cells, 1.0), exchanged)
            two["Support end"] = {**one["Support end"], "Body": "left"}
            two["Load down"] = {**load_of["Load down"], "Body": "right"}
            b = laws.run({**two, **wall, "Contact under": contact("left", 2, "wall", **mu),
                          "Contact beside": contact("right", 2, "wall", **mu)})
            rows = {}
            for row in b.last():
                if row["contact"] in ("under", "beside"):
                    at = rows.setdefault(tuple(round(row[c], 9) for c in "xyz"), dict.fromkeys(("r_n", "r_t1", "r_t2"), 0.0))
                    for c in ("r_n", "r_t1", "r_t2"):
                        at[c] += row[c]
                    at["u"] = [row[f"u_{c}"] for c in ("n", "t1", "t2")]
            force = max(abs(row["r_n"]) for row in a.last())
            size = max(abs(row["u_n"]) for row in a.last())
            found = [(row, rows[tuple(round(row[c], 9) for c in "xyz")]) for row in a.last()]
            name = f"{dim}D: matching meshes are one{', exchanged' * exchanged}"
            laws.demand(f"{name}: they touch", force > 0)
            laws.check(f"{name}: displacements", max(math.dist([row[f"u_{c}"] for c in ("n", "t1", "t2")], other["u"])
                                                     for row, other in found) / size, 1e-10)
            laws.check(f"{name}: contact forces", max(abs(row[c] - other[c]) for row, other in found
                                                      for c in ("r_n", "r_t1", "r_t2")) / force, 1e-10)


def bending(laws):
    """The tip of two tied bars against that of one fine mesh."""
    def tip(scene):
        scene["Obstacle floor"] = floor(2, Point=(0, -10))
        scene["Contact tip"] = contact(scene["Load down"]["Body"], 1)
        rows = [row for row in laws.run(scene).last() if row["contact"] == "tip"]
        return sum(row["u_n"] for row in rows) / len(rows)

    element = {"Element": "Q1 incompatible modes"}
    down = "0 ; -0.02"
    whole = tip({"Dimension": 2, "Body block": {**bar(2, (64, 16), 0.0, 4.0), **element}, "Support end": support(0, "x, y"),
                 "Load down": load("traction", down, 1), "Output": {"VTU": 0}})
    for ratio in ((2, 3), (3, 2)):
        errors = []
        for n in (1, 2, 4):
            k, m = (r * n for r in ratio)
            two = bars(2, {**bar(2, (4 * n, k), 0.0, 2.0), **element}, {**bar(2, (4 * n, m), 2.0, 2.0), **element})
            two.update({"Support end": support(0, "x, y", body="left"), "Load down": load("traction", down, 1, "right")})
            errors.append(abs(tip(two) / whole - 1))
        laws.check(f"bending, {ratio[0]} on {ratio[1]}: tip against one mesh", errors[-1], 3e-3)
        laws.demand("  it falls with the mesh: " + ", ".join(f"{e:.2g}" for e in errors),
                    errors[0] > errors[1] > errors[2] and errors[2] < .25 * errors[0])


def floating(laws):
    """Bodies that only ties hold; two that float together fall as one, on a floor with friction."""
    for dim in (2, 3):
        cells = ((3, 2), (4, 3)) if dim == 2 else ((2, 2, 1), (3, 2, 1))
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        blocks = [box(n, (1.0,) * dim, (0.0,) * (dim - 1) + (z,)) for n, z in zip(cells, (0.0, 1.0))]
        down = "0 ; -1" if dim == 2 else "0 ; 0 ; -1"
        push = "0.05 ; 0" if dim == 2 else "0.05 ; 0 ; 0"
        scene = {"Dimension": dim, "Body lower": blocks[0], "Body upper": blocks[1], "Obstacle floor": floor(dim),
                 f"Contact {JOINT}": tie("upper", bottom, "lower", top), "Contact ground": contact("lower", bottom, mu=.3),
                 "Load weight 1": load("body force", down, body="lower"), "Load weight 2": load("body force", down, body="upper"),
                 "Load push": load("body force", push, body="upper"), "Output": {"VTU": 0}}
        run = laws.run(scene)
        last = run.increments[-1]
        axis = "y" if dim == 2 else "z"
        laws.check(f"{dim}D: the floor carries both", abs(last[f"ground_f_{axis}"] - 2), 1e-10)
        laws.check(f"{dim}D: the tie carries one", abs(last[f"{JOINT}_f_{axis}"] - 1), 1e-10)
        laws.check(f"{dim}D: friction of the ground takes the push", abs(last["ground_f_x"] + .05), 1e-10)
        done, _ = laws.start(merge(scene, {"Load push": {"Value": push.replace("0.05", "2")}}))
        laws.demand(f"{dim}D: pushed too hard both slide ({done.returncode}): {done.stderr.strip()[:90]}",
                    done.returncode == 2 and "slides" in done.stderr)
        lifted = {k: v for k, v in scene.items() if k not in ("Contact ground", "Obstacle floor")}
        done, _ = laws.start(lifted)
        laws.demand(f"{dim}D: nothing holds two tied bodies: {done.stderr.strip()[:90]}",
                    done.returncode == 1 and "Nothing holds body" in done.stderr)
        hung = merge(lifted, {"Support roof": support(top, "x, y" if dim == 2 else "x, y, z", body="upper")})
        laws.check(f"{dim}D: hung on the upper one", abs(laws.run(hung).increments[-1][f"{JOINT}_f_{axis}"] + 1), 1e-10)
        far = f"150*t ; {'20*t' if dim == 2 else '20*t ; 3*t'}"
        carried = merge(hung, {"Support roof": {"Displacement": far}})
        laws.check(f"{dim}D: and carried far", abs(laws.run(carried).increments[-1][f"{JOINT}_f_{axis}"] + 1), 1e-9)


def glued(laws):
    """Ties and bilateral contacts with obstacles."""
    for dim in (2, 3):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        axis = "y" if dim == 2 else "z"
        area = 2.0 if dim == 2 else 1.5
        block = {"Dimension": dim, "Obstacle floor": floor(dim, Displacement="0.1*t ; 0.2*t" + " ; 0.3*t" * (dim - 2)),
                 "Body block": box((5, 3) if dim == 2 else (4, 3, 2), (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)),
                 "Load up": load("pressure", repr(-PULL), top), "Output": {"VTU": 0},
                 f"Contact {JOINT}": {"Body": "block", "Boundary ids": bottom, "Obstacle": "floor", "Kind": "tie"}}
        run = laws.run({**block, "Load side": load("traction", "0.5 ; 0" + " ; 0" * (dim - 2), top)})
        last = run.increments[-1]
        laws.check(f"{dim}D: a block glued to an obstacle is pulled",
                   abs(last[f"{JOINT}_f_{axis}"] + PULL * area) + abs(last[f"{JOINT}_f_x"] + .5 * area), 1e-10)
        held = support(0, "x", body="block")
        if dim == 3:
            held = support(0, "x, y", body="block")
        slider = merge(block, {f"Contact {JOINT}": {"Kind": "bilateral"}, "Support side": held,
                               "Obstacle floor": {"Displacement": "0.1*t ; 0" + " ; 0" * (dim - 2)}})
        run = laws.run(slider)
        last = run.increments[-1]
        laws.check(f"{dim}D: a slider is pulled along the normal only",
                   abs(last[f"{JOINT}_f_{axis}"] + PULL * area) + abs(last[f"{JOINT}_f_x"]), 1e-10)
        laws.demand(f"{dim}D: it slides", all(row["state"] == "slip" for row in joint_rows(run)))
        laws.check(f"{dim}D: no tangential reaction", max(abs(row["r_t1"]) + abs(row["r_t2"]) for row in joint_rows(run)), 0)
        laws.check(f"{dim}D: it does not lift off", max(abs(row["gap"]) for row in joint_rows(run)), 0)


def on_thin_plate(laws):
    """A block is lowered on a thin plate that it may slide along, and that nothing else holds: springs in a row."""
    for element, cells in itertools.product(("Q1", "Q2"), ((2, 3), (3, 2))):
        scene = {"Dimension": 2, "Obstacle floor": floor(2), "Contact ground": contact("plate", 2, mu=.1),
                 "Body plate": {"Element": element, **box((5, 5), (2.0, .04), young=100.0, poisson=0)},
                 "Body block": box(cells, (2.0, .05), (0.0, .04), young=1e5, poisson=0),
                 f"Contact {JOINT}": {**tie("block", 2, "plate", 3), "Kind": "bilateral"},
                 "Support top": support(3, "x, y", "1e-3*t ; -1e-4*t", "block"), "Output": {"VTU": 0}}
        rows = joint_rows(laws.run(scene))
        expected = 1e-4 / (.04 / 100 + .05 / 1e5)
        laws.check(f"on a thin plate of {element}, {cells[0]} cells: pressure",
                   max(abs(row["r_n"] / row["area"] / expected - 1) for row in rows), 1e-9)


def springs(laws):
    """Two tied bars that only a foundation holds: its force, and where it lets them go."""
    scene = bars(2, bar(2, (2, 2)), bar(2, (2, 3), 1.0))
    scene["Support soft"] = support(0, "x, y", body="left", Stiffness=50)
    scene["Load pull"] = load("traction", "1 ; 0.2", 1, "right")
    last = laws.run(scene).increments[-1]
    laws.check("tied bars on springs: force of the joint",
               math.hypot(abs(last[f"{JOINT}_f_x"]) - 1, abs(last[f"{JOINT}_f_y"]) - .2), 1e-10)
    scene["Solver"] = {"Method": "load path"}
    done, _ = laws.start(scene)
    laws.demand(f"no load path without contact: {done.stderr.strip()[:100]}", done.returncode == 1 and "Choose automatic" in done.stderr)


def path(laws):
    """The limit load of two tied blocks that are pushed is that of one."""
    block = {"Dimension": 2, "Obstacle floor": floor(2), "Contact ground": contact("lower", 2, mu=.3),
             "Load weight 1": load("body force", "0 ; -1", body="lower"), "Load weight 2": load("body force", "0 ; -1", body="upper"),
             "Load push": load("body force", "t ; 0", body="upper"), "Time": {"Times": 2}, "Solver": {"Method": "load path"},
             "Body lower": box((3, 2), (1.0, 1.0)), "Body upper": box((4, 3), (1.0, 1.0), (0.0, 1.0)),
             f"Contact {JOINT}": tie("upper", 2, "lower", 3), "Output": {"VTU": 0}}
    done, folder = laws.start(block)
    events = Events(folder)
    laws.demand(f"load path: {events.words}", done.returncode == 0 and "sliding" in events.words)
    laws.check("  limit load", abs(events.parameter - .6), 1e-10)


def elsewhere(laws):
    """A block that a slider guides, pressed against a wall with friction."""
    scene = {"Dimension": 2, "Body block": box((6, 4), (2.0, 1.0)), "Obstacle floor": floor(2),
             "Obstacle wall": {"Shape": "half space", "Normal": (-1, 0), "Point": (2, 0)},
             "Contact guide": {"Body": "block", "Boundary ids": 2, "Obstacle": "floor", "Kind": "bilateral"},
             "Contact side": contact("block", 1, "wall", mu=.4),
             "Load push": load("pressure", "3", 0), "Load up": load("body force", "0 ; 0.7"), "Output": {"VTU": 0}}
    last = laws.run(scene).increments[-1]
    laws.check("a guided block on a wall: the push", abs(last["side_f_x"] + 3), 1e-10)
    laws.check("  forces along the wall", abs(last["side_f_y"] + last["guide_f_y"] + 1.4), 1e-10)
    laws.demand("  friction takes a part of them", abs(last["side_f_y"]) > 1e-3)
    laws.check("  none in the guide", abs(last["guide_f_x"]), 1e-12)


def redundant(laws):
    """Ties that imply each other, and supports that hold what is tied."""
    ids = (1, 0)
    blocks = {f"Body {name}": box(n, (1.0, 1.0), at) for name, n, at in
              (("a", (3, 3), (0.0, 0.0)), ("b", (3, 3), (1.0, 0.0)), ("c", (3, 3), (0.0, 1.0)), ("d", (3, 3), (1.0, 1.0)))}
    scene = {"Dimension": 2, **blocks, "Contact ab": tie("a", ids[0], "b", ids[1]), "Contact cd": tie("c", ids[0], "d", ids[1]),
             "Contact ac": tie("a", 3, "c", 2), "Contact bd": tie("b", 3, "d", 2),
             "Support a": support("0", "x, y", body="a"), "Support c": support("0", "x, y", body="c"),
             "Load b": load("traction", "2 ; -0.3", 1, "b"), "Load d": load("traction", "2 ; -0.3", 1, "d"),
             "Obstacle floor": floor(2, Point=(0, -1)), "Contact under": contact("b", 2), "Output": {"VTU": 0}}
    one = laws.run({"Dimension": 2, "Body block": box((6, 6), (2.0, 2.0)), "Support a": support("0", "x, y"),
                    "Load b": load("traction", "2 ; -0.3", 1), "Obstacle floor": floor(2, Point=(0, -1)),
                    "Contact under": contact(), "Output": {"VTU": 0}})
    where = {round(row["x"], 9): row for row in one.last()}
    rows = [row for row in laws.run(scene).last() if row["contact"] == "under"]
    laws.check("four blocks tied around a point are one",
               max(abs(row["u_n"] - where[round(row["x"], 9)]["u_n"]) + abs(row["u_t1"] - where[round(row["x"], 9)]["u_t1"])
                   for row in rows) / max(abs(row["u_n"]) for row in rows), 1e-10)
    done, _ = laws.start({**pulled(bars(2, bar(2, (2, 3)), bar(2, (2, 3), 1.0)), 2),
                          "Support here": support(1, "x", "0", body="left"), "Support there": support(0, "x", "0.1", body="right")})
    laws.demand(f"a joint that supports tear apart is refused ({done.returncode}): {done.stderr.strip()[-160:]}",
                done.returncode == 2 and "is tied and moves" in done.stderr)
    rings = {"Dimension": 2, "Contact joint": {**tie("outer", 0, "inner", 1, Gap="-0.002"), "Kind": "bilateral"},
             "Support hub": support(0, "x, y", body="inner"), "Output": {"VTU": 0}}
    for name, radii, cells, angle in (("inner", "1 : 2", 10, 0), ("outer", "2 : 3", 7, 13)):
        rings[f"Body {name}"] = {"Mesh": {"Generator": "hyper_shell", "Arguments": f"0, 0 : {radii} : {cells} : true",
                                          "Global refinements": 1, "Rotation": angle},
                                 "Material": {"Young modulus": E, "Poisson ratio": .3}}
    done, _ = laws.start(rings)
    laws.demand(f"a ring that may spin on another ends with a result or a sentence ({done.returncode})", done.returncode in (0, 2))
    for gap in (0.0, .04):
        run = laws.run(pulled(bars(2, bar(2, (2, 3)), bar(2, (2, 3), 1.0 + gap)), 2))
        laws.demand(f"a joint across a gap of {gap} is {'' if gap else 'not '}warned of",
                    ("binds sides that are up to 0.04 apart" in log_of(run)) == (gap > 0))


def press_fits(laws):
    """Quarters of rings, one pressed on the other by an interference that grows: Lame."""
    ring = {"Material": {"Young modulus": E, "Poisson ratio": .3, "Plane": "stress"}}
    def shell(inner, outer, cells):
        return {"Mesh": {"Generator": "quarter_hyper_shell", "Arguments": f"0, 0 : {inner} : {outer} : {cells} : true",
                         "Global refinements": 3}, **ring}
    growing = "-0.002*t/4*(1 + (t > 2))"
    deltas = (.0005, .001, .003, .004)
    for kind, cells in itertools.product(("contact", "tie", "bilateral"), ((4, 4), (3, 4))):
        scene = {"Dimension": 2, "Body inner": shell(1, 2, cells[0]), "Body outer": shell(2, 3, cells[1]),
                 f"Contact {JOINT}": {**tie("inner", 1, "outer", 0, Gap=growing, Pairing="mortar"), "Kind": kind},
                 **{f"Support {body} {axis}": support(side, axis, body=body)
                    for body in ("inner", "outer") for axis, side in (("x", 2), ("y", 3))},
                 "Time": {"End": 4, "Increments": 4}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        means = []
        for k in range(4):
            rows = [row for row in run.rows if row["contact"] == JOINT and row["increment"] == k + 1]
            means.append(sum(row["r_n"] for row in rows) / sum(row["area"] for row in rows))
            laws.check(f"{kind}, {cells[0]} on {cells[1]}: gaps at t = {k + 1}", max(abs(row["gap"]) for row in rows), 1e-15)
            laws.check("  interference", max(abs(row["u_n"] - deltas[k]) for row in rows), 1e-15)
        laws.check("  pressure in proportion", max(abs(mean / means[0] / (d / deltas[0]) - 1) for mean, d in zip(means, deltas)), 1e-10)
        laws.check("  pressure against Lame", abs(means[1] / (.5 * .234375) - 1), 3e-3)
        work = sum(row["external_work"] for row in run.increments)
        laws.check("  work of the interference is strain energy", abs(work / run.increments[-1]["strain_energy"] - 1), 1e-10)


def heated(laws):
    """Nothing but heat acts: a strip of two metals bends (Timoshenko 1925), what is bound to slide spreads without force."""
    def half(name, y, expansion):
        body = box((60, 4), (20.0, .5), (0.0, y))
        return {f"Body {name}": {**merge(body, {"Material": {"Expansion coefficient": expansion, "Plane": "stress"}}),
                                 "Element": "Q1 incompatible modes"}}
    strip = {"Dimension": 2, **half("low", 0.0, 1e-5), **half("high", .5, 3e-5), f"Contact {JOINT}": tie("high", 2, "low", 3),
             "Support end": support(0, "x", body="low"), "Support high end": support(0, "x", body="high"),
             "Support corner": support(7, "y", body="low"),
             **{f"Load {body}": load("temperature", "100*t", body=body) for body in ("low", "high")},
             "Time": {"Times": "0.5, 1"}, "Output": {"VTU": 0, "Probes": "corner: 20, 0"}}
    strip["Body low"]["Mesh"]["Boundary ids"] = "7: x < 0.1 && y < 0.1"
    floating = {"Dimension": 2, "Body block": merge(box((5, 4), (2.0, 1.0), Rotation=37.3), {
        "Material": {"Expansion coefficient": 1e-5}}),
        "Obstacle floor": {"Shape": "half space", "Normal": (-math.sin(math.radians(37.3)), math.cos(math.radians(37.3)))},
        "Contact bottom": {**contact("block", 2, "floor"), "Kind": "bilateral"},
        "Load heat": load("temperature", "10*sin(t)", body="block"), "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
    for name in ("condensed", "iterative"):
        run = laws.run(strip, "-s", f"Solver/Backend={name}")
        exact = -1.5 * 2e-5 * 100 * 20**2 / 2
        laws.check(f"{name}, strip of two metals: its end goes down", abs(run.probe("corner")[1] / exact - 1), 2e-2)
        run = laws.run(floating, "-s", f"Solver/Backend={name}")
        laws.check(f"{name}, bound to slide: no force", run.largest("r_n"), 1e-15)


def tie_family(laws):
    for family in (tension, turned, turned_and_uniform, cut, one_mesh, bending, floating, glued, on_thin_plate, springs, path, elsewhere, redundant, press_fits, heated):
        family(laws)
