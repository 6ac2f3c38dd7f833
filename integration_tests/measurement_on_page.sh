#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The kinematics of a displaced table and a workpiece measured from the page, on real clusters in virtual time:
# measurement_on_page.sh TRUNNION BROWSER_TEST_DIRECTORY SCREENSHOTS
set -euo pipefail
trunnion=$1 page=$2 screenshots=$3
source=$(realpath "$(dirname "$0")/..")
. "$(dirname "$0")/cluster.sh"
cp -r "$source/configs/machines/ac-table" "$work/mill"
cp "$source/examples/calibration/truth.yaml" "$work/mill/truth.yaml"
start_cluster "$work/mill"
cd "$page"
SCREENSHOTS=$screenshots TRUNNION_URL=http://localhost:$port/ npm run --silent browser-measurement
"$trunnion" status --domain $domain > /dev/null
grep -q '"who":"[^"]* calibrate undo"' "$work/state/journal.jsonl" || fail "the journal does not name the undo"
stop_cluster
cp "$source/examples/measuring-cycles/truth.yaml" "$work/mill/truth.yaml"
rm -r "$work/state"
start_cluster "$work/mill"
SCREENSHOTS=$screenshots TRUNNION_URL=http://localhost:$port/ npm run --silent browser-measuring
