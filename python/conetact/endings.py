# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run ended, as its log tells."""
from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

CLOSING = r"increment (\d+)(?: of (\d+))?, t = "  # of the last increment, below those of the way there
STOPPED = r"Increment (\d+) of (\d+) \(t = "
INTERRUPTED, NOT_CONVERGED = r"Interrupted (in|after|at) ", "The path is not converged "
NOT_WRITTEN = r"Cannot write |.* cannot be (written|made)"
REFUSED, NO_ROOM = 2, 3  # exit codes: no equilibrium, no disk
NO_END = "The log has no end: the run was killed, or is still going on."


@dataclass(frozen=True)
class Ending:
    """`exit_code` is None where it is not known, `sentence` the program's where it stopped early, `planned` 0 where no
    number of increments is told, as for load paths."""

    exit_code: int | None
    sentence: str
    planned: int


def ending_of(log: str) -> Ending:
    """Of the last run in a log.

    >>> import conetact.endings
    >>> conetact.endings.ending_of(conetact.run(SCENE).log)
    Ending(exit_code=0, sentence='', planned=1)
    """
    lines = last_run(log.splitlines())
    sentence = why_stopped(lines)
    is_known = sentence != NO_END and not re.match(INTERRUPTED, sentence)
    code = (NO_ROOM if re.match(NOT_WRITTEN, sentence) else REFUSED) if sentence else 0
    return Ending(code if is_known else None, sentence, planned_in(lines))


def last_run(lines: Sequence[str]) -> Sequence[str]:
    """A run that went on from a checkpoint has its log behind that of the run before."""
    heads = [i for i, line in enumerate(lines) if line.startswith("Conetact ")]
    return lines[heads[-1]:] if heads else lines


def planned_in(lines: Iterable[str]) -> int:
    """How many increments the run wanted."""
    told = [found[2] for line in lines for found in (re.match(CLOSING, line), re.match(STOPPED, line)) if found]
    return int(told[-1] or 0) if told else 0


def why_stopped(lines: Sequence[str]) -> str:
    """The sentence of the program, which stands above what it says in closing; "" where all is solved."""
    if lines and re.match(NOT_WRITTEN, lines[-1]):
        return lines[-1]
    closing = [(i, found) for i, line in enumerate(lines) if (found := re.match(CLOSING, line))]
    ends = [closing[-1][0]] if closing else [i for i, line in enumerate(lines) if line.startswith("memory: ")]
    told = [line for line in lines[:ends[-1]] if not re.match(r"\w+: |Results are in| ", line)] if ends else []
    is_last = bool(closing) and closing[-1][1][2] in (None, closing[-1][1][1])
    if is_last and not (told and re.match(f"{STOPPED}|{INTERRUPTED}|{NOT_CONVERGED}", told[-1])):
        return ""
    return told[-1] if told else NO_END
