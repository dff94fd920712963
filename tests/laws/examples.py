# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shipped scenes against statics and closed forms: sums here are those of the nodal tables, not the program's own."""
import math

from support.scenes import SHIPPED
from support.tables import REACTION, Events, Run, in_space
from support.vectors import cross, plus


def shipped(laws, name, *changes):
    return laws.run(SHIPPED / f"{name}.prm", *(word for change in ("Output/VTU=0", *changes) for word in ("-s", change)))


def rows_of(run, contact, time=None):
    """Of one side of a contact at a time, the last one if none is given."""
    time = run.increments[-1]["time"] if time is None else time
    last = max(row["increment"] for row in run.increments if row["time"] == time)
    return [row for row in run.rows if row["increment"] == last and row["contact"] == contact]


def resultant(run, rows):
    """Force and moment about the origin of nodal reactions."""
    force = moment = (0.0, 0.0, 0.0)
    for row in rows:
        r = in_space(row, run.dim, REACTION)
        force = plus(force, r)
        moment = plus(moment, cross((row["x"], row["y"], row["z"]), r))
    return force, moment


def total(rows, column="r_n"):
    return sum(row[column] for row in rows)


def limit_of(laws, name):
    """A load path's last point, its limit load and its run."""
    done, folder = laws.start(SHIPPED / f"{name}.prm", "-s", "Output/VTU=0")
    if done.returncode:
        raise RuntimeError(done.stderr)
    return Run(folder), Events(folder).parameter


def shrink_fit(laws):
    """Lame's pressure."""
    pressure = .002 * 1000 / (2 * (13 / 5 + 5 / 3))
    run = shipped(laws, "shrink-fit")
    rows = rows_of(run, "joint")
    laws.check("shrink fit: mean pressure", abs(total(rows) / total(rows, "area") / pressure - 1), 1e-3)
    force, _ = resultant(run, rows)
    laws.check("shrink fit: forces on the cuts of the inner ring", max(abs(-f / (2 * pressure) - 1) for f in force[:2]), 1e-3)


def bolt_joint(laws):
    """Bolt less joint is the pull; preload and separation of two springs."""
    young, shank, sleeves = 210e3, 25 * math.pi, (9**2 - 5.5**2) * math.pi
    run = shipped(laws, "bolt-joint")

    def along(contact, time):
        return resultant(run, rows_of(run, contact, time))[0][1]
    bolt = [along("seat of head", t) for t in range(1, 10)]
    joint = [along("joint", t) for t in range(1, 10)]
    pulls = [2000 * (t - 1) for t in range(1, 10)]
    laws.check("bolt: bolt less joint is the pull", max(abs(b - j - p) for b, j, p in zip(bolt, joint, pulls)) / bolt[0], 1e-10)
    laws.check("bolt: nut as head", max(abs(along("seat of nut", t) + b) for t, b in zip(range(1, 10), bolt)) / bolt[0], 1e-10)
    soft, stiff = (1 / (1 / (young * shank / length) + 40 / (young * sleeves)) for length in (50, 40))
    laws.demand(f"bolt: preload {bolt[0]:.1f} between springs {.04 * soft:.1f} and {.04 * stiff:.1f}", .04 * soft < bolt[0] < .04 * stiff)
    k_b, k_c = young * shank / 50, young * sleeves / 40
    share = 38 / 40 * k_b / (k_b + k_c)
    laws.check("bolt: share of the pull", abs((bolt[1] - bolt[0]) / 2000 / share - 1), .06)
    apart = pulls[6] + joint[6] * 2000 / (joint[5] - joint[6])
    laws.check(f"bolt: the joint separates at {apart:.1f}, springs {bolt[0] / (1 - share):.1f}", abs(apart * (1 - share) / bolt[0] - 1), .03)
    laws.demand("bolt: separated beyond", joint[6] > 0 and joint[7] == joint[8] == 0)


