#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page in a real browser on a real cluster in virtual time: page_on_cluster.sh TRUNNION BROWSER_TEST_DIRECTORY SCREENSHOTS
set -euo pipefail
trunnion=$1 page=$2 screenshots=$3
examples=$(realpath "$(dirname "$0")/../examples")
. "$(dirname "$0")/cluster.sh"
start_cluster ac-table
url=http://localhost:$port/
# A recording to open in the page: it is made by a cluster of its own.
(cd "$work" && "$trunnion" run ac-table nas979_cone --record cone.mcap > /dev/null && "$trunnion" export cone.mcap --csv feedback --output cone.csv)
cd "$page"
EXPORTED=$work/cone.csv SCREENSHOTS=$screenshots TRUNNION_URL=$url npm run --silent browser
# Drawn programs: the ladder of the example and a chart take over.
mkdir "$work/drawn"
cp "$examples/plc-ladder/coolant.xml" browser/lamp.xml "$work/drawn"
"$trunnion" plc load "$work/drawn" --accept-differences --domain $domain > /dev/null
SCREENSHOTS=$screenshots TRUNNION_URL=$url npm run --silent browser-ladder
"$trunnion" status --domain $domain > /dev/null
