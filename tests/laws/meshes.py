# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes and surfaces that are not what they seem: joined where they should be, and told where they are not."""
import math
import random

from support.gmsh import gmsh_file, tower
from support.logs import log_of
from support.scenes import beam, box, contact, floor, joint, load, merge, simplices, support
from support.surfaces import ball, brick, triangles, write_stl


def warnings_of(run):
    return [line for line in log_of(run).splitlines() if "warning: " in line]


def warns(laws, what, run, *words):
    """One warning has all the words; without words there is none."""
    found = warnings_of(run)
    good = any(all(word in line for word in words) for line in found) if words else not found
    laws.demand(f"{what}: {'told' if words else 'no warning'}{'' if good else ', found ' + repr(found)}", good)


def cracked_square(file, half, ends):
    """A square of unit cells from -half to half; the nodes of y = 0 between both ends, which it has once, are there twice."""
    n = 2 * half + 1
    points = [(float(i - half), float(j - half), 0.0) for j in range(n) for i in range(n)]
    above = {}
    for i in range(n):
        if ends[0] < i - half < ends[1]:
            above[half * n + i] = len(points)
            points.append(points[half * n + i])
    elements = []

    def side(a, b, group):
        elements.append((1, {group}, [a, b]))

    for j in range(n - 1):
        for i in range(n - 1):
            nodes = [j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i]
            if j == half:
                nodes = [above.get(node, node) for node in nodes]
            elements.append((3, {10}, nodes))
    for i in range(n - 1):
        side(i, i + 1, 1)
        side((n - 1) * n + i, (n - 1) * n + i + 1, 2)
        side(i * n, (i + 1) * n, 3)
        if ends[0] <= i - half < ends[1]:
            a, b = half * n + i, half * n + i + 1
            side(a, b, 4)
            side(above.get(a, a), above.get(b, b), 5)
    file.write_bytes(gmsh_file(points, elements, {(2, 10): "rock", (1, 1): "south", (1, 2): "north", (1, 3): "west",
                                                  (1, 4): "lower", (1, 5): "upper"}))


def crack_tips(laws):
    """Tips that both sides of a crack share are no contact nodes: what presses across passes as if there was no crack."""
    for pairing in ("mortar", "node to face"):
        for ends in ((-2, 2), (-3, 1)):
            file = laws.folder / "crack.msh"
            cracked_square(file, 4, ends)
            run = laws.run({"Dimension": 2, "Body rock": {"Mesh": {"File": file.name}, "Material": {"Young modulus": 1000.0, "Poisson ratio": .25}},
                            "Contact crack": joint("rock", "upper", "rock", "lower", **{"Pairing": pairing, "Friction coefficient": .6}),
                            "Support south": support("south", "y", body="rock"), "Support west": support("west", "x", body="rock"),
                            "Load press": load("pressure", "10*t", "north", "rock"), "Output": {"VTU": 0}})
            laws.demand(f"crack by {pairing}: its tips are no contact nodes", {round(row["x"]) for row in run.rows if row["contact"] == "crack"} ==
                        set(range(ends[0] + 1, ends[1])))
            force = sum(row["r_n"] for row in run.rows if row["contact"] == "crack")
            # nodes have the forces of a pressure of 10; mortar gives the tips' share to their neighbours
            expected = 10 * (ends[1] - ends[0] - (pairing == "node to face"))
            laws.check(f"crack by {pairing}: its force", abs(force / expected - 1), 1e-10)
            laws.check(f"crack by {pairing}: settlement, by the work", abs(run.increments[-1]["external_work"] / (.5 * 10**2 * (1 - .25**2) / 1000 * 64) - 1), 1e-10)
            warns(laws, f"crack by {pairing}", run)


