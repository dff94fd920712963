# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies on two feet that both slip outward: what moves them sideways is next to nothing, and only friction that turns resists it."""
import math

from laws.limits import told
from support.meshes import write_msh
from support.scenes import box, contact, floor, load, merge
from support.tables import Events

MU = .02


def beam(lean, pressed, increments):
    """A block with its weight on the ends of its lower side, and a traction in the middle of the upper one."""
    return {"Dimension": 2,
            "Body beam": box((20, 4), (20.0, 2.0), young=1e5, poisson=.2,
                             **{"Boundary ids": f"5: y < 1e-6 && (x < 3 || x > 17) ; 6: y > 1.99 && {pressed}"}),
            "Obstacle floor": floor(2), "Contact feet": contact("beam", 5, mu=MU),
            "Load weight": load("body force", "0 ; -0.3", body="beam"),
            "Load press": load("traction", f"{lean!r}*t ; -t", 6, "beam"),
            "Time": {"End": 50, "Increments": increments}, "Output": {"VTU": 0}}


def feet(laws):
    """Each increment has an equilibrium: friction could hold a hundred times what is across."""
    for lean, pressed in ((-.0011, "x > 8 && x < 10.5"), (0.0, "x > 8 && x < 10.5"), (0.0, "x > 7 && x < 9.5"), (.0007, "x > 11 && x < 14")):
        for increments in (50, 5):
            run = laws.run(beam(lean, pressed, increments))
            name = f"feet, lean {lean:g}, {pressed}, {increments} increments"
            laws.demand(f"{name}: solved to the end", len(run.increments) == increments)
            last, rows = run.increments[-1], run.last()
            force = max(row["r_n"] for row in rows)
            laws.check("  forces of the feet", max(abs(last[f"feet_f_{a}"] + last[f"loads_f_{a}"]) for a in "xy") / force, 1e-10)
            laws.check("  cones", max(abs(row["r_t1"]) - MU * row["r_n"] for row in rows) / force, 1e-11)
            laws.demand("  both feet slip outward", all(row["r_t1"] * (10 - row["x"]) >= 0 for row in rows))


def stone(file, corners, cells):
    """A quadrilateral of cells by 2; ids: 1 its first side, 3 the opposite one."""
    at = {(i, j): i + j * (cells + 1) for j in range(3) for i in range(cells + 1)}
    weights = [((1 - i / cells) * (1 - j / 2), i / cells * (1 - j / 2), i / cells * j / 2, (1 - i / cells) * j / 2) for j in range(3) for i in range(cells + 1)]
    points = [tuple(sum(w * c[d] for w, c in zip(weight, corners)) for d in range(2)) + (0.0,) for weight in weights]
    quads = [[at[i, j], at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]] for j in range(2) for i in range(cells)]
    write_msh(file, 2, points, quads, [(tag, (at[i, j], at[i + 1, j])) for tag, j in ((1, 0), (3, 2)) for i in range(cells)])


def arch(folder, mu):
    """Half a ring of seven stones with their weight, on a floor; a force grows on the crown. The last stone has fewer cells."""
    n, inner, outer = 7, 1.0, 1.2
    angles = [math.pi * (1 - i / n) for i in range(n + 1)]
    scene = {"Dimension": 2, "Obstacle floor": floor(2), "Time": {"Times": 1e4}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}
    for i, (a, b) in enumerate(zip(angles, angles[1:])):
        stone(folder / f"stone{i}.msh", [(r * math.cos(x), r * math.sin(x)) for r, x in ((outer, a), (inner, a), (inner, b), (outer, b))], 2 if i == n - 1 else 3)
        scene[f"Body b{i}"] = {"Mesh": {"File": f"stone{i}.msh"}, "Material": {"Young modulus": 1e8, "Poisson ratio": .2}}
        scene[f"Load w{i}"] = load("body force", "0 ; -1", body=f"b{i}")
    for i in range(1, n):
        scene[f"Contact c{i}"] = {"Body": f"b{i}", "Boundary ids": 1, "Master body": f"b{i - 1}", "Master boundary ids": 3, "Friction coefficient": mu}
    scene["Contact left"] = contact("b0", 1, mu=mu)
    scene["Contact right"] = contact(f"b{n - 1}", 3, mu=mu)
    scene["Load crown"] = load("point force", "0 ; -t", body=f"b{n // 2}", Point=(0, .5 * (inner + outer)))
    return scene


def arches(laws):
    """Where both feet slip outward, loads grow on; the limit is where increments end."""
    for mu in (.35, .4):
        scene = arch(laws.folder, mu)
        run = laws.run(scene)
        events = Events(run.folder)
        laws.demand(f"arch, mu = {mu}: {events.words}", events.words == "limit load: sliding")
        limit = events.parameter
        for part, holds in ((.999, True), (1.001, False)):
            times = ", ".join(repr(limit * part * i / 10) for i in range(1, 11))
            sentence = told(laws, merge(scene, {"Solver": {"Method": "automatic"}, "Time": {"Times": times}}))
            laws.demand(f"  {part} of it is {'held' if holds else 'refused'} by increments",
                        sentence.startswith("exit code 0" if holds else "conetact: Increment 10 of 10") and
                        holds != ("no equilibrium exists" in sentence))


def spreading(laws):
    feet(laws)
    arches(laws)
