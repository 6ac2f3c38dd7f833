#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# upgrade.sh TRUNNION MACHINES: another build takes the places of all services of a machine that has moved, one after the other; it
# is refused during a program and when it is not whole, and when one of its services fails the others are put back.
set -euo pipefail
trunnion=$1 machines=$2
built=$(dirname "$trunnion")
. "$(dirname "$0")/cluster.sh"
fail() { echo "$1"; cat "$work/said"; exit 1; }
refused() { # TEXT COMMAND...
  local text=$1 status=0
  shift
  "$trunnion" "$@" > "$work/said" 2>&1 || status=$?
  [ $status = 1 ] && grep -q "$text" "$work/said" && [ "$(grep -c '^trunnion: ' "$work/said")" = 1 ] || fail "$*: status $status"
}
executables() { # of the services that run
  "$trunnion" status --json "${here[@]}" > "$work/said"
  python3 -c 'import json, sys, os
for service in json.load(open(sys.argv[1]))["services"]: print(os.readlink("/proc/%d/exe" % service["pid"]))' "$work/said"
}

others_run() { [ "$(executables 2> /dev/null | grep -c "^$work/other/trunnion-")" = 10 ]; }

cp -r "$machines/ac-table" "$work/machine"
echo "swap_directories: [$work/other, $work/partial, $work/faulty]" >> "$work/machine/machine.yaml"
mkdir "$work/other" "$work/partial" "$work/faulty"
for service in parameters program plc drive gantry compensation kinematics channel gateway measurement; do
  cp "$built/trunnion-$service" "$work/other"
done
cp "$work/other"/* "$work/faulty"
cp "$work/other"/* "$work/partial"
rm "$work/partial/trunnion-plc"
printf '#!/bin/sh\ncase "$1" in --version) exec %s/trunnion-channel --version;; esac\necho "no licence for this machine"\nexit 1\n' \
  "$built" > "$work/faulty/trunnion-channel"

start_cluster "$work/machine"
here=(--domain "$domain")
"$trunnion" mdi "G0 X10 Y5" "${here[@]}" > "$work/said" || fail "mdi"

refused "partial/trunnion-plc: there is no such executable; nothing was replaced" upgrade "$work/partial" "${here[@]}"
printf 'G0 X20\nM0\nM30\n' > "$work/held.nc"
"$trunnion" program put "$work/held.nc" "${here[@]}" > "$work/said"
"$trunnion" channel mode auto "${here[@]}"
select_program held.nc
"$trunnion" channel start "${here[@]}"
await_state HELD
refused "channel 0 is .*: upgrade a machine at rest" upgrade "$work/other" "${here[@]}"
"$trunnion" channel reset "${here[@]}"
await_idle

"$trunnion" mdi "S1000 M3" "${here[@]}" > "$work/said" || fail "mdi"
refused "spindle 1 turns at [0-9]* 1/min; stop it (M5) first: upgrade a machine at rest" upgrade "$work/other" "${here[@]}"
"$trunnion" mdi "M5" "${here[@]}" > "$work/said" || fail "mdi"

"$trunnion" upgrade "$work/other" "${here[@]}" > "$work/upgrade" 2>&1 || { cp "$work/upgrade" "$work/said"; fail "upgrade"; }
[ "$(grep -c '^\[[0-9]*/10\] ' "$work/upgrade")" = 10 ] || { cp "$work/upgrade" "$work/said"; fail "not ten lines"; }
# The launcher publishes the new process numbers a moment after a swap.
wait_until "every service is the other build's" others_run
"$trunnion" mdi "G0 X-10 Y0" "${here[@]}" > "$work/said" || fail "mdi after the upgrade"

refused "channel 0: .*no licence for this machine; the [0-9]* services before it were put back" \
  upgrade "$work/faulty" "${here[@]}"
wait_until "every service was put back" others_run
"$trunnion" mdi "G0 X10 Y5" "${here[@]}" > "$work/said" || fail "mdi after the failed upgrade"
"$trunnion" alarms "${here[@]}" > "$work/said"
! grep -q ERROR "$work/said" || fail "alarms are left"
