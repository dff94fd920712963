# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What forces leave open, and what is left of them when they vanish."""
import math

from support.scenes import box, contact, floor, load, merge, support
from support.vectors import apply, rotation

PRESSED = {"Dimension": 2, "Body block": box((3, 3), (2.0, 1.0), (-1.0, 0.0), poisson=.4), "Obstacle floor": floor(2),
           "Contact bottom": contact(ids=2, mu=.05), "Load press": load("traction", "0 ; -t", 3),
           "Output": {"VTU": 0}}


def all_slip(laws):
    """A block that is pressed spreads to both sides alike, in one increment or many, alone or on another."""
    for n in (1, 7, 30):
        rows = laws.run(merge(PRESSED, {"Time": {"Increments": n}})).last()
        slid = {row["x"]: row["u_t1"] for row in rows}
        size = max(map(abs, slid.values()))
        laws.demand(f"{n} increments: all slip", all(row["state"] == "slip" for row in rows))
        laws.check(f"{n} increments: to both sides alike",
                   max(abs(slid[x] + slid[min(slid, key=lambda y, x=x: abs(x + y))]) for x in slid) / size, 1e-9)
    upper = {"Body upper": box((3, 2), (2.0, 1.0), (-1.0, 1.0), poisson=.1), "Load press": {"Body": "upper"},
             "Contact joint": {"Body": "upper", "Boundary ids": 2, "Master body": "block", "Master boundary ids": 3,
                               "Friction coefficient": 0}, "Time": {"Increments": 5}}
    rows = [row for row in laws.run(merge(PRESSED, upper)).last() if row["contact"] == "bottom"]
    laws.check("below another without friction: sum of reactions", abs(sum(row["r_n"] for row in rows) - 2), 1e-9)


def springs(laws):
    """A block on springs is lowered and raised over a floor that it never meets."""
    scene = {"Dimension": 2, "Body block": box((3, 1), (30.0, 12.0), young=19050.0, poisson=0),
             "Obstacle floor": {"Shape": "prescribed gap", "Normal": (0, 1), "Gap": .1}, "Contact bottom": contact(ids=2),
             "Support springs": support(3, "x, y", "0 ; -0.003*(1 - 2*abs(t - 1))", Stiffness=47),
             "Time": {"Stages": "2:100"}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    forces = [abs(row[name]) for row in run.increments for name in ("springs_f_x", "springs_f_y") if name in row]
    laws.check("on springs: their forces", max([*forces, run.largest("r_n", "r_t1")]), 0)


def pulses(laws):
    """A block is pressed on a mat and left again: pi is not quite what the sine is zero at."""
    scene = {"Dimension": 2, "Body mat": box((4, 5), (1.4, .56), (-.7, 0.0), young=65541.0),
             "Body block": box((3, 3), (1.26, .56), (-.63, .56), young=2.2e7, poisson=0),
             "Support ground": support(2, "x, y", body="mat"),
             "Contact joint": {"Body": "block", "Boundary ids": 2, "Master body": "mat", "Master boundary ids": 3,
                               "Friction coefficient": 1},
             "Load press": load("traction", f"0 ; -4.5*abs(sin({math.pi!r}*t))", 3),
             "Time": {"Times": "0.5, 1, 1.5, 2, 2.5, 3"}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    left = [abs(row[name]) for row in run.rows if row["time"] in (1, 2, 3) for name in ("r_n", "r_t1")]
    laws.check("pulses: what is left of reactions", max(left) / run.largest("r_n"), 1e-14)


def below_springs(laws):
    """A block on springs presses one that stands on the floor, and leaves it: what springs round goes through both."""
    turn = (-.56, -.964, -.859, -99.14)
    m = rotation(turn[:3], turn[3])
    low = box((2, 2, 1), (30.0, 33.0, 11.4), (-15.0, -16.5, 0.0), young=1.17e5, poisson=.127, Rotation=turn)
    high = box((3, 1, 1), (26.6, 24.8, 9.9), (-13.3, -12.4, 11.4), young=5890.0, poisson=.23, Rotation=turn)
    way = " ; ".join(f"({x!r})*abs(sin({math.pi!r}*t))" for x in apply(m, (.003, 0.0, -.01)))
    scene = {"Dimension": 3, "Body low": {"Element": "Q1 incompatible modes", **low},
             "Body high": {"Element": "Q1 B-bar", **high},
             "Obstacle floor": floor(3, Normal=apply(m, (0, 0, 1))), "Contact bottom": contact("low", 4, mu=.3),
             "Contact joint": {"Body": "high", "Boundary ids": 4, "Master body": "low", "Master boundary ids": 5,
                               "Friction coefficient": .41, "Pairing": "node to face"},
             "Support springs": support(5, "x, y, z", way, "high", Stiffness=3590),
             "Time": {"Times": "0.3, 0.5, 1"}, "Output": {"VTU": 0}}
    for kinematics in ("small", "finite sliding"):
        run = laws.run(merge(scene, {f"Contact {name}": {"Kinematics": kinematics} for name in ("bottom", "joint")}))
        laws.check(f"below a block on springs, {kinematics}: what is left of reactions",
                   max(abs(row["r_n"]) for row in run.last()) / run.largest("r_n"), 1e-12)


def vanishing(laws):
    all_slip(laws)
    springs(laws)
    below_springs(laws)
    pulses(laws)
