#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page in a real browser on a real cluster in virtual time: page_on_cluster.sh TRUNNION BROWSER_TEST_DIRECTORY SCREENSHOTS
set -euo pipefail
trunnion=$1 page=$2 screenshots=$3
domain=58 port=18358
state=$(mktemp -d)
trap '"$trunnion" down --domain $domain > /dev/null 2>&1 || true; rm -rf "$state"' EXIT
"$trunnion" up ac-table --time virtual --domain $domain --port $port --state "$state"
# A recording to open in the page: it is made by a cluster of its own.
(cd "$state" && "$trunnion" run ac-table nas979_cone --record cone.mcap > /dev/null && "$trunnion" export cone.mcap --csv feedback_frame --output cone.csv)
cd "$page"
EXPORTED=$state/cone.csv SCREENSHOTS=$screenshots TRUNNION_URL=http://localhost:$port/ npm run --silent browser
"$trunnion" status --domain $domain > /dev/null
