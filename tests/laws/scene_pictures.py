# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What ParaView shows of scene.pvd: each solid once, with what contact does to it, in the units of the scene."""
import xml.etree.ElementTree as xml

import numpy as np

from support.scenes import beam, box, contact, floor, joint, load, merge, press_and_shear, simplices, support

FIELDS = ("contact_pressure", "contact_traction", "gap", "slip", "state")
STATES = ("open", "stick", "slip", "bonded", "wet")
UNITS = {"displacement": "mm", "gap": "mm", "slip": "mm", "wear": "mm", "u": "mm", "stress": "MPa", "von_mises": "MPa",
         "principal_stresses": "MPa", "contact_pressure": "MPa", "contact_traction": "MPa", "pressure": "MPa",
         "traction": "MPa", "reaction": "N", "axial_force": "N", "shear_force": "N", "moment": "N mm",
         "axial_stress": "MPa"}
WITHOUT_UNITS = {"strain", "principal_strains", "state", "normal", "contact", "body", "material_id", "boundary_id"}


def read(file):
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader
    reader = (vtkXMLPUnstructuredGridReader if file.suffix == ".pvtu" else vtkXMLUnstructuredGridReader)()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def arrays_of(grid):
    return [data.GetArray(i) for data in (grid.GetPointData(), grid.GetCellData())
            for i in range(data.GetNumberOfArrays())]


def field(grid, name):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def has_fields(grid):
    return all(grid.GetPointData().HasArray(name) for name in FIELDS)


def blocks_of(folder):
    """Of scene.pvd: time, name and grid of each block."""
    for entry in xml.parse(folder / "scene.pvd").iter("DataSet"):
        yield float(entry.attrib["timestep"]), entry.attrib["name"], read(folder / entry.attrib["file"])


def cells_of(grid, dim):
    """Places of the corners of all cells; only those of the dimension of the scene, or of frames."""
    found = set()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        if cell.GetCellDimension() not in (1, dim):
            return None
        found.add(frozenset(tuple(round(x, 9) for x in grid.GetPoint(cell.GetPointId(i)))
                            for i in range(cell.GetNumberOfPoints())))
    return found


def faces_of(grid, dim):
    """Nodes of the faces that belong to one cell."""
    seen = {}
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        for f in range(cell.GetNumberOfEdges() if dim == 2 else cell.GetNumberOfFaces()):
            face = cell.GetEdge(f) if dim == 2 else cell.GetFace(f)
            nodes = [face.GetPointId(i) for i in range(face.GetNumberOfPoints())]
            seen.setdefault(frozenset(nodes), []).append(nodes)
    return [same[0] for same in seen.values() if len(same) == 1]


def area(places):
    first = places[1] - places[0]
    if len(places) == 2:
        return np.linalg.norm(first)
    return np.linalg.norm(np.cross(first, places[-1] - places[0])) / (2 if len(places) == 3 else 1)


