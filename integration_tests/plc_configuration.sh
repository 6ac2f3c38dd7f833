#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# plc_configuration.sh TRUNNION MACHINES PYTHON: the AC table's logic run by a CONFIGURATION on a cluster in virtual time: two
# instances of one program in different tasks, global variables, RETAIN through a kill and through down and up, the
# recording verified; the uses of variables and what the PLC inhibits.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', there is '$2'"; }
cp -r "$2/ac-table" "$work/m"
rm -rf "$work/m/recordings"
sed -i "/gateway/d" "$work/m/machine.yaml"
# The programs get names of their own: only the configuration says which task runs them.
sed -i 's/^PROGRAM fast$/PROGRAM guards/' "$work/m/plc/fast.st"
sed -i 's/^PROGRAM main$/PROGRAM auxiliary/' "$work/m/plc/main.st"
rm "$work"/m/plc/*_test.st
cat > "$work/m/plc/machine.st" <<'END'
CONFIGURATION mill
VAR_GLOBAL sum : UDINT; END_VAR
RESOURCE plc ON PLC
  TASK quick(INTERVAL := T#1ms);
  TASK normal(INTERVAL := T#10ms, PRIORITY := 1);
  TASK slow(INTERVAL := T#50ms, PRIORITY := 2);
  PROGRAM guard WITH quick : guards;
  PROGRAM functions WITH normal : auxiliary;
  PROGRAM RETAIN often WITH normal : scans(moving := channel_running_0);
  PROGRAM seldom WITH slow : scans(moving := channel_running_0, n => sum);
END_RESOURCE
END_CONFIGURATION
PROGRAM scans
VAR_INPUT moving : BOOL; END_VAR
VAR_OUTPUT n : UDINT; END_VAR
VAR last : TIME; clock : TON; END_VAR
clock(IN := moving, PT := T#1h);
IF moving AND clock.ET <> last THEN n := n + 1; END_IF;
last := clock.ET;
END_PROGRAM
END
"$trunnion" plc check "$work"/m/plc/*.st "$work/m/plc/devices.yaml" > "$work/check" || fail "$(cat "$work/check")"
start_cluster "$work/m"
plc() { "$trunnion" plc "$@" --domain "$domain"; }
value() { plc watch "$1" --count 1 | sed 's/.* = //'; }
mdi() { "$trunnion" mdi "$1" --domain "$domain" > /dev/null; }

start_recording "$work/r.mcap" "$work/record"
mdi "T2 M6"
mdi "S1000 M3"
mdi "G53 G1 X200 F6000"  # 2 s and more of machine time
often=$(value often.n) seldom=$(value seldom.n)
[ "$often" -gt 100 ] || fail "the 10 ms instance ran $often times"
# Every scan of the 50 ms instance is one of five of the other; each motion may cut the first and the last interval.
[ $((seldom * 5)) -ge $((often - 30)) ] && [ $((seldom * 5)) -le $((often + 30)) ] || fail "10 ms: $often, 50 ms: $seldom scans"
is "the output of an instance" "$(value sum)" "$seldom"
is "the spindle, by the instance of the machine's logic" "$(value spindle_speed_0) $(value spindle_at_speed_0)" "1000 1/min TRUE"
"$python" -c 'import json, sys
tasks = {t["name"] for t in json.load(sys.stdin)}
assert {"fast", "main"} <= tasks, tasks' <<< "$(plc tasks --json)" || fail "$(plc tasks --json)"
# A channel that gets no processor for a while: the commands are sent again, and in the recording more than once.
pid_of() { "$trunnion" status --domain "$domain" --json | "$python" -c 'import json, sys
print(next(s["pid"] for s in json.load(sys.stdin)["services"] if s["service"] == sys.argv[1]))' "$1"; }
channel=$(pid_of channel)
kill -STOP "$channel"
"$trunnion" mdi "M5" --domain "$domain" > "$work/m5" 2>&1 &
command=$!
sleep 0.5
kill -CONT "$channel"
wait $command || fail "M5 of a channel that was stopped: $(cat "$work/m5")"

plc uses seldom.n > "$work/uses"
is "uses" "$(cat "$work/uses")" "$(printf 'machine.st:18:37: writes\nmachine.st:18:42: reads')"
is "uses by a connection of the configuration" "$(plc uses sum --json | "$python" -c 'import json, sys
print([(use["line"], use["column"], use["reads"], use["writes"]) for use in json.load(sys.stdin)])')" "[(10, 70, False, True)]"
! plc uses nothing.n > "$work/out" 2>&1 || fail "uses of nothing"
grep -qx "trunnion: 'nothing.n': there is no such variable or register" "$work/out" || fail "$(cat "$work/out")"

# The memory of the programs is kept whole through a kill, of one instance through a new start.
often=$(value often.n) seldom=$(value seldom.n)
pid=$(pid_of plc)
kill -INT $recorder
wait $recorder || true
for service in plc drive channel; do
  "$trunnion" verify --service $service --recording "$work/r.mcap" --machine "$work/m" > "$work/out" 2>&1 || fail "$(cat "$work/out")"
done
kill -KILL "$pid"
lists_variables() { plc variables often > "$work/out" 2> /dev/null; }
wait_until "the PLC answers after a kill" lists_variables
is "after a kill" "$(value often.n) $(value seldom.n)" "$often $seldom"

# What the PLC inhibits is in the status, with its reason.
plc force start_inhibit_0=TRUE
"$trunnion" status --domain "$domain" > "$work/status" || true
grep -A1 -x "inhibited by the PLC" "$work/status" | grep -qx "  channel 0: cycle start: the programs give no reason" ||
  fail "$(cat "$work/status")"
is "inhibits as JSON" "$("$trunnion" status --domain "$domain" --json | "$python" -c 'import json, sys
print(json.load(sys.stdin)["inhibits"])' || true)" "[{'channel': 0, 'start_inhibit': True, 'manual_inhibit': False, 'reason': ''}]"
plc force start_inhibit_0=FALSE
"$trunnion" status --domain "$domain" > "$work/status" || true
! grep -q "inhibited" "$work/status" || fail "$(cat "$work/status")"

stop_cluster
start_cluster "$work/m"
is "after a new start" "$(value often.n) $(value seldom.n)" "$often 0"
