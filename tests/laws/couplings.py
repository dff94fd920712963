# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces that move as one with a point where forces and moments act (Coupling = rigid)."""
import csv
import itertools
import math
import random

from laws.restart import difference, go_on
from support.scenes import box, contact, floor, joint, load, merge, simplices, support, write_scene
from support.vectors import apply, cross, dot, plus, rotation, scaled

YOUNG, LENGTH = 1000.0, 3.0
BACKENDS = ("condensed", "iterative")


def couplings(laws):
    pure_bending(laws)
    torsion(laws)
    one_rigid_body(laws)
    carried_along(laws)
    turned(laws)
    lever(laws)
    wheel(laws)
    driven_wheel(laws)
    as_written_by_hand(laws)
    ring(laws)
    without_pressure(laws)
    beside_contacts(laws)
    continued(laws)


def at_point(kind, value, point, ids=1, body="block"):
    return load(kind, " ; ".join(map(str, value)), ids, body, Coupling="rigid", Point=tuple(point))


def bar(dim, backend="condensed", poisson=0.0, element="Q2", cells=None, **more):
    """Held at x = 0; its end at x = LENGTH is 1 high [and .8 deep]."""
    size = (LENGTH, 1.0, .8)[:dim]
    return {"Dimension": dim,
            "Body block": {**box(cells or ((6, 2) if dim == 2 else (3, 2, 2)), size, young=YOUNG, poisson=poisson), "Element": element},
            "Support left": support(0, "x, y" if dim == 2 else "x, y, z"),
            "Solver": {"Backend": backend}, "Output": {"VTU": 0}, **more}


def last_row(run, table):
    with open(run.folder / table, newline="") as stream:
        return list(csv.DictReader(stream))[-1]


def motion(run, name="end"):
    row = run.increments[-1]
    return tuple([row[f"obstacle_coupling_{name}_{what}_{c}"] for c in "xyz"] for what in ("u", "rot"))


def held(laws, what, run, force, moment, size, name="left", bound=5e-12):
    """What the support carries, about the origin, against what acts."""
    row = run.increments[-1]
    found = [[row[f"support_{name}_{k}_{c}"] for c in "xyz"] for k in "fm"]
    laws.check(f"{what}: force and moment of the support",
               max(math.dist(found[0], scaled(-1, force)), math.dist(found[1], scaled(-1, moment))) / size, bound)
    laws.check("  balance", row["balance"], 1e-11)


def three(v):
    return (*v, 0.0, 0.0)[:3]


def pure_bending(laws):
    """A force along the bar, eccentric, and moments: displacements of second degree, exact where nu = 0."""
    meshes = [(2, "Q2", "quadrilaterals"), (2, "P2", "triangles"), (3, "Q2", "hexahedra"), (3, "P2", "tetrahedra")]
    for (dim, element, cells), backend in itertools.product(meshes, BACKENDS):
        what = f"{dim}D, {cells}, {backend}"
        depth = 1.0 if dim == 2 else .8
        centre = (LENGTH, .5, .4)[:dim]
        point = (LENGTH + .5, .8, .1)[:dim]
        force = (6.0, 0.0, 0.0)
        moment = (0, 0, 1.5) if dim == 2 else (0, -.7, 1.5)
        scene = bar(dim, backend, **{"Load end": at_point("force", force[:dim], point),
                                     "Load bend": at_point("moment", moment[2:] if dim == 2 else moment, point)})
        scene["Body block"] = {**(simplices(scene["Body block"]) if element == "P2" else scene["Body block"]), "Element": element}
        run = laws.run(scene, bounds=False)
        arm = plus(three(point), scaled(-1, three(centre)))
        about = plus(moment, cross(arm, force))  # of the section
        turn = [0, about[1] * LENGTH / (YOUNG * depth**3 / 12) if dim == 3 else 0, about[2] * LENGTH / (YOUNG * depth / 12)]
        moved = [force[0] * LENGTH / (YOUNG * depth), turn[2] * LENGTH / 2, -turn[1] * LENGTH / 2]
        u, rot = motion(run)
        laws.check(f"{what}: stretched and bent, the turn", math.dist(rot, turn) / math.hypot(*turn), 1e-10)
        exact = plus(moved, cross(turn, arm))
        laws.check("  the motion of the point", math.dist(u, exact) / math.hypot(*exact), 1e-10)
        row = run.increments[-1]
        energy = .5 * (dot(force, u) + dot(moment, rot))
        laws.check("  strain energy", abs(row["strain_energy"] / energy - 1), 1e-10)
        laws.demand("  one coupling of both loads", sum("coupling" in c and c.endswith("u_x") for c in row) == 1)
        held(laws, what, run, force, plus(moment, cross(three(point), force)), 20)
        laws.check("  the log: asked and carried", math.dist([row[f"coupling_end_f_{c}"] for c in "xyz"], force), 1e-10)


