# SPDX-License-Identifier: Apache-2.0
# For scripts that test commands on a cluster: source it after setting `trunnion`. Tests run in parallel, so each takes a
# domain that is free; the cluster and the directory $work end with the script.
work=$(mktemp -d)
domain= port=
stop_cluster() {
  [ -z "$domain" ] || "$trunnion" down --domain "$domain" > "$work/down" 2>&1 || true
  domain=
}
stop_jobs() {  # a recorder, a trace
  local jobs
  jobs=$(jobs -p)
  [ -z "$jobs" ] || kill $jobs 2> /dev/null || true
}
trap 'stop_jobs; stop_cluster; rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }
# start_cluster MACHINE [OPTION...]: in virtual time, with the state in $work/state, and sets $domain and $port of the gateway.
start_cluster() {
  local machine=$1
  shift
  "$trunnion" up "$machine" --free-domain --time virtual --state "$work/state" --json "$@" > "$work/up" 2>&1 ||
    fail "$(cat "$work/up")"
  domain=$(sed -n 's/.*"domain": *\([0-9]*\).*/\1/p' "$work/up")
  port=$(sed -n 's/.*"port": *\([0-9]*\).*/\1/p' "$work/up")
  [ -n "$domain" ] || fail "$(cat "$work/up")"
}
# await_idle: the program of channel 0 has ended.
await_idle() {
  for _ in $(seq 600); do
    "$trunnion" topic echo channel_state --count 1 --json --domain "$domain" > "$work/state.json"
    case $(cat "$work/state.json") in *'"state":"IDLE"'*) return ;; esac
    sleep 0.1
  done
  fail "the program does not end: $(cat "$work/state.json")"
}
# run_to_end PROGRAM: a stored program on channel 0, to its end, or the alarm that has ended it.
run_to_end() {
  "$trunnion" channel select "$1" --domain "$domain"
  "$trunnion" channel start --domain "$domain"
  await_idle
}
