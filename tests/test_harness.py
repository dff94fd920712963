#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What compares tables, refuses scenes, watches the rooms and follows links finds what it must find and nothing else."""
import copy
import tempfile
import unittest
from pathlib import Path

import check_links
import check_rooms
import run_errors
import run_scene

COLUMNS = "increment,time,contact,node,x,y,z,gap,u_n,u_t1,r_n,r_t1,state".split(",")
LINES = ["1,1,bottom,0,0,0,0,0,-1e-3,0,20,3e-8,stick",
         "1,1,bottom,1,1.5,0,0,0.25,-2e-3,1e-19,0,0,open"]


def table():
    return COLUMNS, [dict(zip(COLUMNS, line.split(","))) for line in LINES]


def faults(change, tolerance=1e-8):
    new = copy.deepcopy(table())
    change(new[1])
    return run_scene.compare("t", table(), new, tolerance)


def put(row, column, value):
    return lambda rows: rows[row].__setitem__(column, value)


class Compare(unittest.TestCase):
    def test_the_same(self):
        self.assertEqual(faults(lambda rows: None), [])

    def test_numbers_and_order_of_nodes_do_not_matter(self):
        self.assertEqual(faults(put(0, "node", "17")), [])
        self.assertEqual(faults(lambda rows: rows.reverse()), [])

    def test_each_column_by_its_own_largest(self):
        self.assertEqual(faults(put(1, "u_n", "-2.00000001e-3")), [])
        self.assertIn("u_n differs", faults(put(1, "u_n", "-2.0000001e-3"))[0])
        self.assertIn("gap differs", faults(put(0, "gap", "1e-8"))[0])

    def test_noise(self):
        self.assertEqual(faults(put(1, "u_t1", "-3e-19")), [])
        self.assertEqual(faults(put(0, "r_t1", "0")), [])
        self.assertIn("r_t1", faults(put(0, "r_t1", "1e-7"))[0])

    def test_places_are_matched_to_rounding(self):
        self.assertEqual(faults(put(1, "x", "1.50000000000001")), [])
        self.assertIn("matched", faults(put(1, "x", "1.6"))[0])

    def test_nan_and_infinity(self):
        for value in ("nan", "inf"):
            self.assertIn("gap", faults(put(0, "gap", value))[0])
        with_nan = table()
        with_nan[1][0]["gap"] = "nan"
        self.assertNotEqual(run_scene.compare("t", with_nan, with_nan, 1e-8), [])
        self.assertNotEqual(run_scene.check_bounds([dict(increment="1", residual="nan", equilibrium="0", balance="0",
                                                         err1="0", err2="0")], 1e-10), [])

    def test_states_columns_and_rows(self):
        self.assertIn("state", faults(put(0, "state", "slip"))[0])
        self.assertIn("rows", faults(lambda rows: rows.pop())[0])
        more = [{**row, "area": "1"} for row in table()[1]]
        self.assertEqual(run_scene.compare("t", table(), (COLUMNS + ["area"], more), 1e-8), [])
        self.assertIn("columns", run_scene.compare("t", table(), (COLUMNS[:-1], table()[1]), 1e-8)[0])


PROGRAM = """#!/bin/sh
case $(cat "$1") in
  *plain*) echo "Body 'block': no mesh. Give one." >&2; exit 1 ;;
  *writes*) mkdir "$3"; echo "Body 'block': no mesh. Give one." >&2; exit 1 ;;
  *trace*) printf "no mesh\\nStacktrace:\\n" >&2; exit 1 ;;
esac
"""


class Errors(unittest.TestCase):
    def run_scene(self, text):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            program, scene = folder / "program", folder / "scene.prm"
            program.write_text(PROGRAM)
            program.chmod(0o755)
            scene.write_text(text)
            return run_scene.run_scene(program, folder / "runs", scene, "compare")

    def test_a_plain_sentence(self):
        self.assertEqual(self.run_scene("# expect error: exit=1 no mesh\n# plain"), [])

    def test_other_code_or_text(self):
        self.assertIn("exit code", self.run_scene("# expect error: exit=3 no mesh\n# plain")[0])
        self.assertIn("does not say", self.run_scene("# expect error: exit=1 no material\n# plain")[0])

    def test_nothing_is_written(self):
        self.assertIn("written", self.run_scene("# expect error: exit=1 no mesh\n# writes")[0])

    def test_no_stack_trace(self):
        self.assertIn("sentence", self.run_scene("# expect error: exit=1 no mesh\n# trace")[0])


BASE = """set Dimension = 2

subsection Body block
  set Kind = continuum
  subsection Mesh
    set Scale = 1
  end
end
"""


