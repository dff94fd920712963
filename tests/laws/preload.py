# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ties that a force draws together: bars and joints of bars in closed form."""
import math

from laws.driven import energy
from laws.iterative import backend, iterations
from laws.tie import tie
from support.scenes import box, contact, joint, load, merge, support

E, FORCE, LENGTH = 1000.0, 3.0, 2.0
JOINT = "joint"


def stress_body(cells, size, origin, dim, young=E, poisson=.3, thickness=.5, **mesh):
    body = box(cells, size, origin, young, poisson, **mesh)
    if dim == 2:
        body["Material"].update(Plane="stress", Thickness=thickness)
    return body


def bar(dim, exchanged=False, **entries):
    """Two halves of a bar along the last axis between rollers; sides on planes of symmetry."""
    last = dim - 1
    size, halves = (1.0,) * dim, {"lower": (3, 2, 2)[:dim], "upper": (2, 3, 2)[:dim]}
    pair = (("upper", 2 * last), ("lower", 2 * last + 1))
    slave, master = pair[::-1] if exchanged else pair
    scene = {"Dimension": dim, f"Contact {JOINT}": tie(*slave, *master, Preload=f"{FORCE!r}*min(t, 1)", **entries),
             "Support foot": support(2 * last, "normal", body="lower"),
             "Support head": support(2 * last + 1, "normal", "0.002*max(t - 1, 0)", body="upper"),
             "Time": {"End": 2, "Increments": 4}, "Output": {"VTU": 0}}
    for name, cells in halves.items():
        origin = (0.0,) * last + (0.0 if name == "lower" else 1.0,)
        scene[f"Body {name}"] = stress_body(cells, size, origin, dim)
        scene[f"Support side {name}"] = support("0" if dim == 2 else "0, 2", "normal", body=name)
    return scene


def column(run, name):
    return [row[f"preload_{JOINT}_{name}"] for row in run.increments]


def bars(laws):
    for dim in (2, 3):
        area = .5 if dim == 2 else 1.0
        k = E * area / LENGTH
        axis = {"Preload axis": (0, 0, -2.5)[3 - dim:]}
        for exchanged, entries in ((False, {}), (True, {}), (False, axis)):
            what = f"{dim}D bar{', exchanged' * exchanged}{', axis given' * bool(entries)}"
            run = laws.run(bar(dim, exchanged, **entries))
            tension = [FORCE * min(row["time"], 1) for row in run.increments]
            pulled = [.002 * max(row["time"] - 1, 0) for row in run.increments]
            laws.check(f"{what}: tension", max(abs(f - t) for f, t in zip(column(run, "force"), tension)) / FORCE, 1e-10)
            laws.check("  shortening F L / (E A), less what the head moves",
                       max(abs(s - t / k + d) for s, t, d in zip(column(run, "shortening"), tension, pulled)) / (FORCE / k), 1e-10)
            last, name = run.increments[-1], "xyz"[dim - 1]
            laws.check("  both sides and the foot",
                       max(abs(abs(last[f"{c}_f_{name}"]) - FORCE) for c in (JOINT, f"{JOINT}_master", "support_foot")) / FORCE, 1e-10)
            laws.check("  stresses of the cut", max(abs(row["r_n"] / row["area"] + FORCE / area) for row in run.last()
                                                    if row["contact"] == JOINT) / FORCE * area, 1e-10)
            laws.check("  work", energy(run), 1e-10)
            locked = laws.run(bar(dim, exchanged, **entries, **{"Preload locked from": 1}))
            expected = [t + k * d for t, d in zip(tension, pulled)]
            laws.check("  locked: tension follows the head",
                       max(abs(f - t) for f, t in zip(column(locked, "force"), expected)) / FORCE, 1e-10)
            laws.check("  locked: shortening stays",
                       max(abs(s - t / k) for s, t in zip(column(locked, "shortening"), tension)) / (FORCE / k), 1e-10)
            laws.check("  locked: work", energy(locked), 1e-10)
            laws.check("  locked: support of the head", abs(locked.increments[-1][f"support_head_f_{name}"] - expected[-1]) / FORCE, 1e-10)


def turned(laws):
    """The same along an oblique axis, which the faces tell."""
    scene, place = bar(2, **{"Preload locked from": 1}), (.3, -.2)
    for name in ("lower", "upper"):
        scene[f"Body {name}"]["Mesh"].update(Rotation=37.0, Translation=place)
    straight, oblique = laws.run(bar(2, **{"Preload locked from": 1})), laws.run(scene)
    for name in ("force", "shortening"):
        a, b = column(straight, name), column(oblique, name)
        laws.check(f"turned by 37 degrees: {name}", max(abs(x - y) for x, y in zip(a, b)) / max(a), 1e-10)


