# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a run ended and what it warned of, by its log."""
import re
from dataclasses import dataclass


@dataclass
class Outcome:
    """`sentence` is the program's where it stopped early, "" where all increments are solved."""

    good: bool
    planned: int
    sentence: str
    warnings: list
    bodies: dict
    contacts: dict


CLOSING = r"increment (\d+)(?: of (\d+))?, t = "  # of the last increment, below those of the way there
STOPPED = r"Increment (\d+) of (\d+) \(t = "


def last_run(lines):
    """A run that went on from a checkpoint has its log behind that of the run before."""
    heads = [i for i, line in enumerate(lines) if line.startswith("Conetact ")]
    return lines[heads[-1]:] if heads else lines


def planned_in(lines):
    """How many increments the run wanted; 0 where the log does not tell, as for load paths."""
    told = [found[2] for line in lines for found in (re.match(CLOSING, line), re.match(STOPPED, line)) if found]
    return int(told[-1] or 0) if told else 0


def why_stopped(lines):
    """The sentence of the program; "" where all is solved."""
    stopped = [line for line in lines if re.match(STOPPED, line)]
    closing = [re.match(CLOSING, line) for line in lines if re.match(CLOSING, line)]
    if stopped:
        return stopped[-1]
    if closing and closing[-1][2] in (None, closing[-1][1]):
        return ""
    ended = [i for i, line in enumerate(lines) if line.startswith("memory: ")]
    told = [line for line in lines[:ended[-1]] if not re.match(r"\w+: |Results are in| ", line)] if ended else []
    return told[-1] if told else "The log has no end: the run was killed, or is still going on."


def told_of(lines, kind):
    """What the log says of each body or contact, "Body NAME: words"."""
    told = {}
    for line in lines:
        if found := re.match(kind + r" ([^:]+): (.+)", line):
            told.setdefault(found[1], []).append(found[2])
    return told


def outcome_of(result):
    lines = result.log.splitlines()
    sentence = why_stopped(last_run(lines))
    return Outcome(not sentence, planned_in(last_run(lines)), sentence,
                   [line[9:] for line in lines if line.startswith("warning: ")],
                   told_of(lines, "Body"), told_of(lines, "Contact"))
