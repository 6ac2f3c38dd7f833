#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# verify_golden.sh TRUNNION RECORDING CHANNELS: every service of the machine alone against the recording, all at once, each in a
# domain of its own.
set -uo pipefail
trunnion=$1
recording=$2
channels=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
start() {  # SERVICE CHANNEL
  "$trunnion" verify --service "$1" --channel "$2" --recording "$recording" --timeout 20 > "$work/$1.$2" 2>&1 &
  names+=("$1.$2")
  pids+=($!)
}
names=()
pids=()
registry=$(dirname "$0")/../libs/machine/services.yaml
services=$(sed -n '/^services:/,/^observers:/{/per_channel/d;s/.*{name: \([a-z]*\).*/\1/p}' "$registry")
for service in $services; do start "$service" 0; done
for ((channel = 0; channel < channels; ++channel)); do start channel "$channel"; done
failed=0
for i in "${!pids[@]}"; do
  wait "${pids[$i]}" || failed=1
  cat "$work/${names[$i]}"
done
exit $failed
