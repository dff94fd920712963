# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs scenes from Python and reads their results. Needs numpy only.

    import conetact
    result = conetact.run("parameter-files/floating-block.prm", {"Contact bottom/Friction coefficient": 0.6})
    print(result.increments["bottom_f_x"][-1], result.reactions["r_n"].max())

    for result in conetact.sweep("parameter-files/floating-block.prm",
                                 {"Load push/Value": ["0.2*t", "0.4*t", "0.6*t"]}):
        print(result.changes, result.exit_code, result.error)

Tables are structured arrays with the columns that doc/results.md lists. Errors of the program
are exceptions with its sentence, a class for each exit code: InputError (1),
AnalysisError (2), WriteError (3). The program is build/conetact of this repository, the one
that was installed with this package, or what the environment variable CONETACT names.
"""
import contextlib
import csv
import itertools
import numbers
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from .vtu import read_vtu

TOP = Path(__file__).resolve().parents[2]  # of the source tree, or share/conetact
INTEGERS = ("increment", "node", "substeps", "iterations", "open", "stick", "slip", "event")
TEXTS = ("contact", "state", "solver", "determinate", "from", "to", "largest_displacement_body",
         "largest_pressure_contact")


class ConetactError(Exception):
    """What the program says; also of one that is missing or was killed."""

    exit_code = None


class InputError(ConetactError):
    """Wrong input; nothing was written."""

    exit_code = 1


class AnalysisError(ConetactError):
    """No equilibrium, or not converged; `result` holds the increments before."""

    exit_code = 2
    result = None


class WriteError(ConetactError):
    """The results cannot be written."""

    exit_code = 3


ERRORS = {error.exit_code: error for error in (InputError, AnalysisError, WriteError)}


class ResultError(ConetactError):
    """A result is asked for what it does not hold."""


def executable():
    """The one that is named, that of the source tree, or the one that was installed with this package."""
    named = os.environ.get("CONETACT")
    places = [Path(named)] if named else [TOP / "build" / "conetact", TOP.parent.parent / "bin" / "conetact"]
    for program in places:
        if os.access(program, os.X_OK) and not program.is_dir():
            return program
    raise ConetactError(f"There is no program {places[0]}. " + (
        "The environment variable CONETACT names it; it must be an executable." if named else
        "Build it with ./conetact --version, or name another one in the environment variable CONETACT."))


def read_table(file):
    """A structured array; columns of counts are integers, of words texts, all others numbers."""
    try:
        with open(file, newline="") as stream:
            names, *rows = csv.reader(stream)
        kinds = {**dict.fromkeys(INTEGERS, int), **dict.fromkeys(TEXTS, str)}
        columns = [np.array([row[i] for row in rows], dtype=str).astype(kinds.get(name, float))
                   for i, name in enumerate(names)]
    except OSError:
        raise ResultError(f"{file} cannot be read: it is missing, or no result of the program.") from None
    except (ValueError, IndexError):
        raise ResultError(f"{file} is no table of the program.") from None
    table = np.empty(len(rows), [(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        table[name] = column
    return table


def read_entries(file):
    """Entries of a scene, or of used.prm, by their paths: "Contact bottom/Friction coefficient"."""
    entries, sections = {}, []
    for line in Path(file).read_text().splitlines():
        words = line.split("#")[0].strip()
        if words.startswith("subsection "):
            sections.append(words[11:].strip())
        elif words == "end":
            sections.pop()
        elif words.startswith("set "):
            name, _, value = words[4:].partition("=")
            entries["/".join([*sections, name.strip()])] = value.strip()
    return entries


class Result:
    """A folder of results; tables are read when they are asked for.

    `changes` are the entries that were replaced, `error` is the exception of an exit code
    that is not 0.
    """

    def __init__(self, folder, changes=None, exit_code=0, error=None):
        self.folder, self.changes = Path(folder), dict(changes or {})
        self.exit_code, self.error = exit_code, error
        self._tables = {}
        if not self.folder.is_dir():
            raise ResultError(f"There is no folder {self.folder}.")
        if error is None and not (self.folder / "used.prm").is_file():
            raise ResultError(f"{self.folder} holds no used.prm: is it a folder of results?")

    def __repr__(self):
        return f"Result({str(self.folder)!r}, changes={self.changes}, exit_code={self.exit_code})"

    def table(self, name):
        """Any table: `reactions`, `increments`, `history`, `refinement`."""
        if name not in self._tables:
            self._tables[name] = read_table(self.folder / f"{name}.csv")
        return self._tables[name]

    @property
    def reactions(self):
        return self.table("reactions")

    @property
    def increments(self):
        return self.table("increments")

    @property
    def history(self):
        """Largest displacement and pressure of each increment, displacements of the probes."""
        return self.table("history")

    @property
    def events(self):
        """Changes of contact states along a load path, a row for each node."""
        return self._load_path()[0]

    @property
    def outcome(self):
        """How a load path ends, and the load parameter of that."""
        return self._load_path()[1]

    def _load_path(self):
        if "events" not in self._tables:
            file = self.folder / "events.csv"
            try:
                *lines, last = file.read_text().splitlines()
                _, parameter, _, _, words = next(csv.reader([last]))[:5]
            except (OSError, ValueError):
                raise ResultError(f"{file} cannot be read: it is written with Solver/Method = load path.") from None
            names = [(name, int if name in INTEGERS else float if name == "parameter" else "U16")
                     for name in lines[0].split(",")]
            events = np.array([tuple(row) for row in csv.reader(lines[1:])], dtype=names)
            self._tables["events"] = events, (words, float(parameter))
        return self._tables["events"]

    @property
    def log(self):
        return self._text("log.txt")

    @property
    def entries(self):
        """Every value in force, of used.prm."""
        self._text("used.prm")
        return read_entries(self.folder / "used.prm")

    @property
    def dimension(self):
        return int(self.entries["Dimension"])

    def _text(self, name):
        try:
            return (self.folder / name).read_text()
        except OSError:
            raise ResultError(f"{self.folder} holds no {name}: is it a folder of results?") from None

    def drawn_increments(self):
        """Those with VTU files, but for 0, the undeformed bodies."""
        return sorted({increment for _, increment, _ in self._drawings("solution") if increment > 0})

    def bodies(self, increment):
        """Meshes with displacements and stresses by the names of bodies (letters that files cannot have are _)."""
        return {body: read_vtu(file) for body, at, file in self._drawings("solution") if at == increment}

    def surfaces(self, increment):
        """Their surfaces with pressure, traction, gap and state of contact."""
        return {body: read_vtu(file) for body, at, file in self._drawings("surface") if at == increment}

    def _drawings(self, kind):
        """Bodies, increments and files, not those of pieces, which PVTU files join."""
        for file in sorted(self.folder.iterdir()):
            if match := re.fullmatch(kind + r"-(.+)-(\d{4,})\.p?vtu", file.name):
                yield match[1], int(match[2]), file


def value_text(value):
    """A value as scenes write it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (tuple, list, np.ndarray)):
        return ", ".join(map(value_text, value))
    return str(value)


