# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finite sliding: contacts that are found again where bodies and obstacles are."""
import math

from laws.scene_pictures import field, read
from support.logs import log_of, work_of
from support.scenes import box, contact, load, merge, press_and_shear, support
from support.tables import MOTION, in_space, normal
from support.vectors import apply, plus, rotation, unit

FAR = {"Kinematics": "finite sliding"}


def sliding(laws):
    planes(laws)
    swept_disc(laws)
    rolled_ball(laws)
    hill(laws)
    slabs(laws)
    leave_and_return(laws)
    halves(laws)
    soft_slab(laws)
    held_beside(laws)


def planes(laws):
    """Nothing changes where small sliding is exact: planes, and gaps that are written down."""
    for dim in (2, 3):
        for name, obstacle in (("plane", {}), ("tilted plane", {"Normal": (.05, 1.0) if dim == 2 else (.05, .02, 1.0)}),
                               ("prescribed gap", {"Shape": "prescribed gap", "Gap": "0.002*x"})):
            scene = press_and_shear(dim)
            scene["Obstacle floor"].update(obstacle)
            if name == "plane":  # several lengths of the block
                scene["Support top"]["Displacement"] = scene["Support top"]["Displacement"].replace("0.004", "4.0")
            laws.same(f"{dim}D, {name}", laws.run(scene), laws.run(merge(scene, {"Contact bottom": FAR})), 1e-9)


def place_of(row, dim):
    """Where a row's node is, relative to its opponent."""
    return plus((row["x"], row["y"], row["z"]), in_space(row, dim, MOTION))


def touching(run):
    return [row for row in run.rows if row["state"] != "open"]


def meets(laws, what, run, distance, gradient):
    """Nodes that touch are on the surface, their normals are its own."""
    rows = touching(run)
    places = [place_of(row, run.dim) for row in rows]
    laws.check(f"{what}: {len(rows)} rows that touch are on it", max(abs(distance(p)) for p in places), 1e-9)
    laws.check(f"{what}: their normals",
               max(math.dist(unit(gradient(p)), normal(row)) for p, row in zip(places, rows)), 1e-7)


def energy_error(run):
    """Work that is neither stored nor spent in contacts, over the largest energy."""
    before = worst = 0.0
    for row in run.increments:
        rest = row["external_work"] - (row["strain_energy"] - before) - row["dissipation"] - row["contact_work_normal"]
        before, worst = row["strain_energy"], max(worst, abs(rest))
    return worst / max(row["strain_energy"] for row in run.increments)


def slip_error(run, mu, after):
    """How far rows that touch after a time are from the cone."""
    return max(abs(math.hypot(row["r_t1"], row["r_t2"]) - mu * row["r_n"])
               for row in run.rows if row["time"] > after) / run.largest("r_n")


def disc(increments, way=3.75, mu=.3, degrees=0.0):
    """A disc is pressed into a layer 8 long and 1 high, then moved along it."""
    m = rotation((0, 0, 1), degrees)

    def functions(x, y):
        return " ; ".join(f"({m[d][0]!r})*({x}) + ({m[d][1]!r})*({y})" for d in range(2))
    return {"Dimension": 2, "Body layer": box((64, 8), (8.0, 1.0), (-4.0, -1.0), Rotation=degrees),
            "Obstacle disc": {"Shape": "cylinder", "Radius": 8.0, "Point": apply(m, (-way / 2, 8.0, 0.0))[:2],
                              "Displacement": functions(f"{way!r}*max(t - 1, 0)", "-0.04*min(t, 1)")},
            "Contact top": contact("layer", 3, "disc", mu, **FAR), "Support base": support(2, "x, y", body="layer"),
            "Time": {"Stages": f"1 : 2, 2 : {increments}"}, "Output": {"VTU": 0}}