def doubled_nodes(laws):
    """Two cells whose nodes between them are there twice; told, but where a contact is between them."""
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0)]
    points = [tuple(map(float, p)) for p in points]
    elements = [(3, {10}, [0, 1, 2, 3]), (3, {10}, [4, 5, 6, 7]), (1, {1}, [0, 1]), (1, {1}, [4, 5]), (1, {2}, [3, 2]), (1, {2}, [7, 6]),
                (1, {3}, [0, 3]), (1, {3}, [5, 6]), (1, {4}, [1, 2]), (1, {5}, [4, 7])]
    (laws.folder / "twice.msh").write_bytes(gmsh_file(points, elements, {(1, 4): "right of left", (1, 5): "left of right"}))
    scene = {"Dimension": 2, "Body part": {"Mesh": {"File": "twice.msh"}, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
             "Obstacle floor": floor(2), "Contact sole": contact("part", 1, mu=.3), "Load press": load("pressure", "10*t", 2, "part"),
             "Support base": support(3, "x, y", body="part"), "Output": {"VTU": 0}}
    warns(laws, "nodes that are there twice", laws.run(scene), "body 'part' is of 2 pieces that are not joined", "nodes at (1, 0, 0) coincide", "2 pairs")
    joined = laws.run(merge(scene, {"Contact joint": joint("part", "left of right", "part", "right of left", Kind="tie"),
                                      "Contact sole": None, "Obstacle floor": None}))
    warns(laws, "nodes that are there twice, tied", joined)
    loose = merge(scene, {"Support base": {"Boundary ids": 7}, "Body part": {"Mesh": {"Boundary ids": "7: x < 1e-9"}}, "Contact sole": None,
                          "Obstacle floor": None})
    done, _ = laws.start(loose)
    laws.demand("a piece that nothing holds: refused, with body, place and hint" + ("" if done.returncode == 1 else repr(done)),
                done.returncode == 1 and all(word in done.stderr for word in ("'part'", "coincide", "(1, 0, 0)")))


def second_order(laws):
    """Middle nodes beside the chords are told with number, distance and place, those on them are not."""
    inner, outer, n = 1.0, 2.0, 4

    def place(r, k):
        angle = math.pi / 2 * k / (2 * n)
        return (r * math.cos(angle), r * math.sin(angle), 0.0)

    for curved in (True, False):
        points = [place(inner + (outer - inner) * i / 2, k) for k in range(2 * n + 1) for i in range(3)]
        if not curved:
            for k in range(1, 2 * n, 2):
                for i in range(3):
                    points[3 * k + i] = tuple((a + b) / 2 for a, b in zip(points[3 * k - 3 + i], points[3 * k + 3 + i]))
        elements = []
        for k in range(0, 2 * n, 2):
            a, m, b = 3 * k, 3 * k + 3, 3 * k + 6
            elements += [(10, {10}, [a, a + 2, b + 2, b, a + 1, m + 2, b + 1, m, m + 1]), (8, {1}, [a, b, m]), (8, {2}, [a + 2, b + 2, m + 2])]
        elements += [(8, {3}, [0, 2, 1]), (8, {4}, [6 * n, 6 * n + 2, 6 * n + 1])]
        (laws.folder / "ring.msh").write_bytes(gmsh_file(points, elements, {(1, 1): "inner", (1, 2): "outer", (1, 3): "x", (1, 4): "y"}))
        run = laws.run({"Dimension": 2, "Body ring": {"Element": "Q1", "Mesh": {"File": "ring.msh", "Scale": 10}, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
                        "Support x": support("x", "y", body="ring"), "Support y": support("y", "x", body="ring"),
                        "Obstacle shaft": {"Shape": "sphere", "Radius": 10}, "Contact bore": contact("ring", "inner", "shaft"),
                        "Load press": load("pressure", "10*t", "outer", "ring"), "Output": {"VTU": 0}})
        if curved:
            # where the middle of the longest chord is off most
            off = 10 * outer * (1 - math.cos(math.pi / 4 / n))
            warns(laws, "middle nodes on the curve", run, f"of {2 * n} edges of 'ring.msh'", f"by up to {off:.5g}"[:-1])
        else:
            warns(laws, "middle nodes on chords", run)


def last_digits(laws):
    """A surface whose corners differ from face to face is the one without these digits."""
    random.seed(1)
    solids = {"brick": brick((-1.0, -1.0, -1.0), (1.0, 1.0, 0.0)), "ball": ball(1.0, 3)}
    # a thin lath: its short edges must stay
    solids["lath"] = brick((-1.0, -1.0, -1e-4), (1.0, 1.0, 0.0))
    for name, (points, faces) in solids.items():
        if name == "ball":
            points = [(x, y, z - 1) for x, y, z in points]
        write_stl(laws.folder / "exact.stl", points, faces)
        loose = [points[i] for face in triangles(faces) for i in face]
        digits = 1e-8 if name == "lath" else 1e-6
        loose = [tuple(c + random.uniform(-digits, digits) for c in p) for p in loose]
        write_stl(laws.folder / "loose.stl", loose, [(i, i + 1, i + 2) for i in range(0, len(loose), 3)])
        runs = []
        for file in ("exact.stl", "loose.stl"):
            cube = box((4, 4, 4), (1.0, 1.0, 1.0), (-.5, -.5, 0.0))
            runs.append(laws.run({"Dimension": 3, "Body cube": cube, "Obstacle table": {"Shape": "surface mesh", "File": file},
                                  "Contact sole": contact("cube", 4, "table", .5), "Support top": support(5, "x, y, z", "0 ; 0 ; -0.05*t", "cube"),
                                  "Output": {"VTU": 0}}))
        forces = [run.increments[-1]["sole_f_z"] for run in runs]
        laws.check(f"{name} with other last digits: force", abs(forces[1] / forces[0] - 1), 1e-4)


def stops(laws):
    """A cantilever whose end runs against a stop on springs: R = (F L^3/3EI - gap)/(1/K + L^3/3EI)."""
    size, young, gap, force, stiffness = .2, 1e10, 1e-4, 1000.0, 1e8
    flexibility = 1 / (3 * young * size**4 / 12)
    exact = (force * flexibility - gap) / (1 / stiffness + flexibility)
    for offset in (.0, .01):  # the node faces a node, or a point between two
        run = laws.run({"Dimension": 2, "Body beam": beam((0.0, 0.0), (1.0, 0.0), 4, young, size),
                        "Body stop": box((2, 2), (.1, .1), (.95 + offset, -.1 - gap), 1e15, 0.0),
                        "Contact end": {"Body": "stop", "Boundary ids": 3, "Master body": "beam", "Master boundary ids": 2},
                        "Support wall": {"Body": "beam", "Boundary ids": 1, "Directions": "clamped"},
                        "Support ground": support(2, "y", body="stop", Stiffness=stiffness / .1), "Support side": support(0, "x", body="stop"),
                        "Load force": load("nodal force", f"0 ; {-force}*t", 2, "beam"), "Output": {"VTU": 0}})
        forces = [row["r_n"] for row in run.rows if row["contact"] == "end"]
        laws.check(f"a stop at the end of a beam, {offset} off its middle", abs(sum(forces) / exact - 1), 1e-6)


def planks(laws):
    """A plank leans on a smooth wall with its corner: statics, and no warning of an edge."""
    scene = {"Dimension": 2, "Body plank": box((20, 2), (5.0, .1), young=1e8, Rotation=60, **{"Boundary ids": "5: y < 0.2 ; 6: y > 4.2"}),
             "Obstacle floor": floor(2), "Obstacle wall": {"Shape": "half space", "Normal": (-1, 0), "Point": (2.5, 0)},
             "Contact foot": contact("plank", 5, mu=.4), "Contact top": contact("plank", 6, "wall"),
             "Load weight": load("body force", "0 ; -200*t", body="plank"), "Output": {"VTU": 0}}
    run = laws.run(scene)
    warns(laws, "a corner on a wall", run)
    laws.check("a corner on a wall: weight", abs(run.increments[-1]["foot_f_y"] / 100 - 1), 1e-10)


def never_closed(laws):
    """A contact that never closes is told, once."""
    scene = {"Dimension": 2, "Body block": box((4, 2), (2.0, 1.0)), "Obstacle floor": floor(2, Point=(0.0, -.1)), "Contact sole": contact("block", 2),
             "Support top": support(3, "x, y"), "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    warns(laws, "a contact that never closes", laws.run(scene), "'sole' never closes", "0.1")
    down = merge(scene, {"Support top": {"Displacement": "0 ; -0.11*sin(pi*t/2)"}})
    warns(laws, "a contact that closes and opens", laws.run(down))


def interference(laws):
    """Bodies that start inside each other are told, a press fit that is meant is not."""
    lower, upper = box((10, 5), (20.0, 10.0), young=210e3), box((10, 5), (20.0, 10.0), (0.0, 9.98), young=210e3)
    scene = {"Dimension": 2, "Body lower": lower, "Body upper": upper, "Contact joint": joint("upper", 2, "lower", 3),
             "Support floor": support(2, "x, y", body="lower"), "Support lid": support(3, "x, y", body="upper"), "Output": {"VTU": 0}}
    warns(laws, "blocks drawn into each other", laws.run(scene), "nodes of contact 'joint' start up to 0.02 inside body 'lower'")
    run = laws.run(merge(scene, {"Contact joint": {"Largest interference": .05}}))
    warns(laws, "an interference that is meant", run)
    laws.demand("an interference that is meant: what passes is told", "start up to 0.02 inside body 'lower'" in log_of(run))


def joined(laws):
    """Four warnings of one kind are one; three are three, and each stands in the log."""
    for n in (3, 4):
        blocks = {f"Body block {k}": box((2, 1), (2.0, 1.0), (3.0 * k, -.01 * k)) for k in range(1, n + 1)}
        scene = {"Dimension": 2, **blocks, "Obstacle floor": floor(2), "Output": {"VTU": 0},
                 **{f"Contact sole {k}": contact(f"block {k}", 2) for k in range(1, n + 1)},
                 **{f"Support top {k}": support(3, "x, y", body=f"block {k}") for k in range(1, n + 1)}}
        run = laws.run(scene)
        found = warnings_of(run)
        laws.demand(f"{n} blocks start inside the floor: {len(found)} warnings", len(found) == (n if n < 4 else 1))
        for k in range(1, n + 1):
            laws.demand(f"  block {k} by how much", f"nodes of contact 'sole {k}' start up to {.01 * k:g} inside" in log_of(run))
        if n == 4:
            laws.demand("  one names all of them", "'sole 1' start up to 0.01" in found[0] and
                        "The same holds for 'sole 2', 'sole 3', 'sole 4'" in found[0])


def names(laws):
    """A name that no group has: the one that is meant is in the sentence."""
    (laws.folder / "tower.msh").write_bytes(gmsh_file(*tower(2, 2, (1.0, .5), ("rubber", "steel"))))
    for entry, word, meant in (("Contact bottom/Boundary ids", "flor", "floor"), ("Load top/Boundary ids", "tops", "top"),
                               ("Body column/Mesh/Group", "Steal", "steel")):
        done, _ = laws.start({"Dimension": 2, "Body column": {"Mesh": {"File": "tower.msh"}, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
                              "Obstacle floor": floor(2), "Contact bottom": contact("column", "floor"), "Support left": support("left", "x", body="column"),
                              "Load top": load("pressure", "1", "top", "column")}, "-s", f"{entry}={word}")
        laws.demand(f"{entry} = {word}: {done.stderr.strip()}", done.returncode == 1 and f"Did you mean '{meant}'?" in done.stderr)


def meshes(laws):
    names(laws)
    crack_tips(laws)
    doubled_nodes(laws)
    second_order(laws)
    last_digits(laws)
    stops(laws)
    planks(laws)
    never_closed(laws)
    interference(laws)
    joined(laws)


def quarter(inner, outer, cells, refinements, young=1e9, poisson=.2):
    return {"Mesh": {"Generator": "quarter_hyper_shell", "Arguments": f"0, 0 : {inner} : {outer} : {cells} : true", "Global refinements": refinements},
            "Material": {"Young modulus": young, "Poisson ratio": poisson}}


def rings(refinements=2):
    """A ring around a ring, drawn to touch, pressed from outside: their facets differ."""
    scene = {"Dimension": 2, "Body outer": quarter(.6, 1.0, 5, refinements), "Body inner": quarter(.2, .6, 4, refinements),
             "Contact joint": joint("outer", 0, "inner", 1), "Load press": load("pressure", "1e7*t", 1, "outer"), "Output": {"VTU": 0}}
    for body in ("outer", "inner"):
        scene |= {f"Support {body} x": support(2, "x", body=body), f"Support {body} y": support(3, "y", body=body)}
    return scene


def bent_strips(laws):
    """Two leaf springs, clamped side by side: chords of their faces must not press beside the clamp without a word."""
    def strips(below, above, **entries):
        body = {"Element": "Q1 incompatible modes"}
        return {"Dimension": 2, "Body lower": {**box((below, 2), (100.0, 1.0)), **body},
                "Body upper": {**box((above, 2), (100.0, 1.0), (0.0, 1.0)), **body},
                "Contact joint": {**joint("upper", 2, "lower", 3), **entries},
                "Support lower": support(0, "x, y", body="lower"), "Support upper": support(0, "x, y", body="upper"),
                "Load tip": load("traction", "0 ; -0.0001*t", 1, "upper"), "Output": {"VTU": 0}}
    def balanced(cells):
        """What presses at the clamp is far above what the tip carries, by which the balance of all is told: each body has its own."""
        run = laws.run(strips(*cells), bounds=False)
        laws.check(f"strips of {cells} cells: balance of each", max(row[f"balance_{name}"] for row in run.increments for name in ("upper", "lower")), 1e-11)
        return run
    for cells in ((50, 40), (40, 30)):
        warns(laws, f"strips of {cells} cells", balanced(cells), "contact 'joint'", "presses alone")
    for cells in ((50, 50), (40, 50)):
        run = balanced(cells)
        warns(laws, f"strips of {cells} cells", run)
        force = sum(row["r_n"] for row in run.rows if row["contact"] == "joint")
        laws.check(f"strips of {cells} cells: half of the load goes through the tips", force / 5e-5 - 1, .05)


def rollers(laws):
    """A cylinder on a block, in cells that are larger and smaller than what touches; a flat punch on coarse cells."""
    for dim in (2, 3):
        size, top, down = (2.0, 1.0, .5)[:dim], 2 * dim - 1, dim - 1
        place = (1.0, 4.0) if dim == 2 else (1.0, 0.0, 3.5)
        scene = {"Dimension": dim, "Contact roller": contact(ids=top, obstacle="roller", mu=.2),
                 "Obstacle roller": {"Shape": "cylinder", "Radius": 3.0, "Point": place, "Displacement": " ; ".join(["0"] * down + ["-0.005*t"]),
                                     **({"Axis": "0, 1, 0"} if dim == 3 else {})},
                 "Support low": support(2 * dim - 2, "x, y, z"[:3 * dim - 2]), "Output": {"VTU": 0}}
        for cells, words in (((8, 4, 2), ("contact 'roller'", "narrower than cells resolve")), ((160, 8, 4) if dim == 2 else (60, 2, 4), ())):
            warns(laws, f"{dim}D, a roller on {cells[0]} cells", laws.run({**scene, "Body block": box(cells[:dim], size)}), *words)
        flat = {"Shape": "half space", "Normal": (0,) * down + (-1,), "Point": (0,) * down + (size[-1],), "Displacement": " ; ".join(["0"] * down + ["-0.005*t"])}
        warns(laws, f"{dim}D, a flat punch", laws.run({**scene, "Body block": box((2, 1, 1)[:dim], size), "Obstacle roller": flat}))


def facets(laws):
    rollers(laws)
    """Facets that are taken for gaps are told; where gaps are plane, resolved or written down, there is no word."""
    warns(laws, "rings drawn to touch", laws.run(rings()), "contact 'joint': facets stand off", "more than a tenth")
    warns(laws, "rings with a Gap", laws.run(merge(rings(), {"Contact joint": {"Gap": 0}})))
    hinge = {"Kind": "bilateral", "Friction coefficient": None}
    warns(laws, "a hinge of rings", laws.run(merge(rings(), {"Contact joint": hinge})), "contact 'joint': facets stand off", "moment about its own axis")
    fitted = merge(rings(), {"Body inner": quarter(.2, .62, 4, 2), "Contact joint": {"Largest interference": .05}})
    warns(laws, "a ring with an interference far above its facets", laws.run(fitted))
    fine = {"Body outer": quarter(.6, 1.0, 4, 3)}
    warns(laws, "a fine ring on the facets of a coarse one", laws.run(merge(fitted, fine)), "contact 'joint'", "up and down")
    bent_strips(laws)
    for name, cut in (("quadrilaterals", lambda body: body), ("triangles", simplices)):
        lower, upper = cut(box((8, 4), (2.0, 1.0))), cut(box((6, 3), (2.0, 1.0), (0.0, 1.0)))
        plane = {"Dimension": 2, "Body lower": lower, "Body upper": upper, "Contact joint": joint("upper", 2, "lower", 3),
                 "Support floor": support(2, "x, y", body="lower"), "Load press": load("pressure", "10*t", 3, "upper"),
                 "Support side": support(0, "x", body="upper"), "Output": {"VTU": 0}}
        found = [line for line in warnings_of(laws.run(plane)) if "facets" in line]
        laws.demand(f"plane faces of {name}: no word of facets", not found)
    second = {f"Body {body}": {"Element": "Q2"} for body in ("outer", "inner")}
    warns(laws, "faces of second degree follow their circles", laws.run(merge(rings(1), second)))
    plane = {"Dimension": 2, "Body block": {**box((4, 2), (2.0, 1.0)), "Element": "Q2"}, "Obstacle floor": floor(2), "Contact sole": contact("block", 2),
             "Support side": support(0, "x"), "Load press": load("pressure", "10*t", 3), "Output": {"VTU": 0}}
    warns(laws, "plane faces of second degree", laws.run(plane))


def pin_with_clearance(refinements):
    """Half of a pin in a wider bore, drawn to touch at the bottom and pressed there."""
    steel = {"Young modulus": 1000.0, "Poisson ratio": .3}
    return {"Dimension": 2, "Output": {"VTU": 0},
            "Body pin": {"Mesh": {"Generator": "half_hyper_ball", "Arguments": "0, 0 : 0.9", "Global refinements": refinements,
                                  "Translation": (0.0, -.1)}, "Material": steel},
            "Body bore": {"Mesh": {"Generator": "half_hyper_shell", "Arguments": "0, 0 : 1 : 3 : 8 : true",
                                   "Global refinements": refinements}, "Material": steel},
            "Contact joint": {**joint("pin", 0, "bore", 0), "Gap": "adjust"}, "Support bore": support(1, "x, y", body="bore"),
            "Support pin": support(1, "x", body="pin"), "Support sides": support("2, 3", "x", body="bore"),
            "Load weight": load("body force", "0 ; -t", body="pin")}


def adjusted(laws):
    """Rings that are drawn to touch do so by Gap = adjust, however they are paired."""
    for name, entries in (("mortar", {}), ("node to face", {"Pairing": "node to face"})):
        run, written = (laws.run(merge(rings(), {"Contact joint": {"Gap": gap, **entries}})) for gap in ("adjust", "0"))
        laws.same(f"rings by {name}: as with a Gap of 0", run, written, 1e-9)
    rows = laws.run(merge(rings(), {"Contact joint": {"Gap": "adjust", "Kinematics": "finite sliding"}})).rows
    pressures = [row["pressure"] for row in rows if row["contact"] == "joint"]
    laws.check("rings that slide: pressures differ by", max(pressures) / min(pressures) - 1, 5e-3)
    warns(laws, "a pin with clearance on coarse facets", laws.run(pin_with_clearance(3)), "contact 'joint'", "Gap = adjust closes")
    fine = laws.run(pin_with_clearance(5))
    peak = max((row for row in fine.rows if row["contact"] == "joint"), key=lambda row: row["pressure"])
    laws.check("  on fine ones: the largest pressure is below it, off by", abs(peak["x"]), .05)
    apart = merge(rings(), {"Body inner": quarter(.2, .59, 4, 2), "Contact joint": {"Gap": "adjust"}, "Load press": {"Value": "1e5*t"}})
    laws.demand("rings apart by more than facets: the gap stays", all(row["state"] == "open" and row["gap"] > .005 for row in laws.run(apart).rows))
