#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damaged files of every kind that the programs read: each is taken or refused in a sentence.

usage: mutations.py BUILD [--count N] [--kind NAME] [--jobs N] [--first N] [--keep FOLDER]

A case is a good file with one to three changes that its number determines. Whatever the file is, the
program ends within 20 s by itself, with exit code 0, 1, 2 or 3, says at most one line where it refuses,
leaves nothing where it does so with exit code 1, and writes finite numbers only. A table tells of all
kinds; faults are listed with the command that repeats them. --keep: folder for the files of faults.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import math
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(TOP / "tests"))

from support import mesh_files  # noqa: E402
from support.batch import of_thread  # noqa: E402

SECONDS = 20
ALARM = -14
TEXTS = re.compile(r"contact|state|solver|determinate|.*_(body|contact)")
NASTY = ("0", "-1", "1", "2", "1.5", "1e9", "400000000", "4294967295", "4294967296", "18446744073709551615", "-2147483649",
         "1e400", "-1e300", "1e-320", "nan", "inf", "-inf", "", "x", "1,5", "0x10", "1 2")
NASTY_BYTES = tuple(bytes.fromhex(text) for text in (
    "00000000", "ffffffff", "ffffff7f", "01000000", "0000000000000000", "ffffffffffffffff", "ffffffffffffff7f",
    "000000000000f87f", "000000000000f07f", "000000000000f0bf", "a0c8eb85f3cce17f", "0000000000002440"))


def changed_text(chance, text):
    lines = text.split("\n")
    i, j = chance.randrange(len(lines)), chance.randrange(len(lines))
    at = chance.randrange(len(text) + 1)
    numbers = list(re.finditer(r"-?\d[\d.e+-]*", text))
    kind = chance.randrange(12)
    if kind < 4 and numbers:
        number = chance.choice(numbers)
        return text[:number.start()] + chance.choice(NASTY) + text[number.end():]
    if kind == 4:
        return "\n".join(lines[:i] + lines[i + 1:])
    if kind == 5:
        return "\n".join(lines[:i] + [lines[j]] + lines[i:])
    if kind == 6:
        lines[i], lines[j] = lines[j], lines[i]
        return "\n".join(lines)
    if kind == 7:
        return text[:at]
    if kind == 8:
        return text[:at] + "".join(map(chr, chance.choices(range(1, 256), k=chance.choice((1, 1, 5))))) + text[at + 1:]
    if kind == 9:
        return text[:at] + text[at + chance.choice((1, 2, 10, 100)):]
    if kind == 10:
        words = lines[i].split(" ")
        del words[chance.randrange(len(words))]
        lines[i] = " ".join(words)
        return "\n".join(lines)
    return text[:at] + text[at:at + 5] * chance.choice((2, 20, 6000)) + text[at:]


def changed_bytes(chance, data):
    at = chance.randrange(len(data) + 1)
    kind = chance.randrange(6)
    if kind < 2:
        value = chance.choice(NASTY_BYTES)
        return data[:at] + value + data[at + len(value):]
    if kind == 2:
        return data[:at] + bytes(chance.choices(range(256), k=chance.choice((1, 1, 4)))) + data[at + 1:]
    if kind == 3:
        return data[:at]
    if kind == 4:
        return data[:at] + data[at + chance.choice((1, 4, 8, 50)):]
    return data[:at] + data[at:at + 8] * chance.choice((2, 200)) + data[at:]


def changed(chance, data):
    """Bytes of a file with one to three changes, as text where it is one."""
    for _ in range(chance.choice((1, 1, 2, 3))):
        if b"\0" in data:
            data = changed_bytes(chance, data)
        else:
            data = changed_text(chance, data.decode("latin-1")).encode("latin-1", "replace")
    return data


SCENE = """set Dimension = {dim}
set Bodies = block
set Obstacles = floor
set Contacts = bottom
set Loads = top
subsection Body block
  subsection Mesh
{mesh}  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Obstacle floor
{floor}end
subsection Contact bottom
  set Body = block
  set Boundary ids = {bottom}
  set Obstacle = floor
  set Friction coefficient = 0.3
end
subsection Load top
  set Body = block
  set Boundary ids = {top}
  set Kind = pressure
  set Value = t
end
subsection Time
  set End = {increments}
  set Increments = {increments}
end
subsection Output
  set VTU = 0
  set Checkpoint = {checkpoint}
end
"""


