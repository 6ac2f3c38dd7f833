#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# measuring_cycles.sh TRUNNION MACHINES EXAMPLES PYTHON: examples/measuring-cycles in virtual time. What the cycles find is where
# truth.yaml has the solids; a wrong call is one alarm before anything moves.
set -euo pipefail
trunnion=$1 python=$4
. "$(dirname "$0")/cluster.sh"
machine=$work/m
cp -r "$2/ac-table" "$machine"
cp "$3"/measuring-cycles/truth.yaml "$machine"
cp "$3"/measuring-cycles/*.nc "$machine/programs"
# A wrong call each, and its alarm. The probe is not calibrated when the first one runs.
calls=(
  'G65 P9812 D50' 'the probe is not calibrated: G65 P9810 in a ring gauge'
  '#560=0 G65 P9812 D50' 'the probe is not calibrated: G65 P9810 in a ring gauge'
  'G65 P9810' 'P9810 needs the diameter D of the ring gauge'
  '#560=3 G65 P9811 X1 Y1' 'P9811 needs one of X Y Z'
  '#560=3 G65 P9811 X1 S7' 'S must be 1 .. 6 for G54 .. G59'
  '#560=3 G65 P9812 D-1' 'P9812: D must be above 0'
  '#560=3 G65 P9813 Z5' 'P9813 needs one of X Y'
  '#560=3 G65 P9814 X5' 'P9814 needs X and Y'
  '#560=3 G65 P9815 X5' 'P9815 needs I'
  '#560=3 G65 P9815 I5' 'P9815 needs one of X Y'
  '#560=3 G68 X0 Y0 R10 G65 P9812 D50' 'G69 G15 are needed'
  '#560=3 G10 L10 P9 R63 G43.4 H9 G65 P9812 D50' 'G43 or G49 is needed, not RTCP'
)
for ((i = 0; i < ${#calls[@]}; i += 2)); do
  { echo O0200; sed 's/ G\(10\|65\|68\|43.4\)/\nG\1/g' <<< "${calls[i]}"; echo M30; } > "$machine/programs/call_$i.nc"
done

start_cluster "$machine"
"$trunnion" channel mode auto --domain "$domain"
is_told() { "$trunnion" alarms --domain "$domain" > "$work/alarms" && grep -qF "$1" "$work/alarms"; }

for ((i = 0; i < ${#calls[@]}; i += 2)); do
  run_to_end "call_$i.nc"
  wait_until "${calls[i]}: ${calls[i + 1]}" is_told "${calls[i + 1]}"
  reset_alarms
  "$trunnion" channel reset --domain "$domain"
done

run_to_end measure.nc
"$trunnion" alarms --domain "$domain" > "$work/alarms"
grep -q 'no alarms' "$work/alarms" || fail "$(cat "$work/alarms")"
"$trunnion" variables --domain "$domain" --json > "$work/variables.json"
# Machine coordinates of the solids less G54 (X10 Y20 Z-400): the ring's centre is (-80, 0), the boss' (-60.5, 90.25), the block's
# (60.125, 30.25, -385.0625) with sides of 60, 40 and 30 mm. The last lines are the offsets G55 and G56.
"$python" - "$work/variables.json" <<'END' || fail "wrong results"
import json, math, sys
found = {int(n): v for n, v in json.load(open(sys.argv[1])).items()}
left, front, top = 60.125 - 30 - 10, 30.25 - 20 - 20, -385.0625 + 15 + 400
expected = {510: -90, 511: -20, 512: 50, 513: 0, 514: -70.5, 515: 70.25, 516: 32.5, 517: 32.5, 518: 32.5, 519: top, 520: top - 30,
            521: 50.125, 522: 60, 523: 10.25, 524: 40, 525: left, 526: left, 527: front, 528: -60.5, 529: 90.25,
            530: left - 20 + 10, 531: front + 10 + 20, 532: -400 + top - 30,
            # C1.5 turns the table clockwise by 1.5 deg, 10 mm along the left side and 20 mm back along the front.
            534: -1.5, 535: 10 * math.tan(math.radians(1.5)), 536: -1.5, 537: 20 * math.tan(math.radians(1.5)),
            533: 3 - 0.008 - 50 / 60 * 0.001}  # the ball less the pre-travel and the way of the delay of 1 ms at 50 mm/min
wrong = [f"#{n}: {found.get(n)} instead of {value}" for n, value in expected.items() if n not in found or abs(found[n] - value) > 1e-4]
if wrong: sys.exit("\n".join(wrong))
print(f"{len(expected)} results, largest difference {max(1e3 * abs(found[n] - v) for n, v in expected.items()):.4f} um")
END
