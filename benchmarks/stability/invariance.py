#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene that is turned, mirrored, given in other units, with its bodies in another order or solved by another
backend or condensation ends as it did: the same exit code, the same kind of sentence, the same forces.

Runs random scenes (random_scenes.py) in all of these ways and compares with the first one. Forces are compared node by
node where they are determined, to 1e-8 of the largest. Prints what differs; exit code 1 if anything does.

    cmake --build build --target conetact
    /usr/bin/python3 benchmarks/stability/invariance.py --count 300
    /usr/bin/python3 benchmarks/stability/invariance.py --scene 17 --keep /tmp/scenes
"""
import argparse
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests"))
from support.batch import of_thread  # noqa: E402
from support.scenes import write_scene  # noqa: E402
from support.tables import REACTION, Run, in_space  # noqa: E402

from random_scenes import Frame, dimension_of, make_scene  # noqa: E402

SAME = 1e-8  # of the largest force
KINDS = ("slides", "tips over", "turns", "lifts off", "Nothing holds", "out of balance", "residual", "no descent",
         "not finite", "do not balance", "neither along")
# what a sentence says of a limit it says of all of its kinds
ALIKE = {kind: "limit" for kind in KINDS[:4]}


def variants(number):
    """Name, frame, options; bodies in reverse order in one of them."""
    rng, dim = random.Random(f"frame {number}"), dimension_of(number)
    axis = (0.0, 0.0, 1.0) if dim == 2 else tuple(rng.gauss(0, 1) for _ in range(3))
    degrees = rng.uniform(5, 175)
    return {"first": (Frame(dim), ()),
            "turned": (Frame(dim, axis, degrees), ()),
            "mirrored": (Frame(dim, mirrored=True), ()),
            "SI": (Frame(dim, length=1e-3), ()),
            "odd units": (Frame(dim, length=3.7e2, force=1.3e-5), ()),
            "other order": (Frame(dim), ()),
            "KLU": (Frame(dim), ("-s", "Solver/Condensation=amesos_klu")),
            "iterative": (Frame(dim), ("-s", "Solver/Backend=iterative"))}


def kind_of(sentence):
    last = sentence.splitlines()[-1] if sentence else ""
    kind = next((kind for kind in KINDS if kind in last), re.sub(r"[-+.\d]+(e[-+]?\d+)?", "#", last)[-60:])
    return ALIKE.get(kind, kind)


class End:
    """How a run ended."""

    def __init__(self, program, scene, frame, size, options, folder):
        folder.mkdir(parents=True)
        write_scene(scene, folder / "scene.prm")
        try:
            done = of_thread(program).run(folder / "scene.prm", "-o", folder / "result", "--quiet", *options, timeout=120)
            self.code, self.sentence = done.returncode, done.stderr.strip()
        except subprocess.TimeoutExpired:
            self.code, self.sentence = -1, "no end within 120 s"
        self.unknown = self.code == 1 and "Backend = iterative" in self.sentence
        self.increments, self.forces, self.largest = [], {}, 0.0
        if self.code in (0, 2) and (folder / "result" / "reactions.csv").exists():
            self.read(Run(folder / "result"), frame, size)

    def read(self, run, frame, size):
        self.increments = [row["determinate"] for row in run.increments]
        back = tuple(zip(*frame.matrix))
        for row in run.rows:
            force = in_space(row, frame.dim, REACTION)
            force = [sum(b * f for b, f in zip(line, force)) / frame.force for line in back]
            place = frame.place((row["x"], row["y"], row["z"]))
            key = row["contact"], row["increment"], *(round(c / size * 1e5 + .317) for c in place)
            self.forces[key] = force
            self.largest = max(self.largest, math.hypot(*force))
        for row in run.increments:
            for name, value in row.items():
                if re.fullmatch(r"(loads|supports)_f_[xyz]", name):
                    self.largest = max(self.largest, abs(value) / frame.force)


def difference(first, other):
    """In words; empty where there is none."""
    if other.code != first.code:
        return f"exit code {other.code}: {other.sentence[-200:]} | first {first.code}: {first.sentence[-200:]}"
    if first.code != 0 and kind_of(first.sentence) != kind_of(other.sentence):
        return f"says {other.sentence[-200:]} | first {first.sentence[-200:]}"
    if first.code == 1:
        return ""
    if first.increments != other.increments:
        return f"determinate {other.increments} | first {first.increments}"
    if first.forces.keys() != other.forces.keys():
        return "other nodes"
    worst = max((math.dist(force, other.forces[key]) for key, force in first.forces.items()
                 if first.increments[int(key[1]) - 1] == "yes"), default=0.0)
    return f"forces differ by {worst / first.largest:.1e}" if worst > SAME * first.largest else ""


def judge(program, number, folder):
    """What differs, by variant; the words of the scene and the code of the first."""
    first, faults, words = None, {}, ""
    for name, (frame, options) in variants(number).items():
        scene, words, size = make_scene(number, frame)
        if name == "mirrored" and "simplices" in words:
            continue  # another mesh
        if name == "other order":
            scene = dict(reversed(scene.items()))
        end = End(program, scene, frame, size, options, folder / name.replace(" ", "-"))
        if first is None:
            first = end
        elif not end.unknown and (what := difference(first, end)):
            faults[name] = what
    return number, words, first, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--count", type=int, default=300, help="so many scenes")
    parser.add_argument("--first", type=int, default=0, help="from this one on")
    parser.add_argument("--scene", type=int, action="append", help="only this one (may be repeated)")
    parser.add_argument("--keep", type=Path, help="folder for scenes and results")
    parser.add_argument("--conetact", type=Path, default=ROOT / "build" / "conetact")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    program, n_other, ends = options.conetact.resolve(), 0, {}
    with tempfile.TemporaryDirectory(prefix="conetact-invariance-") as scratch, ThreadPoolExecutor(options.jobs) as pool:
        folder = options.keep or Path(scratch)
        for number, words, first, faults in pool.map(lambda n: judge(program, n, folder / str(n)),
                                                     options.scene or range(options.first, options.first + options.count)):
            end = "solved" if first.code == 0 else f"exit code {first.code}: {kind_of(first.sentence)}"
            ends[end] = ends.get(end, 0) + 1
            n_other += bool(faults)
            for name, what in faults.items():
                print(f"scene {number} ({words}), {name}: {what}", flush=True)
    for end, n in sorted(ends.items(), key=lambda item: -item[1]):
        print(f"{n:4} {end}")
    print(f"{n_other} of {sum(ends.values())} scenes end otherwise in one of the ways")
    return 1 if n_other else 0


if __name__ == "__main__":
    sys.exit(main())