def clamped(areas, moduli, times, pull, dim=2, preload=FORCE, locked=1):
    """A bolt between two rigid plates, and two columns that they clamp; the upper one may move up and down."""
    bolt, column_area = areas
    scene = {"Dimension": 2, "Obstacle ground": {"Shape": "half space", "Normal": (0, 1)},
             "Obstacle plate": {"Shape": "half space", "Normal": (0, -1), "Point": (0, LENGTH), "Free": "y", "Force": f"0 ; {pull}"},
             f"Contact {JOINT}": tie("upper", 2, "lower", 3, Preload=f"{preload!r}*min(t, 1)", **{"Preload locked from": locked}),
             "Contact foot": {**contact("lower", 2, "ground"), "Kind": "tie"},
             "Contact head": {**contact("upper", 3, "plate"), "Kind": "tie"},
             "Time": {"Times": times}, "Output": {"VTU": 0}}
    for name, y in (("lower", 0.0), ("upper", 1.0)):
        scene[f"Body {name}"] = stress_body((2, 3), (bolt, 1.0), (-bolt / 2, y), 2, moduli[0], 0.0, 1.0)
    for name, x in (("left", -3.0), ("right", 2.0)):
        scene[f"Body {name}"] = stress_body((3, 4), (column_area / 2, LENGTH), (x, 0.0), 2, moduli[1], 0.0, 1.0)
        scene[f"Contact {name} below"] = contact(name, 2, "ground", mu=.2)
        scene[f"Contact {name} above"] = contact(name, 3, "plate", mu=.2)
    return scene


def joints(laws):
    """The joint diagram: a pull is shared by stiffness until the plates come apart, then the bolt has all of it."""
    areas, moduli = (.8, 2.6), (2000.0, 700.0)
    k_bolt, k_plates = (e * a / LENGTH for e, a in zip(moduli, areas))
    apart = FORCE * (k_bolt + k_plates) / k_plates
    run = laws.run(clamped(areas, moduli, ".5, 1, 1.5, 1.999, 2.001, 2.5", f"{apart!r}*max(t - 1, 0)"))
    scale = FORCE / k_bolt
    for row in run.increments:
        pull = apart * max(row["time"] - 1, 0)
        tension = FORCE * min(row["time"], 1) + pull * k_bolt / (k_bolt + k_plates) if pull < apart else pull
        laws.check(f"joint under {pull:.4g}: tension", abs(row[f"preload_{JOINT}_force"] - tension) / FORCE, 1e-10)
        shortening = FORCE * min(row["time"], 1) * (1 / k_bolt + 1 / k_plates)
        laws.check("  shortening", abs(row[f"preload_{JOINT}_shortening"] - shortening) / scale, 1e-10)
        clamp = sum(row[f"{name} below_f_y".replace(" ", "_")] for name in ("left", "right"))
        laws.check("  what the plates are pressed with", abs(clamp - max(tension - pull, 0)) / FORCE, 1e-10)
        laws.check("  foot of the bolt", abs(row["foot_f_y"] + tension) / FORCE, 1e-10)
    states = {row["state"] for row in run.last() if row["contact"].startswith(("left", "right"))}
    laws.demand("  apart at the end", states == {"open"})
    laws.check("joint: work", energy(run), 1e-10)

    # nodes that are found again beside a nut that is locked
    small = clamped(areas, moduli, "1, 2, 3", "2*max(t - 1, 0)")
    far = merge(small, {f"Contact {side} below": {"Kinematics": "finite sliding"} for side in ("left", "right")})
    small, far = (column(laws.run(scene), "force") for scene in (small, far))
    laws.check("joint with contacts that slide far: tension", max(abs(a - b) for a, b in zip(small, far)) / FORCE, 1e-8)

    # a bolt that is tightened while the plates are pulled: the force is its own
    free = laws.run(clamped(areas, moduli, "1, 2", "2*max(t - 1, 0)", locked=""))
    laws.check("joint that is not locked: tension", abs(column(free, "force")[-1] - FORCE) / FORCE, 1e-10)
    # clearance is closed before there is any force
    gap = .01
    loose = merge(clamped(areas, moduli, "1, 2", "0"), {"Obstacle plate": {"Point": (0, LENGTH + gap)}})
    for name in ("left", "right"):
        loose[f"Support {name}"] = support(0, "x", body=name)
    loose["Body upper"] = stress_body((2, 3), (areas[0], 1.0 + gap), (-areas[0] / 2, 1.0), 2, moduli[0], 0.0, 1.0)
    run = laws.run(loose)
    k_bolt = 1 / ((LENGTH + gap) / (moduli[0] * areas[0]))
    laws.check("with clearance: shortening", abs(column(run, "shortening")[0] - gap - FORCE * (1 / k_bolt + 1 / k_plates)) / gap, 1e-10)
    laws.check("  tension", abs(column(run, "force")[-1] - FORCE) / FORCE, 1e-10)


