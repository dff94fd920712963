# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load paths: limit loads, the examples of [P], and increments that come to them."""
import itertools
import math
from pathlib import Path

from support.logs import log_of
from support.scenes import SHIPPED, box, contact, entries, floor, joint, load, merge, press_and_shear, pushed_block, support
from support.tables import Events, read
from support.vectors import apply, rotation

REFERENCE = Path(__file__).resolve().parents[1] / "reference"
PATH = entries(Solver__Method="load path", Output__VTU=0)


def posts(n, mu=.5):
    """n equal posts of two bars each, held at their tops."""
    nodes, members = [], []
    for i in range(n):
        nodes += [f"{3 * i + 1}: {2 * i}, 0", f"{3 * i + 2}: {2 * i}, 1", f"{3 * i + 3}: {2 * i + 1}, 1"]
        members += [f"{3 * i + 1}-{3 * i + 2}: bar", f"{3 * i + 1}-{3 * i + 3}: bar"]
    return {"Dimension": 2,
            "Body posts": {"Kind": "frame", "Sections": "bar",
                           "Frame": {"Nodes": " ; ".join(nodes), "Members": " ; ".join(members),
                                     "Boundary ids": "1: y == 0 ; 2: y == 1"},
                           "Section bar": {"Young modulus": 1000, "Area": .01}},
            "Obstacle floor": floor(2), "Contact feet": contact("posts", 1, mu=mu),
            "Support tops": {"Body": "posts", "Boundary ids": 2},
            "Load weight": load("nodal force", "0 ; -1", 1, "posts"),
            "Load push": load("nodal force", "t ; 0", 1, "posts"),
            "Time": {"Times": 2}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}


def path_prestress(laws):
    """A prestress is a pair of forces, for every method, and balances."""
    for method in ("automatic", "load path"):
        scene = merge(posts(3), {"Load push": None, "Contact feet": {"Prestress": 2}, "Solver": {"Method": method}})
        run = laws.run(scene)
        laws.check(f"{method}: reactions carry the weight and the prestress",
                   max(abs(row["r_n"] - 3) for row in run.last()), 1e-12)
    pile = entries(Contact_left__Prestress=1, Contact_right__Prestress=1)
    a = laws.run(SHIPPED / "sheet-pile.prm", "-s", "Output/VTU=0", *pile)
    laws.check("sheet pile: loads of the prestress cancel", abs(a.increments[-1]["loads_f_y"]), 1e-9)


def path_limits(laws):
    """A block slides at p = mu or tips at p = 1/h, whatever mesh, law and place of the push."""
    for cells, law in itertools.product(((2, 1), (7, 3), (16, 8)), ("incremental", "holonomic")):
        for height, mu in ((.3, .5), (.61, .8), (.9, 1.5), (1.0, 1.01)):
            run = laws.run(pushed_block(2, height, mu, cells=cells, **{"Solver": {"Law": law}}))
            events = Events(run.folder)
            kind = "sliding" if mu < 1 / height else "tipping"
            laws.check(f"{cells} cells, {law}, h = {height}, mu = {mu}: limit load",
                       abs(events.parameter / min(mu, 1 / height) - 1), 1e-9)
            laws.demand(f"  {events.words}", events.words == f"limit load: {kind}")
            laws.demand("  mechanism.vtu", (run.folder / "mechanism.vtu").exists())


def path_sled(laws):
    """A block that stays on a sled leaves a wall with it: they slide, and nothing tips, though a gap opens."""
    sled = box((8, 2), (2.0, .3), (0.0, 0.0))
    block = box((4, 4), (1.0, .6), (0.0, .3))
    run = laws.run({"Dimension": 2, "Body sled": sled, "Body block": block, "Obstacle table": floor(2),
                    "Obstacle wall": {"Shape": "half space", "Normal": (1, 0)},
                    "Contact bottom": contact("sled", 2, "table", mu=.15), "Contact joint": joint("block", 2, "sled", 3, **{"Friction coefficient": .5}),
                    "Contact side": contact("block", 0, "wall"), "Load weight": load("traction", "0 ; -10", 3, "block"),
                    "Load push": load("traction", "10*t ; 0", 1, "sled"), "Time": {"Times": 3}, "Solver": {"Method": "load path"},
                    "Output": {"VTU": 0}})
    events = Events(run.folder)
    laws.check("a block on a sled beside a wall: limit load", abs(events.parameter * 10 * .3 / (.15 * 10) - 1), 1e-9)
    laws.demand(f"  {events.words}", events.words == "limit load: sliding")


