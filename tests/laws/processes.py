# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Neither the number of processes of mpirun nor how nodes are shared among them changes a result."""
import csv
import os
import re
import signal
import subprocess
import time
from pathlib import Path

from laws.iterative_sliding import ball
from laws.preload import flanged
from support.scenes import SHIPPED, box, contact, floor, joint, load, merge, press_and_shear, support, write_scene

# as many processes as a test wants, whatever the cores are and whoever starts it
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}
ITERATIVE = ("-s", "Solver/Backend=iterative")


def same_increments(laws, one, many):
    """Resultants and energies, sums over what each process has verified."""
    kinds = (re.compile("_f_[xyz]$"), re.compile("_m_[xyz]$"), re.compile("^(strain_energy|external_work|dissipation|contact_work_normal)$"))
    tables = [list(csv.DictReader((run.folder / "increments.csv").open())) for run in (one, many)]
    worst = 0.0
    for kind in kinds:
        pairs = [(float(a[name]), float(b[name])) for a, b in zip(*tables) for name in a if kind.search(name)]
        worst = max(worst, max(abs(a - b) for a, b in pairs) / max(max(abs(a) for a, _ in pairs), 1e-300))
    laws.demand("  as many increments", len(tables[0]) == len(tables[1]) > 0)
    laws.check("  resultants and energies", worst, 1e-9)


def compare(laws, what, scene, *numbers, says="they share the linear systems"):
    """Tables of one process and of several ones."""
    arguments = ITERATIVE
    one = laws.run(scene, *arguments)
    for n in numbers:
        many = laws.run(scene, *arguments, "--processes", str(n))
        laws.same(f"{what}, {n} processes", one, many, 1e-8)
        same_increments(laws, one, many)
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
    compare(laws, "2D, too small to be shared", press_and_shear(2), 2,
            says="the first one does the work, the others have nothing to do")
    compare(laws, "3D, a hard slave", merge(pair(3, "mortar"), {"Body upper": {"Material": {"Young modulus": 1e6}}}), 2)


def more(laws):
    """Shapes, pairings and shares of work that tests of every day leave out."""
    # halves above each other: one has no contact node
    tall = merge(press_and_shear(3, cells=(11, 8, 8), increments=2), {"Body block": box((4, 4, 20), (1.0, 1.0, 5.0))})
    compare(laws, "3D, contact nodes of one process only", tall, 2)
    compare(laws, "2D, own weight, foundation, refined", merge(press_and_shear(2, cells=(30, 16), increments=3), {
        "Support side": support(1, "x", Stiffness=300), "Load weight": load("body force", "0 ; -2"),
        "Body block": {"Mesh": {"Refinement boxes": "0, 0 : 0.6, 0.3 : 2 ; 1.6, 0 : 2, 0.2 : 3"}}}), 3)
    compare(laws, "3D, mortar", pair(3, "mortar"), 2)
    compare(laws, "2D, node to face", pair(2, "node to face"), 3)
    compare(laws, "3D, a bolt that is tightened and locked", flanged(3, **{"Preload locked from": 1}), 2)
    compare(laws, "3D, a ball that moves over a layer", merge(ball(), {"Body layer": box((13, 6, 5), (3.6, 1.6, .8), (-1.8, -.8, -.8))}), 2)
    shares(laws, (2, 3))
    alone(laws)
    interrupted(laws)


def seen(run):
    """Elements that each process has looked at."""
    return [int(n) for n in re.search(r"^elements seen(?: by processes)?: (.*)$", (run.folder / "log.txt").read_text(), re.M)[1].split(", ")]


def shares(laws, numbers):
    """What is done with elements is done by those processes that have their nodes: those between two processes are both's."""
    layers, cells = 40, (8, 8, 40)
    scene = merge(press_and_shear(3, cells=cells, increments=2), {"Solver": {"Backend": "iterative"}, "Output": {"VTU": 0}})
    one = seen(laws.run(scene))
    whole = 8 * 8 * layers
    laws.demand(f"elements seen by one process: {one[0]}", len(one) == 1 and one[0] > 0 and one[0] % whole == 0)
    for n in numbers:
        many = seen(laws.run(scene, "--processes", str(n)))
        mean, largest = sum(many) / n, max(many)
        # many look at all once more, to part them; of its nodes a process may have parts of two layers, and meets one layer on each side
        most = (one[0] + whole) * (1 / n + 3 / layers)
        laws.demand(f"of {n} processes: {many}, {largest / mean:.3f} times the mean at most", len(many) == n and largest <= 1.15 * mean)
        laws.demand(f"  the largest is {largest / (one[0] + whole):.3f} of all", largest <= most)


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


