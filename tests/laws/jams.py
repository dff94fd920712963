# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What friction jams stays jammed without load, holds as much as its normal reactions allow, and is told to slip out then."""
import math

from laws.limits import share, told
from support.scenes import joint, load, support

ANGLE = 5.0  # degrees, of a plug on which mu .15 locks itself
LENGTH, RADIUS, HUB = 20.0, 10.0, 20.0
WIDE = RADIUS + LENGTH * math.tan(math.radians(ANGLE))
TOP = math.pi * WIDE ** 2
PRESS = 10000.0

TAPER = f"""Point(1)={{0,0,0}};Point(2)={{{RADIUS},0,0}};Point(3)={{{WIDE!r},{LENGTH},0}};Point(4)={{0,{LENGTH},0}};
Point(5)={{{RADIUS},0,0}};Point(6)={{{HUB},0,0}};Point(7)={{{HUB},{LENGTH},0}};Point(8)={{{WIDE!r},{LENGTH},0}};
Line(1)={{1,2}};Line(2)={{2,3}};Line(3)={{3,4}};Line(4)={{4,1}};Line(5)={{5,6}};Line(6)={{6,7}};Line(7)={{7,8}};Line(8)={{8,5}};
Curve Loop(1)={{1:4}};Plane Surface(1)={{1}};Curve Loop(2)={{5:8}};Plane Surface(2)={{2}};
Transfinite Curve{{1:8}}=7;Transfinite Surface{{1,2}};Recombine Surface{{1,2}};
Physical Surface("plug")={{1}};Physical Surface("hub")={{2}};
Physical Curve("cone")={{2}};Physical Curve("top")={{3}};Physical Curve("seat")={{8}};Physical Curve("bottom")={{5}};
"""


def taper(laws, times, force, mu=.15):
    """A plug in a hub that stands on its face; `force` is a function of time, as text, which pulls."""
    (laws.folder / "taper.geo").write_text(TAPER)

    def body(group):
        return {"Mesh": {"File": "taper.geo", "Group": group},
                "Material": {"Young modulus": 210e3, "Poisson ratio": .3, "Plane": "axisymmetric"}}
    return {"Dimension": 2, "Body plug": body("plug"), "Body hub": body("hub"),
            "Contact cone": joint("plug", "cone", "hub", "seat", **{"Friction coefficient": mu}),
            "Support base": support("bottom", "y", body="hub"),
            "Load push": load("traction", f"0 ; {PRESS / TOP!r}*({force})", "top", "plug"),
            "Time": {"Times": times}, "Output": {"VTU": 0}}


def pressed(run):
    """Normal reactions and friction along the slope of the last increment, of all nodes of the plug."""
    rows = [row for row in run.last() if row["contact"] == "cone"]
    return sum(row["r_n"] for row in rows), sum(row["r_t1"] for row in rows), rows


def unloaded(laws):
    """Without its load the plug stays where it is, in one increment as in ten; loads that go on from there are held."""
    slope = math.radians(ANGLE)
    jams = {}
    for name, times in (("one increment", "1, 2"), ("ten", "1, " + ", ".join(str(1 + .1 * i) for i in range(1, 11)))):
        run = laws.run(taper(laws, times, "-min(t, 1) + max(t - 1, 0)"))
        normal, friction, rows = pressed(run)
        laws.check(f"{name}: balance along the axis", abs(normal * math.sin(slope) - abs(friction) * math.cos(slope)) / PRESS, 1e-9)
        laws.check("  cones", max(abs(row["r_t1"]) - .15 * row["r_n"] for row in rows) / PRESS, 1e-12)
        jams[name] = normal
    pressing = PRESS / (math.sin(slope) + .15 * math.cos(slope))  # the sum of normal reactions while it slips in
    laws.check("what is left of the normal reactions", abs(jams["ten"] / pressing - 1), .1)
    laws.check("one increment leaves as much as ten", abs(jams["one increment"] / jams["ten"] - 1), .01)
    # mu 0.05 is less than the tangent of the slope: nothing holds the plug
    run = laws.run(taper(laws, "1, 2", "-min(t, 1) + max(t - 1, 0)", .05))
    laws.check("without self-locking nothing is left", max(abs(row["r_n"]) for row in run.last()), 0)


def pulled(laws):
    """Pulled in one increment or in several the plug slips out under one load, which its normal reactions tell."""
    slope = math.radians(ANGLE)
    found = []
    for times, begin, length in (("1, 3", 1, 2), ("1, 2, 3", 2, 1), ("1, 2, 2.2, 2.25", 2.2, .05), ("1, 1.5, 2, 2.1, 2.4", 2.1, .3)):
        sentence = told(laws, taper(laws, times, "-min(t, 1) + max(t - 1, 0)"))
        laws.demand(f"{times}: {sentence}", "body 'plug' slides along (0, 1, 0)" in sentence or
                    "body 'plug' slides along (0.0872, 0.9962, 0)" in sentence)
        found.append(begin + share(sentence) * length - 2)
        laws.check("  its load", abs(found[-1] / found[0] - 1), .02)
    last = 2 + .999 * min(found)
    run = laws.run(taper(laws, f"1, 2, 2.2, {last!r}", "-min(t, 1) + max(t - 1, 0)"))
    normal, friction, rows = pressed(run)
    laws.check("a thousandth less is held, in balance", abs(abs(friction) * math.cos(slope) - normal * math.sin(slope) -
                                                            PRESS * (last - 2)) / PRESS, 1e-9)
    most = normal * (.15 * math.cos(slope) - math.sin(slope))
    laws.check("  by all friction that there is", abs(PRESS * (last - 2) / most - 1), .01)


def jams(laws):
    unloaded(laws)
    pulled(laws)
