#!/usr/bin/env bash
# golden.sh EXECUTABLE: runs a program on a machine with this stage and keeps the recording, or compares with the one that was kept.
# Remove recordings/golden.mcap when the stage is meant to compute something else.
set -euo pipefail
executable=$(realpath "$1")
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ ! -e recordings/golden.mcap ]; then
  mkdir -p recordings
  trunnion run "${MACHINE:-ac-table}" "${PROGRAM:-nas979_cone}" --exec @STAGE@="$executable" \
    --record recordings/golden.mcap --report "$work"
fi
trunnion verify --service @STAGE@ --exec "$executable" --recording recordings/golden.mcap