def killed(laws):
    """Whichever process is killed, or the one that has started them: none is left behind, what was finished can be read."""
    scene = press_and_shear(3, cells=(24, 20, 20), increments=40)
    for what, number, which in (("the first process", signal.SIGKILL, 0), ("another one", signal.SIGKILL, 2), ("another one, as by a user", signal.SIGTERM, 1),
                                ("mpirun, as by a batch system", signal.SIGTERM, None)):
        file, folder = laws.folder / "killed.prm", laws.folder / f"killed-{number}-{which}"
        write_scene(merge(scene, {"Solver": {"Backend": "iterative"}}), file)
        with subprocess.Popen(["mpirun", "-n", "3", laws.program, file, "-o", folder, "--quiet"], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            table = folder / "increments.csv"
            while process.poll() is None and not (table.exists() and table.read_text().count("\n") > 2):
                time.sleep(.02)
            ranks = runs_of(folder)
            os.kill(process.pid if which is None else ranks[which], number)
            process.wait(timeout=60)
        end = time.monotonic() + 20
        while runs_of(folder) and time.monotonic() < end:
            time.sleep(.1)
        laws.demand(f"{what} is killed: of {len(ranks)} processes {len(runs_of(folder))} are left, exit code {process.returncode}",
                    len(ranks) == 3 and not runs_of(folder) and process.returncode != 0)
        lines = table.read_text().splitlines()
        laws.demand("  the table has whole rows", len(lines) > 2 and len({line.count(",") for line in lines}) == 1)


def interrupted(laws):
    """Ctrl-C at a terminal, which sends it to the whole group: one sentence of what is on disk and how to go on, and no process is left."""
    n, file = 90, laws.folder / "interrupted.prm"
    write_scene(merge(press_and_shear(3, cells=(12, 10, 10), increments=n), {"Solver": {"Backend": "iterative"}, "Output": {"Checkpoint": 2, "VTU": 0}}), file)
    for what, words, code, says in (
            ("--processes", (laws.program, file, "--processes", "3"), -signal.SIGINT, ("is finished first", "Interrupted after increment", "to go on.")),
            ("mpirun", ("mpirun", "-n", "3", laws.program, file), None, ("Interrupted after increment", "to go on"))):
        folder = laws.folder / f"interrupted-by-{what.strip('-')}"
        with subprocess.Popen([*words, "-o", folder, "--quiet"], env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, start_new_session=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)) as process:
            table = folder / "increments.csv"
            while process.poll() is None and not (table.exists() and table.read_text().count("\n") > 8):
                time.sleep(.01)
            os.killpg(process.pid, signal.SIGINT)
            said = process.communicate(timeout=60)[1]
        rows = table.read_text().count("\n") - 1
        laws.demand(f"Ctrl-C, {what}: ended by {process.returncode}, {rows} increments are on disk: {' '.join(ours(said)[-1:])}",
                    process.returncode == code if code else process.returncode != 0)
        laws.demand("  it is said once", all(said.count(words) == 1 for words in says) and str(folder) in said and len(ours(said)) == len(says) - 1
                    # where it is ended between a row and its sentence, that of the row before is said, which is true as well
                    and any(f"after increment {last}," in said for last in ((rows,) if code else (rows, rows - 1))))
        end = time.monotonic() + 20
        while runs_of(folder) and time.monotonic() < end:
            time.sleep(.1)
        laws.demand("  no process is left", not runs_of(folder))
        done = start(laws, 2, file, "-o", folder, "--restart", folder, "--quiet")
        laws.demand("  it goes on from there", done.returncode == 0 and table.read_text().count("\n") == n + 1)


