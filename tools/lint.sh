#!/usr/bin/env bash
# clang-format and the chosen clang-tidy checks over every C++ file; any finding is an error.
set -euo pipefail
build=$1
git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 --dry-run --Werror
# Files of the compilation database that are ours and not generated.
git ls-files '*.cpp' | grep -v _fuzz.cpp | xargs -P "$(nproc)" -n 4 clang-tidy-14 -p "$build" --quiet 2> >(grep -v 'warnings\? generated\|Suppressed\|Use -header-filter\|Use -system-headers' >&2)
echo "lint: clean"
