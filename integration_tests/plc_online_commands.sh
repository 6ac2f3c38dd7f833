#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# plc_online_commands.sh TRUNNION MACHINES PYTHON: the commands plc variables, watch, force, trace and load on a cluster in
# virtual time, and the recording of all this verified.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', there is '$2'"; }
cp -r "$2/ac-table" "$work/m"
rm -rf "$work/m/recordings"
sed -i "/gateway/d" "$work/m/machine.yaml"
cat > "$work/m/plc/counter.st" <<'END'
FUNCTION_BLOCK Counter
VAR_INPUT step : UDINT; END_VAR
VAR_OUTPUT n : UDINT; END_VAR
VAR RETAIN hours : UDINT := 5; END_VAR
VAR timer : TON; END_VAR
n := n + step;
IF hours > 1000 THEN n := 0; END_IF;
timer(IN := coolant_0, PT := T#1h);
END_FUNCTION_BLOCK
END
sed -i 's/^  stop_latch AT %R0.0 : BOOL;/  stop_latch AT %R0.0 : BOOL;\n  counter : Counter;/; s/^feed_hold := feed_hold_button;/feed_hold := feed_hold_button;\nIF channel_running_0 THEN counter(step := 1); END_IF;/' "$work/m/plc/fast.st"
start_cluster "$work/m"
plc() { "$trunnion" plc "$@" --domain "$domain"; }
mdi() { "$trunnion" mdi "$1" --domain "$domain" > /dev/null; }
refused() {  # SENTENCE COMMAND...
  local sentence=$1
  shift
  ! plc "$@" > "$work/out" 2> "$work/error" || fail "$*: it works"
  [ "$(wc -l < "$work/error")" = 1 ] || fail "$*: $(cat "$work/error")"
  grep -qF -- "$sentence" "$work/error" || fail "$*: $(cat "$work/error")"
}

plc variables > "$work/variables"
grep -q '^    .timer$' "$work/variables" && grep -q '^      .ET : TIME$' "$work/variables" || fail "$(cat "$work/variables")"
plc variables fast.counter.h --json | grep -q '"path":"fast.counter.hours","type":"UDINT","retained":true' || fail "$(plc variables fast.counter.h --json)"
is watch "$(plc watch fast.counter.hours spindle_override_0 fast.counter.timer.PT --count 1)" \
  "fast.counter.hours = 5  spindle_override_0 = 100 %  fast.counter.timer.PT = T#0ms"
refused "'fast.none': there is no such variable" watch fast.none --count 1

plc force coolant_0=TRUE fast.counter.hours=9 --list > "$work/forces"
is forces "$(cat "$work/forces")" "$(printf '%%G2968.0 = TRUE\nfast.counter.hours = 9')"
await_alarm "2 of the PLC's values are forced"
mdi "M9"
is mark "$(plc watch coolant_0 fast.counter.hours --count 1)" "coolant_0 = TRUE (forced)  fast.counter.hours = 9 (forced)"
refused "'fast.counter.hours': 'x' is no UDINT: write a whole number 0 .. 4294967295" force fast.counter.hours=x
refused "'main.no_code': it is a constant" force main.no_code=1
pid=$("$trunnion" status --domain "$domain" --json | "$python" -c 'import json, sys
text = json.load(sys.stdin)
print(next(s["pid"] for s in text["services"] if s["service"] == "plc"))')
kill -KILL "$pid"
lists_forces() { plc force --list > "$work/forces" 2> /dev/null; }
wait_until "the PLC answers after a kill" lists_forces
is "forces after a kill" "$(wc -l < "$work/forces")" 2
plc force --release
is released "$(plc force --list)" "Nothing is forced"
"$trunnion" alarms --reset --domain "$domain" > /dev/null || true
"$trunnion" channel reset --domain "$domain" > /dev/null || true

plc tasks > "$work/tasks"
is "tasks" "$(awk '{print $1}' "$work/tasks" | xargs)" "task scan simulation fast main"
plc tasks --json | "$python" -c 'import json, sys
scan, simulation, fast, main = json.load(sys.stdin)
assert scan["budget_us"] == 1000 and 0 < scan["last_us"] <= scan["worst_us"], scan
assert scan["statements"] >= fast["statements"] > 0 and main["statement_budget"] == 200 and main["most_statements"] <= 200, main' ||
  fail "$(cat "$work/tasks")"

# From here on everything is recorded.
start_recording "$work/r.mcap" "$work/record"
mdi "G53 G1 X1 F3000"
plc force feed_hold=TRUE
! mdi "G53 G1 X2 F3000" 2> "$work/error" || fail "the axes move against the forced feed hold"
grep -q "Feed hold of the PLC" "$work/error" || fail "$(cat "$work/error")"
plc force --release feed_hold

# Every scan: the counter of the program rises by one from row to row.
n=$(plc watch fast.counter.n --count 1 | sed 's/.* = //')
"$trunnion" plc trace fast.counter.n coolant_0 --scans 300 --when "fast.counter.n>$((n + 20))" --output "$work/trace.csv" \
  --domain "$domain" > "$work/traced" 2>&1 &
trace=$!
# A second trace is refused while one is armed; this one would be in any case, for its path.
is_armed() { ! plc trace fast.none > "$work/out" 2>&1 && grep -q "another client traces" "$work/out"; }
wait_until "the trace is armed" is_armed
mdi "G53 G1 X30 F3000"
wait $trace || fail "the trace: $(cat "$work/traced")"
"$python" - "$work/trace.csv" "$n" <<'END' || fail "$(head -5 "$work/trace.csv")"
import csv, sys
rows = list(csv.reader(open(sys.argv[1])))
assert rows[0] == ["time_ms", "tick", "fast.counter.n", "coolant_0"]
n = [int(row[2]) for row in rows[1:]]
first = int(sys.argv[2]) + 21
assert n == list(range(first, first + 300)), n[:10]
END

# Programs with an error change nothing; others keep what can be kept, and are undone.
cp -r "$work/m/plc" "$work/next"
echo 'PROGRAM wrong lamp := 1; END_PROGRAM' > "$work/next/wrong.st"
! plc load "$work/next" > "$work/out" 2>&1 || fail "programs with an error run"
grep -q "^wrong.st:1:15: error: there is no variable 'lamp'" "$work/out" || fail "$(cat "$work/out")"
rm "$work/next/wrong.st"
sed -i 's/VAR timer : TON; END_VAR/VAR timer : TON; extra : INT; END_VAR/; s/^n := n + step;/n := n + step; extra := extra + 1;/' "$work/next/counter.st"
before=$(plc watch fast.counter.n --count 1)
plc load "$work/next" --dry-run > "$work/out"
is "dry run" "$(cat "$work/out")" "fast.counter.extra (INT) is new: it begins with its initial value"
plc programs | grep -q "machine's directory; 0 online changes" || fail "$(plc programs)"
plc load "$work/next" > "$work/out" || fail "$(cat "$work/out")"
grep -q "^The new programs run; .* 0 differences$" "$work/out" || fail "$(cat "$work/out")"
is "kept" "$(plc watch fast.counter.n --count 1)" "$before"
mdi "G53 G1 X20 F3000"
mdi "M8"
mdi "M9"
plc watch fast.counter.extra --count 1 | grep -q ' = [1-9]' || fail "the new program does not run"
sed -i 's/^ready_lamp := NOT stop_latch;/ready_lamp := stop_latch;/' "$work/next/fast.st"
! plc load "$work/next" > "$work/out" 2>&1 || fail "a difference is not found"
grep -q "register Y0: 1 and 0" "$work/out" || fail "$(cat "$work/out")"
plc load "$work/next" --accept-differences > /dev/null
is lamp "$(plc watch ready_lamp --count 1)" "ready_lamp = FALSE"
plc load --undo --accept-differences > /dev/null
is "lamp again" "$(plc watch ready_lamp --count 1)" "ready_lamp = TRUE"
mdi "G53 G1 X10 F3000"

end_recording "$work/record"
"$trunnion" verify --service plc --recording "$work/r.mcap" --machine "$work/m" > "$work/verify" 2>&1 || fail "$(cat "$work/verify")"
is "lines of the journal" "$("$python" -c 'import json, sys
print(*[json.loads(line)["what"] for line in open(sys.argv[1])])' "$work/state/plc.jsonl")" "force release force release load load load"
"$trunnion" state check --state "$work/state" > "$work/out" 2>&1 || fail "$(cat "$work/out")"
grep -q "plc.programs" "$work/out" || fail "$(cat "$work/out")"
stop_cluster

# The kept programs are damaged: the generation before runs, and says so; of nothing that can be read, the machine's own.
damage() { printf 'x' | dd of="$work/state/$1" bs=1 seek=40 conv=notrunc status=none; }
alarms() { "$trunnion" alarms --domain "$domain"; }
damage plc.programs
start_cluster "$work/m"
await_alarm "153.*plc.programs is damaged .*PLC programs that were loaded while it ran of generation"
plc programs | grep -q "loaded" || fail "$(plc programs)"
"$trunnion" alarms --reset --domain "$domain" > /dev/null
stop_cluster
start_cluster "$work/m"
! alarms | grep -q "plc.programs" || fail "it is still damaged: $(alarms)"
stop_cluster
damage plc.programs
damage plc.programs.previous
start_cluster "$work/m"
await_alarm "154.*plc.programs is damaged .*are lost"
plc programs | grep -q "machine's directory" || fail "$(plc programs)"
stop_cluster
