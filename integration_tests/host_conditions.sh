#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# host_conditions.sh TRUNNION JUMPING_CLOCK: a program gives the same setpoints and loses nothing on a computer whose wall clock
# jumps, whose language is German, that allows few files, whose disk is full, and whose disk cannot be written.
set -euo pipefail
trunnion=$1 jumping_clock=$2
if [ "${3:-}" != inside ]; then
  user=$((300000 + $$))
  isolated=(unshare --net --mount --pid --fork --kill-child --mount-proc --user --map-user="$user" --map-group="$user")
  isolated+=(--keep-caps)
  "${isolated[@]}" true 2> /dev/null || exit 77  # the computer allows no namespaces
  exec "${isolated[@]}" bash "$0" "$trunnion" "$jumping_clock" inside
fi
ip link set lo up
work=$(mktemp -d)
trap 'cd /; "$trunnion" down > /dev/null 2>&1 || true; umount "$work/disk" 2> /dev/null || true; rm -rf "$work"' EXIT
export HOME=$work/home XDG_STATE_HOME=$work/disk
mkdir -p "$HOME" "$work/disk"
fail() { echo "$*"; cat "$work/said"; exit 1; }

# The setpoints of the cone, as one number.
cone() {
  "$@" "$trunnion" run ac-table nas979_cone --report "$work/report" > "$work/said" 2>&1 || fail "$*: the run failed"
  sed -n 's/.*Drive commands, FNV-1a *//p' "$work/said"
}
expected=$(cone env)
[ -n "$expected" ] || fail "the report has no hash"

[ "$(cone env LD_PRELOAD="$jumping_clock")" = "$expected" ] || fail "other setpoints with a clock that jumps"
# Within 1.4 s the clock has been ahead and back, for each process at another instant.
end=$((SECONDS + 60))
until [ -s "$work/one" ] && [ $(($(sort -n "$work/one" | tail -1) - $(sort -n "$work/one" | head -1))) -gt 3000 ]; do
  [ "$SECONDS" -lt "$end" ] || fail "the clock did not jump: $(cat "$work/one")"
  env LD_PRELOAD="$jumping_clock" date +%s >> "$work/one"
done

localedef -i de_DE -f UTF-8 "$work/de_DE.UTF-8"
[ "$(env LOCPATH="$work" LC_ALL=de_DE.UTF-8 printf %.1f 1,5)" = 1,5 ] || fail "the German locale does not work"
[ "$(cone env LOCPATH="$work" LC_ALL=de_DE.UTF-8)" = "$expected" ] || fail "other setpoints in a German environment"

few_files() { (ulimit -n 64 && "$@"); }
[ "$(cone few_files)" = "$expected" ] || fail "other setpoints with 64 files"

# A disk that fills up, is freed, is full when the machine is switched off and on, and is mounted read-only.
mount -t tmpfs -o size=4m,mode=0700,uid="$(id -u)",gid="$(id -g)" tmpfs "$work/disk"
fill() { dd if=/dev/zero of="$work/disk/filling" bs=1k 2> /dev/null || true; }
does() { "$trunnion" "$@" > "$work/said" 2>&1 || fail "$*: refused"; }
refused() { # TEXT COMMAND...
  local text=$1
  shift
  ! "$trunnion" "$@" > "$work/said" 2>&1 || fail "$*: accepted"
  grep -q "$text" "$work/said" || fail "$*: does not say '$text'"
  [ "$(wc -l < "$work/said")" = 1 ] || fail "$*: more than one line"
}
rapid() { "$trunnion" param get 100034 > "$work/said" 2>&1 || fail "param get"; grep -o '[0-9.]* mm/min' "$work/said" | head -1; }

printf 'G21 G90 G54\nG0 X5\n#500=5\nG0 X-5\nM30\n' > "$work/part.nc"
printf 'G0 X7\nM30\n' > "$work/other.nc"
does up ac-table --time virtual
does program put "$work/part.nc"
does param set 100034 21000
fill
refused "No space left on device" program put "$work/other.nc"
refused "No space left on device" param set 100034 22000
rm "$work/disk/filling"
does program put "$work/other.nc"
does param set 100034 23000
does channel reset
does alarms
fill
does down
# Nothing but the start itself is to be stored.
fill
does up ac-table --time virtual
[ "$(rapid)" = "23000 mm/min" ] || [ "$(rapid)" = "23000.0 mm/min" ] || fail "the parameter is lost on a full disk"
fill
refused "No space left on device" param set 100034 24000
does down
rm "$work/disk/filling"
does up ac-table --time virtual
[ "$(rapid)" = "23000 mm/min" ] || [ "$(rapid)" = "23000.0 mm/min" ] || fail "the parameter is lost"
does program get part.nc "$work/again.nc"
cmp "$work/part.nc" "$work/again.nc"
does program get other.nc "$work/again.nc"
does down
mount -o remount,ro "$work/disk"
refused "Read-only file system" up ac-table --time virtual
[ ! -e "/tmp/trunnion-$(id -u)" ] || fail "the run directory is left"
