#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The comparison of tables finds what it must find and nothing else."""
import copy
import tempfile
import unittest
from pathlib import Path

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


if __name__ == "__main__":
    unittest.main()
