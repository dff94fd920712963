# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which entry is meant by a path or a word."""
from __future__ import annotations

import re

from .errors import InputError, meant
from .program import Entry, manual

LISTS = {"Body": "Bodies", "Obstacle": "Obstacles", "Contact": "Contacts", "Support": "Supports", "Load": "Loads"}
SHORT = {"young": "Young modulus", "poisson": "Poisson ratio", "friction": "Friction coefficient", "slave": "Body",
         "slave_ids": "Boundary ids", "master_ids": "Master boundary ids"}


def template(section: str) -> str:
    """The section of the manual: 'Body NAME/Mesh' for 'Body block/Mesh'."""
    kinds = "|".join([*LISTS, "Section"])
    return "/".join(re.sub(rf"^({kinds}) .+", r"\1 NAME", part) for part in section.split("/") if part)


def entry_at(path: str) -> Entry:
    """What the manual says about an entry; a sentence if it knows none."""
    section, _, name = path.rpartition("/")
    known = manual().get(template(section))
    if known is None:
        raise InputError(f"There is no section '{section}'. {meant(template(section), manual())}")
    if name not in known:
        raise InputError(f"There is no entry '{path}'. {meant(name, known)}")
    return known[name]


def path_of(section: str, word: str, is_frame: bool = False) -> str:
    """The path of the entry that a word of Python names: 'Body b/Material/Young modulus' for 'young' of 'Body b'."""
    name = SHORT.get(word, word.replace("_", " ")).lower()
    rooms = {"": manual()[template(section)]}
    if section.startswith("Body ") and "/" not in section:
        inner = ("Frame",) if is_frame else ("Mesh", "Material")
        rooms.update({room: manual()[f"Body NAME/{room}"] for room in inner})
    for room, known in rooms.items():
        for entry in known:
            if entry.lower() == name:
                return "/".join(filter(None, (section, room, entry)))
    every = [entry.replace(" ", "_").lower() for known in rooms.values() for entry in known]
    every += [short for short, entry in SHORT.items() if any(entry in known for known in rooms.values())]
    raise InputError(f"{section} has no entry '{word}'. {meant(word, every)}")


def file_name(path: str) -> str:
    """Of the mesh of a body: its name, without letters that files cannot have."""
    return re.sub(r"[^\w.-]", "_", path.split("/")[0].partition(" ")[2])
