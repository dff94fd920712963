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
    found = re.search(r"the largest to ([0-9.]+[0-9])", sentence)
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


def limits(laws):
    lap_joint(laws)
    belt(laws)
    ladders(laws)
