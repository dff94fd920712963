#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What scripts/sitepages.py makes for the site: each entry of the manual is in the reference once, each scene has a page,
each line of an example stands in the scene that it links, scenes set the units that their head comments name,
and tutorials show the whole of their drawings and scenes and link these.

usage: check_sitepages.py PROGRAM
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(TOP / "scripts"))
import sitepages  # noqa: E402 (it is beside the scripts)

INCLUDED = re.compile(r"^```\{literalinclude\} (\S+)\n((?::.*\n)*)```$", re.MULTILINE)
EXAMPLE = re.compile(r"^\* \[([^\]]+)\]\(\.\./scenes/\1\.md\): `set (.+?) = (.*)`$", re.MULTILINE)


def headings(folder):
    return [title for page in folder.glob("*.md") for title in re.findall(r"^## (.*)$", page.read_text(), re.MULTILINE)]


def faults_of_reference(folder, manual):
    there, wanted = sorted(headings(folder)), sorted(re.findall(r"^\* \*\*(.*?)\*\*", manual, re.MULTILINE))
    if there != wanted:
        yield f"the reference has {len(there)} entries, the manual {len(wanted)}: {set(there) ^ set(wanted)}"


def faults_of_examples(folder, scenes):
    entries = {scene.name: {(name, value) for _, name, value in scene.entries} for scene in scenes}
    found = [match for page in folder.glob("*.md") for match in EXAMPLE.findall(page.read_text())]
    if len(found) < 100:
        yield f"there are {len(found)} examples only"
    yield from (f"{scene} does not set {name} = {value}" for scene, name, value in found if (name, value) not in entries[scene])


def faults_of_units(scenes):
    """Files for ParaView have the units of the entry only."""
    for scene in scenes:
        told, units = re.search(r"Units: (?!any)", scene.text), [value for *place, value in scene.entries if place == ["Output", "Units"]]
        if told and not units:
            yield f"{scene.name}: its head comment names units, but there is no Output/Units"


def lines_shown(text, options):
    """Numbers of the lines that Sphinx includes."""
    options = dict(re.findall(r"^:([\w-]+): (.*)$", options, re.MULTILINE))
    lines = text.splitlines()
    first = next(i for i, line in enumerate(lines) if options["start-at"] in line)
    last = next((i for i, line in enumerate(lines) if i > first and options["end-before"] in line), first) \
        if "end-before" in options else len(lines)
    return set(range(first, last))


def faults_of_tutorial(page):
    shown = {}
    for name, options in INCLUDED.findall(page.read_text()):
        shown.setdefault(name, set()).update(lines_shown((page.parent / name).read_text(), options))
    for file in sorted((page.parent / page.stem).glob("*.*")):
        name = f"{page.stem}/{file.name}"
        if file.suffix not in (".geo", ".prm", ".py"):
            continue
        if f"]({name})" not in page.read_text():
            yield f"{page.name}: no link leads to {name}"
        comment = "#" if file.suffix != ".geo" else "//"
        hidden = [line for i, line in enumerate(file.read_text().splitlines())
                  if i not in shown.get(name, ()) and line.strip() and not line.startswith(comment)]
        yield from (f"{page.name}: does not show '{line}' of {name}" for line in hidden)


def faults_of_theory(text):
    left = re.findall(r"@f|\\our|\{#", sitepages.for_sphinx(text))
    if left:
        yield f"the theory has words of Doxygen left: {set(left)}"


def main(program):
    manual = subprocess.run([program, "--parameters"], check=True, text=True, stdout=subprocess.PIPE).stdout
    scenes = sitepages.read_scenes(TOP / "parameter-files")
    with tempfile.TemporaryDirectory() as top:
        folder = Path(top) / "reference"
        sitepages.write_reference(folder, manual, scenes)
        sitepages.write_scenes(Path(top) / "scenes", TOP / "doc/gallery", scenes)
        faults = [*faults_of_reference(folder, manual), *faults_of_examples(folder, scenes),
                  *faults_of_units(scenes), *faults_of_units(sitepages.read_scenes(TOP / "doc/site/tutorials", "*/*.prm")),
                  *(fault for page in sorted((TOP / "doc/site/tutorials").glob("*.md")) for fault in faults_of_tutorial(page)),
                  *faults_of_theory((TOP / "doc/doxygen/theory.md").read_text())]
        if len(list((Path(top) / "scenes").glob("*.md"))) != len(scenes) + 1:
            faults.append("a scene has no page")
    print("\n".join(faults) or f"{len(scenes)} scenes, {len(re.findall('^[*] [*][*]', manual, re.MULTILINE))} entries")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
