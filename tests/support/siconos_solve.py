#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solves local problems of FCLib with Siconos (Debian: python3-siconos).

usage: siconos_solve.py FILE.hdf5 [SOLVER [TOLERANCE]]

SOLVER is one of SOLVERS below. The problem is given to Siconos in balanced
units: largest entry of q 1, mean of the diagonal of W 1. Prints time and the
residual that the program uses, free of units; Siconos itself is not believed.
"""
import sys
import time

import h5py
import numpy as np
import siconos.numerics as siconos

SOLVERS = {3: ("NSN_AC", "NSN_FB", "NSN_NM", "NSGS", "ADMM"), 2: ("NSGS", "LEMKE")}


class Problem:
    """u = W r + q, contacts one after the other as (n, t1[, t2])."""

    def __init__(self, file):
        with h5py.File(file, "r") as h5:
            local = h5["fclib_local"]
            self.dim = int(local["spacedim"][()].item())
            self.mu = np.array(local["vectors/mu"], dtype=float).ravel()
            self.q = np.array(local["vectors/q"], dtype=float).ravel()
            n = self.q.size
            if int(local["W/nz"][()].item()) != -1 or local["W/x"].size != n * n:
                raise SystemExit("the matrix W is not full and by columns")
            self.W = np.array(local["W/x"], dtype=float).reshape(n, n).T.copy()
            self.r = np.array(h5["solution/r"], dtype=float).ravel() if "solution/r" in h5 else None
        self.length = np.abs(self.q).max()
        self.force = self.length * n / np.trace(self.W)

    def balanced(self):
        return self.W * (self.force / self.length), self.q / self.length

    def residual(self, r):
        """Natural map of Coulomb's law over the largest of its arguments."""
        shape = (-1, self.dim)
        u = self.W @ r + self.q
        rho = self.q.size / np.trace(self.W)
        u, r = u.reshape(shape), r.reshape(shape)
        scale = max(np.abs(r).max(), rho * np.abs(u).max())
        target = r - rho * u
        target[:, 0] -= rho * self.mu * np.linalg.norm(u[:, 1:], axis=1)
        return np.abs(r - project(target, self.mu)).max() / scale


def project(z, mu):
    """On the cones |z_t| <= mu z_n, rows (z_n, z_t)."""
    z = z.copy()
    n, t = z[:, 0], np.linalg.norm(z[:, 1:], axis=1)
    outside = t > mu * n
    polar = mu * t <= -n
    new = (n + mu * t) / (1 + mu**2)
    ratio = np.divide(mu * new, t, out=np.zeros_like(t), where=t > 0)
    z[outside, 0], z[outside, 1:] = new[outside], (ratio[:, None] * z[:, 1:])[outside]
    z[polar] = 0
    return z


def solve(problem, solver, tolerance, iterations=None):
    """Reactions, CPU seconds of the solve itself, what Siconos returned."""
    W, q = problem.balanced()
    contacts = siconos.FrictionContactProblem(problem.dim, problem.mu.size, W, q, problem.mu)
    name = f"SICONOS_FRICTION_{problem.dim}D_{solver}"
    options = siconos.SolverOptions(getattr(siconos, name))
    options.dparam[siconos.SICONOS_DPARAM_TOL] = tolerance
    if iterations:
        options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = iterations
    r, u = np.zeros(q.size), np.zeros(q.size)
    driver = siconos.fc3d_driver if problem.dim == 3 else siconos.fc2d_driver
    start = time.process_time()
    info = driver(contacts, r, u, options)
    return r * problem.force, time.process_time() - start, info


def main(file, solver=None, tolerance="1e-8"):
    problem = Problem(file)
    for name in [solver] if solver else SOLVERS[problem.dim]:
        r, seconds, info = solve(problem, name, float(tolerance))
        print(f"{name}: {seconds:.4g} s, returns {info}, residual {problem.residual(r):.2g}")
        if problem.r is not None:
            print(f"  from the stored solution {np.abs(r - problem.r).max() / np.abs(problem.r).max():.2g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