def bolt_preload(laws):
    """Ties that meet the axis of revolution: the tension is what was asked for, then what the flange leaves to it."""
    run = shipped(laws, "bolt-preload")
    for row in run.increments:
        at = f"stud, t = {row['time']:g}"
        tension = row["preload_cut_force"]
        if row["time"] <= 1:
            laws.check(f"{at}: tension", abs(tension / (3e4 * row["time"]) - 1), 1e-10)
        bed, nut = (resultant(run, rows_of(run, contact, row["time"]))[0][1] for contact in ("bed", "under nut"))
        laws.check(f"{at}: the nut carries the stud", abs(abs(nut) - tension) / 3e4, 1e-9)
        laws.check(f"{at}: the ground has what the pull leaves", abs(bed - (tension - row["loads_f_y"])) / 3e4, 1e-9)
    laws.check("stud: pull on the faces from the radius 17.2 on", abs(run.increments[-1]["loads_f_y"] / (2e4 * (25**2 - 17.2**2) / (25**2 - 17**2)) - 1), 1e-12)
    laws.demand("stud: the flange takes most of the pull", 0 < tension - 3e4 < .02 * run.increments[-1]["loads_f_y"])


def dovetail(laws):
    """A wedge with friction, pulled and let go; at t = 5 and 6 it sticks."""
    run, mu = shipped(laws, "dovetail"), .25
    for t in range(1, 9):
        half = 450 * (t / 4 if t < 4 else 1 - .2 * (t - 4))
        rows = rows_of(run, "flank", t)
        force, across = total(rows), -total(rows, "r_t1")
        laws.check(f"dovetail, t = {t}: N {force:.4f} and T {across:.4f} balance the pull", abs(.6 * force + .8 * across - half) / half, 1e-10)
        exact = half / (.6 + .8 * mu) if t <= 4 else half / (.6 - .8 * mu)
        if t not in (5, 6):
            laws.check(f"dovetail, t = {t}: a wedge that slips {'in' if t > 4 else 'out'}", abs(force / exact - 1), 1e-10)


def retaining_wall(laws):
    """Coulomb's earth pressure against the wall's friction."""
    run, limit = limit_of(laws, "retaining-wall")
    laws.check("wall: the surcharge at which it slides", abs(limit / 56.16 - 1), 1e-9)
    laws.demand("  wall and soil move by a translation each", ",limit load: sliding," in (run.folder / "events.csv").read_text())
    for last in (run.increments[0], run.increments[-1]):
        rows = [row for row in run.rows if row["increment"] == last["increment"]]
        back, ground = (resultant(run, [row for row in rows if row["contact"] == side])[0] for side in ("back_master", "base"))
        what = f"wall, surcharge {last['time']:.4g}"
        laws.check(f"{what}: earth pressure", abs(-back[0] / ((18 * 8 + last["time"] * 4) / 3) - 1), 1e-9)
        laws.check(f"{what}: base", math.dist(ground, (-back[0], 24 * 3.2 * 4, 0)) / 307.2, 1e-10)


def o_ring(laws):
    """Johnson's cylinder between plates, less its hoop stress; Hertz's width and pressure."""
    run = shipped(laws, "o-ring")
    plane = 2 * (1 - .499**2) / math.pi
    for t in (2, 5):
        rows = sorted(rows_of(run, "lid", t), key=lambda row: row["x"])
        force = total(rows)
        f = force / (math.pi * 50 * 5 * 5)
        half = math.sqrt(plane * f)
        squeeze = f * (plane * (2 * math.log(2 / half) - 1) + 4 * .499**2 / math.pi)
        laws.check(f"O-ring: squeeze of {.01 * t} from its force", abs(squeeze / (.01 * t) - 1), .0025)
        middle = sum(row["r_n"] * row["x"] for row in rows) / force
        spread = 2 * math.sqrt(sum(row["r_n"] * (row["x"] - middle)**2 for row in rows) / force)
        laws.check(f"O-ring: half width at {.01 * t}", abs(spread / (5 * half) - 1), .006)
        peak = max(row["r_n"] / row["area"] for row in rows)
        laws.check(f"O-ring: largest pressure at {.01 * t}", abs(peak / (2 * f * 5 / (math.pi * half)) - 1), .006)


