# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Packages that few methods need."""
from __future__ import annotations

import importlib
from typing import Any

from .errors import ConetactError


def module(name: str, what: str) -> Any:
    """A module, or a sentence if it is missing."""
    try:
        return importlib.import_module(name)
    except ImportError:
        package = name.split(".")[0]
        raise ConetactError(f"{what} needs the Python package {package}, which is not installed. Install it with "
                            f"pip install {package}.") from None
