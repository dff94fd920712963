# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves of the tables of a result."""
from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import optional
from .errors import ResultError, meant
from .tables import Table

if TYPE_CHECKING:
    from .results import Result

OF_INCREMENTS = ("increments", "history")  # one row for each
Line = tuple[str, Any, Any]


def plot(result: Result, columns: Sequence[str], against: str, increment: int | None, contact: str | None,
         axes: Any) -> Any:
    pyplot = optional.module("matplotlib.pyplot", "plot()")
    columns = columns or forces(result.increments)
    if axes is None:
        axes = pyplot.subplots(layout="constrained")[1]
    for column in columns:
        for label, x, y in lines_of(result, column, against, increment, contact):
            axes.plot(x, y, ".-", label=label)
    axes.set(xlabel=against, ylabel=columns[0] if len(columns) == 1 else "")
    if len(axes.lines) > 1:
        axes.legend(frameon=False)
    return axes


def forces(increments: Table) -> list[str]:
    """Columns with forces of contacts that are not 0 all the time."""
    others = ("supports_", "loads_", "support_", "load_", "obstacle_")
    return [name for name in increments.dtype.names or () if name[-4:-1] == "_f_" and not name.startswith(others)
            and increments[name].any()]


def lines_of(result: Result, column: str, against: str, increment: int | None, contact: str | None) -> list[Line]:
    """Labels, abscissas and ordinates."""
    tables = [result.table(name) for name in OF_INCREMENTS if (result.folder / f"{name}.csv").exists()]
    x, y = (next((table[name] for table in tables if name in numbers(table)), None) for name in (against, column))
    if x is not None and y is not None:
        return [(column, x, y)]
    rows = result.reactions
    for name in (column, against):
        if name not in numbers(rows):
            known = [other for table in [*tables, rows] for other in numbers(table)]
            raise ResultError(f"The tables of {result.folder} have no column '{name}' with numbers. "
                              f"{meant(name, known)}")
    return along_contacts(rows[chosen(rows["increment"], increment)], column, against, contact)


def numbers(table: Table) -> list[str]:
    return [name for name in table.dtype.names or () if table.dtype[name].kind in "if"]


def chosen(increments: Table, asked: int | None) -> Table:
    if not len(increments) or asked is not None and asked not in increments:
        raise ResultError(f"There is no increment {asked or 1} in the reactions.")
    there: Table = increments == (increments.max() if asked is None else asked)
    return there


def along_contacts(rows: Table, column: str, against: str, contact: str | None) -> list[Line]:
    names = list(dict.fromkeys(rows["contact"].tolist()))
    if contact is not None and contact not in names:
        raise ResultError(f"There is no contact '{contact}'. {meant(contact, names)}")
    lines = []
    for name in names if contact is None else [contact]:
        part = np.sort(rows[rows["contact"] == name], order=against)
        lines.append((f"{column}, {name}", part[against], part[column]))
    return lines
