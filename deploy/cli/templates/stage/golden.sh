#!/usr/bin/env bash
# golden.sh EXECUTABLE: runs the program on a machine with this stage and keeps the recording, or compares with the one that was kept.
# Delete recordings/golden.mcap when the stage is meant to compute something else.
set -euo pipefail
cd "$(dirname "$0")"
executable=$(realpath "$1")
machine=${MACHINE:-ac-table} program=${PROGRAM:-nas979_cone}
work=$(mktemp -d)
domain=
trap '[ -z "$domain" ] || trunnion down --domain "$domain" > /dev/null; rm -rf "$work"' EXIT

if [ ! -e recordings/golden.mcap ]; then
  mkdir -p recordings
  # A copy of the machine that allows this executable.
  directory=$(trunnion check --machine-directory "$machine")
  cp -r "$directory" "$work/machine"
  echo "swap_directories: [$(dirname "$executable")]" >> "$work/machine/machine.yaml"
  for number in 95 96 97 98 99; do
    trunnion up "$work/machine" --time virtual --state "$work/state" --domain $number --port $((20000 + $$ % 20000)) > "$work/up" 2>&1 &&
      domain=$number && break
  done
  [ -n "$domain" ] || { cat "$work/up"; exit 1; }
  trunnion swap @STAGE@ --exec "$executable" --domain "$domain"
  trunnion record recordings/golden.mcap --domain "$domain" > "$work/record" &
  recorder=$!
  until grep -q recording "$work/record"; do sleep 0.1; done
  trunnion channel mode auto --domain "$domain"
  trunnion channel select "$program" --domain "$domain"
  trunnion channel start --domain "$domain"
  trunnion channel wait --domain "$domain"
  kill -INT $recorder
  wait $recorder
fi
sed "s#build/@NAME@#$executable#" suite.yaml > suite-here.yaml
trunnion test suite-here.yaml
