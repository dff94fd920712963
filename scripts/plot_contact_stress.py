#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a finished run in two dimensions: the deformed body and its contact stresses.

usage: plot_contact_stress.py FOLDER PICTURE.png [--increment N] [--amplify 10] [--mu 0.5]

Left: the deformed body, coloured by von Mises' stress, on its obstacle.
Right: normal contact stress and tangential one over the friction coefficient
along the contact, which coincide where the body is about to slip.
Needs python3-vtk9 and python3-matplotlib.
"""
import argparse
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def read_vtu(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
    return vtk_to_numpy(grid.GetPoints().GetData()), cells, arrays


def last_increment(folder):
    numbers = [int(re.search(r"-(\d+)\.vtu$", f.name)[1]) for f in folder.glob("contact-*.vtu")]
    if not numbers:
        raise SystemExit(f"{folder} holds no contact-*.vtu: run the scene with VTU output.")
    return max(numbers)


def draw_body(axes, folder, increment, amplify):
    for file in sorted(folder.glob(f"solution-*-{increment:04}.vtu")):
        points, cells, arrays = read_vtu(file)
        mises = next(a for name, a in arrays.items() if "mises" in name.lower())
        x = points + amplify * arrays["displacement"]
        triangles = np.vstack((cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]))
        colours = axes.tripcolor(x[:, 0], x[:, 1], triangles, mises, shading="gouraud", cmap="viridis")
        plt.colorbar(colours, ax=axes, label="von Mises stress", fraction=0.046)


def draw_obstacle(axes, points, arrays, amplify):
    # With amplified displacements the initial gaps are amplified too.
    normal = arrays["normal"]
    gap = arrays["gap"] - np.sum(arrays["u"] * normal, axis=1)
    surface = points - amplify * gap[:, None] * normal
    axes.plot(surface[:, 0], surface[:, 1], color="black", linewidth=1.5)


def draw_stresses(axes, x, arrays, mu):
    n = arrays["normal"]
    t = np.column_stack((n[:, 1], -n[:, 0], n[:, 2]))
    sigma_n = np.sum(arrays["traction"] * n, axis=1)
    sigma_t = np.sum(arrays["traction"] * t, axis=1)
    axes.axhline(0, color="grey", linewidth=0.8)
    axes.plot(x, sigma_n, "s-", markersize=3.5, label=r"$r_n$")
    axes.plot(x, sigma_t / mu, "^-", markersize=3.5, label=r"$r_t/\mu$")
    for state, name, marker in ((0, "open", "o"), (1, "stick", "s"), (2, "slip", "D")):
        here = np.round(arrays["state"]) == state
        axes.plot(x[here], np.full(np.sum(here), 0.03), marker, markersize=3, color=f"C{state + 3}", label=name,
                  transform=axes.get_xaxis_transform())
    axes.set_xlabel("x along the contact")
    axes.set_ylabel("contact stress")
    axes.legend(frameon=False)


def friction_coefficient(folder):
    try:
        text = (folder / "used.prm").read_text()
        return float(re.search(r"set Friction coefficient\s*=\s*([-+.\deE]+)\s*(#.*)?$", text, re.M)[1])
    except (OSError, TypeError):
        raise SystemExit("used.prm names no constant friction coefficient: give it by --mu.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--increment", type=int, help="default: the last one")
    parser.add_argument("--amplify", type=float, default=10, help="displacements are drawn so many times larger")
    parser.add_argument("--mu", type=float, help="friction coefficient; default: that of used.prm")
    args = parser.parse_args()

    increment = args.increment or last_increment(args.folder)
    mu = args.mu or friction_coefficient(args.folder)
    points, _, arrays = read_vtu(args.folder / f"contact-{increment:04}.vtu")
    order = np.argsort(points[:, 0])
    points, arrays = points[order], {name: a[order] for name, a in arrays.items()}

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    draw_body(left, args.folder, increment, args.amplify)
    draw_obstacle(left, points, arrays, args.amplify)
    left.set_aspect("equal")
    left.set_title(f"Deformed body (displacements x {args.amplify:g})")
    draw_stresses(right, points[:, 0], arrays, mu)
    right.set_title(f"Contact stresses, increment {increment}")
    figure.savefig(args.picture, dpi=130)


if __name__ == "__main__":
    main()
