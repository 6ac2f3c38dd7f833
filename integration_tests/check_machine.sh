#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check_machine.sh TRUNNION MACHINES PYTHON: the command check-machine, and `up` and `run` of a machine that is not good: the same
# lines, and no process, no domain and no state are left.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
"$trunnion" check-machine "$2/two-channel" > "$work/good"
grep -Eq '^two-channel is good: 6 axes, 2 spindles and 2 channels in [0-9]+ files$' "$work/good" || fail "$(cat "$work/good")"

cp -rL "$2/two-channel" "$work/m"
sed -i 's/^"040002": 1/"040002": 0/; s/^"041001": 3/"041001": 2/; s/^"100006": 400/"100006": -500/' "$work/m/parameters.yaml"
! "$trunnion" check-machine "$work/m" > "$work/bad" || fail "the machine is good"
[ "$(wc -l < "$work/bad")" -eq 3 ] || fail "$(cat "$work/bad")"
grep -q "^$work/m/parameters.yaml:3:11: error: parameter 040002 (channel_axis): Y of channel 0 is axis 0 (X1), which is X of channel 0" "$work/bad" ||
  fail "$(cat "$work/bad")"
! "$trunnion" check-machine --json "$work/m" > "$work/json" || fail "the machine is good"
"$python" - "$work/json" <<'END_PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
assert report["machine"] == "two-channel" and report["channels"] == 2, report
assert [(f["line"], f["column"]) for f in report["findings"]] == [(3, 11), (7, 11), (14, 11)], report
END_PYTHON

for command in "up $work/m --domain 73 --state $work/state" "run $work/m none --domain 73"; do
  ! "$trunnion" $command > "$work/out" 2> "$work/refused" || fail "$command starts"
  sed 's/^trunnion: //' "$work/refused" | diff - "$work/bad" || fail "$command"
done
[ ! -e "/tmp/trunnion-$(id -u)/73" ] && [ ! -e "$work/state" ] || fail "something is left"
! pgrep -u "$(id -u)" -f -- "--machine $work/m" > /dev/null || fail "a process is left"

# Saved before such changes were refused, here a reference point outside the travel of 400 mm: the machine starts with an alarm,
# which the right value ends.
cp -rL "$2/two-channel" "$work/plain"
sed -i '/service: gateway/d' "$work/plain/machine.yaml"
mkdir "$work/state"
echo '"100960": 900' > "$work/state/parameters.yaml"
start_cluster "$work/plain"
await_alarm '159 .*parameter 100960 (numbered_reference): axis 0 (X1) has reference point 2 at 900 mm, outside its travel'
! "$trunnion" param set 041001 1 --domain "$domain" > "$work/out" 2>&1 || fail "an axis has two channels"
grep -q 'parameter 041001 (channel_axis): X of channel 1 is axis 1 (Y1), which is Y of channel 0 already' "$work/out" || fail "$(cat "$work/out")"
"$trunnion" param set 100960 300 --domain "$domain" > "$work/out"
reset_alarms
stop_cluster

# Parameters that no channel can use are named without a cluster, too.
printf '# saved\n"040425": 3\n' > "$work/state/parameters.yaml"
rm -f "$work/state/parameters.yaml.previous"
! "$trunnion" check-machine "$work/plain" --state "$work/state" > "$work/out" || fail "the machine is good"
grep -q "^$work/state/parameters.yaml: error: channel 0, parameters 040429 .. 040431: the direction of an axis is zero" "$work/out" || fail "$(cat "$work/out")"
