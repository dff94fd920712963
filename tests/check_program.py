#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the program behaves around its numerics: what it prints, refuses, removes.

usage: check_program.py PROGRAM CASE [COUNT]

  formats     a block in every format of meshes; bad ones, whose readers crash, never end or take all memory
  limits      long entries, many includes, open sections, little memory
  places      folders and files that cannot be written, links in their place
  locks       two runs into one folder
  checkpoints  bad checkpoints and tables of a run that is to be continued
  processes   processes that do not see each other are refused, and one speaks for all
  silence     nothing but the log on standard output, without contact too
  old-files   pictures of a longer run are removed, files of others stay
  loads       the log tells the resultant of each load
  boundaries  a dry run lists groups of cells and boundary ids
  directions  a body that slides does so where it is pushed
  condensers  what condenses bodies changes no sentence; --verify tells by how much
  first-contact  the manual, a starter scene that runs, includes, line ends, the closing screen
  pipes       scenes from pipes, devices, and readers that have enough
  scripts     what scripts of Gmsh save
  cautions    what is warned of
  batch       many runs of one program that is loaded once: exit codes, what is wrong in their file, signals
  numbers     COUNT meshes of shipped scenes and of deal.II's generators with
              other numbers (default 60): accepted or refused with a sentence,
              never a crash
"""
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

from run_errors import scene_of
from support import mesh_files

SCENES = Path(__file__).resolve().parent.parent / "parameter-files"
ERRORS = Path(__file__).resolve().parent / "errors"

BLOCK = """set Dimension = {dim}
set Bodies = block
set Supports = {supports}
set Loads = {loads}
set Obstacles = {obstacles}
set Contacts = {contacts}
subsection Body block
  subsection Mesh
    set Generator = subdivided_hyper_rectangle
    set Arguments = {cells} : {low} : {high} : true
  end
  subsection Material
    set Young modulus = 100
    set Poisson ratio = 0.3
  end
end
"""
FLOOR = """subsection Obstacle floor
  set Shape = half space
  set Normal = {up}
end
subsection Contact bottom
  set Body = block
  set Boundary ids = {bottom}
  set Obstacle = floor
  set Friction coefficient = 0.3
end
"""


# Generators of deal.II and arguments that they take.
GALLERY = (
    (2, "hyper_cube", "0 : 1 : true"), (3, "subdivided_hyper_cube", "2 : 0 : 1 : true"),
    (2, "hyper_rectangle", "0, 0 : 1, 2 : true"), (2, "subdivided_hyper_rectangle", "2, 3 : 0, 0 : 1, 1 : true"),
    (3, "subdivided_hyper_rectangle", "2, 3, 1 : 0, 0, 0 : 1, 1, 1 : true"),
    (2, "subdivided_hyper_rectangle", "0.5, 0.5 ; 0.2, 0.8 : 0, 0 : 1, 1 : true"),
    (2, "cheese", "2, 3"), (3, "cheese", "1, 1, 1"), (2, "general_cell", "0, 0 ; 1, 0 ; 0, 1 ; 1, 1 : false"),
    (2, "hyper_cross", "1, 2, 0, 1 : false"), (3, "hyper_cross", "1, 2, 0, 1, 1, 1 : false"),
    (2, "simplex", "0, 0 ; 1, 0 ; 0, 1"), (3, "simplex", "0, 0, 0 ; 1, 0, 0 ; 0, 1, 0 ; 0, 0, 1"),
    (2, "plate_with_a_hole", "0.4 : 1 : 2 : 2 : 1 : 1 : 0, 0 : 0 : 1 : 1 : 2 : true"),
    (3, "plate_with_a_hole", "0.4 : 1 : 2 : 2 : 1 : 1 : 0, 0, 0 : 0 : 1 : 1 : 2 : true"),
    (2, "channel_with_cylinder", "0.03 : 2 : 2 : false"), (3, "channel_with_cylinder", "0.03 : 2 : 2 : false"),
    (2, "enclosed_hyper_cube", "0 : 1 : 0.1 : true"), (2, "hyper_ball", "0, 0 : 1 : false"),
    (3, "hyper_ball", "0, 0, 0 : 1 : true"), (2, "quarter_hyper_ball", "0, 0 : 1"), (3, "half_hyper_ball", "0, 0, 0 : 1"),
    (3, "cylinder", "1 : 2"), (2, "truncated_cone", "1 : 0.5 : 2"), (3, "truncated_cone", "1 : 0.5 : 2"),
    (2, "hyper_L", "0 : 1 : true"), (2, "hyper_cube_slit", "0 : 1 : true"), (2, "hyper_shell", "0, 0 : 1 : 2 : 8 : true"),
    (3, "hyper_shell", "0, 0, 0 : 1 : 2 : 12 : true"), (2, "half_hyper_shell", "0, 0 : 1 : 2 : 4 : true"),
    (3, "half_hyper_shell", "0, 0, 0 : 1 : 2 : 5 : true"), (2, "quarter_hyper_shell", "0, 0 : 1 : 2 : 2 : true"),
    (3, "quarter_hyper_shell", "0, 0, 0 : 1 : 2 : 3 : true"), (3, "cylinder_shell", "2 : 1 : 1.5 : 8 : 2"),
    (2, "hyper_cube_with_cylindrical_hole", "0.4 : 1 : 1 : 2 : true"),
    (3, "hyper_cube_with_cylindrical_hole", "0.4 : 1 : 1 : 2 : true"),
    (2, "concentric_hyper_shells", "0, 0 : 0.2 : 1 : 2 : 0.1 : 8 : false"),
    (3, "concentric_hyper_shells", "0, 0, 0 : 0.2 : 1 : 2 : 0.1 : 12 : false"),
    (3, "moebius", "8 : 1 : 4 : 1"), (3, "torus", "3 : 1 : 6 : 6.28"))


def subsection(name, entries):
    return f"subsection {name}\n" + "".join(f"  set {k} = {v}\n" for k, v in entries.items()) + "end\n"


def load(name, kind, value, ids):
    return subsection(f"Load {name}", {"Body": "block", "Kind": kind, "Value": value, "Boundary ids": ids})


def block(dim, obstacles="", contacts="", supports="", loads=""):
    corners = {"cells": ", ".join("2" * dim), "low": ", ".join("0" * dim), "high": ", ".join("1" * dim)}
    return BLOCK.format(dim=dim, obstacles=obstacles, contacts=contacts, supports=supports, loads=loads, **corners)


def held(dim):
    """A block that is held at the bottom and pulled at the top, no contact."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    return (block(dim, supports="bottom", loads="pull") +
            subsection("Support bottom", {"Body": "block", "Boundary ids": bottom,
                                          "Directions": ", ".join("xyz"[:dim])}) +
            load("pull", "traction", " ; ".join(("0.5 * t", "1 * t", "0")[:dim]), top))


