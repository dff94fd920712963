# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Neither threads nor a second run change a result."""
import re

from support.scenes import merge, press_and_shear


def threads(laws):
    scene = press_and_shear(3, cells=(9, 9, 9))
    first = laws.run(scene)
    laws.same("four threads", first, laws.run(scene, "-s", "Solver/Threads=4"), 1e-12)
    for name, tree in (("3D", merge(scene, {"Output": {"VTU": 2}})),
                       ("2D", merge(press_and_shear(2), {"Output": {"VTU": 1}}))):
        one, two = laws.run(tree).folder, laws.run(tree).folder
        files = [sorted(p.name for p in folder.iterdir()) for folder in (one, two)]
        laws.demand(f"{name}: the same {len(files[0])} files", files[0] == files[1])
        other = [f for f in files[0] if f != "log.txt" and without_date(one / f) != without_date(two / f)]
        laws.demand(f"{name}: the same to the bit" + (", not: " + ", ".join(other) if other else ""), not other)


def without_date(file):
    return re.sub(rb"<!--.*?-->", b"", file.read_bytes(), flags=re.S)
