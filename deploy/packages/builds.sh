#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# builds.sh NINJA DIRECTORY TARGET PROGRAM...: whether TARGET builds every one of the programs.
set -euo pipefail
commands=$("$1" -C "$2" -t commands "$3")
for program in "${@:4}"; do
  grep -q -- "-o bin/$program " <<< "$commands" || { echo "$3 does not build $program" >&2; exit 1; }
done
