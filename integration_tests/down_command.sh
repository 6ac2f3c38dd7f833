#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# down_command.sh TRUNNION MACHINES PYTHON: which cluster `trunnion down` stops: without a name that of its own session, another one
# only after a question or by its name, which is also found while another cluster begins to start.
[ -n "${in_own_session:-}" ] || exec env in_own_session=1 setsid --wait "$0" "$@"
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
cp -rL "$2/two-channel" "$work/m"
sed -i '/service: gateway/d' "$work/m/machine.yaml"
runs=/tmp/trunnion-$(id -u)
runs_still() { "$trunnion" status --domain "$domain" > "$work/out" 2>&1 || fail "$* has stopped it: $(cat "$work/out")"; }

# Of another session, without a terminal.
start_cluster "$work/m"
! setsid --wait "$trunnion" down < /dev/null > "$work/out" 2>&1 || fail "it was stopped: $(cat "$work/out")"
grep -q "this session has started no cluster; running: two-channel (domain $domain)" "$work/out" || fail "$(cat "$work/out")"
grep -q "trunnion down NAME" "$work/out" || fail "$(cat "$work/out")"
! setsid --wait "$trunnion" down mill < /dev/null > "$work/out" 2>&1 || fail "it was stopped: $(cat "$work/out")"
grep -q "no cluster of a machine 'mill' is running; running: two-channel (domain $domain)" "$work/out" || fail "$(cat "$work/out")"
runs_still "down of another session"

# At a terminal, which is a session of its own: at_terminal ANSWER gives the exit status of `down`.
at_terminal() {
  "$python" - "$trunnion" "$1" <<'END_PYTHON'
import os, pty, sys
pid, terminal = pty.fork()
if pid == 0:
    os.execv(sys.argv[1], [sys.argv[1], "down"])
said = b""
while b"[y/N] " not in said:
    said += os.read(terminal, 1024)
os.write(terminal, sys.argv[2].encode() + b"\n")
try:
    while part := os.read(terminal, 1024):
        said += part
except OSError:  # the end of a terminal
    pass
print(said.decode())
sys.exit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
END_PYTHON
}
! at_terminal n > "$work/out" || fail "it was stopped: $(cat "$work/out")"
grep -q "two-channel (domain $domain) was started in another session. Stop it? \[y/N\]" "$work/out" || fail "$(cat "$work/out")"
runs_still "n"
at_terminal y > "$work/out" || fail "$(cat "$work/out")"
grep -q "two-channel is down" "$work/out" || fail "$(cat "$work/out")"

# By name from anywhere, while another cluster of this computer has its launcher and has not written down yet what it runs.
start_cluster "$work/m"
beginning=$runs/76
trap 'stop_jobs; stop_cluster; rm -rf "$work" "$beginning"' EXIT
rm -rf "$beginning"
mkdir "$beginning"
cp "$runs/$domain/launcher.pid" "$beginning"
"$trunnion" status > "$work/out" || fail "$(cat "$work/out")"
setsid --wait "$trunnion" down two-channel < /dev/null > "$work/out" 2>&1 || fail "$(cat "$work/out")"
rm -r "$beginning"

# Of the own session.
start_cluster "$work/m"
"$trunnion" down < /dev/null > "$work/out" 2>&1 || fail "$(cat "$work/out")"
grep -q "two-channel is down" "$work/out" || fail "$(cat "$work/out")"
[ ! -e "$runs/$domain" ] || fail "something is left"
domain=
