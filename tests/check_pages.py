#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands of the pages for users run as they stand, their lines of scenes are entries, and README.md is short.

usage: check_pages.py PROGRAM [PAGE...]

All blocks of a page that say sh run as one script of bash which ends at the first error, those that say python as
programs, in an empty folder that has ./conetact and some folders of the source tree, and is the home. Those that say prm are parts of
scenes: each entry must be one of the manual.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
MOST_LINES = 150  # of README.md
PHRASES = {  # what pages say that a command prints
    "README.md": ("29 contact nodes open, 7 stick, 25 slip", "force (-250, 1000, 0)", "slides along (1, 0, 0)", "exit code 2"),
    "doc/running.md": ("2 runs, 0 with another exit code than 0", "verify: ", "probe corner"),
    "doc/python.md": ("Scene(3D: bodies lower, upper; contacts joint", "False joint 1", "Mesh(2D: 231 points", "coefficient = 0.75"),
    "doc/site/tutorials/press-fit.md": ("body 'shaft' slides along (0, 1, 0)", "exit code 2"),
}
FOLDERS = ("parameter-files", "scripts", "doc", "tests", "cmake")  # that pages name in commands
ENTRY = re.compile(r"^\s*set\s+([^=]+?)\s*=", re.MULTILINE)


def pages_for_users():
    return ["README.md", *(str(page.relative_to(TOP)) for page in sorted(TOP.glob("doc/*.md")) + sorted(TOP.glob("doc/site/**/*.md")))]


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def programs(text):
    if scripts := blocks(text, "sh"):
        yield ["bash", "-euc", "".join(scripts)]
    for program in blocks(text, "python"):
        yield ["/usr/bin/python3", "-c", program]


def make_folder(folder, program):
    (folder / "build").mkdir()
    for name in ("conetact", "build/conetact"):  # for users, and as tests are called
        (folder / name).symlink_to(program)
    for name in FOLDERS:
        (folder / name).symlink_to(TOP / name)


def faults_of_entries(page, text, known):
    """The manual has a list item for each entry, '* **Name** = ...'."""
    for block in blocks(text, "prm"):
        yield from (f"{page}: there is no entry '{name}'" for name in ENTRY.findall(block) if name not in known)


def faults_of(page, phrases, program):
    text = (TOP / page).read_text()
    environment = {**os.environ, "CONETACT": str(program), "PYTHONPATH": str(TOP / "python"), "PYTHONDONTWRITEBYTECODE": "1"}
    printed = ""
    with tempfile.TemporaryDirectory() as folder:
        make_folder(Path(folder), program)
        environment["HOME"] = folder
        for command in programs(text):
            run = subprocess.run(command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT)
            printed += run.stdout
            if run.returncode != 0:
                yield f"{page}: exit code {run.returncode} of\n{command[-1]}\n{run.stdout}"
    yield from (f"{page}: no command prints '{phrase}'" for phrase in phrases if phrase not in printed)


def main(program, *pages):
    program = Path(program).resolve()
    manual = subprocess.run([program, "--parameters"], check=True, text=True, stdout=subprocess.PIPE).stdout
    known = set(re.findall(r"^\* \*\*(.*?)\*\*", manual, re.MULTILINE))
    faults = []
    for page in pages or pages_for_users():
        faults += faults_of(page, PHRASES.get(page, ()), program)
        faults += faults_of_entries(page, (TOP / page).read_text(), known)
    n_lines = len((TOP / "README.md").read_text().splitlines())
    if n_lines > MOST_LINES:
        faults.append(f"README.md has {n_lines} lines; {MOST_LINES} are enough. Move what few readers need to a page of doc/.")
    print("\n".join(faults) or f"{len(pages or pages_for_users())} pages")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
