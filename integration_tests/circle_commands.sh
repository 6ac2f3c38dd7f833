#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# circle_commands.sh TRUNNION MACHINES PYTHON EXAMPLES: examples/circular-tests finds the errors of its machines; a second run
# gives the same readings; a recording gives the same figures; a cluster that runs; bad input is one line.
set -euo pipefail
export TRUNNION=$1
trunnion=$1 machines=$2 python=$3 examples=$4
. "$(dirname "$0")/cluster.sh"
"$examples/circular-tests/measure.sh" "$work/out" 2> "$work/error" || fail "$(cat "$work/error")"
machine=$work/out/linear_axes

"$python" - "$work/out" <<'END'
import json, math, sys, xml.dom.minidom
folder = sys.argv[1]
def of(name):
    xml.dom.minidom.parse(f"{folder}/{name}.svg")
    return json.load(open(f"{folder}/{name}.json"))
def near(what, value, expected, tolerance):
    assert abs(value - expected) <= tolerance, f"{what}: {value}, expected {expected} within {tolerance}"
# Lost motion 10 um and squareness 40 urad: +-5 um cos t and -R g sin cos. Noise 0.1 um, reversal spikes of the servo of some um.
circle = of("circle")
near("lost motion X", circle["reversal_um"][0], 10, 0.2)
near("lost motion Y", circle["reversal_um"][1], 0, 0.2)
near("squareness", circle["squareness_urad"], 40, 0.8)
near("feed", circle["feed_mm_per_min"], 2000, 2)
near("start", circle["start_deg"], 30, 0.1)
near("overrun", circle["overrun_deg"], 45, 0.1)
assert circle["hysteresis_um"] >= 9.9 and circle["bidirectional_um"] >= 9.9
# The minimum zone is the least of all, so about the least-squares circle it is not smaller.
assert circle["bidirectional_um"] <= circle["least_squares_um"][2] + 1e-6
assert circle["causes"][0]["cause"] == "lost motion X"
# The encoders of the position loops see neither.
encoders = of("encoders")
near("lost motion by the encoders", encoders["reversal_um"][0], 0, 0.2)
near("squareness by the encoders", encoders["squareness_urad"], 0, 0.8)
# C is displaced by (12, -7) um and inclined by 30 urad about X and -20 urad about Y, 50 mm below the ball: its circle is off by
# (12 + BOC h, -7 - AOC h) = (11, -8.5) um. X and Y read a constant and a circle of that radius; Z the inclination times 72.411 mm.
# C lags by 0.2 ms at 33.3 mm/s: 6.7 um along the circle, which is no constant for X and Y.
k2, tilted = of("k2"), of("k2_tilted")
assert k2["test"] == "BK2" and of("k1")["test"] == "BK1" and of("k1")["axis"] == "A"
near("radius", k2["radius_mm"], 72.411, 1e-6)
for sense in ("positive", "negative"):
    along = 2 * 72.411 * math.hypot(30e-3, 20e-3)
    near("along the axis", k2[sense]["axial_um"], along, 1.5)
    near("along the tilted axis", tilted[sense]["axial_um"], along, 1.5)
    near("radial", k2[sense]["radial_um"], 2 * math.hypot(11, 8.5), 2.5)
r = of("r_test")
near("radius", r["radius_mm"], 72.411, 1e-6)
near("speed", r["speed_rad_per_s"], 2000 / 60 / 72.411, 1e-3)
assert all(servo["fit_percent"] >= 98.27 for servo in r["servos"]), r["servos"]
for how in ("dynamic", "static"):
    errors = r[how]["errors"]
    near(how + " XOC", errors["XOC"]["value"], 12, 0.3)
    near(how + " YOC", errors["YOC"]["value"], -7, 0.3)
    near(how + " AOC", errors["AOC"]["value"], 30, 1)
    near(how + " BOC", errors["BOC"]["value"], -20, 1)
pitch = [p for p in r["pitch"] if p["order"] == 12]
assert len(pitch) == 1, r["pitch"]
near("pitch error", pitch[0]["amplitude_um"], 0.22, 0.02)
# 0.2 ms times 33.3 and 116.7 mm/s along the circle: of X and of Y the root mean square is 1 / sqrt 2 of that.
rows = of("study")["study"]
assert len(rows) == 4
for row in rows:
    expected = 0.2e-3 * row["feed_mm_per_min"] / 60 / math.sqrt(2) * 1000
    for k in (0, 1):
        near(f"dynamic less static at {row['feed_mm_per_min']}", row["difference_um"][k], expected, 0.12 * expected)
        assert row["cleaned_um"][k] < 0.2 * expected, row
