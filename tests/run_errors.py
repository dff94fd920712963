#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
r"""Wrong scenes are refused with the sentence that says what is wrong, and nothing is written.

usage: run_errors.py PROGRAM FOLDER TABLE.txt [ROW...]      (without names, all rows)

A table names a right scene beside it and changes it row by row:

  base: block.prm

  [spring-negative] Springs of negative stiffness.
  Support top/Stiffness = -5
  > Support 'top', Stiffness: it is -5 at (0.0563508, 1, 0).

`Section/Entry = value` sets an entry or adds it at the end of its section, a section that is
not there at the end of the scene; `without Section/Entry` and `without Section` remove one;
`replace TEXT with TEXT` changes what stands in the scene once (\n is the end of a line); `arguments: ...` are given to
the program behind the scene; `>` is the sentence, or a part of it, said with exit code 1.
Tables of wrong files name right ones beside them, `files: block.inp, block.msh`; `in FILE replace TEXT with TEXT` changes one
for a row, `in FILE keep N lines` cuts it off, `in FILE keep N bytes` too. Rows name the file by an entry of the scene.
Changes between `base:` and the first row belong to all rows. Lines that are numbered in
sentences are those of the changed scene. Each base must be right without the rows.
"""
import re
import shlex
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from run_scene import check_error, execute
from support.batch import Batch


@dataclass
class Row:
    name: str
    title: str = ""
    changes: list = field(default_factory=list)
    arguments: list = field(default_factory=list)
    files: list = field(default_factory=list)  # names and changes of them
    sentence: str = None


def read_table(file):
    """The scene of a table with the changes for all, and its rows."""
    base, common, rows = None, Row(""), []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        row = rows[-1] if rows else common
        head = re.fullmatch(r"\[([\w-]+)\] (.+)", line)
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("base: "):
            base = (file.parent / line[6:].strip()).read_text()
        elif head:
            rows.append(Row(*head.groups()))
        elif line.startswith("> ") and not row.sentence:
            row.sentence = line[2:]
        elif line.startswith("files: "):
            common.files = [(name.strip(), None) for name in line[7:].split(",")]
        elif re.match(r"in \S+ (replace|keep) ", line):
            row.files.append(tuple(line[3:].split(" ", 1)))
        elif line.startswith("arguments: "):
            row.arguments = shlex.split(line[11:])
        elif re.match(r"without |replace .+ with |[^=]+ =", line):
            row.changes.append(line)
        else:
            raise SystemExit(f"{file}, line {number}: '{line}' is not understood")
    names = [row.name for row in rows]
    wrong = [row.name for row in rows if not row.sentence] + [name for name in names if names.count(name) > 1]
    if base is None or wrong:
        raise SystemExit(f"{file}: no base, or rows without a sentence or twice: {wrong}")
    for row in rows:
        row.files = [(file.parent / name, None) for name, _ in common.files] + \
                    [(file.parent / name, change) for name, change in row.files]
    return changed(base, common.changes), rows


def bounds(lines, section):
    """First and last line inside a section ("" is the whole scene), None if it is not there."""
    begin, end = 0, len(lines)
    for name in filter(None, section.split("/")):
        depth, found = 0, None
        for i in range(begin, end):
            word = lines[i].strip()
            if depth == 0 and word == f"subsection {name}":
                found = i + 1
            depth += word.startswith("subsection ") - (word == "end")
            if found and depth == 0:
                begin, end = found, i
                break
        else:
            return None
    return begin, end


def entry_of(lines, section, entry):
    """The line of an entry of this very section, and the one behind its last entry."""
    begin, end = bounds(lines, section)
    depth, behind = 0, begin
    for i in range(begin, end):
        word = lines[i].strip()
        if depth == 0 and word.startswith("set "):
            behind = i + 1
            if re.match(rf"set {re.escape(entry)} *=", word):
                return i, behind
        depth += word.startswith("subsection ") - (word == "end")
    return None, behind