def scene(dim, mesh="", floor=None, bottom=None, top=None, increments=1, checkpoint=0):
    """A block on a floor, pressed from above."""
    if not mesh:
        cells, high = {2: ("4, 2", "2, 1"), 3: ("3, 2, 2", "2, 1, 1")}[dim]
        mesh = (f"    set Generator = subdivided_hyper_rectangle\n"
                f"    set Arguments = {cells} : {', '.join('0' * dim)} : {high} : true\n")
        bottom, top = 2 * dim - 2, 2 * dim - 1
    floor = floor or f"  set Shape = half space\n  set Normal = {', '.join('0' * (dim - 1) + '1')}\n"
    return SCENE.format(dim=dim, mesh=mesh, floor=floor, bottom=bottom or 2, top=top or 3, increments=increments,
                        checkpoint=checkpoint)


def mesh_scene(dim, file, has_ids, names=False):
    axis = "xyz"[dim - 1]
    ids = "" if has_ids else f"    set Boundary ids = 2: {axis} < 1e-9 ; 3: {axis} > 1 - 1e-9\n"
    if names:
        return scene(dim, f"    set File = {file}\n    set Group = steel\n", bottom="floor", top="top")
    return scene(dim, f"    set File = {file}\n{ids}")


def is_finite_number(text):
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def table_faults(folder):
    """What no table of a run may have."""
    for file in sorted(folder.glob("*.csv")):
        lines = file.read_text(errors="replace").split("\n")
        columns = lines[0].split(",")
        if lines[-1]:
            yield f"{file.name} ends within a line"
        for line in filter(None, lines[1:]):
            cells = line.split(",")
            if len(cells) != len(columns):
                yield f"{file.name} has a row of {len(cells)} columns"
                break
            for column, cell in zip(columns, cells):
                if not TEXTS.fullmatch(column) and not is_finite_number(cell):
                    yield f"{file.name} has {cell} for {column}"
                    break
    for file in folder.glob("*.tmp"):
        yield f"{file.name} is left"


def contents(folder):
    """Names and sums of all files of a folder."""
    return {p.name: hashlib.sha1(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir()) if p.is_file()} if folder.is_dir() else {}


def limit_run():
    """What no run may take."""
    for what, amount in ((resource.RLIMIT_AS, 3 << 30), (resource.RLIMIT_FSIZE, 100 << 20), (resource.RLIMIT_CORE, 0)):
        resource.setrlimit(what, (amount, amount))