# A quarter of a turn before, the ball starts along X and not along Y: the roles of both are exchanged.
fast = {row["start_deg"]: row["difference_um"] for row in rows if row["feed_mm_per_min"] == 7000}
assert (fast[0][0] > fast[0][1]) != (fast[-90][0] > fast[-90][1]), fast
END

# The second run has the same bits; what it compares has noise, so the seed counts.
"$trunnion" measure circle "$machine" --feed 2000 --start 30 --output "$work/second.csv" > "$work/table"
# A computer that is too slow for every sample gives half of them; then there is nothing to compare.
if grep -q '^readings in a second  *1000\.000' "$work/table" && grep -q '"interval_s":0.001[,}]' "$work/out/circle.json"; then
  cmp "$work/out/circle.csv" "$work/second.csv" || fail "the second run differs"
fi
grep -q '^circular hysteresis H  *1[0-9]\.[0-9]* um at' "$work/table" || fail "$(cat "$work/table")"

# A program of a user that has both circles, recorded; the first one begins 45 degrees before X.
cat > "$work/circles.nc" <<'END'
G90 G17 G94
G53 G1 X0 Y0 Z-50 F6000
G53 G1 X-35.355339 Y-35.355339 F2000
G3 I35.355339 J35.355339
G91 G3 X0 Y70.710678 I35.355339 J35.355339
G90
G53 G1 X0 Y0
G53 G1 X-35.355339 Y35.355339
G2 I35.355339 J-35.355339
G91 G2 X0 Y-70.710678 I35.355339 J-35.355339
G90
M30
END
"$trunnion" run "$machine" "$work/circles.nc" --record "$work/circles.mcap" > "$work/log" 2>&1 || fail "$(cat "$work/log")"
"$trunnion" measure circle "$machine" --recording "$work/circles.mcap" --json > "$work/recorded.json"
"$python" - "$work/recorded.json" <<'END'
import json, sys
r = json.load(open(sys.argv[1]))
assert abs(r["radius_mm"] - 50) < 1e-3 and abs(r["reversal_um"][0] - 10) < 0.2 and abs(r["squareness_urad"] - 40) < 0.8, r
END
"$trunnion" measure circle --recording "$work/circles.mcap" --source encoder > "$work/table" || fail "$(cat "$work/table")"

# A cluster that runs: the channel, its program and its place are those of before.
start_cluster "$machine"
"$trunnion" mdi "G53 G1 X20 Y10 Z-60 F6000" --domain "$domain" > /dev/null
"$trunnion" program list --domain "$domain" > "$work/before"
"$trunnion" measure circle --radius 40 --feed 3000 --domain "$domain" --json > "$work/live.json"
"$python" -c 'import json, sys; r = json.load(open(sys.argv[1])); assert abs(r["centre_mm"][0] - 20) + abs(r["centre_mm"][1] - 10) < 1e-3 and abs(r["reversal_um"][0] - 10) < 0.4, r' \
  "$work/live.json" || fail "$(cat "$work/live.json")"
"$trunnion" program list --domain "$domain" | cmp - "$work/before" || fail "the test leaves a program"

one_line() {
  local expected=$1
  shift
  ! "$trunnion" measure "$@" > "$work/said" 2> "$work/error" || fail "$*: it works"
  [ "$(wc -l < "$work/error")" = 1 ] && grep -q -- "$expected" "$work/error" || fail "$*: $(cat "$work/error")"
}
one_line 'axis X: the circle goes from -5000' circle "$machine" --radius 5000
one_line 'moves with up to' circle "$machine" --feed 90000
one_line '--at 1,2: expected X,Y,Z' circle "$machine" --at 1,2
one_line 'no circle of a whole turn' circle "$machine" --plane YZ --recording "$work/circles.mcap"
one_line 'name the machine' circle --recording "$work/circles.mcap"
one_line 'axes XYZAC' r-test "$machine" --axis Q
one_line '--hold C10: expected another rotary axis' k-test "$machine" --hold C10
one_line 'its travel is' k-test "$machine" --radius 700
one_line 'would turn with' r-test "$machine" --feed 500000
