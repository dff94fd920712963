# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""One HTML file that shows a finished run: its scene, tables, curves, and its bodies in a view to turn.

    from conetact import Result
    from conetact.report import page_of
    text = page_of(Result("output/bracket"))

`page.py` puts the parts one below the other; `outcome.py` reads the log; `tables.py`, `curves.py` and
`scene.py` make parts of the page; `meshes.py`, `fields.py` and `view.py` make what `viewer.js` draws. Needs
numpy only.
"""
from .page import page_of

__all__ = ["page_of"]
