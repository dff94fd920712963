#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens all VTU and PVD files of a finished run as ParaView does.

usage: check_vtu.py FOLDER

Every VTU file is listed by a PVD file, holds its named arrays, none of them
empty or with a non-finite number, and the contact reactions of each increment
sum to those of reactions.csv.
"""
import csv
import math
import re
import sys
import xml.etree.ElementTree as xml
from collections import defaultdict
from pathlib import Path

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

ARRAYS = {"contact": ("reaction", "traction", "gap", "slip", "u", "state", "contact", "normal"),
          "solution": ("displacement", ".*stress", ".*mises")}
FRAME_ARRAYS = ("displacement", ".*force")  # bars and beams have no stress


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
            arrays[array.GetName()] = [array.GetTuple(k) for k in range(array.GetNumberOfTuples())]
    return grid, arrays


def check_file(file):
    grid, arrays = read_vtu(file)
    faults = [] if grid.GetNumberOfCells() > 0 else ["no cells"]
    for name, values in arrays.items():
        if not values:
            faults.append(f"array {name} is empty")
        if not all(math.isfinite(x) for value in values for x in value):
            faults.append(f"array {name} holds a non-finite number")
    def lacks(patterns):
        return [p for p in patterns if not any(re.fullmatch(p, n, re.I) for n in arrays)]
    kind = file.name.split("-")[0]
    missing = lacks(ARRAYS.get(kind, ()))
    if missing and not (kind == "solution" and not lacks(FRAME_ARRAYS)):
        faults.append(f"no array {missing} among {sorted(arrays)}")
    return [f"{file.name}: {fault}" for fault in faults], arrays


def listed_files(folder):
    names = []
    for pvd in sorted(folder.glob("*.pvd")):
        names += [entry.attrib["file"] for entry in xml.parse(pvd).iter("DataSet")]
    return names


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
            # VTU files are in single precision
            if not abs(total - expected[increment][i]) <= 1e-6 * size[increment]:
                faults.append(f"increment {increment}: reactions sum to {total}, not {expected[increment][i]}")
    return faults


def main(folder):
    faults, contacts = [], {}
    files = sorted(folder.glob("*.vtu"))
    listed = listed_files(folder)
    if sorted(listed) != [f.name for f in files]:
        faults.append(f"PVD files list {listed}")
    if not any(f.name.startswith("contact-") for f in files) or not any(f.name.startswith("solution-") for f in files):
        faults.append("there are no VTU files of bodies and contacts")
    for file in files:
        found, arrays = check_file(file)
        faults += found
        if file.name.startswith("contact-"):
            contacts[int(re.search(r"-(\d+)\.vtu", file.name)[1])] = arrays
    faults += check_sums(folder, contacts)
    print("\n".join(faults) or f"{len(files)} VTU files are well")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
