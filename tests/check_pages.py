#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands of the pages for users run as they stand, and README.md is short.

usage: check_pages.py PROGRAM

All blocks of a page that say sh run as one script of bash which ends at the first error, those that say python as
programs, in an empty folder that has ./conetact, parameter-files and scripts as the source tree has them.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
MOST_LINES = 150  # of README.md
PAGES = {  # and what they say that a command prints
    "README.md": ("29 contact nodes open, 7 stick, 25 slip", "force (-250, 1000, 0)", "slides along (1, 0, 0)", "exit code 2"),
    "doc/running.md": ("2 runs, 0 with another exit code than 0", "verify: ", "probe corner"),
    "doc/python.md": (),
}


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def programs(text):
    if scripts := blocks(text, "sh"):
        yield ["bash", "-euc", "".join(scripts)]
    for program in blocks(text, "python"):
        yield ["/usr/bin/python3", "-c", program]


def make_folder(folder, program):
    (folder / "conetact").symlink_to(program)
    for name in ("parameter-files", "scripts"):
        (folder / name).symlink_to(TOP / name)


def faults_of(page, phrases, program):
    text = (TOP / page).read_text()
    environment = {**os.environ, "CONETACT": str(program), "PYTHONPATH": str(TOP / "python"), "PYTHONDONTWRITEBYTECODE": "1"}
    printed = ""
    with tempfile.TemporaryDirectory() as folder:
        make_folder(Path(folder), program)
        for command in programs(text):
            run = subprocess.run(command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT)
            printed += run.stdout
            if run.returncode != 0:
                yield f"{page}: exit code {run.returncode} of\n{command[-1]}\n{run.stdout}"
    if not printed:
        yield f"{page}: nothing runs or prints"
    yield from (f"{page}: no command prints '{phrase}'" for phrase in phrases if phrase not in printed)


def main(program):
    program = Path(program).resolve()
    faults = [fault for page, phrases in PAGES.items() for fault in faults_of(page, phrases, program)]
    n_lines = len((TOP / "README.md").read_text().splitlines())
    if n_lines > MOST_LINES:
        faults.append(f"README.md has {n_lines} lines; {MOST_LINES} are enough. Move what few readers need to a page of doc/.")
    print("\n".join(faults) or f"{len(PAGES)} pages")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
