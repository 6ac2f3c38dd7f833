#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# listeners.sh TRUNNION SDK PYTHON: the listeners of examples/ print every executed cycle of a cluster of either vendor, with the
# same numbers.
set -euo pipefail
trunnion=$1 sdk=$2 python=$3
examples=$(dirname "$trunnion")
. "$(dirname "$0")/cluster.sh"
# What was written before they came they get from the drive's history.
have_all() { [ "$(tail -n 1 "$work/c")" = "$(tail -n 1 "$work/cpp")" ] && grep -q " 12.5 -7.25 " "$work/c"; }

for vendor in cyclonedds fastdds; do
  start_cluster ac-table --vendor $vendor
  listeners=()
  CYCLONEDDS_URI="file://$sdk/cyclonedds.xml" "$examples/listener-in-c" "$domain" > "$work/c" & listeners+=($!)
  "$examples/listener-in-cpp" "$sdk/fastdds.xml" "$domain" > "$work/cpp" & listeners+=($!)
  "$trunnion" mdi "G53 G0 X12.5 Y-7.25" --domain "$domain" > "$work/mdi"
  wait_until "$vendor: both listeners have the same cycles up to the newest" have_all
  kill "${listeners[@]}"
  wait "${listeners[@]}" 2> /dev/null || true
  cmp "$work/c" "$work/cpp" || fail "$vendor: the listeners print different rows"
  # 12.5 mm at no more than 500 mm/s (100034) are 25 cycles at least; each comes once, in order.
  "$python" - "$work/c" << 'CHECK' || fail "$vendor: rows are missing"
import sys
cycles = [int(line.split()[0]) for line in open(sys.argv[1])]
assert len(cycles) > 25 and cycles == list(range(cycles[0], cycles[0] + len(cycles))), cycles[:3]
CHECK
  stop_cluster
  rm -rf "$work/state"
done
