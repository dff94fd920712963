#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares a finished run with the tables of tests/reference to 1e-8.

usage: compare_reference.py 5.1|5.2 FOLDER

5.1 is square-greco.prm, 5.2 is inclined-obstacle.prm: Examples 5.1 and 5.2 of
Kanno, Martins and Pinto da Costa (2004). Each column is compared relative to
its largest value, states exactly.
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
        rows.sort(key=lambda row: float(row["x"]))
    return increments


def state(row):
    """The letters of the reference: t points along +x, so s+ slips to the right."""
    if row["state"] == "slip":
        return "s+" if float(row["du_t1"]) > 0 else "s-"
    return {"open": "o", "stick": "b"}[row["state"]]


def compare(rows, reference, columns):
    """`columns`: name in the reference -> function of a row of the run."""
    if len(rows) != len(reference):
        return [f"{len(rows)} rows instead of {len(reference)}"]
    faults = []
    for name, value in columns.items():
        old, new = [float(r[name]) for r in reference], [value(r) for r in rows]
        largest = max(map(abs, old))
        error = max(abs(a - b) if a - b == a - b else float("inf") for a, b in zip(old, new))
        print(f"  {name}: largest {largest:.6g}, error {error / largest:.2g}")
        if not error <= TOLERANCE * largest:
            faults.append(f"{name} differs by {error / largest:.3g} of its largest value")
    for row, other in zip(rows, reference):
        if state(row) != other["state"]:
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
    states = [state(row) for row in rows]
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


def main(example, folder):
    run = read_run(Path(folder))
    faults = {"5.1": example_5_1, "5.2": example_5_2}[example](run)
    print("\n".join(faults) or "the run agrees with the reference")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