def path_bar(laws):
    """[P] Example 2: the nodes slip one by one from the end, p_j = f q h (j + 1/2) / F."""
    bar = entries(Load_weight__Value="0 ; -3975", Load_pull__Value="243750*t ; 0", Time__End=1.3,
                  Time__Increments=1)
    for n in (5, 10, 20, 40, 80, 160):
        length = 260 / (n - 1)
        run = laws.run(SHIPPED / "bar-on-rigid-base.prm", *PATH, *bar,
                       "-s", f"Body bar/Frame/Arguments=0, 0 : 260, 0 : {n - 1}")
        events = Events(run.folder)
        exact = [.3 * 3975 * length * (j + .5) / 243750 for j in range(n - 1)]
        laws.demand(f"bar of {n} nodes: {len(events.at)} events, {events.words}",
                    len(events.at) == n - 1 and all(len(nodes) == 1 for nodes in events.nodes))
        laws.check("  their loads", max(abs(p / q - 1) for p, q in zip(events.at, exact)), 1e-12)
    run = laws.run(SHIPPED / "bar-pull-release.prm", *PATH)
    events = Events(run.folder)
    step = .3 * 3975 * 260 / 9 / 243750
    exact = [step * (j + .5) for j in range(7)] + [1] + [1 + 2 * step * (j + .5) for j in range(4)]
    laws.demand(f"pulled and released: {len(events.at)} events", len(events.at) == len(exact))
    laws.check("  their loads", max(abs(p - q) for p, q in zip(events.at, exact)), 1e-12)


def path_beam(laws):
    """[P] Example 1: with the tightening weight the left support opens at p = 32/3."""
    beam = entries(Time__End=100, Contact_supports__Prestress=1, Contact_supports__Cohesion=.4)
    run = laws.run(SHIPPED / "beam-three-supports.prm", *PATH, *beam, *entries(Solver__Law="holonomic"))
    events = Events(run.folder)
    laws.demand(f"beam: events {events.nodes}, {events.words}",
                events.nodes[0] == [("0", "stick", "open")] and events.words == "no further change")
    laws.check("  first event", abs(events.at[0] * 3 / 32 - 1), 1e-12)


def path_sheet_pile(laws):
    """[P] Example 3: homogeneous, so that loads of events are proportional to the prestress."""
    expected = [row["force_N"] for row in read(REFERENCE / "popov-3-events.csv")]
    for force in (1, 100):
        run = laws.run(SHIPPED / "sheet-pile.prm", *PATH, *entries(
            Solver__Law="holonomic", Load_push__Value="t ; 0", Time__End=3000 * force,
            Contact_left__Prestress=force, Contact_right__Prestress=force,
            Contact_left__Cohesion=.6 * force, Contact_right__Cohesion=.6 * force))
        events = Events(run.folder)
        laws.demand(f"sheet pile, prestress {force}: {len(events.at)} events, {events.words}",
                    len(events.at) == 68 and events.words == "no further change")
        laws.check("  their loads", max(abs(p / (force * q) - 1) for p, q in zip(events.at, expected)), 1e-9)


def path_alike(laws):
    """Nodes that are alike change together."""
    run = laws.run(posts(40))
    events = Events(run.folder)
    laws.demand(f"40 posts that are alike: {len(events.at)} event of {len(events.nodes[0])} nodes",
                len(events.at) == 1 and len(events.nodes[0]) == 40)
    down = pushed_block(2, .5, .2, **{
        "Load push": None, "Support top": support(3, "x, y", "0 ; -0.01*t"), "Time": {"Times": 1}})
    run = laws.run(down)
    places = {int(row["node"]): row["x"] for row in run.last()}
    other = {"slip+": "slip-", "slip-": "slip+"}
    symmetric = all({(round(2 - places[int(n)], 9), other.get(a, a), other.get(b, b)) for n, a, b in nodes}
                    == {(round(places[int(n)], 9), a, b) for n, a, b in nodes}
                    for nodes in Events(run.folder).nodes)
    laws.demand("a symmetric structure keeps symmetric states", symmetric)


