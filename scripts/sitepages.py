# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of the site that are made: of the program's manual, of shipped scenes, of the theory for Doxygen."""
import re
from pathlib import Path

HEAD = ("<!-- SPDX-FileCopyrightText: Conetact authors -->\n"
        "<!-- SPDX-License-Identifier: LGPL-2.1-or-later -->\n")
ENTRY = re.compile(r"^\* \*\*(?P<name>[^*]+)\*\*(?: = `(?P<default>[^`]*)`)?: (?P<text>.*)$")
UNIT = re.compile(r"\s*\[([^\]]*)\]\.?\s*$")
NAMED = re.compile(r"^(Body|Obstacle|Contact|Support|Load|Section) .+")
MOST_EXAMPLES, LONGEST_EXAMPLE = 3, 70


class Scene:
    """A shipped scene: the words of its head comment, and its entries (section, entry, value) in order."""

    def __init__(self, file):
        self.name, self.text = file.stem, file.read_text()
        self.entries = list(entries_of(self.text))

    def head(self):
        lines = re.match(r"(#[^\n]*\n)+", self.text).group().splitlines()
        return "\n".join(line[2:] for line in lines if "SPDX-" not in line).strip()


def entries_of(text):
    """Names of users are NAME, as the manual writes them."""
    sections = []
    for line in re.sub(r"\\\n\s*", "", text).splitlines():
        line = line.partition("#")[0].strip()
        if line.startswith("subsection "):
            sections.append(NAMED.sub(r"\1 NAME", line.removeprefix("subsection ").strip()))
        elif line == "end":
            sections.pop()
        elif match := re.match(r"set\s+([^=]+?)\s*=\s*(.*)", line):
            yield "/".join(sections), *match.groups()


def read_scenes(folder, pattern="*.prm"):
    return [Scene(file) for file in sorted(Path(folder).glob(pattern))]


def uses(scenes, section, entry):
    """Different values of an entry, each with the first scene that has it, short ones only, one of each scene."""
    found = {}
    for scene in scenes:
        for place, name, value in scene.entries:
            if (place, name) == (section, entry) and 0 < len(value) <= LONGEST_EXAMPLE and scene.name not in found.values():
                found.setdefault(value, scene.name)
    return found


def split_manual(manual):
    """Title of each section and its lines; those before the first one are the introduction."""
    parts = re.split(r"^## (.*)\n", manual, flags=re.MULTILINE)
    return parts[0], list(zip(parts[1::2], parts[2::2]))


def file_of(section):
    return re.sub(r"[^a-z]+", "-", section.lower()).strip("-")


def escaped(text):
    """The manual is plain text: what Markdown would read as marks of its own is written with a backslash."""
    return re.sub(r"([\\`*_<>\[\]$|{}])", r"\\\1", text)




def written_text(text):
    """Lists of choices as lists, all else as it is."""
    pieces = []
    for sentence in re.split(r"(?<=\.) (?=[A-Z])", text):
        choices = re.split(r"; (?=[A-Za-z][\w -]{0,30}: )", sentence)
        if len(choices) > 1 and re.match(r"[\w -]{1,30}: ", choices[0]):
            pieces.append("\n\n" + "".join(choice_line(*choice.partition(": ")[::2]) for choice in choices) + "\n")
        else:
            pieces.append(escaped(sentence) + " ")
    return "".join(pieces).strip()


def choice_line(name, text):
    return f"* `{name}`: {escaped(text)}\n"


def written_entry(match, section, scenes):
    name, default, text = match["name"], match["default"], match["text"]
    unit = UNIT.search(text)
    facts = [f"default `{default}`" if default else "no default"] + ([f"unit {escaped(unit[1])}"] if unit and unit[1] != "-" else [])
    examples = uses(scenes, section, name)
    lines = [f"## {name}\n", f"*{'; '.join(facts)}*\n", written_text(UNIT.sub("", text)) + "\n"]
    if examples:
        shown = list(examples.items())[:MOST_EXAMPLES]
        lines.append("Used so in:\n\n" + "".join(f"* [{scene}](../scenes/{scene}.md): `set {name} = {value}`\n"
                                                   for value, scene in shown))
    return "\n".join(lines)