class Rows(unittest.TestCase):
    def changed(self, *changes):
        return run_errors.changed(BASE, changes)

    def test_values_are_replaced_where_they_stand(self):
        self.assertEqual(self.changed("Body block/Mesh/Scale = 2"), BASE.replace("Scale = 1", "Scale = 2"))
        self.assertEqual(self.changed("Dimension ="), BASE.replace("= 2", "= "))

    def test_entries_are_added_at_the_end_of_their_section(self):
        self.assertEqual(self.changed("Loads = a"), BASE.replace("= 2", "= 2\nset Loads = a"))
        self.assertEqual(self.changed("Body block/Scale = 3"),
                         BASE.replace("continuum", "continuum\n  set Scale = 3"))

    def test_sections_are_added(self):
        self.assertEqual(self.changed("Time/End = 2", "Time/Increments = 1"),
                         BASE + "\nsubsection Time\n  set End = 2\n  set Increments = 1\nend\n")
        self.assertIn("    set Young modulus = 1\n  end\nend\n", self.changed("Body block/Material/Young modulus = 1"))

    def test_what_is_taken_away(self):
        self.assertEqual(self.changed("without Body block/Kind"), BASE.replace("  set Kind = continuum\n", ""))
        self.assertEqual(self.changed("without Body block"), "set Dimension = 2\n\n")
        self.assertRaises(ValueError, self.changed, "without Body block/Sort")

    def test_texts(self):
        self.assertEqual(self.changed(r"replace 2\n with 3\nno"), BASE.replace("2\n", "3\nno", 1))
        self.assertRaises(ValueError, self.changed, "replace end with no")

    def test_tables(self):
        with tempfile.TemporaryDirectory() as name:
            table = Path(name) / "t.txt"
            (Path(name) / "b.prm").write_text(BASE)
            table.write_text("# heads\nbase: b.prm\nDimension = 3\n\n[a] One.\nLoads = x\narguments: -s 'a b'\n> no\n")
            base, (row,) = run_errors.read_table(table)
            self.assertEqual(base, BASE.replace("= 2", "= 3"))
            self.assertEqual((row.name, row.changes, row.arguments, row.sentence), ("a", ["Loads = x"], ["-s", "a b"], "no"))
            for wrong in ("[a] One.\nLoads = x", "[a] One.\nnonsense\n> no", "[a] One.\n> no\n[a] Two.\n> no"):
                table.write_text("base: b.prm\n" + wrong)
                self.assertRaises(SystemExit, run_errors.read_table, table)

    def run_row(self, program, *changes):
        with tempfile.TemporaryDirectory() as name:
            file = Path(name) / "program"
            file.write_text(program)
            file.chmod(0o755)
            row = run_errors.Row("a", changes=list(changes), sentence="no mesh")
            return run_errors.faults_of(run_scene.process(file, name), Path(name) / "runs", BASE, row)

    def test_rows_are_judged_as_scenes(self):
        self.assertEqual(self.run_row(PROGRAM, "Name = plain"), [])
        self.assertIn("written", self.run_row(PROGRAM, "Name = writes")[0])
        self.assertIn("exit code 0", self.run_row(PROGRAM, "Name = right")[0])
        self.assertIn("changes nothing", self.run_row(PROGRAM, "Dimension = 2")[0])


class Circles(unittest.TestCase):
    def circles(self, **graph):
        return {"".join(sorted(circle)) for circle in check_rooms.circles({k: set(v) for k, v in graph.items()})}

    def test_of_graphs(self):
        self.assertEqual(self.circles(a="bc", b="d", c="d", d=""), set())
        self.assertEqual(self.circles(a="b", b="c", c="a", d="ae", e="d"), {"abc", "de"})
        self.assertEqual(self.circles(a="b", b="ca", c="d", d="c", e="abcd"), {"ab", "cd"})

    def test_headers_sources_and_tables(self):
        with tempfile.TemporaryDirectory() as name:
            tree = Path(name)
            files = {"include/conetact/base/a.h": "", "source/base/a.cc": "b", "include/conetact/base/b.h": "a",
                     "include/conetact/base/kinds.h": "", "source/base/kinds_table.cc": "kind kinds",
                     "include/conetact/base/kind.h": "kinds"}
            for file, headers in files.items():
                (tree / file).parent.mkdir(parents=True, exist_ok=True)
                (tree / file).write_text("".join(f'#include "conetact/base/{h}.h"\n' for h in headers.split()))
            found = check_rooms.circles(check_rooms.includes(tree))
            self.assertEqual([sorted(name for _, name in circle) for circle in found], [["base/a", "base/b"]])


class Links(unittest.TestCase):
    def faults(self, **pages):
        with tempfile.TemporaryDirectory() as folder:
            tree = Path(folder).resolve()
            (tree / "doc").mkdir()
            for name, text in pages.items():
                (tree / name.replace("_", "/")).with_suffix(".md").write_text(text)
            readme = tree / "README.md"
            return [*check_links.faults_of(readme, tree), *check_links.pages_without_link(tree)]

    def test_files_and_headings(self):
        self.assertEqual(self.faults(README="[a](doc/a.md) [b](doc/a.md#one-two-x) https://x.y/z [c](https://x.y/z)",
                                     doc_a="# One two: `x`\n"), [])
        self.assertEqual(self.faults(README="[a](doc/a.md#one) [b](doc/b.md)", doc_a="# Two\n```\n# One\n```\n"),
                         ["README.md: there is no heading doc/a.md#one", "README.md: there is no doc/b.md"])

    def test_pages_that_nobody_finds(self):
        self.assertEqual(self.faults(README="text", doc_a="# A\n"), ["README.md: no link leads to doc/a.md"])

    def test_code_is_no_link(self):
        self.assertEqual(self.faults(README="`[a](b.md)`\n\n    [a](b.md)\n\n```\n[a](b.md)\n```\n"), [])


if __name__ == "__main__":
    unittest.main()
