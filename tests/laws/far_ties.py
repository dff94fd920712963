# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ties that turn with their bodies."""
import math

from laws.far_turns import rolled
from laws.kinematics import chosen
from laws.restart import difference, go_on
from laws.sliding import FAR
from laws.tie import tie
from support.scenes import box, contact, load, merge, support, write_scene
from support.tables import MOTION, in_space, normal
from support.vectors import apply, rotation

JOINT = "joint"


def far_ties(laws):
    turned_bars(laws)
    one_mesh(laws)
    chosen_kinematics(laws)
    what_stays(laws)
    goes_on(laws)
    rolled_halves(laws)


def bars(dim, degrees, axis=(0, 0, 1), exchanged=False, **entries):
    """Two bars tied end to end, meshes that do not match; the left end turns, pressures at the other one turn along."""
    cells = ((4, 2), (4, 3)) if dim == 2 else ((3, 2, 2), (3, 3, 2))
    size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, .8)
    pair = (("left", 1), ("right", 0))
    slave, master = pair[::-1] if exchanged else pair
    ids = (1, 3) if dim == 2 else (1, 5)
    return {"Dimension": dim, "Body left": box(cells[0], size),
            "Body right": box(cells[1], size, (size[0],) + (0.0,) * (dim - 1)),
            f"Contact {JOINT}": tie(*slave, *master, **entries),
            "Support hub": {"Body": "left", "Boundary ids": 0, "Turn": f"{degrees!r}*min(t, 1)",
                            "Turn axis": tuple(map(float, axis)), "Reference point": (.3, .2, .1)[:dim]},
            "Load end": load("pressure", "2*max(t - 1, 0)", ids[0], "right"),
            "Load side": load("pressure", "0.3*max(t - 1, 0)", ids[1], "right"),
            "Time": {"Stages": "1 : 3, 2 : 1"}, "Output": {"VTU": 0}}


def turned_bars(laws):
    for dim, degrees, axis in ((2, 90.0, (0, 0, 1)), (3, 90.0, (1, 2, 3))):
        for exchanged, entries in ((False, {}), (True, FAR)):
            still = laws.run(bars(dim, 0.0, axis, exchanged, **entries))
            turned = laws.run(bars(dim, degrees, axis, exchanged, **entries))
            what = f"{dim}D, tied bars turned by {degrees:g} degrees{', exchanged' * exchanged}"
            a, b = (run.increments[-1] for run in (turned, still))
            laws.check(f"{what}: strain energy", abs(a["strain_energy"] / b["strain_energy"] - 1), 1e-10)
            laws.check("  before it is loaded", turned.increments[2]["strain_energy"] / b["strain_energy"], 1e-20)
            rows = {run: [row for row in run.last() if row["contact"] == JOINT] for run in (turned, still)}
            force = max(abs(row["r_n"]) for row in rows[still])
            laws.check("  stresses of the joint", max(abs(p[c] - q[c]) for p, q in zip(rows[turned], rows[still])
                                                      for c in ("r_n",)) / force, 1e-10)
            m = rotation(axis, degrees)
            laws.check("  its forces turn along", max(
                math.dist(in_space(p, dim, ("r_n", "r_t1", "r_t2")), apply(m, in_space(q, dim, ("r_n", "r_t1", "r_t2"))))
                for p, q in zip(rows[turned], rows[still])) / force, 1e-10)
            laws.check("  its normals too", max(math.dist(normal(p), apply(m, normal(q)))
                                                for p, q in zip(rows[turned], rows[still])), 1e-10)


def one_mesh(laws):
    """Tied bars of meshes that match are one bar, also where loads bend them far."""
    two = bars(2, 60.0)
    two["Body right"] = box((4, 2), (2.0, 1.0), (2.0, 0.0))
    for side in ("end", "side"):
        two.pop(f"Load {side}")
    one = {**{k: v for k, v in two.items() if not k.startswith(("Body", "Contact"))}, "Body left": box((8, 2), (4.0, 1.0)),
           "Load weight": load("traction", "0 ; -2*t", 1, "left")}
    two["Load weight"] = load("traction", "0 ; -2*t", 1, "right")
    a, b = (laws.run(scene).increments[-1] for scene in (two, one))
    laws.check("two tied bars that turn are one: strain energy", abs(a["strain_energy"] / b["strain_energy"] - 1), 1e-5)
    laws.check("  force of the support", math.hypot(*(a[f"support_hub_f_{c}"] - b[f"support_hub_f_{c}"] for c in "xy")) /
               abs(b["support_hub_f_y"]), 1e-10)


