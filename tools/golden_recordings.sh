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
  "$trunnion" run "$root/configs/machines/$machine" "$directory"/*.nc --record "$work/golden.mcap" --report "$work/report" > "$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
  programs=("$directory"/*.nc)
  for service in parameters program plc drive gantry compensation kinematics; do
    # Two channels' requests and the drive's ticks reach the PLC in an order that no message tells.
    [ $service != plc ] || [ ${#programs[@]} -eq 1 ] || continue
    timeout 60 "$trunnion" verify --service $service --recording "$work/golden.mcap" > "$work/log" || { cat "$work/log"; exit 1; }
  done
  channel=0
  for program in "$directory"/*.nc; do
    timeout 60 "$trunnion" verify --service channel --channel $channel --recording "$work/golden.mcap" > "$work/log" || { cat "$work/log"; exit 1; }
    channel=$((channel + 1))
  done
  mv "$work/golden.mcap" "$directory/golden.mcap"
  echo "$machine: $(stat -c %s "$directory/golden.mcap") bytes, $channel channel(s)"
done
