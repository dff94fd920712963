# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs scenes and keeps the account of what is checked."""
import math
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from support.batch import Batch
from support.scenes import write_scene
from support.tables import MOTION, REACTION, STEP, Run, in_space
from support.vectors import IDENTITY, apply, dot, scaled


def faces(row):
    """Whether it faces something, so that it has a gap."""
    return row["gap"] == row["gap"]


class Laws:
    """Runs scenes and keeps the account of the checks of one family."""

    def __init__(self, program):
        self.program = Path(program).resolve()
        self.folder = Path(tempfile.mkdtemp(prefix="conetact-laws-"))
        self.batch = Batch(self.program, cwd=self.folder)
        self.failed = 0
        self.n_runs = 0

    def check(self, what, found, bound):
        good = found <= bound  # so that nan fails
        print(f"  {'' if good else 'FAILED: '}{what}: {found:.3g} (bound {bound:g})")
        self.failed += not good

    def demand(self, what, holds):
        print(f"  {'' if holds else 'FAILED: '}{what}")
        self.failed += not holds

    def start(self, scene, *arguments, **options):
        """Runs the program; `scene` is a tree or a file. With options of its own it is a process of its own."""
        self.n_runs += 1
        file = self.folder / f"{self.n_runs}.prm"
        if isinstance(scene, Path):
            file = scene
        else:
            write_scene(scene, file)
        folder = self.folder / str(self.n_runs)
        words = [file, "-o", folder, "--quiet", *arguments]
        if options:
            return subprocess.run([self.program, *words], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, **options), folder
        return self.batch.run(*words), folder

    def run(self, scene, *arguments, bounds=True):
        done, folder = self.start(scene, *arguments)
        if done.returncode != 0:
            raise RuntimeError(f"exit code {done.returncode}: {done.stderr}")
        run = Run(folder)
        worst = max(max(row["residual"], row["equilibrium"], row["balance"]) for row in run.increments)
        if bounds and not worst <= 1e-10:
            self.check("residual, equilibrium, balance", worst, 1e-10)
        return run

    def same(self, what, a, b, bound=1e-10, matrix=IDENTITY, forces=1.0, lengths=1.0, order=None, states=True):
        """Reactions, slips and displacements of b are those of a, turned (or mirrored) and scaled."""
        turned = (lambda p: scaled(lengths, apply(matrix, p))) if order is None else order
        first, second = a.at(turned), b.at()
        if first.keys() != second.keys():
            self.demand(f"{what}: the same nodes", False)
            return
        worst = {}
        for kind, columns, scale in (("reactions", REACTION, forces), ("displacements", MOTION, lengths),
                                     ("slips", STEP, lengths)):
            size = scale * max(a.largest(*(REACTION if kind == "reactions" else MOTION)), 1e-300)
            worst[kind] = max(math.dist(apply(matrix, scaled(scale, in_space(row, a.dim, columns))),
                                        in_space(second[key], b.dim, columns))
                              for key, row in first.items()) / size
        size = max(lengths * a.largest("u_n", "u_t1", "gap"), 1e-300)
        worst["gaps"] = max(abs(lengths * row["gap"] - second[key]["gap"]) if faces(row) == faces(second[key]) == 1 else
                            size * (faces(row) != faces(second[key])) for key, row in first.items()) / size
        self.check(f"{what}: " + ", ".join(f"{k} {v:.2g}" for k, v in worst.items()), max(worst.values()), bound)
        if states:
            other = [key for key, row in first.items() if row["state"] != second[key]["state"]]
            if other:
                self.demand(f"{what}: states differ at {len(other)} of {len(first)} rows, first {other[0]}", False)

    def admissible(self, what, run, mu=None):
        """Nothing pulls, nothing penetrates, cones hold; mu(row) where it is known."""
        force, length = run.largest("r_n"), run.largest(*MOTION)
        self.check(f"{what}: pull", max(-row["r_n"] for row in run.rows) / force, 0)
        self.check(f"{what}: penetration", max(-row["gap"] for row in run.rows if faces(row)) / length, 1e-10)
        self.check(f"{what}: gap times reaction",
                   max(abs(row["gap"] * row["r_n"]) for row in run.rows if faces(row)) / (force * length), 1e-10)
        if mu is None:
            return
        outside = slack = across = 0.0
        for row in run.rows:
            r, du = (row["r_t1"], row["r_t2"]), (row["du_t1"], row["du_t2"])
            limit = mu(row) * row["r_n"]
            outside = max(outside, math.hypot(*r) - limit)
            if row["state"] == "slip":
                slack = max(slack, abs(math.hypot(*r) - limit))
                across = max(across, abs(r[0] * du[1] - r[1] * du[0]), dot(r, du))
        self.check(f"{what}: outside the cone", outside / force, 1e-10)
        self.check(f"{what}: slip inside the cone", slack / force, 1e-9)
        self.check(f"{what}: slip not against friction", across / (force * length), 1e-10)


def orders(sizes, errors):
    """Observed between the two finest meshes, one for each column of errors."""
    return [math.log(a / b) / math.log(sizes[-1] / sizes[-2]) for a, b in zip(errors[-2], errors[-1])]


def run_families(families, program, *names):
    """Exit code; `all` names every family."""
    if "all" in names:
        names = families
    failed = 0
    for name in names:
        print(name)
        begin = time.monotonic()
        laws = Laws(program)
        try:
            families[name](laws)
        except RuntimeError as error:
            laws.demand(str(error).strip(), False)
        laws.batch.close()
        failed += laws.failed
        print(f"  {laws.n_runs} runs, {time.monotonic() - begin:.1f} s, {laws.failed} failed")
        if not os.environ.get("CONETACT_KEEP"):
            shutil.rmtree(laws.folder)
        else:
            print(f"  kept: {laws.folder}")
    return 1 if failed else 0
