# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ctrl-C: the increment that is running is finished, a second one ends the run at once; what is on disk is whole."""
import re
import signal
import subprocess
import time

from laws.kill import readable, rows_on_disk
from laws.restart import difference, far_kinds, go_on
from support.scenes import merge, press_and_shear, pushed_block, write_scene


def by_default():
    """Shells let jobs in the background ignore SIGINT."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def begin(laws, file, folder, *arguments, preexec_fn=by_default):
    return subprocess.Popen([laws.program, file, "-o", folder, *arguments], cwd=laws.folder, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=preexec_fn)


def interrupt_at(laws, file, folder, n):
    """SIGINT as soon as n increments are on disk; what is printed, and how many there are at the end."""
    process = begin(laws, file, folder, "--quiet")
    while process.poll() is None and rows_on_disk(folder) < n:
        time.sleep(.001)
    process.send_signal(signal.SIGINT)
    said = process.communicate()[1]
    rows = rows_on_disk(folder)
    laws.demand(f"{file.stem}, interrupted at {n} increments, {rows} are on disk, ended by {-process.returncode}: "
                f"{said.strip().splitlines()[-1] if said.strip() else ''}",
                process.returncode == -signal.SIGINT and "is finished first" in said and rows >= n)
    readable(laws, folder, "  what is on disk", quiet=True)
    return said, rows


def finishes(laws, name, scene):
    """A checkpoint is written, wherever the next one would have been, and the rest is that of a run in one go."""
    file, folder = laws.folder / f"{name}.prm", laws.folder / name
    write_scene(merge(scene, {"Output": {"Checkpoint": 1000}}), file)
    whole = laws.run(file)
    total = len(whole.increments)
    said, rows = interrupt_at(laws, file, folder, total // 4)
    laws.demand("  it is told which increment was the last one, and how to go on",
                f"Interrupted after increment {rows}, t = " in said and f"--restart {folder}" in said)
    laws.demand("  the log says so, too, and how results are", all(
        text in (folder / "log.txt").read_text() for text in (f"Interrupted after increment {rows}", "work: ", "contact ")))
    laws.demand("  some increments are left", total // 4 <= rows < total)
    if go_on(laws, file, folder):
        laws.check("  difference from the whole run", difference(whole.folder, folder), 1e-12)


def interrupt(laws):
    small = merge(press_and_shear(3, cells=(7, 7, 7), increments=120), {"Output": {"VTU": 1}})
    small["Support top"]["Displacement"] = "0.001*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"
    finishes(laws, "many-at-once", small)
    parts = merge(far_kinds()["increments in parts"], {"Output": {"VTU": 1}})
    finishes(laws, "in-parts", parts)

    plain = laws.folder / "plain.prm"
    write_scene(small, plain)
    said, _ = interrupt_at(laws, plain, laws.folder / "plain", 3)
    laws.demand("  without a checkpoint it is told which entry makes one", "Output/Checkpoint = 1" in said)

    path = laws.folder / "path.prm"
    write_scene(merge(pushed_block(2, .6, .5, cells=(80, 40)), {"Output": {"VTU": 1}}), path)
    said, rows = interrupt_at(laws, path, laws.folder / "path", 2)
    laws.demand("  a load path is told to begin again", f"Interrupted at point {rows} of the path" in said and "from its start" in said)
    at_once(laws, plain)
    unheard(laws)


def at_once(laws, plain):
    """The second one does not wait."""
    folder = laws.folder / "twice"
    process = begin(laws, plain, folder, "--quiet", "-s", "Body block/Mesh/Global refinements=2")
    while process.poll() is None and not (folder / "increments.csv").exists():
        time.sleep(.001)
    process.send_signal(signal.SIGINT)
    process.stderr.readline()
    told = process.stderr.readline()
    process.send_signal(signal.SIGINT)
    said = told + process.communicate()[1]
    laws.demand(f"a second one ends the run by {-process.returncode} without another word: {told.strip()}",
                process.returncode == -signal.SIGINT and "once more ends the run at once" in told and "Interrupted" not in said)
    readable(laws, folder, "  what is on disk", quiet=True)


def unheard(laws):
    """As under nohup; and while meshes are made the first one ends all."""
    small = press_and_shear(2, increments=40)
    file, folder = laws.folder / "unheard.prm", laws.folder / "unheard"
    write_scene(small, file)
    process = begin(laws, file, folder, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
    for _ in range(3):
        process.send_signal(signal.SIGINT)
        time.sleep(.02)
    out, said = process.communicate()
    laws.demand("where SIGINT is ignored the run goes on to its end", process.returncode == 0 and not said and
                rows_on_disk(folder) == 40 and re.search("Results are in", out))
