#!/bin/bash
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# What somebody sees who has nothing but Debian 12. As root, with debootstrap and
# a network; the mirror is the one that apt uses on this machine.
# usage: bare_debian.sh FOLDER package FILE.deb    installs the package and solves Example 5.2
#        bare_debian.sh FOLDER sources             the program is built and run in a clone
#        bare_debian.sh FOLDER tests               the tests, after that
# FOLDER must not be in use by others; FOLDER/base is kept for later calls, and the root of
# the last call stays to be looked at. Results of Example 5.2 are compared with
# tests/reference in each case.
set -euo pipefail

usage() {
  sed -n '/^# What somebody/,/^# tests\/reference/s/^# \{0,1\}//p' "$0" >&2
  exit 1
}
[ $# -ge 2 ] || usage
top=$(cd "$(dirname "$(readlink -f "$0")")/.." && pwd -P)
. "$top/scripts/roots.sh"
roots=$1 case=$2 deb=${3-}
root=$roots/$case
scene=inclined-obstacle

compare() { # FOLDER of results
  /usr/bin/python3 "$top/tests/compare_reference.py" 5.2 "$1"
}

case $case in
  package)
    [ -f "$deb" ] || usage
    fresh_root package
    cp "$deb" "$root/tmp/conetact.deb"
    install_inside package /tmp/conetact.deb
    inside package sh -c "cd /tmp && conetact --version && conetact /usr/share/conetact/parameter-files/$scene.prm"
    compare "$root/tmp/output/$scene"
    ;;
  sources)
    fresh_root sources
    git clone --quiet --no-local "$top" "$root/conetact"
    inside sources nice sh -c "cd /conetact && ./conetact parameter-files/$scene.prm"
    compare "$root/conetact/output/$scene"
    ;;
  tests)
    [ -x "$roots/sources/conetact/build/conetact" ] || usage
    inside sources nice sh -c "cd /conetact && ./test"
    ;;
  *) usage ;;
esac
echo "passed: $case"
