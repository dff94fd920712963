#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `conetact compare` finds, against tables whose differences are known and against runs.

usage: check_compare.py PROGRAM
"""
import csv
import io
import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = Path(__file__).resolve().parent.parent / "parameter-files"
HEAD = ("increment", "contact", "node", "x", "r_n", "r_t1", "gap", "state")


class Compare:
    def __init__(self, program):
        self.program = Path(program).resolve()
        self.folder = Path(tempfile.mkdtemp(prefix="conetact-compare-"))
        self.failed = 0

    def demand(self, what, holds, found=""):
        print(f"  {'' if holds else 'FAILED: '}{what}{'' if holds else f': {found}'}")
        self.failed += not holds

    def run(self, *words):
        return subprocess.run([self.program, *words], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)

    def write(self, name, table, rows, columns=HEAD):
        file = self.folder / name / table
        file.parent.mkdir(exist_ok=True)
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)
        file.write_text(text.getvalue())

    def judge(self, what, code, *words, arguments=(), one="one", other="other"):
        done = self.run("compare", one, other, *arguments)
        said = done.stdout + done.stderr
        self.demand(f"{what}: exit code {done.returncode}", done.returncode == code and all(word in said for word in words), said)
        return done.stdout


def reactions(seed=1):
    chance = random.Random(seed)
    return [[k, contact, node, node, chance.uniform(.1, 1) * 1e5, chance.uniform(-1, 1) * 1e3, chance.uniform(0, 1e-3),
             chance.choice(("open", "stick", "slip"))]
            for k in (1, 2, 3) for contact in ("sole", "side wall") for node in range(5)]


def increments(**changes):
    row = {"increment": 1, "time": 1, "solver": "active set", "substeps": 1, "iterations": 4, "residual": 1e-13,
           "equilibrium": 2e-14, "balance": 3e-15, "strain_energy": 2.5, "determinate": "yes"}
    row.update(changes)
    return [list(row.values())], tuple(row)


def known(compare):
    """Tables made by hand."""
    print("known differences")
    rows = reactions()
    largest = max(row[4] for row in rows)
    compare.write("one", "reactions.csv", rows)
    shuffled = [list(row) for row in rows]
    random.Random(2).shuffle(shuffled)
    compare.write("other", "reactions.csv", shuffled)
    said = compare.judge("rows in another order are the same rows", 0, "are equal to 1e-09: 1 tables, 30 rows")
    compare.demand("  nothing else is said", said.count("\n") == 1, said)

    for part, code in ((.9e-9, 0), (1.1e-9, 2)):
        changed = [list(row) for row in rows]
        changed[17][4] += part * largest
        compare.write("other", "reactions.csv", changed)
        said = compare.judge(f"a reaction is off by {part} of the largest", code, "r_n")
        relative = re.search(r"^reactions.csv +r_n +1 +\S+ +(\S+) +(\S+)", said, re.M)
        compare.demand("  by how much is told", relative and abs(float(relative[2]) / part - 1) < 1e-2 and
                       abs(float(relative[1]) / (part * largest) - 1) < 1e-2, said)
        compare.judge("  with a tolerance of 1e-8", 0, arguments=("--tolerance", "1e-8"))
        compare.judge("  with none", 2, arguments=("--tolerance=0",))
    where = f"increment {rows[17][0]}, contact {rows[17][1]}, node {rows[17][2]}"
    compare.demand("  where it is comes first", f"first: reactions.csv, {where}: r_n is " in said, said)
    changed[2][7] = "wet"
    changed[20][4] *= 2
    compare.write("other", "reactions.csv", changed)
    said = compare.judge("a text differs first, a number more later", 2, f"node 2: state is {rows[2][7]} and wet\n")
    compare.demand("  the larger one of a column is in the table", f"node {rows[20][2]}: {rows[20][4]}" in said, said)

    smooth = [[*row[:5], 1e-12 * row[5], *row[6:]] for row in rows]
    compare.write("one", "reactions.csv", smooth)
    compare.write("other", "reactions.csv", [[*row[:5], 1e-9 * index, *row[6:]] for index, row in enumerate(smooth)])
    compare.judge("a column that is rounding beside its kind", 0, "equal")
    compare.write("other", "reactions.csv", [[*row[:5], 1e-6 * index, *row[6:]] for index, row in enumerate(smooth)])
    compare.judge("a column that is not", 2, "r_t1 is")

    # rows lie at x = 0 to 4: a force of 1e5 there has a rounding of 4e-7 about the origin
    totals = ("increment", "sole_f_y", "sole_m_z", "support_m_z")
    for moment, code in ((3e-7, 0), (5e-7, 2)):
        for name, sign in (("one", 0), ("other", 1)):
            compare.write(name, "reactions.csv", rows)
            compare.write(name, "increments.csv", [[1, 1e5, sign * moment, 0]], totals)
        compare.judge(f"a moment of {moment} beside forces with levers", code, *(("sole_m_z is",) if code else ()))
    for name in ("one", "other"):
        (compare.folder / name / "increments.csv").unlink()

    compare.write("one", "reactions.csv", rows)
    compare.write("other", "reactions.csv", rows[:-2])
    compare.judge("two rows less", 2, "reactions.csv: 2 rows, the first one of increment 3, contact side wall, node 3, is in one only")
    compare.judge("two rows more", 2, "is in one only", one="other", other="one")
    compare.write("other", "reactions.csv", [row[:-1] for row in rows], HEAD[:-1])
    compare.judge("a column less", 2, "column state is in one only")
    compare.write("other", "reactions.csv", [["nan" if c == "r_n" else v for c, v in zip(HEAD, row)] for row in rows])
    compare.judge("what is no number", 2, "and nan")
    nowhere = [[*row[:6], "nan" if row[2] == 4 else row[6], *row[7:]] for row in rows]
    for name, factor in (("one", 1), ("other", 1 + 1e-12)):
        compare.write(name, "reactions.csv", [[*row[:6], row[6] if row[6] == "nan" else factor * row[6], *row[7:]] for row in nowhere])
    compare.judge("gaps to nothing, and others", 0, "equal")
    compare.write("other", "reactions.csv", rows)
    compare.judge("a gap where there was none", 2, "node 4: gap is nan and")
    compare.write("one", "reactions.csv", rows)
    compare.write("other", "history.csv", [[1, 2.5]], ("increment", "largest_pressure"))
    compare.judge("a table less", 2, "the table history.csv is in other only")
    (compare.folder / "other/history.csv").unlink()
    quiet = compare.run("compare", "one", "other", "-q")
    compare.demand("--quiet says nothing", quiet.returncode == 0 and not quiet.stdout + quiet.stderr)


def told(compare):
    """What solvers do is bounded."""
    print("iterations, residuals, solvers")
    compare.write("one", "increments.csv", *increments())
    for changes, code, words in (({"iterations": 9, "residual": 5e-11, "equilibrium": 0, "balance": 9e-11}, 0, "told only"),
                                 ({"iterations": 14}, 2, "iterations is 4 and 14, more than twice as many and 5"),
                                 ({"iterations": 400, "solver": "smoothing"}, 0, "solver"),
                                 ({"residual": 2e-10}, 2, "residual is 1e-13 and 2e-10, more than 1e-10"),
                                 ({"balance": 2e-10}, 2, "balance is"), ({"determinate": "no"}, 2, "determinate is yes and no"),
                                 ({"strain_energy": 2.500001}, 2, "of the largest of the column, 2.5")):
        compare.write("other", "increments.csv", *increments(**changes))
        compare.judge(str(changes), code, words)
    compare.write("other", "increments.csv", *increments(residual=2e-10))
    (compare.folder / "other/used.prm").write_text("subsection Solver\n  set Tolerance = 1e-9\nend\n")
    compare.judge("the bound is that of the run", 0)
    shutil.rmtree(compare.folder / "other")
    compare.write("other", "events.csv", [[1, .5, 7, "open", "slip"], [1, .5, 8, "open", "stick"], ["outcome", 2, "", "", "limit load"]],
                  ("event", "parameter", "node", "from", "to"))
    shutil.rmtree(compare.folder / "one")
    compare.write("one", "events.csv", [[1, .5, 8, "open", "stick"], [1, .5, 7, "open", "slip"], ["outcome", 2, "", "", "limit load"]],
                  ("event", "parameter", "node", "from", "to"))
    compare.judge("changes of one event in another order", 0, "3 rows")
    compare.write("other", "events.csv", [[1, .5, 8, "open", "slip"], [1, .5, 7, "open", "slip"], ["outcome", 2, "", "", "limit load"]],
                  ("event", "parameter", "node", "from", "to"))
    compare.judge("another event", 2, "events.csv, event 1, node 8: to is stick and slip")


def refused(compare):
    print("wrong input")
    (compare.folder / "empty").mkdir()
    (compare.folder / "file").write_text("")
    for words, sentence in ((("one", "nowhere"), "There is no folder nowhere."), (("file", "one"), "There is no folder file."),
                            (("one", "empty"), "The folder empty holds no table (.csv)."), (("one",), "there are fewer"),
                            (("one", "other", "third"), "there are more"), (("one", "other", "--dry-run"), "compare runs no scene"),
                            (("one", "other", "--tolerance", "-1"), "-1 is negative"), (("one", "other", "--tolerance", "few"), "'few' is not a number")):
        done = compare.run("compare", *words)
        compare.demand(" ".join(words), done.returncode == 1 and sentence in done.stderr and done.stderr.count("\n") == 1, done.stderr)
    for content, sentence in (("", "is empty"), ("increment,r_n\n1,2", "ends within a line"), ("increment\n\0\n", "is no text"),
                              ("increment,r_n\n1\n", "has in line 2 1 columns instead of 2")):
        (compare.folder / "one/events.csv").write_text(content)
        done = compare.run("compare", "one", "other")
        compare.demand(f"a table that {sentence}", done.returncode == 1 and sentence in done.stderr, done.stderr)
    done = compare.run("scene.prm", "--tolerance", "1e-9")
    compare.demand("--tolerance without it", done.returncode == 1 and "conetact compare FOLDER FOLDER" in done.stderr, done.stderr)


def runs(compare):
    """Of the program itself."""
    print("runs")
    scene = SCENES / "floating-block.prm"
    for folder, words in (("whole", ()), ("again", ("-s", "Output/VTU=0")), ("threads", ("-s", "Solver/Threads=2")),
                          ("rough", ("-s", "Contact bottom/Friction coefficient=0.61")),
                          ("condensed", ("-s", "Solver/Backend=condensed")), ("iterative", ("-s", "Solver/Backend=iterative")),
                          ("kept", ("-s", "Output/Checkpoint=2", "-s", "Time/Times=0.25, 0.5"))):
        done = compare.run(scene, "-o", folder, "--quiet", *words)
        compare.demand(f"{folder}: {done.stderr.strip() or 'runs'}", done.returncode == 0)
    compare.judge("the same scene", 0, "3 tables", arguments=("--tolerance", "0"), one="whole", other="again")
    compare.judge("two threads", 0, one="whole", other="threads")
    compare.judge("both backends", 0, one="condensed", other="iterative")
    compare.judge("other friction", 2, "first: ", "largest differences by column", one="whole", other="rough")
    compare.judge("other times", 2, "only", one="whole", other="kept")


def main(program):
    compare = Compare(program)
    for family in (known, told, refused, runs):
        family(compare)
    shutil.rmtree(compare.folder)
    return 1 if compare.failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
