# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ellipses of friction whose axes vary, each by an expression: closed forms of a block that is dragged, and tables judged by their definition."""
import math

from laws.layers import SPRINGS, YOUNG, clamped
from support.scenes import merge, press_and_shear, support

CLOSING = .01
PRESSURE = YOUNG * CLOSING


class Law:
    """Both coefficients as text and as functions of s, p and v, and what else the contact has."""

    def __init__(self, first, second, one, two, **entries):
        self.first, self.second, self.coefficients, self.entries = first, second, (one, two), entries
        self.most, self.least = entries.get("Shear limit", math.inf), entries.get("Cohesion", 0.0)

    def entry(self, angle):
        return {"Friction coefficient": self.first, "Second friction coefficient": self.second, "Friction angle": angle, **self.entries}

    def tractions(self, s, p, v):
        return [min(max(0.0, mu(s, p, v)) * p + self.least, self.most) for mu in self.coefficients]


LAWS = {"p": Law("0.3 - 0.01*p", "min(0.4, 1/p)", lambda s, p, v: .3 - .01 * p, lambda s, p, v: min(.4, 1 / p) if p > 0 else .4),
        "s": Law("0.15", "0.2 + 0.2*exp(-s/0.02)", lambda s, p, v: .15, lambda s, p, v: .2 + .2 * math.exp(-s / .02)),
        "v": Law("0.2 + 0.1*v", "0.1 + 0.02*v", lambda s, p, v: .2 + .1 * v, lambda s, p, v: .1 + .02 * v),
        "p, s and v": Law("0.4 - 0.01*p", "0.1 + 0.1*exp(-s/0.02) + 0.03*v", lambda s, p, v: .4 - .01 * p,
                          lambda s, p, v: .1 + .1 * math.exp(-s / .02) + .03 * v),
        "a shear limit": Law("0.4", "0.1", lambda s, p, v: .4, lambda s, p, v: .1, **{"Shear limit": 2.5}),
        "cohesion": Law("0.05*p/(1 + p/10)", "0.1", lambda s, p, v: .05 * p / (1 + p / 10), lambda s, p, v: .1, Cohesion=.7)}


def dragged(force, law, angle, increments=10):
    """A cube between two plates, on springs along x and y, pushed by a body force that grows."""
    scene = clamped(3, CLOSING, 0, increments=increments)
    scene["Support side"] = support("2, 3", "y", Stiffness=SPRINGS / 2)
    scene["Load push"]["Value"] = " ; ".join(f"{f!r}*t" for f in (*force, 0.0))
    scene["Contact below"].update(law.entry(angle))
    scene["Contact above"].update(law.entry(-angle))  # its t1 is reversed
    return scene


def step(free, axes_at):
    """What the block moves by: free - k d = E^2 d / |E d| in the axes, E of the way itself."""
    shortest, longest = 0.0, math.hypot(*free) / SPRINGS
    for _ in range(100):
        way = .5 * (shortest + longest)
        axes = axes_at(way)
        low, high = 0.0, max(axes) * math.hypot(*free) / SPRINGS
        for _ in range(200):
            middle = .5 * (low + high)
            d = [f / (SPRINGS + e * e / middle) if middle > 0 else 0.0 for f, e in zip(free, axes)]
            low, high = (middle, high) if math.hypot(*(e * x for e, x in zip(axes, d))) > middle else (low, middle)
        shortest, longest = (way, longest) if math.hypot(*d) > way else (shortest, way)
    return d


def expected(force, law, angle, increments=10):
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    u, slipped, result = [0.0, 0.0], 0.0, []
    for i in range(increments):
        t = (i + 1) / increments
        push = [c * force[0] * t + s * force[1] * t, c * force[1] * t - s * force[0] * t]

        def axes_at(way):
            return [2 * f for f in law.tractions(slipped, PRESSURE, way * increments)]
        free = [f - SPRINGS * x for f, x in zip(push, u)]
        if math.hypot(*(f / e for f, e in zip(free, axes_at(0.0)))) > 1:
            d = step(free, axes_at)
            u, slipped = [x + y for x, y in zip(u, d)], slipped + math.hypot(*d)
        result.append((c * u[0] - s * u[1], s * u[0] + c * u[1]))
    return result


