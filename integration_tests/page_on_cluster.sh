#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page in a real browser on a real cluster in virtual time: page_on_cluster.sh TRUNNION BROWSER_TEST_DIRECTORY SCREENSHOTS
set -euo pipefail
trunnion=$1 page=$2 screenshots=$3
domain=58 port=18358
state=$(mktemp -d)
trap '"$trunnion" down --domain $domain > /dev/null 2>&1 || true; rm -rf "$state"' EXIT
"$trunnion" up ac-table --time virtual --domain $domain --port $port --state "$state"
cd "$page"
SCREENSHOTS=$screenshots TRUNNION_URL=http://localhost:$port/ npm run --silent browser
"$trunnion" status --domain $domain > /dev/null
