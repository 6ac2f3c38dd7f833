#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# calibrate.sh DIRECTORY [DOMAIN [PORT]]: DIRECTORY becomes a copy of the AC trunnion machine whose rotary axes are off by tenths
# of a millimetre. It is calibrated by dial and edge finder, then in a running cluster by a probe and a sphere; the result is
# written, used and taken back. The S piece and the cone are cut before and after. TRUNNION is the command (default: trunnion in PATH).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
trunnion=${TRUNNION:-trunnion}
machine=$1 domain=${2:-11} port=${3:-8080}
cp -r "$here/../../configs/machines/ac-table" "$machine"
cp "$here/truth.yaml" "$machine"

# The parameters become active a moment after the reset.
reset() {
  "$trunnion" channel reset --domain "$domain"
  while "$trunnion" param get 040433 040435 040436 040437 --json --domain "$domain" | grep -q '"pending": *true'; do
    sleep 0.1
  done
  "$trunnion" param get 040433 040435 040436 040437 --domain "$domain"
}

# Where the tool tip truly is while the machine cuts both test pieces, against the programs.
cut() {
  for program in s_piece nas979_cone; do
    "$trunnion" run "$machine" $program.nc --report "$machine/$1/$program" "${@:2}" | grep -E '^Program|Contour error'
  done
}

echo "0. Two test pieces on the machine as it is"
cut before

echo "1. By hand: virtual dial and edge finder, check at nine poses"
"$trunnion" calibrate manual "$machine" --virtual --place 60,40,-360 --resolution 1 --output "$machine/manual.yaml"

echo "2. By probe, in a cluster that runs"
"$trunnion" up "$machine" --domain "$domain" --port "$port" --time virtual --state "$machine/state"
trap '"$trunnion" down --domain "$domain"' EXIT
"$trunnion" calibrate kinematics "$machine" --on-machine --inputs "$here/inputs.yaml" --check 200 \
  --save-touches "$machine/touches.txt" --protocol "$machine/protocol.txt" --plot "$machine/residuals.svg" --write --domain "$domain"
reset

echo "3. Measured again, only to look"
"$trunnion" calibrate kinematics "$machine" --touches "$machine/touches.txt" --inputs "$here/inputs.yaml" --mode measure_only > "$machine/again.txt"
"$trunnion" calibrate kinematics "$machine" --touches "$machine/touches.txt" --inputs "$here/inputs.yaml" \
  --output "$machine/vectors.yaml" > /dev/null

echo "4. Taken back"
"$trunnion" calibrate undo --domain "$domain"
reset

echo "5. The same two pieces with the vectors that were found"
cut after --parameters "$machine/vectors.yaml"
