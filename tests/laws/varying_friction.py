# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coefficients of friction by expressions: each node obeys the law that the scene has, computed anew from the tables."""
import math
from pathlib import Path

from support.scenes import box, contact, floor, load, press_and_shear


def rate(row):
    return math.hypot(row["du_t1"], row["du_t2"])


class Mu:
    """mu(x, t, T, s, p, v) of each row of a table, in the order of the table; s as the laws of increments have it."""

    def __init__(self, run, law, duration=1.0, limit=math.inf):
        self.slipped, self.values, way = {}, {}, {}
        for row in run.rows:
            key = row["contact"], row["node"]
            s = way.get(key, 0.0)
            p = row["r_n"] / row["area"] if row["area"] > 0 else 0.0
            mu = law(row, s, p, rate(row) / duration)
            self.values[id(row)] = min(mu, limit * row["area"] / row["r_n"]) if row["r_n"] > 0 else mu
            if row["state"] == "slip":
                way[key] = s + rate(row)

    def __call__(self, row):
        return self.values[id(row)]


LAWS = {
    "s": ("0.2 + 0.1*exp(-s/0.003)", lambda row, s, p, v: .2 + .1 * math.exp(-s / .003)),
    "t": ("if(t < 2.5, 0, 0.2)", lambda row, s, p, v: 0 if row["time"] < 2.5 else .2),
    "x and t": ("0.1 + 0.05*x*t", lambda row, s, p, v: .1 + .05 * row["x"] * row["time"]),
    "p": ("min(0.4, 2/p)", lambda row, s, p, v: min(.4, 2 / p) if p > 0 else .4),
    "table of p": ("table(p; 0 : 0.5; 10 : 0.3; 50 : 0.15)",
                   lambda row, s, p, v: .5 - .02 * p if p < 10 else .3 - .00375 * (p - 10) if p < 50 else .15),
    "v": ("0.15 + 0.1*exp(-v/0.002)", lambda row, s, p, v: .15 + .1 * math.exp(-v / .002)),
    "all": ("(0.1 + 0.1*exp(-s/0.003))*(1 + 0.2*x)/(1 + p/50)*(1 + 0.1*exp(-v/0.002)) + 0.01*t",
            lambda row, s, p, v: (.1 + .1 * math.exp(-s / .003)) * (1 + .2 * row["x"]) / (1 + p / 50)
            * (1 + .1 * math.exp(-v / .002)) + .01 * row["time"]),
}


def only_slaves(run):
    run.rows = [row for row in run.rows if not row["contact"].endswith("_master")]
    return run


def by_tables(laws):
    """Cones of the law's own coefficient, in the plane and in space, condensed and iterative."""
    for dim in (2, 3):
        for name, (text, law) in LAWS.items():
            scene = press_and_shear(dim, mu=text)
            run = laws.run(scene)
            laws.admissible(f"{dim}D, mu of {name}", run, Mu(run, law))
            laws.demand(f"{dim}D, mu of {name}: some slip", any(row["state"] == "slip" for row in run.last()))
            if dim == 3:
                other = laws.run(scene, "-s", "Solver/Backend=iterative")
                laws.same(f"{dim}D, mu of {name}: iterative", run, other, 1e-8)
        scene = press_and_shear(dim, mu=.4)
        scene["Contact bottom"]["Shear limit"] = "1.5 + 0.2*t"
        run = laws.run(scene)
        laws.admissible(f"{dim}D, shear limit", run,
                        Mu(run, lambda row, s, p, v: min(.4, (1.5 + .2 * row["time"]) / p) if p > 0 else .4))


def falling(laws):
    """A limit and a coefficient that fall below 0 are none."""
    for dim in (2, 3):
        scene = press_and_shear(dim, mu=.4)
        scene["Contact bottom"]["Shear limit"] = "2 - 0.8*t"
        run = laws.run(scene)
        laws.admissible(f"{dim}D, a shear limit that falls below 0", run,
                        Mu(run, lambda row, s, p, v: min(.4, max(0, 2 - .8 * row["time"]) / p) if p > 0 else .4))
        laws.demand("  no friction in the end", all(row["r_t1"] == 0 for row in run.last()))
        run = laws.run(press_and_shear(dim, mu="0.3 - 0.12*t"))
        laws.admissible(f"{dim}D, mu that falls below 0", run, Mu(run, lambda row, s, p, v: max(0, .3 - .12 * row["time"])))
        laws.demand("  no friction in the end", all(row["r_t1"] == 0 for row in run.last()))


def by_methods(laws):
    """The same by each method, in one run or two."""
    for dim in (2, 3):
        scene = press_and_shear(dim, mu=LAWS["all"][0])
        whole = laws.run(scene)
        for method in ("active set", "smoothing", "gauss-seidel"):
            laws.same(f"{dim}D, {method}", whole, laws.run(scene, "-s", f"Solver/Method={method}"), 1e-7)
        scene["Output"]["Checkpoint"] = 1
        half = laws.run(scene, "-s", "Time/End=2", "-s", "Time/Increments=2")
        laws.same(f"{dim}D, continued", whole, laws.run(scene, "--restart", half.folder), 1e-10)


