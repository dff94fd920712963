#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens all VTU and PVD files of a finished run as ParaView does.

usage: check_vtu.py FOLDER

Every VTU file is listed by the collection of its kind, those of bodies by scene.pvd, holds its named
arrays in double precision, none of them empty or with a non-finite number (but of contact where nothing
may touch), shows the undeformed state at t = 0, and agrees with the tables: reactions sum to
those of reactions.csv, pressures, gaps and states of surfaces are those of its rows, the
largest displacement is that of history.csv. Stresses and strains obey Hooke's law, principal values
are eigenvalues.
"""
import csv
import math
import re
import sys
import xml.etree.ElementTree as xml
from collections import defaultdict
from pathlib import Path

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

ARRAYS = {"contact": ("reaction", "traction", "gap", "slip", "u", "state", "contact", "normal", "displacement",
                      "pressure", "body"),
          "surface": ("displacement", "contact_pressure", "contact_traction", "gap", "slip", "state", "boundary_id",
                      "body"),
          "solution": ("displacement", "stress", "strain", "von_mises", "principal_stresses", "principal_strains",
                       "material_id", "body", "contact_pressure", "contact_traction", "gap", "slip", "state")}
OF_CONTACT = defaultdict(tuple, surface=("gap",),
                         solution=("contact_pressure", "contact_traction", "gap", "slip", "wear"))
FRAME_ARRAYS = ("displacement", ".*force", "material_id", "body")  # bars and beams have no stress


def read_vtu(file):
    """Arrays of points and cells by name, as lists of tuples."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    arrays = {}
    for data in (grid.GetPointData(), grid.GetCellData()):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            if array.GetDataTypeAsString() not in ("double", "int"):
                raise SystemExit(f"{file.name}: {array.GetName()} is of type {array.GetDataTypeAsString()}")
            arrays[array.GetName()] = [array.GetTuple(k) for k in range(array.GetNumberOfTuples())]
    return grid, arrays


def check_file(file):
    grid, arrays = read_vtu(file)
    faults = [] if grid.GetNumberOfCells() > 0 else ["no cells"]
    for name, values in arrays.items():
        if not values:
            faults.append(f"array {name} is empty")
        finite = [math.isfinite(x) for value in values for x in value]
        may_be_none = name in OF_CONTACT[file.name.split("-")[0]]
        touched = [s[0] >= 0 for s in arrays.get("state", ()) for _ in values[0]]
        if not all(finite) and not (may_be_none and finite == touched):
            faults.append(f"array {name} holds a non-finite number")
    def lacks(patterns):
        return [p for p in patterns if not any(re.fullmatch(p, n, re.I) for n in arrays)]
    kind = file.name.split("-")[0]
    missing = lacks(ARRAYS.get(kind, ()))
    if missing and not (kind == "solution" and not lacks(FRAME_ARRAYS)):
        faults.append(f"no array {missing} among {sorted(arrays)}")
    return [f"{file.name}: {fault}" for fault in faults], arrays


def listed_files(folder, *collections):
    """Files and times of PVD files."""
    entries = {}
    for name in collections:
        pvd = folder / f"{name}.pvd"
        for entry in xml.parse(pvd).iter("DataSet") if pvd.exists() else ():
            entries[entry.attrib["file"]] = float(entry.attrib["timestep"])
    return entries


def table(folder, name):
    with open(folder / f"{name}.csv", newline="") as stream:
        return list(csv.DictReader(stream))


def check_strains(file, arrays):
    """Eigenvalues, and sigma = lambda tr(eps) I + 2 G eps without change of temperature, E and nu as found."""
    if "strain" not in arrays:
        return []
    stress, strain = (np.array(arrays[name]).reshape(-1, 3, 3) for name in ("stress", "strain"))
    faults = []
    for name, tensors in (("principal_stresses", stress), ("principal_strains", strain)):
        exact, found = np.linalg.eigvalsh(tensors)[:, ::-1], np.array(arrays[name])
        if not np.abs(exact - found).max() <= 1e-12 * max(np.abs(exact).max(), 1e-300):
            faults.append(f"{file.name}: {name} are no eigenvalues")
    deviator = [t - np.trace(t, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3) for t in (stress, strain)]
    if np.abs(strain).max() > 0:
        double_shear = (deviator[0] * deviator[1]).sum() / (deviator[1] ** 2).sum()
        if not np.abs(deviator[0] - double_shear * deviator[1]).max() <= 1e-10 * np.abs(stress).max():
            faults.append(f"{file.name}: stresses do not follow from strains")
        von_mises = np.sqrt(1.5 * (deviator[0] ** 2).sum(axis=(1, 2)))
        if not np.abs(von_mises - np.array(arrays["von_mises"])[:, 0]).max() <= 1e-12 * von_mises.max():
            faults.append(f"{file.name}: von Mises stresses are wrong")
    return faults