def torsion(laws):
    """A shaft twisted by its end: the rate of St Venant away from both ends, whatever they keep from warping."""
    moment, radius, length = 2.0, .5, 4.0
    for backend in BACKENDS:
        scene = {"Dimension": 3, "Body block": {"Mesh": {"Generator": "cylinder", "Arguments": f"{radius!r} : {length / 2!r}", "Global refinements": 1},
                                                "Element": "Q2", "Material": {"Young modulus": YOUNG, "Poisson ratio": .3}},
                 "Support left": support(1, "x, y, z"), "Load end": at_point("moment", (moment, 0, 0), (length, .3, -.2), 2),
                 "Solver": {"Backend": backend}, "Output": {"VTU": 0, "Probes": "a: -0.5, 0.3, 0 ; b: 0.5, 0.3, 0"}}
        run = laws.run(scene, bounds=False)
        rate = (run.probe("b")[2] - run.probe("a")[2]) / .3
        exact = moment / (YOUNG / 2.6 * math.pi * radius**4 / 2)
        laws.check(f"twisted shaft, {backend}: the rate of twist", abs(rate / exact - 1), .005)
        held(laws, "  its end", run, (0, 0, 0), (moment, 0, 0), moment)


def one_rigid_body(laws):
    """Nodes of the faces keep their distances; the law is linear, so that the first order of them stays exactly."""
    chance = random.Random(3)
    for (dim, element, simplex), backend in itertools.product(((2, "Q1", False), (3, "Q1", False), (3, "P2", True)), BACKENDS):
        ends = list(itertools.product((0, .25, .5, 1.0), repeat=dim - 1))
        probes = {f"p{i}": (LENGTH, *(s * h for s, h in zip(p, (1.0, .8)))) for i, p in enumerate(ends)}
        point = (1.0, -2.0, .7)[:dim]
        force = [chance.uniform(-3, 3) for _ in range(dim)]
        turn = [chance.uniform(-3, 3) for _ in range(1 if dim == 2 else 3)]
        scene = bar(dim, backend, .3, cells=(6, 4) if dim == 2 else (3, 4, 4),
                    **{"Load end": at_point("force", force, point), "Load turn": at_point("moment", turn, point)})
        scene["Body block"] = {**(simplices(scene["Body block"]) if simplex else scene["Body block"]), "Element": element}
        scene["Output"]["Probes"] = " ; ".join(f"{k}: " + ", ".join(map(repr, p)) for k, p in probes.items())
        run = laws.run(scene, bounds=False)
        u = {k: run.probe(k) for k in probes}
        size = max(math.hypot(*v) for v in u.values())
        what = f"{dim}D, {element}, {backend}"
        laws.check(f"{what}: distances of {len(u)} nodes", max(
            abs(dot(plus(u[a], scaled(-1, u[b])), scaled(1 / math.dist(probes[a], probes[b]), plus(three(probes[a]), scaled(-1, three(probes[b]))))))
            for a, b in itertools.combinations(probes, 2)) / size, 1e-12)
        there, rot = motion(run)
        laws.check("  they move with the point", max(
            math.dist(u[k], plus(there, cross(rot, plus(three(p), scaled(-1, three(point)))))) for k, p in probes.items()) / size, 1e-12)
        moment = (0, 0, *turn) if dim == 2 else turn
        held(laws, "  " + what, run, three(force), plus(moment, cross(three(point), three(force))), 10)


def carried_along(laws):
    """A support moves the bar as a whole: nothing is strained, the point goes along."""
    for dim, backend in itertools.product((2, 3), BACKENDS):
        w, shift, point = (0, 0, .01) if dim == 2 else (.004, -.006, .01), (.3, -.2, .1)[:dim], (5.0, 2.0, -1.0)[:dim]
        fields = [f"{s!r} + ({w[1]!r})*{'z' if dim == 3 else 0} - ({w[2]!r})*y" if c == 0 else
                  f"{s!r} + ({w[2]!r})*x - ({w[0]!r})*{'z' if dim == 3 else 0}" if c == 1 else
                  f"{s!r} + ({w[0]!r})*y - ({w[1]!r})*x" for c, s in enumerate(shift)]
        scene = bar(dim, backend, .3, "Q1", **{"Load end": at_point("force", (0,) * dim, point)})
        scene["Support left"]["Displacement"] = " ; ".join(fields)
        run = laws.run(scene, bounds=False)
        u, rot = motion(run)
        exact = plus(three(shift), cross(w, three(point)))
        laws.check(f"{dim}D, {backend}: moved as a whole, the point", math.dist(u, exact) / math.hypot(*exact), 1e-12)
        laws.check("  its turn", math.dist(rot, w) / math.hypot(*w), 1e-11)
        laws.check("  strain energy", abs(run.increments[-1]["strain_energy"]) / YOUNG, 1e-24)


