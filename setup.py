# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes a wheel of the Python package, of the version of CMakeLists.txt.

It is the same on all machines: the package looks for the program when it is used. Everything else is in pyproject.toml.
What is made on the way stays out of the source tree, whose build/ is that of CMake.
"""
import re
import tempfile
from pathlib import Path

from setuptools import setup

TOP = Path(__file__).resolve().parent


def version():
    return re.search(r"project\([^)]*VERSION\s+([\d.]+)", (TOP / "CMakeLists.txt").read_text())[1]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        setup(version=version(), options={"build": {"build_base": folder}, "egg_info": {"egg_base": folder}})
