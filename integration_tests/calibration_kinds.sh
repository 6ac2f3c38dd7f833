#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# calibration_kinds.sh TRUNNION MACHINES PYTHON: heads, mixed, nutating and single axes are measured on the running machine, whose
# axes are not where the parameters have them. The vectors are written, and the second measurement finds nothing to correct.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
have_values() { # NUMBER=VALUE...
  "$trunnion" param get "${@%=*}" --json --domain "$domain" > "$work/values"
  "$python" - "$work/values" "$@" << 'PYTHON' 2> "$work/error"
import json, sys
values = {row["number"]: row["value"] for row in json.load(open(sys.argv[1]))}
for setting in sys.argv[2:]:
    number, value = setting.split("=")
    # The uncertainty that the protocol states is 0.3 to 1.1 um.
    assert abs(values[number] - float(value)) < 0.002, (number, values[number], value)
PYTHON
}
# measured NAME POSITION INPUTS TRUTH NUMBER=VALUE...: the parameters become the values.
measured() {
  local machine=$work/$1 position=$2 inputs=$3 truth=$4
  shift 4
  cp -rL "$machines/$(basename "$machine")" "$machine"
  rm -rf "$machine/recordings"
  sed -i '/gateway/d' "$machine/machine.yaml"
  echo "  - {service: measurement}" >> "$machine/machine.yaml"
  cat > "$machine/truth.yaml" << YAML
axes: {$truth}
probe: {ball_radius_mm: 3, length_mm: 60, pre_travel_um: 8, repeatability_um: 0.3, delay_ms: 1, seed: 1}
solids:
  - {sphere: {diameter_mm: 25, shaft_diameter_mm: 8, shaft_length_mm: 40}, position_mm: [$position]}
YAML
  printf 'mode: correct\ncalibrate_probe: true\naxes: {%s}\n' "$inputs" > "$work/inputs.yaml"
  rm -rf "$work/state"
  start_cluster "$machine"
  "$trunnion" calibrate kinematics "$machine" --on-machine --inputs "$work/inputs.yaml" --write --domain "$domain" > "$work/log" 2>&1 ||
    fail "$machine: $(cat "$work/log")"
  reset_and_settle "${@%=*}"
  have_values "$@" || fail "$machine: $(cat "$work/error" "$work/log")"
  sed -i 's/^mode: .*/mode: measure_only/' "$work/inputs.yaml"
  "$trunnion" calibrate kinematics "$machine" --on-machine --inputs "$work/inputs.yaml" --domain "$domain" > "$work/log" 2>&1 ||
    fail "$machine: $(cat "$work/log")"
  # Of every vector: the second measurement and the first differ by less than their uncertainties together.
  awk '$2 == "difference" { n++; for (i = 3; i <= 5; i++) if ($i > 0.002 || $i < -0.002) bad = 1 } END { exit !(n > 0 && !bad) }' \
    "$work/log" || fail "$machine, measured again: $(cat "$work/log")"
  stop_cluster
}
machines=$2

# B and C are 60 and 40 um beside where the head's vectors have them: from axis to axis, and from B to the spindle face.
measured cb-head "60, 40, -460" "C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 90}, B: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0}" \
  "B: {XOB_um: 60}, C: {YOC_um: -40}" 040417=0.24 040418=-0.14 040420=0.26
# The axis of B is 70 um lower; that of the table 50 and 90 um beside.
measured b-head-c-table "60, 40, -460" "B: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0}, C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 0}" \
  "B: {ZOB_um: -70}, C: {XOC_um: 50, YOC_um: -90}" 040422=179.93 040435=10.05 040436=19.91
measured nutating-b-head-c-table "60, 40, -460" "B: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0}, C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 0}" \
  "B: {XOB_um: 60}, C: {XOC_um: 50, YOC_um: -90}" 040420=0.16 040435=10.05 040436=19.91
measured four-axis "60, 40, -360" "A: {start_deg: 0, end_deg: 90, points: 4}" \
  "A: {YOA_um: 120, ZOA_um: -80}" 040436=4.12 040437=-380.08
