#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# recording_space.sh TRUNNION MACHINES: a recording on a small disk is refused, warns and ends as the space becomes less, its
# file is read up to its end, and what is said of it on the bus, over HTTP and by the command is true.
set -euo pipefail
trunnion=$1 machines=$2
if [ "${3:-}" != inside ]; then
  user=$((300000 + $$))
  isolated=(unshare --mount --user --map-user="$user" --map-group="$user" --keep-caps)
  if ! "${isolated[@]}" mount -t tmpfs tmpfs /mnt 2> /dev/null; then
    echo "skipped: this computer does not allow to mount a file system"
    exit 77
  fi
  exec "${isolated[@]}" bash "$0" "$trunnion" "$machines" inside
fi
. "$(dirname "$0")/cluster.sh"
trap 'stop_jobs; stop_cluster; umount "$work/disk" "$work/state/recordings" 2> /dev/null || true; rm -rf "$work"' EXIT
small_disk() { mkdir -p "$1" && mount -t tmpfs -o size=20m tmpfs "$1"; }
# leave DIRECTORY KIB: so much of its disk is free.
leave() {
  rm -f "$1/filling"
  local free
  free=$(df -k --output=avail "$1" | tail -1)
  # The recorder may fill the disk before it, which is what was asked for then.
  head -c $(((free - $2) * 1024)) /dev/zero > "$1/filling" 2> /dev/null || [ "$2" = 0 ]
}
no_alarm() { ! has_alarm "$1"; }
has_states() { "$trunnion" info "$1" > "$work/info" 2>&1 && grep -q channel_state "$work/info"; }
ended() { ! kill -0 "$recorder" 2> /dev/null; }
status_of() { local status=0; wait "$1" || status=$?; echo "$status"; }

cp -r "$machines/ac-table" "$work/machine"
echo "recording_free_space: 5" >> "$work/machine/machine.yaml"
small_disk "$work/disk"
small_disk "$work/state/recordings"
start_cluster "$work/machine"
api=http://127.0.0.1:$port/api/recordings
list() { curl -fsS "$api" > "$work/list"; }
listed() { list && grep -q -- "$1" "$work/list"; }
# post PATH: its answer in $work/answer, its status on the standard output.
post() { curl -sS -X POST -o "$work/answer" -w '%{http_code}' "$api$1"; }

# Refused, in one line with both sizes.
status=0
"$trunnion" record "$work/disk/day.mcap" --domain "$domain" > "$work/said" 2>&1 || status=$?
[ $status = 1 ] && [ "$(wc -l < "$work/said")" = 1 ] || fail "status $status: $(cat "$work/said")"
grep -Eq "$work/disk/day.mcap: (20|21)\.[0-9] MB are free on its disk, a recording needs 200\.0 MB: " "$work/said" ||
  fail "$(cat "$work/said")"
[ ! -e "$work/disk/day.mcap" ] || fail "a file is left"
leave "$work/state/recordings" 3000
[ "$(post '')" = 409 ] && grep -q "3.1 MB are free on its disk, a recording needs 5.0 MB" "$work/answer" ||
  fail "$(cat "$work/answer")"
rm "$work/state/recordings/filling"

# Low: a warning with the time left, which ends with its cause.
[ "$(curl -sS -X POST -o "$work/answer" -w '%{http_code}' -d '{"name": "run.mcap"}' "$api")" = 200 ] || fail "$(cat "$work/answer")"
leave "$work/state/recordings" 3000
await_alarm "161 .*MB are free: the recording ends in .* at .*/s; disk of .*/recordings/run.mcap"
listed '"recording": *"run.mcap"' || fail "it has ended: $(cat "$work/list")"
rm "$work/state/recordings/filling"
wait_until "the warning is over" no_alarm 161

# Full: the recording ends with a whole file, and nothing says that it went well.
leave "$work/state/recordings" 200
await_alarm "162 .*/recordings/run.mcap: the disk is full: [0-9]* kB are free, the last 500 kB are kept"
wait_until "the list states the end" listed '"problem": *"run.mcap: .*the disk is full'
grep -q '"recording": *""' "$work/list" || fail "$(cat "$work/list")"
[ "$(post /run.mcap/stop)" = 409 ] && grep -q "run.mcap has ended before it was stopped: .*the disk is full" "$work/answer" ||
  fail "$(cat "$work/answer")"
has_states "$work/state/recordings/run.mcap" && ! grep -q "cut off" "$work/info" || fail "$(cat "$work/info")"
rm "$work/state/recordings/filling"
reset_alarms

# A write error, without a watch: the same, and the file is read up to its last chunk.
start_recording "$work/disk/day.mcap" "$work/said" --free-space 0
wait_until "states are in the file" has_states "$work/disk/day.mcap"
leave "$work/disk" 0
wait_until "the recorder ends" ended
[ "$(status_of "$recorder")" = 1 ] || fail "status 0: $(cat "$work/said")"
grep -q "error: .*day.mcap: No space left on device; the file ends at byte " "$work/said" || fail "$(cat "$work/said")"
await_alarm "162 .*day.mcap: No space left on device"
has_states "$work/disk/day.mcap" && grep -q "cut off" "$work/info" || fail "$(cat "$work/info")"
reset_alarms