def swept_disc(laws):
    run = laws.run(disc(30))
    late = [row for row in run.increments if row["time"] > 1.3]
    forces = [-row["top_f_y"] for row in late]
    laws.check("disc swept by 30 cells: normal force", (max(forces) - min(forces)) / max(forces), .01)
    meets(laws, "disc", run, lambda p: math.dist(p[:2], (-3.75 / 2, 8.0)) - 8, lambda p: (p[0] + 3.75 / 2, p[1] - 8, 0))
    laws.check("disc: it slides fully", slip_error(run, .3, 1.3), 1e-9)
    laws.check("disc: energies", energy_error(run), 1e-9)
    laws.same("disc, turned", run, laws.run(disc(30, degrees=37.0)), 1e-8, matrix=rotation((0, 0, 1), 37.0))
    laws.check("disc: factorisations", work_of(run)["factorisations of the elastic system"], 1)
    ends = [laws.run(disc(n, 1.0)).increments[-1]["top_f_x"] for n in (4, 16)]
    laws.check("disc: once it slides fully the increments do not matter", abs(ends[0] / ends[1] - 1), 1e-8)


def rolled_ball(laws):
    def ball(axis=(0, 0, 1), degrees=0.0):
        m = rotation(axis, degrees)
        moves = "1.6*max(t - 1, 0)", "0.2*max(t - 1, 0)", "-0.06*min(t, 1)"
        return {"Dimension": 3, "Body layer": box((9, 4, 3), (3.6, 1.6, .8), (-1.8, -.8, -.8),
                                                  Rotation=(*map(float, axis), degrees)),
                "Obstacle ball": {"Shape": "sphere", "Radius": 2.0, "Center": apply(m, (-.8, -.1, 2.0)),
                                  "Displacement": " ; ".join(" + ".join(f"({m[d][e]!r})*({move})" for e, move
                                                                        in enumerate(moves)) for d in range(3))},
                "Contact top": contact("layer", 5, "ball", .2, **FAR), "Support base": support(4, "x, y, z", body="layer"),
                "Time": {"Stages": "1 : 2, 2 : 8"}, "Output": {"VTU": 0}}
    run = laws.run(ball())
    arm = (.8, .1, -2.0)
    meets(laws, "ball", run, lambda p: math.hypot(*plus(p, arm)) - 2, lambda p: plus(p, arm))
    laws.check("ball: energies", energy_error(run), 1e-9)
    axis, degrees = (1, 2, 3), 23.7
    laws.same("ball, turned", run, laws.run(ball(axis, degrees)), 1e-8, matrix=rotation(axis, degrees))


def hill(laws):
    """A block is drawn over a hill from one valley to the next."""
    def height(x):
        return .1 * (1 - math.cos(math.pi * x))

    def scene(mu, increments):
        return {"Dimension": 2, "Body block": box((2, 2), (.2, .2), (-.1, .005), 1e5, **{"Boundary ids": "7: x < -0.09 && y > 0.1"}),
                "Obstacle hill": {"Shape": "implicit", "Function": "y - 0.1*(1 - cos(pi*x))"},
                "Contact bottom": contact(obstacle="hill", mu=mu, **FAR),
                "Support left": support(7, "x", "2*max(t - 1, 0)"), "Load weight": load("pressure", "min(t, 1)", 3),
                "Time": {"Stages": f"1 : 1, 2 : {increments}"}, "Output": {"VTU": 0}}
    for mu in (0.0, .2):
        run = laws.run(scene(mu, 40))
        meets(laws, f"hill, mu {mu}", run, lambda p: p[1] - height(p[0]),
              lambda p: (-.1 * math.pi * math.sin(math.pi * p[0]), 1, 0))
        laws.check(f"hill, mu {mu}: it carries the weight", max(abs(row["bottom_f_y"] / .2 - 1) for row in run.increments), 1e-9)
        laws.check(f"hill, mu {mu}: energies", energy_error(run), 1e-8)
    for n in (20, 40, 80):  # weight .2 over a hill of height .2, and back to where it was
        work = sum(row["external_work"] for row in laws.run(scene(0.0, n)).increments if row["time"] > 1)
        laws.check(f"hill, {n} increments: work without friction falls as they do", n * abs(work) / .04, .05)


def slab(scene, cells, size, origin, held="both", **entries):
    """The scene with a second body in place of its floor."""
    dim = scene["Dimension"]
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    ids = f"{bottom}, {top}" if held == "both" else bottom
    scene = merge(scene, {"Obstacle floor": None, "Contact bottom": {"Obstacle": "", "Master body": "slab",
                                                                     "Master boundary ids": top, **FAR, **entries}})
    return {**scene, "Body slab": box(cells, size, origin),
            "Support slab": support(ids, "x, y" if dim == 2 else "x, y, z", body="slab")}