def spent(run):
    """What friction spends in each increment: mean reactions times slips of all nodes."""
    before, sums = {}, {row["increment"]: 0.0 for row in run.increments}
    for row in run.rows:
        if not row["contact"].endswith("_master"):
            key, force = (row["contact"], row["node"]), (row["r_t1"], row["r_t2"])
            old = before.get(key, (0.0, 0.0))
            sums[row["increment"]] -= .5 * ((old[0] + force[0]) * row["du_t1"] + (old[1] + force[1]) * row["du_t2"])
            before[key] = force
    return list(sums.values())


def fretting_loop(laws):
    """What a cycle of partial slip spends, by Cattaneo's slips."""
    run, mu, modulus = shipped(laws, "fretting-loop"), .5, 1000 / (2 * (1 - .3**2))
    cycle = sum(work for work, row in zip(spent(run), run.increments) if row["time"] > 2)
    (right, press, _), (left, _, _), (again, _, _) = (resultant(run, rows_of(run, "joint", t))[0] for t in (2, 4, 6))
    laws.check("fretting loop: it closes", max(abs(right + left), abs(right - again)) / abs(right), 1e-9)
    q = abs(right) / (mu * press)
    log = math.log(1 - q)
    exact = 4 * (mu * press)**2 / (math.pi * modulus) * (q * ((1 - q) * (log - 1) - 1) + 1.5 + (1 - q)**2 * (log - 1.5))
    laws.check(f"fretting loop: {cycle:.5g} spent, half planes {exact:.5g}", abs(cycle / exact - 1), .03)


def sheet_pile(laws):
    """The wall turns about its toe under the push and what both soils do to it."""
    run = shipped(laws, "sheet-pile")
    push, toe = 2135.184824469461, (10.0, 0.0, 0.0)
    lever = 0.0
    for side in ("left", "right"):
        rows = rows_of(run, side)
        lever -= resultant(run, rows)[1][2] - cross(toe, resultant(run, rows)[0])[2]
        laws.check(f"sheet pile: {side} soil outside its cone", max(abs(row["r_t1"]) - .4 * row["r_n"] for row in rows) / push, 1e-10)
    laws.check("sheet pile: moments about the toe", abs(lever / (5 * push) - 1), 1e-9)


def plane(laws):
    for law in (shrink_fit, bolt_joint, bolt_preload, dovetail, retaining_wall, o_ring, fretting_loop, sheet_pile):
        law(laws)


def disc_brake(laws):
    """Torque is mu r_n r at each node."""
    run, mu, turn = shipped(laws, "disc-brake"), .4, math.radians(6)
    for t in (2, 6):
        rows = rows_of(run, "upper", t) + rows_of(run, "lower", t)
        torque = resultant(run, rows)[1][2]
        each = mu * sum(row["r_n"] * math.hypot(row["x"], row["y"]) for row in rows)
        pressed = [resultant(run, rows_of(run, side, t))[0][2] for side in ("upper", "lower")]
        laws.check(f"brake, t = {t}: the pads are pressed", max(abs(pressed[0] / 1200 - 1), abs(pressed[1] / 1200 + 1)), 1e-10)
        laws.check(f"brake, t = {t}: torque {torque:.1f} over mu N r of the nodes is that of a chord",
                   abs(torque / (each * math.cos(turn / 2)) - 1), 1e-5)
        laws.check(f"brake, t = {t}: mu N r of an even pressure", abs(each / (mu * 2400 * 77.8678) - 1), .006)
        hub = next(row["support_hub_m_z"] for row in run.increments if row["time"] == t)
        laws.check(f"brake, t = {t}: torque at the hub", abs(hub / torque - 1), 3e-6)
    rest = works(run)
    laws.check("brake: work that is not spent, once it slides", max(map(abs, rest[2:])) / (torque * turn), 2e-6)


