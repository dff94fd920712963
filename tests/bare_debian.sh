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
folder=$1 case=$2 deb=${3-}
root=$folder/$case
scene=inclined-obstacle

make_base() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
    'Release: bookworm' 'Component: main' | head -n 1)
  [ -n "$mirror" ] || { echo "apt knows no mirror of Debian 12 (bookworm) here" >&2; exit 1; }
  mkdir -p "$folder"
  rm -rf "$folder/base.new"
  debootstrap --variant=minbase bookworm "$folder/base.new" "$mirror"
  mv "$folder/base.new" "$folder/base"
}

inside() { # COMMAND [ARGUMENT]..., with nothing of this machine's environment
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root "$@"
}

fresh_root() {
  [ -d "$folder/base" ] || make_base
  rm -rf "$root"
  cp -a "$folder/base" "$root"
}

use_proc() { # as any running system has it
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys"
  trap 'umount "$root/proc" "$root/sys"' EXIT
}

compare() { # FOLDER of results
  /usr/bin/python3 "$top/tests/compare_reference.py" 5.2 "$1"
}

case $case in
  package)
    [ -f "$deb" ] || usage
    fresh_root
    use_proc
    cp "$deb" "$root/tmp/conetact.deb"
    inside apt-get update
    inside apt-get install -y --no-install-recommends /tmp/conetact.deb
    inside sh -c "cd /tmp && conetact --version && conetact /usr/share/conetact/parameter-files/$scene.prm"
    compare "$root/tmp/output/$scene"
    ;;
  sources)
    fresh_root
    use_proc
    git clone --quiet --no-local "$top" "$root/conetact"
    inside nice sh -c "cd /conetact && ./conetact parameter-files/$scene.prm"
    compare "$root/conetact/output/$scene"
    ;;
  tests)
    root=$folder/sources
    [ -x "$root/conetact/build/conetact" ] || usage
    use_proc
    inside nice sh -c "cd /conetact && ./test"
    ;;
  *) usage ;;
esac
echo "passed: $case"
