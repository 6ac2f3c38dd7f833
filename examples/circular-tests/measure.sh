#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# measure.sh DIRECTORY: circular tests on two copies of the AC trunnion machine with errors, in virtual time. DIRECTORY becomes
# the machines, and has figures (JSON), readings (CSV) and pictures (SVG) of each test. TRUNNION is the command (default: in PATH).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
trunnion=${TRUNNION:-trunnion}
output=$1
mkdir -p "$output"
for machine in linear_axes table; do
  cp -r "$here/../../configs/machines/ac-table" "$output/$machine"
  cp "$here/$machine.yaml" "$output/$machine/truth.yaml"
done
# C has less feed-forward than the linear axes: it lags (1 - 0.988) / 60 s = 0.2 ms behind them.
echo '"104904": 0.988' >> "$output/table/parameters.yaml"
measure() {
  local name=$1
  shift
  "$trunnion" measure "$@" --json --plot "$output/$name.svg" > "$output/$name.json"
}
measure circle circle "$output/linear_axes" --plane XY --radius 100 --feed 2000 --start 30 --output "$output/circle.csv"
measure encoders circle "$output/linear_axes" --radius 100 --feed 2000 --source encoder
measure k1 k-test "$output/table" --test K1 --output "$output/k1.csv"
measure k2 k-test "$output/table" --test K2
measure k2_tilted k-test "$output/table" --test K2 --hold A-30
measure r_test r-test "$output/table" --feed 2000 --output "$output/r_test.csv"
measure study r-test "$output/table" --feeds 2000,7000 --starts 0,-90
