# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Sourced by scripts/release and tests/bare_debian.sh: folders with a Debian 12 that
# has nothing else, and commands in them. As root, with debootstrap and a network;
# the mirror is the one that apt uses on this machine. $roots is where they are, by
# one user at a time; $roots/base is kept for later calls, as are packages that were
# fetched and what was compiled.

# dpkg waits for no disk: what is half done after a loss of power is made anew.
unsafe=etc/dpkg/dpkg.cfg.d/unsafe-io
# A cache of ccache that commands inside have in place of $roots/ccache, if set.
cache=${cache-}

make_base() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
    'Release: bookworm' 'Component: main' | head -n 1)
  [ -n "$mirror" ] || { echo "apt knows no mirror of Debian 12 (bookworm) here" >&2; return 1; }
  mkdir -p "$roots" && rm -rf "$roots/base.new" &&
    debootstrap --variant=minbase bookworm "$roots/base.new" "$mirror" &&
    echo force-unsafe-io >"$roots/base.new/$unsafe" &&
    mv "$roots/base.new" "$roots/base"
}

fresh_root() { # NAME: what was there is removed
  [ -d "$roots/base" ] || make_base || return 1
  rm -rf --one-file-system "${roots:?}/$1" && cp -a "$roots/base" "$roots/$1"
}

# NAME COMMAND [ARGUMENT]..., with nothing of this machine's environment. What is
# mounted is seen by the command alone, and goes with it, however that ends.
inside() {
  local root=$roots/$1
  shift
  mkdir -p "$roots/archives" "$roots/ccache" "$root/root/.cache/ccache" || return 1
  unshare --mount bash -c '
    root=$1 roots=$2 cache=$3
    shift 3
    [ -e "$root/dev/null" ] || mount --rbind /dev "$root/dev" || exit # images have none
    mount -t proc proc "$root/proc" && mount -t sysfs -o ro sysfs "$root/sys" &&
      mount --bind "$roots/archives" "$root/var/cache/apt/archives" &&
      mount --bind "$cache" "$root/root/.cache/ccache" &&
      exec chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 "$@"
  ' - "$root" "$roots" "${cache:-$roots/ccache}" "$@"
}

install_inside() { # NAME PACKAGE..., or files that are there
  local root=$1
  shift
  inside "$root" apt-get update &&
    inside "$root" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y --no-install-recommends "$@"
}