def runs_of(folder):
    """The processes that write there, in the order of their ranks."""
    found = {}
    for process in Path("/proc").iterdir():
        try:
            words = (process / "cmdline").read_bytes().split(b"\0")
            if str(folder).encode() in words and not words[0].endswith(b"mpirun"):
                environment = dict(word.split(b"=", 1) for word in (process / "environ").read_bytes().split(b"\0") if b"=" in word)
                found[int(environment[b"OMPI_COMM_WORLD_RANK"])] = int(process.name)
        except (OSError, KeyError, ValueError):
            continue
    return [found[rank] for rank in sorted(found)]


ALONE = "the first one does the work, the others have nothing to do"


def alone(laws):
    """What the first process does while others sleep, and what they know of it when they are needed again."""
    one, many = (laws.run(press_and_shear(2), *more) for more in ((), ("--processes", "2")))
    laws.same("condensed by the first of two processes", one, many, 1e-14)
    laws.demand("  the log says so", ALONE in (many.folder / "log.txt").read_text())
    stages = merge(press_and_shear(2), {"Support top": {"Active": "t < 1.5"}, "Support again": support(3, "x, y", "0 ; -0.01", Active="t > 1.5")})
    for what, scene, arguments, says in (
            ("other supports from a time on", stages, (), ALONE),
            ("a mesh that is refined twice", SHIPPED / "cylinder-on-plane.prm", ("-s", "Adaptive refinement=2"), ALONE),
            ("a mesh that is shared once it has been refined", press_and_shear(2, cells=(17, 17), increments=2),
             (*ITERATIVE, "-s", "Adaptive refinement=1", "-s", "Adaptive fraction=0.6"), "they share the linear systems")):
        one, many = (laws.run(scene, "-s", "Output/VTU=0", *arguments, *more) for more in ((), ("--processes", "3")))
        laws.same(what, one, many, 1e-8)
        laws.demand(f"  the log says: {says}", says in (many.folder / "log.txt").read_text())
    soft = {"Dimension": 2, "Body block": box((60, 14), (4.0, 1.0), young=1e4), "Obstacle floor": floor(2), "Contact bottom": contact(),
            "Support spring": support(1, "x", Stiffness=1e-3), "Time": {"End": 1, "Increments": 2}, "Output": {"VTU": 0},
            "Load pull": {"Body": "block", "Kind": "point force", "Point": (2, 1), "Value": "0.0005*t ; -2*t"}}
    one, many = (laws.run(soft, *ITERATIVE, *more) for more in ((), ("--processes", "3")))
    laws.same("shared, then condensed by the first process", one, many, 1e-8)
    laws.demand("  the log says so", "From here on bodies are condensed" in (many.folder / "log.txt").read_text())


def continued(laws):
    """A checkpoint has what all processes know together, whatever their number is then."""
    scene = press_and_shear(3, cells=(11, 8, 8))
    whole = laws.run(scene, *ITERATIVE)
    checkpoint = ("-s", "Output/Checkpoint=1")
    part = laws.run(scene, *ITERATIVE, *checkpoint, "-s", "Time/End=2", "-s", "Time/Increments=2", "--processes", "2")
    rest = laws.run(scene, *ITERATIVE, *checkpoint, "--restart", part.folder, "--processes", "3")
    laws.same("begun by two processes, continued by three", whole, rest, 1e-8)
    same_increments(laws, whole, rest)


def four(laws):
    shares(laws, (4,))
    continued(laws)
    compare(laws, "3D", press_and_shear(3, cells=(11, 8, 8), increments=2), 4)
    compare(laws, "3D, more processes than are worth it", press_and_shear(3, cells=(7, 7, 8), increments=2), 4)


def seven(laws):
    """More processes than layers of cells: some have no contact node, some hardly a cell of their own; a body of a few nodes."""
    thin = press_and_shear(3, cells=(16, 9, 9), increments=2)
    compare(laws, "3D, parts of some nodes", thin, 3, 7)
    small = merge(pair(3, "mortar"), {"Body upper": box((1, 1, 1), (1.0, 1.0, .7), (0.0, 0.0, .7), young=1e4),
                                      "Body lower": box((14, 12, 8), (1.0, 1.0, .7)),
                                      "Contact joint": joint("lower", 5, "upper", 4, **{"Friction coefficient": .3})})
    compare(laws, "3D, a body of fewer nodes than processes", small, 7)


def processes(laws):
    tables(laws)
    endings(laws)
    killed(laws)
