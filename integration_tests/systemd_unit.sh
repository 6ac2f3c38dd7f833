#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# systemd_unit.sh TRUNNION DOMAIN: takes trunnion@ac-table through start, hang and stop, and says what systemd made of it.
trunnion=$1
domain=$2
unit=trunnion@ac-table
show() { systemctl --user show "$unit" --value -p "$1"; }
clock() { date +%s%3N; }
cluster() { "$trunnion" status --domain "$domain" >/dev/null 2>&1 && echo ready || echo lost; }

systemctl --user start "$unit" # of Type=notify it returns when the unit has said READY=1
echo "started $? $(show ActiveState) $(cluster) $(show NRestarts)"
first=$(show MainPID)
[ "$first" -gt 0 ] || { journalctl --user -n 20 2>/dev/null; exit 1; } # process 0 would be this script
kill -STOP "$first"
hung=$(clock)
for _ in $(seq 1200); do
  [ "$(show NRestarts)" = 1 ] && [ "$(show ActiveState)" = active ] && break
  sleep 0.05
done
echo "hung $(show ActiveState) $(cluster) $(show NRestarts) $([ "$(show MainPID)" != "$first" ] && echo another || echo same)"
echo "milliseconds $(($(clock) - hung))"
systemctl --user stop "$unit"
echo "stopped $? $(show ActiveState) $(show Result) $(pgrep -c '^trunnion')"
