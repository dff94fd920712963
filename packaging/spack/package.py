# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recipe for Spack, to be put into a repository as packages/conetact/package.py; scripts/release fills in where
the archive is."""

from spack_repo.builtin.build_systems.cmake import CMakePackage, generator

from spack.package import *


class Conetact(CMakePackage):
    """Quasi-static frictional contact of linear elastic bodies in the plane and in space, with the exact Coulomb
    cone and without penalty parameters. Each load increment is accepted only after an independent check of contact
    law, equilibrium and balance."""

    url = "@URL@"

    generator("ninja")
    license("LGPL-2.1-or-later")

    version("0.1.0", sha256="@SHA256@")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.21:", type="build")

    # Conetact is tested with this series only.
    depends_on("dealii@9.4+gmsh+metis+mpi+muparser+trilinos")
    depends_on("trilinos@13.2+amesos+epetra+mumps")
    depends_on("mumps+mpi+metis")
    depends_on("metis@5:")
    depends_on("eigen@3.4:")
    depends_on("gmsh+shared")
    depends_on("libdeflate")
    depends_on("openblas")  # brings LAPACKE, too
    depends_on("mpi")

    depends_on("python@3.11:", type="run")
    depends_on("py-numpy", type="run")
    depends_on("py-matplotlib", type="run")
    depends_on("vtk+python", type="run")  # pictures in space

    build_targets = ["conetact", "conetact-reproductions"]

    def cmake_args(self):
        return [self.define("BUILD_TESTING", False)]

    def install(self, spec, prefix):
        cmake("--install", self.build_directory, "--component", "program")

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def solve_a_scene(self):
        scene = join_path(self.prefix.share, "conetact", "parameter-files", "floating-block.prm")
        Executable(join_path(self.prefix.bin, "conetact"))(scene, "-o", join_path(self.build_directory, "result"))
