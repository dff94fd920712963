#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the scenes of the tutorials and compares them with statics and closed forms, and with what their pages say.

usage: check_tutorials.py PROGRAM [--refresh] [TUTORIAL...]

--refresh writes the tables "Check by hand" of the pages and draws their pictures anew.
"""
import math
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from support.page_tables import Row, faults_of_rows, faults_of_table, number, percent, write
from support.result_sums import Tables

TOP = Path(__file__).resolve().parent.parent
PAGES = TOP / "doc/site/tutorials"
sys.path.insert(0, str(TOP / "python"))


def flange(tables):
    thrust = 20 * math.pi * 50**2 / 8
    bolt, joint = (sum(tables.rows(contact)["r_n"]) for contact in ("seat", "joint"))
    young, shank, head, hole, washer = 210e3, 5, 0.4 * 10, 11, 17
    bolt_compliance = (16 + head) / (young * math.pi * shank**2)
    depth = 32 * 0.5  # of both cones of pressure, of which this is one
    cone = (washer + hole) * (washer + depth - hole) / ((washer - hole) * (washer + depth + hole))
    plate_compliance = math.log(cone) / (young * math.pi * hole * 0.5)
    return [
        Row("preload in the joint at t = 1 [N]", 25000, sum(tables.rows("joint", 1)["r_n"]), 1e-6),
        Row("thrust of the pressure on an eighth [N]", thrust, tables.value("loads_f_z"), 1e-3),
        Row("force of the bolt: joint and thrust, at t = 5 [N]", joint + thrust, bolt, 1e-3),
        Row("shortening by the nut [mm]", 25000 * (bolt_compliance + plate_compliance),
            tables.value("preload_cut_shortening"), .03)]


def press_fit(tables):
    b, c, young, delta, mu = 10, 20, 210e3, .01, .15
    pressure = delta * young / (b * ((c**2 + b**2) / (c**2 - b**2) + 1))
    first, last = tables.rows("joint", 1), tables.rows("joint")
    return [
        Row("pressure after pressing [MPa]", pressure, sum(first["r_n"]) / sum(first["area"]), 3e-3),
        Row("largest over mean pressure after pressing", 1, max(first["pressure"]) / (sum(first["r_n"]) / sum(first["area"])), .01),
        Row("friction at t = 5: the pull [N]", 12000, abs(sum(last["r_t1"])), 1e-9),
        Row("force at which the shaft slides [N]", mu * pressure * 2 * math.pi * b * 20, sliding_force(), .03)]


def sliding_force():
    """The last pull that is held: the scene is run on in steps of 50 N, until it is refused."""
    import conetact
    result = conetact.run(PAGES / "press-fit/press-fit.prm", {"Time/Stages": "1 : 1, 5 : 4, 6 : 60", "Time/Increments": 1,
                                                              "Time/End": 1, "Output/VTU": 0}, check=False)
    return 3000 * (result.increments["time"][-1] - 1)


def hertz(tables):
    modulus = 1 / ((1 - .3**2) / 210e3 + (1 - .3**2) / 70e3)
    half = math.sqrt(4 * 35000 * 50 / (math.pi * modulus))
    rows = tables.rows("line")
    spread = 2 * math.sqrt(sum(rows["r_n"] * rows["x"]**2) / sum(rows["r_n"]))
    return [
        Row("force of half of the roller [N]", 17500, -tables.value("line_f_y"), 1e-6),
        Row("largest pressure [MPa]", 2 * 35000 / (math.pi * half), max(rows["pressure"]), .005),
        Row("half width, from the spread of forces [mm]", half, spread, .01)]


def snap_fit(tables):
    young, depth, h, mu, length = 2400, 6, 1.6, .2, 20
    rigidity = young * depth * h**3 / 12
    time = 2.6  # the catch is on the land
    across, along = tables.value("snap_f_y", time), tables.value("snap_f_x", time)
    x = length + 1.1 + .8 + 1.1 / math.tan(math.pi / 6) + .3 - time
    lever = h / 2 + 1.1
    by_hand = (1 + along * lever * x**2 / (2 * rigidity)) * 3 * rigidity / x**3
    turn = (across * x**2 / 2 - along * lever * x) / rigidity
    tilt = math.atan(mu) + turn
    ramp = math.atan(mu) + math.radians(30)
    return [
        Row("force across, on the land, t = 2.6 [N]", by_hand, across, .05),
        Row("push over force across there", math.tan(tilt), along / across, .05),
        Row("push over force across on the front, t = 0.4", math.tan(ramp), tables.value("snap_f_x", .4) / tables.value("snap_f_y", .4), .03)]


def brake(tables):
    r, R, mu = 62, 92, .4
    area = math.radians(36) / 2 * (R**2 - r**2)
    arm = 2 * (R**3 - r**3) / (3 * (R**2 - r**2))
    rows = [row for contact in ("upper", "lower") for row in tables.rows(contact)]
    nodal = sum(mu * row["r_n"] * math.hypot(row["x"], row["y"]) for row in rows)
    torque = abs(tables.value("support_hub_m_z"))
    return [
        Row("force on a pad [N]", area, sum(tables.rows("upper")["r_n"]), 2e-3),
        Row("torque: mu N r_m of an even pressure [N mm]", mu * 2 * area * arm, torque, .01),
        Row("torque: mu r_n r of all nodes, less cos 2.5 degrees [N mm]", nodal * math.cos(math.radians(2.5)), torque, 1e-3),
        Row("heat of an increment: torque times angle [N mm]", torque * math.radians(5), tables.value("dissipation"), 5e-3)]


def fretting(tables):
    modulus, mu, R = 210e3 / (2 * (1 - .3**2)), .6, 100
    force, shear = tables.value("joint_f_y", 2), abs(tables.value("joint_f_x", 2))
    half, q = math.sqrt(4 * force * R / (math.pi * modulus)), shear / (mu * force)
    cycle = 4 * (mu * force)**2 / (math.pi * modulus) * (
        q * ((1 - q) * (math.log(1 - q) - 1) - 1) + 1.5 + (1 - q)**2 * (math.log(1 - q) - 1.5))
    rows = tables.rows("joint", 2)
    stick = sum(row["area"] for row in rows if row["state"] == "stick") / 2
    spent = tables.increments["dissipation"][tables.increments["time"] > 2.001]
    return [
        Row("largest pressure [MPa]", 2 * force / (math.pi * half), max(rows["pressure"]), .01),
        Row("half width that sticks at t = 2, of the cells that do [mm]", half * math.sqrt(1 - q), stick, .12),
        Row("energy of a cycle [N mm a mm]", cycle, sum(spent), .03)]


CHECKS = {"flange": flange, "press-fit": press_fit, "hertz": hertz, "snap-fit": snap_fit, "brake": brake, "fretting": fretting}
PICTURES = {"press-fit": ["--increment", "5"], "snap-fit": ["--increment", "12", "--amplify", "1"]}


def table(rows):
    head = ["| quantity | by hand | program | difference |", "|---|--:|--:|--:|"]
    return head + [f"| {row.quantity} | {number(row.expected)} | {number(row.found)} | {percent(row.error)} |" for row in rows]


def draw(folder, name):
    subprocess.run([TOP / "scripts/picture.py", folder, *PICTURES.get(name, []), "--dpi", "97"], check=True)
    shutil.copy(folder / "picture.png", PAGES / name / f"{name}.png")


def faults_of(name, refresh):
    import conetact
    with tempfile.TemporaryDirectory() as top:
        folder = Path(top) / name
        rows = CHECKS[name](Tables(conetact.run(PAGES / name / f"{name}.prm", folder=folder)))
        if refresh:
            write(PAGES / f"{name}.md", "check", table(rows))
            draw(folder, name)
    return faults_of_rows(name, rows) + faults_of_table(PAGES / f"{name}.md", "check", table(rows))


def main(program, *words):
    os.environ["CONETACT"] = str(Path(program).resolve())
    names = [word for word in words if word != "--refresh"] or list(CHECKS)
    faults = [fault for name in names for fault in faults_of(name, "--refresh" in words)]
    print("\n".join(faults) or f"{len(names)} tutorials")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