def temperature(laws):
    scene = press_and_shear(2, mu="0.2 + 0.001*T")
    scene["Load heat"] = load("temperature", "100*(t - 1)*x")
    for expansion in (0, 1e-9):  # what laws of contacts take need not expand
        scene["Body block"]["Material"]["Expansion coefficient"] = expansion
        run = laws.run(scene)
        laws.admissible(f"mu(T), expansion {expansion:g}", run, Mu(run, lambda row, s, p, v: .2 + .1 * (row["time"] - 1) * row["x"]))


def brake(laws):
    """The shipped brake that fades: forces by its own law of each node, and by hand for an even pressure."""
    run = laws.run(Path(__file__).resolve().parents[2] / "parameter-files/brake-fade.prm", "-s", "Output/VTU=0")
    for time, even in ((1, 648), (5, 324), (6, 576)):
        record = next(record for record in run.increments if record["time"] == time)
        hot = 100 * min(max(time - 1, 0), 4)
        law = sum(row["r_n"] * .45 * (1 - hot / 800) * (1 - row["pressure"] / 20) for row in run.rows if row["time"] == time)
        laws.check(f"brake, t = {time}: friction by its law", abs(record["lining_f_x"] / law - 1), 1e-10)
        laws.check("  and by hand", abs(record["lining_f_x"] / even - 1), .04)


def in_parts(laws):
    """An increment that is cut is those that it is cut into: the speed of each is its slip over its own time."""
    for mu in ("0.1 + 0.01*v", "0.1 + 0.05*exp(-v/0.3)"):
        scene = press_and_shear(3, cells=(3, 2, 2), mu=mu)
        scene["Obstacle floor"].update({"Turn": "30*max(t - 1, 0)", "Turn axis": (0, 0, 1), "Reference point": (.7, .5, 0)})
        scene["Support top"]["Displacement"] = "0 ; 0 ; -0.01*min(t, 1)"
        runs = [laws.run(scene, "-s", f"Time/Times={times}") for times in ("1, 2", "1, 1.5, 2")]
        laws.demand(f"mu = {mu}: cut in two", runs[0].increments[-1]["substeps"] == 2 and runs[1].increments[-1]["substeps"] == 1)
        size = runs[0].largest("r_n")
        laws.check("  reactions of both", max(abs(a[c] - b[c]) for a, b in zip(runs[0].last(), runs[1].last())
                                              for c in ("r_n", "r_t1", "r_t2")) / size, 1e-10)


def viscous(laws):
    """A block that only friction holds goes on at the speed at which friction that rises with it carries the load; forces
    to 1e-10 know it to 1e-8."""
    for dim in (2, 3):
        size, sides = ((2.0, 1.0), (2, 3)) if dim == 2 else ((2.0, 1.5, 1.0), (4, 5))
        scene = {"Dimension": dim, "Body block": box((4, 2, 2)[:dim], size), "Obstacle floor": floor(dim),
                 "Contact bottom": contact(ids=sides[0], mu="0.2 + 0.02*v", Kinematics="small"),
                 "Load press": load("pressure", "2*min(t, 1)", sides[1]),
                 "Load drag": load("traction", " ; ".join(["0.5*min(max(t - 1, 0), 1)"] + ["0"] * (dim - 1)), sides[1]),
                 "Time": {"Times": "1, 2, 3"}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        laws.check(f"{dim}D, friction that rises with speed: slip of a block that nothing else holds",
                   max(abs(row["du_t1"] / 2.5 - 1) for row in run.last()), 1e-7)


def letting_go(laws):
    """Friction that changes with speed faster than bodies resist: what slips jumps, in not many more steps than constant friction takes."""
    def solves(mu):
        scene = press_and_shear(2, cells=(12, 6), mu=mu)
        scene["Support top"]["Displacement"] = "0.012*sin(pi*max(t - 1/32, 0)) ; -0.01*min(32*t, 1)"
        scene["Time"] = {"End": 33 / 32, "Increments": 33}
        run = laws.run(scene)
        return run, sum(record["iterations"] for record in run.increments)

    constant = solves(.3)[1]
    for law, at, most in (("0.15 + 0.1*exp(-v/0.002)", lambda v: .15 + .1 * math.exp(-v / .002), 2.5),
                          ("0.15 + 0.1*exp(-v/0.0002)", lambda v: .15 + .1 * math.exp(-v / .0002), 2.5),
                          ("0.05 + 0.2*exp(-v/0.002)", lambda v: .05 + .2 * math.exp(-v / .002), 3)):
        run, taken = solves(law)
        laws.admissible(f"2D, mu = {law}", run, Mu(run, lambda row, s, p, v: at(v), duration=1 / 32))
        laws.demand(f"  {taken} solves, where a constant coefficient takes {constant}", taken < most * constant)


def from_rest(laws):
    """Coefficients of 0 at rest that grow within slips far below those of bodies: what hardly moves holds less than what slips."""
    for dim in (2, 3):
        for text, law in (("0.3*v/(v + 1e-7)", lambda v: .3 * v / (v + 1e-7)), ("0.3*min(v/1e-4, 1)", lambda v: .3 * min(v / 1e-4, 1))):
            run = laws.run(press_and_shear(dim, mu=text))
            laws.admissible(f"{dim}D, mu = {text}", run, Mu(run, lambda row, s, p, v: law(v)))
            laws.demand("  no increment is cut", all(row["substeps"] == 1 for row in run.increments))


def varying_friction(laws):
    letting_go(laws)
    from_rest(laws)
    viscous(laws)
    brake(laws)
    by_tables(laws)
    falling(laws)
    by_methods(laws)
    temperature(laws)
    in_parts(laws)
