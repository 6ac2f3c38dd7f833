#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# recording_commands.sh BIN MACHINES DOMAIN: the commands for recordings on the golden ones, as a user calls them.
set -euo pipefail
trunnion=$1/trunnion
golden=$2/gantry-cb-head/recordings/golden.mcap
work=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null || true; rm -rf "$work"' EXIT
fail() { echo "$1"; exit 1; }

# What is replayed and recorded again is the same, every message of it, with another compression of the file.
"$1/trunnion-recorder" --output "$work/again.mcap" --machine gantry-cb-head --domain "$3" --duration 300 --compression none > "$work/log" &
recorder=$!
"$trunnion" replay "$golden" --domain "$3" --wait --linger 5 > "$work/replay"
kill -TERM $recorder
wait $recorder || fail "the recorder lost something: $(cat "$work/log")"
"$trunnion" diff "$golden" "$work/again.mcap" > "$work/diff" || fail "$(cat "$work/diff")"

compressions() { "$trunnion" info "$1" | awk '$1 == "chunks" {print $NF}'; }
compressions "$golden" | grep -q zstd && [ "$(compressions "$work/again.mcap")" = none ] || fail "$(compressions "$work/again.mcap")"

# A recording is not replaced by another, unless that is wanted.
status=0
said=$("$trunnion" record "$work/again.mcap" --domain "$3" 2>&1) || status=$?
[ $status = 1 ] &&
  [ "$said" = "trunnion: $work/again.mcap: it exists already: choose another name, or replace it with --force" ] || fail "$said"
"$trunnion" diff "$golden" "$work/again.mcap" > "$work/diff" || fail "$(cat "$work/diff")"

# Messages but those of the recorders themselves.
messages() {
  "$trunnion" info "$1" > "$work/info"
  awk '/^topic /{rows = 1; next} NF == 0{rows = 0} rows && $1 !~ /snapshot/ {sum += $2} END{print sum}' "$work/info"
}
[ "$(messages "$golden")" -gt 800 ] || fail "the recording has hardly any message"
[ "$(messages "$golden")" = "$(messages "$work/again.mcap")" ] || fail "another number of messages"

# Recordings that differ are a status of 1 and the first difference.
status=0
"$trunnion" diff "$golden" "$2/ac-table/recordings/golden.mcap" > "$work/diff" || status=$?
[ $status = 1 ] && grep -q "^first difference: " "$work/diff" || fail "two machines are not the same"

# A line for every cycle and the header.
cycles=$("$trunnion" info "$golden" | awk '$1 == "feedback" && $2 == 0 {print $5}')
[ "$("$trunnion" export "$golden" --csv feedback | wc -l)" = $((cycles + 1)) ] || fail "not a line for every cycle"

# What is cut off is read, and said to be; what is no recording is one line.
head -c $(($(stat -c %s "$golden") - 30000)) "$golden" > "$work/cut.mcap"
"$trunnion" info "$work/cut.mcap" > "$work/info"
grep -q "^cut off " "$work/info" || fail "a file that is cut off"
echo nonsense > "$work/nonsense.mcap"
status=0
said=$("$trunnion" info "$work/nonsense.mcap" 2>&1) || status=$?
[ $status = 1 ] && [ "$said" = "trunnion: $work/nonsense.mcap: not an MCAP file: the magic bytes are missing" ] || fail "$said"

# One wrong byte: what is behind its chunk is read, what is missing is named, and nothing is verified or measured with it.
whole=$2/ac-table/recordings/golden.mcap
cp "$whole" "$work/damaged.mcap"
at=250000
printf '%b' "$(printf '\\x%02x' $(($(od -An -tu1 -j $at -N1 "$whole") ^ 1)))" |
  dd of="$work/damaged.mcap" bs=1 seek=$at conv=notrunc 2> /dev/null
named='bytes [0-9]* to [0-9]*, messages of .*Z to .*Z: the chunk '
"$trunnion" info "$work/damaged.mcap" > "$work/info"
grep -q "^damaged    $named" "$work/info" || fail "$(cat "$work/info")"
last() { "$trunnion" export "$1" --csv feedback 2> "$work/said" | tail -1; }
[ "$(last "$whole")" = "$(last "$work/damaged.mcap")" ] || fail "nothing is read behind the damage"
grep -q "$work/damaged.mcap: warning: damaged, $named" "$work/said" || fail "export: $(cat "$work/said")"
# refuses COMMAND...: with status 1, and names what is missing.
refuses() {
  status=0
  "$trunnion" "$@" > "$work/said" 2>&1 || status=$?
  [ $status = 1 ] && grep -q "damaged, $named" "$work/said" || fail "$*: status $status, $(cat "$work/said")"
}
refuses diff "$whole" "$work/damaged.mcap"
refuses verify --service kinematics --recording "$work/damaged.mcap" --machine "$2/ac-table"
refuses measure circle --recording "$work/damaged.mcap" --source encoder
printf 'tests:\n  - {recording: damaged.mcap, services: [kinematics], machine: %s}\n' "$2/ac-table" > "$work/suite.yaml"
refuses test "$work/suite.yaml"
"$trunnion" replay "$work/damaged.mcap" --only alarm --rate 1000 --domain "$3" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
grep -q "warning: damaged, $named" "$work/said" || fail "replay: $(cat "$work/said")"