def lever(laws):
    """A coupling turns along with what it holds: loads on it keep their directions, a turned bar answers as one that is not."""
    for (dim, axis), backend in itertools.product(((2, (0.0, 0.0, 1.0)), (3, (1.0, 2.0, 3.0))), BACKENDS):
        m, hub = rotation(axis, 90.0), (.2, -.4, .3)[:dim]
        point = (LENGTH + .5, .8, .1)[:dim]
        force, moment = three((.3, -.2, .1)[:dim]), (0, 0, .1) if dim == 2 else (-.1, .2, .05)

        def scene(degrees, turn):
            acting = [f"{x!r}*max(t - 1, 0)" for x in apply(turn, force)[:dim]]
            turning = [f"{x!r}*max(t - 1, 0)" for x in (moment[2:] if dim == 2 else apply(turn, moment))]
            return bar(dim, backend, .3, "Q1", Time={"Stages": "1 : 3, 2 : 1"},
                       **{"Support left": {"Body": "block", "Boundary ids": 0, "Turn": f"{degrees!r}*min(t, 1)", "Turn axis": axis,
                                           "Reference point": hub},
                          "Load end": at_point("force", acting, point), "Load bend": at_point("moment", turning, point)})

        still, far = laws.run(scene(0.0, rotation(axis, 0.0)), bounds=False), laws.run(scene(90.0, m), bounds=False)
        a, b = (run.increments[-1] for run in (far, still))
        laws.check(f"{dim}D, {backend}, a lever turned by a quarter: strain energy", abs(a["strain_energy"] / b["strain_energy"] - 1), 1e-9)
        laws.check("  before it is loaded", far.increments[2]["strain_energy"] / b["strain_energy"], 1e-20)
        for kind in "fm":
            u, v = ([row[f"coupling_end_{kind}_{c}"] for c in "xyz"] for row in (a, b))
            w = apply(m, v) if kind == "f" else u
            laws.check(f"  {kind} on the coupling", math.dist(u, w), 1e-9)
        (u, turn), (v, small) = motion(far), motion(still)
        there = plus(three(hub), apply(m, plus(three(point), v, scaled(-1, three(hub)))))
        laws.check("  the place of the point", math.dist(plus(three(point), u), there), 1e-9)
        angle = math.hypot(*turn)
        whole = product(m, rotation(small, math.degrees(math.hypot(*small))))
        found = rotation(turn, math.degrees(angle))
        laws.check("  its turn", max(math.dist(p, q) for p, q in zip(whole, found)), 1e-9)


def product(a, b):
    return [[dot(row, column) for column in zip(*b)] for row in a]


FACET = math.pi / 48  # half the angle from one to the next
TYRE = {"Mesh": {"Generator": "hyper_shell", "Arguments": "0, 1 : 0.4 : 1 : 48 : true"}, "Material": {"Young modulus": 1e4, "Poisson ratio": .3}}


def wheel(laws):
    """A wheel that is pulled by its axle rolls away, but for the moment of its facets."""
    scene = {"Dimension": 2, "Body wheel": TYRE, "Obstacle floor": floor(2), "Contact tread": contact("wheel", 1, "floor", .4),
             "Load axle": load("force", f"{10 * FACET!r}*0.5*t ; -10*min(t, 1)", 0, "wheel", Point="0, 1", Coupling="rigid"),
             "Time": {"End": 1.5, "Increments": 3}, "Output": {"VTU": 0}}
    for backend in BACKENDS:
        row = laws.run(merge(scene, {"Solver": {"Backend": backend}}), bounds=False).increments[-1]
        laws.check(f"{backend}, pulled by less than its facets hold: balance", row["balance"], 1e-11)
    done, _ = laws.start(merge(scene, {"Load axle": {"Value": "2.5*max(t - 1, 0) ; -10*min(t, 1)"}}))
    laws.demand(f"pulled by an eighth of its weight: {done.stderr.strip()}", done.returncode == 2 and "rolls" in done.stderr)


