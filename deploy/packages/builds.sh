#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# builds.sh NINJA DIRECTORY TARGET PROGRAM...: whether TARGET builds every one of the programs.
set -euo pipefail
inputs=$("$1" -C "$2" -t inputs "$3")
for program in "${@:4}"; do
  grep -qx "bin/$program" <<< "$inputs" || { echo "$3 does not build $program" >&2; exit 1; }
done
