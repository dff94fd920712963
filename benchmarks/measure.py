# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""CPU seconds of processes, Markdown tables, axes: what the benchmarks share.

Puts tests/ on the path, from where they import `support` and nothing else.
"""
import os
import statistics
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
sys.path.append(str(TOP / "tests"))


def resources(command, output=os.devnull, folder=".", one_core=True):
    """What the whole process used (CPU seconds, peak memory [MB]), None if it fails.

    It runs in the folder, pinned to one core unless told otherwise; what it prints goes to a file.
    """
    command = [str(word) for word in command]
    child = os.fork()
    if child == 0:
        os.chdir(folder)
        if one_core:
            os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
            os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
        os.dup2(os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 1)
        os.execv(command[0], command)
    _, status, usage = os.wait4(child, 0)
    return (usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3) if status == 0 else None


def checked_resources(command, output=os.devnull, **how):
    """The same of a process that must not fail."""
    used = resources(command, output, **how)
    if used is None:
        raise SystemExit(f"{' '.join(map(str, command))} failed"
                         + (f"; what it said is in {output}" if output != os.devnull else ""))
    return used


def cpu_seconds(command, output=os.devnull, **how):
    return checked_resources(command, output, **how)[0]


def median_cpu_seconds(command, runs=3):
    return statistics.median(cpu_seconds(command) for _ in range(runs))


def table(columns, rows):
    """A Markdown table."""
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def plain_ticks(axis):
    """Numbers 1, 2, 5 of each decade along a logarithmic axis of matplotlib, written out."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def finish_panel(panel, **words):
    """Title and labels, numbers along its logarithmic x axis, and a grid."""
    panel.set(**words)
    plain_ticks(panel.xaxis)
    panel.grid(True, which="major", alpha=.3)
