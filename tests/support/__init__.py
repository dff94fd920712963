# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What tests and benchmarks share: scenes, their results, exact solutions, fixtures in C++.

The one way between tests/ and benchmarks/: benchmarks import from here, nothing in tests/
imports from benchmarks/. A script needs tests/ on its path (benchmarks/measure.py puts it there):

    from support.scenes import box, contact, floor
    from support.tables import Run
"""
