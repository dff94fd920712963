# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run ended and what it warned of, by its log."""
import re
from dataclasses import dataclass

from ..endings import ending_of


@dataclass
class Outcome:
    """`sentence` is the program's where it stopped early, "" where all increments are solved."""

    good: bool
    planned: int
    sentence: str
    warnings: list
    bodies: dict
    contacts: dict


def told_of(lines, kind):
    """What the log says of each body or contact, "Body NAME: words"."""
    told = {}
    for line in lines:
        if found := re.match(kind + r" ([^:]+): (.+)", line):
            told.setdefault(found[1], []).append(found[2])
    return told


def outcome_of(result):
    lines, ending = result.log.splitlines(), ending_of(result.log)
    return Outcome(not ending.sentence, ending.planned, ending.sentence,
                   [line[9:] for line in lines if line.startswith("warning: ")],
                   told_of(lines, "Body"), told_of(lines, "Contact"))
