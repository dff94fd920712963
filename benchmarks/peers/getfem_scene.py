#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two scenes of the program in GetFEM (Debian: python3-getfem).

usage: getfem_scene.py inclined-obstacle | block-press-shear N

Nodal contact, augmented Lagrangian version 1 with r = 0.1 E h, the exact Coulomb
cone (gamma = -1: slips count from the last increment), Newton with MUMPS. Prints
the contact forces on the body, a line for each increment.
"""
import sys

import getfem as gf
import numpy as np

SCENES = {
    # per side: elements, length, E, nu, mu, normal, gap(x), increments, displacement of the top
    "inclined-obstacle": (2, 50, 80.0, 5.0, 0.4, 0.5, (-1.0, 80.0), lambda x: (80 - x[0]) / 80, 23,
                          lambda t: (-0.05 * max(t - 1, 0), -0.7 * min(t, 1))),
    "block-press-shear": (3, 16, 1.0, 1.0, 0.3, 0.3, (0.0, 0.0, 1.0), lambda x: 0 * x[0], 11,
                          lambda t: (0.002 * max(t - 1, 0), 0.0, -0.01 * min(t, 1))),
}


def faces(mesh, height):
    """All faces at this height along the last axis."""
    nodes = np.nonzero(np.abs(mesh.pts()[-1] - height) < 1e-9)[0]
    return mesh.faces_from_pid(nodes)


def contact_matrices(points, dofs, n_dofs, normal):
    """Rows -n and tangents of each contact node, t1 = n x e_z or e_y x n."""
    dim = len(normal)
    n = np.array(normal) / np.linalg.norm(normal)
    tangents = [np.array((n[1], -n[0]))] if dim == 2 else [np.array((1.0, 0, 0)), np.array((0, 1.0, 0))]
    BN = gf.Spmat("empty", len(dofs), n_dofs)
    BT = gf.Spmat("empty", len(dofs) * (dim - 1), n_dofs)
    for i, first in enumerate(dofs):
        for d in range(dim):
            BN.add(i, first + d, -n[d])
            for k, t in enumerate(tangents):
                BT.add(i * (dim - 1) + k, first + d, t[d])
    return BN, BT


def model(scene, n=None):
    dim, cells, length, E, nu, mu, normal, gap, increments, motion = SCENES[scene]
    cells = n or cells
    grid = np.linspace(0, length, cells + 1)
    mesh = gf.Mesh("cartesian", *[grid] * dim)
    mesh.set_region(1, faces(mesh, 0))
    mesh.set_region(2, faces(mesh, length))
    mfu = gf.MeshFem(mesh, dim)
    mfu.set_fem(gf.Fem(f"FEM_QK({dim}, 1)"))
    mim = gf.MeshIm(mesh, gf.Integ(f"IM_GAUSS_PARALLELEPIPED({dim}, 3)"))

    md = gf.Model("real")
    md.add_fem_variable("u", mfu)
    md.add_initialized_data("lambda", [E * nu / ((1 + nu) * (1 - 2 * nu))])
    md.add_initialized_data("mu", [E / (2 * (1 + nu))])
    md.add_isotropic_linearized_elasticity_brick(mim, "u", "lambda", "mu")
    md.add_initialized_fem_data("top", mfu, np.zeros(mfu.nbdof()))
    md.add_Dirichlet_condition_with_simplification("u", 2, "top")

    dofs = np.sort(mfu.basic_dof_on_region(1))[::dim]
    points = mfu.basic_dof_nodes()[:, dofs]
    BN, BT = contact_matrices(points, dofs, mfu.nbdof(), normal)
    md.add_variable("r_n", len(dofs))
    md.add_variable("r_t", len(dofs) * (dim - 1))
    md.add_initialized_data("r", [0.1 * E * length / cells])
    md.add_initialized_data("friction", [mu])
    md.add_initialized_data("gap", gap(points))
    md.add_initialized_data("alpha", np.ones(len(dofs)))
    md.add_initialized_data("gamma", [-1.0])
    md.add_initialized_data("start", np.zeros(mfu.nbdof()))
    md.add_basic_contact_brick("u", "r_n", "r_t", "r", BN, BT, "friction", "gap", "alpha", 1, "gamma", "start")
    return md, mfu, BN, BT, increments, motion, dim


def run(md, mfu, BN, BT, increments, motion, dim):
    for k in range(1, increments + 1):
        md.set_variable("top", np.tile(motion(k), mfu.nbdof() // dim))
        md.set_variable("start", md.variable("u"))
        steps = md.solve("max_res", 1e-10, "max_iter", 200, "lsolver", "mumps")[0]
        force = -(BN.tmult(md.variable("r_n")) + BT.tmult(md.variable("r_t")))
        print(k, *(-force[d::dim].sum() for d in range(dim)), steps, flush=True)


if __name__ == "__main__":
    run(*model(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else None))
