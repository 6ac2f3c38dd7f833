#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# old_releases.sh TRUNNION PYTHON: what releases before this one have left (old_releases/README.md) is read, or refused in
# one line that names the version and what to do.
set -euo pipefail
trunnion=$1 python=$2
old=$(dirname "$0")/old_releases/0.3.0
. "$(dirname "$0")/cluster.sh"
cp -r "$old/machine" "$work/machine"
refused() { # TEXT COMMAND...: status 1 and this in the one line
  local text=$1 status=0
  shift
  "$trunnion" "$@" > "$work/out" 2> "$work/said" || status=$?
  [ $status = 1 ] && grep -qF -- "$text" "$work/said" && [ "$(wc -l < "$work/said")" = 1 ] ||
    fail "$*: status $status, $(cat "$work/out" "$work/said")"
}
# kept FILE: its last line has format and checksum now.
kept() { tail -n 1 "$work/state/$1" | grep -q '^# trunnion-state .*format=1' || fail "$1: $(tail -n 1 "$work/state/$1")"; }

echo "A backup of format 1 with a state of format 0"
"$python" - "$old/state" "$work/backup.tar" <<'END'
import io, json, pathlib, sys, tarfile, zlib
state, names = pathlib.Path(sys.argv[1]), []
members = {str(path.relative_to(state)): path.read_bytes() for path in sorted(state.rglob("*")) if path.is_file()}
manifest = {"format": 1, "machine": "four-axis", "version": "0.3.0", "time": "2026-11-22T15:44:00Z",
            "files": [{"name": name, "size": len(data), "crc32": zlib.crc32(data)} for name, data in members.items()]}
text = (json.dumps(manifest) + "\n# trunnion-state format=1 file=MANIFEST.json generation=1 crc32=").encode()
text += b"%08x\n" % zlib.crc32(text)
with tarfile.open(sys.argv[2], "w") as archive:
    for name, data in {"MANIFEST.json": text, **members}.items():
        entry = tarfile.TarInfo(name)
        entry.size = len(data)
        archive.addfile(entry, io.BytesIO(data))
END
refused 'is of version 0.3.0 and has no files of the machine'"'"'s directory: copy them from the old computer' \
  restore "$work/backup.tar" --state "$work/state" --configuration "$work/new"
"$trunnion" restore "$work/backup.tar" --machine "$work/machine" --state "$work/state" > "$work/out" || fail "$(cat "$work/out")"
grep -q 'version 0.3.0' "$work/out" || fail "$(cat "$work/out")"
diff -r "$old/state" "$work/state" || fail "the state differs"
"$trunnion" state check --state "$work/state" > "$work/out" || fail "$(cat "$work/out")"

echo "The state of the older release is used"
start_cluster "$work/machine"
# Its texts have no checksums, so that nothing may be taken for damage (alarms 153, 154).
await_alarm 'Program part.nc was in line 2 when the control was switched off: it can be started from there'
! grep -qE '^ *15[0-9] ' "$work/alarms" || fail "$(cat "$work/alarms")"
"$trunnion" param get 100034 --domain "$domain" | grep -q '= 21000' || fail "parameter"
is_published() { "$trunnion" topic echo "$1" --count 1 --timeout 5 --json --domain "$domain" > "$work/topic" 2>&1 && grep -qF -- "$2" "$work/topic"; }
wait_until "tool 7 is there" is_published tool_table '"length":42.125'
wait_until "G54 is there" is_published work_offsets '-2.25'
"$trunnion" program get part.nc "$work/part.nc" --domain "$domain" > "$work/out"
cmp "$old/state/programs/part.nc" "$work/part.nc" || fail "the program differs"
"$trunnion" program list --domain "$domain" > "$work/out"
! grep -q rtcp.nc "$work/out" || fail "a program that was deleted is back"
"$trunnion" mdi "#501=#500*2" --domain "$domain" > "$work/out" 2>&1 || fail "$(cat "$work/out")"
is_doubled() { [ "$("$trunnion" variables 501 --domain "$domain")" = "#501 5" ]; }
wait_until "#500 is kept" is_doubled
"$trunnion" mdi "G0 X10 Y5" --domain "$domain" > "$work/out" 2>&1 || fail "the PLC of that release: $(cat "$work/out")"

echo "What changes is written in the format of today, and read again"
"$trunnion" param set 100034 22000 --domain "$domain" > "$work/out"
stop_cluster
for file in parameters.yaml active.yaml channel-0.variables; do kept "$file"; done
"$trunnion" state check --state "$work/state" > "$work/out" || fail "$(cat "$work/out")"
start_cluster "$work/machine"
"$trunnion" param get 100034 --domain "$domain" | grep -q '= 22000' || fail "parameter"
wait_until "tool 7 is there" is_published tool_table '"length":42.125'
stop_cluster

echo "A recording with another contract"
"$trunnion" info "$old/four-axis.mcap" > "$work/out" || fail "$(cat "$work/out")"
grep -q '^version  *0.3.0' "$work/out" && grep -q '^contract  *bc8bff3798cc3d5a' "$work/out" || fail "$(cat "$work/out")"
for service in parameters program plc drive gantry compensation kinematics channel gateway; do
  refused "is of version 0.3.0, contract bc8bff3798cc3d5a: service $service uses " \
    verify --service "$service" --recording "$old/four-axis.mcap" --machine "$work/machine"
  grep -q 'verify it with the services of that version' "$work/said" || fail "$(cat "$work/said")"
done
