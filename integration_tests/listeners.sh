#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# listeners.sh TRUNNION SDK PYTHON: the listeners of examples/ print every executed cycle of a cluster of either vendor, with the
# same numbers.
set -euo pipefail
trunnion=$1 sdk=$2 python=$3
examples=$(dirname "$trunnion")
work=$(mktemp -d)
domain= listeners=()
stop_listeners() {
  for listener in "${listeners[@]}"; do kill "$listener" 2> /dev/null || true; done
  wait "${listeners[@]}" 2> /dev/null || true
  listeners=()
}
trap 'stop_listeners; [ -z "$domain" ] || "$trunnion" down --domain "$domain" > /dev/null; rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }

for vendor in cyclonedds fastdds; do
  for wanted in 87 88 89 90 91 92; do
    if "$trunnion" up ac-table --time virtual --vendor $vendor --domain $wanted --state "$work/$vendor" \
        --port $((20000 + wanted)) > "$work/up" 2>&1; then
      domain=$wanted
      break
    fi
  done
  [ -n "$domain" ] || fail "$(cat "$work/up")"
  CYCLONEDDS_URI="file://$sdk/cyclonedds.xml" "$examples/listener-in-c" "$domain" > "$work/c" & listeners+=($!)
  "$examples/listener-in-cpp" "$sdk/fastdds.xml" "$domain" > "$work/cpp" & listeners+=($!)
  "$trunnion" mdi "G53 G0 X12.5 Y-7.25" --domain "$domain" > "$work/mdi"
  # What was written before they came they get from the drive's history.
  for _ in $(seq 100); do
    [ "$(tail -n 1 "$work/c")" = "$(tail -n 1 "$work/cpp")" ] && grep -q " 12.5 -7.25 " "$work/c" && break
    sleep 0.1
  done
  stop_listeners
  cmp "$work/c" "$work/cpp" || fail "$vendor: the listeners print different rows"
  # 12.5 mm at no more than 500 mm/s (100034) are 25 cycles at least; each comes once, in order.
  "$python" - "$work/c" << 'CHECK' || fail "$vendor: rows are missing"
import sys
cycles = [int(line.split()[0]) for line in open(sys.argv[1])]
assert len(cycles) > 25 and cycles == list(range(cycles[0], cycles[0] + len(cycles))), cycles[:3]
CHECK
  "$trunnion" down --domain "$domain" > "$work/down"
  domain=
done