def force_on(grid, dim):
    """Integral of the traction over the faces all of whose nodes may touch: the contact of a convex body."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    places = vtk_to_numpy(grid.GetPoints().GetData())
    state, traction = field(grid, "state"), field(grid, "contact_traction")
    return sum(area(places[face]) * traction[face].mean(axis=0)
               for face in faces_of(grid, dim) if (state[face] >= 0).all())


def coincide(grids, dim):
    cells = [cells_of(grid, dim) for grid in grids]
    return None in cells or sum(map(len, cells)) != len(set().union(*cells))


def largest(rows):
    return max(abs(row["pressure"]) for row in rows)


def check_rows(laws, what, grid, rows):
    """A point of the solid is a row of reactions.csv, or it is not touched."""
    state = field(grid, "state")
    here = {tuple(round(x, 6) + 0.0 for x in grid.GetPoint(i)): i for i in np.flatnonzero(state >= 0)}
    points = [here[tuple(round(row[c], 6) + 0.0 for c in "xyz")] for row in rows]
    for name, column in (("contact_pressure", "pressure"), ("gap", "gap")):
        exact = np.array([row[column] for row in rows])
        laws.check(f"{what}: {name} of the rows", np.abs(field(grid, name)[points] - exact).max() / largest(rows), 1e-9)
    laws.demand("  their states", len(here) == len(rows) == len(set(points))
                and [STATES[state[i]] for i in points] == [row["state"] for row in rows])
    bare = [np.isnan(field(grid, name).reshape(len(state), -1)).all(axis=1) for name in FIELDS[:-1]]
    laws.demand("  nothing elsewhere", all((none == (state == -1)).all() for none in bare))


def solids(laws):
    """Blocks pressed and sheared: the picture's pressure makes the force of increments.csv."""
    for dim in (2, 3):
        for kind, cells in (("boxes", None), ("simplices", simplices)):
            scene = merge(press_and_shear(dim, increments=2), {"Output": {"VTU": 1, "Units": "N, mm, s, K"}})
            if cells:
                scene["Body block"] = cells(scene["Body block"])
            run, what = laws.run(scene), f"{dim}D, {kind}"
            blocks = list(blocks_of(run.folder))
            laws.demand(f"{what}: one block a time", [b[:2] for b in blocks] == [(t, "body block") for t in (0, 1, 2)])
            laws.demand("  fields at each", all(has_fields(grid) for _, _, grid in blocks))
            first = blocks[0][2]
            laws.demand("  nothing presses at t = 0",
                        set(field(first, "contact_pressure")[field(first, "state") >= 0]) == {0})
            last, grid = run.increments[-1], blocks[-1][2]
            exact = np.array([last[f"bottom_f_{c}"] if f"bottom_f_{c}" in last else 0.0 for c in "xyz"])
            found = force_on(grid, dim)
            laws.check("  integral of the traction", np.abs(found - exact).max() / np.abs(exact).max(), 1e-9)
            check_rows(laws, what, grid, run.last())
            laws.demand("  the units of all", units_are_told(run.folder))


def second_degree(laws):
    """A plate of one layer under 7 MPa: contacts stand at corners of six-node faces, and all nodes of the faces show them."""
    body = simplices(box((3, 3, 1), (1.5, 1.0, .5), poisson=0.0))
    scene = {"Dimension": 3, "Body block": merge(body, {"Element": "P2"}), "Obstacle floor": floor(3),
             "Obstacle ceiling": {"Shape": "half space", "Normal": (0, 0, -1), "Point": (0, 0, .5)},
             "Contact bottom": contact(ids=4, mu=.3), "Contact top": contact(ids=5, obstacle="ceiling"),
             "Load top": load("pressure", 7, 5), "Output": {"VTU": 1}}
    run = laws.run(scene)
    for kind in ("solution", "surface"):
        grid = read(run.folder / f"{kind}-block-0001.vtu")
        z = np.array([grid.GetPoint(i)[2] for i in range(grid.GetNumberOfPoints())])
        pressure, state = field(grid, "contact_pressure"), field(grid, "state")
        laws.check(f"{kind}: at all {(z == 0).sum()} nodes of the foot", np.abs(pressure[z == 0] / 7 - 1).max(), 1e-9)
        laws.demand(f"{kind}: all stick", set(state[z == 0]) == {1} and len({row['node'] for row in run.last()}) < (z == 0).sum())
        laws.demand(f"{kind}: none between both contacts", set(state[(z > 0) & (z < .5)]) == {-1} and set(state[z == .5]) == {0})


