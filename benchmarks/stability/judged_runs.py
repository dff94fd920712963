# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes, one after the other in one process, each judged by its tables; the account of them."""
import argparse
import random
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "tests"))
from support.batch import Batch  # noqa: E402
from support.scenes import write_scene  # noqa: E402
from support.tables import Run  # noqa: E402

BOUND = 1e-8  # of the largest force or length of a run


def table(values):
    """Values at t = 1, 2, ..., from 0 on, linear in between."""
    return "table(t; 0 : 0; " + "; ".join(f"{i + 1} : {v!r}" for i, v in enumerate(values)) + ")"


def reader(what, **more):
    """Options that all scripts with random scenes have."""
    parser = argparse.ArgumentParser(description=what, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder for scenes that are wrong or have no answer")
    for name, entry in more.items():
        parser.add_argument(f"--{name}", **entry)
    return parser


class Account:
    """`judge(run, known)` gives the largest violation of each kind, over the largest force or length of the run."""

    def __init__(self, options):
        self.options, self.batch, self.wrong = options, Batch(options.build / "conetact"), 0

    def one(self, scene, known, judge):
        """Increments, faults, what the program refused by."""
        with tempfile.TemporaryDirectory() as folder:
            file, out = Path(folder) / "scene.prm", Path(folder) / "out"
            write_scene(scene, file)
            done = self.batch.run(file, "-o", out, "--quiet")
            if done.returncode not in (0, 2):
                raise SystemExit(f"exit code {done.returncode}: {done.stderr}\n{file.read_text()}")
            run = Run(out)
        found = judge(run, known) if run.rows else {}
        bad = {what: error for what, error in found.items() if not error <= BOUND}
        return len(run.increments), bad, done.stderr.strip() if done.returncode else ""

    def family(self, name, scene_of, judge):
        """Draws scenes by `scene_of(chance)`, a scene and what is known of it; prints a line about all."""
        chance, wrong, refused, judged = random.Random(f"{name} {self.options.seed}"), 0, 0, 0
        for number in range(self.options.scenes):
            scene, known = scene_of(chance)
            increments, bad, refusal = self.one(scene, known, judge)
            judged, wrong, refused = judged + increments, wrong + bool(bad), refused + bool(refusal)
            if bad or refusal:
                print(f"  {name} {number}: {bad or ''} {refusal}")
            if (bad or refusal) and self.options.keep:
                self.options.keep.mkdir(exist_ok=True)
                write_scene(scene, self.options.keep / f"{name.replace(' ', '-')}-{self.options.seed}-{number}.prm")
        print(f"{name}: {self.options.scenes} scenes, {judged} increments judged, {wrong} scenes wrong, "
              f"{refused} without equilibrium or not converged", flush=True)
        self.wrong += wrong