def path_turns(laws):
    """A foot that slipping unloads, K_tn = K_tt = 1/sqrt(8) k and r_n = 1 - K_tn |u|: it slips at p = mu, and
    mu > K_tt/K_tn lets p = mu + K_tt (1 - mu) |u| fall to 1, where it opens. Coulomb's law jumps at p = mu."""
    k = 10 / math.sqrt(8)
    for n, law in itertools.product((1, 3), ("holonomic", "incremental")):
        scene = merge(posts(n, mu=2), {"Load push": load("nodal force", "-t ; 0", 1, "posts"), "Time": {"Times": 3},
                                       "Solver": {"Law": law}})
        run = laws.run(scene)
        events = Events(run.folder)
        snaps = law == "holonomic"
        laws.demand(f"{n} feet, {law}: {events.loads} at {events.at}, {events.words}",
                    events.loads == (["turns down", "turns up"] if snaps else ["rises"]) and events.words == (
                        "no further change after 2 turning points" if snaps else
                        "no further change after a jump at p = 2") and all(len(e) == n for e in events.nodes))
        laws.check("  their loads", max(abs(p - q) for p, q in zip(events.at, (2, 1) if snaps else (2,))), 1e-12)
        laws.demand("  records follow the path", [row["time"] for row in run.increments][:3] == [
            p for p in ((0, 2, 1) if snaps else (0, 2, 2))])
        row = run.last()[0]
        laws.check("  open at the end: gap and slip", max(
            abs(row["gap"] - 2 * k / (10 * k)), abs(row["u_t1"] + ((10 + k) * 3 - k) / (10 * k))), 1e-12)
    scene = merge(posts(1, mu=2), {"Load push": load("nodal force", "-1.5*min(t, 1) - max(t - 1, 0) ; 0", 1, "posts"),
                                   "Time": {"Times": "1, 3"}, "Solver": {"Law": "holonomic"}})
    events = Events(laws.run(scene).folder)
    laws.demand(f"back at the start of its stage: {events.words}",
                events.words == "returned to start after 1 turning point" and events.parameter == 1)


def path_increments(laws):
    """Increments of the SOCLCP come to the path; where nothing reverses one increment is the path."""
    bar = (SHIPPED / "bar-on-rigid-base.prm", "-s", "Output/VTU=0")
    pull = entries(Load_weight__Value="0 ; -3975", Load_pull__Value="243750*t ; 0", Time__End=1, Time__Increments=1)
    path, one = laws.run(*bar, *PATH, *pull), laws.run(*bar, *pull)
    size = path.largest("u_t1")
    laws.check("bar, one increment against the path", max(
        abs(a["u_t1"] - b["u_t1"]) for a, b in zip(path.last(), one.last())) / size, 1e-10)
    moved = ("-s", "Support top/Displacement=-0.2*max(t - 1, 0) ; -0.35*t",
             "-s", "Contact bottom/Friction coefficient=0.2", "-s", "Output/VTU=0")
    file = SHIPPED / "inclined-obstacle.prm"
    path = laws.run(file, *moved, *PATH, "-s", "Time/Times=1, 2").last()
    errors = []
    for n in (4, 16, 64):
        rows = laws.run(file, *moved, "-s", f"Time/Stages=1 : {n}, 2 : {n}").last()
        errors.append(max(abs(a[c] - b[c]) for a, b in zip(path, rows) for c in ("r_n", "r_t1")))
    for coarse, fine in zip(errors, errors[1:]):
        laws.check("where slip reverses, differences to the path with a fourth of the increment", fine / coarse, .5)


def turned_pair(degrees, young, weight, push, times):
    """A block on a wider base, 5 cells on 4, turned as a whole and pushed along the joint."""
    def body(cells, size, place, modulus):
        return box(cells, size, place, young=modulus, Rotation=degrees)
    return {"Dimension": 2, "Body block": body((5, 3), (2.0, .8), (-1.0, 0.0), young[0]),
            "Body base": body((4, 3), (12.0, 2.0), (-6.0, -2.0), young[1]),
            "Contact joint": contact("block", 2, "", .5, **{"Master body": "base", "Master boundary ids": 3,
                                                               "Pairing": "node to face"}),
            "Support ground": support(2, "x, y", body="base"),
            "Load weight": load("pressure", weight, 3, "block"), "Load push": load("pressure", push, 0, "block"),
            "Time": {"Times": times}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}