def several(laws):
    """A stack of two blocks and a beam: three blocks that are nowhere the same."""
    upper = box((4, 2), (2.0, 1.0), (0.0, 1.0))
    scene = {"Dimension": 2, "Body lower": box((6, 2), (2.0, 1.0)), "Body upper": upper,
             "Body rod": beam((3.0, 1.0), (3.0, 0.0), 2, 1e3, .1), "Obstacle floor": floor(2),
             "Contact bottom": contact("lower", mu=.3), "Contact joint": joint("upper", 2, "lower", 3),
             "Contact foot": contact("rod", 2, mu=.3),
             "Support top": support(3, "x, y", "0 ; -0.01*t", "upper"), "Support side": support(0, "x", body="lower"),
             "Support head": support(1, "x, y, rz", "0 ; -0.001*t ; 0", "rod"), "Output": {"Units": "N, mm"}}
    run = laws.run(scene)
    for time in (0, 1):
        grids = {name: grid for t, name, grid in blocks_of(run.folder) if t == time}
        laws.demand(f"t = {time}: solids and frames", sorted(grids) == ["body lower", "body rod", "body upper"])
        laws.demand("  none lies on another", not coincide(list(grids.values()), 2))
        laws.demand("  fields on all", all(map(has_fields, grids.values())))
    laws.demand("the foot of the rod stands", sorted(set(field(grids["body rod"], "state"))) == [-1, 1])
    found, exact = force_on(grids["body upper"], 2)[1], run.increments[-1]["joint_f_y"]
    laws.check("  pressure in the joint", abs(found / exact - 1), 1e-9)
    laws.demand("  the units of all", units_are_told(run.folder))


def worn(laws):
    """Archard: h = k p s, on the solid, too."""
    scene = {"Dimension": 2, "Body block": box((4, 2), (2.0, 1.0), poisson=0.0), "Obstacle floor": floor(2),
             "Contact bottom": contact(mu=0, **{"Wear coefficient": 1e-3}),
             "Load top": load("pressure", 7, 3), "Support sides": support("0, 1", "x", "0.1*t"),
             "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 2, "Units": "kN, m"}}
    run = laws.run(scene)
    grid = read(run.folder / "solution-block-0002.vtu")
    touched = field(grid, "state") >= 0
    laws.check("wear", np.abs(field(grid, "wear")[touched] / (1e-3 * 7 * .2) - 1).max(), 1e-9)
    laws.check("slip of the increment", np.abs(field(grid, "slip")[touched] - [.1, 0, 0]).max(), 1e-9)
    laws.demand("none elsewhere", np.isnan(field(grid, "wear")[~touched]).all())
    laws.demand("kN and m", [label(grid.GetPointData().GetArray("von_mises")), label(grid.GetPoints().GetData())]
                == ["kPa", "m"])


def label(array):
    from vtkmodules.vtkCommonCore import vtkDataArray
    return array.GetInformation().Get(vtkDataArray.UNITS_LABEL())


def units_are_told(folder):
    """By VTK's own key, of all arrays that have one, in all files; N, mm."""
    for file in folder.glob("*.vtu"):
        grid = read(file)
        if not grid.GetFieldData().GetAbstractArray("units").GetValue(0).startswith("N, mm"):
            return False
        if {a.GetName(): label(a) for a in arrays_of(grid)} != {
                a.GetName(): None if a.GetName() in WITHOUT_UNITS else UNITS[a.GetName()] for a in arrays_of(grid)}:
            return False
    return True


def without_units(laws):
    """A scene that does not name them has none, and the same numbers."""
    scene = press_and_shear(2, (4, 2), increments=1)
    named, plain = (laws.run(merge(scene, {"Output": {"VTU": 1, "Units": units}})) for units in ("N, mm", ""))
    files = sorted(f.name for f in plain.folder.glob("*.vtu"))

    def numbers(run, name):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        return {a.GetName(): vtk_to_numpy(a).tobytes() for a in arrays_of(read(run.folder / name))}
    laws.demand("nothing but labels differs", all(numbers(named, f) == numbers(plain, f) for f in files))
    laws.demand("no labels", all(label(a) is None for f in files for a in arrays_of(read(plain.folder / f))))


def pictures(laws):
    solids(laws)
    second_degree(laws)
    several(laws)
    worn(laws)
    without_units(laws)
