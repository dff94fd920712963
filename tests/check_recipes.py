#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recipes of packages say what CMake says, and scripts/release packs the sources and fills the recipes in.

usage: check_recipes.py SOURCE_TREE

Neither conda nor Spack is needed: the recipe of conda-forge is rendered and read as YAML, that of Spack is run on
stand-ins that write down what it declares.
"""
import hashlib
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import types
import unittest
from pathlib import Path

import yaml

TOP = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1]).resolve()
# what CMake looks for, as conda-forge and Spack call it
LIBRARIES = {"deal.II": ("dealii", "dealii"), "Eigen3": ("eigen", "eigen"), "dmumps": ("mumps-mpi", "mumps"),
             "mumps_common": ("mumps-mpi", "mumps"), "metis": ("metis", "metis"),
             "trilinos_amesos": ("trilinos", "trilinos"), "deflate": ("libdeflate", "libdeflate"), "gmsh": ("gmsh", "gmsh"),
             "BLAS": ("libblas", "openblas"), "LAPACK": ("liblapack", "openblas"), "lapacke": ("liblapacke", "openblas")}


def cmake():
    return (TOP / "CMakeLists.txt").read_text()


def wanted():
    """Names that CMake cannot do without, and least versions."""
    text = cmake().partition("# Flags of our own code")[0]
    found = re.findall(r"find_package\(([\w.]+) ?([\d.]*)[^)]*REQUIRED|"
                       r"find_library\(\w+ (?:NAMES )?(\w+)[^)]*REQUIRED", text)
    return {package or library: version for package, version, library in found}


def version():
    return re.search(r"project\(Conetact VERSION ([\d.]+)", cmake())[1]


def conda(text):
    """The recipe as conda renders it, as far as this one needs it."""
    variables = dict(re.findall(r'{% set (\w+) = "([^"]*)" %}', text))
    text = re.sub(r"{%.*?%}\n", "", text)
    text = re.sub(r"{{ (compiler|stdlib)\('(\w+)'\) }}", r"\1_\2", text)
    return yaml.safe_load(re.sub(r"{{ (\w+) }}", lambda m: variables[m[1]], text))


def spack(file):
    """What a package of Spack declares: (directive, arguments, options)."""
    declared = []

    def directive(name):
        return lambda *words, **options: declared.append((name, words, options)) or (lambda function: function)
    names = {"version", "license", "depends_on", "generator", "run_after", "on_package_attributes"}
    modules = {name: types.ModuleType(name) for name in
               ("spack", "spack.package", "spack_repo", "spack_repo.builtin", "spack_repo.builtin.build_systems",
                "spack_repo.builtin.build_systems.cmake")}
    for name in names:
        setattr(modules["spack.package"], name, directive(name))
    modules["spack_repo.builtin.build_systems.cmake"].CMakePackage = type("CMakePackage", (), {})
    modules["spack_repo.builtin.build_systems.cmake"].generator = directive("generator")
    sys.modules.update(modules)
    scope = {}
    exec(compile(file.read_text(), str(file), "exec"), scope)  # the recipe is ours
    return scope["Conetact"], declared


class Recipes(unittest.TestCase):
    def test_conda(self):
        recipe = conda((TOP / "packaging/conda-forge/meta.yaml").read_text())
        self.assertEqual(recipe["package"], {"name": "conetact", "version": version()})
        self.assertEqual(recipe["about"]["license"], "LGPL-2.1-or-later")
        self.assertTrue((TOP / recipe["about"]["license_file"]).is_file())
        host = {word.split()[0]: word for word in recipe["requirements"]["host"]}
        for name, least in wanted().items():
            self.assertIn(LIBRARIES[name][0], host)
            self.assertIn(least, host[LIBRARIES[name][0]])
        python = re.search(r'requires-python = "(.*)"', (TOP / "pyproject.toml").read_text())[1]
        self.assertIn(f"python {python}", recipe["requirements"]["run"])

    def test_spack(self):
        recipe, declared = spack(TOP / "packaging/spack/package.py")
        self.assertEqual([words for name, words, _ in declared if name == "version"], [(version(),)])
        self.assertEqual([words for name, words, _ in declared if name == "license"], [("LGPL-2.1-or-later",)])
        needed = {re.match(r"[\w-]+", words[0])[0]: words[0] for name, words, _ in declared if name == "depends_on"}
        for name, least in wanted().items():
            self.assertIn(LIBRARIES[name][1], needed)
            self.assertIn(f"@{least}" if least else "", needed[LIBRARIES[name][1]])
        targets = [line.split()[0] for line in re.findall(r"add_executable\(([^)]*)\)", cmake())]
        self.assertLessEqual(set(recipe.build_targets), set(targets))

    def test_citation(self):
        self.assertIn(f"version: {version()}\nlicense: LGPL-2.1-or-later\n", (TOP / "CITATION.cff").read_text())
        self.assertIn('license = { text = "LGPL-2.1-or-later" }', (TOP / "pyproject.toml").read_text())


class Release(unittest.TestCase):
    def release(self, *words):
        return subprocess.run([TOP / "scripts/release", *words], capture_output=True, text=True, timeout=600,
                              env={**os.environ, "LC_ALL": "C"}, check=False)

    def test_help_lists_the_steps(self):
        told = self.release("--help")
        self.assertEqual(told.returncode, 0)
        steps = re.search(r'all_steps="([^"]*)"', (TOP / "scripts/release").read_text())[1].split()
        self.assertEqual(re.findall(r"^  (\w+) ", told.stdout, re.M), steps)
        self.assertTrue(told.stdout.endswith("release.log has all that they print.\n"))

    def test_what_it_does_not_know(self):
        for words, sentence in ((["paint"], "There is no step 'paint'; there are: source recipes"),
                                (["--colour"], "usage:")):
            done = self.release(*words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(sentence, done.stderr)

    @unittest.skipUnless((TOP / ".git").exists(), "no repository")
    def test_sources_recipes_and_sums(self):
        with tempfile.TemporaryDirectory() as name:
            out, url = Path(name) / "out", "https://example.org/a&b|c.tar.gz"
            done = self.release("-o", str(out), "-u", url, "source", "recipes", "sums")
            self.assertEqual(done.returncode, 0, done.stderr)
            archive = out / f"conetact-{version()}.tar.gz"
            with tarfile.open(archive) as tar:
                self.assertIn(f"conetact-{version()}/CMakeLists.txt", tar.getnames())
            recipe = conda((out / "conda-forge/meta.yaml").read_text())
            exact = hashlib.sha256(archive.read_bytes()).hexdigest()
            self.assertEqual(recipe["source"], {"url": url, "sha256": exact})
            filled, declared = spack(out / "spack/package.py")
            self.assertEqual(filled.url, url)
            self.assertEqual([options["sha256"] for kind, _, options in declared if kind == "version"], [exact])
            self.assertIn(f"{exact}  {archive.name}\n", (out / "SHA256SUMS").read_text())
            subprocess.run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=out, check=True)

    def test_what_earlier_steps_make(self):
        with tempfile.TemporaryDirectory() as name:
            done = self.release("-o", name, "recipes")
            self.assertEqual(done.returncode, 1)
            self.assertIn(".tar.gz is missing: scripts/release source makes it.", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
