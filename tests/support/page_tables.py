# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of pages whose numbers come from runs: a test compares them, --refresh writes them.

A table stands between the lines `<!-- table NAME -->` and `<!-- end of table -->`.
"""
import math
import re
from dataclasses import dataclass

PRINTED = 2e-3  # relative: what four digits and other processors may change


@dataclass
class Row:
    """A quantity, what it should be, what a run gives, and how far both may differ, relative to the first."""
    quantity: str
    expected: float
    found: float
    tolerance: float
    source: str = ""
    command: str = ""

    @property
    def error(self):
        return self.found / self.expected - 1


def number(value):
    if 1e3 <= abs(value) < 1e6:
        return f"{value:.0f}"
    return f"{value:.4g}" if 1e-3 <= abs(value) < 1e3 or value == 0 else f"{value:.3e}"


def percent(error):
    """Below a thousandth of a percent all is rounding."""
    return "0" if abs(error) < 1e-5 else f"{100 * error:+.2g} %"


def place_of(name):
    return re.compile(rf"(<!-- table {name} -->\n)(.*?)(<!-- end of table -->)", re.DOTALL)


def write(page, name, lines):
    text = page.read_text()
    if not place_of(name).search(text):
        raise SystemExit(f"{page} has no place for the table {name}")
    page.write_text(place_of(name).sub(lambda match: match[1] + "\n" + "\n".join(lines) + "\n\n" + match[3], text))


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


def same(a, b):
    try:
        return math.isclose(float(a), float(b), rel_tol=PRINTED)
    except ValueError:
        return a == b or a.endswith("%") and b.endswith("%") or "%" in a + b  # the error itself is judged by its tolerance


def faults_of_table(page, name, lines):
    """Where the page says something else than these lines."""
    found = place_of(name).search(page.read_text())
    if not found:
        return [f"{page.name} has no table {name}"]
    there = [line for line in found[2].splitlines() if line.strip()]
    if len(there) != len(lines):
        return [f"{page.name}: the table {name} has {len(there)} lines, not {len(lines)}"]
    return [f"{page.name}: the table {name} says '{old}', the run '{new}'" for old, new in zip(there, lines)
            if len(cells(old)) != len(cells(new)) or not all(map(same, cells(old), cells(new)))]


def faults_of_rows(where, rows):
    return [f"{where}: {row.quantity} is {row.found:.6g}, expected {row.expected:.6g} within {row.tolerance:g}"
            for row in rows if not abs(row.error) <= row.tolerance]
