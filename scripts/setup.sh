# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Sourced by ./conetact and ./test: packages, configuration and build, each only
# where something is missing. Needs nothing but bash and apt; $top is the folder
# of the source tree.

packages="g++ cmake ninja-build ccache libdeal.ii-dev libmumps-dev libmetis-dev
  libeigen3-dev libopenblas-dev liblapacke-dev libdeflate-dev libfclib-dev libgtest-dev numdiff
  clang-format python3 python3-yaml python3-vtk9 python3-numpy python3-matplotlib mypy python3-pip python3-venv python3-wheel"
# For documentation, which is not needed to build or run: apt-get install $documentation_packages
# (target doc: doxygen, graphviz; target site: the others)
documentation_packages="doxygen graphviz python3-sphinx python3-myst-parser furo libjs-mathjax"

say() { printf '%s\n' "$*" >&2; }

die() {
  say "$*"
  exit 1
}

# Runs a command with its output in a log file: a moving line on a terminal, else a
# line for each tenth of what ninja does; the tail of the log if it fails.
logged() {
  local title=$1 log=$2
  shift 2
  say "$title (log: $log)"
  if [ -t 2 ]; then
    "$@" 2>&1 </dev/null | tee "$log" | show_progress
  else
    "$@" 2>&1 </dev/null | tee "$log" | show_tenths
  fi && return
  say "... failed; the end of $log:"
  tail -n 40 "$log" | cut -c 1-400 >&2
  return 1
}

show_progress() {
  local line
  while IFS= read -r line; do
    printf '\r\033[K%s' "${line:0:${COLUMNS:-78}}" >&2
  done
  printf '\r\033[K' >&2
}

show_tenths() {
  local line tenth=0 now
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    now=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
    ((now > tenth && BASH_REMATCH[2] > 9)) || continue
    tenth=$now
    say "... ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]}"
  done
}

missing_packages() {
  local installed package
  installed=" $(dpkg-query -W -f='${db:Status-Status}:${Package} ' $packages 2>/dev/null || true)"
  for package in $packages; do
    case $installed in
      *" installed:$package "*) ;;
      *) printf '%s ' "$package" ;;
    esac
  done
}

install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This is no Debian system, so nothing is installed. Needed are what Debian 12 calls:" $packages
    return
  fi
  local missing as_root=
  missing=$(missing_packages)
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null ||
      die "Packages are missing and there is no sudo; please run as root: apt-get install $missing"
    as_root=sudo
    sudo -v || die "Packages are missing and sudo does not let you install them; please ask for: apt-get install $missing"
  fi
  say "Missing packages: $missing"
  logged "Reading the lists of packages" "$top/build/apt.log" $as_root apt-get update ||
    say "Going on with the lists that are there."
  logged "Installing" "$top/build/apt.log" \
    $as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends $missing ||
    die "The packages could not be installed."
}

# Compilers need up to about 1.5 GB each for finite elements.
n_jobs() {
  awk -v cores="$(nproc)" '/^MemAvailable/ { m = int($2 / 1.5e6) }
    END { if (m < 1) m = 1; print (m < cores ? m : cores) }' /proc/meminfo
}

folder_of() { # of a preset
  case $1 in
    release) echo "$top/build" ;;
    *) echo "$top/build-$1" ;;
  esac
}

configure() {
  local folder
  folder=$(folder_of "$1")
  # A tree that was moved or copied starts anew.
  if [ -f "$folder/CMakeCache.txt" ] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$top" "$folder/CMakeCache.txt"; then
    rm -rf "$folder/CMakeCache.txt" "$folder/CMakeFiles" "$folder/build.ninja"
  fi
  [ "$folder/build.ninja" -nt "$top/CMakePresets.json" ] ||
    logged "Configuring" "$folder/configure.log" cmake --preset "$1"
}

# What is to be compiled: "Building 45 files, some 6 minutes on 2 cores". A file takes a
# core 15 s on a machine of 2024.
expected() { # FOLDER, JOBS [TARGET]
  local n
  n=$(ninja -C "$1" -n ${3+"$3"} 2>/dev/null | grep -c '\.o$') || true
  if [ "$n" -gt 0 ]; then
    echo "Building $n files, some $(((15 * n / $2 + 59) / 60)) minutes with $2 of $(nproc) cores"
  else
    echo "Building"
  fi
}

# True if the program in build/ is younger than all that it is made of. The
# folders count too: they change when a file comes or goes.
is_built() {
  [ -x "$top/build/conetact" ] && [ -f "$top/build/stamp" ] &&
    [ -z "$(find "$top/CMakeLists.txt" "$top/CMakePresets.json" \
      "$top/scripts/setup.sh" "$top/source" "$top/include" \
      -newer "$top/build/stamp" -print -quit)" ]
}

# build PRESET [TARGET]: one process at a time, later ones find it done.
build() (
  folder=$(folder_of "$1")
  mkdir -p "$top/build" "$folder" ||
    die "Cannot write to $top; copy the source tree to a folder of your own."
  cd "$top" && exec 9>"$folder/lock" && flock 9 || exit 1
  if [ "${2-}" = conetact ] && is_built; then exit 0; fi
  install_packages
  # What is edited from here on is newer than the stamp.
  touch "$folder/stamp.new" &&
    configure "$1" &&
    jobs=$(n_jobs) &&
    logged "$(expected "$folder" "$jobs" ${2+"$2"})" "$folder/build.log" \
      cmake --build --preset "$1" --parallel "$jobs" ${2+--target "$2"} &&
    mv "$folder/stamp.new" "$folder/stamp"
)
