# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program: one, or many in one process that is loaded once."""
from __future__ import annotations

import contextlib
import itertools
import numbers
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import IO, TYPE_CHECKING, Any, Optional, Union

from .errors import AnalysisError, ConetactError, InputError, error_of
from .program import executable, execute
from .results import Result
from .values import Value, value_text

if TYPE_CHECKING:
    from .scenes import Scene

SceneLike = Union[str, "os.PathLike[str]", "Scene"]
Changes = Mapping[str, Value]
Temporary = Optional["tempfile.TemporaryDirectory[str]"]


@contextlib.contextmanager
def scene_file(scene: SceneLike) -> Iterator[str]:
    """A file that the program can read; of a Scene a temporary one with whole names of other files."""
    if isinstance(scene, (str, os.PathLike)):
        yield os.fspath(scene)
        return
    with tempfile.TemporaryDirectory(prefix="conetact-") as folder:
        yield str(scene._write(Path(folder) / "scene.prm", os.path.abspath))


def words_of(scene: str, changes: Changes, folder: str | os.PathLike[str]) -> list[str]:
    """What stands behind the program on its command line."""
    return [scene, "-q", "-o", str(folder), *(word for entry, value in changes.items() for word in
                                              ("-s", f"{entry}={value_text(value, entry.split('/')[-1])}"))]


def run(scene: SceneLike, changes: Changes | None = None, folder: str | os.PathLike[str] | None = None,
        check: bool = True) -> Result:
    """Runs a scene, a file or a Scene, with other values of some entries; returns its Result.

    Without `folder` the results are in a temporary one, which is removed with the Result. With
    check=False the analysis may end early: then the Result has exit code 2 and an `error`.

    >>> conetact.run(SCENE, {"Contact bottom/Friction coefficient": 0.6}).increments["slip"]
    array([5])
    """
    changes = dict(changes or {})
    temporary: Temporary = None if folder else tempfile.TemporaryDirectory(prefix="conetact-")
    with scene_file(scene) as file:
        done = execute(words_of(file, changes, folder or temporary.name))  # type: ignore[union-attr]
    result = result_of(changes, folder, temporary, done.returncode, done.stderr)
    if result.error and check:
        raise result.error
    return result


def check(scene: SceneLike) -> str:
    """Has the program read and mesh a scene without solving it; returns what it says of sizes, memory and time.

    >>> "21 contact nodes" in conetact.check(SCENE)
    True
    """
    with scene_file(scene) as file:
        done = execute([file, "--dry-run"])
    if error := error_of(done.returncode, done.stderr):
        raise error
    return done.stdout


def result_of(changes: Changes, folder: str | os.PathLike[str] | None, temporary: Temporary, code: int,
              said: str) -> Result:
    """The Result of a run that has ended, also early; other errors are raised."""
    error = error_of(code, said)
    early = error if isinstance(error, AnalysisError) else None
    if error is not early:
        raise error  # type: ignore[misc]
    result = Result(folder or temporary.name, changes, code, early)  # type: ignore[union-attr]
    result.temporary = temporary
    if early is not None:
        early.result = result
    return result


def combinations(lists: Mapping[str, Any], zipped: bool = False) -> list[dict[str, Any]]:
    """Values for each run of a sweep: all combinations, or the first values, the second ones, ...

    >>> conetact.combinations({"a": [1, 2], "b": "x"})
    [{'a': 1, 'b': 'x'}, {'a': 2, 'b': 'x'}]
    """
    names = list(lists)
    values = [[v] if isinstance(v, (str, numbers.Number)) else list(v) for v in lists.values()]
    if zipped and len({len(v) for v in values}) > 1:
        lengths = ", ".join(f"{name}: {len(v)}" for name, v in zip(names, values))
        raise InputError(f"Lists that are zipped must be of one length ({lengths}).")
    return [dict(zip(names, row)) for row in (zip(*values) if zipped else itertools.product(*values))]


def sweep(scene: SceneLike, lists: Mapping[str, Any], changes: Changes | None = None, zipped: bool = False,
          folder: str | os.PathLike[str] | None = None, processes: int | None = None,
          progress: bool | None = None) -> list[Result]:
    """Runs a scene for lists of values, on all cores, with a program that is loaded once.

    Results are in the order of the lists.
    `lists`: {"Contact bottom/Friction coefficient": [0.1, 0.2], ...}, in all combinations, or
    zipped; a text or a number is one value. `changes` are the same for all. With `folder` results
    stay, in folder/0001, ... A run without equilibrium has exit code 2 and an `error`, and is no
    reason to stop; wrong input is.

    >>> results = conetact.sweep(SCENE, {"Load push/Value": ["0.2*t", "0.4*t", "0.6*t"]}, {"Output/VTU": 0})
    >>> [result.exit_code for result in results]
    [0, 0, 2]
    """
    cases = [{**(changes or {}), **case} for case in combinations(lists, zipped)]
    if folder:
        Path(folder).mkdir(parents=True, exist_ok=True)
    bar = ProgressBar(len(cases), sys.stderr.isatty() if progress is None else progress)
    results = []
    try:
        with scene_file(scene) as file, Batch(processes) as batch:
            for result in batch.results(file, cases, folder):
                results.append(result)
                bar.advance()
        return results
    finally:
        bar.end()


