#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Links of the pages in Markdown lead to files and headings that are there, and README.md leads to each page of doc/.

usage: check_links.py SOURCE_TREE

Links to other sites are not followed. Code is no text: what looks like a link in it is none.
"""
import re
import sys
from pathlib import Path

PAGES = ("*.md", "doc/**/*.md", "tests/*.md", "source/*/README.md")
LINK = re.compile(r"\]\(\s*([^()\s]+)\s*\)")
ELSEWHERE = re.compile(r"[a-z]+:")  # https:, mailto:
CODE = re.compile(r"^(```|~~~).*?^\1[^\n]*$|^(?:\n|\A)(?: {4}[^\n]*\n)+|(?<!`)(`+)(?!`).+?(?<!`)\2(?!`)", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^#{1,6} +(.*?)(?: +\{#([\w-]+)\})? *$", re.MULTILINE)


def without_code(text):
    return CODE.sub("\n", text)


def without_fences(text):
    """Headings may have code in them, but lines of scripts that begin with # are none."""
    return re.sub(r"^(```|~~~).*?^\1[^\n]*$", "", text, flags=re.MULTILINE | re.DOTALL)


def marks(text):
    """What may stand behind # in a link to the page: headings as GitHub writes them, and names that are given."""
    found = set()
    for title, name in HEADING.findall(without_fences(text)):
        words = re.sub(r"\]\([^)]*\)", "", title).lower()
        mark = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        n = next(n for n in range(1000) if (f"{mark}-{n}" if n else mark) not in found)
        found |= {f"{mark}-{n}" if n else mark, name} - {""}
    return found


def links(page):
    return [link for link in LINK.findall(without_code(page.read_text())) if not ELSEWHERE.match(link)]


def target_of(page, link):
    """The file that a link leads to. Pages for Doxygen call pictures by their names alone."""
    file = link.partition("#")[0]
    target = (page.parent / file).resolve() if file else page
    if not target.exists() and page.parent.name == "doxygen" and "/" not in file:
        target = page.parent.parent / file
    return target


def faults_of(page, tree):
    for link in links(page):
        target, mark = target_of(page, link), link.partition("#")[2]
        if not target.exists():
            yield f"{page.relative_to(tree)}: there is no {link}"
        elif mark and (target.suffix != ".md" or mark not in marks(target.read_text())):
            yield f"{page.relative_to(tree)}: there is no heading {link}"


def pages_without_link(tree):
    readme = tree / "README.md"
    linked = {target_of(readme, link) for link in links(readme)}
    return [f"README.md: no link leads to doc/{page.name}" for page in sorted(tree.glob("doc/*.md")) if page not in linked]


def main(tree):
    tree = Path(tree).resolve()
    pages = sorted({page for pattern in PAGES for page in tree.glob(pattern)})
    faults = [fault for page in pages for fault in faults_of(page, tree)] + pages_without_link(tree)
    print("\n".join(faults) or f"{len(pages)} pages, {sum(len(links(page)) for page in pages)} links")
    return bool(faults) or not pages


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