def written_lines(text, section, scenes):
    """Entries, and what is said between them."""
    pieces = []
    for line in text.splitlines():
        match = ENTRY.match(line)
        pieces.append(written_entry(match, section, scenes) if match else written_remark(line))
    return "\n".join(pieces)


def written_remark(line):
    return line if line.startswith(("`", "*")) else escaped(line)


def write_reference(folder, manual, scenes):
    folder.mkdir(parents=True)
    introduction, sections = split_manual(manual)
    head, _, top = introduction.partition("\n* ")
    pages = {"scene": ("Entries of the scene itself", "* " + top, "")}
    pages |= {file_of(title): (title, text, title) for title, text in sections}
    for name, (title, text, section) in pages.items():
        place = f"They stand in `subsection {section.replace('/', '`, `subsection ')}`.\n\n" if section else ""
        (folder / f"{name}.md").write_text(f"{HEAD}# {title}\n\n{place}{written_lines(text, section, scenes)}")
    toc = "\n".join(pages)
    words = head.partition("\n")[2].strip()
    (folder / "index.md").write_text(f"{HEAD}# Reference of all entries\n\n{words}\n\n"
                                     "Each entry has its default, its unit, what it does, and scenes that use it.\n"
                                     "`conetact --parameters` prints the same text.\n\n"
                                     f"```{{toctree}}\n:maxdepth: 1\n\n{toc}\n```\n")


def write_scenes(folder, gallery, scenes):
    folder.mkdir(parents=True)
    for scene in scenes:
        picture = f"![{scene.name}](../../gallery/{scene.name}.png)\n\n" if (gallery / f"{scene.name}.png").exists() else ""
        (folder / f"{scene.name}.md").write_text(
            f"{HEAD}# {scene.name}\n\n```text\n{scene.head()}\n```\n\n{picture}"
            f"```{{literalinclude}} ../../../parameter-files/{scene.name}.prm\n:language: prm\n:linenos:\n```\n")
    names = "\n".join(scene.name for scene in scenes)
    (folder / "index.md").write_text(f"{HEAD}# All scenes\n\nThese scenes come with the program, in `parameter-files`.\n"
                                     f"The [gallery](../../gallery.md) shows them by kind.\n\n"
                                     f"```{{toctree}}\n:maxdepth: 1\n\n{names}\n```\n")


def for_sphinx(text):
    """Formulas, marks and links to code as Doxygen knows them, in the words of MyST."""
    text = re.sub(r"@f\[(.*?)@f\]", lambda match: f"\n$$\n{match[1].strip()}\n$$\n", text, flags=re.DOTALL)
    text = re.sub(r"@f\$(.*?)@f\$", lambda match: f"${' '.join(match[1].split())}$", text, flags=re.DOTALL)
    text = re.sub(r"\\our\{(?:\w+::)?([^}]*)\}", r"`\1`", text)
    text = re.sub(r"^# (.*?) \{#(theory_\w+)\}$", r"(\2)=\n## \1", text, flags=re.MULTILINE)
    return re.sub(r"^# (.*?) \{#theory\}$", r"# \1", text, flags=re.MULTILINE)


def write_theory(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(for_sphinx(text))


def write_cpp(file, there):
    """Doxygen's pages are beside those of Sphinx if they were made."""
    words = ('<a href="../../cpp/index.html">Pages of the C++ code</a> have the headers of all rooms, and how to add kinds of things.\n'
             if there else "`cmake --build build --target doc` makes the pages of the C++ code (it needs Doxygen).\n")
    file.write_text(f"{HEAD}# C++ code\n\n{words}\n[AGENTS.md](../../AGENTS.md) names the rooms of the program, and\n"
                    "[CONTRIBUTING.md](../../CONTRIBUTING.md) says how to build, test and change it.\n")
