# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of large bodies that processes write in pieces show what one process draws."""
import subprocess

import numpy as np

from laws.processes import ITERATIVE
from laws.scene_pictures import arrays_of, label, read
from support.scenes import box, load, merge, press_and_shear, write_scene


def drawn(file):
    """Fields of points by where they are, and the centres of cells with theirs, as VTK reads them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    grid = read(file)
    places = vtk_to_numpy(grid.GetPoints().GetData())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)

    def table(where, data):
        """Once where pieces meet. Nothing touches where `state` says so, there are no numbers then."""
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        fields = np.column_stack([where.round(9) + 0.0] + [np.nan_to_num(vtk_to_numpy(a).reshape(len(where), -1)) for a in arrays])
        _, first = np.unique(fields[:, :3], axis=0, return_index=True)
        return [a.GetName() for a in arrays], fields[first]
    return table(places, grid.GetPointData()), table(places[corners].mean(axis=1), grid.GetCellData())


def units_of(file):
    return {array.GetName(): label(array) for array in arrays_of(read(file))}


def difference(a, b):
    """The largest one of all fields, over their sizes."""
    (names, one), (others, two) = a, b
    if names != others or one.shape != two.shape:
        return 1.0
    return (abs(one - two).max(axis=0) / np.maximum(abs(one).max(axis=0), 1e-3 * abs(one).max())).max()


def pieces(laws):
    hot = merge(box((260, 240), (2.0, 1.0)), {"Material": {"Expansion coefficient": 1e-4}})
    scene = merge(press_and_shear(2, increments=2), {
        "Body block": hot, "Load warmth": load("temperature", "3*x*t"), "Output": {"VTU": 2, "Units": "N, mm"}})
    one = laws.run(scene, *ITERATIVE)
    for n in (2, 3):
        many = laws.run(scene, *ITERATIVE, "--processes", str(n))
        parts = [f"solution-block-000{k}{end}" for k in (0, 2) for end in (*(f".{p}.vtu" for p in range(n)), ".pvtu")]
        laws.demand(f"{n} pieces and what joins them", sorted(f.name for f in many.folder.glob("solution-*-*")) == parts)
        for increment in (0, 2):
            stem = f"solution-block-000{increment}"
            points, cells = (difference(a, b) for a, b in zip(drawn(one.folder / f"{stem}.vtu"),
                                                              drawn(many.folder / f"{stem}.pvtu")))
            laws.check(f"increment {increment}: fields of points", points, 1e-8)
            laws.check("and of cells", cells, 1e-14)
            laws.demand("and units", units_of(one.folder / f"{stem}.vtu") == units_of(many.folder / f"{stem}.pvtu"))
        listed = (many.folder / "scene.pvd").read_text()
        laws.demand("scene.pvd names what joins them", f'file="{stem}.pvtu"' in listed and ".0.vtu" not in listed)
    small, large = laws.folder / "small.prm", laws.folder / "large.prm"
    write_scene(merge(scene, {"Body block": {"Mesh": box((12, 6), (2.0, 1.0))["Mesh"]}}), small)
    write_scene(scene, large)

    def again(*arguments):
        return subprocess.run([laws.program, *arguments, *ITERATIVE, "-o", many.folder, "--quiet"], capture_output=True, text=True, timeout=300)
    again(small)
    laws.demand("a later run removes them", sorted(f.name for f in many.folder.glob("solution-*-*"))
                == ["solution-block-0000.vtu", "solution-block-0002.vtu"])
    (many.folder / "solution-block-0002.1.vtu" / "mine").mkdir(parents=True)
    done = again(large, "--processes", "2")
    told = [line for line in done.stderr.splitlines() if line.startswith("conetact: ")]
    laws.demand(f"a piece that cannot be written: exit code {done.returncode}, {told}",
                done.returncode == 3 and len(told) == 1 and "0002.1.vtu" in told[0])
    laws.demand("nothing joins the others", not (many.folder / "solution-block-0002.pvtu").exists())
