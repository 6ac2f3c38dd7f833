#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clang-format over every C++ file, and the chosen clang-tidy checks over every source that is built into a program; any
# finding is an error. clang-tidy excludes tests, benchmarks and fuzzers: they include the test framework and would
# nearly double the time. `tools/lint.sh BUILD FILE...` checks the named files only.
set -euo pipefail
build=$1
shift
files=("$@")
if [ ${#files[@]} -eq 0 ]; then
  git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 --dry-run --Werror
  mapfile -t files < <(git ls-files '*.cpp' | grep -Ev '(^|/)(test|bench|integration_tests)/')
fi
# clang-tidy compiles without the precompiled headers of GCC, so a source that relies on them for what it uses is found here.
lint=$build/lint
mkdir -p "$lint"
sed -E 's/ -Winvalid-pch//g; s# -include [^ ]*cmake_pch\.hxx##g' "$build/compile_commands.json" > "$lint/compile_commands.json"
noise='warnings\? generated\|Suppressed\|Use -header-filter\|Use -system-headers'
printf '%s\n' "${files[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy-14 -p "$lint" --quiet 2> >(grep -v "$noise" >&2)
echo "lint: clean"
