#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Python package: scenes, meshes and fits, and that all of it is documented, typed and can be installed.

usage: check_package.py PROGRAM CASE

  doctests   each public function, method and property has an example, and all examples are right
  types      mypy finds no errors (skipped where it is not installed)
  scenes     shipped scenes are read, written and read by the program with the same values; typing errors get a sentence
  meshes     bodies of numpy arrays, meshio and pyvista give the same results as those of the program's own meshes
  results    tables, curves and pictures for pandas, pyvista and notebooks
  fits       values are found again, within bounds, and what cannot be found is told
  many       100 runs in a process that is loaded once
  notebooks  all cells run, and none holds what it has printed
  wheel      a wheel is made and installed, and finds the program (skipped without pip)
"""
import contextlib
import doctest
import importlib
import inspect
import io
import json
import os
import pkgutil
import shutil
import subprocess
import sys
import types
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parent.parent
sys.path += [str(TOP / "python")]
import conetact  # noqa: E402
from support.batch import Batch  # noqa: E402
from support.checks import run_families  # noqa: E402

SCENES = TOP / "parameter-files"
BLOCK = SCENES / "floating-block.prm"
MU = "Contact bottom/Friction coefficient"
OPTIONAL = {"PANDAS": "pandas", "PYVISTA": "pyvista", "MATPLOTLIB": "matplotlib"}
FLAGS = {doctest.register_optionflag(flag): module for flag, module in OPTIONAL.items()}


def is_there(module):
    return importlib.util.find_spec(module) is not None


def demand_sentence(laws, kind, words, call):
    try:
        call()
    except kind as error:
        laws.demand(f"{kind.__name__}: {error}", words in str(error))
        return
    laws.demand(f"{kind.__name__} with '{words}' is raised", False)


@contextlib.contextmanager
def working_folder(folder):
    """With the scenes where the source tree has them."""
    before = Path.cwd()
    folder.mkdir(exist_ok=True)
    (folder / "parameter-files").symlink_to(SCENES)
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


@contextlib.contextmanager
def loaded_once(laws, **options):
    """Runs do not start the program each time; that they can is shown by check_python.py."""
    before, batch = conetact.runs.execute, Batch(laws.program, **options)
    conetact.runs.execute = lambda words: batch.run(*words)
    try:
        yield
    finally:
        conetact.runs.execute = before
        batch.close()


def modules():
    return [importlib.import_module(f"conetact.{info.name}") for info in pkgutil.iter_modules(conetact.__path__)]


def public_things():
    """Functions, classes, their methods and properties, by name."""
    for name in conetact.__all__:
        thing = getattr(conetact, name)
        if inspect.isfunction(thing) or inspect.isclass(thing):
            yield name, thing
        for method, function in vars(thing).items() if inspect.isclass(thing) else ():
            if inspect.isfunction(getattr(function, "__func__", function)) and not method.startswith("_"):
                yield f"{name}.{method}", getattr(function, "__func__", function)
            if isinstance(function, property) and not method.startswith("_"):
                yield f"{name}.{method}", function


def doctests(laws):
    bare = [name for name, thing in public_things() if ">>>" not in (thing.__doc__ or "")]
    laws.demand(f"all have examples, but for {bare}", not bare)
    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner(verbose=False)
    with working_folder(laws.folder / "doctests"), loaded_once(laws, cwd=Path.cwd()):
        for module in modules():
            for test in finder.find(module, extraglobs={"conetact": conetact, "SCENE": str(BLOCK)}):
                skip_missing(test)
                said = io.StringIO()
                failed, _ = runner.run(test, out=said.write)
                if failed:
                    laws.demand(f"{test.name}:\n{said.getvalue()}", False)
    laws.demand(f"{runner.tries} examples", runner.tries > 80)


def skip_missing(test):
    """Examples with packages that are not installed."""
    for example in test.examples:
        for flag, module in FLAGS.items():
            if example.options.get(flag) and not is_there(module):
                example.options[doctest.SKIP] = True


def typed(laws):
    if not is_there("mypy"):
        print("  skipped: mypy is not installed (Debian: mypy)")
        return
    words = [sys.executable, "-m", "mypy", "--cache-dir", laws.folder / "mypy"]
    done = subprocess.run(words, cwd=TOP, capture_output=True, text=True)
    laws.demand(f"mypy: {done.stdout.strip()}{done.stderr.strip()}", done.returncode == 0)
    bare = [name for name, thing in public_things() if inspect.isfunction(thing) and
            "return" not in thing.__annotations__]
    laws.demand(f"all have type hints, but for {bare}", not bare)
    laws.demand("py.typed", (TOP / "python/conetact/py.typed").exists())


def scenes(laws):
    for file in sorted(SCENES.glob("*.prm")):
        demand_round_trip(laws, file)
    for name in ("stacked-blocks", "fretting-loop", "bracket"):  # the last two include a file and name a mesh
        quick = {"Time/Stages": "1 : 1"} if name == "fretting-loop" else {}
        file = SCENES / f"{name}.prm"
        first, second = conetact.run(file, quick), conetact.Scene.load(file).run(quick)
        laws.demand(f"{name}: the same results", first.entries.keys() == second.entries.keys() and
                    differing(first.entries, second.entries) <= {"File"} and
                    (first.folder / "reactions.csv").read_bytes() == (second.folder / "reactions.csv").read_bytes())
    made_in_python(laws)
    refused(laws)
    written(laws)


def demand_round_trip(laws, file):
    """Read, written elsewhere and read again; the program meshes it to the same sizes."""
    scene = conetact.Scene.load(file)
    copy = scene.save(laws.folder / file.name)
    again = conetact.Scene.load(copy)
    laws.demand(f"{file.name}: {len(scene)} entries", differing(scene, again) <= {"File"} and
                len(scene) == len(again) > 5)
    first, second = (laws.batch.run(f, "--dry-run") for f in (file, copy))
    laws.demand(f"{file.name}: the program reads the same", first.returncode == second.returncode == 0 and
                sizes(first.stdout) == sizes(second.stdout))


def differing(one, other):
    """Last parts of the paths of entries that differ."""
    return {path.split("/")[-1] for path in {**one, **other} if one.get(path) != other.get(path)}


def sizes(report):
    return [line for line in report.splitlines() if "scene" not in line and "estimate" not in line]


def distance(one, other):
    """Of reactions at the same places; nodes may have other numbers."""
    first, second = (np.sort(result.reactions, order="x")["r_n"] for result in (one, other))
    return np.abs(first - second).max() if len(first) == len(second) else np.inf


def block(**contact):
    scene = conetact.Scene(dimension=2, title="The floating block", units="any")
    scene.body("block", mesh=conetact.box((20, 10), (0, 0), (2, 1)), young=1000, poisson=.3)
    scene.obstacle("floor", shape="half space", normal=(0, 1))
    scene.contact("bottom", **{"slave": "block", "slave_ids": 2, "master": "floor", "friction": .5, **contact})
    scene.loading("weight", body="block", boundary_ids=3, kind="pressure", value="0.5 * t")
    scene.loading("push", body="block", boundary_ids=0, kind="pressure", value="0.4 * t")
    return scene


def made_in_python(laws):
    scene, shipped = block(), conetact.Scene.load(BLOCK)
    laws.demand(f"made in Python: {scene}", differing(scene, shipped) <= {"Kind", "Young modulus", "Shape"})
    laws.check("the same reactions", distance(scene.run(), conetact.run(BLOCK)), 0)
    laws.demand("check()", "231 nodes" in scene.check())
    other = scene.copy()
    del other["Contact bottom"]
    laws.demand("sections are deleted with their names", other["Contacts"] == "" and "Contact bottom" not in other and
                "Contact bottom" in scene and MU not in other and len(other) == len(scene) - 4)
    other.contact("side", slave="block", slave_ids=[0, 1], master="floor")
    other["Time/End"] = 3
    other["Time/Times"] = (1, 2)
    laws.demand("times stand in place of equal increments", "Time/End" not in other and other["Time/Times"] == "1, 2")
    laws.demand("lists", other["Contact side/Boundary ids"] == "0, 1" and other.get(MU, "none") == "none")
    html = block(friction="if(t < 1, 0, 0.2)")._repr_html_()
    frame = conetact.Scene()
    frame.body("beam", kind="frame", generator="line", arguments="0, 0 : 1, 0 : 2")
    for name in ("thick", "thin"):
        frame.section("beam", name, young=1, area=1)
    del frame["Body beam/Section thick"]
    laws.demand("sections of frames, too", frame["Body beam/Sections"] == "thin" and len(frame) == 8)
    laws.demand("a table for notebooks", "if(t &lt; 1, 0, 0.2)" in html and html.count("<tr>") == len(scene))
    laws.demand(f"a short repr: {scene}", len(repr(scene)) < 100)


def refused(laws):
    scene, wrong = block(), conetact.InputError
    demand_sentence(laws, wrong, "Did you mean 'Friction coefficient'", lambda: scene.update({MU + "s": 1}))
    demand_sentence(laws, wrong, "Did you mean 'bottom'", lambda: scene.update({"Contact botom/Reach": 1}))
    demand_sentence(laws, wrong, "Did you mean 'poisson_ratio'", lambda: scene.body("block", poison_ratio=.2))
    demand_sentence(laws, wrong, "no section 'Bod block'", lambda: scene.update({"Bod block/Kind": 1}))
    demand_sentence(laws, wrong, "# begins a comment", lambda: scene.update({"Load push/Value": "t # so"}))
    demand_sentence(laws, wrong, "cannot be used", lambda: scene.obstacle("a, b"))
    demand_sentence(laws, wrong, "type int", lambda: scene.body("other", mesh=3))
    demand_sentence(laws, wrong, "cannot be read", lambda: conetact.Scene.load(laws.folder / "none.prm"))
    demand_sentence(laws, wrong, "cannot be written", lambda: scene.save(laws.folder / "none" / "a.prm"))
    demand_sentence(laws, KeyError, "its default is '0'", lambda: scene["Contact bottom/Friction angle"])
    demand_sentence(laws, KeyError, "sets no Time", lambda: scene.__delitem__("Time"))
    before = dict(scene)
    demand_sentence(laws, wrong, "no entry 'frction'", lambda: scene.contact("second", frction=.1))
    laws.demand("a call that is refused adds nothing", dict(scene) == before)
    loop = laws.folder / "loop.prm"
    loop.write_text("include loop.prm\n")
    demand_sentence(laws, wrong, "include one another", lambda: conetact.Scene.load(loop))
    loop.write_text("set Dimension\n")
    demand_sentence(laws, wrong, "is no line of a scene", lambda: conetact.Scene.load(loop))


def written(laws):
    """Files are found from another folder; encodings, long lines and comments are read as the program reads them."""
    folder = laws.folder / "elsewhere"
    folder.mkdir()
    copy = conetact.Scene.load(SCENES / "bracket.prm").save(folder / "bracket.prm")
    named = conetact.Scene.load(copy)["Body bracket/Mesh/File"]
    laws.demand(f"a mesh is named from there: {named}", (folder / named).resolve() == SCENES / "bracket.msh")
    odd = laws.folder / "odd.prm"
    odd.write_bytes("\ufeffset Dimension = 2 # plane\r\n  SET Bodies = a,\\ # two\r\n b\r\nsubsection  Body a\r\n"
                    "set Kind\t= frame\r\nend\r\n".encode())
    read = dict(conetact.Scene.load(odd))
    laws.demand("odd files", read == {"Dimension": "2", "Bodies": "a, b", "Body a/Kind": "frame"})
    odd.write_bytes("# Größe\nset Dimension = 2\n".encode("latin-1"))
    laws.demand("Latin-1", conetact.Scene.load(odd).title == "Größe")
    odd.write_text(f"include {BLOCK}\nset Loads = weight\n")
    fewer = conetact.Scene.load(odd)
    laws.demand("loads that the including file does not name are left out", fewer["Loads"] == "weight"
                and "Load weight" in fewer and "Load push" not in fewer)


def square(n=(20, 10), size=(2, 1)):
    """Points and quadrilaterals of the floating block."""
    x, y = (np.linspace(0, length, count + 1) for length, count in zip(size, n))
    points = np.column_stack([axis.ravel() for axis in np.meshgrid(x, y)])
    first = (np.arange(n[1])[:, None] * (n[0] + 1) + np.arange(n[0])).ravel()
    return points, first[:, None] + np.array([0, 1, n[0] + 2, n[0] + 1])


SIDES = {"left": lambda x: x[:, 0] < 1e-9, "floor": lambda x: x[:, 1] < 1e-9, 3: lambda x: x[:, 1] > 1 - 1e-9}


def with_mesh(mesh):
    scene = block(slave_ids="floor")
    for entry in ("Generator", "Arguments"):
        del scene[f"Body block/Mesh/{entry}"]
    scene.body("block", mesh=mesh)
    scene.loading("push", boundary_ids="left")
    return scene


def demand_same(laws, what, mesh, bound=1e-12):
    """Reactions are those of the shipped scene."""
    laws.check(f"{what}: {conetact.mesh_of(mesh)}", distance(with_mesh(mesh).run(), conetact.run(BLOCK)), bound)


def meshes(laws):
    points, cells = square()
    mesh = conetact.Mesh(points, cells, boundary=SIDES)
    demand_same(laws, "numpy", mesh)
    demand_same(laws, "meshio, cell sets", stand_in_of_meshio(mesh, sets=True))
    demand_same(laws, "meshio, physical groups", stand_in_of_meshio(mesh, sets=False))
    if is_there("meshio"):
        mesh.save(laws.folder / "square.msh")
        import meshio
        with contextlib.redirect_stdout(io.StringIO()):
            read = meshio.read(laws.folder / "square.msh")
        demand_same(laws, "read by meshio itself", read)
    grid = stand_in_of_pyvista(mesh)
    scene = with_mesh(conetact.from_pyvista(grid))
    laws.demand("groups of pyvista are numbers", sorted(conetact.from_pyvista(grid).boundary) == [1, 2, 3])
    scene.contact("bottom", slave_ids=2)
    scene.loading("push", boundary_ids=1)
    laws.check("pyvista", distance(scene.run(), conetact.run(BLOCK)), 1e-12)
    saved = with_mesh(mesh).save(laws.folder / "meshed.prm")
    laws.demand("a saved scene has its mesh beside it", (laws.folder / "meshed-block.msh").exists() and
                len(conetact.run(saved).reactions) == 21)
    in_space(laws)
    of_second_degree(laws)
    with_groups(laws)
    refused_meshes(laws)


def stand_in_of_meshio(mesh, sets):
    """What meshio.read would give: cells and lines, in sets or with numbers of physical groups."""
    lines = [(name, rows) for name, faces in mesh.boundary.items() for _, rows in faces]
    cells = [types.SimpleNamespace(type="quad", data=mesh.cells[0][1])]
    cells += [types.SimpleNamespace(type="line", data=rows) for _, rows in lines]
    like = types.SimpleNamespace(points=mesh.points, cells=cells)
    if sets:
        like.cell_sets = {name: [None] * (i + 1) + [np.arange(len(rows))] + [None] * (len(lines) - i - 1)
                          for i, (name, rows) in enumerate(lines)}
    else:
        numbers = {name: i for i, (name, _) in enumerate(lines, 1) if isinstance(name, str)}
        like.field_data = {name: np.array([number, 1]) for name, number in numbers.items()}
        like.cell_data = {"gmsh:physical": [np.zeros(len(cells[0].data), int)] +
                          [np.full(len(rows), numbers.get(name, name)) for name, rows in lines]}
    return like


def stand_in_of_pyvista(mesh):
    """A grid with its cells in between the lines."""
    lines = [rows for faces in mesh.boundary.values() for _, rows in faces]
    kinds = np.concatenate([[3] * len(lines[0]), [9] * len(mesh.cells[0][1]), [3] * sum(map(len, lines[1:]))])
    numbers = [np.full(len(rows), i) for i, rows in enumerate(lines, 1)]
    tags = np.concatenate([numbers[0], np.zeros(len(mesh.cells[0][1]), int), *numbers[1:]])
    return types.SimpleNamespace(points=mesh.points, celltypes=kinds, cell_data={"gmsh:physical": tags},
                                 cells_dict={3: np.concatenate(lines), 9: mesh.cells[0][1]})


def pressed(mesh, **words):
    """A body in space on a floor, pressed by 1 in all."""
    scene = conetact.Scene(dimension=3)
    scene.body("block", mesh=mesh, young=1000, poisson=.3, **words)
    scene.obstacle("floor", normal=(0, 0, 1))
    scene.contact("bottom", slave="block", slave_ids="floor", master="floor", friction=.5)
    scene.loading("weight", body="block", boundary_ids="top", kind="pressure", value="t")
    return scene


CUBE = [(x, y, z) for z in (0., 1.) for y in (0., 1.) for x in (0., 1.)]
ENDS = {"floor": lambda x: x[:, 2] < 1e-9, "top": lambda x: x[:, 2] > 1 - 1e-9}


def in_space(laws):
    kinds = {"hexahedron": [(0, 1, 3, 2, 4, 5, 7, 6)], "voxel": [range(8)],
             "wedge": [(0, 1, 2, 4, 5, 6), (1, 3, 2, 5, 7, 6)],
             "tetra": [(0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7)]}
    for kind, cells in kinds.items():
        mesh = conetact.Mesh(CUBE, {kind: [list(cell) for cell in cells]}, boundary=ENDS)
        rows = pressed(mesh).run({"Output/VTU": 0}).reactions
        laws.check(f"{mesh}: the floor carries the load", abs(rows["r_n"].sum() - 1), 1e-12)
        laws.demand(f"{kind}: {len(rows)} nodes touch", len(rows) == 4)


def middles(points, cell, edges, faces=(), centre=False):
    """A cell with nodes in the middles of its edges, of faces and of all of it."""
    points = list(points)
    parts = [*edges, *faces, *([range(len(cell))] if centre else [])]
    new = [tuple(np.mean([points[cell[i]] for i in part], axis=0)) for part in parts]
    return points + new, [[*cell, *range(len(points), len(points) + len(new))]]


def of_second_degree(laws):
    """Nodes in the middle stand where VTK has them, and the program finds them on straight edges."""
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    faces = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 2, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7)]
    cell = (0, 1, 3, 2, 4, 5, 7, 6)
    cases = {"hexahedron20": middles(CUBE, cell, edges), "hexahedron27": middles(CUBE, cell, edges, faces, True),
             "tetra10": middles([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], (0, 1, 2, 3),
                                [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)])}
    for kind, (points, cells) in cases.items():
        boundary = dict(ENDS, top=ENDS["top"] if kind != "tetra10" else lambda x: x[:, 0] < 1e-9)
        scene = pressed(conetact.Mesh(points, {kind: cells}, boundary=boundary))
        report = scene.check()
        laws.demand(f"{kind}: {next(line for line in report.splitlines() if line.startswith('Body'))}",
                    "Q2" in report or "P2" in report)
        if kind != "tetra10":
            laws.check(f"{kind}: the floor carries the load", abs(scene.run().reactions["r_n"].sum() - 1), 1e-12)


def with_groups(laws):
    """Two materials in one body; numbers and names; cells in two groups."""
    points, cells = square()
    left = points[cells].mean(axis=1)[:, 0] < 1
    groups = {"soft": left, "hard": np.flatnonzero(~left), "all": range(len(cells))}
    mesh = conetact.Mesh(points, cells, boundary=SIDES, groups=groups)
    scene = with_mesh(mesh)
    scene.body("block", material_group="soft ; hard", young="1000 ; 1000", poisson="0.3 ; 0.3")
    laws.check("two equal materials", distance(scene.run(), conetact.run(BLOCK)), 1e-12)
    mixed = conetact.mesh_of(types.SimpleNamespace(
        points=[(0, 0), (1, 0), (1, 1), (0, 1), (2, 0)], cell_sets={"odd": [[0], [], [0]]},
        cells=[types.SimpleNamespace(type=kind, data=[row]) for kind, row in
               (("triangle", (1, 4, 2)), ("quad", (0, 1, 2, 3)), ("triangle", (0, 1, 2)))]))
    laws.demand(f"blocks of one kind are joined: {mixed}", mixed.groups["odd"].tolist() == [0, 1] and
                len(mixed.cells) == 2)


def refused_meshes(laws):
    points, cells = square((2, 1))
    for words, call in (("of shape (3,)", lambda: conetact.Mesh([1, 2, 3], cells)),
                        ("there are 0 to 5", lambda: conetact.Mesh(points, cells + 4)),
                        ("'cube' are not known", lambda: conetact.Mesh(points, cells, kind="cube")),
                        ("have 3 nodes; these have 4", lambda: conetact.Mesh(points, cells, kind="triangle")),
                        ("no kind of cell of dimension 2 with 5", lambda: conetact.Mesh(points, [[0, 1, 2, 3, 4]])),
                        ("whole numbers", lambda: conetact.Mesh(points, [[0., 1., 2.]])),
                        ("has no face", lambda: conetact.Mesh(points, cells, boundary={"far": lambda x: x[:, 0] > 9})),
                        ("'a' names (0, 4), which is no face", lambda: conetact.Mesh(points, cells, boundary={"a": [(0, 1), (0, 4)]})),
                        ("'c,d' cannot be used", lambda: conetact.Mesh(points, cells, boundary={"c,d": [(0, 1)]})),
                        ("'#' cannot be used", lambda: conetact.Mesh(points, cells, groups={"#": [0]})),
                        ("the cells 0 to 7", lambda: conetact.Mesh(points, cells, groups={"far": [0, 7]})),
                        ("Cells of a body", lambda: conetact.Mesh(points, {"quad": cells, "line": [(0, 1)]})),
                        ("cannot be written", lambda: conetact.Mesh(points, cells).save("/proc/none/a.msh"))):
        demand_sentence(laws, conetact.InputError, words, call)


def results(laws):
    result = conetact.run(BLOCK)
    laws.demand(f"a short repr: {result}", "exit code 0, 1 increments" in repr(result))
    slides = conetact.run(BLOCK, {MU: .3}, check=False)
    html = slides._repr_html_()
    laws.demand("tables for notebooks", "<th>slip</th>" in result._repr_html_())
    laws.demand("with what was changed and went wrong", "slides" in html and f"{MU} = 0.3" in html)
    curves(laws, result, slides)
    with missing("pandas", "pyvista", "matplotlib.pyplot"):
        for call in (result.to_pandas, result.to_pyvista, result.plot):
            demand_sentence(laws, conetact.ConetactError, "pip install", call)
    read = []
    grids = types.SimpleNamespace(read=lambda file: read.append(file) or Path(file).name, MultiBlock=dict)
    with instead_of("pyvista", grids):
        laws.demand("pyvista reads the files", result.to_pyvista() == {"block": "solution-block-0001.vtu"} and
                    result.to_pyvista(0, "surface") == {"block": "surface-block-0000.vtu"} and Path(read[0]).exists())
        demand_sentence(laws, conetact.ResultError, "there are 0, 1", lambda: result.to_pyvista(7))
        bare = conetact.run(BLOCK, {"Output/VTU": 0})
        demand_sentence(laws, conetact.ResultError, "Output/VTU", bare.to_pyvista)
    empty = laws.folder / "empty"
    empty.mkdir()
    for text in ("", "subsection Solver\nend\n"):
        (empty / "used.prm").write_text(text)
        for ask in (lambda: conetact.Result(empty).entries, lambda: conetact.Result(empty).dimension):
            demand_sentence(laws, conetact.ResultError, "used.prm is empty or cut off", ask)
    for wrong in (99, -1, "x"):
        for call in (result.bodies, result.surfaces):
            demand_sentence(laws, conetact.ResultError, f"increment {wrong}; there are 0, 1", lambda: call(wrong))
    demand_sentence(laws, conetact.ResultError, "Output/VTU", lambda: bare.bodies(1))
    with instead_of("pandas", types.SimpleNamespace(DataFrame=lambda table: table.dtype.names)):
        laws.demand("pandas takes tables", "r_n" in result.to_pandas("reactions") and "slip" in result.to_pandas())


def curves(laws, result, slides):
    if not is_there("matplotlib"):
        return
    import matplotlib
    matplotlib.use("Agg")
    axes = result.plot()
    laws.demand("forces of contacts", [line.get_label() for line in axes.lines] == ["bottom_f_x", "bottom_f_y"])
    axes = result.plot("pressure", against="x", contact="bottom", axes=axes)
    laws.demand("along a contact, on the same axes", len(axes.lines) == 3 and len(axes.lines[2].get_xdata()) == 21 and
                (np.diff(axes.lines[2].get_xdata()) > 0).all())
    axes = result.plot("largest_pressure", against="bottom_f_x")
    laws.demand("against each other", len(axes.lines[0].get_xdata()) == 1)
    wrong = conetact.ResultError
    demand_sentence(laws, wrong, "Did you mean 'pressure'", lambda: result.plot("presure", against="x"))
    demand_sentence(laws, wrong, "Did you mean 'bottom'", lambda: result.plot("pressure", against="x", contact="botom"))
    demand_sentence(laws, wrong, "no increment 5", lambda: result.plot("pressure", against="x", increment=5))
    demand_sentence(laws, wrong, "no increment 1", lambda: slides.plot("pressure", against="x"))
    matplotlib.pyplot.close("all")


@contextlib.contextmanager
def instead_of(name, module):
    """A module by this name; None: it is missing."""
    before = sys.modules.get(name)
    sys.modules[name] = module
    try:
        yield
    finally:
        if before is None:
            del sys.modules[name]
        else:
            sys.modules[name] = before


@contextlib.contextmanager
def missing(*names):
    with contextlib.ExitStack() as stack:
        for name in names:
            stack.enter_context(instead_of(name, None))
        yield


def fits(laws):
    def slips(result):
        return result.reactions["u_t1"]

    known = {MU: .75, "Body block/Material/Young modulus": 800.}
    target = slips(conetact.run(BLOCK, known))
    found = conetact.fit(BLOCK, {MU: .6, "Body block/Material/Young modulus": 1000.}, slips, target)
    laws.demand(f"{found}", found.converged and found.result.exit_code == 0 and
                found.history[-1] < 1e-6 * found.history[0])
    laws.check("two values are found", max(abs(found.values[name] / value - 1) for name, value in known.items()), 1e-6)
    bounded = conetact.fit(BLOCK, {MU: .5}, slips, target, bounds={MU: (.45, .6)},
                           changes={"Body block/Material/Young modulus": 800.})
    laws.demand(f"a bound holds: {bounded}", bounded.values[MU] == .6 and bounded.converged)
    noise = 1e-3 * np.abs(target).max() * np.random.default_rng(1).standard_normal(len(target))
    noisy = conetact.fit(BLOCK, {MU: .6}, slips, target + noise, changes={"Body block/Material/Young modulus": 800.})
    laws.check(f"standard errors hold the value: {noisy}", abs(noisy.values[MU] - .75) / noisy.errors[MU], 3)
    laws.demand("a table for notebooks", "standard error" in noisy._repr_html_())
    far = conetact.fit(BLOCK, {MU: .41}, slips, target, changes={"Body block/Material/Young modulus": 800.})
    laws.check("from beside the limit of equilibrium", abs(far.values[MU] - .75), 1e-5)
    refused_fits(laws, slips, target)


def refused_fits(laws, slips, target):
    def times(result):
        return result.increments["time"]

    wrong = conetact.InputError
    for kind, words, start, measure, numbers, options in (
            (wrong, "The target has 2 numbers", {MU: .6}, slips, [1, 2], {}),
            (conetact.AnalysisError, "slides", {MU: .3}, slips, target, {}),
            (wrong, "no value to start from", {}, slips, target, {}),
            (wrong, "bounds of 'b'", {MU: 1}, slips, target, {"bounds": {"b": (0, 1)}}),
            (wrong, "finite", {MU: .6}, lambda _: np.nan, 1, {}),
            (conetact.ConetactError, "does not change what is measured", {MU: .6}, times, [2.], {}),
            (wrong, "Did you mean", {MU + "s": .6}, slips, target, {})):
        demand_sentence(laws, kind, words, lambda: conetact.fit(BLOCK, start, measure, numbers, **options))


def many(laws):
    """One process does them all, and goes on for others."""
    values = np.linspace(.41, 1.2, 100)
    scene, starts, start = conetact.Scene.load(BLOCK), [], subprocess.Popen
    subprocess.Popen = lambda *words, **options: starts.append(words) or start(*words, **options)
    results = conetact.sweep(scene, {MU: values}, {"Output/VTU": 0}, progress=False)
    subprocess.Popen = start
    laws.demand(f"{len(starts)} process is started", len(starts) == 1)
    laws.demand("100 runs in order", [r.changes[MU] for r in results] == values.tolist() and
                not any(r.error for r in results))
    laws.check("each carries its load", max(abs(r.increments["bottom_f_x"][-1] + .4) for r in results), 1e-10)
    with conetact.Batch(processes=2) as batch:
        first = list(batch.results(str(BLOCK), [{MU: .3}, {MU: .6}]))
        second = list(batch.results(str(BLOCK), [{MU: .7}], laws.folder / "kept"))
        laws.demand("a batch goes on after a run that fails", [r.exit_code for r in first + second] == [2, 0, 0] and
                    second[0].folder == laws.folder / "kept" / "0001" and batch.process.poll() is None)
        batch.process.terminate()
        demand_sentence(laws, conetact.ConetactError, "ended", lambda: list(batch.results(str(BLOCK), [{MU: .5}])))


def notebooks(laws):
    os.environ["MPLBACKEND"] = "Agg"
    files = sorted((TOP / "python/notebooks").glob("*.ipynb"))
    laws.demand(f"{len(files)} notebooks", len(files) >= 2)
    for file in files:
        cells = [cell for cell in json.loads(file.read_text())["cells"] if cell["cell_type"] == "code"]
        laws.demand(f"{file.name}: {len(cells)} cells without output", not any(
            cell["outputs"] or cell["execution_count"] for cell in cells))
        with working_folder(laws.folder / file.stem), contextlib.redirect_stdout(io.StringIO()) as said:
            run_cells(cells, file.name)
        laws.demand(f"{file.name} runs: {said.getvalue().strip()[-200:]}", True)


def run_cells(cells, name):
    """One after the other, as a notebook does, in one scope."""
    scope = {"__name__": "__main__"}
    for i, cell in enumerate(cells, 1):
        exec(compile("".join(cell["source"]), f"{name}, cell {i}", "exec"), scope)


def wheel(laws):
    if not all(map(is_there, ("pip", "ensurepip", "setuptools", "wheel"))):
        print("  skipped: what makes wheels is not installed (Debian: python3-pip, python3-venv, python3-wheel)")
        return
    before = tracked()
    python = laws.folder / "venv/bin/python"
    quietly(laws, sys.executable, "-m", "venv", "--system-site-packages", laws.folder / "venv")
    tree = laws.folder / "tree"
    copy_of_tree(tree)
    quietly(laws, python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", tree)
    places = [path for path in (laws.folder / "venv").rglob("conetact*/**/*") if path.is_file() and path.suffix != ".pyc"
              and path.name != "direct_url.json" and str(tree).encode() in path.read_bytes()]
    laws.demand(f"no file of the installed package names the source tree: {places}", not places)
    where = "import conetact; print(conetact.executable())"
    said = said_by(laws, python, where, PATH="/nowhere")
    laws.demand("without a program it says where one could be", "neither on the PATH" in said and "CONETACT" in said)
    (laws.folder / "bin").mkdir()
    (laws.folder / "bin/conetact").symlink_to(laws.program)
    said = said_by(laws, python, where, PATH=str(laws.folder / "bin"))
    laws.demand(f"that of the PATH: {said}", said == [str(laws.folder / "bin/conetact")])
    said = said_by(laws, python, "import conetact, sys; print(conetact.executable()); "
                   f"print(len(conetact.run({str(BLOCK)!r}).reactions), conetact.__file__.startswith(sys.prefix))",
                   CONETACT=str(laws.program))
    laws.demand(f"what CONETACT names: {said}", said == [str(laws.program), "21", "True"])
    (python.parent / "conetact").symlink_to(laws.program)
    said = said_by(laws, python, where, PATH=str(laws.folder / "bin"))
    laws.demand(f"before that of the PATH, the one that was installed beside it: {said}", said == [str(python.parent / "conetact")])
    laws.demand("nothing is left in the source tree", tracked() == before)


def said_by(laws, python, program, **more):
    """Words that a program of Python prints, or its error, with more variables of the environment."""
    environment = {name: value for name, value in os.environ.items() if name not in ("CONETACT", "PYTHONPATH")} | more
    done = subprocess.run([python, "-c", program], cwd=laws.folder, env=environment, capture_output=True, text=True)
    return done.stdout.split() or done.stderr


def tracked():
    """Names of what pip could leave."""
    return sorted(path.name for folder in (TOP, TOP / "python", TOP / "python/conetact") for path in folder.iterdir()
                  if path.name != "__pycache__")


def copy_of_tree(tree):
    shutil.copytree(TOP / "python", tree / "python", ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt"):
        shutil.copy(TOP / name, tree / name)


def quietly(laws, *words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        laws.demand(f"{words}: {done.stdout[-500:]}{done.stderr[-500:]}", False)


def quick(case):
    def run(laws):
        with loaded_once(laws):
            case(laws)
    return run


CASES = {"doctests": doctests, "types": typed, "scenes": scenes, "meshes": meshes, "results": results, "fits": fits,
         "many": many, "notebooks": notebooks, "wheel": wheel}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[2] not in [*CASES, "all"]:
        sys.exit(__doc__)
    os.environ["CONETACT"] = str(Path(sys.argv[1]).resolve())
    sys.exit(run_families({name: quick(case) for name, case in CASES.items()}, sys.argv[1], sys.argv[2]))
