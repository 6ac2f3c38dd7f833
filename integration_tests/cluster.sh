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
# wait_until WHAT COMMAND...: until COMMAND succeeds. The limit, $patience s, only ends a hang: a busy computer takes its time.
wait_until() {
  local what=$1 limit=${patience:-60} end=$((SECONDS + ${patience:-60}))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || fail "not within $limit s: $what"
    sleep 0.05
  done
}
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
# await_alarm PATTERN: leaves the list of alarms in $work/alarms.
has_alarm() { "$trunnion" alarms --domain "$domain" > "$work/alarms" || true; grep -q -- "$1" "$work/alarms"; }
await_alarm() { wait_until "there is an alarm '$1'" has_alarm "$1"; }
# reset_alarms: of the whole machine; none is left.
reset_alarms() {
  "$trunnion" alarms --reset --domain "$domain" > "$work/alarms" || true
  await_alarm 'no alarms'
}
# await_state STATE: of channel 0.
has_state() {
  # Every channel has a state of its own there, and the listener ends with its reader.
  { timeout 10 "$trunnion" topic echo channel_state --timeout 5 --json --domain "$domain" 2> "$work/listener" || true; } |
    grep -m 1 '"channel":0,' > "$work/state.json"
  grep -q "\"state\":\"$1\"" "$work/state.json"
}
await_state() { wait_until "channel 0 is $1" has_state "$1"; }
# await_idle: the program of channel 0 has ended.
await_idle() {
  (patience=300 await_state IDLE) ||
    fail "the program does not end: $(cat "$work/state.json" && "$trunnion" alarms --domain "$domain")"
}
# select_program NAME: on channel 0, to which the list with a program that was stored just now may still be on its way.
is_selected() { "$trunnion" channel select "$1" --domain "$domain" 2> "$work/select"; }
select_program() { wait_until "channel 0 takes the program $1" is_selected "$1"; }
# run_to_end PROGRAM: a stored program on channel 0, to its end, or the alarm that has ended it.
run_to_end() {
  select_program "$1"
  "$trunnion" channel start --domain "$domain"
  await_idle
}
# start_recording FILE SAID [OPTION...]: from when it returns everything is recorded; $recorder is the process of the command.
start_recording() {
  local said=$2
  "$trunnion" record "$1" --domain "$domain" "${@:3}" > "$said" 2>&1 &
  recorder=$!
  wait_until "the recording begins" begins_or_ends "$said"
  grep -q '^recording ' "$said" || fail "$(cat "$said")"
}
begins_or_ends() { grep -qs '^recording ' "$1" || ! kill -0 "$recorder" 2> /dev/null; }
# end_recording SAID: fails when something was lost.
end_recording() {
  kill -INT "$recorder"
  wait "$recorder" || fail "$(cat "$1")"
}
# reset_and_settle PARAMETER...: a reset of channel 0, after which none of these has a value that waits to become active.
is_settled() {
  "$trunnion" param get "$@" --json --domain "$domain" > "$work/pending" && ! grep -q '"pending": *true' "$work/pending"
}
reset_and_settle() {
  "$trunnion" channel reset --domain "$domain" > "$work/reset"
  wait_until "parameters $* are active" is_settled "$@"
}
