#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# check.sh TRUNNION EXECUTABLE WRONG RECORDED-MACHINES WORK: the suite passes with EXECUTABLE, and does not with WRONG, a stage
# that is wrong in one bit; so the check is known to check something. Writes junit.xml and report.html of both into WORK.
set -euo pipefail
trunnion=$1 executable=$2 wrong=$3 machines=$4 work=$5
rm -rf "$work"
mkdir -p "$work/recordings"
cp "$(dirname "$0")/suite.yaml" "$work"
for machine in ac-table gantry-cb-head; do
  cp "$machines/$machine/recordings/golden.mcap" "$work/recordings/$machine.mcap"
done
cp "$executable" "$work/compensation-in-c"
"$trunnion" test "$work/suite.yaml" --junit "$work/junit.xml" --html "$work/report.html"

cp "$wrong" "$work/compensation-in-c"
if "$trunnion" test "$work/suite.yaml" --junit "$work/wrong.xml" --html "$work/wrong.html"; then
  echo "a stage that is wrong in one bit passed" >&2
  exit 1
fi
failures=$(grep -c "first difference: compensation_batch" "$work/wrong.xml")
[[ $failures -ge 1 ]] && [[ -n $(sed -n '/<svg/p' "$work/wrong.html") ]]