def driven_wheel(laws):
    """The axle is pressed down and drawn along: the wheel rolls, and withstands no more than its facets do."""
    held = {"Free": "rz", "Displacement": "{drawn!r}*max(t - 1, 0) ; -0.004*min(t, 1)"}
    loaded = {"Free": "y, rz", "Displacement": "{drawn!r}*max(t - 1, 0) ; 0", "Force": "0 ; -20*min(t, 1)"}
    for what, hub, road, drawn in (("held axle", held, "floor", .1), ("held axle", held, "floor", 1.0), ("loaded axle", loaded, "floor", .7),
                                   ("loaded axle on a body", loaded, "ground", .5)):
        scene = {"Dimension": 2, "Body wheel": merge(TYRE, {"Mesh": {"Translation": "0, 1", "Arguments": "0, 0 : 0.4 : 1 : 48 : true"}}),
                 "Obstacle hub": {"Shape": "prescribed gap", "Normal": "0.6, 0.8", "Gap": 0, "Reference point": "0, 1",
                                  **{name: value.replace("{drawn!r}", repr(drawn)) for name, value in hub.items()}},
                 "Contact axle": {"Body": "wheel", "Boundary ids": 0, "Obstacle": "hub", "Kind": "tie"},
                 "Time": {"Stages": "1 : 1, 2 : 12"}, "Output": {"VTU": 0}}
        scene.update({"Obstacle floor": floor(2), "Contact tread": contact("wheel", 1, "floor", .4)} if road == "floor" else
                     {"Body ground": box((40, 2), (2.0, .2), (-.5, -.2), 1e4), "Support bed": support(2, "x, y", body="ground"),
                      "Contact tread": joint("wheel", 1, "ground", 3, **{"Friction coefficient": .4})})
        run = laws.run(scene, bounds=False)
        for row in run.increments[1:]:
            laws.demand(f"{what}, drawn by {drawn:g}, t = {row['time']:.3g}: drag {row['tread_f_x']:g} of {row['tread_f_y']:g}",
                        abs(row["tread_f_x"]) <= 1.05 * FACET * row["tread_f_y"])
        laws.check("  it rolls", abs(run.increments[-1]["obstacle_hub_rot_z"] + drawn) / drawn, .01)


def turned(laws):
    """Everything turned gives everything turned."""
    for dim, axis, degrees in ((2, (0, 0, 1), 37.0), (3, (1, 2, 3), 23.7)):
        m = rotation(axis, degrees)
        force, moment, point = (3.0, -2.0, 1.5)[:dim], (4.0,) if dim == 2 else (1.0, -4.0, 2.5), (4.0, 1.5, -.5)[:dim]
        plain = laws.run(bar(dim, poisson=.3, element="Q1", **{"Load end": at_point("force", force, point), "Load turn": at_point("moment", moment, point)}))
        scene = bar(dim, poisson=.3, element="Q1",
                    **{"Load end": at_point("force", apply(m, three(force))[:dim], apply(m, three(point))[:dim]),
                       "Load turn": at_point("moment", moment if dim == 2 else apply(m, moment), apply(m, three(point))[:dim])})
        scene["Body block"]["Mesh"]["Rotation"] = degrees if dim == 2 else (*map(float, axis), degrees)
        run = laws.run(scene)
        for k, what in enumerate(("motion", "turn")):
            a, b = motion(plain)[k], motion(run)[k]
            laws.check(f"{dim}D, turned: the {what} of the point", math.dist(apply(m, a), b) / math.hypot(*a), 1e-10)


def as_written_by_hand(laws):
    """An obstacle that is free, and a tie; loads that come and go."""
    for dim in (2, 3):
        free, point, force = ("x, y, rz", (4.0, .2), "1 ; -2*t") if dim == 2 else ("x, y, z, rx, ry, rz", (4.0, .2, .1), "1 ; -2*t ; t^2")
        scene = bar(dim, poisson=.3, element="Q1", Time={"End": 3, "Increments": 3})
        coupled = merge(scene, {"Load end": load("force", force, 1, Coupling="rigid", Point=point, Active="t > 1.5")})
        values = [f"if(t > 1.5, {f}, 0)" for f in force.split(" ; ")]
        by_hand = merge(scene, {"Obstacle plate": {"Shape": "prescribed gap", "Normal": (1, 0, 0)[:dim], "Gap": 0, "Free": free,
                                                   "Reference point": point, "Force": " ; ".join(values)},
                                "Contact joint": {"Body": "block", "Boundary ids": 1, "Obstacle": "plate", "Kind": "tie"}})
        a, b = laws.run(coupled), laws.run(by_hand)
        for one, other in zip(a.increments, b.increments):
            found = [abs(one[f"obstacle_coupling_end_{k}_{c}"] - other[f"obstacle_plate_{k}_{c}"]) for k in ("u", "rot") for c in "xyz"]
            laws.check(f"{dim}D, by hand, t = {one['time']}", max(found), 1e-12)
        laws.demand("  nothing acts at first", motion(a)[0] != [0, 0, 0] and a.increments[0]["obstacle_coupling_end_u_y"] == 0)