def check_surfaces(folder, surfaces):
    """Each row of reactions.csv is found at its place on the surface of a body."""
    faults = []
    for row in table(folder, "reactions"):
        here = surfaces.get(int(row["increment"]))
        if here is None:
            continue
        place = tuple(round(float(row[c]), 6) + 0.0 for c in "xyz")
        found = [(float(p), float(g), int(s)) for p, g, s in here.get(place, ())]
        wanted = (float(row["pressure"]), float(row["gap"]), ("open", "stick", "slip").index(row["state"]))
        size = max([abs(wanted[0]), *(abs(f[0]) for f in found)], default=0) + 1e-300
        if not any(abs(f[0] - wanted[0]) <= 1e-9 * size and abs(f[1] - wanted[1]) <= 1e-9 * (1 + abs(wanted[1]))
                   and f[2] == wanted[2] for f in found) and not row["contact"].endswith("_master"):
            faults.append(f"increment {row['increment']}, {row['contact']} at {place}: {wanted} is not on the surface: {found}")
    return faults[:3]


def check_extremes(folder, largest):
    """The largest displacement of the pictures is that of history.csv."""
    return [f"increment {row['increment']}: largest displacement {largest[int(row['increment'])]} in pictures, "
            f"{row['largest_displacement']} in history.csv" for row in table(folder, "history")
            if int(row["increment"]) in largest
            and not abs(largest[int(row["increment"])] - float(row["largest_displacement"]))
            <= 1e-12 * float(row["largest_displacement"])]


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def reaction(row):
    """Force on the body in global coordinates from a row of reactions.csv."""
    n = tuple(float(row["n_" + a]) for a in "xyz")
    t1 = cross((0, 1, 0), n) if abs(n[2]) > 0.9 else cross(n, (0, 0, 1))
    length = math.sqrt(sum(x * x for x in t1))
    t1 = tuple(x / length for x in t1)
    t2 = cross(n, t1)
    r = [float(row[c]) for c in ("r_n", "r_t1", "r_t2")]
    return tuple(r[0] * n[i] + r[1] * t1[i] + r[2] * t2[i] for i in range(3))


def check_sums(folder, contacts):
    expected = defaultdict(lambda: [0.0, 0.0, 0.0])
    size = defaultdict(float)
    with open(folder / "reactions.csv", newline="") as stream:
        for row in csv.DictReader(stream):
            for i, x in enumerate(reaction(row)):
                expected[int(row["increment"])][i] += x
                size[int(row["increment"])] += abs(x)
    faults = []
    for increment, arrays in contacts.items():
        for i in range(3):
            total = sum(r[i] for r in arrays.get("reaction", []))
            if not abs(total - expected[increment][i]) <= 1e-12 * size[increment]:
                faults.append(f"increment {increment}: reactions sum to {total}, not {expected[increment][i]}")
    return faults


def increment_of(file):
    return int(re.search(r"-(\d+)\.vtu", file.name)[1])


def is_still(arrays):
    return all(x == 0 or math.isnan(x) for name in ("displacement", "contact_pressure", "reaction", "stress", "axial_force")
               for value in arrays.get(name, ()) for x in value)


def main(folder):
    faults, contacts, surfaces, largest = [], {}, defaultdict(lambda: defaultdict(list)), defaultdict(float)
    files = sorted(folder.glob("*.vtu"))
    kinds = listed_files(folder, "solution", "surface", "contact", "mechanism")
    scene = listed_files(folder, "scene")
    names = [f.name for f in files]
    if sorted(kinds) != names or sorted(scene) != [n for n in names if n.startswith("solution")]:
        faults.append(f"PVD files list {sorted(kinds)} and {sorted(scene)}")
    times = {0: 0.0, **{int(row["increment"]): float(row["time"]) for row in table(folder, "increments")}}
    for kind in ("solution", "surface", "contact"):
        if not any(f.name.startswith(kind + "-") and increment_of(f) == 0 for f in files):
            faults.append(f"there is no {kind} file of t = 0")
    for file in files:
        found, arrays = check_file(file)
        faults += found
        increment = increment_of(file) if not file.name.startswith("mechanism") else None
        if increment == 0 and not is_still(arrays):
            faults.append(f"{file.name} shows no undeformed state")
        if increment is not None and not math.isclose(kinds.get(file.name, -1), times[increment], abs_tol=1e-300):
            faults.append(f"PVD files show {file.name} at {kinds.get(file.name)}, not {times[increment]}")
        if file.name.startswith("solution-"):
            faults += check_strains(file, arrays)
        if file.name.startswith(("solution-", "surface-")):
            largest[increment] = max(largest[increment], *(math.hypot(*u) for u in arrays["displacement"]))
        if file.name.startswith("contact-") and increment > 0:
            contacts[increment] = arrays
        if file.name.startswith("surface-"):
            grid, _ = read_vtu(file)
            for i in range(grid.GetNumberOfPoints()):
                place = tuple(round(x, 6) + 0.0 for x in grid.GetPoint(i))
                surfaces[increment][place].append(tuple(arrays[n][i][0] for n in ("contact_pressure", "gap", "state")))
    faults += check_sums(folder, contacts) + check_surfaces(folder, surfaces) + check_extremes(folder, largest)
    print("\n".join(faults) or f"{len(files)} VTU files are well")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