class Batch:
    """The program, loaded once: lines for `conetact --batch -`, of which some are done side by side.

    >>> with conetact.Batch(processes=1) as batch:
    ...     [len(result.increments) for result in batch.results(SCENE, [{"Time/Increments": n} for n in (1, 2)])]
    [1, 2]
    """

    def __init__(self, processes: int | None = None) -> None:
        self.processes = processes or len(os.sched_getaffinity(0))
        self.files = tempfile.TemporaryDirectory(prefix="conetact-batch-")
        self.said = Path(self.files.name)
        words = [str(executable()), "--batch", "-", "--jobs", str(self.processes)]
        try:
            with open(self.said / "batch", "w") as errors:  # no pipe, which could be full
                self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors,
                                                text=True)
        except OSError as error:
            raise ConetactError(f"The program cannot be started: {error}") from None

    def __enter__(self) -> Batch:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def results(self, scene: str, cases: Sequence[Changes],
                folder: str | os.PathLike[str] | None = None) -> Iterator[Result]:
        """The Result of each case, as soon as those before it have ended, too.

        >>> with conetact.Batch() as batch:
        ...     [result.exit_code for result in batch.results(SCENE, [{}, {"Load push/Value": "0.6*t"}])]
        [0, 2]
        """
        folders = [(Path(folder) / f"{number:04}", None) if folder else
                   (None, tempfile.TemporaryDirectory(prefix="conetact-")) for number in range(1, len(cases) + 1)]
        lines = [words_of(scene, case, kept or other.name)  # type: ignore[union-attr]
                 for case, (kept, other) in zip(cases, folders)]
        for case, places, (code, said) in zip(cases, folders, self._outcomes(lines)):
            yield result_of(case, *places, code, said)

    def _outcomes(self, lines: Sequence[list[str]]) -> Iterator[tuple[int, str]]:
        """Exit code and errors of each line. A few lines are sent ahead, so that no pipe is ever full."""
        ahead = iter(enumerate(lines))
        for number, words in itertools.islice(ahead, 2 * self.processes):
            self._send(number, words)
        for i in range(len(lines)):
            code = self._next_code()
            for number, words in itertools.islice(ahead, 1):
                self._send(number, words)
            yield 128 - code if code > 128 else code, (self.said / str(i)).read_text(errors="replace")

    def _send(self, number: int, words: Iterable[str]) -> None:
        line = shlex.join(words).replace("\n", " ")
        with contextlib.suppress(BrokenPipeError):  # why it has ended is said when its answer is missing
            pipe(self.process.stdin).write(f"{line} 2> {shlex.quote(str(self.said / str(number)))}\n")
            pipe(self.process.stdin).flush()

    def _next_code(self) -> int:
        for row in pipe(self.process.stdout):
            if found := re.match(r" *(\d+) +(\d+)  ", row):
                return int(found[2])
        code = self.process.wait()
        said = (self.said / "batch").read_text(errors="replace")
        raise error_of(code, said) or ConetactError(f"The program ended within a batch. {said}".strip())

    def close(self) -> None:
        """Ends the program, and what it still runs.

        >>> conetact.Batch().close()
        """
        self.process.terminate()
        with contextlib.suppress(BrokenPipeError):
            self.process.communicate()
        self.files.cleanup()


def pipe(stream: IO[str] | None) -> IO[str]:
    assert stream is not None  # as it was opened
    return stream


class ProgressBar:
    """A line on standard error."""

    WIDTH = 40

    def __init__(self, total: int, visible: bool) -> None:
        self.total, self.visible, self.done = total, visible, 0
        self.draw()

    def advance(self) -> None:
        self.done += 1
        self.draw()

    def draw(self) -> None:
        if self.visible:
            full = self.WIDTH * self.done // max(self.total, 1)
            sys.stderr.write(f"\r[{'#' * full}{'.' * (self.WIDTH - full)}] {self.done} of {self.total}")
            sys.stderr.flush()

    def end(self) -> None:
        if self.visible:
            sys.stderr.write("\n")
