#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# run_stopped.sh TRUNNION: `trunnion run` says where a program has stopped and how it is continued, and ends with it.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"

printf 'G21 G90 G54\nG0 X5\nM0\nG0 X6\nM0\nG0 X7\nM30\n' > "$work/stops.nc"
"$trunnion" run ac-table "$work/stops.nc" --report "$work/report" > "$work/said" 2>&1 &
run=$!
stopped() { grep -q "channel 0 is stopped behind line $1 (M0, M1 or a feed hold)" "$work/said" || ! kill -0 $run 2> /dev/null; }
for line in 2 4; do
  wait_until "the run says that the program is stopped behind line $line" stopped $line
  start=$(sed -n "s/.*line $line .*'trunnion \(channel start .*\)'.*/\1/p" "$work/said")
  [ -n "$start" ] || fail "$(cat "$work/said")"
  "$trunnion" $start
done
wait $run || fail "$(cat "$work/said")"
[ "$(grep -c "is stopped behind line" "$work/said")" = 2 ] || fail "once for each stop: $(cat "$work/said")"