def add_section(lines, section):
    """Unless it is there, at the end of the one around it, which may have to be added first."""
    if bounds(lines, section) is not None:
        return
    outer, _, name = section.rpartition("/")
    add_section(lines, outer)
    at, indent = bounds(lines, outer)[1], "  " * section.count("/")
    lines[at:at] = ([] if outer else [""]) + [f"{indent}subsection {name}", f"{indent}end"]


def put(lines, path, value):
    section, _, entry = path.rpartition("/")
    add_section(lines, section)
    at, behind = entry_of(lines, section, entry)
    line = "  " * path.count("/") + f"set {entry} = {value}"
    lines[slice(behind, behind) if at is None else slice(at, at + 1)] = [line]


def remove(lines, path):
    if bounds(lines, path):
        begin, end = bounds(lines, path)
        del lines[begin - 1:end + 2]  # and the empty line behind it
        return
    at, _ = entry_of(lines, *path.rpartition("/")[::2])
    if at is None:
        raise ValueError(f"there is no {path} to remove")
    del lines[at]


def changed(text, changes):
    for change in changes:
        swap = re.fullmatch(r"replace (.+) with (.*)", change)
        if swap:
            old, new = (part.replace("\\n", "\n") for part in swap.groups())
            if text.count(old) != 1:
                raise ValueError(f"'{swap[1]}' stands there {text.count(old)} times")
            text = text.replace(old, new)
            continue
        lines = text.splitlines()
        if change.startswith("without "):
            remove(lines, change[8:])
        else:
            put(lines, *re.fullmatch(r"([^=]+?) = ?(.*)", change).groups())
        text = "\n".join(lines) + "\n"
    return text


def write_files(folder, files):
    """Files that a scene reads, the later ones with a change in place of the earlier ones."""
    folder.mkdir(parents=True, exist_ok=True)
    for file, change in files:
        data = (folder / file.name if change else file).read_bytes()
        if change and (cut := re.fullmatch(r"keep (\d+) (lines|bytes)", change)):
            data = data[:int(cut[1])] if cut[2] == "bytes" else b"".join(data.splitlines(True)[:int(cut[1])])
        elif change:
            data = changed(data.decode("latin-1"), [change]).encode("latin-1")
        (folder / file.name).write_bytes(data)


def scene_of(table, name):
    """The scene of a row, for other tests."""
    base, rows = read_table(table)
    return changed(base, next(row.changes for row in rows if row.name == name))


def run_text(start, folder, name, text, arguments):
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / f"{name}.prm"
    scene.write_text(text)
    return execute(start, folder / name, scene, arguments)


def faults_of(start, folder, base, row):
    """What is wrong with how a row is refused."""
    text = changed(base, row.changes)
    if text == base and not row.arguments and not any(change for _, change in row.files):
        return ["it changes nothing"]
    write_files(folder, row.files)
    run, result, faults = run_text(start, folder, row.name, text, row.arguments)
    return faults + check_error(run, result, 1, row.sentence)


def faults_of_table(start, folder, base, rows):
    write_files(folder, [(file, None) for row in rows[:1] for file, change in row.files if not change])
    run, _, failed = run_text(start, folder, "base", base, ["--dry-run"])
    if run.returncode != 0:
        failed.append(run.stderr.strip())
    failed = [f"the base: {fault}" for fault in failed]
    for row in rows:
        failed += [f"[{row.name}] {fault}" for fault in faults_of(start, folder, base, row)]
    return failed


def main(program, folder, file, *names):
    program, folder, file = (Path(a).resolve() for a in (program, folder, file))
    base, rows = read_table(file)
    rows = [row for row in rows if row.name in names or not names]
    with tempfile.TemporaryDirectory() as empty:
        batch = Batch(program, cwd=empty)
        failed = faults_of_table(batch.run, folder, base, rows)
        batch.close()
        failed += [f"{path.name} is left in the working folder" for path in Path(empty).iterdir()]
    print("\n".join(f"{file.name}: {fault}" for fault in failed + [f"{len(rows)} rows, {len(failed)} faults"]))
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
