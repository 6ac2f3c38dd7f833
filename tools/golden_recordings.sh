#!/usr/bin/env bash
# tools/golden_recordings.sh BUILD [MACHINE...]: makes configs/machines/<machine>/recordings/golden.mcap anew for every machine
# (or those named) from the programs beside it, one for each channel in the order of their names, and verifies every service
# against what it has made. Run it whenever a change is meant to alter what the services compute or the contract they speak.
set -euo pipefail
build=$1
shift
root=$(cd "$(dirname "$0")/.." && pwd)
trunnion=$build/bin/trunnion
machines=("$@")
[ ${#machines[@]} -gt 0 ] || machines=($(ls "$root/configs/machines"))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for machine in "${machines[@]}"; do
  directory=$root/configs/machines/$machine/recordings
  [ -d "$directory" ] || continue
  # The order of messages of different writers in a recording is that of their time stamps; where two came too close to tell,
  # a service may not be verifiable against it, and another recording is made.
  for try in 1 2 3 4 5; do
    "$trunnion" run "$root/configs/machines/$machine" "$directory"/*.nc --record "$work/golden.mcap" --report "$work/report" > "$work/log" 2>&1 ||
      { cat "$work/log"; exit 1; }
    good=yes
    for service in parameters program plc kinematics compensation gantry drive; do
      timeout 60 "$trunnion" verify --service $service --recording "$work/golden.mcap" > "$work/log" || { good=no; break; }
    done
    channel=0
    for program in "$directory"/*.nc; do
      [ $good = yes ] || break
      timeout 60 "$trunnion" verify --service channel --channel $channel --recording "$work/golden.mcap" > "$work/log" || good=no
      channel=$((channel + 1))
    done
    [ $good = no ] || break
  done
  [ $good = yes ] || { cat "$work/log"; exit 1; }
  mv "$work/golden.mcap" "$directory/golden.mcap"
  echo "$machine: $(stat -c %s "$directory/golden.mcap") bytes, $channel channel(s)"
done
