# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the program is, and which entries its scenes may have."""
from __future__ import annotations

import functools
import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .errors import ConetactError, error_of

TOP = Path(__file__).resolve().parents[2]  # of the source tree, share/conetact, or lib/python3.N of an environment


def places() -> list[Path]:
    """Where the program may be, the most likely place first."""
    on_path = shutil.which("conetact")
    return [TOP / "build" / "conetact", TOP.parent.parent / "bin" / "conetact",
            *([Path(on_path)] if on_path else [])]


def executable() -> Path:
    """The program: what CONETACT names, that of the source tree, the one that was installed beside the package, or that of PATH.

    >>> conetact.executable().name
    'conetact'
    """
    named = os.environ.get("CONETACT")
    for program in [Path(named)] if named else places():
        if os.access(program, os.X_OK) and not program.is_dir():
            return program
    if named:
        raise ConetactError(f"There is no program {named}. The environment variable CONETACT names it; "
                            "it must be an executable.")
    looked = ", ".join(map(str, places()))
    raise ConetactError(f"The program conetact is neither on the PATH nor one of {looked}. "
                        "Build it with ./conetact --version in the source tree, and name build/conetact in the "
                        "environment variable CONETACT, or link it to a folder of the PATH.")


def execute(words: Sequence[str]) -> subprocess.CompletedProcess[str]:
    """A run of the program with what it prints."""
    try:
        return subprocess.run([str(executable()), *words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace")
    except OSError as error:
        raise ConetactError(f"The program cannot be started: {error}") from None


@dataclass(frozen=True)
class Entry:
    """What the manual says about an entry."""

    name: str
    default: str
    text: str


def manual() -> dict[str, dict[str, Entry]]:
    """Entries by sections, as `conetact --parameters` tells them: "Body NAME/Mesh", "Contact NAME", ...; "" is the top.

    >>> entries = conetact.manual()
    >>> entries["Contact NAME"]["Friction coefficient"].default
    '0'
    """
    return read_manual(executable())


@functools.lru_cache(maxsize=4)
def read_manual(_program: Path) -> dict[str, dict[str, Entry]]:
    """Once for each program."""
    done = execute(["--parameters"])
    if error := error_of(done.returncode, done.stderr):
        raise error
    return entries_of(done.stdout)


def entries_of(text: str) -> dict[str, dict[str, Entry]]:
    sections: dict[str, dict[str, Entry]] = {"": {}}
    section = sections[""]
    for line in text.splitlines():
        if line.startswith("## "):
            section = sections.setdefault(line[3:].strip(), {})
        elif row := re.match(r"\* \*\*(.+?)\*\*(?: = `(.*?)`)?: (.*)", line):
            section[row[1]] = Entry(row[1], row[2] or "", row[3])
    return sections