def ring(laws):
    """A tube that is pressed by its end: uniform strain where nu = 0."""
    for backend in BACKENDS:
        tube = {"Dimension": 2, "Body block": merge(box((2, 4), (.5, 2.0), (1.0, 0.0), YOUNG, 0.0), {"Material": {"Plane": "axisymmetric"}}),
                "Support left": support(2, "x, y"), "Load end": at_point("force", (0, -70), (0.0, 3.0), 3),
                "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        run = laws.run(tube)
        exact = -70 * 2 / (YOUNG * math.pi * (1.5**2 - 1))
        laws.check(f"tube, {backend}: its end", abs(motion(run)[0][1] / exact - 1), 1e-11)
        laws.check("  the support", abs(run.increments[-1]["support_left_f_y"] / 70 - 1), 1e-12)


def without_pressure(laws):
    """Forces pass through its nodes; pressures along the axes of their frames would say nothing."""
    for dim, backend in itertools.product((2, 3), BACKENDS):
        run = laws.run(bar(dim, backend, .3, **{"Load end": at_point("force", (-6.0, 1.0, .5)[:dim], (LENGTH, .5, .4)[:dim])}))
        row = last_row(run, "history.csv")
        laws.demand(f"{dim}D, {backend}: a coupling has no pressure", float(row["largest_pressure"]) == 0 and not row["largest_pressure_contact"]
                    and all(r["pressure"] == r["area"] == r["traction_t1"] == 0 for r in run.rows))
        laws.check("  its nodes have the force", abs(run.increments[-1]["coupling_end_f_x"] / -6 - 1), 1e-10)


def beside_contacts(laws):
    """A block that is pressed on a floor and pushed by its top: friction carries what is asked."""
    for dim in (2, 3):
        bottom, top, down = (2, 3, 1) if dim == 2 else (4, 5, 2)
        press, push = ["0"] * dim, ["0"] * dim
        press[down], push[0] = "-20*min(t, 1)", "4*max(t - 1, 0)"
        point = [1.0, .5, .4][:dim]
        point[down] = 1.2
        scene = {"Dimension": dim, "Body block": box((8, 4) if dim == 2 else (5, 3, 3), (2.0, 1.0, 1.0)[:dim]),
                 "Obstacle floor": floor(dim), "Contact bottom": contact(ids=bottom, mu=.3),
                 "Load press": at_point("force", press, point, top), "Load push": at_point("force", push, point, top),
                 "Time": {"End": 2, "Increments": 4}, "Output": {"VTU": 0}}
        runs = {}
        for backend in BACKENDS:
            runs[backend] = run = laws.run(merge(scene, {"Solver": {"Backend": backend}}))
            row = run.increments[-1]
            laws.check(f"{dim}D, pressed and pushed, {backend}: the floor", math.dist([row["bottom_f_" + c] for c in "xyz"[:dim]],
                       [-4.0 if c == 0 else 20.0 if c == down else 0 for c in range(dim)]) / 20, 1e-9)
        laws.same(f"{dim}D, both backends", runs[BACKENDS[0]], runs[BACKENDS[-1]], 1e-8)


def continued(laws):
    """A run that goes on from a checkpoint, with other loads on the same coupling."""
    for backend in BACKENDS:
        scene = bar(2, backend, .3, "Q1", **{"Load end": at_point("force", ("t", "-2*t"), (4.0, .2)), "Time": {"End": 6, "Increments": 6}})
        scene["Output"]["Checkpoint"] = 2
        whole = laws.run(scene)
        file, folder = laws.folder / f"coupled-{backend}.prm", laws.folder / f"coupled-{backend}"
        write_scene(merge(scene, {"Time": {"End": 3, "Increments": 3}}), file)
        laws.batch.run(file, "-o", folder, "--quiet").check_returncode()
        write_scene(scene, file)
        if go_on(laws, file, folder):
            laws.check(f"a coupling, {backend}: 3 increments and 3 more", difference(whole.folder, folder), 1e-12)
        done, _ = laws.start(merge(scene, {"Load end": {"Point": (5.0, .2)}, "Time": {"End": 9, "Increments": 9}}), "--restart", folder)
        laws.demand(f"  another point: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 1 and "Load end/Point was '4.0, 0.2'" in done.stderr)
