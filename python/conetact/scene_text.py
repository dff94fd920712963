# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The text of scene files: sections, includes, comments, long lines."""
from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from .errors import InputError

MOST_OPEN = 50  # files that include one another
NAME_LISTS = {"Body": "Bodies", "Obstacle": "Obstacles", "Contact": "Contacts", "Support": "Supports", "Load": "Loads"}
TIME_LISTS, EQUAL_TIMES = ("Time/Times", "Time/Stages"), ("Time/End", "Time/Increments")


def decoded(file: Path) -> str:
    """UTF-8 or Latin-1, with the line ends of any system."""
    try:
        raw = file.read_bytes()
    except OSError:
        raise InputError(f"The scene file {file} cannot be read. Check its name and permissions.") from None
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n").replace("\u00a0", " ")


def lines_of(file: Path, depth: int = 0) -> Iterator[tuple[int, str]]:
    """With those of the files that are included, relative to the one that names them, and how deep these are."""
    if depth > MOST_OPEN:
        raise InputError(f"{file}: more than {MOST_OPEN} files include one another. Remove one of the includes.")
    for line in decoded(file).split("\n"):
        if found := re.match(r"\s*include[ \t]+([^#]+)", line):
            yield from lines_of(file.parent / re.sub(r"^(['\"])(.*)\1$", r"\2", found[1].strip()), depth + 1)
        else:
            yield depth, line


def statements(lines: Iterator[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    """Without comments; a backslash at the end goes on in the next line."""
    for depth, line in lines:
        text = line.split("#")[0].strip()
        while text.endswith("\\"):
            text = f"{text[:-1].strip()} {next(lines, (0, ''))[1].split('#')[0].strip()}"
        if text:
            yield depth, text


def placed_entries(file: Path) -> Iterator[tuple[str, str, int]]:
    """Path, value and depth of each line that sets an entry."""
    sections: list[str] = []
    for depth, text in statements(lines_of(file)):
        word, _, rest = text.replace("\t", " ").partition(" ")
        if word.lower() == "subsection":
            sections.append(" ".join(rest.split()))
        elif word.lower() == "end" and sections:
            sections.pop()
        elif word.lower() == "set" and "=" in rest:
            name, _, value = rest.partition("=")
            yield "/".join([*sections, " ".join(name.split())]), value.strip(), depth
        else:
            raise InputError(f"{file}: '{text}' is no line of a scene. "
                             "Write subsection NAME, set ENTRY = VALUE, or end.")


def read_entries(file: str | Path) -> dict[str, str]:
    """Entries of a scene, or of used.prm, by their paths: "Contact bottom/Friction coefficient".

    >>> conetact.read_entries(SCENE)["Contact bottom/Friction coefficient"]
    '0.5'
    """
    entries, depths = {}, {}
    for path, value, depth in placed_entries(Path(file)):
        entries[path], depths[path] = value, depth
    for path in [*replaced_times(entries, depths), *unlisted(entries, depths)]:
        del entries[path]
    return entries


def unlisted(entries: Mapping[str, str], depths: Mapping[str, int]) -> list[str]:
    """What an included file says of a body, load, ... that the list of the one that includes it does not name any more."""
    left_out = []
    for path, depth in depths.items():
        kind, _, name = path.partition("/")[0].partition(" ")
        names = NAME_LISTS.get(kind, "") if name and "/" in path else ""
        if names in entries and depths[names] < depth and name not in [word.strip() for word in entries[names].split(",")]:
            left_out.append(path)
    return left_out


def replaced_times(entries: Mapping[str, str], depths: Mapping[str, int]) -> list[str]:
    """Equal increments of an included file where the one that includes it lists times or stages."""
    lists = [depths[path] for path in TIME_LISTS if entries.get(path)]
    return [path for path in EQUAL_TIMES if path in entries and any(depth < depths[path] for depth in lists)]


def read_scene_file(file: Path) -> tuple[dict[str, str], str]:
    """Its entries, and the comments at its head without those of the licence."""
    head: list[str] = []
    for line in decoded(file).split("\n"):
        if not line.startswith("#"):
            break
        if "SPDX-" not in line:
            head.append(line[1:].strip())
    return read_entries(file), "\n".join(head).strip()


def tree_of(texts: Mapping[str, str]) -> dict[str, object]:
    tree: dict[str, object] = {}
    for path, text in texts.items():
        *sections, name = path.split("/")
        branch = tree
        for section in sections:
            branch = branch.setdefault(section, {})  # type: ignore[assignment]
        branch[name] = text
    return tree


def scene_lines(comments: str, texts: Mapping[str, str]) -> Iterator[str]:
    if comments:
        yield from (f"# {line}".rstrip() for line in comments.splitlines())
        yield ""
    yield from tree_lines(tree_of(texts))


def tree_lines(tree: Mapping[str, object], depth: int = 0) -> Iterator[str]:
    """Entries first, then sections."""
    blank = "  " * depth
    for name, text in tree.items():
        if not isinstance(text, dict):
            yield f"{blank}set {name} = {text}".rstrip()
    for name, branch in tree.items():
        if isinstance(branch, dict):
            yield from [""] * (depth == 0)
            yield f"{blank}subsection {name}"
            yield from tree_lines(branch, depth + 1)
            yield f"{blank}end"
