#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# backup_commands.sh TRUNNION MACHINES: a backup brings a machine to a new computer, and nothing is written beside a cluster that runs.
set -euo pipefail
trunnion=$1
. "$(dirname "$0")/cluster.sh"
cp -rL "$2/two-channel" "$work/m"
sed -i '/service: gateway/d' "$work/m/machine.yaml"
rm -rf "$work/m/recordings"
cp -r "$work/m" "$work/kept"
mkdir "$work/m/recordings"
echo x > "$work/m/recordings/golden.mcap"
echo x > "$work/m/server.key"

start_cluster "$work/m"
"$trunnion" param set 100034 25000 --domain "$domain" > "$work/out"
"$trunnion" backup "$work/b.tar" --domain "$domain" > "$work/out" || fail "$(cat "$work/out")"
tar tf "$work/b.tar" > "$work/list"
grep -qx configuration/plc/main.st "$work/list" && grep -qx parameters.yaml "$work/list" || fail "$(cat "$work/list")"
! grep -q 'recordings\|server.key' "$work/list" || fail "$(cat "$work/list")"

# What is given with --domain is the cluster that runs: no other directory is written.
for command in "restore $work/b.tar" "state accept parameters.yaml"; do
  ! "$trunnion" $command --domain "$domain" --state "$work/other" > "$work/out" 2>&1 || fail "$command: $(cat "$work/out")"
  grep -q 'leave --domain out' "$work/out" || fail "$(cat "$work/out")"
done
! "$trunnion" state accept parameters.yaml --domain "$domain" > "$work/out" 2>&1 || fail "$(cat "$work/out")"
grep -q 'no cluster may use it' "$work/out" || fail "$(cat "$work/out")"
[ ! -e "$work/other" ] || fail "a state directory was made"
stop_cluster

# On the same computer the machine stays as it is, and what differs is named.
sed -i 's/^"100006": 400/"100006": 300/' "$work/m/parameters.yaml"
"$trunnion" restore "$work/b.tar" --machine "$work/m" --state "$work/state" > "$work/out" || fail "$(cat "$work/out")"
grep -q "^$work/m is not as in the backup" "$work/out" && grep -qx "  parameters.yaml" "$work/out" || fail "$(cat "$work/out")"
[ "$(grep -c '^  ' "$work/out")" -eq 1 ] || fail "$(cat "$work/out")"

# On a new one.
rm -rf "$work/m" "$work/state"
"$trunnion" restore "$work/b.tar" --state "$work/state" --configuration "$work/new" > "$work/out" || fail "$(cat "$work/out")"
diff -r "$work/kept" "$work/new" || fail "the machine differs"
! "$trunnion" restore "$work/b.tar" --state "$work/state" --configuration "$work/new" > "$work/out" 2>&1 || fail "$(cat "$work/out")"
grep -q "$work/new is there already" "$work/out" || fail "$(cat "$work/out")"
start_cluster "$work/new"
"$trunnion" param get 100034 --domain "$domain" | grep -q '= 25000' || fail "the saved value is lost"
