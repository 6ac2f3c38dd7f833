# SPDX-License-Identifier: Apache-2.0
# For scripts that test commands on a cluster: source it after setting `trunnion`. Tests run in parallel, so each takes a
# domain that is free; the cluster and the directory $work end with the script.
work=$(mktemp -d)
domain= port=
stop_cluster() {
  [ -z "$domain" ] || "$trunnion" down --domain "$domain" > "$work/down" 2>&1 || true
  domain=
}
trap 'stop_cluster; rm -rf "$work"' EXIT
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
