#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# gantry_commands.sh TRUNNION MACHINES PYTHON: the command gantry on a cluster whose slave is 0.15 mm from its place: both
# sides, the error, the limit, Auto Offset as a proposal and written, a second run, machines without a gantry.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
cp -rL "$2/gantry-cb-head" "$work/m"
# The slave belongs 0.15 mm farther than it is, the limit is 0.1 mm, and nothing aligns it.
cat >> "$work/m/parameters.yaml" <<'END'
"102129": 0.15
END
sed -i 's/^"102062": 1/"102062": 0/; s/^"102107": 0.2/"102107": 0.1/' "$work/m/parameters.yaml"
began=$(date -u +%Y-%m-%dT%H:%M:%S)
start_cluster "$work/m"
gantry() { "$trunnion" gantry --domain "$domain" "$@"; }

# The drives are switched on a moment after the services are ready.
is_coupled() { gantry > "$work/shown" && grep -q '^Y (axis 1) with its slave Y2 (axis 2): coupled' "$work/shown"; }
wait_until "the slave is coupled" is_coupled
grep -q 'synchronization error  *-0.1500 mm  *limit 0.1000 (parameter 102107)  EXCEEDED' "$work/shown" || fail "$(cat "$work/shown")"
grep -q 'difference of speeds .* not supervised (parameter 102108)' "$work/shown" || fail "$(cat "$work/shown")"
grep -q 'Auto Offset: parameter 102129 of axis 2 would be set to 0.000000 mm (now 0.150000)' "$work/shown" || fail "$(cat "$work/shown")"
"$trunnion" param get 102129 --domain "$domain" | grep -q '= 0.15' || fail "a proposal has written"
await_alarm 'Slave axis 2 is off its master axis 1 by -0.1500 mm, limit 0.1000 mm (parameter 102107)'
# When it was raised, of the wall clock, and the cycle, or - when none belongs to it.
grep -qE '^ *[0-9]+ [A-Z]+ +[a-z]+ +[-0-9]{10}T[0-9:]{8}\.[0-9]{3}Z cycle ([0-9]+|-) +Slave axis 2 ' "$work/alarms" ||
  fail "$(cat "$work/alarms")"
"$trunnion" alarms --json --domain "$domain" > "$work/json"
"$python" - "$work/json" "$began" "$(date -u +%Y-%m-%dT%H:%M:%SZ)" <<'END' || fail "$(cat "$work/json")"
import json, sys
path, began, now = sys.argv[1:]
alarms = json.load(open(path))
# Texts of this form sort as the moments do; those of now and of the alarm differ by the milliseconds.
assert alarms and all(began <= alarm["raised"] and alarm["raised"][:19] <= now[:19] for alarm in alarms), (began, now)
END

gantry --json --write > "$work/json"
"$python" - "$work/json" <<'END' || fail "$("$trunnion" status --domain "$domain")"
import json, sys
shown = json.load(open(sys.argv[1]))
(pair,) = shown["gantries"]
assert shown["written"] is True, shown
assert abs(pair["synchronization_error"]["value"] + 0.15) < 1e-4 and pair["synchronization_error"]["exceeded"], pair
assert pair["synchronization_error"]["unit"] == "mm" and pair["synchronization_error"]["parameter"] == "102107", pair
assert pair["auto_offset"]["parameter"] == "102129" and abs(pair["auto_offset"]["proposal_mm"]) < 1e-4, pair
assert pair["alignment"]["on"] is False and pair["state"] == "coupled", pair
END
stop_cluster
start_cluster "$work/m"
wait_until "the slave is coupled" is_coupled
grep -q 'synchronization error  *-*0.0000 mm' "$work/shown" || fail "after the restart: $(cat "$work/shown")"
gantry --json --write | "$python" -c 'import json, sys; assert json.load(sys.stdin)["written"] is False' || fail "a second writing"

# A machine of its own; and one without a gantry.
"$trunnion" gantry "$2/gantry-cb-head" > "$work/shown" || fail "a cluster of its own"
grep -q 'alignment on: errors up to 0.2000 mm' "$work/shown" || fail "a cluster of its own: $(cat "$work/shown")"
"$trunnion" gantry "$2/ac-table" | grep -q 'ac-table has no gantry' || fail "a machine without a gantry"
