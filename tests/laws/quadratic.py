# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elements of second degree.

quadratic: a uniform pressure on obstacles, areas of nodes; quadratic-pairs: a uniform
pressure through joints of all kinds of faces; quadratic-orders: how fast errors fall; quadratic-one-by-one: node to face.
"""
import itertools
import math

from laws.iterative import compare
from laws.mortar import PRESSURE, balances, check_patch, from_files, stacked, swing, turned_on_wider
from laws.patch import patch_scene
from laws.sliding import energy_error, of_body, slab
from laws.tie import bar, bars, both_sides, pulled, stress_error
from support import half_space, manufactured
from support.checks import orders
from support.meshes import distorted
from support.scenes import box, contact, joint, load, merge, press_and_shear, support, with_element

Q1, P1, Q2, P2 = ({"Element": element} for element in ("Q1", "P1", "Q2", "P2"))


KINDS = (Q2, P2)


def shape_integral(k, a, b, h):
    """Over [a, b], of the function of second degree of node k, where nodes are h/2 apart and 0, 2, ... are corners."""
    def piece(first, values):
        """Of the parabola with these values at first, first + h/2, first + h: Simpson is exact."""
        low, high = max(a, first), min(b, first + h)
        if high <= low:
            return 0.0

        def at(x):
            s = (x - first) / h
            return (values[0] * (1 - 2 * s) * (1 - s) + values[1] * 4 * s * (1 - s) + values[2] * s * (2 * s - 1))
        return (high - low) / 6 * (at(low) + 4 * at((low + high) / 2) + at(high))
    x = k * h / 2
    if k % 2:
        return piece(x - h / 2, (0, 1, 0))
    return piece(x - h, (0, 0, 1)) + piece(x, (1, 0, 0))


def quadratic(laws):
    for dim, ids in ((2, (10, 12, 13)), (3, (10, 12, 14, 15))):
        file = laws.folder / f"distorted{dim}.msh"
        distorted(file, dim)
        boxes = "0.4, 0 : 0.6, 0.3 : 2" if dim == 2 else "0.2, 0.2, 0 : 0.45, 0.6, 0.3 : 1"
        for kind, refined, plane in itertools.product(KINDS, ("", boxes), ("strain", "stress")[:4 - dim]):
            if refined and kind == P2:
                continue
            body = merge({"Mesh": {"File": file.name, "Refinement boxes": refined},
                          "Material": {"Young modulus": 1000, "Poisson ratio": .3, "Plane": plane}}, kind)
            pressed(laws, f"{dim}D, {kind['Element']}, plane {plane}, distorted{', hanging nodes' * bool(refined)}",
                    *patch_scene(dim, body, ids, plane))
    areas_of_boxes(laws)


def pressed(laws, what, scene, pressure, strain):
    run = laws.run(scene)
    laws.check(f"{what}: reactions over areas", max(abs(row["r_n"] / row["area"] - pressure) for row in run.rows) / pressure, 1e-10)
    laws.check("  sum of areas", abs(sum(row["area"] for row in run.rows) - 1), 1e-12)
    laws.check("  displacement", max(math.dist((strain * row["x"], strain * row["y"] if run.dim == 3 else 0),
                                               (row["u_t1"], row["u_t2"])) for row in run.rows) / strain, 1e-10)
    laws.check("  friction and gap", max(abs(row["r_t1"]) + abs(row["r_t2"]) + abs(row["gap"]) for row in run.rows), 1e-11)


def areas_of_boxes(laws):
    for dim, cells in ((2, (6, 5)), (3, (4, 3, 2))):
        body = merge(box(cells, (1.0,) * dim), Q2)
        run = laws.run(patch_scene(dim, body, (0, 2, 3) if dim == 2 else (0, 2, 4, 5))[0])

        def area(row):
            return math.prod(shape_integral(round(2 * n * row[c]), 0, 1, 1 / n) for n, c in zip(cells[:dim - 1], "xy"))
        laws.check(f"{dim}D, Q2: {len(run.rows)} nodes, their areas", max(abs(row["area"] - area(row)) for row in run.rows), 1e-14)
        laws.demand("  one in the middle of each edge and face", len(run.rows) == math.prod(2 * n + 1 for n in cells[:-1]))


def pairs(laws):
    for ratio, (one, other), exchanged in itertools.product(((2, 3), (5, 7), (1, 9)), (
            (Q2, Q2), (Q2, Q1), (Q1, Q2), (Q2, P2), (P2, P2)), (False, True)):
        lower, upper = (merge(box((n, 3), (2.0, 1.0), (0.0, y)), kind)
                        for n, y, kind in zip(ratio, (0.0, 1.0), (one, other)))
        check_patch(laws, f"{ratio[0]} {one['Element']} on {ratio[1]} {other['Element']}{', exchanged' * exchanged}",
                    laws.run(stacked(2, lower, upper, exchanged)))
    for (lower, upper), (one, other), exchanged in itertools.product((((2, 3, 1), (3, 2, 1)), ((2, 2, 1), (2, 2, 1))), (
            (Q2, Q2), (Q2, Q1), (Q1, Q2), (P2, P2), (P2, P1), (P2, Q1), (Q2, P2), (P1, P2)), (False, True)):
        blocks = (merge(box(n, (1.5, 1.0, 1.0), (0.0, 0.0, z)), kind) for n, z, kind in ((lower, 0.0, one), (upper, 1.0, other)))
        check_patch(laws, f"{lower} {one['Element']} on {upper} {other['Element']}{', exchanged' * exchanged}",
                    laws.run(stacked(3, *blocks, exchanged)))
    distorted_pairs(laws)
    hanging_pairs(laws)
    covered_in_plane(laws)
    covered_in_space(laws)
    symmetric_rims(laws)
    tied(laws)


def one_by_one(laws):
    """Node to face: exact where meshes match or the slave's divides the master's; on others the force is right, pressures are not."""
    def boxes(dim, cells, kinds):
        size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
        return (merge(box(n, size, (0.0,) * (dim - 1) + (z,)), kind) for n, z, kind in zip(cells, (0.0, 1.0), kinds))

    for dim, coarse, fine in ((2, (4, 3), (8, 2)), (3, (2, 2, 1), (4, 4, 1))):
        for slave, (one, other) in itertools.product((coarse, fine), ((Q2, Q2), (Q2, Q1), (P2, P2), (P2, P1))):
            check_patch(laws, f"{dim}D, node to face: {other['Element']} {coarse} below {one['Element']} {slave}",
                        laws.run(stacked(dim, *boxes(dim, (coarse, slave), (other, one)), False, Pairing="node to face")))
    for dim, lower, upper in ((2, (5, 3), (7, 3)), (3, (2, 3, 1), (3, 2, 1))):
        run = laws.run(stacked(dim, *boxes(dim, (lower, upper), (P2, P2)), False, Pairing="node to face"))
        laws.demand(f"{dim}D, node to face: meshes that do not match: pressures swing by {swing(run):.2g}", swing(run) > .01)
        force, moment = balances(run)
        laws.check("  forces of both sides", force, 1e-12)
        laws.check("  moments of both sides", moment, 1e-11)
    compare(laws, "3D, node to face: both backends", {
        "Dimension": 3, "Body lower": merge(box((3, 3, 2), (1.0, 1.0, .7)), P2),
        "Body upper": merge(box((3, 3, 2), (1.0, 1.0, .7), (0.0, 0.0, .7), young=1e6), P2),
        "Contact joint": joint("upper", 4, "lower", 5, **{"Friction coefficient": .3, "Pairing": "node to face"}),
        "Support ground": support(4, "x, y, z", body="lower"),
        "Support top": support(5, "x, y, z", "0.004*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)", body="upper"),
        "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}})


def symmetric_rims(laws):
    """A slave that reaches beyond its master on all four sides alike: nodes at the rim give up alike."""
    for half in (.41, .45, .49):
        lower = merge(box((3, 3, 2), (1.2, 1.2, .6), (-.6, -.6, 0.0)), Q2)
        upper = merge(box((2, 2, 2), (2 * half, 2 * half, .6), (-half, -half, .6)), Q2)
        scene = stacked(3, lower, upper, True, mu=.5)
        for wall in ("Support wall lower", "Support wall upper"):
            del scene[wall]
        scene["Support ground"] = support(4, "x, y, z", body="lower")
        forces = {(round(row["x"], 6) + 0.0, round(row["y"], 6) + 0.0): row["r_n"] for row in laws.run(scene).rows}
        largest = max(forces.values())
        laws.check(f"3D: rim of a slave, master of half width {half}: asymmetry of {len(forces)} forces",
                   max(abs(force - forces[place]) for (x, y), force in forces.items()
                       for place in ((-x + 0.0, y), (x, -y + 0.0), (y, x))) / largest, 1e-10)


def distorted_pairs(laws):
    for dim, counts in ((2, (5, 7)), (3, (2, 3))):
        files = [laws.folder / f"pair{dim}{n}.msh" for n in counts]
        for file, n in zip(files, counts):
            distorted(file, dim, n)
        for kind, exchanged in itertools.product(KINDS, (False, True)):
            blocks = (merge({"Mesh": {"File": file.name, "Translation": (0, z) if dim == 2 else (0, 0, z)},
                             "Material": {"Young modulus": 1000, "Poisson ratio": .3}}, kind) for z, file in enumerate(files))
            check_patch(laws, f"{dim}D: distorted cells, {kind['Element']}{', exchanged' * exchanged}",
                        laws.run(from_files(stacked(dim, *blocks, exchanged))))


def hanging_pairs(laws):
    for dim, lower, upper, boxes in ((2, (4, 3), (5, 3), "0.4, 0.8 : 0.9, 1 : 2"),
                                     (3, (2, 2, 1), (3, 2, 1), "0, 0, 0.7 : 0.4, 0.4, 1 : 1")):
        for exchanged in (False, True):
            size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
            blocks = [merge(box(n, size, (0.0,) * (dim - 1) + (z,)), Q2) for n, z in ((lower, 0.0), (upper, 1.0))]
            blocks[0]["Mesh"]["Refinement boxes"] = boxes
            check_patch(laws, f"{dim}D: hanging nodes{', exchanged' * exchanged}", laws.run(stacked(dim, *blocks, exchanged)))


def covered_in_plane(laws):
    """A narrow block on a wide one: the rest of the wide one carries the same pressure."""
    n, width = 5, 2.0
    h = width / n
    for (left, right), kind, exchanged in itertools.product(((.33, 1.47), (.05, 1.95), (.39, 1.61), (.0999, 1.2999)),
                                                            (Q2, Q1), (False, True)):
        scene = stacked(2, merge(box((n, 2), (width, 1.0)), Q2),
                        merge(box((4, 3), (right - left, 1.0), (left, 1.0)), kind), exchanged, mu=1.0)
        scene.pop("Support wall upper")
        for k in range(2 * n + 1):
            force = -PRESSURE * (shape_integral(k, 0, width, h) - shape_integral(k, left, right, h))
            if abs(force) > 1e-15:
                scene[f"Load {k}"] = load("point force", f"0; {force!r}", body="lower", Point=(k * h / 2, 1.0))
        check_patch(laws, f"{kind['Element']} from {left} to {right} on a wider Q2{', exchanged' * exchanged}", laws.run(scene))


def covered_in_space(laws):
    for angle, exchanged in itertools.product((0.0, 20.0, 45.0), (False, True)):
        scene = turned_on_wider(angle, exchanged, degree=2, mu=1.0)
        for kind in KINDS:
            check_patch(laws, f"3D: {kind['Element']}, turned by {angle:g} degrees on a wider one{', exchanged' * exchanged}",
                        laws.run(merge(scene, {"Body upper": kind})))


def tied(laws):
    for dim, left, right in ((2, (2, 3), (2, 5)), (3, (1, 2, 3), (1, 3, 2))):
        for (one, other), exchanged in itertools.product(((Q2, Q2), (Q2, Q1), (P2, P2), (P2, Q2)), (False, True)):
            run = laws.run(pulled(bars(dim, merge(bar(dim, left), one), merge(bar(dim, right, 1.0), other), exchanged), dim))
            laws.check(f"{dim}D: {one['Element']} tied to {other['Element']}{', exchanged' * exchanged}: stress", stress_error(run), 1e-10)
            laws.check("  both sides", both_sides(run), 1e-10)


def tetrahedra(laws):
    """Contacts stand at corners only; both backends, which have other unknowns, agree."""
    cut(laws)
    scene = with_element(press_and_shear(3, cells=(4, 4, 4)), "P2")
    run = compare(laws, "3D, P2", scene)
    laws.demand(f"3D, P2: {len(run.last())} contact nodes are corners", len(run.last()) == 41)
    compare(laws, "3D, P2, without friction", merge(scene, {"Contact bottom": {"Friction coefficient": 0}}))
    compare(laws, "3D, P2, opened again", merge(scene, {
        "Support top": {"Displacement": "0.002*t ; 0 ; -0.01*sin(t)"}, "Time": {"End": 6, "Increments": 6}}))
    moved = "0.004*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"
    for kind in (P2, Q1, Q2):
        compare(laws, f"3D, P2 hard on {kind['Element']}", {
            "Dimension": 3, "Body lower": merge(box((3, 3, 2), (1.0, 1.0, .7)), P2),
            "Body upper": merge(box((4, 4, 2), (1.0, 1.0, .7), (0.0, 0.0, .7), young=1e6), kind),
            "Contact joint": joint("upper", 4, "lower", 5, **{"Friction coefficient": .3}),
            "Support ground": support(4, "x, y, z", body="lower"), "Support top": support(5, "x, y, z", moved, body="upper"),
            "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}})


def cut(laws):
    """Friction of a pair that a plane of symmetry cuts: both backends agree, and two halves are the whole."""
    def pressed_pair(y, cells, pairing):
        bodies = {f"Body {body}": merge(box((3, cells, 2), (1.0, .5 - y, .7), (0.0, y, z), young=young), P2)
                  for body, z, young in (("lower", 0.0, 1000.0), ("upper", .7, 3000.0))}
        return {"Dimension": 3, **bodies,
                "Contact joint": joint("upper", 4, "lower", 5, **{"Friction coefficient": .3, "Pairing": pairing}),
                "Support ground": support(4, "x, y, z", body="lower"),
                "Support top": support(5, "x, y, z", "0.004*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)", body="upper"),
                "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}

    for pairing in ("mortar", "node to face"):
        half = pressed_pair(0.0, 2, pairing)
        half.update({f"Support cut {body}": support(2, "y", body=body) for body in ("lower", "upper")})
        half = compare(laws, f"a half by {pairing}", half)
        whole = laws.run(pressed_pair(-.5, 4, pairing))
        for column in ("joint_f_x", "joint_f_z"):
            size = max(abs(row["joint_f_z"]) for row in whole.increments)
            laws.check(f"by {pairing}: {column} of the whole is that of two halves", max(
                abs(a[column] - 2 * b[column]) for a, b in zip(whole.increments, half.increments)) / size, 1e-9)


def bent(laws):
    """Cells with bent edges: a ring on a shaft, volumes, a folded cell."""
    shrunk_on_shaft(laws)
    volumes(laws)


def shrunk_on_shaft(laws):
    """A part of a ring or a hollow ball, pressed from outside, on a rigid shaft or ball (Lame)."""
    nu, radii, pressure = .3, (1.0, 2.0), 10.0
    for dim, kind, finer in itertools.product((2, 3), (Q2, P2), (0, 1)):
        finer += dim - 2
        way = (2 if dim == 2 else 3) * (1 - nu)  # u = A (r - 1/r^(dim - 1))
        exact = pressure * way / ((1 if dim == 2 else 1 + nu) + (dim - 1) * (1 - 2 * nu) * (radii[0] / radii[1])**dim)
        run = laws.run({"Dimension": dim, "Body ring": merge(kind, {
            "Mesh": {"Generator": "quarter_hyper_shell", "Arguments": ", ".join("0" * dim) + f" : 1 : 2 : {4 if dim == 2 else 3} : true",
                     "Global refinements": finer},
            "Material": {"Young modulus": 1000, "Poisson ratio": nu}}),
            "Obstacle shaft": {"Shape": "sphere", "Radius": 1}, "Contact bore": contact(body="ring", ids=0, obstacle="shaft"),
            **{f"Support {axis}": support(2 + i, axis, body="ring") for i, axis in enumerate("xyz"[:dim])},
            "Load press": load("pressure", f"{pressure}*t", 1, "ring"), "Output": {"VTU": 0}})
        what = f"{dim}D, {kind['Element']}, refined {finer} times: a ring on a shaft"
        mean = sum(row["r_n"] for row in run.rows) / sum(row["area"] for row in run.rows)
        laws.check(f"{what}: mean pressure", abs(mean / exact - 1), 2e-2 / 4**finer)
        laws.check("  pressures", max(abs(row["pressure"] / exact - 1) for row in run.rows), (2e-2 if dim == 2 else 7e-2) / 2**finer)


def volumes(laws):
    """The force of a body force is the volume: of second order it is off by h^4."""
    for dim, kind in itertools.product((2, 3), (Q2, P2)):
        exact, errors = math.pi * (1 if dim == 2 else 4 / 3), []
        for finer in (1, 2):
            run = laws.run({"Dimension": dim, "Body ball": merge(kind, {
                "Mesh": {"Generator": "hyper_ball", "Arguments": ", ".join("0" * dim) + " : 1 : false", "Global refinements": finer},
                "Material": {"Young modulus": 1000, "Poisson ratio": .3}}),
                "Support rim": support(0, ", ".join("xyz"[:dim]), body="ball"),
                "Load weight": load("body force", " ; ".join(["1"] + ["0"] * (dim - 1)), body="ball"), "Output": {"VTU": 0}})
            errors.append([abs(run.increments[-1]["loads_f_x"] / exact - 1)])
        order = orders((1, 2), errors)[0]
        laws.check(f"{dim}D, {kind['Element']}: volume of a ball: error {errors[-1][0]:.2g}, order {order:.2f}, missing", max(0, 3.7 - order), 0)


def far(laws):
    """Finite sliding, and the iterative backend."""
    for dim in (2, 3):
        scene = with_element(press_and_shear(dim, increments=5), "Q2")
        compare(laws, f"{dim}D: both backends", scene)
        scene["Contact bottom"]["Friction coefficient"] = .03  # every node touches: none turns its neighbours' normals
        scene["Support top"]["Displacement"] = scene["Support top"]["Displacement"].replace("0.004", "0.43")
        plane = laws.run(scene)
        held = slab(scene, *(((28, 1), (7.0, .5), (-1.0, -.5)) if dim == 2 else ((13, 11, 1), (6.5, 4.4, .5), (-1.0, -1.0, -.5))))
        laws.same(f"{dim}D: a slab that is held is a plane", plane, of_body(laws.run(held)), 1e-8)
    scene = with_element(press_and_shear(2, mu=.3, increments=21), "Q2")
    scene["Support top"]["Displacement"] = "0.9*sin(pi*max(t - 1, 0)/10) ; -0.02*min(t, 1)"
    scene = slab(scene, (13, 2), (6.5, 1.0), (-2.25, -1.0), "bottom")
    scene["Body slab"]["Element"] = "Q2"
    run = laws.run(scene)
    laws.check("soft slab: energies", energy_error(run), 1e-9)
    laws.check("soft slab: balance", max(row[f"balance_{b}"] for row in run.increments for b in ("block", "slab")), 1e-10)
    laws.admissible("soft slab", of_body(run), lambda row: .3)


def converging(laws):
    # full slip, then full stick; reactions over areas: those at the edges are of a lower order
    names = [f"{what}, {state}" for state in ("slip", "stick") for what in ("displacement", "energy", "reactions")]
    for dim, sizes in ((2, (4, 8)), (3, (2, 4))):
        errors = [manufactured.solution_errors(laws, dim, n, body=Q2, degree=2) for n in sizes]
        for name, size, order, least in zip(names, errors[-1], orders(sizes, errors), (2.9, 1.9, 1.5) * 2):
            laws.check(f"{dim}D, Q2: {name}: error {size:.2g}, order {order:.2f}, missing", max(0, least - order), 0)
    triangles(laws)
    tetrahedra_orders(laws)
    lines(laws)


def simplex_orders(laws, dim, sizes, least):
    found = [manufactured.simplex_fields(laws, dim, n, "P2") for n in sizes]
    for i, state in enumerate(("slip", "stick")):
        for what, order in least.items():
            coarse, fine = (errors[i][what] for errors in found)
            seen, = orders(sizes, [[coarse], [fine]])
            laws.check(f"{dim}D, P2: {what}, {state}: error {fine:.2g}, order {seen:.2f}, missing", max(0, order - seen), 0)


def triangles(laws):
    simplex_orders(laws, 2, (4, 8), {"displacement at nodes": 2.9, "stresses at nodes": 1.8, "displacement in L2": 2.9, "energy": 1.9})


def tetrahedra_orders(laws):
    simplex_orders(laws, 3, (3, 6), {"displacement at nodes": 2.9, "stresses at nodes": 1.9, "displacement in L2": 2.9,
                                            "energy": 1.95, "pressures": 1.45, "pressures inside": 1.7})
    # P1 on the same places of nodes
    for state, of_p2, of_p1 in zip(("slip", "stick"), manufactured.simplex_fields(laws, 3, 4, "P2"), manufactured.simplex_fields(laws, 3, 8, "P1")):
        for what in ("displacement in L2", "energy"):
            laws.check(f"3D, {state}: {what}, {of_p2[what]:.2g} of P2 over {of_p1[what]:.2g} of P1 with as many unknowns",
                       of_p2[what] / of_p1[what], 1 / 3)


def lines(laws):
    """Hertz contact of a line: nodes as far apart as those of Q1."""
    exact = half_space.Hertz(2, half_space.POISSON["hertz"], 1)
    for n, widths in ((16, 2e-4), (32, 5e-5)):
        errors = {}
        for kind, cells in ((Q1, n), (Q2, n // 2)):
            scene = half_space.hertz(2, cells, 2)
            scene["Body block"].update(kind)
            rows = laws.run(scene).last()
            force = sum(row["r_n"] for row in rows)
            spread = sum(row["r_n"] * row["x"]**2 for row in rows) / force
            wrong, size = (sum(row["area"] * f(row["r_n"] / row["area"], exact.pressure(abs(row["x"])))**2 for row in rows)
                           for f in (lambda a, b: a - b, lambda a, b: b))
            errors[kind["Element"]] = (abs(2 * force / exact.force - 1), math.sqrt(wrong / size), abs(2 * math.sqrt(spread) - 1))
        for what, bound, a, b in zip(("force", "pressures in L2"), (.01, .6), errors["Q2"], errors["Q1"]):
            laws.check(f"Hertz, {n} nodes a half width: {what}, {a:.2g} of Q2 over {b:.2g} of Q1", a / b, bound)
        # of Q1 that is better by chance, as forces at nodes spread a little
        laws.check("  half width from the spread, Q2", errors["Q2"][2], widths)
