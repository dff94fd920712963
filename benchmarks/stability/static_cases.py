# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of the families that statics.py judges: a scene, what is known about it, a verdict."""
import csv
import re
import subprocess
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "tests"))
from support.batch import of_thread  # noqa: E402
from support.scenes import write_scene  # noqa: E402
from statics import Statement, judge  # noqa: E402

OUTCOMES = ("solved", "refused rightly", "WRONG", "refused wrongly", "crash")
NO_EQUILIBRIUM = "slides?|slid|tips|tip over|lifts|falls"


@dataclass
class StaticCase:
    name: str
    scene: dict
    statement: Statement
    refused: str = None  # what the sentence must say; None: solvable
    limit: float = None  # of a load path: the load parameter of its limit
    target: bool = False  # a load path that reaches its target
    more: list = field(default_factory=list)  # functions of a folder that return further faults
    beside: dict = None  # another scene of the same statement; its results are in ../beside/result for `more`


@dataclass
class Verdict:
    number: int
    case: StaticCase
    outcome: str
    text: str = ""

    @property
    def good(self):
        return self.outcome in OUTCOMES[:2]


def outcome_of_path(folder):
    """Load parameter and words of the last line of events.csv."""
    with open(folder / "events.csv", newline="") as stream:
        *_, last = csv.DictReader(stream)
    return float(last["parameter"]), last["to"]


def path_faults(case, folder):
    if case.limit is None and not case.target:
        return []
    parameter, words = outcome_of_path(folder)
    if case.target:
        return [] if words.startswith(("target reached", "no further change")) else [f"{words} at {parameter:.10g}"]
    if "limit load" in words and abs(parameter - case.limit) <= 1e-6 * case.limit:
        return []
    return [f"{words} at {parameter:.10g} instead of a limit load at {case.limit:.10g}"]


def all_faults(case, folder, finished):
    if not (folder / "increments.csv").exists():
        return []
    faults = judge(folder, case.statement, finished)
    return faults + [fault for look in case.more for fault in look(folder) if finished]


def verdict_of(case, folder, code, sentence):
    """Outcome and why."""
    last = sentence.splitlines()[-1] if sentence else ""
    if code not in (0, 1, 2):
        return "crash", f"exit code {code}: {last}"
    if code == 1:  # told before anything is computed
        rightly = case.refused and "Nothing holds" in sentence
        return "refused rightly" if rightly else "refused wrongly", last
    faults = all_faults(case, folder, code == 0)
    if code == 2:
        if faults:
            return "WRONG", f"before the refusal: {faults[0]}"
        if case.refused and re.search(case.refused, sentence):
            return "refused rightly", last
        return "refused wrongly", ("with another sentence: " if case.refused else "") + last
    if case.refused:
        return "WRONG", "no equilibrium exists, one was accepted" + "".join(f"; {fault}" for fault in faults[:1])
    faults += path_faults(case, folder)
    more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
    return ("WRONG", faults[0] + more) if faults else ("solved", "")


def run_scene(program, case, scene, folder, seconds):
    """Outcome and why."""
    folder.mkdir(parents=True, exist_ok=True)
    write_scene(scene, folder / "scene.prm")
    try:
        done = of_thread(program).run(folder / "scene.prm", "-o", folder / "result", "--quiet", timeout=seconds)
    except subprocess.TimeoutExpired:
        return "crash", f"no end within {seconds} s"
    return verdict_of(case, folder / "result", done.returncode, done.stderr.strip())


def run_static(program, number, case, folder, seconds=120):
    if case.beside:
        outcome, text = run_scene(program, replace(case, more=[]), case.beside, folder / "beside", seconds)
        if outcome != "solved":
            return Verdict(number, case, outcome, f"the scene beside it: {text}")
    return Verdict(number, case, *run_scene(program, case, case.scene, folder, seconds))


def header():
    return ["| family judged by statics | cases | " + " | ".join(OUTCOMES) + " |", "|---|---|" + "---|" * len(OUTCOMES)]


def line(title, verdicts):
    counts = [sum(v.outcome == outcome for v in verdicts) for outcome in OUTCOMES]
    return f"| {title} | {len(verdicts)} | " + " | ".join(map(str, counts)) + " |"
