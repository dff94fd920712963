# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which kinematics a contact has by itself: small, finite sliding where something turns or slides far."""
import math
import re

from laws.sliding import slab
from support.logs import log_of
from support.scenes import box, contact, floor, joint, load, merge, press_and_shear, ring, support
from support.vectors import apply, rotation


def chosen(run):
    """Of each contact, as log.txt says it last."""
    return dict(re.findall(r"^Contact (.+): kinematics (finite sliding|small)", log_of(run), re.M))


def with_kinematics(scene, kinematics):
    return merge(scene, {key: {"Kinematics": kinematics} for key in scene if key.startswith("Contact ")})


def demand_equal(laws, what, scene, kinematics):
    """What is chosen is that, and tables are the same to their last digit."""
    own, asked = laws.run(with_kinematics(scene, "automatic")), laws.run(with_kinematics(scene, kinematics))
    laws.demand(f"{what}: it chooses {chosen(own)}", set(chosen(own).values()) == {kinematics})
    laws.demand(f"{what}: tables of {kinematics}", all((own.folder / table).read_text() == (asked.folder / table).read_text()
                                                      for table in ("reactions.csv", "increments.csv")))
    return own


def pressed_cylinders(depth, radius=8.0):
    """Two equal half cylinders, one against the other by a part of their radius."""
    def half(sign):
        low, high = (-.3, -.05) if sign < 0 else (-.05, -.3)
        boxes = f"{-.3*radius}, {low*radius} : {.3*radius}, {-high*radius} : 2"
        return {"Mesh": {"Generator": "half_hyper_ball", "Arguments": f"0, 0 : {radius!r}", "Global refinements": 3,
                         "Refinement boxes": boxes, "Rotation": 90 * sign * -1, "Translation": f"0, {sign*radius!r}",
                         "Boundary ids": f"2: {sign}*y < {.3*radius!r} ; 4: {sign}*y > {.999*radius!r}"},
                "Material": {"Young modulus": 200, "Poisson ratio": .3}}
    return {"Dimension": 2, "Body upper": half(1), "Body lower": half(-1),
            "Contact nip": {"Body": "upper", "Boundary ids": 2, "Master body": "lower", "Master boundary ids": 2,
                            "Friction coefficient": .2},
            "Support top": support(4, "x, y", f"0 ; {-depth*radius!r}", "upper"), "Support base": support(4, "x, y", body="lower"),
            "Time": {"Increments": 1}, "Output": {"VTU": 0}}


def shear(run, mu):
    """The sum of shears over that of the friction there may be."""
    rows = [row for row in run.last() if row["contact"] == "nip"]
    return sum(abs(row["r_t1"]) for row in rows) / (mu * sum(row["r_n"] for row in rows))


def same_decisions(laws):
    """How far a body turns is that of its nodes, by whichever backend: of one on springs, and of one that is tied and bends."""
    plain = {"Dimension": 3, "Output": {"VTU": 0}, "Load push": load("traction", "15*t ; 0 ; 0", 5), "Time": {"End": 2, "Increments": 2}}
    on_springs = {**plain, "Body block": box((6, 6, 6), (1.0, 1.0, 1.0))}
    for n, (x, y, axis) in enumerate((x, y, axis) for x in (0.0, 1.0) for y in (0.0, 1.0) for axis in range(3)):
        end = [x, y, 0.0]
        end[axis] += .5 if end[axis] > .5 else -.5
        on_springs[f"Contact s{n}"] = {"Kind": "spring", "Body": "block", "Point": (x, y, 0.0), "Master point": tuple(end), "Stiffness": 400.0}
    tied = {**merge(plain, {"Load push": {"Value": "0.7*t ; 0 ; 0", "Body": "stud"}}), "Body plate": box((4, 4, 2), (2.0, 2.0, 1.0), young=1e4),
            "Body stud": box((2, 2, 12), (.5, .5, 3.0), (.75, .75, 1.0)), "Support plate": support(4, "x, y, z", body="plate"),
            "Contact foot": joint("stud", 4, "plate", 5, Kind="tie"),
            "Obstacle wall": floor(3, Normal=(-1, 0, 0), Point=(4, 0, 0)), "Contact wall": contact("stud", 1, "wall")}
    for what, scene in (("on springs", on_springs), ("tied", tied)):
        said = []
        for backend in ("condensed", "iterative"):
            done, folder = laws.start(merge(scene, {"Solver": {"Backend": backend}}))
            log = (folder / "log.txt").read_text()
            said.append((done.returncode, re.findall(r"turns by [-+.e0-9]+[0-9]", log)))
        laws.demand(f"a body {what}: exit codes and turns {said}", said[0] == said[1] and said[0][1])


