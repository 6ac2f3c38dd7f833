#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# plan_command.sh TRUNNION PYTHON: what the command plan reports beside the motion: the least time, and the places that
# lose most time as text, JSON and picture.
set -euo pipefail
trunnion=$1
python=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }

# Time is lost at the square corner in line 5 and at both ends, not within lines of 100 mm at the programmed feed.
printf 'G21 G17 G90 G94 G61\nG0 X0 Y0\nF6000\nG1 X100\nY100\nM30\n' > "$work/corner.nc"
"$trunnion" plan "$work/corner.nc" --machine ac-table --plot "$work/corner.svg" > "$work/report.json"
"$trunnion" plan "$work/corner.nc" --machine ac-table --places > "$work/places"
"$python" -B - "$work" <<'END'
import json, re, sys, xml.dom.minidom
work = sys.argv[1]
report = json.load(open(work + "/report.json"))
# Two lines at 100 mm/s from stop to stop: 1 s each and a ramp of 2 sqrt(v / J) = 82 ms, J = 60000 mm/s3. The motion may
# take two percent more than the least time.
assert report["least_time"] <= report["motion_time"] < 1.02 * report["least_time"], report
places = report["costly_places"]
assert 1 <= len(places) <= 10, places
assert all(a["lost"] >= b["lost"] for a, b in zip(places, places[1:])), places
for place in places:
    assert place["lost"] > 0 and place["begin"] < place["end"] <= 0.001 * report["cycles"] + 0.001, place
    assert place["axis"] in "XY" and place["limit"] in ("velocity", "acceleration", "jerk"), place
    assert 4 <= place["lines"][0] <= place["lines"][1] <= 5, place
text = open(work + "/places").read().splitlines()
assert len(text) == len(places), text
for line, place in zip(text, places):
    first, last = place["lines"]
    lines = str(first) if first == last else "%d-%d" % (first, last)
    assert line.startswith(work + "/corner.nc:" + lines + ": "), (line, place)
    lost, begin = map(float, re.search(r"([0-9.]+) s lost from ([0-9.]+) s on", line).groups())
    assert abs(lost - place["lost"]) < 0.001 and abs(begin - place["begin"]) < 0.001, (line, place)
    assert "axis " + place["axis"] in line and "its " + place["limit"] in line, (line, place)
picture = xml.dom.minidom.parse(work + "/corner.svg")
words = [node.firstChild.data for node in picture.getElementsByTagName("text") if node.firstChild]
for number, line in enumerate(text, 1):
    assert "%d. %s" % (number, line[len(work + "/corner.nc:"):]) in words, words
    assert words.count(str(number)) >= 2, words  # on the path and over time
# Path, programmed feed, feed, and each place twice.
assert len(picture.getElementsByTagName("polyline")) == 3 + 2 * len(places)
END
status=0
"$trunnion" plan "$work/corner.nc" --machine ac-table --plot /nowhere/corner.svg > "$work/out" 2> "$work/err" || status=$?
[ $status = 1 ] && grep -q "^.*/nowhere/corner.svg: cannot be written" "$work/err" || fail "status $status, $(cat "$work/err")"
