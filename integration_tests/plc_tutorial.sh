#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# plc_tutorial.sh TRUNNION MACHINES DOCS: the PLC tutorial to its stated end, on a cluster in virtual time with the programs of
# the document. Then what the delivered logic and a machine without a function do with M codes.
set -euo pipefail
trunnion=$1 machines=$2 docs=$3
. "$(dirname "$0")/cluster.sh"
refused() {  # ALARM LINE: MDI ends with this alarm, and no axis has moved
  ! "$trunnion" mdi "$2" --domain "$domain" > "$work/out" 2>&1 || fail "$2 is not refused: $(cat "$work/out")"
  grep -q "$1" "$work/out" || fail "$2: no alarm $1 in $(cat "$work/out")"
  "$trunnion" channel reset --domain "$domain"
  reset_alarms
}
moves() { "$trunnion" mdi "$1" --domain "$domain" > "$work/out" 2>&1 || fail "$1: $(cat "$work/out")"; }
without_gateway() { sed -i /gateway/d "$work/m/machine.yaml"; rm -rf "$work/m/recordings" "$work/state"; }

awk '/^## Tutorial/ { tutorial = 1 } !tutorial { next } /^```/ { inside = !inside; if (inside) ++n; next } inside { print > ("'"$work"'/block_" n) }' "$docs/plc.md"
cp -rL "$machines/ac-table" "$work/m"
without_gateway
find "$work/m/plc" -type f ! -name fast.st -delete
# Block 3 is the changer; 5 and 6 go into it, as the document says in words: the example has the result.
cp "$(dirname "$docs")/examples/plc-tool-changer/tool_changer.st" "$work/m/plc/"
for block in "$work"/block_*; do
  ! grep -q '^arm:' "$block" || cp "$block" "$work/m/plc/devices.yaml"
  ! grep -q '^PROGRAM main' "$block" || cp "$block" "$work/m/plc/main.st"
done
diff "$work/m/plc/main.st" <(tail -n +2 "$(dirname "$docs")/examples/plc-tool-changer/main.st") || fail "the tutorial's main.st is not the example's"
start_cluster "$work/m"
moves "T1 M6"
refused 132 M3
refused 1104 M13
stop_cluster

# The delivered machine knows what its parameter lists; nothing of a block with another code is done.
rm -rf "$work/m"
cp -rL "$machines/ac-table" "$work/m"
without_gateway
start_cluster "$work/m"
for code in 10 12 13 31 88 428 999; do
  [ $code = 10 ] || refused 1104 "G0 X50 M$code"
done
refused 1103 "M8 M9"
moves "M10"
moves "G4 P1"
grep -q '^X machine *0.0000' "$work/out" || fail "a refused block has moved X: $(cat "$work/out")"
