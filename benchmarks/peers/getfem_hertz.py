#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz contact of support/half_space.py on equal cells in GetFEM (Debian: python3-getfem).

usage: getfem_hertz.py N      (N cells a half width, 4 N along each edge)

Nodal contact without friction, augmented Lagrangian with r = 0.1 E h, Newton with MUMPS; planes of
symmetry by a penalty of 1e8 E/L. Prints the contact force of the quarter.
"""
import sys
from pathlib import Path

import getfem as gf
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from getfem_scene import contact_matrices, faces  # noqa: E402
from peer_meshes import HERTZ, far_motion, is_candidate  # noqa: E402


def side(mesh, axis, place):
    return mesh.faces_from_pid(np.nonzero(np.abs(mesh.pts()[axis] - place) < 1e-9)[0])


def force(n):
    grid = np.linspace(0, HERTZ.size, HERTZ.size * n + 1)
    mesh = gf.Mesh("cartesian", grid, grid, grid)
    mesh.set_region(1, faces(mesh, 0))
    mesh.set_region(2, np.hstack([side(mesh, axis, HERTZ.size) for axis in range(3)]))
    for axis in range(2):
        mesh.set_region(3 + axis, side(mesh, axis, 0))
    mfu = gf.MeshFem(mesh, 3)
    mfu.set_fem(gf.Fem("FEM_QK(3, 1)"))
    mim = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3, 3)"))
    md = gf.Model("real")
    md.add_fem_variable("u", mfu)
    md.add_initialized_data("lambda", [HERTZ.poisson / ((1 + HERTZ.poisson) * (1 - 2 * HERTZ.poisson))])
    md.add_initialized_data("mu", [.5 / (1 + HERTZ.poisson)])
    md.add_isotropic_linearized_elasticity_brick(mim, "u", "lambda", "mu")
    places = mfu.basic_dof_nodes()
    far = np.array([far_motion(place)[i % 3] if max(place) > HERTZ.size - 1e-9 else 0. for i, place in enumerate(places.T)])
    md.add_initialized_fem_data("far", mfu, far)
    md.add_Dirichlet_condition_with_simplification("u", 2, "far")
    for axis in range(2):
        md.add_linear_term(mim, f"1e8*u({axis + 1})*Test_u({axis + 1})", 3 + axis)

    dofs = np.sort(mfu.basic_dof_on_region(1))[::3]
    dofs = np.array([dof for dof in dofs if is_candidate(places[:, dof])])
    BN, _ = contact_matrices(places[:, dofs], dofs, mfu.nbdof(), (0.0, 0.0, 1.0))
    md.add_variable("r_n", len(dofs))
    md.add_initialized_data("r", [.1 / n])
    md.add_initialized_data("gap", (places[0, dofs]**2 + places[1, dofs]**2) / (2 * HERTZ.radius))
    md.add_initialized_data("alpha", np.ones(len(dofs)))
    md.add_basic_contact_brick("u", "r_n", "r", BN, "gap", "alpha", 1)
    md.solve("max_res", 1e-10, "max_iter", 200, "lsolver", "mumps")
    return BN.tmult(md.variable("r_n"))[2::3].sum()


if __name__ == "__main__":
    print(abs(force(int(sys.argv[1]))))