def of_body(run):
    run.rows = [row for row in run.rows if row["contact"] == "bottom"]
    return run


def slabs(laws):
    """A slab that is held all over is a plane."""
    for dim in (2, 3):
        scene = press_and_shear(dim, increments=8)
        scene["Support top"]["Displacement"] = scene["Support top"]["Displacement"].replace("0.004", "0.43")
        plane = laws.run(scene)
        for pairing in ("node to face", "mortar"):
            other = slab(scene, *(((28, 1), (7.0, .5), (-1.0, -.5)) if dim == 2 else
                                  ((13, 11, 1), (6.5, 4.4, .5), (-1.0, -1.0, -.5))), Pairing=pairing)
            laws.same(f"{dim}D, slab, {pairing}", plane, of_body(laws.run(other)), 1e-8)
    # hanging nodes, of which surfaces know the masters only
    refined = {"Body block": {"Mesh": {"Refinement boxes": "0, 0, 0 : 0.6, 0.6, 0.3 : 1"}}}
    other = slab(merge(scene, refined), (13, 11, 1), (6.5, 4.4, .5), (-1.0, -1.0, -.5))
    forces = [[row["bottom_f_z"] for row in laws.run(s).increments] for s in (merge(scene, refined), other)]
    laws.check("3D, slab, hanging nodes: normal force beside that of a plane", max(abs(a / b - 1) for a, b in zip(*forces)), 2e-3)


def leave_and_return(laws):
    """A block leaves a slab and comes back to it."""
    for pairing in ("node to face", "mortar"):
        scene = press_and_shear(2, mu=0.0, increments=17)
        scene["Support top"]["Displacement"] = "if(t < 9, 0.44*max(t - 1, 0), 0.44*(17 - t)) ; -0.01*min(t, 1)"
        # no node comes to stand on an edge between faces, where normals jump
        run = laws.run(slab(scene, (12, 2), (3.0, 1.0), (-.53, -1.0), "bottom", Pairing=pairing))
        forces = [row["bottom_f_y"] for row in run.increments]
        laws.check(f"leave and return, {pairing}: the way back", max(abs(a - b) for a, b in zip(forces, forces[::-1])) / forces[0],
                   1e-8)
        laws.check(f"leave and return, {pairing}: nothing beyond", abs(forces[8]), 0)
        gaps = {k: [row["gap"] for row in of_body(run).rows if row["increment"] == k] for k in (1, 9)}
        laws.demand("  and no gap to it", all(math.isnan(gap) for gap in gaps[9]) and all(gap == 0 for gap in gaps[1]))
    drawn = laws.run(merge(slab(scene, (12, 2), (3.0, 1.0), (-.53, -1.0), "bottom"), {"Time": {"End": 9, "Increments": 9}, "Output": {"VTU": 9}}))
    laws.demand("  nor in pictures", all(math.isnan(gap) for gap in field(read(drawn.folder / "surface-block-0009.vtu"), "gap")))


def halves(laws):
    """Half of a block that leaves half of a slab over its end: nodes in the plane of symmetry keep their unknowns on the way."""
    def scene(pairing, whole):
        start, n = (-.5, 2) if whole else (0.0, 1)
        sides = {} if whole else {f"Support side {body}": support(2, "y", body=body) for body in ("block", "slab")}
        return {"Dimension": 3, "Body block": box((3, 3 * n, 2), (1.0, .5 * n, .5), (0.0, start, 0.0)),
                "Body slab": box((5, 2 * n, 2), (1.7, .5 * n, .5), (-.4, start, -.5)),
                "Support top": support(5, "x, y, z", "0.5*max(t - 1, 0) ; 0 ; -0.004*min(t, 1)"), "Support base": support(4, "x, y, z", body="slab"),
                **sides, "Contact bottom": {"Body": "block", "Boundary ids": 4, "Master body": "slab", "Master boundary ids": 5,
                                            "Friction coefficient": .3, "Pairing": pairing, **FAR},
                "Time": {"Times": "1, 1.3, 1.7, 2.1, 2.5"}, "Output": {"VTU": 0}}
    for pairing in ("node to face", "mortar"):
        half, whole = (laws.run(scene(pairing, w)).increments for w in (False, True))
        for axis in "xz":
            laws.check(f"halves, {pairing}: force along {axis} of the whole",
                       max(abs(2 * a[f"bottom_f_{axis}"] / b[f"bottom_f_{axis}"] - 1) for a, b in zip(half, whole)), 1e-7)


