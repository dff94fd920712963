# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes scenes in Python, runs them and reads their results. Needs numpy only.

    import conetact
    result = conetact.run("parameter-files/floating-block.prm", {"Contact bottom/Friction coefficient": 0.6})
    print(result.increments["bottom_f_x"][-1], result.reactions["r_n"].max())

    for result in conetact.sweep("parameter-files/floating-block.prm",
                                 {"Load push/Value": ["0.2*t", "0.4*t", "0.6*t"]}):
        print(result.changes, result.exit_code, result.error)

Tables are structured arrays with the columns that doc/results.md lists. Errors of the program
are exceptions with its sentence, a class for each exit code: InputError (1),
AnalysisError (2), WriteError (3). The program is build/conetact of this repository, the one
that was installed with this package, or what the environment variable CONETACT names.
"""
from .errors import AnalysisError, ConetactError, InputError, MissingEntry, ResultError, WriteError
from .fitting import Fit, fit
from .meshes import Mesh, from_meshio, from_pyvista, mesh_of
from .program import executable, manual
from .results import Result
from .runs import Batch, check, combinations, run, sweep
from .scene_text import read_entries
from .scenes import Scene, box
from .tables import read_table
from .values import value_text
from .vtu import VtuMesh, read_vtu

__all__ = ["AnalysisError", "Batch", "ConetactError", "Fit", "InputError", "Mesh", "MissingEntry", "Result",
           "ResultError", "Scene", "VtuMesh", "WriteError", "box", "check", "combinations", "executable", "fit",
           "from_meshio", "from_pyvista", "manual", "mesh_of", "read_entries", "read_table", "read_vtu", "run", "sweep",
           "value_text"]
