# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Sourced by scripts/release: its steps. Each makes files in $out and prints to its
# log alone.

scene=inclined-obstacle # Example 5.2 of [K], which tests/reference has

says() { # what a step does, for people who wait
  case $1 in
    source) echo "Packing the sources" ;;
    recipes) echo "Writing recipes for conda-forge and Spack" ;;
    package) echo "Building the Debian package in a Debian 12 of its own" ;;
    check) echo "Checking the package by lintian and in another Debian 12" ;;
    image) echo "Making the OCI image, and solving a scene in it" ;;
    sums) echo "Summing up" ;;
  esac
}

# Functions of steps are called where set -e does not reach: they join by &&.
run_step() {
  say "$(says "$1") ..."
  printf '\n== %s\n' "$(says "$1")" >>"$log"
  "step_$1" >>"$log" 2>&1 </dev/null && return
  tail -n 40 "$log" | cut -c 1-400 >&2
  die "... failed; all that was printed is in $log"
}

check_tools() {
  local needed="" step tool
  for step in $steps; do
    case $step in
      package) needed="$needed debootstrap" ;;
      check) needed="$needed debootstrap lintian" ;;
      image) needed="$needed debootstrap umoci" ;;
    esac
  done
  [ -z "$needed" ] || [ "$(id -u)" = 0 ] ||
    die "The steps package, check and image make systems of their own; please run this as root, or name other steps."
  for tool in $needed; do
    command -v "$tool" >/dev/null || die "$tool is missing; please run: apt-get install $tool"
  done
}

made() { # FILE, and the step that makes it
  [ -f "$1" ] || { echo "$1 is missing: scripts/release $2 makes it." && return 1; }
}

step_source() {
  git -C "$top" -c tar.umask=022 archive --prefix="conetact-$version/" HEAD | gzip -9n >"$archive.new" &&
    mv "$archive.new" "$archive" && ls -l "$archive"
}

escaped() { # for sed
  printf %s "$1" | sed 's/[&|\\]/\\&/g'
}

step_recipes() {
  made "$archive" source || return 1
  local recipe sum
  sum=$(sha256sum "$archive" | cut -d ' ' -f 1)
  for recipe in conda-forge/meta.yaml spack/package.py; do
    mkdir -p "$out/${recipe%/*}" &&
      sed -e "s|@SHA256@|$sum|" -e "s|@URL@|$(escaped "${url:-file://$archive}")|" \
        "$top/packaging/$recipe" >"$out/$recipe" || return 1
  done
}

# Its settings decide what ccache takes for the same.
share_cache() {
  local settings
  [ -n "$cache" ] || return 0
  settings=$(ccache --show-config | sed -n 's/^(\(.*ccache.conf\)).*/\1/p' | head -n 1)
  mkdir -p "$roots/build/root/.config/ccache" &&
    { [ -z "$settings" ] || cp "$settings" "$roots/build/root/.config/ccache/ccache.conf"; }
}

step_package() {
  made "$archive" source || return 1
  fresh_root build && mkdir -p "$roots/build$sources" &&
    tar -C "$roots/build$sources" --strip-components=1 -xzf "$archive" && share_cache &&
    inside build nice "$sources/scripts/make-deb" &&
    cp "$roots/build$sources/build/conetact_${version}_$arch.deb" "$deb" &&
    dpkg-deb --info "$deb" && ls -l "$deb"
}

step_check() {
  made "$deb" package || return 1
  lintian --allow-root --fail-on error "$deb" && "$top/tests/bare_debian.sh" "$roots" package "$deb"
}

step_image() {
  made "$deb" package || return 1
  fill_image && pack_image && try_image
}

# What no run needs: deal.II with its assertions, headers, static libraries, manuals.
make_slim() {
  local root=$1
  rm -rf "$root"/usr/lib/*/libdeal.ii.g.so* "$root"/usr/include/* "$root"/usr/share/{man,locale,info}/* &&
    find "$root/usr/lib" -name '*.a' -delete &&
    find "$root/usr/share/doc" -type f ! -name copyright ! -path '*/conetact/*' -delete
}

# Debian with the package and what draws pictures; nothing of this machine.
fill_image() {
  local root=$roots/image
  fresh_root image && cp "$deb" "$root/tmp/conetact.deb" &&
    install_inside image /tmp/conetact.deb python3-numpy python3-matplotlib python3-vtk9 xvfb &&
    cp "$root/usr/share/doc/apt/examples/sources.list" "$root/etc/apt/sources.list" &&
    rm -rf "$root/tmp/conetact.deb" "$root/$unsafe" "$root"/var/lib/apt/lists/* "$root"/var/log/*.log \
      "$root"/var/log/apt "$root"/root/.cache "$root/etc/resolv.conf" "$root/etc/hostname" &&
    make_slim "$root" && mkdir -p "$root/work"
}

# One layer; its time is that of the commit.
pack_image() {
  local layout=$roots/layout when
  when=$(git -C "$top" log -1 --format=%cI)
  rm -rf "$layout" && tar -C "$roots/image" --sort=name --numeric-owner --exclude='./dev/*' \
    --exclude='./proc/*' --exclude='./sys/*' -cf "$roots/layer.tar" . &&
    umoci init --layout "$layout" && umoci new --image "$layout:$version" &&
    umoci raw add-layer --image "$layout:$version" --history.created "$when" \
      --history.created_by "scripts/release image" "$roots/layer.tar" &&
    umoci config --image "$layout:$version" --no-history --created "$when" --architecture "$arch" --os linux \
      --config.entrypoint conetact --config.workingdir /work \
      --config.env PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
      --config.label "org.opencontainers.image.title=conetact" \
      --config.label "org.opencontainers.image.version=$version" \
      --config.label "org.opencontainers.image.licenses=LGPL-2.1-or-later" &&
    umoci gc --layout "$layout" &&
    tar -C "$layout" --sort=name --mtime="$when" -cf "$image.new" . && mv "$image.new" "$image" &&
    rm "$roots/layer.tar" && ls -l "$image"
}

# Of the file, as somebody has it who loads it.
try_image() {
  local layout=$roots/loaded bundle=$roots/bundle
  rm -rf --one-file-system "$layout" "$bundle" && mkdir -p "$layout" && tar -C "$layout" -xf "$image" &&
    umoci unpack --image "$layout:$version" "$bundle" &&
    inside bundle/rootfs sh -c "cd /work && conetact /usr/share/conetact/parameter-files/$scene.prm" &&
    /usr/bin/python3 "$top/tests/compare_reference.py" 5.2 "$bundle/rootfs/work/output/$scene" &&
    rm -rf --one-file-system "$layout" "$bundle"
}

step_sums() {
  (cd "$out" && shopt -s nullglob &&
    files=(conetact-*.tar.gz conetact_*.deb conetact-*.oci.tar conda-forge/* spack/*) &&
    [ ${#files[@]} -gt 0 ] && sha256sum "${files[@]}" >SHA256SUMS && cat SHA256SUMS)
}
