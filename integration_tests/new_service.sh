#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# new_service.sh TRUNNION: what `trunnion new service` writes, and what it refuses. The test of the packages builds it.
set -euo pipefail
trunnion=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "$*"; exit 1; }
refused() { # TEXT COMMAND...
  local text=$1
  shift
  ! "$trunnion" "$@" > said 2>&1 || fail "$*: accepted"
  grep -q "$text" said && [ "$(wc -l < said)" = 1 ] || fail "$*: $(cat said)"
}
"$trunnion" new service my-stage > said
[ "$(ls my-stage | wc -l)" = 8 ] || fail "$(ls my-stage)"
! grep -rq '@[A-Z_]*@' my-stage || fail "words are not filled in: $(grep -r '@[A-Z_]*@' my-stage)"
grep -q 'namespace my_stage' my-stage/my-stage_core.hpp
[ -x my-stage/golden.sh ] || fail "golden.sh cannot be executed"
refused "my-stage exists and is not empty" new service my-stage
refused "a name has 1 .. 32 small letters" new service My.Stage
refused "is a service of Trunnion" new service drive
"$trunnion" new service gap --stage gantry --directory there/gap --json | grep -q '"directory":"there/gap"'
grep -q 'Stage::GANTRY' there/gap/main.cpp
