#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# systemd_instance.sh DIRECTORY SCRIPT [ARGUMENT...]: runs a script beside a systemd of its own (a user instance), which has
# processes, /run and control groups for itself; the units are those of DIRECTORY/config/systemd/user. Ends with 77 and one
# line where this computer does not let it.
set -euo pipefail
directory=$1
shift
cannot() { echo "$*"; exit 77; }

if [ "${TRUNNION_INSIDE:-}" = 1 ]; then
  mount -t tmpfs tmpfs /run
  mkdir -p /run/systemd/system /run/user/0/systemd # the first is how a systemd knows that the computer has one
  export XDG_RUNTIME_DIR=/run/user/0 XDG_CONFIG_HOME=$directory/config HOME=$directory
  /lib/systemd/systemd --user --unit=basic.target >/dev/null 2>&1 &
  for _ in $(seq 1200); do
    systemctl --user list-units >/dev/null 2>&1 && break
    kill -0 $! 2>/dev/null || cannot "systemd does not start as a user's here"
    sleep 0.05
  done
  systemctl --user list-units >/dev/null || { echo "systemd does not answer within a minute"; exit 1; }
  status=0
  bash "$@" || status=$?
  systemctl --user exit
  wait $! || true
  exit "$status"
fi

[ "$(id -u)" -eq 0 ] || cannot "needs root for a systemd of its own"
[ -x /lib/systemd/systemd ] && command -v systemctl >/dev/null || cannot "there is no systemd on this computer"
unshare --mount --pid --fork --mount-proc true 2>/dev/null || cannot "there are no namespaces for a systemd of its own"
groups=()
clear_up() {
  for group in "${groups[@]}"; do find "$group" -depth -type d -exec rmdir {} + 2>/dev/null || true; done
}
trap clear_up EXIT
# The hierarchies that systemd uses: the unified one, or its named one and perhaps the unified one beside it.
for hierarchy in /sys/fs/cgroup /sys/fs/cgroup/systemd /sys/fs/cgroup/unified; do
  [ -e "$hierarchy/cgroup.procs" ] || continue
  mkdir "$hierarchy/trunnion-$$" 2>/dev/null || cannot "nobody may make a control group in $hierarchy"
  groups+=("$hierarchy/trunnion-$$")
done
[ ${#groups[@]} -gt 0 ] || cannot "there are no control groups for a systemd of its own"
status=0
(
  for group in "${groups[@]}"; do echo "$BASHPID" >"$group/cgroup.procs" || exit 77; done
  TRUNNION_INSIDE=1 exec unshare --mount --pid --fork --kill-child --mount-proc "$0" "$directory" "$@"
) || status=$?
exit "$status"