class Case:
    def __init__(self, program, folder):
        self.program, self.folder, self.faults = Path(program).resolve(), Path(folder), []
        self.result = self.folder / "result"

    def run(self, text, *arguments, starter=(), **options):
        scene = self.folder / "scene.prm"
        scene.write_text(text)
        return subprocess.run([*starter, self.program, scene, "-o", self.result, *arguments], cwd=self.folder,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", **options)

    def demand(self, what, holds, shown=""):
        print(("ok      " if holds else "FAILED  ") + what + (f": {shown}" if not holds else ""))
        if not holds:
            self.faults.append(what)

    def processes(self):
        for names in (("OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"), ("PMI_SIZE", "PMI_RANK")):
            for rank in "01":
                run = self.run(held(2), env={**os.environ, names[0]: "2", names[1]: rank})
                self.demand(f"{names[0]} = 2, rank {rank}: refused",
                            run.returncode == 1 and not self.result.exists(), run)
                self.demand("  one process says why", ("started 2 processes" in run.stderr) == (rank == "0")
                            and not run.stdout, run)

    def silence(self):
        for dim in (2, 3):
            run = self.run(held(dim), "--quiet")
            self.demand(f"{dim}D, loads and no contact: solved", run.returncode == 0, run.stderr)
            self.demand("  nothing is printed", run.stdout == run.stderr == "", run.stdout + run.stderr)

    def old_files(self):
        self.run(held(2), "-s", "Time/Increments=3")
        (self.result / "solution-notes.vtu").write_text("mine")
        self.run(held(2), "-s", "Time/Increments=2")
        left = sorted(p.name for p in self.result.glob("*.vtu"))
        self.demand("pictures of the shorter run and what is not ours",
                    left == [*(f"solution-block-000{k}.vtu" for k in range(3)), "solution-notes.vtu",
                             *(f"surface-block-000{k}.vtu" for k in range(3))], left)

    def loads(self):
        for dim, resultant in ((2, "(0.5, 1, 0) at t = 1, on 3 nodes"), (3, "(0.5, 1, 0) at t = 1, on 9 nodes")):
            run = self.run(held(dim), "--dry-run")
            self.demand(f"{dim}D: resultant of a traction", f"Load pull: resultant {resultant}" in run.stdout, run.stdout)
        text = held(2).replace("traction", "nodal force").replace("0.5 * t ; 1 * t", "0 ; -1")
        run = self.run(text, "--dry-run")
        self.demand("a nodal force acts on each node",
                    "Load pull: resultant (0, -3, 0) at all times, on 3 nodes" in run.stdout, run.stdout)

    def boundaries(self):
        """A dry run lists what a drawing numbers: groups of cells, boundary ids with area, shape and place."""
        geo = self.folder / "two parts.geo"
        geo.write_text('SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\nCylinder(2) = {.5, .5, 1, 0, 0, 1, .25};\n')
        run = self.run(self.on_mesh(3, "two parts.geo\n    set Size = 0.25"), "--dry-run")
        self.demand("groups of cells", "; groups of its cells: 1, 2" in run.stdout, run.stdout)
        for line in (r"boundary id 5: area 1, plane with normal \(0, 0, -1\), from \(0, 0, 0\) to \(1, 1, 0\)",
                     r"boundary id 7: area 1\.[45]\d*, not plane, from \(0.25, \S* 1\) to \(0.75, \S* 2\)"):
            self.demand(line, re.search("^Body block, " + line + "$", run.stdout, re.M), run.stdout)

    def directions(self):
        """Pushed beyond friction in each direction, as the slave and as the master of the contact."""
        for dim in (2, 3):
            up, ids = (0, 1, 0)[:dim] if dim == 2 else (0, 0, 1), (2, 3) if dim == 2 else (4, 5)
            for axis in range(dim - 1):
                for sign in (1, -1):
                    push = [0.0] * dim
                    push[axis], push[dim - 1] = sign * .5, -1
                    expected = [0] * 3
                    expected[axis] = sign
                    floor = FLOOR.format(up=", ".join(map(str, up)), bottom=ids[0])
                    pushed = load("push", "traction", " ; ".join(f"{p} * t" for p in push), ids[1])
                    self.slides(f"{dim}D, {expected}, on an obstacle", expected,
                                block(dim, "floor", "bottom", loads="push") + floor + pushed)
                    self.slides(f"{dim}D, {expected}, master of a fixed body", expected,
                                self.on_a_mat(dim, ids) + pushed)

    def on_a_mat(self, dim, ids):
        mat = (", ".join("2" * dim), ", ".join(["0"] * (dim - 1) + ["-1"]), ", ".join(["1"] * (dim - 1) + ["0"]))
        text = block(dim, contacts="bottom", supports="under", loads="push").replace("block\n", "block, mat\n", 1)
        body = text[text.index("subsection Body block"):].replace("Body block", "Body mat")
        body = re.sub(r"Arguments = .*", "Arguments = {} : {} : {} : true".format(*mat), body)
        return (text + body +
                subsection("Support under", {"Body": "mat", "Boundary ids": ids[0], "Directions": ", ".join("xyz"[:dim])}) +
                subsection("Contact bottom", {"Body": "mat", "Boundary ids": ids[1], "Master body": "block",
                                              "Master boundary ids": ids[0], "Friction coefficient": 0.3,
                                              "Pairing": "node to face"}))

    def slides(self, name, direction, text):
        run = self.run(text, "--quiet")
        said = re.search(r"body 'block' slides along \(([^)]*)\)", run.stderr)
        found = [round(float(x)) for x in said[1].split(",")] if said else run.stderr
        self.demand(name, run.returncode == 2 and found == direction, found)

    def condensers(self):
        """A member of a frame that moves freely, bodies that are compared."""
        frame = scene_of(ERRORS / "frames.txt", "mechanism")
        expected = self.run(frame).stderr
        self.demand("MUMPS finds what moves freely", "Some part of a body can move" in expected, expected)
        for name in ("amesos_klu", "amesos_mumps", "amesos_lapack"):
            run = self.run(frame, "-s", f"Solver/Condensation={name}")
            self.demand(f"{name} says the same", run.returncode == 1 and run.stderr == expected
                        and not self.result.exists(), run.stderr)
        stack = (SCENES / "stacked-blocks.prm").read_text()
        for name, other in (("mumps", "amesos_klu"), ("amesos_lapack", "mumps")):
            run = self.run(stack, "--verify", "-s", f"Solver/Condensation={name}")
            said = re.findall(r"^verify: condensed stiffness of body '(\w+)', (\w+) against (\w+): "
                              r"largest relative difference (\S+)$", run.stdout, re.M)
            self.demand(f"--verify tells of each body, {name}", run.returncode == 0 and
                        [s[:3] for s in said] == [(b, name, other) for b in ("lower", "middle", "upper")] and
                        all(0 <= float(s[3]) < 1e-12 for s in said), run)
            log = (self.result / "log.txt").read_text()
            self.demand("  so does the log", log.count("verify: ") == 3 and f"condensation by {name}" in log, log)
        run = self.run(held(2), "--verify")
        self.demand("nothing to verify without contacts", run.returncode == 0 and
                    "verify: no node may touch anything" in run.stdout, run)

    def first_contact(self):
        """What a new user types first."""
        def say(*words):
            return subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True)
        manual = say("--parameters")
        self.demand("--parameters alone prints the manual", manual.returncode == 0 and
                    all(f"\n## {name}\n" in manual.stdout for name in ("Body NAME/Material", "Body NAME/Section NAME", "Contact NAME", "Solver",
                                                                     "Output"))
                    and "**Torsion constant**" in manual.stdout and "* **Sections**:" in manual.stdout, manual.stdout[:200] + manual.stderr)
        new = say("--new", "mine")
        self.demand("--new writes a scene", new.returncode == 0 and (self.folder / "mine.prm").exists(), new.stderr)
        run = say("mine.prm")
        self.demand("  which runs", run.returncode == 0, run.stderr)
        lines = run.stdout.splitlines()
        for start in ("increment 20 of 20, t = 2: ", "contact bottom: force (", "supports: force (",
                      "largest displacement: ", "largest pressure: ", "probe edge: displacement (0.3, -0.1, 0)",
                      "Results are in output/mine: increments.csv, reactions.csv, history.csv, scene.pvd, log.txt"):
            self.demand(f"  the last screen says '{start}'", any(line.startswith(start) for line in lines), run.stdout)
        self.demand("  in about ten lines", len(lines) - next(
            (i for i, line in enumerate(lines) if line.startswith("increment 20")), 0) <= 11, run.stdout)
        nowhere = say("--new", "none/mine")
        self.demand("--new in no folder: nothing of the disk", nowhere.returncode == 3 and "make its folder" in nowhere.stderr
                    and "disk space" not in nowhere.stderr, nowhere.stderr)
        again = say("--new", "mine.prm")
        self.demand("  and is never overwritten", again.returncode == 1 and "exists already" in again.stderr, again.stderr)
        (self.folder / "below").mkdir()
        (self.folder / "below" / "other.prm").write_bytes(
            "# gr\xfc\xdfe\r\ninclude ../mine.prm\r\nsubsection Contact bottom\r\n  set Friction coefficient = 0\r\nend\r\n"
            .encode("latin-1"))
        run = say("below/other.prm", "-o", "result")
        self.demand("an included scene is changed behind the include, with line ends of Windows and Latin-1",
                    run.returncode == 0 and re.search(r"contact bottom: force \((\S+),", run.stdout)[1] == "0", run)
        (self.folder / "below" / "other.prm").write_text("include ../mine.prm\nsubsection Contact bottom\n  set Fiction = 0\nend\n")
        run = say("below/other.prm", "-o", "result")
        self.demand("mistakes are told with their own file and line",
                    "below/other.prm, line 3: there is no entry 'Fiction' in 'Contact bottom'" in run.stderr, run.stderr)
        text = (self.folder / "mine.prm").read_text()
        (self.folder / "mine.prm").write_text(text.replace("Poisson ratio = 0.3", "Poisson ratio = 0,3"))
        line = text[:text.index("Poisson ratio")].count("\n") + 1
        (self.folder / "below" / "other.prm").write_text("include ../mine.prm\n")
        run = say("below/other.prm", "-o", "result")
        self.demand("  those of an included file with that file",
                    f"mine.prm, line {line}: Body 'block', Material/Poisson ratio: '0,3' has a comma" in run.stderr, run.stderr)

    def pipes(self):
        """A scene that is no file."""
        def fed(text):
            return subprocess.run([self.program, "/dev/stdin", "-o", self.result], cwd=self.folder, input=text,
                                  capture_output=True, text=True)
        run = fed(held(2))
        self.demand("a scene through a pipe", run.returncode == 0 and (self.result / "increments.csv").exists(), run.stderr)
        run = fed(held(2).replace("Young modulus = ", "Young modulus = -"))
        self.demand("  its mistakes are told with their line", run.returncode == 1 and
                    re.search(r"/dev/stdin, line \d+: Body 'block', Material/Young modulus: -", run.stderr), run.stderr)
        run = subprocess.run([self.program, "/dev/zero"], cwd=self.folder, capture_output=True, text=True)
        self.demand("a device without end", run.returncode == 1 and "it is a device" in run.stderr, run.stderr)
        for words in (["--help"], ["--parameters"], ["--schema"]):
            for signals in (True, False):  # as shells start programs, and as others do
                reading, writing = os.pipe()
                os.close(reading)
                run = subprocess.run([self.program, *words], stdout=writing, stderr=subprocess.PIPE, text=True, restore_signals=signals)
                os.close(writing)
                self.demand(f"nobody reads {words[0]}: it ends quietly", not run.stderr and run.returncode in ((0,) if not signals else
                            (0, -signal.SIGPIPE)), run)

    def scripts(self):
        """Scripts of Gmsh write nothing beside themselves."""
        script = (ERRORS / "files" / "plate.geo").read_text()
        scene = (ERRORS / "meshes.prm").read_text().replace("block.inp", "plate.geo")
        (self.folder / "plate.prm").write_text(scene)
        for end in ("\n", ""):
            (self.folder / "plate.geo").write_text(script + 'Save "plate.step";' + end)
            run = subprocess.run([self.program, "plate.prm", "--dry-run"], cwd=self.folder, capture_output=True, text=True)
            self.demand("a script that saves a drawing, dry", run.returncode == 0 and not list(self.folder.glob("*.step")), run)
            run = subprocess.run([self.program, "plate.prm", "-o", self.result], cwd=self.folder, capture_output=True, text=True)
            self.demand("  and in a run", run.returncode == 0 and not list(self.folder.glob("*.step")), run)
        (self.folder / "plate.geo").write_text(script.replace("Box(1) =", "Bocks(1) =") + 'Save "plate.step";\n')
        run = subprocess.run([self.program, "plate.prm"], cwd=self.folder, capture_output=True, text=True)
        self.demand("  its mistakes are told with its own place", run.returncode == 1 and "Gmsh says: " in run.stderr
                    and tempfile.gettempdir() + "/conetact-" not in run.stderr.replace(str(self.folder), ""), run.stderr)

    def cautions(self):
        """What is possible and hardly meant."""
        for name, change, words in (
                ("bolt-preload", "Contact cut/Preload locked from=99", "Contact 'cut', Preload locked from: it is never locked"),
                ("block-press-shear", "Obstacle floor/Displacement=0 ; 0 ; 0.01*(1 - t)",
                 "Obstacle 'floor', Displacement: it is (0, 0, 0.01) at t = 0"),
                ("block-press-shear", "Support top/Displacement=0 ; 0 ; -0.01*(1 + t)",
                 "Support 'top', Displacement: it is -0.01 at")):
            run = subprocess.run([self.program, SCENES / f"{name}.prm", "--dry-run", "-s", change], cwd=self.folder,
                                 capture_output=True, text=True)
            self.demand(f"{name} with {change}: warned", f"\nwarning: {words}" in run.stdout, run.stdout + run.stderr)

    def refuses(self, what, run, words, code=1):
        lines = run.stderr.splitlines()
        self.demand(what, run.returncode == code and len(lines) == 1 and lines[0].startswith("conetact: ")
                    and words in lines[0], run)

    def on_mesh(self, dim, file, has_ids=True):
        """A block of a file, pressed on a floor."""
        axis, up = "xyz"[dim - 1], ", ".join("0" * (dim - 1) + "1")
        text = block(dim, "floor", "bottom", loads="top") + FLOOR.format(up=up, bottom=2) + load("top", "pressure", "t", 3)
        mesh = f"set File = {file}\n" + ("" if has_ids else
                                        f"    set Boundary ids = 2: {axis} < 1e-9 ; 3: {axis} > 1 - 1e-9\n")
        return re.sub(r"set Generator.*\n *set Arguments.*\n", mesh, text)

    def formats(self):
        sizes = {}
        for name, (extension, write, dims, has_ids) in mesh_files.MESHES.items():
            for dim in dims:
                file = self.folder / f"{name.replace(' ', '-')}-{dim}.{extension}"
                file.write_bytes(mesh_files.in_bytes(write(mesh_files.Block(dim))))
                run = self.run(self.on_mesh(dim, file, has_ids), "--dry-run")
                told = re.findall(r"(\d+ (?:nodes|cells|contact nodes|dofs))", run.stdout)
                sizes.setdefault(dim, told)
                self.demand(f"{name} in {dim}D", run.returncode == 0 and told and told == sizes[dim], run)
        for name, (extension, write, words) in BAD_MESHES.items():
            file = self.folder / f"bad.{extension}"
            file.write_bytes(mesh_files.in_bytes(write(mesh_files.Block(2))))
            start = time.monotonic()
            run = self.run(self.on_mesh(2, file, extension not in ("xda", "dat")), preexec_fn=little_memory)
            self.refuses(f"{name}", run, words)
            self.demand("  soon, and nothing is written", time.monotonic() - start < 60 and not self.result.exists())

    def limits(self):
        for name, change in (
                ("an entry of digits", ("Young modulus = 100", "Young modulus = " + "1" * 30000)),
                ("  of letters", ("Young modulus = 100", "Young modulus = " + "x" * 30000)),
                ("  of brackets", ("Young modulus = 100", "Young modulus = " + "(" * 30000)),
                ("  a name", ("Body = block", "Body = " + "b" * 30000)),
                ("  a list", ("Directions = x, y", "Directions = " + "x, " * 30000))):
            self.refuses(f"{name}, 30,000 of them", self.run(held(2).replace(*change), timeout=20), "")
        for name, lines in (("open sections", "subsection a\n" * 100000), ("lines", "\n" * 2000000),
                            ("sections that end", "subsection a\nend\n" * 100000)):
            self.refuses(f"very many {name}", self.run(lines + held(2), timeout=30, preexec_fn=little_memory), "")
        deep = "/".join(["a"] * 10000)
        self.refuses("an option with many sections", self.run(held(2), "-s", f"{deep}=1", timeout=20), "Section/Entry=value")
        for k in range(26):
            (self.folder / f"twice{k}.prm").write_text(f"include twice{k + 1}.prm\n" * 2)
        (self.folder / "twice26.prm").write_text("# end\n")
        self.refuses("includes that double 26 times", self.run("include twice0.prm\n", timeout=20), "more than 1000 files")
        for k in range(1000):
            (self.folder / f"deep{k}.prm").write_text(f"include deep{k + 1}.prm\n")
        self.refuses("1,000 includes inside of each other", self.run("include deep0.prm\n", timeout=20), "more than 50 files")
        for megabytes, code in ((600, 1), (660, 1)):
            run = self.run(held(2), "--dry-run", env={k: v for k, v in os.environ.items() if "NUM_THREADS" not in k}, timeout=60,
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20,) * 2))
            self.refuses(f"{megabytes} MB of memory", run, "ulimit -v", code)
        for value in ("", "many", "0"):
            run = self.run(held(2), "--dry-run", env={**os.environ, "DEAL_II_NUM_THREADS": value})
            self.demand(f"DEAL_II_NUM_THREADS={value}", run.returncode == 0, run)

    def places(self):
        os.symlink("loop", self.folder / "loop")
        for name, folder in (("a loop of links", "loop"), ("a loop of links above it", "loop/below"), ("a name that is too long", "n" * 300),
                             ("a path that is too long", "/".join(["n" * 200] * 30)), ("a file above it", "scene.prm/below")):
            self.refuses(f"results in {name}", self.run(held(2), "-o", folder), "-o", 3)
            self.refuses("  and a run from there", self.run(held(2), "--restart", folder), "--restart")
        for words in (("--parameters",), ("--help",), ("--version",), ("scene.prm", "--parameters"), ("scene.prm", "--dry-run")):
            with open("/dev/full", "w") as full:
                run = subprocess.run([self.program, *words], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True)
            self.refuses(f"{' '.join(words)} > /dev/full", run, "Standard output", 3)
        self.refuses("an empty name", subprocess.run([self.program, ""], cwd=self.folder, capture_output=True, text=True), "empty")
        below = self.folder / "below"
        below.mkdir()
        (below / "...prm").write_text(held(2))
        run = subprocess.run([self.program, "...prm"], cwd=below, capture_output=True, text=True)
        self.refuses("a scene that is called ...prm", run, "Name one with -o")
        self.demand("  nothing is written", [p.name for p in below.iterdir()] == ["...prm"])
        mine = self.folder / "mine"
        mine.write_text("mine")
        self.result.mkdir()
        names = ("reactions.csv", "increments.csv", "history.csv", "used.prm", "scene.pvd", "solution-block-0001.vtu")
        for name in names:
            os.symlink(mine, self.result / f"{name}.tmp")
            os.symlink(mine, self.result / name)
        run = self.run(held(2))
        self.demand("links in the place of results and of what is written first: what they lead to stays",
                    run.returncode == 0 and mine.read_text() == "mine" and not list(self.result.glob("*.tmp"))
                    and not any((self.result / name).is_symlink() for name in names), run)
        (self.result / "log.txt").unlink()
        os.symlink(mine, self.result / "log.txt")
        self.refuses("a link in the place of the log", self.run(held(2)), "log.txt", 3)
        self.demand("  what it leads to stays", mine.read_text() == "mine")

    def locks(self):
        """The first of two runs keeps its folder, however it ends."""
        slow = pressed(increments=4000)
        (self.folder / "slow.prm").write_text(slow)

        def begin():
            return subprocess.Popen([self.program, "slow.prm", "-o", self.result, "--quiet"], cwd=self.folder,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

        def wait(process):
            while process.poll() is None and not (self.result / "checkpoint.bin").exists():
                time.sleep(.01)
        first = begin()
        wait(first)
        used = (self.result / "used.prm").read_text()
        self.refuses("a second run", self.run(held(2)), "Another run writes", 3)
        self.refuses("  that would go on", self.run(pressed(increments=9000), "--restart", self.result), "Another run writes", 3)
        self.demand("  changes nothing", used == (self.result / "used.prm").read_text())
        first.send_signal(signal.SIGKILL)
        first.communicate()
        run = self.run(held(2))
        self.demand("after a kill there is no lock", run.returncode == 0, run)
        shutil.rmtree(self.result)
        both = [begin(), begin()]
        ended = None
        while ended is None:
            ended = next((p for p in both if p.poll() is not None), None)
            time.sleep(.01)
        text = ended.communicate()[1]
        self.demand("of two runs that make the folder together one is refused", ended.returncode == 3 and "Another run" in text, text)
        other = both[both[0] is ended]
        wait(other)
        self.demand("  the other one goes on", other.poll() is None)
        other.kill()
        other.communicate()

    def checkpoints(self):
        whole = self.folder / "whole"
        (self.folder / "short.prm").write_text(pressed(increments=3))
        subprocess.run([self.program, "short.prm", "-o", whole, "--quiet"], cwd=self.folder, check=True)
        bad, go_on = self.folder / "bad", pressed(increments=6)

        def refuse(what, change, words):
            shutil.rmtree(bad, ignore_errors=True)
            shutil.copytree(whole, bad)
            change(bad)
            before = {p.name: p.read_bytes() for p in bad.iterdir()}
            scene = self.folder / "scene.prm"
            scene.write_text(go_on)
            run = subprocess.run([self.program, scene, "--restart", bad, "-o", bad, "--quiet"], capture_output=True, text=True)
            self.refuses(what, run, words)
            self.demand("  nothing has changed", before == {p.name: p.read_bytes() for p in bad.iterdir()})
        for table in ("increments.csv", "reactions.csv", "history.csv"):
            for what, change in BAD_TABLES.items():
                def spoil(folder, change=change):
                    lines = (folder / table).read_text().splitlines(keepends=True)
                    (folder / table).write_text("".join(change(lines)))
                refuse(f"{table}: {what}", spoil, f"{table} ")
        for what, (name, change) in BAD_ENTRIES.items():
            def craft(folder):
                change_numbers(folder / "checkpoint.bin", name, change)
            refuse(f"a checkpoint with {what}", craft, "checkpoint")
        run = self.run(go_on, "--restart", whole)
        self.demand("the whole run goes on", run.returncode == 0, run)

    def run_batch(self, lines, *arguments, file="runs.txt", **options):
        (self.folder / "runs.txt").write_text("".join(f"{line}\n" for line in lines))
        with open(self.folder / "runs.txt") as stream:
            return subprocess.run([self.program, "--batch", file, *arguments], cwd=self.folder, stdin=stream, text=True,
                                  capture_output=True, timeout=120, **options)

    def batch(self):
        """A batch is what its runs are one by one."""
        (self.folder / "a b.prm").write_text(held(2))
        (self.folder / "none.prm").write_text(pressed(increments=1).replace("1e-6*t", "1*t"))
        lines = ["# a comment", "", "'a b.prm' -o one --quiet  # and another", '"a b.prm" -s "Time/Increments=3" -o "two # 2"',
                 "a\\ b.prm -o three -s Time/Incremens=3", "none.prm -o four 2> said.txt", "a\\ b.prm --dry-run >sizes.txt",
                 "a\\ b.prm -o /proc/none"]
        good, bad = "conetact: ", ("there is no entry 'Incremens'", "body 'block'", "cannot be")
        for jobs, file in (("1", "runs.txt"), ("3", "runs.txt"), ("2", "-")):
            run = self.run_batch(lines, "--jobs", jobs, file=file)
            rows = [re.match(r" *(\d+) +(\d+)  (.*)", row) for row in run.stdout.splitlines()[1:-1]]
            self.demand(f"{file}, {jobs} side by side: exit codes in the order of the lines", run.returncode == 3 and [
                        (int(r[1]), int(r[2])) for r in rows] == [(3, 0), (4, 0), (5, 1), (6, 2), (7, 0), (8, 3)], run)
            self.demand("  folders and sentences", [r[3] for r in rows[:2]] == ["one", "two # 2"] and rows[4][3] == "a b.prm" and all(
                        words in row[3] for words, row in zip(bad, (rows[2], rows[3], rows[5]))), run)
            self.demand("  what runs print goes where they say", "Load pull" in (self.folder / "sizes.txt").read_text()
                        and (self.folder / "said.txt").read_text() == f"{good}{rows[3][3].removeprefix('four: ')}\n", run)
            self.demand("  results", not (self.folder / "three").exists() and
                        (self.folder / "two # 2" / "increments.csv").read_text().count("\n") == 4)
            self.demand("  the last line", run.stdout.endswith("6 runs, 3 with another exit code than 0\n"), run.stdout)
        alone = self.run(held(2), "--quiet")
        self.demand("tables are those of a run alone", alone.returncode == 0 and all(
            (self.result / name).read_bytes() == (self.folder / "one" / name).read_bytes()
            for name in ("reactions.csv", "increments.csv", "used.prm")))
        self.refuse_batches()
        self.end_batch()
        self.stop_batch()

    def refuse_batches(self):
        for what, lines, words in (
                ("wrong options", ["'a b.prm' -o x", "'a b.prm' --loud"], ["runs.txt: Line 2: Option --loud is not known"]),
                ("open quotes", ["'a b.prm -o x"], ["Line 1: The quotation mark ' has no partner"]),
                ("all wrong lines", ["a --help", "#", "b c", "-q"], ["Line 1: A line of a batch runs a scene", "Line 3: More than one scene",
                                                                  "Line 4: No scene file"]),
                ("no file behind >", ["'a b.prm' -o x >"], ["Line 1: There is no file behind the last >"]),
                ("one folder for two", ["'a b.prm' -o x", "'a b.prm' -o ./y/../x"], ["Line 2: Its results would replace those of line 1"]),
                ("the folder of the scene's name", ["'a b.prm'", "'a b.prm' -o 'output/a b'"], ["Line 2: Its results would replace"]),
                ("no runs", ["# nothing"], ["runs.txt: No line holds a run"])):
            run = self.run_batch(lines)
            self.demand(f"{what}: refused before anything runs", run.returncode == 1 and not run.stdout and
                        len(run.stderr.splitlines()) == len(words) and all(w in run.stderr for w in words)
                        and not (self.folder / "x").exists() and not (self.folder / "output").exists(), run)
        for arguments, words in ((("--batch", "missing.txt"), "missing.txt cannot be read"), (("--batch", "."), "cannot be read"),
                                 (("--batch", ""), "name is empty"), (("--batch", "runs.txt", "-o", "x"), "only --jobs"),
                                 (("--batch", "runs.txt", "a b.prm"), "only --jobs"), (("--jobs", "2", "a b.prm"), "--jobs is for"),
                                 (("--batch", "runs.txt", "--jobs", "0"), "'0' is no number of runs"), (("--batch",), "needs a value")):
            run = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True)
            self.demand(f"{' '.join(arguments)}: refused", run.returncode == 1 and words in run.stderr
                        and len(run.stderr.splitlines()) == 1, run)
        rooted = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                  "OMPI_MCA_rmaps_base_oversubscribe": "1"}
        for _ in range(4):  # another process may not end before the first one has spoken
            run = subprocess.run(["mpirun", "-n", "3", self.program, "--batch", "runs.txt"], cwd=self.folder, capture_output=True,
                                 text=True, env=rooted)
            self.demand("a batch under mpirun: refused once", run.returncode == 1 and run.stderr.count("Leave mpirun out") == 1, run)

    def end_batch(self):
        """A run that dies ends alone; a batch takes its runs along."""
        slow = pressed(increments=400000)
        (self.folder / "slow.prm").write_text(slow)

        def begin(*lines):
            (self.folder / "runs.txt").write_text("\n".join(lines))
            process = subprocess.Popen([self.program, "--batch", "runs.txt", "--jobs", "2"], cwd=self.folder, text=True,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            while process.poll() is None and not (self.folder / "slow" / "checkpoint.bin").exists():
                time.sleep(.01)
            children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
            return process, [int(child) for child in children.read_text().split()]
        process, (child, *_) = begin("slow.prm -o slow", "'a b.prm' -o fast")
        self.demand("it has started no threads", len(list(Path(f"/proc/{process.pid}/task").iterdir())) == 1)
        os.kill(child, signal.SIGSEGV)
        out = process.communicate(timeout=60)[0]
        self.demand("a run that crashes is told, the others go on", process.returncode == 139 and
                    "    1   139  slow: The run was ended by signal 11" in out and "    2     0  fast\n" in out, out)
        for ending in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            shutil.rmtree(self.folder / "slow")
            process, children = begin("slow.prm -o slow")
            process.send_signal(ending)
            process.communicate(timeout=60)
            until = time.monotonic() + 20
            while any(Path(f"/proc/{child}").exists() for child in children) and time.monotonic() < until:
                time.sleep(.01)
            self.demand(f"{ending.name} ends runs, too", process.returncode == -ending and children and
                        not any(Path(f"/proc/{child}").exists() for child in children), process.returncode)

    def stop_batch(self):
        """Ctrl-C once: increments are finished, each run that was begun has its row, no other begins; twice: at once."""
        (self.folder / "runs.txt").write_text("".join(f"slow.prm -o slow{i} -s Output/Checkpoint=1\n" for i in range(4)))
        begun = [self.folder / f"slow{i}" for i in range(2)]
        for times, words in ((1, "Interrupted after increment"), (2, "The run was ended at once")):
            for folder in begun:
                shutil.rmtree(folder, ignore_errors=True)
            process = subprocess.Popen([self.program, "--batch", "runs.txt", "--jobs", "2"], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            while process.poll() is None and not all((folder / "checkpoint.bin").exists() for folder in begun):
                time.sleep(.01)
            children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
            if times == 2:  # that no increment ends in between
                for child in children:
                    os.kill(int(child), signal.SIGSTOP)
            process.send_signal(signal.SIGINT)
            said = "".join(process.stderr.readline() for _ in range(2))
            if times == 2:
                process.send_signal(signal.SIGINT)
            out, rest = process.communicate(timeout=60)
            said += rest
            rows = out.splitlines()[1:]
            self.demand(f"{times} times Ctrl-C: a row for each run that was begun", process.returncode == -signal.SIGINT and len(rows) == 3 and all(
                        f"   130  slow{i}: {words}" in rows[i] for i in range(2)), out)
            self.demand("  no other begins, and it says so", "2 more were not begun" in rows[-1] and "is finished first" not in out and
                        said.count("are finished first") == 1 and not (self.folder / "slow2").exists(), out + said)
            lengths = [(folder / f"{name}.csv").read_text().count("\n") - 1 for folder in begun for name in ("increments", "history")]
            told = [int(re.search(r"increment (\d+),", row)[1]) for row in rows[:2]] if times == 1 else lengths[::2]
            self.demand(f"  tables are whole: {lengths}", times == 2 or lengths == [told[0]] * 2 + [told[1]] * 2, out)

    def numbers(self, count=60):
        """Each number of a mesh, replaced by what its generator cannot mean."""
        values = ("0", "-1", "1", "3", "40", "1e9", "1.5", "nan", "inf", "-inf", "1e400", "1e-300", "-1e300",
                  "999999999", "2147483648", "4294967295", "99999999999999999999", "", "1/0", "x", "1e9, 8", "2 ; 3")
        chance = random.Random(4)
        scenes = sorted(SCENES.glob("*.prm"))
        bad = []
        for i in range(count):
            text = chance.choice(scenes).read_text() if i % 4 == 0 else generated(*chance.choice(GALLERY))
            text = mutated(chance, text, values)
            run = None
            try:
                run = self.run(text, "--dry-run", timeout=60, preexec_fn=little_memory)
            except subprocess.TimeoutExpired:
                pass
            if run is None or run.returncode not in (0, 1) or (run.returncode == 1 and len(run.stderr.splitlines()) != 1):
                change = next(line for line in text.splitlines() if line.startswith("# changed"))
                bad.append(f"number {i}, {change[2:]}: " +
                           ("does not end" if run is None else f"exit {run.returncode} {run.stderr.strip()[-200:]}"))
                print(bad[-1], flush=True)
        self.demand(f"{count} meshes with other numbers", not bad, bad)


def pressed(increments):
    """A block pressed on a floor and pushed, with a checkpoint of each increment."""
    text = block(2, "floor", "bottom", loads="top") + FLOOR.format(up="0, 1", bottom=2) + load("top", "traction", "1e-6*t ; -1e-4*t", 3)
    return (text + subsection("Time", {"End": increments, "Increments": increments}) +
            subsection("Output", {"VTU": 0, "Checkpoint": 1}))


def other(write, old, new):
    """A writer of a mesh with something else in its first place."""
    def change(block):
        text = write(block)
        assert old in text, (old, text)
        return text.replace(old, new, 1)
    return change


# What crashes deal.II's readers, has no end for them or asks for gigabytes: extension, writer, words.
BAD_MESHES = {
    "Abaqus without its nodes": ("inp", other(mesh_files.abaqus, "*NODE", "NODE"), "the node 1 is not there"),
    "Abaqus with a set of numbers": ("inp", other(mesh_files.abaqus, "*ELSET, ELSET=SS3", "1e400, ELSET=SS3"), "line"),
    "Abaqus with sides of no set": ("inp", other(mesh_files.abaqus, "SS3_E3, S3", "18446744073709551615, S3"), "line"),
    "Tecplot without a node": ("dat", lambda b: mesh_files.tecplot(b).replace("\n2.0 1.0", "", 1), "cannot be read"),
    "Tecplot with a node below 0": ("dat", other(mesh_files.tecplot, "1 2 6 5", "1 -2 6 5"), "cannot be read"),
    "VTK with a number more": ("vtk", other(mesh_files.vtk, "4 1 2 6 5", "4 1 2 6 5        6"), "cannot be read"),
    "Gmsh 4.0 with a block of no kind": ("msh", other(mesh_files.gmsh_40, "1 2 3 6\n", "1 2 3 600\n"), "no mesh that can be taken"),
    "XDA with a number missing": ("xda", other(mesh_files.xda, "0 1 5 4\n", "0 1 5\n"), ""),
    "XDA of 400000000 nodes": ("xda", other(mesh_files.xda, "\n12\n", "\n400000000\n"), "cannot be read"),
    "UCD of 400000000 nodes": ("ucd", other(mesh_files.ucd, "12 12", "400000000 12"), "cannot be read"),
    "UCD with a cell of one node four times": ("ucd", other(mesh_files.ucd, "quad 1 2 6 5", "quad 1 1 1 1"), "")}

BAD_TABLES = {"cut within a row": lambda lines: [*lines[:-1], lines[-1][:len(lines[-1]) // 2]],
              "without its last rows": lambda lines: lines[:-1],
              "without the first increment": lambda lines: lines[:1] + [row for row in lines[1:] if not row.startswith("1,")],
              "with nan": lambda lines: [*lines[:-1], re.sub(r"^(\d+),[^,]+", r"\1,nan", lines[-1])],
              "with a column less": lambda lines: [*lines[:-1], lines[-1][:lines[-1].rindex(",")] + "\n"],
              "with a row twice": lambda lines: [*lines, lines[-1]],
              "empty": lambda lines: []}

NAN, BELOW, HUGE = (struct.pack("<d", x) for x in (float("nan"), -3.0, 1e300))
BAD_ENTRIES = {"a block that is no multiple of 8": ("contact/base", lambda v: v + b"12345"),
               "no times": ("times", lambda v: b""),
               "times that fall": ("times", lambda v: v[8:16] + v[:8] + v[16:]),
               "energies that are nan": ("energies/u", lambda v: NAN + v[8:]),
               "energies of other sizes": ("energies/forces", lambda v: v[8:]),
               "a number of points that is nan": ("energies/points", lambda v: NAN),
               "a number of points below 0": ("energies/points", lambda v: BELOW),
               "states of no kind": ("contact/states", lambda v: HUGE + v[8:]),
               "states of rows below 0": ("rows/states", lambda v: BELOW + v[8:]),
               "a number of rows below 0": ("rows of reactions.csv", lambda v: BELOW)}


def change_numbers(file, name, change):
    """Changes a list of numbers of a checkpoint, by Boost: length of the name, name, length of the list, list; with the right checksum."""
    data = file.read_bytes()
    text = data[:data.rindex(b"checksum ")]
    start = text.index(struct.pack("<Q", len(name)) + name.encode()) + 8 + len(name)
    n, = struct.unpack_from("<Q", text, start)
    new = change(text[start + 8:start + 8 + 8 * n])
    text = text[:start] + struct.pack("<Q", len(new) // 8) + new + text[start + 8 + 8 * n:]
    file.write_bytes(text + b"checksum %08x\n" % (zlib.crc32(text) & 0xffffffff))


def little_memory():
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


MESH_ENTRY = re.compile(r"^(\s*set (Arguments|Global refinements|Refinement boxes|Refinement distance|Scale|Rotation|"
                        r"Translation|Bays|Nodes|Members)\s*=\s*)(.*)$", re.M)


def generated(dim, generator, arguments):
    text = re.sub("Generator = .*", f"Generator = {generator}", held(dim))
    text = text.replace(re.search("Arguments = .*", text)[0], f"Arguments = {arguments}\n    set Global refinements = 1")
    return re.sub("Boundary ids = .*", "Boundary ids = 0", text)


def mutated(chance, text, values):
    """The scene with one number of one entry of a mesh replaced."""
    entries = [m for m in MESH_ENTRY.finditer(text) if re.search(r"\d", m[3])]
    if not entries:
        return "# changed: nothing\n" + text
    entry = chance.choice(entries)
    number = chance.choice(list(re.finditer(r"-?[\d.]+(e-?\d+)?", entry[3].split("#")[0]) or [None]))
    new = entry[3][:number.start()] + chance.choice(values) + entry[3][number.end():]
    return (f"# changed: {entry[1].strip()} {new}\n" +
            text[:entry.start()] + entry[1] + new + text[entry.end():])


def main(program, name, *count):
    with tempfile.TemporaryDirectory() as folder:
        case = Case(program, folder)
        getattr(case, name.replace("-", "_"))(*map(int, count))
        return 1 if case.faults else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
