# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Loads beyond what contacts carry are told as what happens: which body slides or tips, and from which load on."""
import math
import re

from support.scenes import beam, box, contact, floor, joint, load, support


def told(laws, scene, *arguments):
    """The sentence of a refusal."""
    done, _ = laws.start(scene, *arguments)
    return done.stderr.strip() if done.returncode == 2 else f"exit code {done.returncode}: {done.stderr.strip()}"


def share(sentence):
    found = re.search(r"can carry at most ([0-9.]+[0-9])", sentence)
    return float(found[1]) if found else math.nan


def needed(sentence):
    found = re.search(r"(?:the largest to|coefficient of) ([0-9.]+[0-9])", sentence)
    return float(found[1]) if found else math.nan


def clamped_plates(times):
    """Two plates between frictionless pads, clamped by 5000, mu = .2, pulled apart by 1000 (t - 1)."""
    return {"Dimension": 3,
            "Body lower": box((6, 3, 1), (40.0, 20.0, 4.0), young=210e3),
            "Body upper": box((8, 3, 1), (40.0, 20.0, 4.0), (20.0, 0.0, 4.0), young=210e3,
                              **{"Boundary ids": "9: z > 7.999 && x < 35.001"}),
            "Obstacle pad": {"Shape": "half space", "Point": (30, 10, 8), "Normal": (0, 0, -1),
                             "Reference point": (30, 10, 8), "Free": "z", "Force": "0 ; 0 ; -5000*min(t, 1)"},
            "Obstacle anvil": floor(3),
            "Contact joint": joint("upper", 4, "lower", 5, **{"Friction coefficient": .2}),
            "Contact under pad": contact("upper", 9, "pad"), "Contact on anvil": contact("lower", 4, "anvil"),
            "Support wall": {"Body": "lower", "Boundary ids": 0},
            "Support guide": support(1, "y, z", "0 ; 0", "upper"),
            "Load pull": load("traction", "1000/80*max(t - 1, 0) ; 0 ; 0", 1, "upper"),
            "Time": {"Times": times}, "Output": {"VTU": 0}}


def lap_joint(laws):
    """What slips before the end of an increment is told with the same load, whatever the increment."""
    last = laws.run(clamped_plates("1, 1.9")).increments[-1]
    normal = abs(last["joint_f_z"])
    for times, first, length in (("1, 2.1", 0, 1.1), ("1, 1.5, 2.5", .5, 1.0)):
        sentence = told(laws, clamped_plates(times))
        laws.demand(sentence, "body 'upper' slides along (1, 0, 0)" in sentence and
                    "all of contact 'joint' slips" in sentence)
        found = (first + share(sentence) * length) * 1000
        laws.check("  its limit", abs(found / (.2 * normal) - 1), 5e-3)


