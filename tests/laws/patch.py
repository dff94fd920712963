# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A uniform pressure goes through any mesh."""
import itertools
import math

from support.meshes import distorted, tributary
from support.scenes import ELEMENTS, box, contact, floor, load, merge, support
from support.vectors import plus, scaled


def patch_scene(dim, body, ids, plane="strain", poisson=.3):
    """Uniform pressure on the top of a unit block on a frictionless floor; ids: left, (front,) bottom, top."""
    pressure, young = 7.0, 1000.0
    scene = {"Dimension": dim, "Body block": body, "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=ids[-2]),
             "Support left": support(ids[0], "x"),
             "Load top": load("pressure", pressure, ids[-1]),
             "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support front"] = support(ids[1], "y")
    ratio = poisson * (1 + poisson) if dim == 2 and plane == "strain" else poisson
    return scene, pressure, ratio * pressure / young


def corners_below(folder):
    """Places of the corners of all faces of hexahedra at z = 0, to the seven digits of a VTU file."""
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "solution-block-0001.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        for f in range(cell.GetNumberOfFaces()):
            face = cell.GetFace(f)
            places = [grid.GetPoint(face.GetPointId(k)) for k in range(4)]
            if all(abs(p[2]) < 1e-6 for p in places):
                yield places


def areas_of(run):
    """Areas of the contact nodes at the bottom: what hangs between two nodes belongs to both by half."""
    places = [(row["x"], row["y"], row["z"]) for row in run.last()]
    if run.dim == 2:
        x = sorted(p[0] for p in places)
        share = {c: (x[min(i + 1, len(x) - 1)] - x[max(i - 1, 0)]) / 2 for i, c in enumerate(x)}
        return lambda row: share[row["x"]]
    nodes = {tuple(round(c, 5) + 0.0 for c in p): i for i, p in enumerate(places)}

    def node(p):
        return nodes.get(tuple(round(c, 5) + 0.0 for c in p))
    faces = list(corners_below(run.folder))
    edges = [(node(a), node(b)) for face in faces for a, b in zip(face, face[1:] + face[:1])]
    halves = {tuple(round(c, 4) + 0.0 for c in scaled(.5, plus(places[a], places[b]))): (a, b)
              for a, b in edges if None not in (a, b)}
    points, owners, quads = [], [], []
    for face in faces:
        for p in face:
            own = node(p)
            pair = (own, own) if own is not None else halves[tuple(round(c, 4) + 0.0 for c in p)]
            owners.append(pair)
            points.append(scaled(.5, plus(places[pair[0]], places[pair[1]])))
        quads.append(range(len(points) - 4, len(points)))
    areas = dict.fromkeys(places, 0.0)
    for i, area in tributary(points, quads).items():
        for owner in owners[i]:
            areas[places[owner]] += area / 2
    return lambda row: areas[row["x"], row["y"], row["z"]]


def patch(laws):
    def check(what, scene, pressure, strain, areas=None):
        run = laws.run(merge(scene, {"Output": {"VTU": 1}}))
        areas = areas or areas_of(run)
        worst = max(abs(row["r_n"] / areas(row) - pressure) for row in run.rows) / pressure
        laws.check(f"{what}: reaction over tributary area", worst, 1e-12)
        slide = max(math.dist(scaled(strain, (row["x"], row["y"] if run.dim == 3 else 0)),
                              (row["u_t1"], row["u_t2"])) for row in run.rows)
        laws.check(f"{what}: displacement", slide / strain, 1e-12)
        laws.check(f"{what}: friction and gap", max(abs(row["r_t1"]) + abs(row["r_t2"]) + abs(row["gap"])
                                                    for row in run.rows), 1e-12)
        total = sum(row["r_n"] for row in run.rows)
        laws.check(f"{what}: sum", abs(total / pressure - 1), 1e-12)
        laws.check(f"{what}: pull", max(-row["r_n"] for row in run.rows), 0)

    def share(n):
        return lambda c: (.5 if min(c, 1 - c) < 1e-9 else 1) / n

    for plane in ("strain", "stress"):
        body = box((6, 5), (1.0, 1.0))
        body["Material"]["Plane"] = plane
        check(f"2D, plane {plane}", *patch_scene(2, body, (0, 2, 3), plane), lambda row: share(6)(row["x"]))
    check("3D", *patch_scene(3, box((4, 3, 4), (1.0, 1.0, 1.0)), (0, 2, 4, 5)),
          lambda row: share(4)(row["x"]) * share(3)(row["y"]))
    for dim, ids in ((2, (10, 12, 13)), (3, (10, 12, 14, 15))):
        file = laws.folder / f"distorted{dim}.msh"
        points, faces = distorted(file, dim)
        areas = tributary(points, faces)
        by_place = {tuple(round(c, 9) for c in points[i]): a for i, a in areas.items()}
        body = {"Mesh": {"File": file.name}, "Material": {"Young modulus": 1000, "Poisson ratio": .3}}
        check(f"{dim}D, distorted", *patch_scene(dim, body, ids),
              lambda row: by_place[tuple(round(row[c], 9) for c in "xyz")])
        boxes = "0.4, 0 : 0.6, 0.3 : 2" if dim == 2 else "0.2, 0.2, 0 : 0.45, 0.6, 0.3 : 1"
        for element, plane in itertools.product(ELEMENTS, ("strain", "stress")[:4 - dim]):
            hanging = merge(body, {"Element": element, "Mesh": {"Refinement boxes": boxes}, "Material": {"Plane": plane}})
            check(f"{dim}D, {element}, plane {plane}, distorted, hanging nodes",
                  *patch_scene(dim, hanging, ids, plane))
    away = box((4, 4), (1.0, 1.0), **{"Refinement boxes": "0.3, 0.6 : 0.7, 0.9 : 2"})
    check("2D, hanging nodes away from the contact", *patch_scene(2, away, (0, 2, 3)),
          lambda row: share(4)(row["x"]))
    near = box((4, 4, 4), (1.0, 1.0, 1.0), **{"Refinement boxes": "0, 0, 0 : 0.5, 0.5, 0.3 : 1"})
    check("3D, hanging nodes on the contact", *patch_scene(3, near, (0, 2, 4, 5)))