def symmetric_shear(laws):
    for depth in (.002, .005, .01):
        run = laws.run(with_kinematics(pressed_cylinders(depth), "finite sliding"))
        laws.check(f"equal cylinders, pressed by {depth:g} of their radius: shear over friction", shear(run, .2), 1e-6)
        laws.demand("  finite sliding", chosen(run) == {"nip": "finite sliding"})
    for kinematics in ("automatic", "small"):  # normals between both sides: right but for how these turn
        run = laws.run(with_kinematics(pressed_cylinders(.01), kinematics))
        laws.check(f"  {kinematics}: shear over friction", shear(run, .2), 1e-3)
        laws.demand("  with one warning", log_of(run).count("contact is that of the undeformed bodies") == 1)


def far_block(dim=2):
    """It is pressed on another one and slides by several of its cells."""
    scene = press_and_shear(dim, increments=6)
    scene["Support top"]["Displacement"] = scene["Support top"]["Displacement"].replace("0.004", "0.11")
    scene = slab(scene, (28, 2), (7.0, .5), (-1.0, -.5), "bottom")
    return scene


def choices(laws):
    # what is plane and stays so
    demand_equal(laws, "a block on a plane", press_and_shear(2), "small")
    demand_equal(laws, "a block on a plane, turned", merge(press_and_shear(2, Rotation=37.0), {
        "Obstacle floor": {"Normal": apply(rotation((0, 0, 1), 37.0), (0, 1, 0))[:2]},
        "Support top": {"Displacement": "0.01*sin(37*pi/180)*t ; -0.01*cos(37*pi/180)*t"}}), "small")
    near = far_block()
    near["Support top"]["Displacement"] = "0.004*max(t - 1, 0) ; -0.01*min(t, 1)"
    demand_equal(laws, "a block on another one", near, "small")
    demand_equal(laws, "facets of a plane to rounding", merge(press_and_shear(2), {"Obstacle floor": None}) | {
        "Obstacle floor": {"Shape": "implicit", "Function": "y + 1e-6*sin(7*x)"}}, "small")
    # what turns or slides far
    tilting = merge(press_and_shear(2), {"Obstacle floor": {"Turn": "2*max(t - 1, 0)"},
                                         "Support top": {"Displacement": "0 ; -0.05*min(t, 1)"}})
    demand_equal(laws, "a floor that turns", tilting, "finite sliding")
    demand_equal(laws, "a block that slides by several cells", far_block(), "finite sliding")


def other_units(laws):
    """The same in other lengths, and turned."""
    m = rotation((0, 0, 1), 23.0)
    for length, degrees in ((1e-4, 0.0), (1e5, 0.0), (1.0, 23.0)):
        what = f"lengths times {length:g}, turned by {degrees:g}"
        block = box((6, 3), (2.0 * length, length), Rotation=degrees)
        down = apply(m, (0, -1, 0))[:2] if degrees else (0.0, -1.0)
        up = tuple(-c for c in down)
        scene = {"Dimension": 2, "Body block": block, "Load weight": load("traction", " ; ".join(f"{c!r}*t" for c in down), 3),
                 "Obstacle floor": floor(2, Normal=up), "Contact bottom": contact(mu=.3), "Output": {"VTU": 0}}
        laws.demand(f"{what}: a plane is one", chosen(laws.run(scene)) == {"bottom": "small"})
        radius = 50.0 * length
        middle = tuple(length * a - radius * b for a, b in zip(apply(m, (1, 0, 0))[:2] if degrees else (1.0, 0.0), up))
        scene["Obstacle floor"] = {"Shape": "cylinder", "Point": middle, "Radius": radius}
        laws.demand(f"{what}: a cylinder is none", "finite sliding would follow that" in log_of(laws.run(scene)))


