#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# mdi_commands.sh TRUNNION MACHINES PYTHON: mdi and channel status. mdi on a machine of two channels prints where the axes of its own channel are, after
# its own line; errors are those of its own line.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
start_cluster "$2/two-channel"
for place in 1 2 3 4 5; do
  for channel in 0 1; do
    "$trunnion" mdi "G0 X$((10 * channel + place))" --channel "$channel" --json --domain "$domain" > "$work/json"
    "$python" - "$work/json" "$channel" "$((10 * channel + place))" <<'END' || fail "$(cat "$work/json")"
import json, sys
state, channel, place = json.load(open(sys.argv[1])), int(sys.argv[2]), float(sys.argv[3])
assert state["channel"] == channel, (state["channel"], channel)
assert abs(state["workpiece"][state["letters"].index("X")] - place) < 1e-3, (state["workpiece"], place)
END
  done
done

# The status of a channel: once as JSON and as text, then live.
"$trunnion" channel status --channel 1 --json --domain "$domain" > "$work/json"
"$trunnion" alarms --json --domain "$domain" > "$work/alarms"
"$python" - "$work/json" "$work/alarms" <<'END' || fail "$(cat "$work/json")"
import json, sys
status, alarms = (json.load(open(path)) for path in sys.argv[1:])
axes = {axis["axis"]: axis for axis in status["axes"]}
assert (status["channel"], status["mode"], status["state"]) == (1, "MDI", "IDLE"), status
assert status["connected"] and status["feed_override"] == 1 and status["alarms"] == len(alarms), (status, alarms)
assert abs(axes["X"]["workpiece"] - 15) < 1e-3 and axes["X"]["unit"] == "mm", axes
END
"$trunnion" channel status --channel 1 --domain "$domain" > "$work/said"
grep -Eq '^X  machine .* workpiece .* to go .* mm$' "$work/said" || fail "$(cat "$work/said")"
"$trunnion" channel status --watch --channel 1 --domain "$domain" > "$work/live" &
watcher=$!
shows() { grep -q "$1" "$work/live"; }
wait_until "the live status has a first line" shows '"channel":1'
"$trunnion" mdi "G0 X16" --channel 1 --domain "$domain" > "$work/said"
shows_place() { "$python" -c 'import json, sys
for line in open(sys.argv[1]).read().splitlines()[-1:]:
  place = {axis["axis"]: axis["workpiece"] for axis in json.loads(line)["axes"]}["X"]
  sys.exit(abs(place - 16) > 1e-3)' "$work/live"; }
wait_until "the live status has X16" shows_place
kill "$watcher"
wait "$watcher" || fail "the live status ends with $?"
if "$trunnion" channel hold --watch --domain "$domain" 2> "$work/said"; then fail "--watch is taken by a command"; fi
grep -q -- '--watch is an option of status' "$work/said" || fail "$(cat "$work/said")"

if "$trunnion" mdi "G0 X1000" --channel 1 --domain "$domain" 2> "$work/said"; then fail "a line beyond the travel is executed"; fi
grep -q 'X would go to 990.0000.*alarm 140' "$work/said" || fail "$(cat "$work/said")"
# A message of the program is no failure of the line.
"$trunnion" mdi "#3006=7 (CLAMP IT)" --domain "$domain" > "$work/message" 2>&1 &
line=$!
await_alarm ' 151 '
"$trunnion" channel start --take-right --domain "$domain"
wait "$line" || fail "$(cat "$work/message")"

# A line that repeats for ever is shown, does not keep the other channel from moving, ends by reset, and blames nobody.
if "$trunnion" mdi "M99" --timeout 3 --domain "$domain" 2> "$work/said"; then fail "a line without an end ends"; fi
grep -q 'within 3 s: line 1: .* lines were read without a motion; reset ends it' "$work/said" || fail "$(cat "$work/said")"
"$trunnion" mdi "G0 X19" --channel 1 --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
"$trunnion" channel reset --domain "$domain"
"$trunnion" mdi "G0 X3" --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
"$trunnion" alarms --domain "$domain" > "$work/alarms"
if grep -q ' 172 ' "$work/alarms"; then fail "$(cat "$work/alarms")"; fi

# An alarm that is shown already is not the line's, and one that comes again is.
printf 'G1 X4 F1000\nGOTO 99\nM30\n' > "$work/label.nc"
"$trunnion" program put "$work/label.nc" --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
"$trunnion" channel mode auto --domain "$domain"
run_to_end label.nc
await_alarm 'label.nc:2'
"$trunnion" mdi "G0 X5" --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
"$trunnion" channel mode auto --domain "$domain"
printf 'GOTO 3\nG1 X4 F1000\nN3 M30\n' > "$work/jump.nc"
"$trunnion" program put "$work/jump.nc" --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
select_program jump.nc
for attempt in 1 2; do
  if "$trunnion" channel start --from-line 2 --domain "$domain" 2> "$work/said"; then fail "a line that is not reached is found"; fi
  grep -q 'alarm 170: .*without reaching this line' "$work/said" || fail "$attempt: $(cat "$work/said")"
done

# What a search has announced is over when the program starts.
printf 'G1 X4 F1000\nX5\nM30\n' > "$work/line.nc"
"$trunnion" program put "$work/line.nc" --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
select_program line.nc
"$trunnion" channel start --from-line 2 --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
await_alarm ' 171 '
"$trunnion" channel start --domain "$domain"
await_idle
"$trunnion" alarms --domain "$domain" > "$work/alarms"
if grep -q ' 171 ' "$work/alarms"; then fail "$(cat "$work/alarms")"; fi

# A listener ends with the reader of its output, also when nothing is published any more.
topic=("$trunnion" topic echo cluster --json --domain "$domain")
status=0
timeout 60 bash -c '"$@" | head -n 1; exit "${PIPESTATUS[0]}"' listener "${topic[@]}" > "$work/said" || status=$?
[ $status = 141 ] || fail "the listener ended with $status, not with 141 (SIGPIPE): $(cat "$work/said")"