def closed_forms(laws):
    for name, law in LAWS.items():
        for force, angle in (((12.0, 0.0), 0.0), ((0.0, 12.0), 0.0), ((10.0, 7.0), 0.0), ((10.0, -5.0), 25.0)):
            right = expected(force, law, angle)
            size = max(math.hypot(*u) for u in right)
            for backend in ("condensed", "iterative"):
                run = laws.run(merge(dragged(force, law, angle), {"Solver": {"Backend": backend}}))
                found = [(-record["support_springs_f_x"] / SPRINGS, -record["support_side_f_y"] / SPRINGS) for record in run.increments]
                error = max(abs(a - b) for u, v in zip(found, right) for a, b in zip(u, v))
                laws.check(f"axes of {name}, pushed along {force}, {angle} degrees, {backend}", error / size, 1e-9)


def judged(laws, what, run, law, angle, duration=1.0):
    """Each row by the definition of its ellipse: |(r_1/f_1, r_2/f_2)| <= 1, slip along the normal."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    size, length, way = run.largest("r_n"), run.largest("du_t1", "du_t2"), {}
    outside = slack = across = 0.0
    for row in run.rows:
        before, rate = way.get(row["node"], 0.0), math.hypot(row["du_t1"], row["du_t2"])
        if row["r_n"] <= 0:
            continue
        limits = [row["area"] * f for f in law.tractions(before, row["r_n"] / row["area"], rate / duration)]
        r = c * row["r_t1"] + s * row["r_t2"], c * row["r_t2"] - s * row["r_t1"]
        du = c * row["du_t1"] + s * row["du_t2"], c * row["du_t2"] - s * row["du_t1"]
        part = math.hypot(*(x / f for x, f in zip(r, limits)))
        outside = max(outside, (part - 1) * row["r_n"])
        if row["state"] == "slip":
            way[row["node"]] = before + rate
            slack = max(slack, abs(part - 1) * row["r_n"])
            e = [f * x for f, x in zip(limits, du)]
            across = max(across, math.hypot(*(x + f * y / math.hypot(*e) for x, f, y in zip(r, limits, e))) * rate)
    laws.check(f"{what}: outside", outside / size, 1e-9)
    laws.check(f"{what}: slip inside", slack / size, 1e-9)
    laws.check(f"{what}: slip across its normal", across / (size * length), 1e-9)


VARYING = {
    "all": Law("(0.1 + 0.1*exp(-s/0.003))/(1 + p/50)", "0.2 + 0.1*exp(-v/0.002)",
               lambda s, p, v: (.1 + .1 * math.exp(-s / .003)) / (1 + p / 50), lambda s, p, v: .2 + .1 * math.exp(-v / .002)),
    "tables": Law("table(p; 0 : 0.5; 10 : 0.3; 50 : 0.15)", "min(0.3, 2/p)",
                  lambda s, p, v: .5 - .02 * p if p < 10 else .3 - .00375 * (p - 10) if p < 50 else .15,
                  lambda s, p, v: min(.3, 2 / p)),
    "a shear limit": Law("0.4", "0.2", lambda s, p, v: .4, lambda s, p, v: .2, **{"Shear limit": 1.5}),
    "an axis with little friction": Law("0.25", "max(1e-3, 0.2 - s/0.002)", lambda s, p, v: .25, lambda s, p, v: max(1e-3, .2 - s / .002))}


def by_tables(laws):
    """Blocks that are sheared: partly stuck, by both backends, by finite sliding, in one run or two."""
    for name, law in VARYING.items():
        for angle in (0.0, 25.0):
            scene = press_and_shear(3)
            scene["Contact bottom"].update(law.entry(angle))
            run = laws.run(scene)
            what = f"axes of {name} at {angle} degrees"
            judged(laws, what, run, law, angle)
            laws.demand(f"{what}: some stick, some slip", {"stick", "slip"} <= {row["state"] for row in run.rows})
            laws.same(f"{what}: iterative", run, laws.run(scene, "-s", "Solver/Backend=iterative"), 1e-8)
    laws.same("sliding on a plane", run, laws.run(scene, "-s", "Contact bottom/Kinematics=finite sliding"), 1e-8)
    laws.same("active set", run, laws.run(scene, "-s", "Solver/Method=active set"), 1e-8)
    scene["Output"]["Checkpoint"] = 1
    half = laws.run(scene, "-s", "Time/End=2", "-s", "Time/Increments=2")
    laws.same("continued", run, laws.run(scene, "--restart", half.folder), 1e-10)


def vanishing_axis(laws):
    """Friction that a law of t switches on along both axes; one axis without it beside the other is refused; equal axes are a circle."""
    for backend in ("condensed", "iterative"):
        scene = merge(press_and_shear(3), {"Solver": {"Backend": backend}})
        scene["Contact bottom"].update({"Friction coefficient": "if(t < 2.5, 0, 0.3)", "Second friction coefficient": "if(t < 2.5, 0, 0.2)"})
        run = laws.run(scene)
        laws.demand(f"{backend}: no friction, then friction along both axes", all(
            row["r_t1"] == row["r_t2"] == 0 for row in run.rows if row["time"] < 2.5) and any(row["r_t2"] != 0 for row in run.last()))
    scene["Contact bottom"]["Friction coefficient"] = .3
    done, _ = laws.start(scene)
    laws.demand("friction along one axis only is refused", done.returncode == 1 and "along one axis" in done.stderr)
    scene = press_and_shear(3, mu="0.3/(1 + p/50)")
    circle = laws.run(scene)
    scene["Contact bottom"].update({"Second friction coefficient": "0.3/(1 + p/50)", "Friction angle": 33.3})
    laws.same("equal axes", circle, laws.run(scene), 1e-9)


def held(laws):
    """Along the one tangent that supports leave the limit is half of the ellipse's width there; layers are elastic below it."""
    angle = 25.0
    scene = press_and_shear(3, poisson=0.0)
    scene["Contact bottom"].update(LAWS["p"].entry(angle))
    scene["Support sides"] = support("2, 3", "y")
    scene["Support top"] = support(5, "x, z", "0.02*max(t - 1, 0) ; -0.01*min(t, 1)")
    run = laws.run(scene)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    rows = [row for row in run.last() if row["y"] in (0.0, 1.0)]
    judge = max(abs(abs(row["r_t1"]) / row["area"]
                    - 1 / math.hypot(*(x / f for x, f in zip((c, s), LAWS["p"].tractions(0, row["pressure"], 0)))))
                for row in rows) / PRESSURE
    laws.check("  by the pressure of each node", judge, 1e-9)
    for law in ({"Compliance": "table(p; 0 : 2e-4; 20 : 1e-4)", "Shear compliance": 2e-4, "Wear coefficient": 1e-3, "Wear integration": "implicit"},
                {"Compliance": 1e-4}):
        scene = press_and_shear(3)
        scene["Contact bottom"].update({**VARYING["all"].entry(angle), **law})
        run = laws.run(scene)
        laws.demand("layers and an ellipse: both states", {"stick", "slip"} <= {row["state"] for row in run.rows})
        laws.same("  iterative", run, laws.run(scene, "-s", "Solver/Backend=iterative"), 1e-8)


