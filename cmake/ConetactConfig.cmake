# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(BLAS)
find_dependency(LAPACK)
include("${CMAKE_CURRENT_LIST_DIR}/ConetactTargets.cmake")
