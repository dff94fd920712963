#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A model of the times of one and many processes: fitted to small runs, held against larger ones, then asked for 1e8 and 1e9 dofs.

usage: process_times.py [--build FOLDER] [--results FOLDER] [--runs R] [--table FILE] [--quick]

Scene: block-press-shear.prm with N^3 cells. Of n processes each works, in seconds of CPU,

    start(n) + a D + b D / n + c S I + d D K / n

with D dofs, S contact nodes, I increments and K linear iterations. a and c are what each does alike, b and d what processes share. start
is a run of 2^3 cells; the others are fitted to runs of 16^3 and 32^3 cells with one and two processes, 1 and 11 increments, and of 16^3
with eight, so that what is alike shows. Work is CPU without that of waiting for others (log.txt), of the process that works
most, the least of R runs. Memory is libraries(n) + e D + f D / n, fitted to all runs. The clock is that work and the messages of messages(),

    K (messages + sums log2 n) latency + K (bytes + 2 bytes of sums) / bandwidth

for two processes of this machine with a ping-pong through mpi4py. Runs that were not fitted tell how far the model is right.
Prints three tables and writes process_times.csv, all runs, to FOLDER; --table reads such a file and runs nothing but the ping-pong.
"""
import argparse
import csv
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy
from scipy.optimize import nnls

import weak_scaling
from measure import TOP, table

INCREMENTS = 11
TINY = 2  # cells along an edge: hardly more than the start
FITTED = [(n, p, i) for n in (16, 32) for p in (1, 2) for i in (1, INCREMENTS)] + [(16, 8, 1), (16, 8, INCREMENTS)]
FORETOLD = [(n, p, INCREMENTS) for n in (24, 40, 48) for p in (1, 2)] + [(24, 4, INCREMENTS)]
QUICK = [(n, p, i) for n in (6, 10) for p in (1, 2) for i in (1, INCREMENTS)], [(8, 2, INCREMENTS)]
RUN = ("cells", "processes", "increments", "iterations", "work", "waiting", "memory", "messages", "bytes")

# Linear iterations an increment of one process over cells along an edge, counted; two parts or more need a few more.
ITERATIONS = {16: 27, 24: 29, 32: 30, 48: 34, 64: 34, 100: 37}
MORE_OF_PARTS = 1.03

# Of a process and iteration, from weak_scaling.py: exchanges with each neighbour on each shared level, their bytes a node of others,
# sums over all, and bytes of them a contact node.
EXCHANGES, BYTES_OF_GHOST, SUMS, BYTES_OF_CONTACT = 6, 84, 7, 120
WHOLE = 4000  # unknowns of a level of which each process has all

# Latency [s] and bandwidth [bytes/s] of MPI between two machines: gist.github.com/jfgrimm/3af692a5475bdd4ed836b5a18197a209 (2021).
NETWORKS = {"InfiniBand": (1.2e-6, 10e9), "gigabit Ethernet": (25e-6, 0.116e9)}
CLUSTERS = ((1e8, 1), (1e8, 32), (1e8, 512), (1e8, 4096), (1e9, 512), (1e9, 4096))
COMPARED = ("cells", "processes", "increments", "fitted", "iterations", "counted", "work of each, s", "measured", "off, %", "clock, s",
            "memory of each, MB", "measured", "messages an iteration", "counted", "kB", "counted")


def iterations(cells, processes, increments=INCREMENTS):
    """A straight line over the logarithm of the cells along an edge; the first increment takes a third more."""
    slope, first = numpy.polyfit(numpy.log(list(ITERATIONS)), list(ITERATIONS.values()), 1)
    mean = first + slope * math.log(cells)
    return (increments if increments > 1 else 1.33) * mean * (MORE_OF_PARTS if processes > 1 else 1)


def parts(processes):
    """Along each axis, as equal as powers of two may be."""
    power = round(math.log2(processes))
    return [2 ** ((power + axis) // 3) for axis in (2, 1, 0)]


def messages(cells, processes):
    """Of the process that has most, an iteration: messages, bytes, sums, bytes of sums."""
    if processes == 1:
        return 0, 0, 0, 0
    nodes, along = cells + 1, parts(processes)
    neighbours = math.prod(min(n, 3) for n in along) - 1
    ghosts = math.prod(nodes / n + min(n - 1, 2) for n in along) - math.prod(nodes / n for n in along)
    levels = 1  # aggregates are of 3^3 nodes and have six unknowns
    while 6 * (nodes / 3**levels) ** 3 > WHOLE:
        levels += 1
    return (EXCHANGES * levels * neighbours, BYTES_OF_GHOST * ghosts * sum((2 / 9) ** level for level in range(levels)),
            SUMS, BYTES_OF_CONTACT * nodes**2)


def seconds_of_messages(cells, processes, count, latency, bandwidth):
    number, size, sums, size_of_sums = messages(cells, processes)
    return count * ((number + sums * math.log2(processes)) * latency + (size + 2 * size_of_sums) / bandwidth)


def ping_pong():
    """Prints latency and bandwidth between two processes: half the shortest way there and back."""
    from mpi4py import MPI
    world = MPI.COMM_WORLD

    def shortest(size, tries):
        data, best = bytearray(size), math.inf
        for _ in range(tries):
            start = MPI.Wtime()
            if world.rank == 0:
                world.Send(data, 1)
                world.Recv(data, 1)
            else:
                world.Recv(data, 0)
                world.Send(data, 0)
            best = min(best, (MPI.Wtime() - start) / 2)
        return best
    latency, large = shortest(8, 20000), 1 << 20
    bandwidth = large / shortest(large, 500)
    if world.rank == 0:
        print(latency, bandwidth)


def run(build, cells, processes, increments):
    """What is in RUN: of the process that has most."""
    log, seconds = weak_scaling.run(build, processes, (cells,) * 3, increments)
    count = weak_scaling.iterations(log)
    cpu = weak_scaling.numbers(log, "CPU of processes") or [seconds]
    waiting = weak_scaling.numbers(log, "of which waiting") or [0]
    each = [max(weak_scaling.numbers(log, name), default=0) / count for name in ("messages to neighbours", "their bytes")]
    return dict(zip(RUN, (cells, processes, increments, count, max(c - w for c, w in zip(cpu, waiting)), max(waiting),
                          max(weak_scaling.megabytes(log)), *each)))


def measure(build, keys, repeats):
    """Each once, then each again, so that other programs disturb all alike."""
    best = {}
    for _ in range(repeats):
        for key in keys:
            found = run(build, *key)
            least = best.setdefault(key, found)
            for name in ("work", "memory"):
                least[name] = min(least[name], found[name])
    return best


def read(file):
    with open(file, newline="") as stream:
        rows = [{name: float(number) for name, number in row.items()} for row in csv.DictReader(stream)]
    return {tuple(int(row[name]) for name in RUN[:3]): row for row in rows}


def fit(rows, values, weights):
    """No coefficient is less than nothing."""
    return nnls(numpy.array(rows) * numpy.array(weights)[:, None], numpy.multiply(values, weights))[0]


class Model:
    def __init__(self, runs, keys):
        tiny = {p: one for (n, p, _), one in runs.items() if n == TINY}
        self.start = {p: one["work"] for p, one in tiny.items()}
        self.libraries = {p: one["memory"] for p, one in tiny.items()}
        work = [runs[key]["work"] - self.start[key[1]] for key in keys]
        self.of_work = fit([self.terms(*key, runs[key]["iterations"]) for key in keys], work, [1 / max(w, .01) for w in work])
        self.of_memory = fit([self.terms(*key, 0)[:2] for key in runs],
                             [one["memory"] - self.libraries[p] for (_, p, _), one in runs.items()], [1] * len(runs))

    @staticmethod
    def terms(cells, processes, increments, count):
        dofs, contacts = 3 * (cells + 1) ** 3, (cells + 1) ** 2
        return dofs, dofs / processes, contacts * increments, dofs * count / processes

    def work(self, cells, processes, increments=INCREMENTS):
        terms = self.terms(cells, processes, increments, iterations(cells, processes, increments))
        return self.start.get(processes, max(self.start.values())) + self.of_work @ terms

    def memory(self, cells, processes):
        return self.libraries.get(processes, max(self.libraries.values())) + self.of_memory @ self.terms(cells, processes, 0, 0)[:2]


def constants(model, latency, bandwidth):
    names = ("a, us a dof, alike", "b, us a dof, shared", "c, us a contact node and increment, alike", "d, us a dof and iteration, shared")
    return [("start, s, by processes", ", ".join(f"{p}: {s:.2f}" for p, s in model.start.items())),
            *zip(names, (f"{1e6 * x:.3g}" for x in model.of_work)),
            *zip(("e, kB a dof, alike", "f, kB a dof, shared"), (f"{1e3 * x:.2g}" for x in model.of_memory)),
            ("latency here, us", f"{1e6 * latency:.2g}"), ("bandwidth here, GB/s", f"{1e-9 * bandwidth:.2g}")]


def compare(model, runs, keys, latency, bandwidth):
    rows = []
    for key, one in sorted(runs.items()):
        cells, processes, increments = key
        if cells == TINY:
            continue
        count, work, sent = iterations(*key), model.work(*key), messages(cells, processes)
        clock = work + seconds_of_messages(cells, processes, count, latency, bandwidth)
        rows.append((f"{cells}^3", processes, increments, "yes" if key in keys else "no", f"{count:.0f}", f"{one['iterations']:.0f}", f"{work:.2f}",
                     f"{one['work']:.2f}", f"{100 * (work / one['work'] - 1):+.0f}", f"{clock:.2f}", f"{model.memory(cells, processes):.0f}",
                     f"{one['memory']:.0f}", sent[0], f"{one['messages']:.0f}", f"{1e-3 * sent[1]:.0f}", f"{1e-3 * one['bytes']:.0f}"))
    return rows


def foretell(model):
    rows = []
    for dofs, processes in CLUSTERS:
        cells = round((dofs / 3) ** (1 / 3)) - 1
        count, work, sent = iterations(cells, processes), model.work(cells, processes), messages(cells, processes)
        terms = model.of_work * model.terms(cells, processes, INCREMENTS, count)
        waits = [seconds_of_messages(cells, processes, count, *network) for network in NETWORKS.values()]
        rows.append((f"{dofs:.0e}", processes, f"{count:.0f}", f"{terms[0]:.0f}", f"{terms[2]:.0f}", f"{terms[1] + terms[3]:.0f}",
                     *(f"{wait:.0f}" for wait in waits), f"{work + waits[0]:.0f}", f"{model.memory(cells, processes) / 1e3:.0f}", sent[0],
                     f"{sent[1] / 1e3:.0f}", f"{sent[3] / 1e6:.0f}"))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--runs", type=int, default=3, metavar="R")
    parser.add_argument("--table", type=Path, metavar="FILE")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--ping-pong", action="store_true", help="what two processes do that mpirun starts")
    options = parser.parse_args()
    if options.ping_pong:
        return ping_pong()
    os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
    fitted, foretold = QUICK if options.quick else (FITTED, FORETOLD)
    keys = [(TINY, p, 1) for p in sorted({p for _, p, _ in fitted + foretold})] + fitted + foretold
    runs = read(options.table) if options.table else measure(options.build.resolve(), keys, options.runs)
    answer = subprocess.run(["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n", "2", sys.executable, __file__,
                             "--ping-pong"], check=True, capture_output=True, text=True).stdout
    latency, bandwidth = map(float, answer.split())
    model = Model(runs, fitted)
    print(table(("constant", "value"), constants(model, latency, bandwidth)))
    print("\n" + table(COMPARED, compare(model, runs, fitted, latency, bandwidth)))
    print("\n" + table(("dofs", "processes", "iterations", "s: a D", "c S I", "shared", *(f"messages, {n}" for n in NETWORKS), "clock, InfiniBand",
                        "memory of each, GB", "messages an iteration", "kB", "MB of sums"), foretell(model)))
    options.results.mkdir(parents=True, exist_ok=True)
    with open(options.results / "process_times.csv", "w", newline="") as stream:
        writer = csv.DictWriter(stream, RUN)
        writer.writeheader()
        writer.writerows(runs.values())


if __name__ == "__main__":
    sys.exit(main())
