#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# program_commands.sh TRUNNION: the commands for stored programs on a running cluster, as a user calls them.
set -euo pipefail
trunnion=$1
work=$(mktemp -d)
domain=
trap '[ -z "$domain" ] || "$trunnion" down --domain "$domain" > /dev/null; rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }
# refused TEXT COMMAND...: status 1 and one line with TEXT.
refused() {
  local status=0 text=$1
  shift
  "$trunnion" "$@" > "$work/out" 2> "$work/err" || status=$?
  [ $status = 1 ] && grep -q -- "$text" "$work/err" || fail "$*: status $status, $(cat "$work/err")"
}

for wanted in 81 82 83 84 85 86; do
  if "$trunnion" up ac-table --time virtual --domain $wanted --state "$work/state" --port $((20000 + wanted)) > "$work/up" 2>&1; then
    domain=$wanted
    break
  fi
done
[ -n "$domain" ] || fail "$(cat "$work/up")"
here=(--domain "$domain")

printf 'G21 G90 G54\nG0 X5\nG1 Y10 F1000\nM30\n' > "$work/part.nc"
"$trunnion" program put "$work/part.nc" "${here[@]}" > "$work/out"
grep -q "^part.nc stored: revision 1, 35 bytes, 4 lines" "$work/out" || fail "$(cat "$work/out")"
refused "is stored already (revision 1)" program put "$work/part.nc" "${here[@]}"
echo 'G0 X6' >> "$work/part.nc"
"$trunnion" program put "$work/part.nc" --replace "${here[@]}" > "$work/out"
grep -q "^part.nc stored: revision 2" "$work/out" || fail "$(cat "$work/out")"

# With and without .nc, to a file and to standard output: the same bytes.
"$trunnion" program get part "$work/again.nc" "${here[@]}" > "$work/out"
cmp "$work/part.nc" "$work/again.nc"
"$trunnion" program get part.nc "${here[@]}" | cmp - "$work/part.nc"
refused "there is no stored program nothing" program get nothing "${here[@]}"

"$trunnion" program list "${here[@]}" > "$work/out"
grep -Eq "^part.nc +2 +41 +5$" "$work/out" || fail "$(cat "$work/out")"
"$trunnion" program check part "${here[@]}" > "$work/out" || fail "$(cat "$work/out")"
printf 'G90 G54\nG0 X99999\nM30\n' > "$work/far.nc"
"$trunnion" program put "$work/far.nc" "${here[@]}" > "$work/out"
status=0
"$trunnion" program check far "${here[@]}" > "$work/out" 2>&1 || status=$?
[ $status = 1 ] && grep -q "far.nc:2" "$work/out" || fail "X99999 is within the travel? $(cat "$work/out")"

# A program that a channel executes stays.
printf 'G21 G90 G54\nG0 X5\nM0\nM30\n' > "$work/held.nc"
"$trunnion" program put "$work/held.nc" "${here[@]}" > "$work/out"
"$trunnion" channel mode auto "${here[@]}"
"$trunnion" channel select held.nc "${here[@]}"
"$trunnion" channel start "${here[@]}"
sleep 1
refused "is being executed by channel 0" program delete held "${here[@]}"
"$trunnion" program put "$work/held.nc" --replace "${here[@]}" > "$work/out"  # the same text is no change
echo "(later)" >> "$work/held.nc"
refused "is being executed by channel 0" program put "$work/held.nc" --replace "${here[@]}"
"$trunnion" channel reset "${here[@]}"
sleep 1
"$trunnion" program rename held other.nc "${here[@]}" > "$work/out"
"$trunnion" program delete other "${here[@]}" > "$work/out"
refused "there is no stored program held" program delete held "${here[@]}"
