#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of the documentation that are written by hand: their pictures and the files they link to are there.

usage: check_site.py FOLDER [PATTERN...]
       FOLDER: build/doc/html, which target doc makes; build/site/html of target site with the pattern **/*.html

Doxygen warns of links that it knows to be links to code or pages only. Pages of the
second one may load nothing from another site.
"""
import functools
import html.parser
import sys
import urllib.parse
from pathlib import Path

PAGES = ("index.html", "theory.html", "extending.html", "md_*.html")


class References(html.parser.HTMLParser):
    """Pictures and links of a page, and what may be linked to in it."""

    def __init__(self, page):
        super().__init__()
        self.found, self.ids, self.loaded, self.n_pictures = set(), set(), set(), 0
        self.feed(page.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids |= {attributes[key] for key in ("id", "name") if attributes.get(key)}
        self.n_pictures += tag == "img"
        name = attributes.get({"img": "src", "a": "href"}.get(tag))
        source = attributes.get("href" if tag == "link" else "src")
        if tag in ("script", "link", "img") and source and "//" in source.partition("?")[0]:
            self.loaded.add(source)
        if name and "://" not in name and not name.startswith(("javascript:", "mailto:")):
            self.found.add(name)


@functools.lru_cache(maxsize=None)
def ids_of(page):
    return References(page).ids


def faults_of(page, references):
    for name in sorted(references.found):
        file, _, mark = name.partition("#")
        target = page.parent / urllib.parse.unquote(file) if file else page
        if not target.is_file():
            yield f"{page.name}: there is no {name}"
        elif mark and target.suffix == ".html" and mark not in ids_of(target):
            yield f"{page.name}: {target.name} has no place '{mark}'"


def main(folder, *patterns):
    files = {page for pattern in patterns or PAGES for page in Path(folder).glob(pattern)}
    pages = {page: References(page) for page in sorted(files) if "cpp" not in page.relative_to(folder).parts}
    faults = [fault for page, references in pages.items() for fault in faults_of(page, references)]
    if patterns:
        faults += [f"{page.name}: loads {name}" for page, references in pages.items() for name in sorted(references.loaded)]
    n_pictures = sum(references.n_pictures for references in pages.values())
    print("\n".join(faults) or f"{len(pages)} pages, {n_pictures} pictures")
    return bool(faults) or not n_pictures


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
