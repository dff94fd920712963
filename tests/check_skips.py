#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene does not need is not done: numbers of log.txt, never seconds.

usage: check_skips.py PROGRAM
"""
import os
import re
import subprocess
import sys

from support import scenes
from support.checks import run_families
from support.logs import check_estimates, check_ratio, demand_work, dry_run, log_of, work_of
from support.tables import REACTION


def factor_once(laws):
    """One factorisation and one condensation, however many increments and different loads."""
    for dim in (2, 3):
        scene = scenes.press_and_shear(dim, increments=20)
        demand_work(laws, f"{dim}D, 20 increments", laws.run(scene),
                    {"factorisations of the elastic system": 1, "condensations": 1, "reductions of loads": 0,
                     "recoveries of displacements": 20})


def carried(laws):
    """Supports that move bodies without strain cost no reduction; with a trace of strain they do, to the same result."""
    down = {dim: scenes.press_and_shear(dim) for dim in (2, 3)}
    slide = {"Support left": scenes.support(0, "x", "0.004*max(t - 1, 0)")}
    for name, scene in (("block in the plane", down[2]), ("in space, on rollers besides", scenes.merge(down[3], slide)),
                        ("stacked-blocks", scenes.SHIPPED / "stacked-blocks.prm"),
                        ("inclined-obstacle", scenes.SHIPPED / "inclined-obstacle.prm")):
        still = laws.run(scene)
        top = re.search(r"subsection Support top.*?Displacement *= ([^\n]*)", (still.folder / "used.prm").read_text(), re.S)[1]
        # x alone would turn the support
        strained = laws.run(scene, "-s", f"Support top/Displacement={top} * (1 + 1e-13*x*x)")
        # bodies that meet others reduce forces once more to recover displacements
        if name != "stacked-blocks":
            demand_work(laws, name, still, {"reductions of loads": 0})
        laws.demand(f"{name}, strained: loads are reduced",
                    work_of(strained)["reductions of loads"] > work_of(still)["reductions of loads"])
        laws.same(name, still, strained, 1e-9)


def loads_once(laws):
    """Loads that do not depend on time are integrated once for all increments."""
    scene = scenes.press_and_shear(2, increments=20)
    for value, count in (("0 ; -1", 1), ("0 ; -0.1*t", 20)):
        run = laws.run(scenes.merge(scene, {"Load side": scenes.load("traction", value, 1)}))
        demand_work(laws, f"traction {value}, 20 increments", run, {"integrations of loads": count})
        laws.demand("the log says what is skipped",
                    f"skipped: {40 - count} of 40 integrations of loads" in log_of(run)
                    and "skipped: 19 of 20 factorisations" in log_of(run)
                    and "of 20 load cases, combinations of others" in log_of(run))


def tables_once(laws):
    """Each row is written once, however long the tables are."""
    for increments, cells in ((16, 8), (160, 8), (160, 200)):
        run = laws.run(scenes.press_and_shear(2, cells=(cells, 2), increments=increments))
        size = sum((run.folder / name).stat().st_size for name in ("reactions.csv", "increments.csv", "history.csv"))
        laws.check(f"{increments} increments, {cells} cells, bytes of tables written over those on disk",
                   work_of(run)["bytes of tables written"] / size, 1)


def drawn_only(laws):
    run = laws.run(scenes.merge(scenes.press_and_shear(2, increments=10), {"Output": {"VTU": 4}}))
    demand_work(laws, "every 4th of 10 increments drawn", run, {"increments drawn": 2})
    laws.demand("the log says so", "skipped: drawings of 8 of 10 increments" in log_of(run))


def paused(laws):
    """Increments in which no load changes cost no solve."""
    for dim in (2, 3):
        scene = scenes.press_and_shear(dim, increments=3)
        top = scene["Support top"]["Displacement"].replace("t - 1", "min(t, 3) - 1")
        short = laws.run(scene)
        pause = laws.run(scenes.merge(scene, {"Support top": {"Displacement": top}, "Time": {"End": 9, "Increments": 9}}))
        once = work_of(short)
        demand_work(laws, f"{dim}D, 3 increments and 6 without change", pause,
                    {what: once[what] for what in ("reductions of loads", "recoveries of displacements", "triangular solves",
                                                   "linear solves of contact", "dense factorisations")})
        last = [row for row in pause.rows if row["increment"] == 9]
        laws.demand("nothing moves", all(row["du_t1"] == 0 == row["du_t2"] for row in last)
                    and [row["r_n"] for row in last] == [row["r_n"] for row in short.rows if row["increment"] == 3])


def no_contact(laws):
    """One linear solve of each different load; the others are combinations."""
    for dim in (2, 3):
        scene = {key: entry for key, entry in scenes.press_and_shear(dim, increments=20).items()
                 if key not in ("Obstacle floor", "Contact bottom")}
        scene["Support low"] = scenes.support(2 if dim == 2 else 4, "x, y" if dim == 2 else "x, y, z")
        demand_work(laws, f"{dim}D without contact, 20 increments", laws.run(scene),
                    {"factorisations of the elastic system": 1, "condensations": 0, "reductions of loads": 0,
                     "recoveries of displacements": 2, "linear solves of contact": 0, "dense factorisations": 0})


def at_rest(laws):
    """A body that nothing reaches is left out; the others do not notice."""
    block = scenes.merge(scenes.press_and_shear(2), {"Output": {"VTU": 4}})
    other = {"Body other": scenes.box((6, 4), (1.0, 1.0), (5.0, 0.0)),
             "Support other": scenes.support(2, "x, y", body="other")}
    alone, both = laws.run(block), laws.run({**block, **other})
    laws.same("beside a body at rest", alone, both, 0.0)
    text = log_of(both)
    laws.demand("the log names it", "skipped: 70 dofs of body other, which no load, support motion or contact "
                "reaches" in text)
    laws.demand("its unknowns are not there", re.search(r"unknowns of (\d+)", text)[1]
                == re.search(r"unknowns of (\d+)", log_of(alone))[1])
    laws.demand("it is drawn", (both.folder / "solution-other-0004.vtu").exists())
    for name, change in (("a load", {"Load other": scenes.load("traction", "0 ; -1", 3, "other")}),
                         ("a support that moves", {"Support other": {"Displacement": "0 ; 0.01*t"}}),
                         ("a contact that stays open", {"Contact other": scenes.contact("other", 1, mu=.1)})):
        run = laws.run(scenes.merge({**block, **other}, change))
        laws.demand(f"{name} reaches it", "of body other, which" not in log_of(run))


def congruent(laws):
    run = laws.run(scenes.press_and_shear(3))
    laws.demand("congruent cells share a matrix", "skipped: 79 of 80 cell matrices of body block" in log_of(run))


def beside_each_other(block, names):
    """A block with equal ones beside it, each on the same floor."""
    dim, scene = block["Dimension"], dict(block)
    cells, size = ((12, 6), (2.0, 1.0)) if dim == 2 else ((5, 4, 4), (1.5, 1.0, 1.0))
    for k, name in enumerate(names, 1):
        scene[f"Body {name}"] = scenes.box(cells, size, (3.0 * k,) + (0.0,) * (dim - 1))
        scene[f"Contact {name}"] = {**block["Contact bottom"], "Body": name}
        scene[f"Support {name}"] = {**block["Support top"], "Body": name}
    return scene


def reactions(run, contact):
    return [row[what] for row in run.rows if row["contact"] == contact for what in REACTION]


def used_again(laws):
    """A body that is there several times is factorised once; one that differs, once more."""
    for dim in (2, 3):
        block = scenes.press_and_shear(dim)
        names = ("b", "c", "d")
        scene = beside_each_other(block, names)
        alone = laws.run(block)
        laws.demand("one body has no equal", "equal to others" not in log_of(alone))
        expected = reactions(alone, "bottom")
        size = max(map(abs, expected))
        for what, change, factors, shared in (
                ("four equal blocks", {}, 1, 3),
                ("another material", {"Body c": {"Material": {"Young modulus": 1001}}}, 2, 2),
                ("another support", {"Support c": {"Stiffness": 500}}, 2, 2)):
            run = laws.run(scenes.merge(scene, change))
            demand_work(laws, f"{dim}D, {what}", run, {"factorisations of the elastic system": factors,
                                                       "condensations": factors})
            laws.demand("the log says so",
                        f"skipped: condensation of {shared} of 4 bodies, equal to others" in log_of(run))
            for name in ("bottom",) + names:
                if name != "c" or not change:
                    found = reactions(run, name)
                    laws.check(f"{name}: reactions are those of the block alone",
                               max(abs(f - e) for f, e in zip(found, expected, strict=True)) / size, 1e-12)


def estimated(laws):
    """A dry run writes and factorises nothing; its estimates are those of the run."""
    for dim, cells, mu in ((2, (120, 120), .3), (3, (14, 14, 14), .3), (3, (14, 14, 14), 0.0)):
        scene = scenes.press_and_shear(dim, cells=cells, mu=mu)
        name = f"{dim}D, mu = {mu}"
        file = laws.folder / "dry.prm"
        scenes.write_scene(scene, file)
        before = sorted(laws.folder.iterdir())
        text = dry_run(laws, scene)
        laws.demand(f"{name}: writes nothing", sorted(laws.folder.iterdir()) == before)
        laws.demand(f"{name}: factorises nothing",
                    "work: 0 factorisations of the elastic system, 0 condensations" in text)
        laws.demand(f"{name}: says what is skipped", "skipped: drawings of 4 of 4" in text)
        check_estimates(laws, name, text, laws.run(scene), "factor", "condensed stiffness", "memory")
        # columns of the factor have c_j entries: their squares are the operations
        entries = float(re.search(r"factor of (\S+) MB, ", text)[1]) * 1e6 / 8
        mean = entries**2 / int(re.search(r"unknowns of (\d+)", text)[1])
        flops = float(re.search(r"estimate: (\S+) floating", text)[1])
        laws.demand(f"{name}: {flops:.3g} operations, columns of equal length would take {mean:.3g}",
                    mean < flops < 5 * mean)

    scene = scenes.merge(scene, {"Load side": scenes.load("traction", "1/(t - 2) ; 0 ; 0", 0)})
    scenes.write_scene(scene, file)
    done = subprocess.run([laws.program, file, "--dry-run"], capture_output=True, text=True)
    laws.demand("a dry run finds a load that is not finite", done.returncode == 1 and "is not finite" in done.stderr)


def estimated_of_processes(laws):
    """The same of each process where nothing is condensed."""
    for dim, cells in ((2, (130, 130)), (3, (20, 20, 20))):
        scene = scenes.press_and_shear(dim, cells=cells, increments=2)
        iterative = ("-s", "Solver/Backend=iterative")
        check_estimates(laws, f"{dim}D, iterative", dry_run(laws, scene, *iterative), laws.run(scene, *iterative), "memory")
        for n in (2, 3):
            processes = (*iterative, "--processes", str(n))
            first, other = re.search(r"processes, the first one (\S+) MB .*, each other one (\S+) MB",
                                     dry_run(laws, scene, *processes)).groups()
            log = log_of(laws.run(scene, *processes))
            found = re.search("memory of processes: (.*)", log)[1].split(", ")
            laws.demand(f"{dim}D: there are {n} processes", len(found) == n)
            check_ratio(laws, f"{dim}D, {n} processes: memory of the first", first, found[0].split()[0])
            for memory in found[1:]:
                check_ratio(laws, f"{dim}D, {n} processes: memory of another", other, memory.split()[0])


def choice(laws, scene):
    return re.search("backend: .*", dry_run(laws, scene))[0]


def operations(line):
    return [float(number) for number in re.findall(r"(\S+) operations", line)]


def chosen_under_load(laws):
    """Backends are chosen by operations, not by the clock: others on the machine change nothing."""
    scene = scenes.press_and_shear(3, cells=(28, 28, 28))
    alone = choice(laws, scene)
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(3 * os.cpu_count())]
    try:
        crowded = choice(laws, scene)
    finally:
        for other in others:
            other.kill()
            other.wait()
    laws.demand(f"alone {alone}; beside others {crowded}",
                alone.split()[1] == crowded.split()[1] and len(operations(alone)) == 2
                and operations(alone) == operations(crowded))


def chosen(laws):
    """Large bodies are not condensed but where iterations are slow: what is nearly incompressible, hard slaves."""
    found = []
    for nu in (.3, .4999):
        scene = scenes.with_element(scenes.press_and_shear(3, cells=(28, 28, 28)), "Q1 B-bar")
        line = choice(laws, scenes.merge(scene, {"Body block": {"Material": {"Poisson ratio": nu}}}))
        found.append(operations(line)[1])
    laws.demand(f"nu = {nu}: {line}", line.startswith("backend: condensed") and line.endswith("nearly incompressible"))
    laws.demand("the iterative backend would take far longer", found[1] > 20 * found[0])
    stack = scenes.stack(3, ((26, 26, 26), (28, 28, 28)), (1.0, 1.0), .3, .3)
    bodies = [body for body in stack if body.startswith("Body ")]
    for hard, backend in ((None, "iterative"), (bodies[0], "iterative"), (bodies[1], "condensed")):
        scene = scenes.merge(stack, {hard: {"Material": {"Young modulus": 1e5}}}) if hard else stack
        line = choice(laws, scene)
        laws.demand(f"{hard or 'no body'} is harder than the others: {line}", line.startswith(f"backend: {backend}"))
    laws.demand("it says why", line.endswith("as a slave is harder than its master"))


def failed(laws):
    """A run without an equilibrium says what it did, too."""
    done, folder = laws.start(scenes.SHIPPED / "floating-block.prm", "-s", "Contact bottom/Friction coefficient=0.01")
    last = (folder / "log.txt").read_text().splitlines()[-4:]
    laws.demand(f"exit code {done.returncode}: the reason, memory, elements and work end the log",
                done.returncode == 2 and done.stderr.endswith(last[0] + "\n") and last[3].startswith("work: 1 fact"))


def frictionless(laws):
    """Tangential displacements of nodes without friction are condensed with the rest."""
    for dim in (2, 3):
        run = laws.run(scenes.press_and_shear(dim, mu=0.0))
        n = len(run.last())
        laws.demand(f"{dim}D: {n} nodes without friction, as many unknowns",
                    f"{n} contact nodes with {n} unknowns" in log_of(run)
                    and f"skipped: friction cones of {n} contact nodes" in log_of(run))


CHECKS = (factor_once, carried, loads_once, tables_once, drawn_only, paused, no_contact, at_rest, congruent, used_again,
          estimated, estimated_of_processes, chosen, chosen_under_load, failed, frictionless)

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(run_families({check.__name__: check for check in CHECKS}, sys.argv[1], "all"))
