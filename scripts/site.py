#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Builds the site for users, one folder that a browser opens without network.

usage: site.py PROGRAM FOLDER [--cpp PAGES_OF_DOXYGEN] [--theme NAME]

FOLDER/source receives the pages as the source tree has them, with those that are made: a reference of all entries
from `PROGRAM --parameters`, a page for each scene, the theory with formulas that Sphinx reads. FOLDER/html is the
site; a warning of Sphinx is an error. Needs python3-sphinx, python3-myst-parser, furo and libjs-mathjax of Debian.
"""
import argparse
import shutil
import subprocess
import sys
from pathlib import Path

import sitepages  # what is made of the program's manual, scenes and theory

TOP = Path(__file__).resolve().parent.parent
PAGES = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "AGENTS.md", "tests/README.md", "LICENSE", "CITATION.cff")
FOLDERS = ("doc", "parameter-files")
NOT_COPIED = shutil.ignore_patterns("doxygen", "man", "__pycache__")
MATHJAX = Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_SVG.js", "jax/output/SVG", "jax/input/TeX", "jax/element",
                 "extensions/TeX", "extensions/MathMenu.js", "extensions/MathZoom.js")
SERVED = "/javascript/normalize.css/normalize.css"
START = "doc/site/index.html"
REDIRECT = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Conetact</title>
<meta http-equiv="refresh" content="0; url={START}"></head>
<body><a href="{START}">Conetact: documentation</a></body></html>
"""


def copy_pages(source):
    """The same places as in the source tree, so that links of pages lead to the same files."""
    for name in PAGES:
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(TOP / name, source / name)
    for name in FOLDERS:
        shutil.copytree(TOP / name, source / name, ignore=NOT_COPIED)


def make_pages(source, program, cpp):
    manual = subprocess.run([program, "--parameters"], check=True, text=True, stdout=subprocess.PIPE).stdout
    scenes = sitepages.read_scenes(TOP / "parameter-files")
    sitepages.write_reference(source / "doc/site/reference", manual, scenes)
    sitepages.write_scenes(source / "doc/site/scenes", source / "doc/gallery", scenes)
    sitepages.write_theory(source / "doc/doxygen/theory.md", (TOP / "doc/doxygen/theory.md").read_text())
    sitepages.write_cpp(source / "doc/site/cpp.md", bool(cpp))


def copy_mathjax(html):
    """The parts that draw formulas as outlines: fonts of the web are not loaded by pages from a disk."""
    for part in MATHJAX_PARTS:
        goal = html / "_static/mathjax" / part
        goal.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (MATHJAX / part).is_dir() else shutil.copy)(MATHJAX / part, goal)


def serve_without_server(html):
    """Debian's furo imports a script, which browsers refuse to pages from a disk, and a style from a web server's root."""
    script, style = html / "_static/scripts/furo.js", html / "_static/styles/furo.css"
    if not script.exists():
        return
    begin, _, own = script.read_text().partition("\n")
    if begin.startswith("import Gumshoe"):
        # a page of one section has no places to be told apart by
        own = own.replace("tocScroll === null", """tocScroll === null || !document.querySelector('.toc-tree a[href*="#"]:not([href="#"])')""")
        script.write_text(script.with_name("gumshoe-patched.js").read_text() + own)
    text = style.read_text()
    if SERVED in text:
        shutil.copy(f"/usr/share{SERVED}", style.with_name("normalize.css"))
        style.write_text(text.replace(SERVED, "normalize.css"))


def run_sphinx(folder, theme):
    command = ["sphinx-build", "-W", "--keep-going", "-q", "-b", "html", "-c", TOP / "doc/site", "-D", f"html_theme={theme}",
               folder / "source", folder / "html"]
    return subprocess.run([str(word) for word in command]).returncode


def main(arguments):
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0].replace("site.py", "%(prog)s"))
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--cpp", type=Path, help="pages of the C++ code that the target doc makes; they come along if they are there")
    parser.add_argument("--theme", default="furo", help="furo, sphinx_rtd_theme or any other one that is installed")
    args = parser.parse_args(arguments)
    args.cpp = args.cpp if args.cpp and args.cpp.is_dir() else None
    for name in ("source", "html"):
        shutil.rmtree(args.folder / name, ignore_errors=True)
    copy_pages(args.folder / "source")
    make_pages(args.folder / "source", args.program.resolve(), args.cpp)
    if code := run_sphinx(args.folder, args.theme):
        return code
    copy_mathjax(args.folder / "html")
    serve_without_server(args.folder / "html")
    (args.folder / "html/index.html").write_text(REDIRECT)
    if args.cpp:
        shutil.copytree(args.cpp, args.folder / "html/cpp")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
