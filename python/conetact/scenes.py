# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes as trees of entries: read, made, changed and written."""
from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from . import entries, meshes, runs
from .errors import InputError, MissingEntry, meant
from .scene_text import EQUAL_TIMES, TIME_LISTS, read_scene_file, scene_lines
from .values import Value, value_text

if TYPE_CHECKING:
    from .results import Result

MeshLike = Union[str, "os.PathLike[str]", Mapping[str, Any], "meshes.Mesh", Any]


class Scene(MutableMapping[str, str]):
    """A scene: a dictionary of texts by paths of entries, with methods that add bodies, contacts, ...

    Names and entries that the program does not know are refused at once. `title` and `units` become comments.

    >>> scene = conetact.Scene(dimension=2, title="A block on a table", units="N, mm, MPa")
    >>> scene.body("block", mesh=conetact.box((8, 4), (0, 0), (2, 1)), young=1000, poisson=0.3)
    >>> scene.obstacle("table", normal=(0, 1))
    >>> scene.contact("sole", slave="block", slave_ids=2, master="table", friction=0.3)
    >>> scene.loading("weight", body="block", boundary_ids=3, kind="pressure", value="0.5*t")
    >>> scene["Contact sole/Friction coefficient"] = 0.4
    >>> scene["Contact sole/Friction coefficient"]
    '0.4'
    >>> scene
    Scene(2D: bodies block; obstacles table; contacts sole; loads weight)
    >>> scene["Contact sole/Friction"] = 0.4
    Traceback (most recent call last):
    conetact.errors.InputError: There is no entry 'Contact sole/Friction'. Did you mean 'Friction angle'?
    """

    def __init__(self, dimension: int = 2, title: str = "", units: str = "") -> None:
        self.title, self.units, self.folder = title, units, Path.cwd()
        self._texts: dict[str, str] = {}
        self._meshes: dict[str, meshes.Mesh] = {}
        self["Dimension"] = dimension

    @classmethod
    def load(cls, file: str | os.PathLike[str]) -> Scene:
        """Reads a scene file, with all that it includes. (A load is added by `loading`.)

        >>> scene = conetact.Scene.load("parameter-files/floating-block.prm")
        >>> scene["Contact bottom/Friction coefficient"]
        '0.5'
        """
        scene = cls()
        texts, comments = read_scene_file(Path(file))
        scene._texts = texts
        scene.title = comments
        scene.folder = Path(file).absolute().parent
        return scene

    # a dictionary of entries

    def __getitem__(self, path: str) -> str:
        if path in self._texts:
            return self._texts[path]
        entry = entries.entry_at(path)
        raise MissingEntry(f"The scene does not set {path}; its default is '{entry.default}'.")

    def __setitem__(self, path: str, value: Value | meshes.Mesh) -> None:
        name = entries.entry_at(path).name
        self._check_section(path)
        self._meshes.pop(path, None)
        if isinstance(value, meshes.Mesh):
            self._meshes[path] = value
            value = f"{entries.file_name(path)}.msh"
        self._texts[path] = value_text(value, name)
        if path in TIME_LISTS and self._texts[path]:  # they stand in place of equal increments
            for other in EQUAL_TIMES:
                self._texts.pop(other, None)

    def __delitem__(self, path: str) -> None:
        """Deletes an entry, or a whole section such as "Contact joint" with its place in the list of names."""
        if path not in self._texts and not any(self._in_section(path)):
            raise MissingEntry(f"The scene sets no {path}.")
        for name in [path] if path in self._texts else list(self._in_section(path)):
            self._texts.pop(name)
            self._meshes.pop(name, None)
        self._unlist(path)

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def __len__(self) -> int:
        return len(self._texts)

    def __contains__(self, path: object) -> bool:
        """True of entries that are set, and of sections that have some."""
        return path in self._texts or any(self._in_section(str(path)))

    def copy(self) -> Scene:
        """A scene of its own with the same entries.

        >>> scene = conetact.Scene.load(SCENE)
        >>> other = scene.copy()
        >>> del other["Load push"]
        >>> scene["Loads"], other["Loads"]
        ('weight, push', 'weight')
        """
        other = Scene()
        other.title, other.units, other.folder = self.title, self.units, self.folder
        other._texts, other._meshes = dict(self._texts), dict(self._meshes)
        return other

    def names(self, kind: str) -> list[str]:
        """Names of the bodies, obstacles, contacts, supports or loads.

        >>> conetact.Scene.load(SCENE).names("loads")
        ['weight', 'push']
        """
        return [name for name in re.split(r"\s*,\s*", self._texts.get(kind.capitalize(), "").strip()) if name]

    def _in_section(self, section: str) -> Iterator[str]:
        return (path for path in self._texts if path.startswith(section + "/"))

    def _check_section(self, path: str) -> None:
        """A section of a thing that is in no list of names would be an error of the program."""
        kind, _, name = path.split("/")[0].partition(" ")
        if kind in entries.LISTS and "/" in path and name not in self.names(entries.LISTS[kind]):
            raise InputError(f"There is no {kind.lower()} '{name}'. {meant(name, self.names(entries.LISTS[kind]))}")

    def _enlist(self, kind: str, name: str) -> None:
        if not name.strip() or re.search(r"[,/#\n]", name):
            raise InputError(f"The name '{name}' cannot be used. Choose one without , / and #.")
        names = self.names(entries.LISTS[kind])
        if name not in names:
            self._texts[entries.LISTS[kind]] = ", ".join([*names, name])

    def _unlist(self, section: str) -> None:
        """Takes the name of a thing, or of a section of a frame, out of the list that it stands in."""
        owner, _, last = section.rpartition("/")
        kind, _, name = last.partition(" ")
        path = f"{owner}/Sections" if owner and kind == "Section" else entries.LISTS.get(kind, "") if not owner else ""
        if path in self._texts:
            names = re.split(r"\s*,\s*", self._texts[path])
            self._texts[path] = ", ".join(other for other in names if other != name)

    # what adds things; called again with a name, they change its entries

    def body(self, name: str, mesh: MeshLike = None, *, young: Value | None = None, poisson: Value | None = None,
             **words: Value) -> None:
        """Adds a body, or changes one. `mesh`: a file, a Mesh, a mesh of meshio or pyvista, or entries as box() makes.

        Other words are entries of the body, its mesh, frame and material: blanks are written _.

        >>> scene = conetact.Scene(dimension=3)
        >>> scene.body("plate", mesh="plate.msh", young=210e3, poisson=0.3, element="P2", scale=0.001)
        >>> scene["Body plate/Mesh/File"], scene["Body plate/Mesh/Scale"], scene["Body plate/Element"]
        ('plate.msh', '0.001', 'P2')
        """
        self._add("Body", name, {"young": young, "poisson": poisson, **words})
        if mesh is not None:
            self._set_mesh(f"Body {name}/Mesh", mesh)

    def _set_mesh(self, section: str, mesh: MeshLike) -> None:
        if isinstance(mesh, Mapping):
            for key, value in mesh.items():
                self[f"{section}/{key}"] = value
        elif isinstance(mesh, (str, os.PathLike)):
            self[f"{section}/File"] = os.fspath(mesh)
        else:
            self[f"{section}/File"] = meshes.mesh_of(mesh)

    def section(self, body: str, name: str, **words: Value) -> None:
        """Adds a cross section to a body that is a frame.

        >>> scene = conetact.Scene(dimension=2)
        >>> scene.body("beam", kind="frame", generator="line", arguments="0, 0 : 1, 0 : 10")
        >>> scene.section("beam", "bar", young=210e3, area=1, moment_of_inertia=0.1)
        >>> scene["Body beam/Sections"], scene["Body beam/Section bar/Area"]
        ('bar', '1')
        """
        path = f"Body {body}/Sections"
        names = [word.strip() for word in self.get(path, "").split(",") if word.strip()]
        self[path] = ", ".join([*names, *([] if name in names else [name])])
        self._set_words(f"Body {body}/Section {name}", words)

    def obstacle(self, name: str, **words: Value) -> None:
        """Adds a rigid obstacle, or changes one.

        >>> scene = conetact.Scene(dimension=3)
        >>> scene.obstacle("ball", shape="sphere", center=(0, 0, 2), radius=2, displacement=(0, 0, "-0.1*t"))
        >>> scene["Obstacle ball/Displacement"]
        '0 ; 0 ; -0.1*t'
        """
        self._add("Obstacle", name, words)

    def contact(self, name: str, *, slave: str | None = None, master: str | None = None, friction: Value | None = None,
                **words: Value) -> None:
        """Adds a contact of the body `slave` with the body or obstacle `master`, or changes one.

        `slave_ids` and `master_ids` are boundary ids of both, or names of groups.

        >>> scene = conetact.Scene.load("parameter-files/stacked-blocks.prm")
        >>> scene.contact("joint 2", friction=0.2, pairing="mortar")
        >>> scene["Contact joint 2/Friction coefficient"], scene["Contact joint 2/Pairing"]
        ('0.2', 'mortar')
        """
        kind = "obstacle" if master in self.names("Obstacles") else "master_body"
        self._add("Contact", name, {"slave": slave, kind: master, "friction": friction, **words})

    def support(self, name: str, *, body: str | None = None, **words: Value) -> None:
        """Adds a support, or changes one.

        >>> scene = conetact.Scene.load("parameter-files/stacked-blocks.prm")
        >>> scene.support("side", body="middle", boundary_ids=0, directions="x")
        >>> scene["Supports"]
        'ground, top, side'
        """
        self._add("Support", name, {"body": body, **words})

    def loading(self, name: str, *, body: str | None = None, kind: str | None = None, value: Value | None = None,
                **words: Value) -> None:
        """Adds a load, or changes one. A list of values has an expression for each component.

        >>> scene = conetact.Scene.load(SCENE)
        >>> scene.loading("gravity", body="block", kind="body force", value=(0, "-0.01*t"))
        >>> scene["Load gravity/Value"]
        '0 ; -0.01*t'
        """
        self._add("Load", name, {"body": body, "kind": kind, "value": value, **words})

    def _add(self, kind: str, name: str, words: Mapping[str, Value | None]) -> None:
        before = self._texts.get(entries.LISTS[kind])
        self._enlist(kind, name)
        try:
            self._set_words(f"{kind} {name}", words)
        except InputError:  # nothing is added by half
            self._texts.pop(entries.LISTS[kind])
            if before is not None:
                self._texts[entries.LISTS[kind]] = before
            raise

    def _set_words(self, section: str, words: Mapping[str, Value | None]) -> None:
        is_frame = words.get("kind", self._texts.get(f"{section}/Kind")) == "frame"
        given = {entries.path_of(section, word, is_frame): value for word, value in words.items() if value is not None}
        for path, value in given.items():
            self[path] = value

    # files and runs

    def text(self) -> str:
        """What a scene file says.

        >>> print(conetact.Scene(dimension=3, title="Nothing yet").text(), end="")
        # Nothing yet
        <BLANKLINE>
        set Dimension = 3
        """
        return self._text(self._texts)

    def _text(self, texts: Mapping[str, str]) -> str:
        comments = [line for line in (self.title, self.units and f"Units: {self.units}.") if line]
        return "\n".join([*scene_lines("\n".join(comments), texts), ""])

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Writes the scene, and meshes that were made in Python beside it; files that it names are found from there.

        >>> conetact.Scene.load(SCENE).save("copy.prm").name
        'copy.prm'
        >>> conetact.Scene.load("copy.prm") == conetact.Scene.load(SCENE)
        True
        """
        file = Path(file)
        folder = Path(os.path.realpath(file.absolute().parent))
        return self._write(file, lambda named: os.path.relpath(named, folder))

    def _write(self, file: Path, name_of: Callable[[str], str]) -> Path:
        texts = dict(self._texts)
        for path, text in self._texts.items():
            if path in self._meshes:
                texts[path] = f"{file.stem}-{text}"
                self._meshes[path].save(file.parent / texts[path])
            elif path.split("/")[-1] == "File" and text and not os.path.isabs(text):
                texts[path] = name_of(os.path.realpath(self.folder / text))
        try:
            file.write_text(self._text(texts), encoding="utf-8")
        except OSError as error:
            raise InputError(f"The scene cannot be written to {file}: {error.strerror}.") from None
        return file

    def run(self, changes: Mapping[str, Value] | None = None, folder: str | os.PathLike[str] | None = None,
            check: bool = True) -> Result:
        """Runs the scene as `conetact.run` does.

        >>> scene = conetact.Scene.load(SCENE)
        >>> scene.run({"Load push/Value": "0.2*t"}).increments["slip"]
        array([0])
        """
        return runs.run(self, changes, folder, check)

    def check(self) -> str:
        """Has the program read and mesh the scene without solving it; returns what it says of sizes, memory and time.

        >>> print(conetact.Scene.load(SCENE).check().splitlines()[2])
        Body block: 200 cells Q1, 231 nodes; Element = automatic: Q1, for quadrilaterals
        """
        return runs.check(self)

    # what is shown

    def __repr__(self) -> str:
        lists = [f"{kind.lower()} {', '.join(self.names(kind))}" for kind in entries.LISTS.values() if self.names(kind)]
        return f"Scene({self._texts.get('Dimension', '2')}D: {'; '.join(lists) or 'empty'})"

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        cell = "<td style='text-align:left'>"
        rows = "".join(f"<tr>{cell}{escape(path)}</td>{cell}{escape(text)}</td></tr>" for path, text in self.items())
        head = f"<b>{escape(self.title.splitlines()[0])}</b>" if self.title else escape(repr(self))
        return f"<details open><summary>{head}</summary><table>{rows}</table></details>"


def box(cells: Sequence[int], first: Sequence[float], second: Sequence[float]) -> dict[str, str]:
    """Entries of a mesh: a box between two corners; boundary ids are 0, 1 (x), 2, 3 (y) and 4, 5 (z).

    >>> conetact.box((8, 4), (0, 0), (2, 1))["Arguments"]
    '8, 4 : 0, 0 : 2, 1 : true'
    """
    return {"Generator": "subdivided_hyper_rectangle",
            "Arguments": " : ".join([*(value_text(row) for row in (cells, first, second)), "true"])}
