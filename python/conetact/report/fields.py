# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quantities that can be chosen: names, titles, units, and their values at the nodes that are drawn."""
import numpy as np

COMPONENTS = {"xx": 0, "yy": 4, "zz": 8, "xy": 1, "yz": 5, "xz": 2}
TITLES = {"von_mises": "von Mises stress", "contact_pressure": "contact pressure",
          "contact_traction": "contact traction", "state": "contact state", "gap": "gap",
          "axial_force": "axial force", "moment": "bending moment"}
OF_CONTACT = ("contact_pressure", "contact_traction", "gap", "state")
ON_SOLIDS = (*OF_CONTACT, "slip", "wear")  # what bodies have of contact; surfaces have it, too
LESS_WANTED = ("strain", "principal_strains")  # they are left out first
FIRST = ("von_mises", *OF_CONTACT)


def split(name, values, dimension):
    """Scalars of an array: of tensors their components, of principal values the largest, middle and least."""
    if values.ndim == 1:
        return {name: values}
    if values.shape[1] == 9:
        wanted = [c for c in COMPONENTS if dimension == 3 or c in ("xx", "yy", "zz", "xy")]
        return {f"{name}_{c}": values[:, COMPONENTS[c]] for c in wanted}
    if name.startswith("principal"):
        return {f"{name}_{i + 1}": values[:, i] for i in range(values.shape[1])}
    return {f"{name}_{c}": values[:, i] for i, c in enumerate("xyz")}


def of_body(arrays):
    """Those that a body has everywhere."""
    return {name: values for name, values in arrays.items() if name not in ON_SOLIDS}


def values_of(body, surface, shape, dimension, without=()):
    """All of them by name; not a number where a node is on no contact."""
    found = {}
    for name, values in of_body(body.arrays).items():
        if name != "displacement" and name not in without:
            at_nodes = np.where((shape.rows >= 0).reshape(-1, *[1] * (values.ndim - 1)), values[shape.rows], np.nan)
            found |= split(name, at_nodes, dimension)
    return found | contact_values(surface, shape)


def contact_values(surface, shape):
    may_touch = (surface.arrays["state"] >= 0) & (shape.touching >= 0)
    found = {}
    for name in OF_CONTACT:
        values = surface.arrays[name]
        values = np.linalg.norm(values, axis=1) if values.ndim > 1 else values
        found[name] = np.full(len(shape.points), np.nan)
        found[name][shape.touching[may_touch]] = values[may_touch]
    return found if may_touch.any() else {}


def kind_of(name):
    return "contact" if name in OF_CONTACT else "body"


def described(name, units):
    """Title and unit."""
    title = TITLES.get(name, name.replace("_", " "))
    kind = "stress" if name in ("contact_pressure", "contact_traction") else None
    unit = units.label(name, kind)[len(name):].strip(" []")
    return {"name": name, "title": title, "unit": unit, "kind": kind_of(name)}