def path_turned_pairs(laws):
    """Gaps that are rounding are closed: nodes do not come to the base one after the other."""
    for degrees in (0, 12, 30, 33.3, 57.1, 155):
        for name, young in (("stiff base", (4.3e4, 1e6)), ("metals in SI", (7.3e9, 8.8e11))):
            p = young[0] * 1e-6  # slides where push x 0.8 = 0.5 x weight x 2
            for what, weight, push, times, limit in (
                    ("weight first", f"{p}*min(2*t, 1)", f"{p}*max(4*t - 2, 0)", "0.5, 1", .5 + 1.25 / 4),
                    ("weight all the time", f"{p}", f"{p}*2*t", "1", .625)):
                run = laws.run(turned_pair(degrees, young, weight, push, times))
                events = Events(run.folder)
                laws.check(f"{name} turned by {degrees} degrees, {what}: limit load", abs(events.parameter / limit - 1), 1e-9)
                laws.demand("  it slides: " + events.words, events.words == "limit load: sliding")


def path_from_nothing(laws):
    """Turned blocks that miss the floor and each other by the last digits rest on them under the first load."""
    for axis, degrees in (((-.889, -.385, .081), .2), ((-.731, .078, -.678), 179.0), ((.3, -.5, .8), 77.3)):
        turn = rotation(axis, degrees)

        def vector(*v, m=turn):
            return apply(m, v)

        def traction(p, h, m=turn):
            down, side = apply(m, (0, 0, -1)), apply(m, (1, 0, 0))
            return " ; ".join(f"{p}*({a!r})*min(t, 1) + {h}*({b!r})*max(t - 1, 0)" for a, b in zip(down, side))
        place = {"Rotation": (*map(float, axis), degrees)}
        scene = {"Dimension": 3, "Body lower": box((2, 2, 2), (2.0, 2.0, .56), (-1.0, -1.0, 0.0), poisson=0.0, **place),
                 "Body upper": box((1, 1, 2), (1.5, 1.5, .56), (-.75, -.75, .56), **place),
                 "Obstacle floor": {"Shape": "half space", "Normal": vector(0, 0, 1)},
                 "Contact ground": contact("lower", 4, mu=.3), "Contact joint": joint(
                     "upper", 4, "lower", 5, **{"Friction coefficient": .5}),
                 "Load push": load("traction", traction(.1, .04), 5, "upper"),
                 "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}, "Solver": {"Method": "load path"}}
        run = laws.run(scene)
        events = Events(run.folder)
        laws.demand(f"two blocks turned by {degrees} degrees: {events.words}", events.words == "limit load: sliding")
        laws.check("  its limit", abs(events.parameter - 1.75), 1e-6)
        done, _ = laws.start(scene, "-s", "Solver/Method=automatic")
        laws.check("  by increments", abs(float(done.stderr.split("at most ")[1].split(". ")[0]) - .75), 1e-4)


def path_in_space(laws):
    for degrees in (0, 17, 45, 110):
        angle = math.radians(degrees)
        run = laws.run(pushed_block(3, .2, .5, angle))
        events = Events(run.folder)
        laws.check(f"block pushed low at {degrees} degrees: limit load", abs(events.parameter - .5), 1e-6)
        laws.demand("  it slides: " + events.words, events.words == "limit load: sliding")
        run = laws.run(pushed_block(3, .9, 2.0, angle))
        events = Events(run.folder)
        limit = 1 / (.9 * max(abs(math.cos(angle)), abs(math.sin(angle))))
        laws.check(f"block pushed high at {degrees} degrees: limit load", abs(events.parameter / limit - 1), 1e-6)
        laws.demand("  it tips: " + events.words, events.words == "limit load: tipping")
        laws.admissible("  records", run, lambda row: 2.0)
    for mu in (.7, 1.2):
        run = laws.run(SHIPPED / "double-layer-grid-04.prm", "-s", "Solver/Method=load path", "-s", "Time/End=3",
                       "-s", "Load thrust/Value=4e-4/6*t ; 2e-4/6*t ; -4e-4/6", "-s", "Output/VTU=0",
                       "-s", f"Contact feet/Friction coefficient={mu}")
        events = Events(run.folder)
        laws.check(f"grid, mu = {mu}: side over vertical load at the limit",
                   abs(events.parameter * math.sqrt(5) / 2 - mu), 1e-6)
        laws.demand("  it slides: " + events.words, events.words == "limit load: sliding")


def path_far(laws):
    """Along a plane the contact of undeformed bodies is exact, however far they slide."""
    for degrees in (0.0, 30.0):
        m = rotation((0, 0, 1), degrees)
        scene = press_and_shear(2, cells=(8, 4), increments=3, Rotation=degrees)
        motion = [" + ".join(f"({m[d][e]!r})*({f})" for e, f in enumerate(("7*max(t - 1, 0)", "-0.01*min(t, 1)"))) for d in range(2)]
        scene = merge(scene, {"Obstacle floor": {"Normal": apply(m, (0, 1, 0))[:2]},
                              "Support top": {"Displacement": " ; ".join(motion)}})
        increments, done = laws.run(scene), laws.run(merge(scene, {"Solver": {"Method": "load path"}}))
        rows = [{(row["x"], row["y"]): row for row in run.last()} for run in (increments, done)]
        force = max(row["r_n"] for row in rows[0].values())
        what = f"load path along a plane, by 7 lengths, turned by {degrees:g}"
        laws.check(f"{what}: reactions", max(abs(rows[1][p][c] - row[c]) for p, row in rows[0].items() for c in ("r_n", "r_t1")) / force, 1e-9)
        laws.check("  the way of its nodes", max(abs(abs(row["u_t1"]) / 14 - 1) for row in rows[1].values()), 1e-2)
        laws.check("  friction", max(abs(abs(row["r_t1"]) - .3 * row["r_n"]) for row in rows[1].values()) / force, 1e-10)
        log = log_of(done)
        laws.demand("  small kinematics, no warning", "bottom: kinematics small, both sides are plane" in log and "warning" not in log)


def path_on_springs(laws):
    """Soft foundations cost no digits: the path ends where increments do."""
    rise = "min(max(t, 0), 1)", "min(max(t - 1, 0), 1)", "min(max(t - 2, 0), 1)"
    for stiffness, young in ((100.0, 1e4), (1.0, 1e5), (1e4, 1e4)):
        press = f"(0.7*{rise[0]} - 0.12*{rise[1]} - 0.15*{rise[2]})*(1 + 0.1*x)"
        shear = f"0.3*(0.1*{rise[0]} + 0.04*{rise[1]} - 0.28*{rise[2]})"
        scene = {"Dimension": 2, "Body block": box((7, 5), (2.8, 1.15), young=young), "Obstacle floor": floor(2), "Contact bottom": contact(mu=.2),
                 "Support side": {"Body": "block", "Boundary ids": 0, "Stiffness": stiffness},
                 "Load weight": load("body force", "0 ; -1"), "Load press": load("pressure", press, 3), "Load shear": load("traction", f"{shear} ; 0", 3),
                 "Time": {"Times": "1, 2, 3"}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        events = Events(run.folder)
        name = f"a block on springs, {stiffness:g} beside {young:g}"
        laws.demand(f"{name}: {events.words}", events.words == "target reached")
        steps = laws.run(merge(scene, {"Solver": {"Method": "automatic"}, "Time": {"Times": ", ".join(str(.025 * i) for i in range(1, 121))}}))
        force = max(row["r_n"] for row in steps.last())
        laws.check("  reactions beside 120 increments",
                   max(abs(a[c] - b[c]) for a, b in zip(run.last(), steps.last()) for c in ("r_n", "r_t1")) / force, 1e-11)


def path_shared_nodes(laws):
    """A node in two contacts with friction is refused whatever rounding makes of its rows."""
    for young, cells in itertools.product((1.0, 10.0, 100.0, 1e5), ((3, 2), (4, 3), (5, 7), (6, 5))):
        block = merge(box(cells, (898.2, 417.7), young=young, poisson=.2), {"Element": "Q1"})
        done, _ = laws.start({"Dimension": 2, "Body block": block, "Obstacle floor": floor(2), "Obstacle wall": {"Shape": "half space", "Normal": (1, 0)},
                              "Contact bottom": contact(mu=.6), "Contact back": contact(ids=0, obstacle="wall", mu=.3),
                              "Load weight": load("body force", "0 ; -1e-6"), "Load push": load("traction", "-t ; 0", 1),
                              "Time": {"Times": 1000}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}})
        laws.demand(f"a corner in two contacts, E = {young:g}, {cells}",
                    done.returncode == 1 and "stands in contacts 'bottom' and 'back'" in done.stderr)


def path(laws):
    path_on_springs(laws)
    path_shared_nodes(laws)
    path_far(laws)
    path_prestress(laws)
    path_limits(laws)
    path_sled(laws)
    path_bar(laws)
    path_beam(laws)
    path_sheet_pile(laws)
    path_alike(laws)
    path_turns(laws)
    path_increments(laws)
    path_turned_pairs(laws)
    path_from_nothing(laws)
    path_in_space(laws)