def run(scene, changes=None, folder=None, check=True):
    """Runs a scene with other values of some entries; returns its Result.

    Without `folder` the results are in a temporary one, which is removed with the Result. With
    check=False the analysis may end early: then the Result has exit code 2 and an `error`.
    """
    changes = dict(changes or {})
    temporary = None if folder else tempfile.TemporaryDirectory(prefix="conetact-")
    try:
        done = subprocess.run([executable(), *words_of(scene, changes, folder or temporary.name)], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True)
    except OSError as error:
        raise ConetactError(f"The program cannot be started: {error}") from None
    result = result_of(changes, folder, temporary, done.returncode, done.stderr)
    if result.error and check:
        raise result.error
    return result


def words_of(scene, changes, folder):
    """What stands behind the program on its command line."""
    return [str(scene), "-q", "-o", str(folder),
            *(word for entry, value in changes.items() for word in ("-s", f"{entry}={value_text(value)}"))]


def result_of(changes, folder, temporary, code, said):
    """The Result of a run that has ended, also early; other errors are raised."""
    error = error_of(code, said)
    if error and not isinstance(error, AnalysisError):
        raise error
    result = Result(folder or temporary.name, changes, code, error)
    result.temporary = temporary
    if error:
        error.result = result
    return result


def error_of(code, said):
    """None, or the exception of a process that has ended."""
    if code == 0:
        return None
    sentence = re.sub(r"^conetact: ", "", said.strip(), flags=re.M)
    if code in ERRORS:
        return ERRORS[code](sentence)
    return ConetactError(f"The program ended with code {code}: {sentence or 'it said nothing.'}")


