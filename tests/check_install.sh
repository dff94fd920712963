#!/bin/bash
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Installs the solvers from a build, builds the example with the installed
# package alone and runs it: one node sticks, one slips.
# usage: check_install.sh SOURCE_TREE BUILD
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$2" --prefix "$folder/prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }
cmake -S "$1/examples/contact_by_hand" -B "$folder/build" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$folder/prefix" >"$folder/log" || { cat "$folder/log"; exit 1; }
cmake --build "$folder/build" >"$folder/log" || { cat "$folder/log"; exit 1; }
"$folder/prefix/bin/conetact-reproductions" --help >"$folder/log" || { cat "$folder/log"; exit 1; }
found=$("$folder/build/contact-by-hand")
echo "$found"
# springs carry what the floor does not: r_n = 10 - 0, 10 - 100 * 0.02; r_t = -2, -0.3 * 8
[ "$found" = "node 0: r_t = -2, r_n = 10, stick by 0
node 1: r_t = -2.4, r_n = 8, slip by 0.026" ]
