#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# faulty_parameters.sh TRUNNION MACHINES: a machine whose saved parameters no channel can use starts with its drives off, names them,
# and is ready when they are corrected.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
cp -rL "$2/two-channel" "$work/m"
sed -i '/service: gateway/d' "$work/m/machine.yaml"
# is_published TOPIC PATTERN: in the newest message.
is_published() { "$trunnion" topic echo "$1" --count 1 --timeout 5 --json --domain "$domain" > "$work/topic" 2>&1 && grep -Eq "$2" "$work/topic"; }
is_ready() { "$trunnion" status --domain "$domain" > "$work/status" 2>&1; }
moves() { "$trunnion" mdi "G0 X$1" --domain "$domain" > "$work/moved" 2>&1; }

# saves PARAMETERS: all that is in the state directory then.
saves() {
  rm -rf "$work/state"
  mkdir "$work/state"
  printf '# saved\n%b\n' "$1" > "$work/state/parameters.yaml"
}

# recovers SAVED PATTERN NUMBER VALUE: with SAVED the start names what PATTERN matches, and NUMBER = VALUE corrects it.
recovers() {
  saves "$1"
  ! "$trunnion" up "$work/m" --free-domain --time virtual --state "$work/state" --json > "$work/up" 2> "$work/fault" ||
    fail "$1: up says that it is ready"
  domain=$(sed -n 's/.*"domain": *\([0-9]*\).*/\1/p' "$work/up")
  [ -n "$domain" ] || fail "$1: no cluster: $(cat "$work/fault")"
  grep -Eq "drives off, not ready: channel \\(.*$2" "$work/fault" || fail "$(cat "$work/fault")"
  await_alarm "$2"
  wait_until "the drives are off" is_published feedback '"mode":"OFF"'
  ! is_ready || fail "$1: status says that it is ready"
  grep -q FAULT "$work/status" || fail "$(cat "$work/status")"
  ! moves 1 || fail "$1: it moves"
  grep -Eq "$2" "$work/moved" || fail "$(cat "$work/moved")"

  # Neither reset takes the alarm away, and the kept value is still there.
  "$trunnion" alarms --reset --domain "$domain" > "$work/alarms" || true
  "$trunnion" channel reset --domain "$domain" > "$work/out"
  has_alarm "$2" || fail "$1: the alarm is gone: $(cat "$work/alarms")"

  "$trunnion" param set "$3" "$4" --domain "$domain" > "$work/out" || fail "$(cat "$work/out")"
  "$trunnion" channel reset --domain "$domain" > "$work/out"
  wait_until "the machine is ready" is_ready
  await_alarm 'no alarms'
  wait_until "an axis moves" moves 1
  stop_cluster
  start_cluster "$work/m"  # and next time
  stop_cluster
}

recovers '"300020": 1\n"300022": 50\n"300023": 10\n"000910": 20' 'parameter 000910 .volumetric_values_maximum. permits 20 values' 000910 100
recovers '"301030": 1' 'parameter 301031 .squareness_first_axis.' 301030 0
recovers '"040425": 3' 'parameters 040429 .. 040431: the direction of an axis is zero' 040425 0

# The same without a cluster.
offline() { "$trunnion" param "$@" --state "$work/state" > "$work/out" 2>&1; }
saves '"300020": 1\n"300022": 50\n"300023": 10\n"000910": 20'
cp -r "$work/state" "$work/before"
offline get 000910 300022 --machine "$work/m" || fail "$(cat "$work/out")"
grep -q '^000910 volumetric_values_maximum = 20' "$work/out" && grep -q '^300022 pitch_points = 50' "$work/out" || fail "$(cat "$work/out")"
diff -r "$work/before" "$work/state" || fail "get has changed the state"
! offline get 000910 || fail "no machine: $(cat "$work/out")"
grep -q "say with --machine whose state $work/state is" "$work/out" || fail "$(cat "$work/out")"
! offline set 000910 10001 --machine "$work/m" || fail "beyond its limit: $(cat "$work/out")"
grep -q 'parameter 000910 .*10001.*10000' "$work/out" || fail "$(cat "$work/out")"
offline set 000910 100 --machine "$work/m" || fail "$(cat "$work/out")"
grep -q '"number":910,"old":20.0,"new":100.0' "$work/state/journal.jsonl" || fail "$(cat "$work/state/journal.jsonl")"
start_cluster "$work/m"
"$trunnion" param get 000910 --domain "$domain" | grep -q '= 100' || fail "the value is not active"
! offline set 000910 200 --machine "$work/m" || fail "while the cluster runs: $(cat "$work/out")"
grep -q 'is in use by launcher' "$work/out" || fail "$(cat "$work/out")"
stop_cluster

# Damage is told by the next start: a change beside it would put the file aside, and nothing would tell any more.
printf x >> "$work/state/parameters.yaml"
rm -rf "$work/before"
cp -r "$work/state" "$work/before"
for command in "get 000910" "set 000910 200"; do
  ! offline $command --machine "$work/m" || fail "$command of a damaged file: $(cat "$work/out")"
  grep -q "parameters.yaml is damaged" "$work/out" || fail "$(cat "$work/out")"
done
diff -r "$work/before" "$work/state" || fail "the damaged state was changed"