def belt(laws):
    """A belt around half a drum turns with it from exp(mu pi) on; it is as thick as a hundredth of the radius."""
    scene = {"Dimension": 2,
             "Body belt": {"Mesh": {"Generator": "half_hyper_shell", "Arguments": "0, 0 : 10 : 10.1 : 40 : true"},
                           "Material": {"Young modulus": 1000, "Poisson ratio": 0}},
             "Obstacle drum": {"Shape": "cylinder", "Radius": 10}, "Contact wrap": contact("belt", 0, "drum", .3),
             "Load slack": load("traction", "-0.1*min(t, 1) ; 0", 2, "belt"),
             "Load tight": load("traction", "-0.1*min(t, 1) - 0.2*max(t - 1, 0) ; 0", 3, "belt"),
             "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}}
    sentence = told(laws, scene)
    laws.demand(sentence, "body 'belt' turns" in sentence)
    laws.check("  its limit", abs((1 + 2 * share(sentence)) / math.exp(.3 * math.pi) - 1), .02)


def leaning(body, weight, mu):
    """On a floor, against a smooth wall at x = 2.5."""
    return {"Dimension": 2, "Body ladder": body, "Obstacle floor": floor(2),
            "Obstacle wall": {"Shape": "half space", "Normal": (-1, 0), "Point": (2.5, 0)},
            "Contact foot": contact("ladder", 1 if "Frame" in body else 5, mu=mu),
            "Contact top": contact("ladder", 2 if "Frame" in body else 6, "wall"),
            "Load weight": {"Body": "ladder", **weight}, "Output": {"VTU": 0}}


def ladders(laws):
    """The friction that a ladder needs does not depend on its mesh."""
    end = (2.5, 5 * math.sin(math.pi / 3))
    line = {"Kind": "line load", "Boundary ids": 0, "Value": "0 ; -20*t"}
    for n in (3, 4, 8, 11):
        scene = leaning(beam((0.0, 0.0), end, n, 1e9, .1), line, .28)
        sentence = told(laws, scene)
        laws.demand(f"{n} beams: {sentence}", "body 'ladder' slides along (-1, 0, 0)" in sentence)
        laws.check("  the friction it needs", abs(needed(sentence) - .5 / math.tan(math.pi / 3)), 1e-6)
    # a plank of .1: the wall carries W (2.5 cos 60 - .05 sin 60)/(5 sin 60)
    exact = (2.5 * .5 - .05 * math.sqrt(.75)) / (5 * math.sqrt(.75))
    for cells in ((10, 1), (20, 2), (40, 4)):
        plank = box(cells, (5.0, .1), young=1e8, Rotation=60, **{"Boundary ids": "5: y < 0.2 ; 6: y > 4.2"})
        sentence = told(laws, leaning(plank, {"Kind": "body force", "Value": "0 ; -200*t"}, .2))
        laws.check(f"plank of {cells} cells: the friction it needs", abs(needed(sentence) - exact), 1e-6)


def dragged(dim, times="1, 2", **entries):
    """A flat block that is pressed by 2 and dragged by 0.8 (t - 1) along x, with other entries of its contact."""
    size, sides = ((20.0, 1.0), (2, 3)) if dim == 2 else ((20.0, 20.0, 1.0), (4, 5))
    drag = " ; ".join(["0.8*max(t - 1, 0)"] + ["0"] * (dim - 1))
    return {"Dimension": dim, "Body block": box((8, 1) if dim == 2 else (4, 4, 1), size, poisson=0),
            "Obstacle floor": floor(dim),
            "Contact sole": contact(ids=sides[0], **{"mu": .3, "Kinematics": "small", **entries}),
            "Load press": load("pressure", "2*min(t, 1)", sides[1]), "Load drag": load("traction", drag, sides[1]),
            "Time": {"Times": times}, "Output": {"VTU": 0}}


def reached(sentence, begin):
    """The time of a limit in an increment from `begin` on, or in the part of it that the sentence tells."""
    times = [float(found) for found in re.findall(r"t = ([0-9.]+[0-9]|[0-9]+)", sentence)]
    if len(times) == 0:
        return math.nan
    start = times[1] if len(times) > 1 else begin
    return start + share(sentence) * (times[0] - start)


def by_laws(laws):
    """Whatever the law of friction, its limit is told: before anything is tried where coefficients have a bound."""
    for dim in (2, 3):
        for text, entries in {"v, which does nothing": {"mu": "0.3 + 0*v"}, "p, which does nothing": {"mu": "0.3 + 0*p"},
                              "v, falling": {"mu": "0.2 + 0.1*exp(-v/5)"}, "v, rising": {"mu": "0.3 - 0.1*exp(-v/5)"},
                              "p": {"mu": "min(0.3, 3/p)"}, "a layer": {"Compliance": 1e-4},
                              "wear": {"Wear coefficient": 1e-6}, "a shear limit far away": {"Shear limit": 100},
                              "two axes": {"Second friction coefficient": "0.3 + 0*v"}}.items():
            if dim == 2 and "Second friction coefficient" in entries:
                continue
            sentence = told(laws, dragged(dim, **entries))
            laws.demand(f"{dim}D, {text}: {sentence}", "no equilibrium exists, body 'block' slides along (1, 0" in sentence)
            laws.check("  its limit", abs(share(sentence) - .75), 1e-4)
        for text, limit, entries in (("a shear limit", .4, {"Shear limit": .4}), ("cohesion", .7, {"Cohesion": .1})):
            sentence = told(laws, dragged(dim, **entries))
            laws.demand(f"{dim}D, {text}: {sentence}", "no equilibrium exists, body 'block' slides along (1, 0" in sentence)
            laws.demand("  which is no less than its limit", .8 * (reached(sentence, 1) - 1) > .99 * limit)
        laws.check("  and that", abs(.8 * (reached(sentence, 1) - 1) / limit - 1), 1e-2)


def not_by_cones(laws):
    """Two blocks that a spring joins slide together; a lid that a fluid presses from below lifts off; a block with a shear
    limit slides by that."""
    scene = dragged(3)
    scene["Body other"] = box((4, 4, 1), (20.0, 20.0, 1.0), (30.0, 0.0, 0.0), poisson=0)
    scene["Contact other sole"] = contact("other", 4, mu=.3, Kinematics="small")
    scene["Contact link"] = {"Kind": "spring", "Body": "block", "Master body": "other", "Point": (20, 10, 0),
                             "Master point": (30, 10, 0), "Stiffness": 500}
    scene["Load press other"] = load("pressure", "2*min(t, 1)", 5, "other")
    scene["Load drag"]["Value"] = "1.6*max(t - 1, 0) ; 0 ; 0"
    sentence = told(laws, scene)
    laws.demand(sentence, "slides along (1, 0" in sentence)
    laws.check("  its limit", abs(1.6 * (reached(sentence, 1) - 1) / 1.2 - 1), 5e-3)

    scene = dragged(2, **{"Penetrating pressure": "t", "Fluid from boundary ids": "0, 1"})
    del scene["Load drag"]
    scene["Load press"]["Value"] = 5
    scene["Time"] = {"Times": "1, 4, 8"}
    sentence = told(laws, scene)
    laws.demand(sentence, "no equilibrium exists, body 'block' lifts off, moving along (0, 1, 0)" in sentence)


def rings():
    """Two rings from radius 10 to 20 and on to 30, of quadrilaterals whose nodes are on circles but for rounding."""
    text = "Point(99)={0,0,0};\n"
    for ring, (inner, outer) in enumerate(((10, 20), (20, 30))):
        k = 100 * ring
        for i in range(4):
            for j, radius in ((1, inner), (11, outer)):
                text += f"Point({k + j + i})={{{radius}*Cos({i}*Pi/2),{radius}*Sin({i}*Pi/2),0}};\n"
        for i in range(4):
            j = (i + 1) % 4
            text += (f"Circle({k + 1 + i})={{{k + 1 + i},99,{k + 1 + j}}};Circle({k + 11 + i})={{{k + 11 + i},99,{k + 11 + j}}};"
                     f"Line({k + 21 + i})={{{k + 1 + i},{k + 11 + i}}};\n")
        for i in range(4):
            j = (i + 1) % 4
            text += (f"Curve Loop({k + 1 + i})={{{k + 1 + i},{k + 21 + j},{-(k + 11 + i)},{-(k + 21 + i)}}};"
                     f"Plane Surface({k + 1 + i})={{{k + 1 + i}}};Transfinite Curve{{{k + 1 + i},{k + 11 + i}}}=7;"
                     f"Transfinite Curve{{{k + 21 + i}}}=5;Transfinite Surface{{{k + 1 + i}}};Recombine Surface{{{k + 1 + i}}};\n")
    for name, k in (("shaft", 0), ("hub", 100)):
        text += (f'Physical Surface("{name}")={{{k + 1}:{k + 4}}};Physical Curve("inside of {name}")={{{k + 1}:{k + 4}}};'
                 f'Physical Curve("outside of {name}")={{{k + 11}:{k + 14}}};\n')
    return text


def press_fit(laws, torque, slave):
    """A hub shrunk by .02 onto a shaft that is held inside, turned by a torque by way of its rim, which stays round."""
    (laws.folder / "rings.geo").write_text(rings())

    def ring(name):
        return {"Mesh": {"File": "rings.geo", "Group": name}, "Material": {"Young modulus": 210e3, "Poisson ratio": .3}}
    sides = ["shaft", "outside of shaft", "hub", "inside of hub"]
    return {"Dimension": 2, "Body shaft": ring("shaft"), "Body hub": ring("hub"),
            "Contact fit": joint(*(sides if slave == "shaft" else sides[2:] + sides[:2]),
                                 **{"Gap": "-0.02*min(t, 1)", "Friction coefficient": "if(t <= 1, 0, 0.15)"}),
            "Support core": support("inside of shaft", "x, y", body="shaft"),
            "Load torque": {"Body": "hub", "Boundary ids": "outside of hub", "Kind": "moment", "Coupling": "rigid",
                            "Value": f"{torque!r}*max(t - 1, 0)", "Point": "0, 0"},
            "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}}


def press_fits(laws):
    """A press fit turns under mu p 2 pi r^2, and not as far away as rounding of its circles would hold it."""
    whole = .15 * 301.44 * 2 * math.pi * 20 ** 2  # p by Lame, of circles
    for slave in ("shaft", "hub"):
        held = laws.run(press_fit(laws, .98 * whole, slave))
        rows = [row for row in held.rows if row["contact"] == "fit" and row["increment"] == 1]
        most = .15 * 20 * sum(row["r_n"] for row in rows)
        laws.check(f"nodes of the {slave}: pressure beside that of circles", abs(most / whole - 1), .02)
        laws.demand("  a torque of .98 of it is held", len(held.increments) == 2)
        for factor in (1.005, 1.05, 2.0):
            sentence = told(laws, press_fit(laws, factor * most, slave))
            laws.demand(f"  {factor}: {sentence}", "no equilibrium exists, body 'hub' turns about (0, 0, 1)" in sentence)
            laws.check("  its limit", abs(share(sentence) * factor - 1), 5e-3)


def released(laws):
    """The share is one of the loads: what a support held that is released before has no part in it."""
    scene = {"Dimension": 2, "Body plate": box((12, 2), (60.0, 10.0), young=210e3, **{"Boundary ids": "5: y > 9.99"}),
             "Obstacle floor": floor(2), "Contact sole": contact("plate", mu=.3),
             "Load press": load("pressure", f"{1000 / 60!r}*min(t, 1)", 5, "plate"),
             "Load pull": load("force", "", 1, "plate", Point="60, 0.5"),
             "Support jig": support(0, "x", body="plate", Active="t < 1.5"), "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}}
    for load_at_end in (303.0, 450.0):
        scene["Load pull"]["Value"] = f"{load_at_end}*max(t - 1, 0) ; 0"
        sentence = told(laws, scene)
        laws.demand(sentence, "slides along (1, 0, 0)" in sentence)
        laws.check("  its limit", abs(share(sentence) * load_at_end / 300 - 1), 1e-5)


def pushed_askew(laws):
    """A block on another one, pressed, pushed and turned: the friction that is told does not depend on that at hand,
    a little more of it holds, a little less does not."""
    def scene(mu):
        return {"Dimension": 3, "Body lower": box((3, 3, 2), (2.5, 2.0, 1.0), (-.5, -.5, -1.0)),
                "Body upper": box((4, 3, 2), (1.6, 1.0, .5)), "Contact joint": joint("upper", 4, "lower", 5, **{"Friction coefficient": mu}),
                "Support ground": {"Body": "lower", "Boundary ids": 4},
                "Load press": load("traction", "1.2 ; 4.6 ; -20", 5, "upper"), "Load side": load("pressure", 2, 0, "upper"),
                "Output": {"VTU": 0}}
    least = [needed(told(laws, scene(mu))) for mu in (.01, .1, .2)]
    laws.check("needed friction, whatever is at hand", max(abs(mu / least[0] - 1) for mu in least), 1e-5)
    laws.demand("  1.001 of it holds", laws.start(scene(1.001 * least[0]))[0].returncode == 0)
    laws.demand("  .999 does not", "no equilibrium exists" in told(laws, scene(.999 * least[0])))


def braked_rollers(laws):
    """A plate on two rollers whose brakes use up friction, pulled by a tenth more than they hold: no share of the load is carried,
    as the brakes are a part of it, and none is told."""
    mu, weight, radius = .2, 4.0, 4.0
    scene = {"Dimension": 2, "Body plate": box((40, 4), (32.0, 2.0), young=500.0), "Output": {"VTU": 0},
             "Load weight": load("pressure", f"{weight / 32!r}*t", 3, "plate"),
             "Load pull": load("force", f"{1.1 * mu * weight!r}*t ; 0", 1, "plate")}
    for name, x in (("left", 8.0), ("right", 24.0)):
        centre = (x, -radius)
        scene[f"Obstacle {name}"] = {"Shape": "sphere", "Center": centre, "Radius": radius, "Free": "rz", "Reference point": centre,
                                     "Moment": f"{mu * weight / 2 * radius!r}*t"}
        scene[f"Contact {name}"] = contact("plate", 2, name, mu)
    done, folder = laws.start(scene)
    laws.demand(done.stderr.strip(), done.returncode == 2 and "not even under the smallest part" in done.stderr
                and "turns about (0, 0, 1)" in done.stderr and "can carry" not in done.stderr and "Apply less load" not in done.stderr)
    solves = int(re.search(r"(\d+) linear solves of contact", (folder / "log.txt").read_text())[1])
    laws.check("  solves", solves, 3800)


def limits(laws):
    braked_rollers(laws)
    pushed_askew(laws)
    press_fits(laws)
    released(laws)
    by_laws(laws)
    not_by_cones(laws)
    lap_joint(laws)
    belt(laws)
    ladders(laws)
