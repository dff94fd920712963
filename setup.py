# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes a wheel of the Python package, of the version of CMakeLists.txt, which knows the program in build/.

Everything else is in pyproject.toml. What is made on the way stays out of the source tree, whose build/ is that of
CMake.
"""
import re
import tempfile
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

TOP = Path(__file__).resolve().parent


class BuildPackage(build_py):
    """With a module that names the program, if there is one."""

    def run(self):
        super().run()
        program = TOP / "build" / "conetact"
        if program.is_file():
            line = f"BUILT = {str(program)!r}\n"
            (Path(self.build_lib) / "conetact" / "_built.py").write_text(line)


def version():
    return re.search(r"project\([^)]*VERSION\s+([\d.]+)", (TOP / "CMakeLists.txt").read_text())[1]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        setup(version=version(), cmdclass={"build_py": BuildPackage},
              options={"build": {"build_base": folder}, "egg_info": {"egg_base": folder}})