def leaning_plank(laws):
    """What a plank needs to stand at a smooth wall, by moments about its foot, on any mesh."""
    length, width, degrees = 5.0, .1, 60.0
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    needed = (length * c - width * s) / 2 / (length * s)
    for cells in ((20, 2), (7, 1)):
        for mu in (.2, .95 * needed, 1.01 * needed):
            scene = {"Dimension": 2, "Body plank": box(cells, (length, width), young=1e8, Rotation=degrees,
                                                       **{"Boundary ids": "5: y < 0.2 ; 6: y > 4.2"}),
                     "Obstacle floor": floor(2), "Obstacle wall": {"Shape": "half space", "Normal": (-1, 0), "Point": (length * c, 0.0)},
                     "Contact foot": contact("plank", 5, "floor", mu), "Contact top": contact("plank", 6, "wall"),
                     "Load weight": load("body force", "0 ; -200*t", body="plank"), "Output": {"VTU": 0}}
            done, _ = laws.start(scene)
            what = f"a plank of {cells[0]} cells, mu {mu:.3g}"
            laws.demand(f"{what}: exit code {done.returncode}", done.returncode == (0 if mu > needed else 2))
            if mu < needed:
                found = re.search(r"the largest to ([\d.]+), to hold it", done.stderr)
                laws.check(f"{what}: friction that it needs, {done.stderr.strip()}", abs(float(found[1]) / needed - 1) if found else 1, 1e-4)


def soft_bodies(laws):
    """A load of a million times Young's modulus: no smaller increment is asked for."""
    done, _ = laws.start({"Dimension": 2, "Body block": box((4, 2), (1.0, .5)), "Body slab": box((9, 2), (2.0, .5), (-.5, -.5)),
                          "Support base": support(2, "x, y", body="slab"), "Load weight": load("pressure", "1e9*t", 3, body="block"),
                          "Contact bottom": {"Body": "block", "Boundary ids": 2, "Master body": "slab", "Master boundary ids": 3,
                                             "Friction coefficient": .3, "Kinematics": "finite sliding"}})
    laws.demand(f"soft bodies: {done.stderr.strip()}", done.returncode == 2 and "Loads are far too large" in done.stderr)


def turned_hubs(laws):
    """A hub is turned on its shaft: the warning of its normals says where friction holds no more, for it may have been passed."""
    told = "All of its nodes that touch slip"
    for mu, slips in ((.1, True), (.6, False), (0.0, False)):
        run = laws.run({"Dimension": 2, "Body hub": ring(1.0, 1.5, 48), "Body shaft": ring(.5, 1.0, 48),
                        "Contact fit": {**joint("hub", 0, "shaft", 1), "Pairing": "node to face", "Friction coefficient": mu, "Gap": "-0.01*min(t, 1)"},
                        "Support inside": support(0, "x, y", body="shaft"),
                        "Support outside": support(1, "x, y", "-0.02*max(t - 1, 0)*y ; 0.02*max(t - 1, 0)*x", "hub"),
                        "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}})
        warnings = [line for line in log_of(run).splitlines() if "the contact normal at" in line]
        laws.demand(f"a hub, mu = {mu}: a warning of its normals", len(warnings) == 1)
        laws.demand(f"  that says {'' if slips else 'nothing of '}a limit of friction", (told in warnings[0]) == slips)
        laws.demand("  which is so", all((row["state"] == "slip") == slips for row in run.last()) or mu == 0)


def kinematics(laws):
    turned_hubs(laws)
    soft_bodies(laws)
    symmetric_shear(laws)
    same_decisions(laws)
    choices(laws)
    other_units(laws)
    leaning_plank(laws)
