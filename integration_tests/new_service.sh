#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# new_service.sh TRUNNION: what `trunnion new service` and `new machine` write, and what they refuse. The test of the
# packages builds the service.
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

# Its plc is a link to that of another machine.
"$trunnion" new machine mine --from four-axis > said
grep -q "check-machine mine" said || fail "$(cat said)"
[ -f mine/plc/main.st ] && [ -z "$(find mine -type l)" ] && [ ! -e mine/recordings ] || fail "$(find mine)"
[ "$(grep -c '^name: mine$' mine/machine.yaml)" = 1 ] || fail "$(cat mine/machine.yaml)"
"$trunnion" check-machine mine > said || fail "$(cat said)"
"$trunnion" new machine again --from ./mine --directory there/again --json | grep -q '"directory":"there/again"'
diff -r --exclude machine.yaml mine there/again
refused "mine exists and is not empty" new machine mine --from four-axis
refused "no such directory" new machine other --from none
rm -r mine/plc && ln -s ../ac-table/plc mine/plc
refused "is a link to '../ac-table/plc', which is not there" new machine other --from ./mine
[ ! -e other ] || fail "a refused copy leaves a folder"
