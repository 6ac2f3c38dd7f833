#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program_commands.sh TRUNNION: the commands for stored programs on a running cluster, as a user calls them.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
# is_refused TEXT COMMAND...: status 1 and one line with TEXT.
is_refused() {
  local text=$1
  shift
  status=0
  "$trunnion" "$@" > "$work/out" 2> "$work/err" || status=$?
  [ $status = 1 ] && grep -q -- "$text" "$work/err"
}
refused() { is_refused "$@" || fail "${*:2}: status $status, $(cat "$work/err")"; }

start_cluster ac-table
here=(--domain "$domain")

printf 'G21 G90 G54\nG0 X5\nG1 Y10 F1000\nM30\n' > "$work/part.nc"
"$trunnion" program put "$work/part.nc" "${here[@]}" > "$work/out"
grep -q "^part.nc stored: revision 1, 35 bytes, 4 lines" "$work/out" || fail "$(cat "$work/out")"
refused "is stored already (revision 1)" program put "$work/part.nc" "${here[@]}"
echo 'G0 X6' >> "$work/part.nc"
"$trunnion" program put "$work/part.nc" --replace "${here[@]}" > "$work/out"
grep -q "^part.nc stored: revision 2" "$work/out" || fail "$(cat "$work/out")"

# With and without .nc, to a file and to standard output: the same bytes.
"$trunnion" program get part "$work/again.nc" "${here[@]}" > "$work/out"
cmp "$work/part.nc" "$work/again.nc"
"$trunnion" program get part.nc "${here[@]}" | cmp - "$work/part.nc"
refused "there is no stored program nothing" program get nothing "${here[@]}"

"$trunnion" program list "${here[@]}" > "$work/out"
grep -Eq "^part.nc +2 +41 +5$" "$work/out" || fail "$(cat "$work/out")"
"$trunnion" program check part "${here[@]}" > "$work/out" || fail "$(cat "$work/out")"
printf 'G90 G54\nG0 X99999\nM30\n' > "$work/far.nc"
"$trunnion" program put "$work/far.nc" "${here[@]}" > "$work/out"
status=0
"$trunnion" program check far "${here[@]}" > "$work/out" 2>&1 || status=$?
[ $status = 1 ] && grep -q "far.nc:2" "$work/out" || fail "X99999 is within the travel? $(cat "$work/out")"
printf 'G90 G54\nT99 M6\nM30\n' > "$work/tool.nc"
status=0
"$trunnion" check "$work/tool.nc" --machine ac-table > "$work/out" 2>&1 || status=$?
[ $status = 1 ] && grep -q "tool.nc:2.*T99" "$work/out" && grep -q 1709 "$work/out" || fail "T99 is there? $(cat "$work/out")"

# The tables of the running machine count, and the programs that it has stored: O99 is in no folder of the machine.
printf 'G90 G54\nT17 M6\nG0 X150\nM98 P99\nM30\n' > "$work/calls.nc"
printf 'G0 X-150\nM99\n' > "$work/O99.nc"
for name in calls.nc O99.nc; do "$trunnion" program put "$work/$name" "${here[@]}" > "$work/out"; done
status=0
"$trunnion" program check calls "${here[@]}" > "$work/out" 2>&1 || status=$?
[ $status = 1 ] && grep -q "calls.nc:2.*1709" "$work/out" || fail "tool 17 is not there: $(cat "$work/out")"
curl -fsS -X PUT -H "Content-Type: application/json" -d "{\"length\": 80, \"length_wear\": 0, \"radius\": 5, \"radius_wear\": 0, \"name\": \"drill\"}" \
  "http://127.0.0.1:$port/api/tools/17" > "$work/out" || fail "$(cat "$work/out")"
"$trunnion" program check calls "${here[@]}" > "$work/out" 2>&1 || fail "tool 17 is there: $(cat "$work/out")"
"$trunnion" param set 100007 -100 "${here[@]}" > "$work/out"
reset_and_settle 100007
status=0
"$trunnion" program check calls "${here[@]}" > "$work/out" 2>&1 || status=$?
[ $status = 1 ] && grep -q "O99.nc:1" "$work/out" || fail "X-150 is within -100? $(cat "$work/out")"

# A program that a channel executes stays. What the store knows of the channel is seen by a change to a name that is taken.
printf 'G21 G90 G54\nG0 X5\nM0\nM30\n' > "$work/held.nc"
"$trunnion" program put "$work/held.nc" "${here[@]}" > "$work/out"
"$trunnion" channel mode auto "${here[@]}"
select_program held
"$trunnion" channel start "${here[@]}"
taken_name=(program rename held part.nc "${here[@]}")
wait_until "the store knows that held.nc is executed" is_refused "is being executed by channel 0" "${taken_name[@]}"
refused "is being executed by channel 0" program delete held "${here[@]}"
"$trunnion" program put "$work/held.nc" --replace "${here[@]}" > "$work/out"  # the same text is no change
echo "(later)" >> "$work/held.nc"
refused "is being executed by channel 0" program put "$work/held.nc" --replace "${here[@]}"
"$trunnion" channel reset "${here[@]}"
wait_until "the store knows that held.nc has ended" is_refused "exists already" "${taken_name[@]}"
"$trunnion" program rename held other.nc "${here[@]}" > "$work/out"
"$trunnion" program delete other "${here[@]}" > "$work/out"
refused "there is no stored program held" program delete held "${here[@]}"
