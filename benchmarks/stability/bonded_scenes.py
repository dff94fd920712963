#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes with bonds and with fluids, judged by statics and by the law of each node, from tables alone.

usage: bonded_scenes.py [--build FOLDER] [--scenes N] [--seed N] [--keep FOLDER]

A block on a floor is pressed, pulled and sheared at random by its top. Of each increment: forces of contact and support
cancel out; no node is pulled by more than what is left of its strength, and where it opens, by that; friction is within
mu p + c, is that where a node slips, and is against its slip, with a mu that may fall with speed, way and pressure; what
is wet carries the fluid at least. What is left of a bond is computed here from gaps and slips of the tables. The top
moves as it is told, so that each increment has a solution. Runs without equilibrium are counted; increments before are
judged.
"""
import math

from judged_runs import Account, reader, table  # first: it knows the way to tests
from node_judge import Text
from support.scenes import box, contact, floor, support


def falling(chance):
    """A coefficient that falls with speed, way or pressure."""
    mu, least, at = chance.choice((.2, .4, .7)), chance.choice((.1, .3, .6)), chance.choice((.0005, .002, .006))
    by = chance.choice(("v", "v", "s", "p"))
    return chance.choice((f"{mu}*({least} + {1 - least!r}*exp(-{by}/{20 if by == 'p' else at}))",
                          f"table({by}; 0 : {mu}; {20 if by == 'p' else at} : {mu * least!r})"))


def scene_of(chance, fluid=False, varying=False):
    dim = chance.choice((2, 2, 3))
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    law = {"mu": falling(chance) if varying else chance.choice((0, .1, .3, .7))}
    if fluid:
        law.update({"Penetrating pressure": table([chance.uniform(0, 12) for _ in range(6)]), "Fluid from boundary ids": 0})
    else:
        lost = chance.choice(("never", "opening", "slip"))
        law.update({"Tensile strength": chance.choice((0, .5, 2)), "Cohesion": chance.choice((.3, 1, 3)), "Cohesion lost": lost})
        if lost != "never" and chance.random() < .7:
            law["Softening length"] = chance.choice((.005, .01, .03))
    up = [chance.uniform(-.01, .006) for _ in range(6)]
    side = [chance.uniform(-.008, .008) for _ in range(6)]
    where = f"{table(side)} ; {table(up)}" if dim == 2 else f"{table(side)} ; {table(side[::-1])} ; {table(up)}"
    n = (chance.randint(2, 8), chance.randint(1, 4), chance.randint(1, 3))[:dim]
    return {"Dimension": dim, "Body block": box(n, (2.0, 1.0, 1.0)[:dim], poisson=chance.choice((0.0, .3))),
            "Obstacle floor": floor(dim), "Contact bottom": contact(ids=bottom, **law),
            "Support top": support(top, "x, y" if dim == 2 else "x, y, z", where),
            "Solver": {"Backend": chance.choice(("condensed", "iterative"))},
            "Time": {"End": 6, "Increments": 6}, "Output": {"VTU": 0}}, (law, fluid)


def rest(law, opened, slipped):
    lost, length = law["Cohesion lost"], law.get("Softening length")
    way = opened if lost == "opening" else math.hypot(opened, slipped)
    if lost == "never":
        return 1.0
    return max(0.0, 1 - way / length) if length else float(way <= 1e-9)


def faults(run, known):
    """Largest violations over the largest force, of all increments."""
    law, fluid = known
    worst, opened, slipped, way = {}, {}, {}, {}
    mu_of, sure = Text(law["mu"]), True
    scale = max(abs(row[c]) for row in run.rows for c in ("r_n", "r_t1", "r_t2")) or 1.0

    def note(what, error):
        worst[what] = max(worst.get(what, 0.0), error / scale)
    for record in run.increments:
        for c in "xyz"[:run.dim]:
            note("statics", abs(record[f"bottom_f_{c}"] + record[f"support_top_f_{c}"]))
        sure = sure and record["substeps"] == 1  # of an increment that was cut laws hold in parts
        for row in (row for row in run.rows if row["increment"] == record["increment"]):
            k, area = row["node"], row["area"]
            before = opened.get(k, 0.0), slipped.get(k, 0.0)
            slip, gap = math.hypot(row["du_t1"], row["du_t2"]), max(row["gap"], 0.0)
            friction = math.hypot(row["r_t1"], row["r_t2"])
            note("penetrates", max(0.0, -row["gap"]) * 1000)
            if fluid:
                p = row["r_n"] if row["state"] != "wet" else row["r_n"] - pressure_at(law, record["time"]) * area
                note("carries less than its fluid", max(0.0, -p))
                note("friction", max(0.0, friction - law["mu"] * max(p, 0.0)))
                continue
            softens = "Softening length" in law
            moved = slip if row["state"] in ("slip", "open") else 0.0
            left = rest(law, max(before[0], gap), before[1] + moved) if softens else rest(law, *before)
            mu = mu_of(v=slip, s=way.get(k, 0.0), p=max(row["r_n"], 0.0) / area if area > 0 else 0.0)
            pull = law["Tensile strength"] * area * left
            if softens and 0 < gap < before[0]:
                pull *= gap / before[0]
            elif softens and before[0] > 0 and gap == 0:
                pull = 0.0
            note("is pulled", max(0.0, -row["r_n"] - pull))
            most = max(0.0, mu * row["r_n"] + law["Cohesion"] * area * left)
            if not sure and isinstance(law["mu"], str):
                continue
            note("friction", max(0.0, friction - most))
            if row["state"] == "slip":
                note("slips below the limit", most - friction)
                note("friction is not against the slip", math.hypot(*(row[f"r_t{i}"] * slip + most * row[f"du_t{i}"]
                                                                      for i in (1, 2))) / (slip or 1.0))
            if row["state"] == "open":
                note("opens below its strength", max(0.0, row["r_n"] + pull))
            opened[k], slipped[k] = max(before[0], gap), before[1] + moved
            if row["state"] == "slip":  # the way of a bond that opens is its own
                way[k] = way.get(k, 0.0) + moved
    return worst


def pressure_at(law, t):
    values = [float(part.split(":")[1]) for part in law["Penetrating pressure"].rstrip(")").split(";")[1:]]
    return values[int(t)]


def main():
    account = Account(reader(__doc__).parse_args())
    account.family("bonds", scene_of, faults)
    account.family("bonds and friction that falls", lambda chance: scene_of(chance, varying=True), faults)
    account.family("fluids", lambda chance: scene_of(chance, fluid=True), faults)
    raise SystemExit(account.wrong > 0)


if __name__ == "__main__":
    main()
