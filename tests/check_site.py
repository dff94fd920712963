#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of the documentation that are written by hand: their pictures and the files they link to are there.

usage: check_site.py FOLDER      (build/doc/html, which target doc makes)

Doxygen warns of links that it knows to be links to code or pages only.
"""
import html.parser
import sys
from pathlib import Path

PAGES = ("index.html", "theory.html", "extending.html", "md_*.html")


class References(html.parser.HTMLParser):
    """Pictures and links of a page, and what may be linked to in it."""

    def __init__(self, page):
        super().__init__()
        self.found, self.ids, self.n_pictures = set(), set(), 0
        self.feed(page.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        self.n_pictures += tag == "img"
        name = attributes.get({"img": "src", "a": "href"}.get(tag))
        if name and "://" not in name and not name.startswith(("javascript:", "mailto:")):
            self.found.add(name)


def faults_of(page, references):
    for name in sorted(references.found):
        file, _, mark = name.partition("#")
        target = page.parent / file if file else page
        if not target.is_file():
            yield f"{page.name}: there is no {name}"
        elif mark and target.suffix == ".html" and mark not in References(target).ids:
            yield f"{page.name}: {target.name} has no place '{mark}'"


def main(folder):
    pages = {page: References(page) for pattern in PAGES for page in sorted(Path(folder).glob(pattern))}
    faults = [fault for page, references in pages.items() for fault in faults_of(page, references)]
    n_pictures = sum(references.n_pictures for references in pages.values())
    print("\n".join(faults) or f"{len(pages)} pages, {n_pictures} pictures")
    return bool(faults) or not n_pictures


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
