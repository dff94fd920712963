#!/bin/bash
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# What a small scene costs beside an empty program that is linked to deal.II and
# starts no MPI. Both run in turn; medians of CPU and wall time, and their ratio.
#   benchmarks/startup.sh [BUILD] [RUNS] [SCENE]
# with build/, 15 and inclined-obstacle.prm if not given. --instructions at the
# end counts instructions with callgrind instead.
set -euo pipefail
top=$(cd "$(dirname "$0")/.." && pwd)
count=
[ "${!#}" != --instructions ] || { count=yes && set -- "${@:1:$#-1}"; }
build=$(cd "${1:-$top/build}" && pwd)
runs=${2:-15}
scene=$(realpath "${3:-$top/parameter-files/inclined-obstacle.prm}")

cmake --build "$build" --target conetact bench-empty >/dev/null
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"
empty=("$build/benchmarks/startup/bench-empty")
small=("$build/conetact" "$scene" --quiet -o "$work/result" -s Output/VTU=0)

instructions() { # all of its instructions, in millions
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 |
    awk '/Collected/ { printf "%.0f\n", $4 / 1e6 }'
}
if [ -n "$count" ]; then
  e=$(instructions "${empty[@]}")
  s=$(instructions "${small[@]}")
  echo "instructions: empty $e M, scene $s M, ratio $(awk "BEGIN { printf \"%.2f\", $s / $e }")"
  exit
fi

timed() { # NAME COMMAND: appends "user+system wall" to NAME
  local name=$1
  shift
  /usr/bin/time -f '%U %S %e' -o one "$@"
  awk '{ print $1 + $2, $3 }' one >>"$name"
}
median() { # FILE COLUMN
  sort -g -k"$2,$2" "$1" | awk -v c="$2" '{ x[NR] = $c } END { print x[int((NR + 1) / 2)] }'
}
for ((i = 0; i <= runs; ++i)); do
  timed empty "${empty[@]}"
  timed small "${small[@]}"
  [ "$i" != 0 ] || rm empty small # the first ones fill caches
done
printf '| time | empty, s | scene, s | ratio |\n|---|---|---|---|\n'
for column in 1 2; do
  e=$(median empty $column)
  s=$(median small $column)
  echo "| $([ $column = 1 ] && echo CPU || echo wall) | $e | $s |" \
    "$(awk "BEGIN { printf \"%.2f\", $s / $e }") |"
done
