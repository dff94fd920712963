# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact of bodies whose meshes do not match.

plane, space: a uniform pressure through joints; triangles: where one or both bodies are of
triangles or tetrahedra; covered: turned blocks that cover a part of each other; held: supports take the ends of a joint; hertz: cylinder on
cylinder; rings: shrink fits; many: 100 x 100 faces on as many; apart: coarse balls that do not touch.
"""
import itertools
import math
import re
import time

from support.half_cylinders import half_cylinder
from support.meshes import distorted
from support.polygons import shares_under
from support.scenes import box, joint, load, merge, ring, simplices, support

PRESSURE = 2.0
JOINT = "joint"


def swing(run):
    """Largest deviation of a nodal pressure of the slave side, over the pressure."""
    return max(abs(row["r_n"] / row["area"] - PRESSURE) + (abs(row["r_t1"]) + abs(row["r_t2"])) / row["area"]
               for row in run.last() if row["contact"] == JOINT) / PRESSURE


def balances(run):
    """Sums of the forces and of the moments of both sides of the joint, over the force on one."""
    last = run.increments[-1]
    force = math.hypot(*(last[f"{JOINT}_f_{c}"] for c in "xyz"))
    return [math.hypot(*(last[f"{JOINT}_{what}_{c}"] + last[f"{JOINT}_master_{what}_{c}"] for c in "xyz")) / force
            for what in "fm"]


def check_patch(laws, what, run, pressure=1e-10):
    force, moment = balances(run)
    laws.check(f"{what}: nodal pressures", swing(run), pressure)
    laws.check(f"{what}: forces of both sides", force, 1e-12)
    laws.check(f"{what}: moments of both sides", moment, 1e-11)


def stacked(dim, lower, upper, exchanged, mu=0.0, **contact):
    """Two bodies on rollers, pressed together; ids of sides as boxes have them."""
    sides = ((0, 2, 3) if dim == 2 else (0, 4, 5))
    walls = str(sides[0]) if dim == 2 else "0, 2"
    pair = (("lower", sides[2]), ("upper", sides[1]))
    slave, master = pair if exchanged else pair[::-1]
    return {"Dimension": dim, "Body lower": lower, "Body upper": upper,
            f"Contact {JOINT}": joint(*slave, *master, **{"Friction coefficient": mu, **contact}),
            "Support ground": support(sides[1], "normal", body="lower"),
            "Support wall lower": support(walls, "normal", body="lower"),
            "Support wall upper": support(walls, "normal", body="upper"),
            "Load top": load("pressure", repr(PRESSURE), sides[2], "upper"),
            "Output": {"VTU": 0}}


def from_files(scene):
    """Sides of meshes from distorted() have other ids."""
    for tree in scene.values():
        for key in ("Boundary ids", "Master boundary ids"):
            if isinstance(tree, dict) and key in tree:
                tree[key] = re.sub(r"\d+", lambda m: str(10 + int(m[0])), str(tree[key]))
    return scene


def distorted_cells(laws, dim, counts):
    for exchanged in (False, True):
        files = [laws.folder / f"distorted{dim}{n}.msh" for n in counts]
        for file, n in zip(files, counts):
            distorted(file, dim, n)
        blocks = ({"Mesh": {"File": file.name, "Translation": (0, z) if dim == 2 else (0, 0, z)},
                   "Material": {"Young modulus": 1000, "Poisson ratio": .3}} for z, file in enumerate(files))
        check_patch(laws, f"distorted cells{', exchanged' * exchanged}",
                    laws.run(from_files(stacked(dim, *blocks, exchanged))))


def plane(laws):
    for ratio, exchanged in itertools.product(((2, 3), (5, 7), (7, 7), (1, 9)), (False, True)):
        lower, upper = (box((n, 3), (2.0, 1.0), (0.0, y)) for n, y in zip(ratio, (0.0, 1.0)))
        run = laws.run(stacked(2, lower, upper, exchanged))
        check_patch(laws, f"{ratio[0]} on {ratio[1]} cells{', exchanged' * exchanged}", run)
    distorted_cells(laws, 2, (5, 7))
    run = laws.run(stacked(2, box((5, 3), (2.0, 1.0)), box((7, 3), (2.0, 1.0), (0.0, 1.0)), False,
                           Pairing="node to face"))
    laws.demand(f"node to face: nodal pressures swing by {swing(run):.2g}", swing(run) > .05)


def space(laws):
    for lower, upper in (((2, 3, 1), (3, 2, 1)), ((4, 5, 1), (7, 3, 1)), ((3, 3, 1), (3, 3, 1))):
        for exchanged in (False, True):
            blocks = (box(n, (1.5, 1.0, 1.0), (0.0, 0.0, z)) for n, z in ((lower, 0.0), (upper, 1.0)))
            run = laws.run(stacked(3, *blocks, exchanged))
            check_patch(laws, f"{lower} on {upper}{', exchanged' * exchanged}", run)
    distorted_cells(laws, 3, (3, 4))


def triangles(laws):
    for dim, cells in ((2, ((5, 3), (7, 3))), (3, ((2, 3, 1), (3, 4, 1)))):
        size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
        blocks = [box(n, size, (0.0,) * (dim - 1) + (z,)) for n, z in zip(cells, (0.0, 1.0))]
        for cut, exchanged in itertools.product(((True, False), (False, True), (True, True)), (False, True)):
            bodies = [simplices(block) if is_cut else block for block, is_cut in zip(blocks, cut)]
            names = [("triangles" if dim == 2 else "tetrahedra") if is_cut else "whole cells" for is_cut in cut]
            check_patch(laws, f"{dim}D: {names[1]} on {names[0]}{', exchanged' * exchanged}",
                        laws.run(stacked(dim, *bodies, exchanged)))


def held(laws):
    """The sides of the slave move as in the uniform state, the ends of the joint with them."""
    along, down = .3 * 1.3 * PRESSURE / 1000, -(1 - .3**2) * PRESSURE / 1000  # strains, plane strain
    for ratio, exchanged in itertools.product(((4, 7), (6, 5)), (False, True)):
        scene = stacked(2, *(box((n, 3), (2.0, 1.0), (0.0, y)) for n, y in zip(ratio, (0.0, 1.0))), exchanged)
        slave = "lower" if exchanged else "upper"
        scene.pop(f"Support wall {slave}")
        scene["Support sides"] = support("0, 1", "x, y", f"{along!r}*x ; {down!r}*y", slave)
        run = laws.run(scene)
        laws.check(f"{ratio[0]} on {ratio[1]} cells{', exchanged' * exchanged}: nodal pressures", swing(run), 1e-10)
        laws.check("  forces of both sides", balances(run)[0], 1e-12)
        laws.check("  the whole force", abs(abs(run.increments[-1][f"{JOINT}_f_y"]) / (2 * PRESSURE) - 1), 1e-10)
    held_prestress(laws)


def held_prestress(laws):
    """A prestress that the contact itself carries moves nothing: reactions are its forces, those of held nodes as well."""
    scene = stacked(2, *(box((n, 3), (2.0, 1.0), (0.0, y)) for n, y in zip((6, 5), (0.0, 1.0))), False, Prestress="1 + x")
    scene.pop("Load top")
    scene["Support sides"] = support("0, 1", "x, y", body="upper")
    run = laws.run(scene)
    forces = sum(1 + 2 * k / 5 for k in range(6))
    laws.check("a prestress: the whole force", abs(run.increments[-1][f"{JOINT}_f_y"] / forces - 1), 1e-10)
    laws.check("  which moves nothing", max(abs(row["u_n"]) for row in run.last()), 1e-12)


def turned_on_wider(angle, exchanged, is_cut=False, pressure=PRESSURE, degree=1, **contact):
    """A turned block on a wider one, which carries the same pressure beside it: all of it is uniform."""
    cells, size, small = (4, 5), (2.0, 2.0), 1.1
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    place = [(.97 + c * x - s * y, 1.02 + s * x + c * y)
             for x, y in ((-small / 2, -small / 2), (small / 2, -small / 2), (small / 2, small / 2), (-small / 2, small / 2))]
    under = shares_under(cells, size, place, degree)
    whole = shares_under(cells, size, [(0, 0), (2, 0), (2, 2), (0, 2)], degree)
    upper = box((3, 4, 1), (small, small, 1.0), (-small / 2, -small / 2, 0.0), Rotation=(0, 0, 1, angle), Translation=(.97, 1.02, 1.0))
    scene = stacked(3, box((*cells, 2), (*size, 1.0)), simplices(upper) if is_cut else upper, exchanged, **contact)
    scene.pop("Support wall upper")
    if degree == 2:
        scene = merge(scene, {"Body lower": {"Element": "Q2"}, "Body upper": {"Element": "Q2"}})
    scene["Load top"]["Value"] = repr(pressure)
    for k, (node, share) in enumerate(whole.items()):
        force = -pressure * (share - under.get(node, 0))
        if abs(force) > 1e-15:
            scene[f"Load {k}"] = load("point force", f"0; 0; {force!r}", body="lower",
                                      Point=(node[0] * size[0] / cells[0], node[1] * size[1] / cells[1], 1.0))
    return scene


def covered(laws):
    covered_in_plane(laws)
    for angle, exchanged, is_cut in (*itertools.product((0.0, 10.0, 30.0, 45.0), (False, True), (False,)),
                                     (20.0, False, True), (20.0, True, True)):
        check_patch(laws, f"{'tetrahedra ' * is_cut}turned by {angle:g} degrees{', exchanged' * exchanged}",
                    laws.run(turned_on_wider(angle, exchanged, is_cut, mu=1.0)))


def covered_in_plane(laws):
    """A narrow block on a wide one: the rest of the wide one carries the same pressure."""
    n, width, left, right = 5, 2.0, .33, 1.47
    h = width / n

    def under(k, a, b):
        """Integral of the hat of node k over [a, b]."""
        def up_to(x):
            s = min(max(x / h - k, -1), 1)
            return h * (s + 1 - math.copysign(s * s, s) / 2 - .5)
        low, high = max(a, 0), min(b, width)
        return up_to(high) - up_to(low)
    for exchanged in (False, True):
        scene = stacked(2, box((n, 2), (width, 1.0)), box((4, 3), (right - left, 1.0), (left, 1.0)), exchanged, mu=1.0)
        scene.pop("Support wall upper")
        for k in range(n + 1):
            force = -PRESSURE * (under(k, 0, width) - under(k, left, right))
            if abs(force) > 1e-15:
                scene[f"Load {k}"] = load("point force", f"0; {force!r}", body="lower", Point=(k * h, 1.0))
        check_patch(laws, f"a narrow block on a wide one{', exchanged' * exchanged}", laws.run(scene))


def cylinders(laws, n, ratio, pairing="mortar"):
    """Errors of peak pressure and half width, n cells of the slave a half width."""
    young, poisson, radius, size = 1000.0, .3, 20.0, 32.0
    modulus, curvature = young / (2 * (1 - poisson**2)), 2 / radius
    peak = modulus * curvature / 2  # half width 1
    for name, step, sign in (("upper", 1 / n, 1), ("lower", ratio / n, -1)):
        half_cylinder(laws.folder / f"{name}.msh", step, radius, size, sign)
    bodies = {f"Body {name}": {"Mesh": {"File": f"{name}.msh"},
                               "Material": {"Young modulus": young, "Poisson ratio": poisson}} for name in ("upper", "lower")}
    # Hertz has pressures act on surfaces as they were
    scene = {"Dimension": 2, **bodies, f"Contact {JOINT}": joint("upper", 1, "lower", 1, Pairing=pairing, Kinematics="small"),
             "Support ground": support(2, "y", body="lower"),
             "Support middle lower": support(3, "x", body="lower"), "Support middle upper": support(3, "x", body="upper"),
             "Load top": load("traction", f"0 ; {-math.pi * peak / 4 / size!r}", 2, "upper"), "Output": {"VTU": 0}}
    run = laws.run(scene)
    rows = sorted((row for row in run.last() if row["contact"] == JOINT), key=lambda row: row["x"])
    total = sum(row["r_n"] for row in rows)
    spread = 2 * math.sqrt(sum(row["r_n"] * row["x"]**2 for row in rows) / total)
    local = max(abs(row["r_n"] / row["area"] - peak * math.sqrt(max(0, 1 - row["x"]**2))) / peak
                for row in rows if row["x"] < .8)
    return abs(rows[0]["r_n"] / rows[0]["area"] / peak - 1), abs(spread - 1), local


def hertz(laws):
    for ratio in (.5, .7, 1.0, 1.5, 3.0):
        coarse, fine = (cylinders(laws, n, ratio) for n in (8, 16))
        for what, before, found in zip(("peak pressure", "half width", "pressures up to .8 half widths"), coarse, fine):
            laws.check(f"cells {ratio:g} times as large: {what} ({before:.2g} at 8 cells)", found, .01)


def rings(laws):
    for name, cells, turned in (("matching", (48, 48), 0.0), ("turned by half a facet", (48, 48), 3.75),
                                ("48 facets in 64", (48, 64), 0.0), ("64 facets in 48", (64, 48), 1.0)):
        for exchanged in (False, True):
            pair = (("inner", 1), ("outer", 0))
            slave, master = pair[::-1] if exchanged else pair
            scene = {"Dimension": 2, "Body inner": ring(1.0, 2.0, cells[0], turned), "Body outer": ring(2.0, 3.0, cells[1]),
                     f"Contact {JOINT}": joint(*slave, *master, Gap=-.002, **{"Friction coefficient": .3}),
                     "Support soft": support(1, "x, y", "0 ; 0", body="outer", Stiffness=1e-3), "Output": {"VTU": 0}}
            for body in ("inner", "outer"):
                scene[f"Body {body}"]["Mesh"]["Global refinements"] = 1
            run = laws.run(scene, bounds=False)  # resultants of closed rings are rounding, so is their sum over them
            laws.check(f"{name}{', exchanged' * exchanged}: residual, equilibrium, balance of each ring",
                       max(run.increments[-1][c] for c in ("residual", "equilibrium", "balance_inner", "balance_outer")), 1e-10)
            pressures = [row["r_n"] / row["area"] for row in run.last() if row["contact"] == JOINT]
            mean = sum(pressures) / len(pressures)
            laws.check(f"{name}{', exchanged' * exchanged}: pressures about their mean",
                       max(abs(p / mean - 1) for p in pressures), .01)
            laws.check(f"{name}{', exchanged' * exchanged}: mean against Lame", abs(mean / .234375 - 1), .01)


def many(laws):
    """Dry runs, because the stiffness would cost more than the pairing."""
    for pairing, turned in itertools.product(("mortar", "node to face"), (0.0, 20.0)):
        blocks = (box((100, 100, 1), (1.0, 1.0, .1), (-.5, -.5, z)) for z in (0.0, .1))
        scene = stacked(3, *blocks, False, Pairing=pairing)
        scene["Body upper"]["Mesh"]["Rotation"] = (0, 0, 1, turned)
        begin = time.monotonic()
        done, _ = laws.start(scene, "--dry-run")
        laws.demand(f"100 x 100 faces turned by {turned:g} degrees, {pairing}: {time.monotonic() - begin:.1f} s {done.stderr}",
                    done.returncode == 0)


def apart(laws):
    """Balls of facets whose centres are more than two radii apart do not touch, however coarse they are."""
    places = ((-.26997, .00379, 46.7), (.27, .1, 10.0), (.5, -.2, 75.0), (-.35, .45, 30.0), (.12, .61, 62.0), (.7, .3, 5.0))
    for dim, kinematics in ((2, "small"), (3, "small"), (3, "finite sliding")):
        for x, y, turn in places:
            side = y if dim == 3 else 0.0
            up = math.sqrt(2.01**2 - x**2 - side**2)
            middle = (x, side, up)[:3] if dim == 3 else (x, up)
            run = laws.run({"Dimension": dim, **{f"Body {name}": ball(dim, at, **more) for name, at, more in
                                                 (("low", (0.0,) * dim, {}), ("up", middle, {"Rotation": (0, 0, 1, turn)} if dim == 3 else {}))},
                            "Contact joint": joint("up", 0, "low", 0, **{"Friction coefficient": .2, "Kinematics": kinematics}),
                            "Support low": support(5, "x, y, z"[:3 * dim - 2], body="low"),
                            "Support up": support(5, "x, y, z"[:3 * dim - 2], body="up"),
                            "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}})
            laws.check(f"{dim}D, {kinematics}, coarse balls apart at {x:g}, {side:g}: force", run.largest("r_n"), 0)


def ball(dim, middle, **more):
    """Held at its outer end."""
    axis, sign = "xyz"[dim - 1], "<" if middle[-1] == 0 else ">"
    return {"Mesh": {"Generator": "hyper_ball", "Arguments": ", ".join("0" * dim) + " : 1 : false", "Global refinements": 2 if dim == 3 else 1,
                     "Translation": middle, **more,
                     "Boundary ids": f"6: {axis} {sign} {middle[-1]!r} ; 5: {axis} {sign} {middle[-1] + (-.5 if sign == '<' else .5)!r}"},
            "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}}
