#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# bench_real_time.sh TRUNNION PYTHON: `bench --real-time --seconds` names every process of the stream and a lead.
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
