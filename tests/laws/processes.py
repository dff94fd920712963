# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Neither the number of processes of mpirun nor how nodes are shared among them changes a result."""
import os
import re
import subprocess

from laws.iterative_sliding import ball
from laws.preload import flanged
from support.scenes import SHIPPED, box, joint, load, merge, press_and_shear, support

# as many processes as a test wants, whatever the cores are and whoever starts it
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}
ITERATIVE, CONDENSED = (("-s", f"Solver/Backend={name}") for name in ("iterative", "condensed"))


def compare(laws, what, scene, *numbers, arguments=ITERATIVE, says="they share the linear systems"):
    """Tables of one process and of several ones."""
    one = laws.run(scene, *arguments)
    for n in numbers:
        many = laws.run(scene, *arguments, "--processes", str(n))
        laws.same(f"{what}, {n} processes", one, many, 1e-8)
        log = (many.folder / "log.txt").read_text()
        found = re.search(r"^memory of processes: (.*)$", log, re.M)
        laws.demand(f"  there were {n}", found and len(found[1].split(", ")) == n)
        laws.demand(f"  the log says: {says}", f"{n} processes: {says}" in log)


def pair(dim, pairing):
    """A block on another one, finer than what needs no levels."""
    cells = ((24, 14), (34, 14)) if dim == 2 else ((7, 6, 4), (9, 7, 4))
    size = (2.0, 1.0) if dim == 2 else (1.0, 1.0, .7)
    low, high = (2, 3) if dim == 2 else (4, 5)
    every = "x, y" if dim == 2 else "x, y, z"
    moved = " ; ".join(["0.004*max(t - 1, 0)"] + ["0"] * (dim - 2) + ["-0.01*min(t, 1)"])
    return {"Dimension": dim, "Body lower": box(cells[0], size),
            "Body upper": box(cells[1], size, (0.0,) * (dim - 1) + (size[-1],), young=1e4),
            "Contact joint": joint("upper", low, "lower", high, **{"Pairing": pairing, "Friction coefficient": .3}),
            "Support ground": support(low, every, body="lower"),
            "Support top": support(high, every, moved, body="upper"),
            "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}


def tables(laws):
    space = press_and_shear(3, cells=(11, 8, 8), increments=2)
    compare(laws, "3D", space, 2, 3)
    # halves above each other: one has no contact node
    tall = merge(space, {"Body block": box((4, 4, 20), (1.0, 1.0, 5.0))})
    compare(laws, "3D, contact nodes of one process only", tall, 2)
    compare(laws, "2D, too small to be shared", press_and_shear(2), 2,
            says="the first one does the work, the others have nothing to do")
    compare(laws, "2D, own weight, foundation, refined", merge(press_and_shear(2, cells=(30, 16), increments=3), {
        "Support side": support(1, "x", Stiffness=300), "Load weight": load("body force", "0 ; -2"),
        "Body block": {"Mesh": {"Refinement boxes": "0, 0 : 0.6, 0.3 : 2 ; 1.6, 0 : 2, 0.2 : 3"}}}), 3)
    compare(laws, "3D, mortar", pair(3, "mortar"), 2)
    hard = {"Body upper": {"Material": {"Young modulus": 1e6}}}
    compare(laws, "3D, a hard slave", merge(pair(3, "mortar"), hard), 2)
    compare(laws, "2D, node to face", pair(2, "node to face"), 3)
    compare(laws, "3D, a bolt that is tightened and locked", flanged(3, **{"Preload locked from": 1}), 2)
    compare(laws, "3D, a ball that moves over a layer", merge(ball(), {"Body layer": box((13, 6, 5), (3.6, 1.6, .8), (-1.8, -.8, -.8))}), 2)


def start(laws, n, *arguments, **options):
    return subprocess.run(["mpirun", "-n", str(n), laws.program, *arguments], cwd=laws.folder, env=ENVIRONMENT,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, **options)


def ours(text):
    return [line for line in text.splitlines() if line.startswith("conetact: ")]


def endings(laws):
    """What is said once, and what the exit codes are."""
    block = SHIPPED / "block-press-shear.prm"
    for option, words in (("--version", "conetact "), ("--help", "usage: "), ("--parameters", "# All entries")):
        done = start(laws, 2, option)
        laws.demand(f"{option}: once", done.returncode == 0 and len(re.findall(f"^{words}", done.stdout, re.M)) == 1)
    folder = laws.folder / "refused"
    for what, wrong, code in (("wrong input", ("-s", "Solver/Tolerance=-1"), 1),
                              ("an unknown option", ("--wrong",), 1),
                              ("another number of processes", ("--processes", "3"), 1),
                              ("no number of processes", ("--processes", "0"), 1),
                              ("a folder that cannot be made", ("-o", "/proc/none"), 3)):
        done = start(laws, 2, block, "-o", folder, *wrong, timeout=60)
        laws.demand(f"{what}: one sentence, exit code {code}",
                    done.returncode == code and len(ours(done.stderr)) == 1 and not folder.exists())
    ends = merge(press_and_shear(2), {"Support top": None, "Load push": load("traction", "0.5*t ; -1", ids=3)})
    done, folder = laws.start(ends, "--processes", "2", timeout=60)
    laws.demand("no equilibrium: one sentence, exit code 2, nothing else", done.returncode == 2
                and done.stderr.count("\n") == 1 and done.stderr == "".join(line + "\n" for line in ours(done.stderr)))
    none = {**ENVIRONMENT, "PATH": str(laws.folder)}
    done, folder = laws.start(press_and_shear(2), "--processes", "2", env=none)
    laws.demand("no mpirun: one sentence", done.returncode == 1 and "mpirun" in "".join(ours(done.stderr)))


def condensed(laws):
    """A factor is shared from 20000 unknowns on: all that is solved with it, also where nodes join or bodies float."""
    one, many = (laws.run(press_and_shear(2), *more) for more in ((), ("--processes", "2")))
    laws.same("condensed by the first of two processes", one, many, 1e-14)
    laws.demand("  the log says so", "nothing to do" in (many.folder / "log.txt").read_text())
    for what, scene, numbers, changes in (
            ("3D", press_and_shear(3, cells=(24, 18, 18), increments=2), (2, 3), ()),
            ("2D, a pair", merge(pair(2, "mortar"), {"Body upper": box((150, 75), (2.0, 1.0), (0.0, 1.0))}), (2,), ()),
            ("floating-block", SHIPPED / "floating-block.prm", (2,), ("Body block/Mesh/Arguments=142, 70 : 0, 0 : 2, 1 : true",)),
            ("sphere-on-layer", SHIPPED / "sphere-on-layer.prm", (2,), ("Time/Times=1, 4, 6",))):
        compare(laws, f"condensed, {what}", scene, *numbers, says="they share the condensation",
                arguments=[*CONDENSED, "-s", "Output/VTU=0", *(word for change in changes for word in ("-s", change))])


def four(laws):
    compare(laws, "3D", press_and_shear(3, cells=(11, 8, 8), increments=2), 4)
    compare(laws, "3D, more processes than are worth it", press_and_shear(3, cells=(7, 7, 8), increments=2), 4)


def processes(laws):
    tables(laws)
    condensed(laws)
    endings(laws)
