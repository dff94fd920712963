# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles with edges, of files, that loads press, and that turn."""
import math

from support.logs import log_of
from support.scenes import box, contact, joint, load, merge, press_and_shear, support
from support.surfaces import ball, brick, write_binary_stl, write_msh, write_obj, write_stl


def layer(dim, obstacle, cells=None, mu=0.0):
    """A layer from z = -1 (2D: y) to 0, held below, under an obstacle."""
    size = (2.0, 1.0) if dim == 2 else (2.0, 2.0, 1.0)
    cells = cells or ((16, 6) if dim == 2 else (10, 10, 4))
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    return {"Dimension": dim,
            "Body block": box(cells, size, (-1.0,) * dim),
            "Obstacle punch": obstacle,
            "Contact top": contact(ids=top, obstacle="punch", mu=mu),
            "Support bottom": support(bottom, "x, y" if dim == 2 else "x, y, z"),
            "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}


def along_last(dim, value):
    return " ; ".join(["0"] * (dim - 1) + [value])


def shapes(laws):
    """Cones, boxes and surfaces of files beside the same shape in other words."""
    cone = {"Shape": "cone", "Point": (.1, .1, .0), "Axis": (0, 0, 1), "Half angle": 85.0,
            "Displacement": along_last(3, "-0.03*t")}
    implicit = {"Shape": "implicit", "Displacement": cone["Displacement"],
                "Function": "cos(85*pi/180)*sqrt((x - 0.1)^2 + (y - 0.1)^2) - sin(85*pi/180)*z"}
    a = laws.run(layer(3, cone))
    laws.same("cone and implicit cone", a, laws.run(layer(3, implicit)), 1e-6)
    laws.demand("the cone touches here and not there", 0 < sum(row["r_n"] > 0 for row in a.rows) < len(a.rows))
    wedge = {"Shape": "cone", "Point": (.01, .0), "Axis": (0, 1), "Half angle": 80.0, "Apex radius": .5,
             "Displacement": "0 ; -0.01*t"}
    blunt = {"Shape": "implicit", "Displacement": wedge["Displacement"],
             # a disk between its tangents
             "Function": "if(abs(x - 0.01) < 0.5*cos(80*pi/180), sqrt((x - 0.01)^2 + (y - 0.5/sin(80*pi/180))^2) - 0.5, "
                         "cos(80*pi/180)*abs(x - 0.01) - sin(80*pi/180)*y)"}
    laws.same("rounded wedge and its parts", laws.run(layer(2, wedge)), laws.run(layer(2, blunt)), 1e-8)

    low, high = (-.53, -.47, .0), (.51, .55, .5)
    middle = tuple((a + b) / 2 for a, b in zip(low, high))
    sizes = tuple(b - a for a, b in zip(low, high))
    punch = {"Shape": "box", "Center": middle, "Sizes": sizes, "Displacement": along_last(3, "-0.01*t")}
    a = laws.run(layer(3, punch))
    points, faces = brick(low, high)
    for name, write in (("box.stl", write_stl), ("box.obj", write_obj), ("box.msh", write_msh)):
        write(laws.folder / name, points, faces)
        file = {"Shape": "surface mesh", "File": name, "Displacement": punch["Displacement"]}
        laws.same(f"box and {name}", a, laws.run(layer(3, file)), 1e-10)
    # half the size, turned by a right angle, moved back
    write_msh(laws.folder / "small.msh", [(p[1] / 2, -p[0] / 2, p[2] / 2 - 1) for p in points], faces, version=4)
    laws.same("a file that is scaled, turned and moved", a, laws.run(layer(3, {
        "Shape": "surface mesh", "File": "small.msh", "Scale": 2.0, "Rotation": (0, 0, 1, 90),
        "Translation": (0, 0, 2), "Displacement": punch["Displacement"]})), 1e-10)
    write_msh(laws.folder / "line.msh", [(-.53, .0, 0), (.53, .0, 0), (.53, .4, 0), (-.53, .4, 0)],
              [(0, 1), (1, 2), (2, 3), (3, 0)])
    plane = {"Shape": "box", "Center": (0, .2), "Sizes": (1.06, .4), "Displacement": "0 ; -0.01*t"}
    laws.same("rectangle and lines of a file", laws.run(layer(2, plane)), laws.run(layer(2, {
        "Shape": "surface mesh", "File": "line.msh", "Displacement": plane["Displacement"]})), 1e-10)

    sphere = {"Shape": "sphere", "Center": (0, 0, 1.0), "Radius": 1.0, "Displacement": along_last(3, "-0.05*t")}
    force = sum(row["r_n"] for row in laws.run(layer(3, sphere)).rows)
    errors = []
    for refinements in (2, 3, 4):
        write_binary_stl(laws.folder / "ball.stl", *ball(1.0, refinements))
        run = laws.run(layer(3, merge(sphere, {"Shape": "surface mesh", "File": "ball.stl", "Translation": (0, 0, 1.0),
                                              "Center": None, "Radius": None})))
        errors.append(abs(sum(row["r_n"] for row in run.rows) / force - 1))
    laws.demand("a ball of facets: force off by " + ", ".join(f"{e:.2g}" for e in errors),
                all(b < .5 * a for a, b in zip(errors, errors[1:])))
    laws.check("the finest ball", errors[-1], .02)


def energy(run):
    """Largest gap of the energy balance over the largest work."""
    before = gap = work = 0.0
    for row in run.increments:
        change = row["strain_energy"] - before
        before = row["strain_energy"]
        gap = max(gap, abs(row["external_work"] - change - row["dissipation"] - row["contact_work_normal"]))
        work = max(work, abs(row["external_work"]))
    return gap / work


def corner_blocks(dim, places):
    """Blocks that stand on a corner each, with the other corner up at height 1."""
    side = 1 / math.sqrt(dim)
    turn = 45.0 if dim == 2 else (1, -1, 0, math.degrees(math.acos(1 / math.sqrt(3))))
    scene = {"Dimension": dim, "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}
    for i, place in enumerate(places):
        scene[f"Body block {i}"] = box((2,) * dim, (side,) * dim, Rotation=turn, Translation=place + (0,))
        scene[f"Contact {i}"] = contact(f"block {i}", "1, 3" if dim == 2 else "1, 3, 5", "plate")
        scene[f"Support {i}"] = support("0, 2" if dim == 2 else "0, 2, 4", "x, y" if dim == 2 else "x, y, z",
                                        body=f"block {i}")
    return scene


def free_obstacles(laws):
    """What statics says of obstacles that loads press."""
    spun_ball(laws)
    for dim in (2, 3):
        sphere = {"Shape": "sphere", "Center": (.1,) * (dim - 1) + (1.0,), "Radius": 1.0}
        pressed = layer(dim, sphere | {"Free": "xyz"[dim - 1], "Force": along_last(dim, "-7*t")}, mu=.2)
        run = laws.run(pressed)
        last = run.increments[-1]
        axis = "xyz"[dim - 1]
        laws.check(f"{dim}D, sphere pressed by 7: contact force", abs(last[f"top_f_{axis}"] + 7), 7e-10)
        laws.check(f"{dim}D: force on the obstacle", abs(last[f"obstacle_punch_f_{axis}"] - 7), 7e-10)
        laws.check(f"{dim}D: energy", energy(run), 1e-9)
        laws.same(f"{dim}D: the same without condensing", run, laws.run(merge(pressed, {"Solver": {"Backend": "iterative"}})), 1e-9)
        moved = last[f"obstacle_punch_u_{axis}"]
        laws.same(f"{dim}D: the same by its displacement {moved:.6g}", run,
                  laws.run(layer(dim, sphere | {"Displacement": along_last(dim, f"({moved!r})*t")}, mu=.2)), 1e-9)

    # a plate on corners: levers
    places, at, moment = [(0.0, 0.0), (3.0, 0.2), (1.0, 2.5)], (1.2, .7), (.4, -.3)
    scene = corner_blocks(3, places)
    scene["Obstacle plate"] = {"Shape": "half space", "Normal": (0, 0, -1), "Point": (0, 0, 1), "Free": "z, rx, ry",
                               "Reference point": at + (1.0,), "Force": "0 ; 0 ; -6*t",
                               "Moment": f"{moment[0]}*t ; {moment[1]}*t ; 0"}
    run = laws.run(scene)
    # N_i: sum N = 6, sum N y = 6 y_at - M_x, sum N x = 6 x_at + M_y
    sums = [6.0, 6 * at[0] + moment[1], 6 * at[1] - moment[0]]
    rows = [[1.0, 1.0, 1.0], [p[0] for p in places], [p[1] for p in places]]

    def det(m):
        return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
                   for i in range(3))

    for i in range(3):
        exact = det([[sums[r] if c == i else rows[r][c] for c in range(3)] for r in range(3)]) / det(rows)
        found = -run.increments[-1][f"{i}_f_z"]
        laws.check(f"plate on three corners: reaction {i} is {exact:.6g}", abs(found - exact), 6e-10)
    laws.demand("one node each touches", sum(row["r_n"] > 0 for row in run.rows) == 3)
    laws.check("its balance", run.increments[-1]["balance_plate"], 1e-10)
    laws.check("its energy", energy(run), 1e-9)

    scene = corner_blocks(2, [(0.0,), (2.0,)])
    scene["Obstacle plate"] = {"Shape": "box", "Center": (1.0, 1.2), "Sizes": (4.0, .4), "Free": "y, rz",
                               "Reference point": (.5, 1.2), "Force": "0 ; -4*t", "Moment": "1*t"}
    last = laws.run(scene).increments[-1]
    # about the left corner: 2 N_1 + 1 = 4 * .5
    laws.check("a beam on two corners", max(abs(last["1_f_y"] + .5), abs(last["0_f_y"] + 3.5)), 4e-10)

    # friction holds a plate
    plate = {"Shape": "half space", "Normal": (0, -1), "Point": (0, 0), "Free": "x, y"}
    held = layer(2, plate | {"Force": "2.9*max(t - 1, 0) ; -10*min(t, 1)"}, mu=.3)
    held["Time"] = {"End": 2, "Increments": 4}
    run = laws.run(held)
    laws.check("friction holds the plate", abs(run.increments[-1]["obstacle_punch_f_x"] + 2.9), 1e-9)
    laws.check("its energy", energy(run), 1e-9)
    for name, force, sentence in (("slides", "3.1*max(t - 1, 0) ; -10*min(t, 1)", "obstacle 'punch' slides along (1, 0, 0)"),
                                  ("lifts", "0 ; 10*(t - 1.2)", "obstacle 'punch' lifts off, moving along (0, 1, 0)")):
        done, _ = laws.start(merge(held, {"Obstacle punch": {"Force": force}}))
        laws.demand(f"a plate that {name} is refused: {done.stderr.strip()}",
                    done.returncode == 2 and sentence in done.stderr)
    slides_on_a_dent(laws)


def spun_ball(laws):
    """A ball that turns about its own axis is no deeper between nodes than it was."""
    radius = 8.0
    ball_on_top = {"Shape": "sphere", "Center": (.1, .1, radius), "Radius": radius, "Reference point": (.1, .1, 0.0), "Free": "z, rz",
                   "Force": "0 ; 0 ; -7*min(t,1)", "Moment": "0 ; 0 ; .5*max(t-1,0)"}
    run = laws.run(merge(layer(3, ball_on_top, cells=(4, 4, 2), mu=.4), {"Time": {"Times": "1, 2"}}))
    laws.demand("a spun ball: no warning of depth", "deep in" not in log_of(run))


def slides_on_a_dent(laws):
    """A block of weight .96 on one that its weight dents slides from .384 on; it would tip from 1.44 on."""
    soft = {"Dimension": 2, "Obstacle floor": {"Shape": "half space", "Normal": (0, 1)},
            "Body lower": box((21, 9), (2.0, 1.0)), "Body upper": box((16, 7), (1.2, .8), (.3, 1.0), young=500.0),
            "Contact ground": contact("lower", mu=.5, Kinematics="finite sliding"),
            "Contact joint": joint("upper", 2, "lower", 3, Kinematics="finite sliding") | {"Friction coefficient": .4,
                                                                                           "Pairing": "node to face"},
            "Load w1": load("body force", "0 ; -1", body="lower"), "Load w2": load("body force", "0 ; -1", body="upper"),
            "Load push": load("pressure", "0.25*t", 0, "upper"),
            "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    done, _ = laws.start(soft)
    laws.demand(f"a block that slides on a dent is refused: {done.stderr.strip()}",
                done.returncode == 2 and "body 'upper' slides along (1," in done.stderr and
                abs(float(done.stderr.split("at most ")[1].split(". ")[0]) - .92) < 5e-3)


def turning(laws):
    """An obstacle that turns is one whose gaps change by its angle."""
    for dim in (2, 3):
        scene = press_and_shear(dim, mu=0.0)
        angle, c = 1.0, 1.0 if dim == 2 else .5
        sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
        turned = merge(scene, {"Obstacle floor": {"Turn": f"{angle}*min(t, 1)", "Turn axis": (0, 0, 1) if dim == 2 else
                                                  (0, 1, 0), "Reference point": (c, .2) if dim == 2 else (c, .5, .2)}})
        for tree in (scene, turned):
            tree["Time"] = {"Times": "1"}
        turned["Contact bottom"]["Kinematics"] = "small"  # gaps that are stated are those of undeformed nodes
        # the foot (x, 0) rises by sin (x - c), less what its lever to c sinks; about y it sinks
        side = sine if dim == 2 else -sine
        gap = f"{'y' if dim == 2 else 'z'} - ({side!r}*(x - {c!r}) + {-.2 * (cosine - 1)!r})"
        stated = merge(scene, {"Obstacle floor": {"Shape": "prescribed gap", "Gap": gap}})
        a, b = laws.run(turned), laws.run(stated)
        first = {key: row["r_n"] for key, row in a.at().items()}
        second = {key: row["r_n"] for key, row in b.at().items()}
        laws.check(f"{dim}D, turned floor: reactions", max(abs(first[k] - second[k]) for k in first) /
                   max(first.values()), 1e-10)
        laws.demand(f"{dim}D: it touches on one side", 0 < sum(r > 0 for r in first.values()) < len(first))
        laws.check(f"{dim}D: energy", energy(a), 1e-9)
    rough = merge(scene, {"Contact bottom": {"Friction coefficient": .3},
                          "Obstacle floor": {"Turn": "0.2*t", "Turn axis": (0, 0, 1), "Reference point": (.7, .5, 0)}})
    rough["Time"] = {"End": 2, "Increments": 4}
    run = laws.run(rough)
    laws.check("a floor that turns about its normal: energy", energy(run), 1e-9)
    laws.demand("and twists the block", abs(run.increments[-1]["bottom_m_z"]) > 1e-3)
    far = merge(scene, {"Obstacle floor": {"Turn": "-12*t", "Turn axis": (0, 1, 0)}})
    far["Contact bottom"]["Kinematics"] = "small"
    said = [line for line in log_of(laws.run(far)).splitlines() if line.startswith("warning: contact 'bottom'")]
    laws.demand(f"a turn too large is warned of once: {said}", len(said) == 1 and "obstacle 'floor' turns" in said[0])