def with_far_floor(scene):
    return merge(scene, {"Obstacle floor": {"Shape": "half space", "Normal": (0, 1), "Point": (0, -50.0)},
                         "Contact end": contact("right", 1, "floor")})


def chosen_kinematics(laws):
    """A contact of what is tied to a body that turns follows it by itself."""
    run = laws.run(with_far_floor(bars(2, 90.0)))
    laws.demand(f"automatic kinematics of tied bars: {chosen(run)}", chosen(run)["end"] == "finite sliding")
    laws.check("  strain energy before it is loaded", run.increments[2]["strain_energy"] / run.increments[-1]["strain_energy"], 1e-20)


def what_stays(laws):
    """Ties that cannot turn are told before anything is written."""
    for what, change in (("across a gap", {"Body right": box((4, 3), (2.0, 1.0), (2.01, 0.0))}),
                         ("with a Preload", {f"Contact {JOINT}": {"Preload": "t"}, "Support end": support(1, "x, y", body="right")}),
                         ("of a body on rollers", {"Support side": support(2, "normal", body="right")})):
        done, folder = laws.start(merge(bars(2, 90.0), change))
        laws.demand(f"a tie {what} does not turn: {done.stderr.strip()}",
                    done.returncode == 1 and "Turn" in done.stderr and "tied" in done.stderr and not folder.exists())


def goes_on(laws):
    """From a checkpoint in the middle of the turn."""
    scene = merge(with_far_floor(bars(2, 90.0)), {"Load end": {"Value": "2*t"}, "Load side": {"Value": "0.3*t"}, "Output": {"Checkpoint": 2}})
    whole = laws.run(scene)
    file = laws.folder / "far-ties.prm"
    write_scene(scene, file)
    short = laws.folder / "far-ties-short.prm"
    write_scene(merge(scene, {"Time": {"Stages": None, "Times": [row["time"] for row in whole.increments][:2]}}), short)
    folder = laws.folder / "far-ties"
    laws.batch.run(short, "-o", folder, "--quiet").check_returncode()
    if go_on(laws, file, folder):
        laws.check("  difference from one run", difference(whole.folder, folder), 1e-12)


def rolled_halves(laws):
    """A disc that rolls between plates, whole and as two halves that are tied."""
    def half(name, degrees):
        return {f"Body {name}": {"Mesh": {"Generator": "half_hyper_shell", "Arguments": "0, 0 : 0.4 : 1 : 8 : false",
                                          "Global refinements": 1, "Rotation": degrees, "Translation": (0.0, 1.0),
                                          "Boundary ids": "5: x*x + (y - 1)*(y - 1) > 0.98 ; 6: abs(x) < 1e-9"},
                                 "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}}}
    disc = merge(rolled(8, way=.8), {"Obstacle high": {"Displacement": "0.8*max(t - 1, 0) ; -0.005*min(t, 1)"}})
    whole = merge(disc, {"Body disc": {"Mesh": {"Generator": "hyper_shell", "Arguments": "0, 1 : 0.4 : 1 : 16 : true",
                                                "Global refinements": 1}},
                         "Contact low": {"Boundary ids": 1}, "Contact high": {"Boundary ids": 1}})
    whole["Body disc"]["Mesh"].pop("Rotation", None)
    halves = {k: v for k, v in disc.items() if not k.startswith(("Body", "Contact"))}
    halves.update({**half("one", 0.0), **half("two", 180.0), "Contact middle": tie("one", 6, "two", 6),
                   **{f"Contact {plate} {body}": contact(body, 5, plate, .5, **FAR) for plate in ("low", "high") for body in ("one", "two")}})
    a, b = laws.run(halves), laws.run(whole)
    forces = [[row[f"{plate}_f_{c}"] for row in b.increments for plate in ("low", "high") for c in "xy"],
              [row[f"{plate}_one_f_{c}"] + row[f"{plate}_two_f_{c}"] for row in a.increments for plate in ("low", "high") for c in "xy"]]
    laws.check("a rolling ring of two tied halves is one", max(abs(p - q) for p, q in zip(*forces)) / max(map(abs, forces[0])), 1e-6)
