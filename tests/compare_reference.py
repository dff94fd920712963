#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares a finished run with the tables of tests/reference to 1e-8.

usage: compare_reference.py EXAMPLE FOLDER

Examples of Kanno, Martins and Pinto da Costa (2004): 5.1 is square-greco.prm, 5.2
inclined-obstacle.prm, 5.3-04 to 5.3-12 are double-layer-grid-04.prm to -12.prm, 5.4
is double-layer-grid-unloading.prm. sheet-pile is Example 3 of Popov and Lovtsov
(2023). Each column is compared relative to its largest value, states exactly.
"""
import csv
import sys
from pathlib import Path

REFERENCE = Path(__file__).parent / "reference"
TOLERANCE = 1e-8


def read(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def read_run(folder):
    """Rows of each increment, ordered along x."""
    increments = {}
    for row in read(folder / "reactions.csv"):
        increments.setdefault(int(row["increment"]), []).append(row)
    for rows in increments.values():
        rows.sort(key=lambda row: (round(float(row["y"]), 6), float(row["x"])))
    return increments


def letters(row):
    """The letters of the reference: t points along +x, so s+ slips to the right."""
    if row["state"] == "slip":
        return "s+" if float(row["du_t1"]) > 0 else "s-"
    return {"open": "o", "stick": "b"}[row["state"]]


def compare(rows, reference, columns, state=letters):
    """`columns`: name in the reference -> function of a row of the run."""
    if len(rows) != len(reference):
        return [f"{len(rows)} rows instead of {len(reference)}"]
    faults = []
    for name, value in columns.items():
        old, new = [float(r[name]) for r in reference], [value(r) for r in rows]
        largest = max(map(abs, old))
        error = max(abs(a - b) if a - b == a - b else float("inf") for a, b in zip(old, new))
        error /= largest or 1
        print(f"  {name}: largest {largest:.6g}, error {error:.2g}")
        if not error <= TOLERANCE:
            faults.append(f"{name} differs by {error:.3g} of its largest value")
    for row, other in zip(rows, reference):
        if state and state(row) != other["state"]:
            faults.append(f"node at x = {row['x']}: state {state(row)} instead of {other['state']}")
    return faults


def column(name, factor=1):
    return lambda row: factor * float(row[name])


def example_5_1(run):
    last = run[max(run)]
    print("square-greco, last increment")
    faults = compare(last, read(REFERENCE / "kanno-5.1-32x16.csv"),
                     {"x_mm": column("x"), "ut_mm": column("u_t1"), "gap_mm": column("gap"),
                      "rn_N_per_mm": column("r_n"), "rt_N_per_mm": column("r_t1")})
    total = sum(float(row["r_n"]) for row in last)
    print(f"  sum of r_n: {total:.15g} N/mm")
    # 50 N/mm^2 on 40 mm
    return faults if abs(total - 2000) <= 2000 * TOLERANCE else faults + [f"the sum of r_n is {total}, not 2000"]


def count_states(rows):
    states = [letters(row) for row in rows]
    first = next((i + 1 for i, s in enumerate(states) if s != "o"), 0)
    return [states.count("b"), states.count("s-"), states.count("s+"), states.count("o"), first]


def example_5_2(run):
    faults = []
    for step in (0, 11):
        print(f"inclined-obstacle, increment {step + 1}")
        faults += [f"increment {step + 1}: {fault}" for fault in compare(
            run.get(step + 1, []), read(REFERENCE / f"kanno-5.2-step{step:02}.csv"),
            {"x_mm": column("x"), "un_abs_towards_obstacle": column("u_n", -1), "ut_abs": column("u_t1"),
             "gap_now": column("gap"), "dut_last_step": column("du_t1"),
             "rn_N_per_mm": column("r_n"), "rt_N_per_mm": column("r_t1")})]
    names = ["stick", "slip_left", "slip_right", "free", "first_contact_node"]
    for row in read(REFERENCE / "kanno-5.2-counts.csv"):
        increment = int(row["step"]) + 1
        expected, counts = [int(row[name]) for name in names], count_states(run.get(increment, []))
        if counts != expected:
            faults.append(f"increment {increment}: {names} are {counts} instead of {expected}")
    return faults


# Nodes that stick, slip and are open.
GRID_STATES = {"5.3-04": [(4, 9, 3)], "5.3-07": [(11, 33, 5)], "5.3-10": [(43, 52, 5)], "5.3-12": [(78, 62, 4)],
               "5.4": [(88, 56, 0), (104, 40, 0), (96, 48, 0), (92, 52, 0), (80, 64, 0), (24, 120, 0)]}
GRID_TABLES = {"5.3-04": {1: "kanno-5.3-04.csv"}, "5.3-07": {1: "kanno-5.3-07.csv"},
               "5.4": {1: "kanno-5.4-m1.csv", 6: "kanno-5.4-m6.csv"}}


def asymmetry(rows):
    """Largest difference of reactions of mirrored nodes over the largest reaction."""
    at = {(round(float(r["x"]), 6), round(float(r["y"]), 6)): [float(r[c]) for c in ("r_n", "r_t1", "r_t2")] for r in rows}
    largest = max(abs(x) for r in at.values() for x in r)
    return max(max(abs(r[0] - at[-x, y][0]), abs(r[1] + at[-x, y][1]), abs(r[2] - at[-x, y][2]),
                   abs(r[0] - at[x, -y][0]), abs(r[1] - at[x, -y][1]), abs(r[2] + at[x, -y][2]))
               for (x, y), r in at.items()) / largest


def double_layer_grid(example):
    def check(run):
        faults = []
        for increment, expected in enumerate(GRID_STATES[example], 1):
            rows = run.get(increment, [])
            counts = tuple(sum(row["state"] == s for row in rows) for s in ("stick", "slip", "open"))
            print(f"increment {increment}: {counts} nodes stick, slip, are open")
            if counts != expected:
                faults.append(f"increment {increment}: {counts} nodes stick, slip, are open instead of {expected}")
            if example == "5.4" and rows:
                error = asymmetry(rows)
                print(f"  asymmetry {error:.2g}")
                if not error <= 1e-12:
                    faults.append(f"increment {increment}: asymmetry {error:.3g}")
        for increment, table in GRID_TABLES.get(example, {}).items():
            print(table)
            faults += [f"increment {increment}: {fault}" for fault in compare(
                run.get(increment, []), read(REFERENCE / table),
                {"x": column("x"), "y": column("y"), "dux": column("du_t1"), "duy": column("du_t2"),
                 "dun": lambda row: float(row["gap"]), "rx": column("r_t1"), "ry": column("r_t2"), "rn": column("r_n")},
                lambda row: {"open": "free"}.get(row["state"], row["state"]))]
        return faults
    return check


def sheet_pile(run):
    """Pairs of both sides; the table's t is upwards, that of the wall relative to the soil."""
    faults = []
    for side, sign in (("left", -1), ("right", 1)):
        print(f"sheet-pile, {side}")
        rows = [row for row in run[max(run)] if row["contact"] == side and float(row["y"]) > 0.1]
        faults += [f"{side}: {fault}" for fault in compare(
            rows, [row for row in read(REFERENCE / "popov-3.csv") if row["side"] == side],
            {"y": column("y"), "xn": column("r_n"), "xt": column("r_t1", sign), "zn": column("gap"),
             "zt": column("u_t1", sign)}, None)]
    return faults


EXAMPLES = {"5.1": example_5_1, "5.2": example_5_2, "sheet-pile": sheet_pile, **{name: double_layer_grid(name) for name in GRID_STATES}}


def main(example, folder):
    run = read_run(Path(folder))
    faults = EXAMPLES[example](run)
    print("\n".join(faults) or "the run agrees with the reference")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
