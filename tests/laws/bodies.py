# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two bodies that do not meet know nothing of each other."""
import re

from support.scenes import press_and_shear
from support.tables import Run


def bodies(laws):
    for dim in (2, 3):
        left = press_and_shear(dim)
        right = press_and_shear(dim, mu=.5, young=70.0)
        shift = (5.0,) + (0.0,) * (dim - 1)
        right["Body block"]["Mesh"]["Translation"] = shift
        right["Support top"]["Displacement"] = re.sub(r"0\.004", "-0.003", right["Support top"]["Displacement"])
        other = {"Body other": right["Body block"], "Contact other": {**right["Contact bottom"], "Body": "other"},
                 "Support other": {**right["Support top"], "Body": "other"}}
        both = laws.run({**left, **other})
        for name, alone, start in (("first", laws.run(left), 0), ("second", laws.run(right), 4)):
            part = Run(both.folder)
            part.rows = [row for row in both.rows if (row["x"] > 4) == (start > 0)]
            laws.same(f"{dim}D, {name} body", alone, part, 1e-12)
