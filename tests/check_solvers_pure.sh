#!/bin/bash
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The solvers are the ground floor: fails if one of their files includes more
# than Eigen, LAPACKE, CBLAS, the standard library and the solvers' own headers.
# usage: check_solvers_pure.sh SOURCE_TREE
cd "$1" || exit 1
foreign=$(grep -nE '^[[:space:]]*#[[:space:]]*include' \
  source/solvers/*.cc include/conetact/solvers/*.h |
  grep -vE 'include[[:space:]]*("conetact/solvers/[^"]+"|<Eigen/[^>]+>|<lapacke\.h>|<cblas\.h>|<[a-z_]+>)')
[ -z "$foreign" ] && exit
echo "The solvers may not include:"
echo "$foreign"
exit 1
