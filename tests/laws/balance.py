# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces and moments balance on fine and coarse meshes."""
from support.scenes import ELEMENTS, press_and_shear, with_element
from support.tables import REACTION, in_space
from support.vectors import cross, plus


def balance(laws):
    for n, element in ((8, "Q1"), (16, "Q1"), *((8, element) for element in ELEMENTS[1:])):
        scene = with_element(press_and_shear(3, cells=(n, n, n), increments=6), element)
        run = laws.run(scene, bounds=False)
        for column in ("residual", "equilibrium", "balance"):
            laws.check(f"{n}^3 {element}: {column}", max(row[column] for row in run.increments), 1e-10)
        force = moment = 0.0
        for increment in run.increments:
            total, about = (0, 0, 0), (0, 0, 0)
            for row in run.rows:
                if row["increment"] == increment["increment"]:
                    r = in_space(row, 3, REACTION)
                    total = plus(total, r)
                    about = plus(about, cross((row["x"], row["y"], row["z"]), r))
            size = max(map(abs, total))
            force = max(force, *(abs(total[d] - increment[f"bottom_f_{'xyz'[d]}"]) / size for d in range(3)))
            moment = max(moment, *(abs(about[d] - increment[f"bottom_m_{'xyz'[d]}"]) / size for d in range(3)))
        # forces below 1e-9 of the largest are written 0
        laws.check(f"{n}^3: sum of reactions against the resultant", force, 1e-10)
        laws.check(f"{n}^3: sum of moments against the resultant", moment, 1e-9)
        laws.admissible(f"{n}^3 {element}", run, lambda row: .3)
