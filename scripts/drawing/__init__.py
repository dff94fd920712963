# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What picture.py and curve.py stand on: results, shapes of bodies, plane and space."""
import sys
from pathlib import Path

try:
    import matplotlib
    import numpy  # noqa: F401 (told of here, where it is first needed)
except ModuleNotFoundError as error:
    sys.exit(f"{Path(sys.argv[0]).name}: This Python, {sys.executable}, has no {error.name}. Call the script without 'python3' "
             "before it, or with /usr/bin/python3, which has it from Debian's packages python3-numpy and python3-matplotlib.")

matplotlib.use("Agg")
sys.path.append(str(Path(__file__).resolve().parents[2] / "python"))