class Programs:
    """The main program, a batch for each thread, and the other ones."""

    def __init__(self, build):
        self.build = build

    def conetact(self, *arguments):
        batch = of_thread(self.build / "conetact", preexec_fn=limit_run, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        try:
            run = batch.run(*arguments, timeout=SECONDS)
            return run.returncode, run.stdout, run.stderr
        except subprocess.TimeoutExpired:
            return ALARM, "", ""

    def other(self, program, folder, *arguments):
        try:
            run = subprocess.run([self.build / program, *arguments], cwd=folder, capture_output=True, text=True, errors="replace",
                                 timeout=SECONDS, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
            return run.returncode, run.stdout, run.stderr
        except subprocess.TimeoutExpired:
            return ALARM, "", ""


def said_faults(code, error):
    if code < 0:
        yield "it takes more than 20 s" if code == ALARM else f"signal {-code}"
    elif code > 3:
        yield f"exit code {code}"
    elif code > 0 and len(error.splitlines()) != 1:
        yield f"exit code {code} and {len(error.splitlines())} lines"
    elif code == 0 and re.search(r"\b(nan|inf)\b", error):
        yield "it says nan"


class Kind:
    """Good files of a kind, and what is done with a bad one."""

    def __init__(self, programs, folder):
        self.programs, self.good = programs, folder
        folder.mkdir()
        self.prepare()

    def prepare(self):
        pass

    def run_scene(self, folder, *arguments):
        code, _, error = self.programs.conetact(folder / "scene.prm", "-o", folder / "result", "--quiet", *arguments)
        result = folder / "result"
        faults = list(said_faults(code, error))
        if code == 1 and result.exists():
            faults.append("exit code 1 and results")
        faults += table_faults(result)
        return code, faults


class Meshes(Kind):
    seeds = [(name, dim) for name, (_, _, dims, _) in mesh_files.MESHES.items() for dim in dims]

    def case(self, chance, folder):
        name, dim = chance.choice(self.seeds)
        extension, write, _, has_ids = mesh_files.MESHES[name]
        data = mesh_files.in_bytes(write(mesh_files.Block(dim)))
        (folder / f"block.{extension}").write_bytes(changed(chance, data))
        (folder / "scene.prm").write_text(mesh_scene(dim, f"block.{extension}", has_ids))
        return self.run_scene(folder)


class Groups(Kind):
    """Names in the file, in the scene, or in both are others."""

    def case(self, chance, folder):
        dim = chance.choice((2, 3))
        data = mesh_files.in_bytes(mesh_files.gmsh(chance.choice(("2.2", "4.1")), False)(mesh_files.Block(dim)))
        head = data.index(b"$Nodes")
        text = mesh_scene(dim, "block.msh", True, names=True).encode()
        if chance.random() < .7:
            data = changed(chance, data[:head]) + data[head:]
        else:
            line = chance.choice([m for m in re.finditer(rb"(Group|Boundary ids) = \w+", text)])
            text = text[:line.start()] + changed(chance, line[0]).replace(b"\n", b" ") + text[line.end():]
        (folder / "block.msh").write_bytes(data)
        (folder / "scene.prm").write_bytes(text)
        return self.run_scene(folder)


class Surfaces(Kind):
    def case(self, chance, folder):
        extension, write = mesh_files.SURFACES[chance.choice(sorted(mesh_files.SURFACES))]
        (folder / f"box.{extension}").write_bytes(changed(chance, mesh_files.in_bytes(write())))
        (folder / "scene.prm").write_text(scene(3, floor=f"  set Shape = surface mesh\n  set File = box.{extension}\n"))
        return self.run_scene(folder)


class Scenes(Kind):
    """Shipped ones, read and meshed only."""
    files = sorted((TOP / "parameter-files").glob("*.prm"))

    def case(self, chance, folder):
        (folder / "scene.prm").write_bytes(changed(chance, chance.choice(self.files).read_bytes()))
        return self.run_scene(folder, "--dry-run")


class Checkpoints(Kind):
    """Their entries and the tables beside them; the checksum is right."""

    def prepare(self):
        for dim in (2, 3):
            folder = self.good / str(dim)
            folder.mkdir()
            for name, increments in (("first.prm", 2), ("scene.prm", 4)):
                (folder / name).write_text(scene(dim, increments=increments, checkpoint=1))
            code, _, error = self.programs.conetact(folder / "first.prm", "-o", folder / "result", "--quiet")
            if code != 0:
                raise SystemExit(f"the good checkpoint: {error}")

    @staticmethod
    def entries(data):
        start, result = data.index(b"\n") + 1, []
        while not result or result[-1][0] != b"end":
            end = data.index(b"\n", start)
            kind, size, name = data[start:end].split(b" ", 2)
            result.append((kind, name, data[end + 1:end + 1 + int(size)]))
            start = end + int(size) + 2
        return data[:data.index(b"\n") + 1], result

    @staticmethod
    def with_checksum(text):
        return text + b"checksum %08x\n" % (zlib.crc32(text) & 0xffffffff)

    def other_entries(self, chance, data):
        head, entries = self.entries(data)
        for _ in range(chance.choice((1, 1, 2))):
            i = chance.randrange(len(entries) - 1)
            kind, name, value = entries[i]
            change = chance.randrange(4)
            if change == 0:
                del entries[i]
            elif change == 1 and len(value) >= 8:
                at = 8 * chance.randrange(len(value) // 8)
                entries[i] = (kind, name, value[:at] + chance.choice([b for b in NASTY_BYTES if len(b) == 8]) + value[at + 8:])
            elif change == 2:
                size = chance.choice((0, 1, 7, 8, 16, max(0, len(value) - 8), len(value) + 8))
                entries[i] = (kind, name, (value + bytes(8))[:size])
            else:
                entries[i] = (kind, name, changed(chance, value) if kind == b"text" else changed_bytes(chance, value))
        return self.with_checksum(head + b"".join(b"%s %d %s\n%s\n" % (k, len(v), n, v) for k, n, v in entries))

    def case(self, chance, folder):
        shutil.copytree(self.good / chance.choice("23"), folder, dirs_exist_ok=True)
        shutil.rmtree(folder / "former", ignore_errors=True)
        (folder / "result").rename(folder / "former")
        file = folder / "former" / "checkpoint.bin"
        way = chance.randrange(4)
        if way < 2:
            file.write_bytes(self.other_entries(chance, file.read_bytes()))
        elif way == 2:
            file.write_bytes(self.with_checksum(changed_bytes(chance, file.read_bytes()[:-18])))
        else:
            table = folder / "former" / chance.choice(("increments.csv", "reactions.csv", "history.csv"))
            table.write_bytes(changed(chance, table.read_bytes()))
        before = contents(folder / "former")
        if chance.random() < .5:
            code, faults = self.run_scene(folder, "--restart", folder / "former")
            faults += ["it changes the former run"] * (contents(folder / "former") != before)
            return code, faults
        code, _, error = self.programs.conetact(folder / "scene.prm", "-o", folder / "former", "--restart", folder / "former", "--quiet")
        faults = list(said_faults(code, error))
        if code == 1 and contents(folder / "former") != before:
            faults.append("exit code 1 and other results")
        return code, faults + list(table_faults(folder / "former") if code != 1 else [])


class Problems(Kind):
    """What other programs read of a scene's contact problems."""
    entry, pattern, ways = "Text increments", "problem-*.txt", (("conetact-reproductions", "lemke"), ("conetact-reproductions", "smoothing"))
    behind = ()

    def prepare(self):
        (self.good / "scene.prm").write_text(scene(2).replace("set Loads = top", "set Loads = top\nset Supports = side") +
                                             "subsection Support side\n  set Body = block\n  set Boundary ids = 0\n"
                                             "  set Directions = x, y\nend\n")
        code, _, error = self.programs.conetact(self.good / "scene.prm", "-o", self.good / "result", "--quiet", "-s",
                                                f"Output/{self.entry}=1")
        self.files = sorted((self.good / "result").glob(self.pattern))
        if code != 0 or not self.files:
            raise SystemExit(f"the good problems: {error}")

    def case(self, chance, folder):
        file = chance.choice(self.files)
        (folder / file.name).write_bytes(changed(chance, file.read_bytes()))
        program, *words = chance.choice(self.ways)
        code, out, error = self.programs.other(program, folder, *words, file.name, *self.behind)
        faults = list(said_faults(code, error))
        if code == 0 and re.search(r"\bnan\b", out):
            faults.append("it prints nan")
        return code, faults


class Fclib(Problems):
    entry, pattern, ways = "FCLib increments", "problem-*.hdf5", (("conetact-fclib", "solve"),)
    behind = ("--time-limit", "5")


# name, class, cases of a thousand
KINDS = {"meshes": (Meshes, 400), "groups": (Groups, 60), "surfaces": (Surfaces, 120), "checkpoints": (Checkpoints, 200),
         "scenes": (Scenes, 100), "problem texts": (Problems, 60), "fclib": (Fclib, 60)}


def run_case(kind, name, number, folder, keep):
    case = folder / f"{name}-{number}".replace(" ", "-")
    case.mkdir()
    code, faults = kind.case(random.Random(f"{name} {number}"), case)
    if faults and keep:
        shutil.copytree(case, keep / case.name, dirs_exist_ok=True)
    shutil.rmtree(case)
    return name, number, code, faults


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n")[1][7:])
    parser.add_argument("build", type=Path)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--kind", choices=KINDS)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    kinds = {options.kind: (KINDS[options.kind][0], 1000)} if options.kind else KINDS
    programs = Programs(options.build.resolve())
    if not (programs.build / "conetact-fclib").exists():
        kinds = {name: row for name, row in kinds.items() if name != "fclib"}
    results = collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        folder = Path(folder)
        ready = {name: made(programs, folder / name) for name, (made, _) in kinds.items()}
        work = [pool.submit(run_case, ready[name], name, number, folder, options.keep)
                for name, (_, share) in kinds.items()
                for number in range(options.first, options.first + math.ceil(options.count * share / 1000))]
        for done in concurrent.futures.as_completed(work):
            name, number, code, faults = done.result()
            results[name][code] += 1
            results[name]["faults"] += bool(faults)
            for fault in faults:
                print(f"FAULT {name} {number}: {fault} (--kind '{name}' --first {number} --count 1)", flush=True)
    print("\n| files | cases | taken | refused | no equilibrium | faults |\n|---|---|---|---|---|---|")
    for name in kinds:
        row = results[name]
        cases = sum(n for code, n in row.items() if code != "faults")
        print(f"| {name} | {cases} | {row[0]} | {row[1]} | {row[2]} | {row['faults']} |")
    return 1 if any(row["faults"] for row in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