def soft_slab(laws):
    """A block is drawn round a closed path on an elastic slab."""
    sums = []
    for pairing in ("node to face", "mortar"):
        scene = press_and_shear(2, mu=.3, increments=21)
        scene["Support top"]["Displacement"] = "0.9*sin(pi*max(t - 1, 0)/10) ; -0.02*min(t, 1)"
        run = laws.run(slab(scene, (26, 4), (6.5, 1.0), (-2.25, -1.0), "bottom", Pairing=pairing))
        laws.check(f"soft slab, {pairing}: energies", energy_error(run), 1e-9)
        laws.check(f"soft slab, {pairing}: balance", max(row[f"balance_{b}"] for row in run.increments
                                                         for b in ("block", "slab")), 1e-10)
        laws.admissible(f"soft slab, {pairing}", of_body(run), lambda row: .3)
        sums.append([row["bottom_f_y"] for row in run.increments])
    laws.check("soft slab: normal force of both pairings", max(abs(a / b - 1) for a, b in zip(*sums)), .02)


def held_beside(laws):
    """All faces of a block are in the contact, also one by which a support draws it: it holds nodes along their normals that face nothing."""
    for dim in (2, 3):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        scene = {"Dimension": dim, "Body block": box((4, 3, 3)[:dim], (1.0, .5, .5)[:dim]),
                 "Body slab": box((9, 2, 2)[:dim], (3.0, .5, .5)[:dim], (-1.7,) + (0.0,) * (dim - 2) + (-.5,)),
                 "Support draw": support(0, "x", "-0.8*max(t - 1, 0)", body="block"),
                 "Support base": support(bottom, "x, y, z"[:3 * dim - 2], body="slab"),
                 "Load weight": load("traction", "; ".join(["0"] * (dim - 1) + ["-0.01*min(t, 1)"]), top),
                 "Contact bottom": {"Body": "block", "Boundary ids": ", ".join(str(i) for i in range(2 * dim)), "Master body": "slab",
                                    "Master boundary ids": top, "Friction coefficient": .3, "Reach": .2},
                 "Time": {"End": 2, "Increments": 10}, "Output": {"VTU": 0}}
        weight = .01 * (1 if dim == 2 else .5)
        for pairing in ("mortar", "node to face"):
            what = f"{dim}D, held beside, {pairing}"
            run = laws.run(merge(scene, {"Contact bottom": {"Pairing": pairing}}))
            laws.demand(f"{what}: it slides far", "finite sliding" in log_of(run))
            up, along = ("y", "x") if dim == 2 else ("z", "x")
            laws.check(f"{what}: the weight", abs(run.increments[-1][f"bottom_f_{up}"] / weight - 1), 1e-9)
            laws.check(f"{what}: friction", abs(run.increments[-1][f"bottom_f_{along}"] / (.3 * weight) - 1), 1e-5)
    notch = {"Mesh": {"Generator": "hyper_L", "Arguments": "0 : 2 : false", "Global refinements": 3}, "Material": scene["Body slab"]["Material"]}
    done, _ = laws.start({"Dimension": 2, "Body block": box((3, 3), (.3, .3), (1.2, 1.0)), "Body notch": notch,
                          "Support draw": support(0, "x", "-0.21*t", body="block"), "Support base": support(0, "x, y", body="notch"),
                          "Load weight": load("traction", "0 ; -0.01", 3),
                          "Contact corner": {"Body": "block", "Boundary ids": "0, 2", "Master body": "notch", "Master boundary ids": 0,
                                             "Friction coefficient": .3, "Reach": .05, **FAR},
                          "Time": {"Increments": 10}, "Output": {"VTU": 0}})
    laws.demand(f"held nodes that come to a wall: {done.stderr.strip()}",
                done.returncode == 2 and "a support holds the contact node at" in done.stderr)