def glued(laws):
    """A glued block whose layer is stretched and sheared: its ellipse has the semi-axes mu p + c, where it is pulled, too."""
    strength, law = .3, Law("0.2", "0.4", lambda s, p, v: .2, lambda s, p, v: .4, Cohesion=1.0)
    for entries in ({"Compliance": 5e-4}, {"Compliance": 5e-4, "Shear compliance": 2e-4}):
        scene = press_and_shear(3, cells=(3, 3, 2))
        scene["Contact bottom"].update({**law.entry(0.0), **entries, "Tensile strength": strength})
        scene["Support top"]["Displacement"] = "0.0025*t ; 0.0035*t ; -0.001*t*(2 - 2*x)"
        scene["Time"] = {"End": 2, "Increments": 4}
        run = laws.run(scene)
        rows = [row for row in run.rows if row["state"] != "open"]
        parts = [math.hypot(*(row[f"traction_t{k}"] / (mu * row["pressure"] + 1) for k, mu in ((1, .2), (2, .4)))) for row in rows]
        what = f"glued, {', '.join(entries)}"
        laws.check(f"{what}: outside", max(parts) - 1, 1e-9)
        laws.check("  slip inside", max((abs(part - 1) for row, part in zip(rows, parts) if row["state"] == "slip"), default=1.0), 1e-9)
        laws.demand("  some are pulled", any(row["pressure"] < 0 for row in rows))
        laws.demand("  by no more than they bear", all(row["pressure"] >= -strength * (1 + 1e-9) for row in run.rows))


def ellipses(laws):
    glued(laws)
    closed_forms(laws)
    by_tables(laws)
    vanishing_axis(laws)
    held(laws)