def block_in_groove(laws):
    """A wedge's friction."""
    run, limit = limit_of(laws, "block-in-groove")
    laws.check("groove: limit", abs(limit / (.3 * math.sqrt(2)) - 1), 1e-8)
    for side, sign in (("left", 1), ("right", -1)):
        force, _ = resultant(run, rows_of(run, side))
        laws.check(f"groove: {side} flank", math.dist(force, (-500 * limit, 500 * sign, 500)) / 500, 1e-7)


def bracket(laws):
    """Sole against loads, by forces and moments of both."""
    run = shipped(laws, "bracket")
    rows = rows_of(run, "sole")
    force, moment = resultant(run, rows)
    last = run.increments[-1]
    loads = [[sum(last[f"load_{name}_{what}_{c}"] for name in ("bolts", "pin")) for c in "xyz"] for what in "fm"]
    laws.check("bracket: forces", math.dist(force, [-f for f in loads[0]]) / force[2], 1e-10)
    laws.check("bracket: moments", math.dist(moment, [-m for m in loads[1]]) / math.hypot(*moment), 1e-10)
    laws.check("bracket: bolts of 10 kN, on polygons", abs(force[2] / 20e3 - 1), .05)
    laws.check("bracket: pin of 4 kN, on a polygon", abs(force[0] / 4e3 - 1), .01)
    laws.admissible("bracket", run, lambda row: .3)
    done, _ = laws.start(SHIPPED / "bracket.prm", *(w for e in ("Output/VTU=0", "Time/End=8", "Time/Increments=8") for w in ("-s", e)))
    part = 1 + .3 * force[2] / (force[0] / 4) - 6
    words = done.stderr.partition("friction can carry at most ")[2]
    laws.demand(f"bracket: it slides in increment 7, at {part:.6f} of it: {done.stderr.strip()[:150]}",
                done.returncode == 2 and "Increment 7 of 8" in done.stderr and abs(float(words.partition(". ")[0]) - part) < 1e-5)


def bracket_drawing(laws):
    """The sole is found by itself, and carries what washers press."""
    run = shipped(laws, "bracket-drawing")
    rows = rows_of(run, "bracket ground")
    force, _ = resultant(run, rows)
    laws.demand("drawing: the sole alone meets the ground", all(abs(row["z"]) < 1e-9 for row in rows))
    laws.check("drawing: 20 kN, on polygons", abs(force[2] / 20e3 - 1), .05)
    last = run.increments[-1]
    laws.check("  as the load says", math.dist(force, [-last[f"load_bolts_f_{c}"] for c in "xyz"]) / force[2], 1e-10)


def space(laws):
    for law in (disc_brake, block_in_groove, bracket, bracket_drawing):
        law(laws)


def works(run):
    """Of each increment what is neither stored nor spent of its work."""
    rest, before = [], 0.0
    for row in run.increments:
        rest.append(row["external_work"] - (row["strain_energy"] - before) - row["dissipation"] - row["contact_work_normal"])
        before = row["strain_energy"]
    return rest


ENERGIES = (("inclined-obstacle",), ("partial-slip",), ("fretting-loop",), ("shrink-fit",), ("stacked-blocks",), ("sheet-pile",),
            ("double-layer-grid-unloading",), ("floating-block",), ("bolt-joint",), ("bolt-preload",), ("dovetail",), ("retaining-wall",), ("o-ring",),
            ("bracket",), ("block-press-shear", "Body block/Mesh/Arguments=8, 8, 8 : 0, 0, 0 : 1, 1, 1 : true"))


def energies(laws):
    """Work is stored or spent; what friction spends is that of the nodal reactions."""
    for name, *changes in ENERGIES:
        run = shipped(laws, name, *changes)
        size = max(max(abs(row["external_work"]), row["strain_energy"]) for row in run.increments)
        laws.check(f"{name}: work less energy and what contacts spend", max(map(abs, works(run))) / size, 1e-9)
        friction = max(abs(row["dissipation"] - nodes) for row, nodes in zip(run.increments, spent(run)))
        laws.check(f"{name}: dissipation less that of the nodes", friction / size, 1e-9)
