# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the program as structured arrays."""
from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .errors import ResultError

Table = npt.NDArray[Any]
INTEGERS = ("increment", "node", "substeps", "iterations", "open", "stick", "slip", "event")
TEXTS = ("contact", "state", "solver", "determinate", "unique", "from", "to", "largest_displacement_body",
         "largest_pressure_contact")
KINDS: dict[str, type] = {**dict.fromkeys(INTEGERS, int), **dict.fromkeys(TEXTS, str)}


def read_table(file: str | Path) -> Table:
    """A table of the program; columns of counts are integers, of words texts, all others numbers.

    >>> result = conetact.run(SCENE)
    >>> conetact.read_table(result.folder / "increments.csv")["slip"]
    array([8])
    """
    try:
        whole, _, _ = Path(file).read_text().rpartition("\n")  # a kill may tear the last row
        names, *rows = csv.reader(whole.splitlines())
        columns: list[Table] = [np.array([row[i] for row in rows], dtype=str).astype(KINDS.get(name, float))
                   for i, name in enumerate(names)]
    except OSError:
        raise ResultError(f"{file} cannot be read: it is missing, or no result of the program.") from None
    except (ValueError, IndexError):
        raise ResultError(f"{file} is no table of the program.") from None
    table = np.empty(len(rows), [(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        table[name] = column
    return table


def read_events(file: Path) -> tuple[Table, tuple[str, float]]:
    """Events of a load path, and how it ends: the words and the load parameter of the last row."""
    try:
        *lines, last = file.read_text().splitlines()
        _, parameter, _, _, words = next(csv.reader([last]))[:5]
    except (OSError, ValueError):
        raise ResultError(f"{file} cannot be read: it is written with Solver/Method = load path.") from None
    rows = [tuple(row) for row in csv.reader(lines[1:])]
    node = lines[0].split(",").index("node")
    of_several = any(":" in row[node] for row in rows)  # contacts: "slide:4"
    kinds: dict[str, Any] = {"event": int, "parameter": float, "node": "U64" if of_several else int}
    names = [(name, kinds.get(name, "U64")) for name in lines[0].split(",")]
    return np.array(rows, dtype=names), (words, float(parameter))
