#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tools/golden_recordings.sh BUILD [MACHINE...]: makes configs/machines/<machine>/recordings/golden.mcap for every machine
# (or those named) from the programs beside it, one for each channel in the order of their names, and verifies every
# service with the result. tools/golden_operator.py stores, selects and starts the programs over HTTP, as an operator
# does. Run it after a change that is meant to alter what the services compute, or their contract.
set -euo pipefail
build=$1
shift
root=$(cd "$(dirname "$0")/.." && pwd)
trunnion=$build/bin/trunnion
domain=${GOLDEN_DOMAIN:-76}
port=${GOLDEN_PORT:-18476}
services=$(sed -n '/^services:/,/^observers:/{/per_channel/d;/not_verified/d;s/.*{name: \([a-z]*\).*/\1/p}' "$root/libs/machine/machine/services.yaml")
machines=("$@")
[ ${#machines[@]} -gt 0 ] || machines=($(grep -L '^hardware: hal' "$root"/configs/machines/*/machine.yaml | xargs -n1 dirname | xargs -n1 basename))
work=$(mktemp -d)
recorder=
finish() {
  [ -z "$recorder" ] || kill "$recorder" 2> /dev/null || true
  "$trunnion" down --domain "$domain" > /dev/null 2>&1 || true
  rm -rf "$work"
}
trap finish EXIT

record() {  # MACHINE PROGRAM...: writes $work/golden.mcap
  local machine=$1
  shift
  rm -rf "$work/state" "$work/golden.mcap"
  mkdir "$work/state"
  "$trunnion" up "$root/configs/machines/$machine" --time virtual --domain "$domain" --port "$port" --state "$work/state" > "$work/log" 2>&1 || return 1
  : > "$work/recorder"  # which the recorder before has written, and the shell empties in the background
  "$build/bin/trunnion-recorder" --output "$work/golden.mcap" --machine "$machine" --domain "$domain" --parent-bound > "$work/recorder" 2>&1 &
  recorder=$!
  for _ in $(seq 200); do
    ! grep -q '^recording' "$work/recorder" || break
    sleep 0.05
  done
  local good=0
  /usr/bin/python3 "$root/tools/golden_operator.py" "$port" "$@" > "$work/log" 2>&1 || good=1
  kill "$recorder"
  wait "$recorder" || true
  recorder=
  "$trunnion" down --domain "$domain" > /dev/null
  return $good
}

verify() {  # SERVICE [CHANNEL]
  timeout 60 "$trunnion" verify --service "$1" --channel "${2:-0}" --recording "$work/golden.mcap" > "$work/log" 2>&1
}

# The lines of the operator journal count from 1: none is missing.
is_journal_whole() {
  "$trunnion" export "$work/golden.mcap" --csv operator_request 2> "$work/log" |
    awk -F, '/^[0-9]+,[0-9]+,[A-Z_]+,/ { ++lines; last = $2 } END { exit !(lines > 0 && lines == last) }'
}

verify_all() {  # CHANNELS
  local service channel
  is_journal_whole || { echo "lines of the operator journal are missing" >> "$work/log"; return 1; }
  for service in $services; do verify "$service" || return 1; done
  for ((channel = 0; channel < $1; ++channel)); do verify channel "$channel" || return 1; done
}

for machine in "${machines[@]}"; do
  directory=$root/configs/machines/$machine/recordings
  [ -d "$directory" ] || continue
  programs=("$directory"/*.nc)
  # The order of messages of different writers in a recording is that of their time stamps; where two came too close to tell,
  # a service may not be verifiable against it, and another recording is made.
  for try in 1 2 3 4 5; do
    good=no
    record "$machine" "${programs[@]}" || { cat "$work/log"; exit 1; }
    ! verify_all ${#programs[@]} || good=yes
    [ $good = no ] || break
    echo "$machine, try $try:"
    cat "$work/log"
  done
  [ $good = yes ] || exit 1
  mv "$work/golden.mcap" "$directory/golden.mcap"
  echo "$machine: $(stat -c %s "$directory/golden.mcap") bytes, ${#programs[@]} channel(s)"
done
