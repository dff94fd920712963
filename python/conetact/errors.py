# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exceptions: a class for each exit code of the program, and those of this package itself."""
from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .results import Result


class ConetactError(Exception):
    """What the program says; also of one that is missing or was killed.

    >>> raise conetact.ConetactError("There is no program.")
    Traceback (most recent call last):
    conetact.errors.ConetactError: There is no program.
    """

    exit_code: int | None = None


class InputError(ConetactError):
    """Wrong input; nothing was written.

    >>> try:
    ...     conetact.run(SCENE, {"Contact bottom/Friction": 0.5})
    ... except conetact.InputError as error:
    ...     print("Did you mean" in str(error))
    True
    """

    exit_code = 1


class AnalysisError(ConetactError):
    """No equilibrium, or not converged; `result` holds the increments before.

    >>> try:
    ...     conetact.run(SCENE, {"Contact bottom/Friction coefficient": 0.3})
    ... except conetact.AnalysisError as error:
    ...     print("slides" in str(error), len(error.result.increments))
    True 0
    """

    exit_code = 2
    result: Result | None = None


class WriteError(ConetactError):
    """The results cannot be written.

    >>> try:
    ...     conetact.run(SCENE, folder="/proc/none")
    ... except conetact.WriteError as error:
    ...     print(error.exit_code)
    3
    """

    exit_code = 3


class ResultError(ConetactError):
    """A result is asked for what it does not hold.

    >>> conetact.Result("nowhere")
    Traceback (most recent call last):
    conetact.errors.ResultError: There is no folder nowhere.
    """


class MissingEntry(InputError, KeyError):
    """An entry that a scene does not set; a KeyError, too.

    >>> try:
    ...     conetact.Scene()["Time/End"]
    ... except KeyError as error:
    ...     print(error)
    The scene does not set Time/End; its default is '1'.
    """

    def __str__(self) -> str:
        return str(self.args[0])  # a KeyError would quote it


ERRORS: dict[int, type[ConetactError]] = {1: InputError, 2: AnalysisError, 3: WriteError}


def error_of(code: int, said: str) -> ConetactError | None:
    """None, or the exception of a process that has ended."""
    if code == 0:
        return None
    sentence = re.sub(r"^conetact: ", "", said.strip(), flags=re.M)
    if code in ERRORS:
        return ERRORS[code](sentence)
    return ConetactError(f"The program ended with code {code}: {sentence or 'it said nothing.'}")


def meant(word: str, known: Iterable[str]) -> str:
    """A question with the name that is nearest, or all names where none is near."""
    names = [name for name in known if name]
    near = difflib.get_close_matches(word.lower(), [name.lower() for name in names], 1, 0.6)
    if near:
        return f"Did you mean '{next(name for name in names if name.lower() == near[0])}'?"
    return f"There are: {', '.join(names)}." if names else "There are none."
