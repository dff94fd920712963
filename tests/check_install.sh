#!/bin/bash
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Installs a build into a folder and uses what is there, without the source tree: the
# program solves a scene as its golden table says, the Python package finds the program
# and draws the scene's picture, pages of man are there if they were made. Then builds the
# example with the installed solvers alone and runs it: one node sticks, one slips.
# usage: check_install.sh SOURCE_TREE BUILD
set -euo pipefail
tree=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix
bin=$prefix/bin
unset CONETACT PYTHONPATH

quietly() { "$@" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }; }

quietly cmake --install "$build" --prefix "$folder/first"
mv "$folder/first" "$prefix" # it may be moved
cd "$folder"

# a scene of those that were installed
scenes=$prefix/share/conetact/parameter-files
quietly /usr/bin/python3 "$tree/tests/run_scene.py" "$bin/conetact" runs \
  "$tree/tests/scenes/shipped-floating-block.prm"
quietly "$bin/conetact" "$scenes/floating-block.prm" -o result
cmp result/reactions.csv runs/shipped-floating-block/result/reactions.csv

# Python and pictures
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$prefix/share/conetact/python /usr/bin/python3 -c "
import conetact, pathlib
assert conetact.executable().resolve() == pathlib.Path('$bin/conetact').resolve()
result = conetact.run('$scenes/floating-block.prm')
assert result.exit_code == 0 and len(result.reactions) > 0"
quietly env PYTHONDONTWRITEBYTECODE=1 "$bin/conetact-picture" result -o picture.png
[ -s picture.png ]
quietly env PYTHONDONTWRITEBYTECODE=1 "$bin/conetact-report" result -o report.html
grep -q 'id="data"' report.html
PYTHONDONTWRITEBYTECODE=1 "$bin/conetact-curve" result | grep -q bottom_f_x

# pages to read; those of man where help2man made them
for page in README.md CHANGELOG.md LICENSE copyright doc/results.md doc/doxygen/theory.md \
  doc/bolted-flange.png doc/gallery/floating-block.png; do
  [ -s "$prefix/share/doc/conetact/$page" ] || { echo "$page is missing"; exit 1; }
done
if grep -q '^HELP2MAN:FILEPATH=/' "$build/CMakeCache.txt" && [ -d "$build/man" ]; then
  for program in "$bin"/*; do
    page=$prefix/share/man/man1/$(basename "$program").1.gz
    gzip -dc "$page" | grep -q 'SH DESCRIPTION' || { echo "$page is not there or empty"; exit 1; }
  done
  gzip -dc "$prefix/share/man/man1/conetact.1.gz" | grep -q 'restart'
fi
quietly "$bin/conetact-reproductions" --help

# for shells and editors
if [ -d "$build/editors" ]; then
  share=$prefix/share
  for text in bash-completion/completions/conetact vim/vimfiles/syntax/conetact.vim vim/vimfiles/ftdetect/conetact.vim \
    conetact/vscode/package.json conetact/vscode/language-configuration.json \
    conetact/vscode/syntaxes/conetact.tmLanguage.json conetact/schema/scene.schema.json; do
    [ -s "$share/$text" ] || { echo "$text is missing"; exit 1; }
  done
  bash -n "$share/bash-completion/completions/conetact"
  /usr/bin/python3 -c "import json, sys; [json.load(open(f)) for f in sys.argv[1:]]" \
    "$share"/conetact/vscode/*.json "$share"/conetact/vscode/syntaxes/*.json "$share"/conetact/schema/*.json
fi
[ ! -x "$bin/conetact-fclib" ] || quietly "$bin/conetact-fclib" --help

# the solvers, for other programs
quietly cmake -G Ninja -S "$tree/examples/contact_by_hand" -B build -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$prefix"
quietly cmake --build build
found=$(build/contact-by-hand)
echo "$found"
# springs carry what the floor does not: r_n = 10 - 0, 10 - 100 * 0.02; r_t = -2, -0.3 * 8
[ "$found" = "node 0: r_t = -2, r_n = 10, stick by 0
node 1: r_t = -2.4, r_n = 8, slip by 0.026" ]
