#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# calibration.sh TRUNNION EXAMPLES MACHINES: examples/calibration, then what the commands refuse.
set -euo pipefail
export TRUNNION=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }

# Tests run in parallel: the first domain that no other cluster uses.
done=
for domain in $(seq 60 2 78); do
  if "$2/calibration/calibrate.sh" "$work/mill" "$domain" $((22000 + domain)) > "$work/log" 2>&1; then done=1; break; fi
  grep -q "domain $domain" "$work/log" || break
  rm -rf "$work/mill"
done
[ -n "$done" ] || fail "$(cat "$work/log")"

# The offset of A is that of its axis less that of C: 120 + 90 um. The inclinations of 20 and 30 urad, 36 urad together, are not
# written and go into the offsets with the distance of the sphere, 82 mm: 3 um; touches of 0.5 um come on top.
value() { awk -v number="$1" -v nth="$2" '$1 == number && $3 == "=" && $5 == "mm" && ++n == nth { print $4 }' "$work/log"; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; exit !(d < 0.0045 && d > -0.0045) }' || fail "$3: $1, not $2: $(cat "$work/log")"; }
near "$(value 040433 1)" 0.21 "offset of A"
near "$(value 040435 1)" 0.05 "X of C"
near "$(value 040436 1)" -0.09 "Y of C"
near "$(value 040437 1)" -400.08 "Z of C"
for number in 040433 040435 040436; do [ "$(value $number 2)" = 0.0 ] || fail "$number after the undo: $(value $number 2)"; done
[ "$(value 040437 2)" = -400.0 ] || fail "040437 after the undo: $(value 040437 2)"
# RTCP before and after: the largest displacement is a twentieth at most.
awk '/^before  largest/ { b = $4 + $6 + $8 } /^after   largest/ { a = $4 + $6 + $8 } END { exit !(a > 0 && a < b / 20) }' "$work/log" ||
  fail "$(grep largest "$work/log")"
grep -q '"who":".* calibrate"' "$work/mill/state/journal.jsonl" || fail "the journal does not name the calibration"
grep -q '"who":".* calibrate undo"' "$work/mill/state/journal.jsonl" || fail "the journal does not name the undo"
[ "$(grep -c '^A.* after \|^C.* after ' "$work/mill/protocol.txt")" = 2 ] || fail "$(cat "$work/mill/protocol.txt")"
# The same touches give the same vectors.
diff <(grep '^[AC] after' "$work/mill/protocol.txt") <(grep '^[AC] after' "$work/mill/again.txt") || fail "the stored touches give others"
for number in 040433 040437; do grep -q "\"$number\"" "$work/mill/manual.yaml" || fail "$(cat "$work/mill/manual.yaml")"; done

python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' "$work/mill/residuals.svg" || fail "residuals.svg is no XML"

refused() {
  local expected=$1
  shift
  if "$TRUNNION" calibrate "$@" > "$work/out" 2> "$work/error"; then fail "not refused: $*"; fi
  [ "$(wc -l < "$work/error")" = 1 ] || fail "$(cat "$work/error")"
  grep -qF -- "$expected" "$work/error" || fail "$*: $(cat "$work/error")"
}
refused "give one of --virtual" kinematics "$work/mill" --virtual --on-machine
refused "--on-machine needs --save-touches FILE" kinematics "$work/mill" --on-machine
refused "--resume continues a measurement --on-machine" kinematics "$work/mill" --virtual --resume
inputs=$2/calibration/inputs.yaml
refused "give one of --virtual, --on-machine and --touches FILE" kinematics "$work/mill"
refused "give --mode correct" kinematics "$work/mill" --virtual --output "$work/o.yaml"
refused "give the stored touches with --touches" kinematics "$work/mill" --virtual --mode only_correct
refused "the tolerance is 0.5000 mm" kinematics "$work/mill" --virtual --inputs "$inputs" --set 040437=-400.6 --output "$work/o.yaml"
[ ! -e "$work/o.yaml" ] || fail "written in spite of the tolerance"
refused "the confidence range is 1.0000 mm; reset" kinematics "$work/mill" --virtual --inputs "$inputs" --true-sphere 61.2,40,-360
refused "pose A0 C0, touch 1: no contact within the measuring path of 2 mm" kinematics "$work/mill" --virtual --inputs "$inputs" \
  --true-sphere 52,40,-360
printf 'X1 Y2\n' > "$work/touches"
refused "touches:1:1: error: axis Z is missing" kinematics "$work/mill" --touches "$work/touches" --inputs "$inputs"
refused "use \`trunnion calibrate kinematics\`" manual "$3/nutating-b-head-c-table" --virtual
"$TRUNNION" calibrate kinematics "$work/mill" --virtual --inputs "$inputs" --set 040437=-400.6 --output "$work/o.yaml" --acknowledge > "$work/out"
grep -q 040437 "$work/o.yaml" || fail "$(cat "$work/out")"
"$TRUNNION" calibrate kinematics "$work/mill" --virtual --inputs "$inputs" --json > "$work/json"
grep -q '"type": *"P"' "$work/json" || fail "$(cat "$work/json")"
