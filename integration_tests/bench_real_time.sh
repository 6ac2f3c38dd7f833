#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# bench_real_time.sh TRUNNION PYTHON: `bench --real-time --seconds` names every process of the stream and a lead; a stage that
# comes to a halt is counted as starved periods and does not end the benchmark.
set -eu
trunnion=$1 python=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

printf 'G21 G90 G94 G54\nG1 X20 F3000\nG1 X0 Y10\nG1 Y0\nM30\n' > "$work/short.nc"
"$trunnion" bench --real-time --seconds 1 --program "$work/short.nc" --vendor cyclonedds --json > "$work/timing.json"
"$python" - "$work/timing.json" << 'CHECK'
import json
import sys

(run,) = json.load(open(sys.argv[1]))
names = [p["process"] for p in run["processes"]]
assert names == ["channel", "kinematics", "compensation", "gantry", "drive", "whole stream"], names
assert run["vendor"] == "cyclonedds"
# 20, 22.4 and 10 mm at 50 mm/s take 1.05 s without the ramps; what did not arrive would be missing here.
assert run["cycles"] + run["missing_cycles"] > 1050, run["cycles"]
for process in run["processes"]:
    assert process["count"] > 100, process
    assert sum(process["histogram"]) == process["count"], process
    assert process["median_us"] <= process["p99_us"] <= process["p999_us"] <= process["maximum_us"], process
assert 8 <= run["usable_lead_cycles"], run
CHECK

# A stage that stands still for 0.3 s with setpoints of 0.03 s ahead starves the drive; the program goes on to its end.
printf 'G21 G90 G94 G54\nG1 X60 F1000\nM30\n' > "$work/long.nc"
# The processes of the cluster have the environment of the command; other tests have clusters beside it.
BENCH_OF_TEST=$$ "$trunnion" bench --real-time --rounds 1 --program "$work/long.nc" --vendor cyclonedds --json \
  > "$work/starved.json" 2> "$work/error" &
bench=$!
stage=
for _ in $(seq 1200); do
  for process in $(pgrep trunnion-kinema); do
    if grep -qzx "BENCH_OF_TEST=$$" "/proc/$process/environ" 2> /dev/null; then stage=$process; fi
  done
  [ -z "$stage" ] || break
  sleep 0.05
done
[ -n "$stage" ] || { echo "no stage"; cat "$work/error"; exit 1; }
# The motion takes 3.6 s, whenever it begins; the stage ends with the benchmark.
while :; do
  sleep 0.9
  kill -STOP "$stage" 2> /dev/null || break
  sleep 0.3
  kill -CONT "$stage" 2> /dev/null || break
done
wait $bench || { cat "$work/error" "$work/starved.json"; exit 1; }
"$python" - "$work/starved.json" << 'CHECK'
import json
import sys

(run,) = json.load(open(sys.argv[1]))
assert run["starved_periods"] > 0, run
assert run["cycles"] > 3600, run  # 60 mm at 16.7 mm/s
CHECK
