#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# nightly.sh [STAGE...]: all that is checked, whole, as long as it takes; or the named stages. A stage that has passed for this
# commit is not repeated, so it continues where it was interrupted; uncommitted changes are refused for that reason.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/stages.sh
[ -z "$(git status --porcelain)" ] || { echo "nightly: commit the changes first: what has passed is remembered by commit"; exit 2; }
passed=${XDG_CACHE_HOME:-$HOME/.cache}/trunnion/nightly/$(git rev-parse HEAD)
mkdir -p "$passed"
export TRUNNION_FORGET=1 FUZZ_SECONDS=60
all=(packages build test lint sanitize threads fuzz faults recordings histories rests soak hostile hostile_bus under_load coverage oscat corpus)

once() {
  [ ! -e "$passed/$1" ] || { echo "== $1 has passed"; return; }
  stage "$@"
  touch "$passed/$1"
}
run() {
  case $1 in
    packages) once packages deploy/install-packages.sh nightly ;;
    under_load) once under_load tools/under_load.sh 10 ;;
    build | test | lint | sanitize | threads | fuzz | faults | recordings | histories | rests | soak | hostile | hostile_bus | coverage | oscat | corpus) once "$1" make "$1" ;;
    *) echo "nightly: no stage $1: ${all[*]}"; exit 2 ;;
  esac
}
[ $# -gt 0 ] || set -- "${all[@]}"
for name; do run "$name"; done
stages_table
