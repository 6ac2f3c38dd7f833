#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# commissioning.sh TRUNNION EXAMPLES PYTHON: examples/commissioning makes a good machine of a bad one; then a five-axis
# program runs on it within the limits of its axes, and the tool is where the program has it.
set -euo pipefail
export TRUNNION=$1
python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }

# Tests run in parallel: the first domain that no other cluster uses.
done=
for domain in $(seq 41 2 49); do
  if "$2/commissioning/commission.sh" "$work/mill" "$domain" $((21000 + domain)) > "$work/log" 2>&1; then done=1; break; fi
  grep -q "domain $domain" "$work/log" || break
  rm -rf "$work/mill"
done
[ -n "$done" ] || fail "$(cat "$work/log")"
grep -q '040951 volumetric_type = 2' "$work/log" || fail "$(cat "$work/log")"
# Mean deviation of the tip, um: the last summary is at most 15 % of the first. Constant offsets are in both.
awk '/^tip: mean/ { sub(",", "", $3); value[n++] = $3 + 0 } END { exit !(n == 2 && value[1] < 0.15 * value[0]) }' "$work/log" ||
  fail "$(grep -A1 'random poses' "$work/log")"

cat > "$work/five_axis.nc" <<'END'
G21 G17 G90 G54 G94 G64
T1 M6
G0 X0 Y0 Z0 A0 C0
G43.4 H1
G1 X120 Y60 Z-40 A25 C40 F12000
X-100 Y-50 Z0 A-20 C-50
G2 X-100 Y-50 I30 J10 A15 C20
G1 X0 Y0 Z-20 A40 C120
G0 X60 Y-60 A-30 C60
X-60 Y60 A30 C-30
M30
END
"$TRUNNION" run "$work/mill" "$work/five_axis.nc" --report "$work/report" > "$work/run.log" 2>&1 || fail "$(cat "$work/run.log")"
for topic in kinematics_batch compensation_batch; do
  "$TRUNNION" export "$work/report/recording.mcap" --csv $topic > "$work/$topic.csv"
done
"$python" "$(dirname "$0")/check_compensated_motion.py" "$TRUNNION" "$work"
