#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws that results must obey, whatever the scene.

usage: tests/laws/run.py PROGRAM FAMILY...      (all: every family)

Each family, a function of the files beside this one, writes small scenes into a temporary
folder, runs them, and checks numbers of reactions.csv and increments.csv: against each
other (a rotated scene gives rotated reactions), or against closed forms. Every check prints
what was found and its bound. With CONETACT_KEEP=1 the folders stay.
"""
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])
from laws import (automatic, axisymmetric, backends, balance, bearings, bodies, bonds, corners, drawn, driven, driven_far, elements, ellipses, examples, far_ties, far_turns, friction, gmsh, grooves, held_joints, hertz, initial_strain, iterative, iterative_sliding, joints, kill, layers, limits, load_sums, loads, mortar, obstacles, orthotropic, pairs, passing, patch, path, pieces, preload, processes, quadratic, quadratic_round, refinement, restart, rolling, redundant, seals, kinematics, axisymmetric_sliding, mesh_kinds, meshes, rims, interrupt, jams, scene_pictures, couplings, swings, vees,  # noqa: E402
                  round_pairs, sliding, spins, spreading, stages,
                  supports, threads, tie, transformations, vanishing, uniqueness, varying_friction, worn)
from support.checks import run_families  # noqa: E402

FAMILIES = {"balance": balance.balance, "extrusion": transformations.extrusion, "rotation": transformations.rotation_family,
            "mirror": transformations.mirror, "units": transformations.units, "patch": patch.patch,
            "elements": elements.elements, "refinement": refinement.refinement, "obstacles": obstacles.obstacles,
            "shapes": driven.shapes, "free": driven.free_obstacles, "turning": driven.turning,
            "supports": supports.supports, "loads": loads.loads, "load-sums": load_sums.load_sums, "stages": stages.stages, "friction": friction.friction, "bodies": bodies.bodies,
            "corners": corners.corners, "pairs": pairs.pairs, "threads": threads.threads, "processes": processes.processes, "processes-more": processes.more, "processes-four": processes.four, "processes-seven": processes.seven, "pieces": pieces.pieces, "kill": kill.kill, "interrupt": interrupt.interrupt, "couplings": couplings.couplings,
            "hertz": hertz.hertz, "axisymmetric": axisymmetric.axisymmetric, "axisymmetric-sliding": axisymmetric_sliding.axisymmetric_sliding,
            "gmsh": gmsh.gmsh, "held-joints": held_joints.held_joints,
            "orthotropic": orthotropic.orthotropy, "path": path.path, "iterative": iterative.iterative,
            "iterative-pairs": iterative.iterative_pairs, "iterative-floating": iterative.iterative_floating,
            "iterative-frames": iterative.iterative_frames, "iterative-sliding": iterative_sliding.iterative_sliding, "restart": restart.restart,
            "backends": backends.backends, "backends-shared": backends.backends_shared, "sliding": sliding.sliding, "kinematics": kinematics.kinematics, "far-turns": far_turns.far_turns, "far-ties": far_ties.far_ties,
            "drawn": drawn.drawn_family, "driven-far": driven_far.driven_far, "passing": passing.passing, "rolling": rolling.rolling, "bearings": bearings.bearings, "round-plane": round_pairs.plane, "round-orders": round_pairs.orders_of_plane, "round-space": round_pairs.space,
            "mortar-plane": mortar.plane, "mortar-space": mortar.space, "mortar-triangles": mortar.triangles,
            "mortar-covered": mortar.covered,
            "mortar-held": mortar.held, "mortar-hertz": mortar.hertz, "mortar-rings": mortar.rings,
            "mortar-many": mortar.many, "mortar-apart": mortar.apart, "tie": tie.tie_family, "limits": limits.limits, "jams": jams.jams, "spins": spins.spins, "swings": swings.swings, "vees": vees.vees, "spreading": spreading.spreading,
            "redundant": redundant.redundant_family, "rims": rims.rims,
            "initial-strain": initial_strain.initial_strain, "preload": preload.preload, "vanishing": vanishing.vanishing,
            "examples-plane": examples.plane, "examples-space": examples.space, "energies": examples.energies,
            "meshes": meshes.meshes, "mesh-kinds": mesh_kinds.mesh_kinds, "adjusted": meshes.adjusted, "facets": meshes.facets,
            "quadratic": quadratic.quadratic, "quadratic-pairs": quadratic.pairs, "quadratic-orders": quadratic.converging,
            "quadratic-far": quadratic.far, "quadratic-tetrahedra": quadratic.tetrahedra, "quadratic-bent": quadratic.bent,
            "quadratic-one-by-one": quadratic.one_by_one, "quadratic-rings": quadratic_round.rings, "quadratic-pins": quadratic_round.pins, "quadratic-vees": quadratic_round.vees, "quadratic-units": quadratic_round.implicit_units,
            "quadratic-balls": quadratic_round.balls, "quadratic-sheared-balls": quadratic_round.sheared_balls, "automatic": automatic.automatic,
            "varying-friction": varying_friction.varying_friction, "ellipses": ellipses.ellipses, "layers": layers.layers, "bonds": bonds.bonds, "joints": joints.joints, "seals": seals.seals, "pictures": scene_pictures.pictures, "worn": worn.worn, "worn-half-planes": worn.half_planes, "worn-off": worn.worn_off, "worn-faster": worn.faster, "grooves": grooves.grooves,
            "uniqueness": uniqueness.uniqueness}

if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(run_families(FAMILIES, *sys.argv[1:]))
