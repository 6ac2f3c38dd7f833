#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# truth_commands.sh TRUNNION MACHINES PYTHON EXAMPLES: the commands truth and measure on a copy of a machine with a truth.yaml.
set -euo pipefail
trunnion=$1 python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$2/ac-table" "$work/m"
machine=$work/m
fail() { echo "$*" >&2; exit 1; }
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', there is '$2'"; }
well_formed() { "$python" -c 'import sys, xml.dom.minidom as x; x.parse(sys.argv[1])' "$1" || fail "$1: no XML"; }

# No truth.yaml: the ideal machine. Z0 and a tool of 100: the tip is at Z-100.
is ideal "$(printf 'X10 Y200\n' | "$trunnion" truth "$machine" --tool-length 100)" \
  "10.000000 200.000000 -100.000000 0.000000000 0.000000000 1.000000000 0.000 0.000 0.000 0.000 0.000 0.000"
# Squareness of 10 urad over 200 mm, given in the call.
is set "$(printf 'X10 Y200\n' | "$trunnion" truth "$machine" --set C0Y=10 | cut -d' ' -f7-9)" "-2.000 0.000 0.000"
! "$trunnion" truth "$machine" --set C0Y=1e9 < /dev/null 2> "$work/error" || fail "1e9 urad are accepted"
is limits "$(cat "$work/error")" "trunnion: --set C0Y=1e9: expected a number within -100000 .. 100000"
# What was answered before a fault stays.
status=0
out=$(printf '# first\nX1\nX2 Q3\n' | "$trunnion" truth "$machine" 2> "$work/error") || status=$?
is status $status 1
is lines "$(wc -l <<< "$out")" 1
is place "$(cat "$work/error")" \
  "trunnion: standard input:3:4: expected a word of one of the axes XYZAC, for example X10.5"

printf 'axes:\n  Y: {C0Y_urad: 10}\n  X: {EXX: [{polynomial_um: [0, 20]}, {reversal_um: -4}]}\n' > "$machine/truth.yaml"
is "from the file" "$(printf 'Y200\n' | "$trunnion" truth "$machine" | cut -d' ' -f7-9)" "-2.000 0.000 0.000"
"$trunnion" truth "$machine" --summary 500 --plot "$work/grid.svg" > "$work/summary"
grep -q '^tip: mean .* maximum .* um$' "$work/summary" || fail "$(cat "$work/summary")"
"$trunnion" measure ballbar "$machine" --radius 150 --plot "$work/circle.svg" > "$work/ballbar"
# 10 urad, 4 um and 20 um/m, each within 2 %.
awk '/^squareness/ && ($2 < 9.8 || $2 > 10.2) { exit 1 } /^lost motion X/ && ($4 < 3.92 || $4 > 4.08) { exit 1 }
     /^scale/ && ($5 < 19.6 || $5 > 20.4) { exit 1 }' "$work/ballbar" || fail "$(cat "$work/ballbar")"
"$trunnion" measure laser "$machine" --error EXX --from -100 --to 100 --plot "$work/laser.svg" > "$work/laser"
# 20 um/m over 0.2 m.
is laser "$(awk '$1 == "mean_bidirectional_M" { print $2 }' "$work/laser")" 4.000
"$trunnion" measure sensor-nest "$machine" --axis C --at 10,20,-300 --points 3 --json |
  "$python" -c 'import json, sys; assert len(json.load(sys.stdin)["readings"]) == 3'
for picture in grid circle laser; do well_formed "$work/$picture.svg"; done

# A cluster whose X has two masses, backlash and a coarse scale: twice the same bits, and others than an ideal one.
printf 'G90 G1 F3000 X30 Y10\nG3 X30 Y10 I-10 J0\nG1 X0 Y0\nM30\n' > "$work/circle.nc"
run() {
  local name=$1
  shift
  "$trunnion" run "$machine" "$work/circle.nc" --report "$work/$name" "$@" > "$work/$name.log" 2>&1 || fail "$(cat "$work/$name.log")"
  "$trunnion" export "$work/$name/recording.mcap" --csv feedback > "$work/$name.csv"
}
# Cycle, channel, epoch, revision, and both positions of five axes: what does not depend on when and in which batches it
# was written.
motion() { cut -d, -f1-14 "$work/$1.csv"; }
rm "$machine/truth.yaml"
run none
: > "$machine/truth.yaml"
run ideal
cmp <(motion none) <(motion ideal) || fail "an empty truth.yaml changes the machine"
printf 'drives:\n  X:\n    mechanics: {coulomb: 0.02, backlash_um: 10}\n    load_encoder: {resolution_um: 1}\n' \
  > "$machine/truth.yaml"
run first
run second
cmp <(motion first) <(motion second) || fail "the second run differs"
run other_vendor --vendor fastdds
cmp <(motion first) <(motion other_vendor) || fail "the feedback differs between the vendors"
commanded() { cut -d, -f5-9 "$1"; }
cmp <(commanded "$work/first.csv") <(commanded "$work/ideal.csv") || fail "the commands differ from the ideal machine's"
! cmp -s <(motion first) <(motion ideal) || fail "the drive does not use truth.yaml"

# The example: a machine of tenths of a millimetre, which its drives can still move.
cp "$4/worn-trunnion/truth.yaml" "$machine"
"$trunnion" truth "$machine" --summary 2000 > "$work/summary"
awk '/^tip/ && ($3 + 0 < 50 || $3 + 0 > 300) { exit 1 }' "$work/summary" || fail "$(cat "$work/summary")"
run worn
[ "$(commanded "$work/worn.csv" | wc -l)" = "$(commanded "$work/ideal.csv" | wc -l)" ] || fail "the run did not end"

printf 'axes:\n  Y: {C0Y_um: 10}\n' > "$machine/truth.yaml"
status=0
echo X1 | "$trunnion" truth "$machine" > "$work/out" 2> "$work/error" || status=$?
is status $status 1
case $(cat "$work/error") in
  *"/truth.yaml:2:7: error: unknown key 'C0Y_um'"*) ;;
  *) fail "$(cat "$work/error")" ;;
esac
