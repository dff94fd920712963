#!/bin/bash
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The solvers, and what reproduces papers with them, are the ground floor: fails if one of their files includes more
# than Eigen, LAPACKE, CBLAS, the standard library and the solvers' own headers.
# usage: check_solvers_pure.sh SOURCE_TREE
cd "$1" || exit 1
foreign=$(grep -nE '^[[:space:]]*#[[:space:]]*include' \
  {source,include/conetact}/{solvers,load_path,reproductions}/*.{cc,h} 2>/dev/null |
  grep -vE 'include[[:space:]]*("conetact/(solvers|load_path|reproductions)/[^"]+"|<Eigen/[^>]+>|<lapacke\.h>|<cblas\.h>|<[a-z_]+>)')
[ -z "$foreign" ] && exit
echo "The solvers may not include:"
echo "$foreign"
exit 1
