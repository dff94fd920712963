# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Folders of results: their tables, meshes, curves."""
from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import curves, optional
from .endings import ending_of
from .errors import AnalysisError, ConetactError, ResultError
from .scene_text import read_entries
from .tables import Table, read_events, read_table
from .vtu import VtuMesh, read_vtu

if TYPE_CHECKING:
    import tempfile


class Result:
    """A folder of results; tables are read when they are asked for.

    `changes` are the entries that were replaced, `error` is the exception of an exit code
    that is not 0. A folder that is there is read as its log ends: of a run that was interrupted
    or killed, or still goes on, the exit code is None, and `error` says so.

    >>> result = conetact.run(SCENE, {"Load push/Value": "0.2*t"}, folder="push")
    >>> result
    Result('push', exit code 0, 1 increments)
    >>> conetact.Result("push").increments["bottom_f_x"]
    array([-0.2])
    >>> conetact.run(SCENE, {"Load push/Value": "9*t"}, folder="slides", check=False).exit_code
    2
    >>> conetact.Result("slides").error
    AnalysisError("Increment 1 of 1 (t = 1): no equilibrium exists, body 'block' slides along (1, 0, 0): no friction could hold it.")
    """

    def __init__(self, folder: str | os.PathLike[str], changes: Mapping[str, Any] | None = None,
                 exit_code: int | None = None, error: ConetactError | None = None) -> None:
        self.folder, self.changes = Path(folder), dict(changes or {})
        self.exit_code, self.error = exit_code, error
        self.temporary: tempfile.TemporaryDirectory[str] | None = None  # that of the folder, which ends with this
        self._tables: dict[str, Table] = {}
        self._path: tuple[Table, tuple[str, float]] | None = None
        if not self.folder.is_dir():
            raise ResultError(f"There is no folder {self.folder}.")
        if error is None and not (self.folder / "used.prm").is_file():
            raise ResultError(f"{self.folder} holds no used.prm: is it a folder of results?")
        if exit_code is None:
            self._read_ending()

    def _read_ending(self) -> None:
        """What whoever has started the run was told."""
        if not (self.folder / "log.txt").is_file():
            self.error = ConetactError(f"{self.folder} holds no log.txt: how the run ended is not known.")
            return
        ending = ending_of(self.log)
        self.exit_code = ending.exit_code
        if self.exit_code is None:
            self.error = ConetactError(ending.sentence)
        elif self.exit_code != 0:
            self.error = AnalysisError(ending.sentence)
            self.error.result = self

    def __repr__(self) -> str:
        code = "unknown" if self.exit_code is None else self.exit_code
        return f"Result({str(self.folder)!r}, exit code {code}, {self._n_increments()} increments)"

    def _n_increments(self) -> int:
        try:
            return len(self.increments)
        except ResultError:
            return 0

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        try:
            names = [name for name in ("increment", "time", "open", "stick", "slip", "residual") if name in
                     (self.increments.dtype.names or ())]
            rows = [[f"{value:g}" for value in row] for row in self.increments[names][-8:].tolist()]
        except ResultError:
            names, rows = [], []
        head = "".join(f"<th>{name}</th>" for name in names)
        body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
        changes = "".join(f"<br>{escape(entry)} = {escape(str(value))}" for entry, value in self.changes.items())
        error = f"<br>{escape(str(self.error))}" if self.error else ""
        return f"<b>{escape(repr(self))}</b>{changes}{error}<table><tr>{head}</tr>{body}</table>"

    def table(self, name: str) -> Table:
        """Any table: `reactions`, `increments`, `history`, `refinement`.

        >>> conetact.run(SCENE).table("history")["largest_pressure_contact"]
        array(['bottom'], dtype='<U6')
        """
        if name not in self._tables:
            self._tables[name] = read_table(self.folder / f"{name}.csv")
        return self._tables[name]

    @property
    def reactions(self) -> Table:
        """A row for each contact node and increment.

        >>> conetact.run(SCENE).reactions["state"][:2]
        array(['slip', 'slip'], dtype='<U5')
        """
        return self.table("reactions")

    @property
    def increments(self) -> Table:
        """A row for each increment.

        >>> conetact.run(SCENE).increments["time"]
        array([1.])
        """
        return self.table("increments")

    @property
    def history(self) -> Table:
        """Largest displacement and pressure of each increment, displacements of the probes.

        >>> round(conetact.run(SCENE).history["largest_displacement"][-1], 6)
        0.000777
        """
        return self.table("history")

    @property
    def events(self) -> Table:
        """Changes of contact states along a load path, a row for each node.

        >>> conetact.run("parameter-files/pushed-block.prm").events[["from", "to"]][0]
        ('stick', 'slip-')
        """
        return self._load_path()[0]

    @property
    def outcome(self) -> tuple[str, float]:
        """How a load path ends, and the load parameter of that.

        >>> words, parameter = conetact.run("parameter-files/pushed-block.prm").outcome
        >>> words, round(parameter, 9)
        ('limit load: sliding', 0.5)
        """
        return self._load_path()[1]

    def _load_path(self) -> tuple[Table, tuple[str, float]]:
        if self._path is None:
            self._path = read_events(self.folder / "events.csv")
        return self._path

    @property
    def log(self) -> str:
        """What the program says about the run.

        >>> conetact.run(SCENE).log.startswith("Conetact")
        True
        """
        return self._text("log.txt")

    @property
    def entries(self) -> dict[str, str]:
        """Every value in force, of used.prm.

        >>> conetact.run(SCENE).entries["Bodies"]
        'block'
        """
        self._text("used.prm")
        entries = read_entries(self.folder / "used.prm")
        if "Dimension" not in entries:  # which every run writes
            raise ResultError(f"{self.folder / 'used.prm'} is empty or cut off: it was not written to its end. Run the scene again.")
        return entries

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space.

        >>> conetact.run(SCENE).dimension
        2
        """
        return int(self.entries["Dimension"])

    def _text(self, name: str) -> str:
        try:
            return (self.folder / name).read_text(errors="replace")
        except OSError:
            raise ResultError(f"{self.folder} holds no {name}: is it a folder of results?") from None

    def to_pandas(self, name: str = "increments") -> Any:
        """A table as a DataFrame of pandas.

        >>> conetact.run(SCENE).to_pandas("reactions")["state"].value_counts()["stick"]  # doctest: +PANDAS
        13
        """
        table = self.events if name == "events" else self.table(name)
        return optional.module("pandas", "to_pandas()").DataFrame(table)

    def to_pyvista(self, increment: int | None = None, kind: str = "solution") -> Any:
        """The bodies of an increment, by default the last one drawn, as a MultiBlock of pyvista.

        `kind`: "solution", or "surface" for surfaces with pressure and state of contact.

        >>> conetact.run(SCENE).to_pyvista()["block"]["von_mises"].max() > 0  # doctest: +PYVISTA
        True
        """
        pyvista = optional.module("pyvista", "to_pyvista()")
        files = self._files_of(increment, kind)
        return pyvista.MultiBlock({body: pyvista.read(str(file)) for body, file in files.items()})

    def plot(self, *columns: str, against: str = "time", increment: int | None = None, contact: str | None = None,
             axes: Any = None) -> Any:
        """Draws columns of the tables by matplotlib; returns the axes.

        Columns of increments and history are drawn over `against`, by default time; those of reactions along each
        contact, or the one named, in an increment, by default the last one. Without columns: forces of all contacts.

        >>> axes = conetact.run(SCENE).plot("pressure", against="x")  # doctest: +MATPLOTLIB
        >>> axes.get_ylabel()  # doctest: +MATPLOTLIB
        'pressure'
        """
        return curves.plot(self, columns, against, increment, contact, axes)

    def drawn_increments(self) -> list[int]:
        """Those with VTU files, but for 0, the undeformed bodies.

        >>> conetact.run(SCENE).drawn_increments()
        [1]
        """
        return sorted({increment for _, increment, _ in self._drawings("solution") if increment > 0})

    def bodies(self, increment: int) -> dict[str, VtuMesh]:
        """Meshes with displacements, stresses, contact by the names of bodies.

        >>> conetact.run(SCENE).bodies(1)["block"].arrays["displacement"].shape
        (231, 3)
        >>> conetact.run(SCENE, folder="drawn").bodies(99)
        Traceback (most recent call last):
        conetact.errors.ResultError: drawn holds no drawing of increment 99; there are 0, 1.
        """
        return {body: read_vtu(file) for body, file in self._files_of(increment, "solution").items()}

    def surfaces(self, increment: int) -> dict[str, VtuMesh]:
        """Their surfaces with pressure, traction, gap and state of contact.

        >>> sorted(conetact.run(SCENE).surfaces(1)["block"].arrays)[:2]
        ['contact_pressure', 'contact_traction']
        """
        return {body: read_vtu(file) for body, file in self._files_of(increment, "surface").items()}

    def _drawings(self, kind: str) -> Iterator[tuple[str, int, Path]]:
        """Bodies, increments and files, not those of pieces, which PVTU files join."""
        names = self._bodies_by_files()
        for file in sorted(self.folder.iterdir()):
            if match := re.fullmatch(kind + r"-(.+)-(\d{4,})\.p?vtu", file.name):
                yield names.get(match[1], match[1]), int(match[2]), file

    def _bodies_by_files(self) -> dict[str, str]:
        """Names of bodies by those in names of their files, which have _ in place of each byte of other letters."""
        names: dict[str, str] = {}
        for name in filter(None, map(str.strip, self.entries.get("Bodies", "").split(","))):
            plain = safe = re.sub(rb"[^A-Za-z0-9._-]", b"_", name.encode()).decode()
            number = 2
            while safe in names:
                safe, number = f"{plain}_{number}", number + 1
            names[safe] = name
        return names

    def _files_of(self, increment: int | None, kind: str) -> dict[str, Path]:
        found = list(self._drawings(kind))
        if not found:
            raise ResultError(f"{self.folder} holds no {kind}-*.vtu: run the scene with Output/VTU = 1.")
        asked = max(at for _, at, _ in found) if increment is None else increment
        files = {body: file for body, at, file in found if at == asked}
        if not files:
            drawn = ", ".join(map(str, sorted({at for _, at, _ in found})))
            raise ResultError(f"{self.folder} holds no drawing of increment {asked}; there are {drawn}.")
        return files
