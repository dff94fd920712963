#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program makes of its entries for shells and editors, used as bash, vim and others use it.

usage: check_editors.py PROGRAM CASE

  bash      completions of options, files and entries, by a script and in a terminal
  vim       colours of a scene in vim, where it is installed with its syntax files
  textmate  colours of scenes by the grammar that VS Code reads
  schema    all entries with types, defaults and values; all shipped scenes fit
"""
import json
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
sys.path.append(str(TOP / "python"))
SCENES = TOP / "parameter-files"
SCENE = "floating-block.prm"


class Editors:
    def __init__(self, program):
        self.program = Path(program).resolve()
        self.folder = Path(tempfile.mkdtemp(prefix="conetact-editors-"))
        shutil.copy(SCENES / SCENE, self.folder)
        self.failed = 0

    def demand(self, what, holds, found=""):
        print(f"  {'' if holds else 'FAILED: '}{what}{'' if holds else f': {found}'}")
        self.failed += not holds

    def text(self, *words):
        return subprocess.run([self.program, *words], cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def bash(self):
        (self.folder / "completion").write_text(self.text("--completion", "bash"))
        (self.folder / "conetact").symlink_to(self.program)
        (self.folder / "runs").mkdir()
        (self.folder / "an other.prm").write_text("include " + SCENE)
        help_text = self.text("--help")
        options = set(re.findall(r"^ +(?:-\w, )?(--[\w-]+)", help_text, re.M)) | set(re.findall(r"^  (-\w),", help_text, re.M))
        self.demand("all options of --help", set(self.complete("./conetact -")) == options, self.complete("./conetact -"))
        for typed, expected in (("./conetact --re", ["--restart"]), ("./conetact fl", [SCENE]), ("./conetact a", ["an other.prm"]),
                                (f"./conetact {SCENE} -o ru", ["runs"]), (f"./conetact {SCENE} --output=ru", ["runs"]),
                                ("./conetact com", ["compare"]), ("./conetact compare r", ["runs"]), ("./conetact --grammar ", ["vim", "vscode"]),
                                ("./conetact -s Sol", []), (f"./conetact {SCENE} --jobs ", [])):
            self.demand(typed, self.complete(typed) == expected, self.complete(typed))
        self.complete_entries()
        self.in_terminal()

    def complete_entries(self):
        """One subsection after the other, then values; as they must be quoted where they stand."""
        for scene in (SCENE, "an\\ other.prm", "'an other.prm'"):
            top = set(self.complete(f"./conetact {scene} -s "))
            self.demand(f"{scene}: lists and sections", {"Bodies=", "Body\\ block/", "Contact\\ bottom/", "Solver/"} <= top, top)
        start = f"./conetact {SCENE} -s "
        for typed, expected in (
                ("Contact\\ bottom/Friction\\ c", ["Contact\\ bottom/Friction\\ coefficient=", "Contact\\ bottom/Friction\\ coefficient=0.5"]),
                ('"Contact bottom/Friction c', ["Contact bottom/Friction coefficient=", "Contact bottom/Friction coefficient=0.5"]),
                ("'Body block/Mate", None), ("Solver/Method=act", ["active\\ set"]), ('"Solver/Method=act', ["Solver/Method=active set"]),
                ("Nothing/", []), ("Dimension=", ["2", "3"])):
            found = self.complete(start + typed)
            if expected is None:
                self.demand(f"{typed}: goes on into it", "Body block/Material/Young modulus=" in found, found)
            else:
                self.demand(typed, found == expected, found)
        before = self.complete(f"./conetact {SCENE} -q --set=Solver/Thr")
        self.demand("--set=", before == ["Solver/Threads=", "Solver/Threads=1"], before)

    def complete(self, typed):
        """What bash would offer at the end of a line."""
        script = ('. ./completion; compopt() { :; }; COMP_LINE=$1; COMP_POINT=${#1}; _conetact ./conetact; '
                  'for reply in "${COMPREPLY[@]}"; do printf "%s\\n" "$reply"; done')
        done = subprocess.run(["bash", "--norc", "-c", script, "bash", typed], cwd=self.folder, capture_output=True, text=True)
        if done.stderr:
            return [done.stderr]
        return done.stdout.splitlines()

    def in_terminal(self):
        """With readline, which adds and quotes: what a user types with tabs is what the program gets."""
        (self.folder / "conetact").unlink()
        (self.folder / "conetact").write_text(
            f'#!/bin/sh\ncase "$*" in *--completion*) exec "{self.program}" "$@";; esac\nprintf "<%s>" "$@" > got\n')
        (self.folder / "conetact").chmod(0o755)
        for typed, expected in ((f"./conetact fl\t-s \"Contact bottom/Fri\tc\t0.7\"", f"<{SCENE}><-s><Contact bottom/Friction coefficient=0.7>"),
                                (f"./conetact fl\t-s Contact\\ bottom/Fri\tc\t0.7", f"<{SCENE}><-s><Contact bottom/Friction coefficient=0.7>"),
                                (f"./conetact fl\t--se\tSolver/Meth\tact\t", f"<{SCENE}><--set><Solver/Method=active set>"),
                                (f"./conetact 'an\t -s 'Solver/Meth\tact\t", "<an other.prm><-s><Solver/Method=active set>"),
                                (f"./conetact fl\t--out\tru\t", f"<{SCENE}><--output><runs/>")):
            got = self.type(typed)
            self.demand(f"in a terminal: {typed!r}", got == expected, got)

    def type(self, typed):
        (self.folder / "got").unlink(missing_ok=True)
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.folder)
            os.environ.update(TERM="dumb", PS1="ready ", INPUTRC="/dev/null")
            os.execvp("bash", ["bash", "--norc", "--noprofile", "-i"])
        self.wait_for(terminal, "ready ")
        os.write(terminal, b"bind 'set bell-style none'; . ./completion\n")
        self.wait_for(terminal, "ready ")
        for part in re.split("(\t)", typed):
            os.write(terminal, part.encode())
            self.wait_quiet(terminal)
        os.write(terminal, b"\nexit\n")
        self.wait_for(terminal, "exit")
        os.waitpid(child, 0)
        os.close(terminal)
        got = self.folder / "got"
        return got.read_text() if got.exists() else ""

    @staticmethod
    def wait_for(terminal, text, seconds=60):
        seen, until = "", time.monotonic() + seconds
        while text not in seen.split("\n")[-1] and text + "\r" not in seen and time.monotonic() < until:
            if select.select([terminal], [], [], .1)[0]:
                try:
                    seen += os.read(terminal, 4096).decode(errors="replace")
                except OSError:
                    return

    def wait_quiet(self, terminal):
        """Until nothing has come for a while, and no program of a completion runs."""
        quiet = 0
        while quiet < 4:
            if select.select([terminal], [], [], .1)[0]:
                os.read(terminal, 4096)
                quiet = 0
            else:
                busy = subprocess.run(["pgrep", "-f", f"{self.folder}|{self.program} .*--completion entries"], capture_output=True).stdout
                quiet = 0 if busy else quiet + 1

    def vim(self):
        if shutil.which("vim") is None or "+syntax" not in subprocess.run(["vim", "--version"], capture_output=True, text=True).stdout:
            print("skipped: vim with its syntax files is not installed (Debian: vim)")
            return
        (self.folder / "syntax").mkdir()
        (self.folder / "syntax/conetact.vim").write_text(self.text("--grammar", "vim"))
        (self.folder / "scene.prm").write_text("\n".join(line for line, _ in COLOURS) + "\n")
        script = ["syntax on", "setf conetact", "let g:out = []",
                  *(f"call add(g:out, synIDattr(synID({n}, {column + 1}, 0), 'name'))"
                    for n, (line, words) in enumerate(COLOURS, 1) for column, _ in places(line, words)),
                  "call writefile(g:out, 'colours')", "qa!"]
        (self.folder / "script.vim").write_text("\n".join(script) + "\n")
        subprocess.run(["vim", "-u", "NONE", "-N", "-es", "--cmd", "set rtp^=.", "-S", "script.vim", "scene.prm"], cwd=self.folder,
                       stdin=subprocess.DEVNULL, capture_output=True, timeout=120)
        found = (self.folder / "colours").read_text().splitlines()
        expected = [(line, word, "conetact" + kind) for line, words in COLOURS for _, (word, kind) in places(line, words)]
        for (line, word, kind), seen in zip(expected, found):
            self.demand(f"{word!r} in {line!r}: {kind}", seen == kind, seen)
        self.demand("all were asked for", len(found) == len(expected), found)

    def textmate(self):
        grammar = json.loads(self.text("--grammar", "vscode"))
        self.demand("for files *.prm", grammar["fileTypes"] == ["prm"] and grammar["scopeName"] == "source.conetact")
        for line, words in COLOURS:
            scopes = coloured(grammar, line)
            for column, (word, kind) in places(line, words):
                self.demand(f"{word!r} in {line!r}: {TEXTMATE[kind]}", scopes[column].startswith(TEXTMATE[kind]) if TEXTMATE[kind]
                            else not scopes[column], scopes[column])
        unknown = []
        for scene in sorted(SCENES.glob("*.prm")):
            unknown += [(scene.name, line) for line in joined_lines(scene.read_text())
                        if any(scope.startswith("invalid") for scope in coloured(grammar, line))]
        self.demand("nothing in shipped scenes is unknown", not unknown, unknown[:3])

    def schema(self):
        from conetact import program  # the manual, read from --parameters
        os.environ["CONETACT"] = str(self.program)
        schema = json.loads(self.text("--schema"))
        wrong, known = [], dict(flat(schema))
        for section, entries in program.manual().items():
            for name, entry in entries.items():
                found = known.pop((section, name), None)
                if found is None or found["description"] != entry.text or plain(found.get("default", "")) != entry.default:
                    wrong.append((section, name, entry.default, found))
        self.demand("entries, defaults and texts are those of the manual, and no others", not wrong and not known, (wrong[:2], list(known)[:2]))
        for path, name, piece in (("Solver", "Threads", {"type": "integer", "minimum": 0, "maximum": 1024, "default": 1}),
                                  ("", "Dimension", {"type": "string", "enum": ["2", "3"], "default": "2"}),
                                  ("Obstacle NAME", "Shape", {"type": "string", "default": "half space"})):
            found = dict(flat(schema))[path, name]
            self.demand(f"{path}/{name}: {piece}", piece.items() <= found.items(), found)
        bad = []
        for scene in sorted(SCENES.glob("*.prm")):
            tree = read_tree(self.text(scene, "--parameters"), schema)
            bad += [(scene.name, fault) for fault in faults_of(tree, schema)]
        self.demand("all shipped scenes fit", not bad, bad[:3])
        for fault in ({"Solver": {"Threads": -1}}, {"Solver": {"Thread": 1}}, {"Body b": {"Kind": "beam"}}, {"Bodi": {}},
                      {"Solver": {"Threads": "one"}}):
            self.demand(f"{fault} does not", list(faults_of(fault, schema)))


# lines of scenes, and what some of their words are
COLOURS = (
    ("# set Dimension = 2", (("Dimension", "Comment"),)),
    ("set Dimension = 3 # space", (("set", "Set"), ("Dimension", "Entry"), ("=", "Equals"), ("3", "Number"), ("space", "Comment"))),
    ("set Dimensions = 3", (("Dimensions", "Unknown"), ("3", "Number"))),
    ("subsection Body block # one", (("subsection", "Subsection"), ("Body", "Kind"), ("block", "Name"), ("one", "Comment"))),
    ("  subsection Mesh", (("subsection", "Subsection"), ("Mesh", "Section"))),
    ("    set Boundary ids = 5: y > 9.5e-3", (("Boundary ids", "Entry"), ("9.5e-3", "Number"))),
    ("    set Young modulus=210e3", (("Young modulus", "Entry"), ("210e3", "Number"))),
    ("  end # of it", (("end", "End"), ("of it", "Comment"))),
    ("  subsection Meshes", (("Meshes", "Error"),)),
    ("set Shape = half space", (("Shape", "Entry"), ("half space", "Word"))),
    ("include parts/other.prm # more", (("include", "Include"), ("parts", "File"), ("more", "Comment"))),
)
TEXTMATE = {"Comment": "comment", "Set": "keyword.control", "Entry": "support.type.property-name", "Equals": "keyword.operator",
            "Number": "constant.numeric", "Unknown": "invalid", "Subsection": "keyword.control", "Kind": "entity.name.section",
            "Section": "entity.name.section", "Name": "variable.other", "End": "keyword.control", "Error": "invalid",
            "Word": "constant.language", "Include": "keyword.control", "File": "string.unquoted"}


def places(line, words):
    return [(line.index(word), (word, kind)) for word, kind in words]


def joined_lines(text):
    return [line for line in re.sub(r"\\\s*(#.*)?\n", " ", text).splitlines() if line.strip()]


def coloured(grammar, line):
    """The colour of each letter of one line, by the rules of TextMate: the first match, of equal ones the first rule."""
    scopes = [""] * len(line)

    def paint(begin, end, name):
        scopes[begin:end] = [name] * (end - begin)

    def groups(match, names):
        for number, style in names.items():
            if match[int(number)] is not None:
                paint(match.start(int(number)), match.end(int(number)), style["name"])

    def scan(begin, patterns):
        while begin <= len(line):
            found = [(match.start(), rank, match, rule) for rank, rule in enumerate(patterns)
                     if (match := re.compile(rule.get("match") or rule["begin"]).search(line, begin))]
            if not found:
                return
            _, _, match, rule = min(found, key=lambda f: f[:2])
            if "name" in rule:
                paint(match.start(), match.end(), rule["name"])
            groups(match, rule.get("captures") or rule.get("beginCaptures") or {})
            begin = max(match.end(), begin + 1)
            if "begin" in rule:
                return scan(match.end(), rule["patterns"])
    scan(0, grammar["patterns"])
    return scopes


TYPES = {"object": dict, "string": str, "integer": int, "number": (int, float), "boolean": bool}


def faults_of(value, schema, path=""):
    """What a schema says of a value, by the few words that ours has."""
    if not isinstance(value, TYPES[schema["type"]]):
        yield f"{path}: {value} is no {schema['type']}"
    elif schema["type"] != "object":
        if "enum" in schema and value not in schema["enum"]:
            yield f"{path}: {value} is none of {schema['enum']}"
        if not schema.get("minimum", value) <= value <= schema.get("maximum", value):
            yield f"{path}: {value} is out of bounds"
    else:
        for name, below in value.items():
            own = schema.get("properties", {}).get(name) or next(
                (s for pattern, s in schema.get("patternProperties", {}).items() if re.search(pattern, name)), None)
            if own is None:
                yield f"{path}: there is no {name}"
            else:
                yield from faults_of(below, own, f"{path}/{name}")


def flat(schema, section=""):
    """((section, name), schema) of each entry, with NAME as in the manual."""
    for name, below in schema.get("properties", {}).items():
        if below["type"] == "object":
            yield from flat(below, f"{section}/{name}".strip("/"))
        else:
            yield (section, name), below
    for pattern, below in schema.get("patternProperties", {}).items():
        yield from flat(below, f"{section}/{pattern.strip('^$').replace('.+', 'NAME')}".strip("/"))


def plain(value):
    return {True: "true", False: "false"}.get(value) if isinstance(value, bool) else str(value) if not isinstance(value, float) else f"{value:g}"


def read_tree(text, schema):
    """A scene as objects, numbers where the schema has numbers."""
    tree, stack, schemas = {}, [], [schema]
    at = tree
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("subsection "):
            name = line[len("subsection "):]
            stack.append(at)
            at = at.setdefault(name, {})
            here = schemas[-1]
            schemas.append(here.get("properties", {}).get(name) or next(
                (s for p, s in here.get("patternProperties", {}).items() if re.search(p, name)), {}))
        elif line == "end":
            at = stack.pop()
            schemas.pop()
        elif line.startswith("set "):
            name, value = (part.strip() for part in line[4:].split("#")[0].split("=", 1))
            kind = schemas[-1].get("properties", {}).get(name, {}).get("type")
            at[name] = int(value) if kind == "integer" else float(value) if kind == "number" else value == "true" if kind == "boolean" else value
    return tree


def main(program, case):
    editors = Editors(program)
    getattr(editors, case)()
    shutil.rmtree(editors.folder)
    return 1 if editors.failed else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