def restarted(laws):
    """A run that goes on from a checkpoint, before and after its nut is locked."""
    scene = merge(bar(2, **{"Preload locked from": 1}), {"Output": {"Checkpoint": 1}})
    whole = laws.run(scene)
    for end in (.5, 1.0, 1.5):
        done, folder = laws.start(merge(scene, {"Time": {"End": end, "Increments": int(2 * end)}}))
        again, other = laws.start(scene, "--restart", folder)
        if done.returncode + again.returncode:
            laws.demand(f"restart at t = {end}: {done.stderr}{again.stderr}", False)
            continue
        run = type(whole)(other)
        for name in ("force", "shortening"):
            a, b = column(whole, name), column(run, name)
            laws.check(f"restart at t = {end}: {name}", max(abs(x - y) for x, y in zip(a, b)) / max(a), 1e-12)


def flanged(dim, n=1, **entries):
    """A bolt in two halves with a head, which clamps two plates at either side of it, all of them elastic; n of them in a row along x."""
    last, bottom, top, every = dim - 1, 2 * (dim - 1), 2 * dim - 1, "x, y, z"[:3 * dim - 2]
    scene = {"Dimension": dim, "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}

    def body(name, cells, size, origin, young):
        def deep(plane, across):
            return plane if dim == 2 else (plane[0], across, plane[1])
        scene[f"Body {name}"] = stress_body(deep(cells, 2), deep(size, .5), deep(origin, 0.0), dim, young)
        if dim == 3:
            scene[f"Support sides {name}"] = support("2, 3", "y", body=name)

    for i in range(n):
        x, m = 10.0 * i, "" if n == 1 else f" {i}"
        body(f"stud{m}", (4, 5), (.8, 1.0), (x - .4, 0.0), 2000.0)
        body(f"bolt{m}", (4, 4), (.8, 1.0), (x - .4, 1.0), 2000.0)
        body(f"head{m}", (8, 3), (2.0, .6), (x - 1.0, 2.0), 2500.0)
        scene[f"Support stud{m}"] = support(bottom, every, body=f"stud{m}")
        scene[f"Contact {JOINT}{m}"] = tie(f"bolt{m}", bottom, f"stud{m}", top, Preload=f"{FORCE + .4 * i!r}*min(t, 1)", **entries)
        scene[f"Contact thread{m}"] = tie(f"bolt{m}", top, f"head{m}", bottom)
        for side, left, outside in (("left", x - 1.2, 0), ("right", x + .4, 1)):
            lower, upper = f"lower {side}{m}", f"upper {side}{m}"
            body(lower, (4, 5), (.8, 1.0), (left, 0.0), 700.0)
            body(upper, (4, 4), (.8, 1.0), (left, 1.0), 700.0)
            scene[f"Support {lower}"] = support(bottom, every, body=lower)
            scene[f"Contact joint {side}{m}"] = joint(upper, bottom, lower, top, **{"Friction coefficient": .2})
            scene[f"Contact seat {side}{m}"] = joint(upper, top, f"head{m}", bottom, **{"Friction coefficient": .15})
            scene[f"Load pull {side}{m}"] = load("traction", " ; ".join(["0"] * last + [f"{.5 + .1 * i}*max(t - 1, 0)"]), outside, body=upper)
    return scene


def by_both_backends(laws):
    """The same tables, of cuts also: bars whose closed forms are above, and bolts among bodies that deform."""
    lock = {"Preload locked from": 1}
    near = {"Pairing": "node to face"}  # supports of the sides hold what their nodes meet, then
    scenes = {f"{dim}D bar{', exchanged' * exchanged}{', locked' * bool(entries)}": bar(dim, exchanged, **near, **entries)
              for dim, exchanged, entries in ((2, False, {}), (2, True, lock), (3, False, lock), (3, True, {}))}
    scenes.update({f"{dim}D, {n} bolt{'s' * (n > 1)}{', locked' * bool(entries)}": flanged(dim, n, **entries)
                   for dim, n, entries in ((2, 1, {}), (2, 3, lock), (3, 1, lock), (3, 2, {}))})
    scenes["2D, a bolt with clearance"] = merge(flanged(2, **lock), {f"Contact seat {side}": {"Gap": .002} for side in ("left", "right")})
    for what, scene in scenes.items():
        condensed, iterative = (laws.run(scene, *backend(name)) for name in ("condensed", "iterative"))
        laws.same(f"{what}: both backends", condensed, iterative, 1e-9)
        laws.demand("  solved by all unknowns", all(row["solver"] in ("iterative", "linear") for row in iterative.increments))
        for name in condensed.increments[0]:
            if name.startswith("preload_"):
                size = max(abs(row[name]) for row in condensed.increments)
                laws.check(f"  {name}", max(abs(a[name] - b[name]) for a, b in zip(condensed.increments, iterative.increments)) / size, 1e-9)


def first_steps(laws):
    """Linear systems of contacts that carry nothing yet are solved to some digits, not to what rounding leaves."""
    run = laws.run(merge(flanged(3), {"Time": {"End": 1, "Increments": 1}}), *backend("iterative"))
    laws.check("linear iterations of a bolt that is drawn", iterations(run), 40)


def preload(laws):
    bars(laws)
    turned(laws)
    joints(laws)
    restarted(laws)
    by_both_backends(laws)
    first_steps(laws)
