#!/usr/bin/env python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the pages in doc/doxygen call by name is there: files, classes, functions, members, snippets.

usage: check_doc_names.py SOURCE_TREE

Doxygen finds the same and more where it is installed.
"""
import pathlib
import re
import sys

FOLDERS = ("source", "include", "tests", "doc", "examples", "scripts", "benchmarks")


def declared(code, name):
    """Each part of Class::member() stands in the headers; the first one as class, function or constant."""
    first, *rest = name.removesuffix("()").split("::")
    if rest and f"namespace conetact::{first}\n" in code:
        first, *rest = rest
    begin = rf"\b{first}\s*\(" if name.endswith("()") and not rest else rf"(class|struct|enum class|using)\s+{first}\b"
    return re.search(begin, code) and all(re.search(rf"\b{part}\b", code) for part in rest)


def faults_of(page, code, tree):
    text = page.read_text()
    for name in re.findall(r"\\our\{([^}]*)\}", text):
        if not declared(code, name):
            yield f"{page.name}: there is no {name} in the headers"
    for name in re.findall(r"`([\w./-]+)`", text):
        if name.split("/")[0] in FOLDERS and "/" in name and name.upper() != name and "ROOM" not in name:
            if not (tree / name).exists():
                yield f"{page.name}: there is no file {name}"
    for file, mark in re.findall(r"\\snippet (\S+) (.*\S)", text):
        if (tree / "tests/unit/extending" / file).read_text().count(f"//! [{mark}]\n") != 2:
            yield f"{page.name}: {file} does not hold the marks [{mark}] twice"


def main(tree):
    tree = pathlib.Path(tree)
    code = "\n".join(f.read_text() for f in sorted(tree.glob("include/**/*.h")))
    pages = sorted(tree.glob("doc/doxygen/*.md"))
    faults = [fault for page in pages for fault in faults_of(page, code, tree)]
    print("\n".join(faults) or f"{len(pages)} pages")
    return bool(faults) or not pages


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
