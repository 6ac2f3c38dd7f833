#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cycle9960.sh TRUNNION EXAMPLES MACHINES: examples/calibration/measure.nc, a program with CYCLE9960, recorded on each vendor. The
# channel does the same from the recording, and the motion is the same bit for bit. A machine without the service says so.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
machine=$work/mill
cp -r "$3/ac-table" "$machine"
cp "$2/calibration/truth.yaml" "$machine"
cp "$2/calibration/measure.nc" "$work"
for vendor in cyclonedds fastdds; do
  "$trunnion" run "$machine" "$work/measure.nc" --vendor $vendor --record "$work/$vendor.mcap" \
    --report "$work/$vendor" > "$work/log" 2>&1 || fail "$vendor: $(cat "$work/log")"
  "$trunnion" verify --service channel --recording "$work/$vendor.mcap" --machine "$machine" \
    --require "cycle of a service" > "$work/verify" 2>&1 || fail "$vendor: $(cat "$work/verify")"
done
"$trunnion" diff "$work/cyclonedds.mcap" "$work/fastdds.mcap" --align --topics path_batch,gantry_batch > "$work/diff" ||
  fail "$(cat "$work/diff")"

sed -i '/measurement/d' "$machine/machine.yaml"
status=0
"$trunnion" run "$machine" "$work/measure.nc" --report "$work/none" > "$work/log" 2>&1 || status=$?
[ $status != 0 ] || fail "measured without the service"
grep -q 'measure.nc:6: this machine has no service `measurement`' "$work/log" || fail "$(cat "$work/log")"