def combinations(lists, zipped=False):
    """A dictionary of values for each run of a sweep: all combinations, or the first values, the second ones, ..."""
    names = list(lists)
    values = [[values] if isinstance(values, (str, numbers.Number)) else list(values) for values in lists.values()]
    if zipped and len({len(v) for v in values}) > 1:
        lengths = ", ".join(f"{name}: {len(v)}" for name, v in zip(names, values))
        raise InputError(f"Lists that are zipped must be of one length ({lengths}).")
    return [dict(zip(names, row)) for row in (zip(*values) if zipped else itertools.product(*values))]


def sweep(scene, lists, changes=None, zipped=False, folder=None, processes=None, progress=None):
    """Runs a scene for lists of values, on all cores, with a program that is loaded once; returns the Results in the order of the lists.

    `lists`: {"Contact bottom/Friction coefficient": [0.1, 0.2], ...}, in all combinations, or
    zipped; a text or a number is one value. `changes` are the same for all. With `folder` results stay, in folder/0001, ... A run
    without equilibrium has exit code 2 and an `error`, and is no reason to stop; wrong input is.
    """
    cases = [{**(changes or {}), **case} for case in combinations(lists, zipped)]
    if folder:
        Path(folder).mkdir(parents=True, exist_ok=True)
    bar = ProgressBar(len(cases), sys.stderr.isatty() if progress is None else progress)
    results = []
    try:
        with contextlib.closing(batch(scene, cases, folder, processes or len(os.sched_getaffinity(0)))) as runs:
            for ended in runs:
                results.append(result_of(*ended))
                bar.advance()
        return results
    finally:
        bar.end()


def batch(scene, cases, folder, jobs):
    """Changes, folder, exit code and words of each run, as soon as those before it have ended, too."""
    folders = [(Path(folder) / f"{number:04}", None) if folder else
               (None, tempfile.TemporaryDirectory(prefix="conetact-")) for number in range(1, len(cases) + 1)]
    with tempfile.TemporaryDirectory(prefix="conetact-") as said:
        lines = [shlex.join(words_of(scene, case, kept or other.name)).replace("\n", " ") + f" 2> {shlex.quote(f'{said}/{i}')}\n"
                 for i, (case, (kept, other)) in enumerate(zip(cases, folders))]
        (Path(said) / "lines").write_text("".join(lines))
        try:
            process = subprocess.Popen([executable(), "--batch", f"{said}/lines", "--jobs", str(jobs)],
                                       stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        except OSError as error:
            raise ConetactError(f"The program cannot be started: {error}") from None
        try:
            rows = filter(None, (re.match(r" *(\d+) +(\d+)  ", row) for row in process.stdout))
            i = -1
            for i, row in enumerate(rows):
                code = int(row[2])
                yield cases[i], *folders[i], 128 - code if code > 128 else code, (Path(said) / str(i)).read_text()
            if i + 1 < len(cases):
                raise error_of(process.wait(), process.stderr.read())
        finally:
            process.terminate()
            process.communicate()


class ProgressBar:
    """A line on standard error."""

    WIDTH = 40

    def __init__(self, total, visible):
        self.total, self.visible, self.done = total, visible, 0
        self.draw()

    def advance(self):
        self.done += 1
        self.draw()

    def draw(self):
        if self.visible:
            full = self.WIDTH * self.done // max(self.total, 1)
            sys.stderr.write(f"\r[{'#' * full}{'.' * (self.WIDTH - full)}] {self.done} of {self.total}")
            sys.stderr.flush()

    def end(self):
        if self.visible:
            sys.stderr.write("\n")
