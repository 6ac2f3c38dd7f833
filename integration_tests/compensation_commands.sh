#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# compensation_commands.sh TRUNNION MACHINES PYTHON: tables as text into a cluster that runs and out of it again; a bad file changes
# nothing; the axis moves by its table.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
cp -r "$2/ac-table" "$work/m"
start_cluster "$work/m"
compensation() { "$trunnion" compensation "$@" --domain "$domain"; }

[ "$(compensation show)" = "no tables" ] || fail "$(compensation show)"
# X at 0, 100 and 200 mm: 0, 20 and 40 um. Y is square to X but for 0.01 deg.
cat > "$work/tables" <<'END'
table X_X
points 3
offset 0
spacing 100000
values 0 20 40
squareness X_Y 10
END
compensation import "$work/tables" > "$work/log"
"$trunnion" channel reset --domain "$domain"
has_tables() { compensation show > "$work/shown" && ! grep -q 'no tables' "$work/shown"; }
wait_until "the tables are active" has_tables
grep -q '^pitch  *X_X  *direction 1, 3 points, 0.000 .. 200.000 mm: 0.000 .. 40.000 um$' "$work/shown" || fail "$(cat "$work/shown")"
grep -q '^squareness  *X_Y  *10.000 0.001 deg$' "$work/shown" || fail "$(cat "$work/shown")"
compensation show --json | "$python" -c 'import json, sys; t = json.load(sys.stdin); assert t[0]["largest"] == 40 and t[1]["angle"] == 10, t' ||
  fail "$(compensation show --json)"
# What is exported is what was imported, and importing that changes nothing.
compensation export "$work/exported"
compensation import "$work/exported" > "$work/log"
compensation export - | cmp - "$work/exported" || fail "another text: $(cat "$work/exported")"
grep -q '^0 20 40$' "$work/exported" || fail "$(cat "$work/exported")"

# Half way between two values X has 30 um of its table.
"$trunnion" mdi "G53 G1 X150 F3000" --domain "$domain" > "$work/log" || fail "$(cat "$work/log")"
# The history comes first, then what is published at rest, behind the cycles of the motion.
cycle=$("$trunnion" topic echo channel_state --count 1 --timeout 60 --json --domain "$domain" | sed 's/.*"cycle":\([0-9]*\).*/\1/')
"$trunnion" topic echo feedback --json --domain "$domain" > "$work/batches" &
listener=$!
is_at_rest() { grep -s "\"first\":$cycle,\"count\":0,.*}\$" "$work/batches" > "$work/at_rest"; }
wait_until "the drive reports that it rests behind cycle $cycle" is_at_rest
kill $listener
wait $listener 2> /dev/null || true
tail -n 1 "$work/at_rest" > "$work/feedback.json"
"$python" -c 'import json, sys; x = json.load(open(sys.argv[1]))["position"][0]; assert abs(x - 150.030) < 2e-4, x' "$work/feedback.json" ||
  fail "$(cat "$work/feedback.json")"

# A bad file is one line with its place, and the tables stay.
mkdir "$work/bad"
for case in 'values 0 20 x|tables:5:13: ' 'values 0 20|tables:'; do
  sed "s/^values.*/${case%%|*}/" "$work/tables" > "$work/bad/tables"
  ! compensation import "$work/bad/tables" > "$work/log" 2> "$work/error" || fail "${case%%|*} is imported"
  [ "$(wc -l < "$work/error")" = 1 ] && grep -qF "${case#*|}" "$work/error" || fail "$(cat "$work/error")"
  compensation export - | cmp - "$work/exported" || fail "a bad file has changed the tables"
done

# Into a parameter file in place of a cluster.
"$trunnion" compensation import "$work/tables" --machine "$work/m" --output "$work/parameters.yaml" > "$work/log"
grep -q '^"300020": 1 ' "$work/parameters.yaml" || fail "$(cat "$work/parameters.yaml")"
