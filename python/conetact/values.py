# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values as scenes write them."""
from __future__ import annotations

import numbers
from collections.abc import Iterable, Mapping
from typing import Any, Union

import numpy as np

from .errors import InputError

Value = Union[str, float, Iterable[Any], Mapping[Any, Any], Any]
COMPONENTS = ("Value", "Displacement", "Force", "Moment", "Stiffness")  # expressions, which may have commas


def value_text(value: Value, entry: str = "") -> str:
    """A value as scenes write it; components of loads and displacements are separated by ; and others by commas.

    A dictionary is a list of names or numbers and what belongs to them, such as boundary ids by conditions.

    >>> conetact.value_text((1, 0.5)), conetact.value_text((0, "-t"), "Value"), conetact.value_text(True)
    ('1, 0.5', '0 ; -t', 'true')
    >>> conetact.value_text({"tip": (1, 0), "foot": (0, 0)})
    'tip: 1, 0 ; foot: 0, 0'
    """
    if isinstance(value, Mapping):
        return " ; ".join(f"{key}: {value_text(text)}" for key, text in value.items())
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (tuple, list, np.ndarray)):
        return (" ; " if entry in COMPONENTS else ", ").join(map(value_text, value))
    return line_of(str(value))


def line_of(text: str) -> str:
    """In one line; a # would hide what is behind it."""
    if "#" in text:
        raise InputError(f"The value '{text}' cannot be written: # begins a comment. Leave it out.")
    return " ".join(text.split())
