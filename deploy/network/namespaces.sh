#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Network namespaces as the hosts of one machine, on one computer, for tests; needs root.
#   namespaces.sh up PREFIX HOST=ADDRESS...     one namespace PREFIX-HOST each, joined by the bridge PREFIX-br (24-bit network)
#   namespaces.sh bare PREFIX HOST=ADDRESS...   the same without the bridge: a program attaches a TAP device `cable` to each
#   namespaces.sh address PREFIX HOST=ADDRESS...  gives those devices their addresses
#   namespaces.sh exec PREFIX HOST COMMAND...   runs a command on a host; each host has run files of clusters of its own
#   namespaces.sh loss PREFIX PERCENT           every host drops that share of the UDP packets it gets, at random; 0 = none
#   namespaces.sh cut PREFIX HOST SECONDS       the cable of a host is out for so long (bridge only)
#   namespaces.sh down PREFIX                   removes all of it
set -euo pipefail

fail() { echo "namespaces.sh: $*" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || fail "needs root"
[ $# -ge 2 ] || fail "see the head of this file"
verb=$1
prefix=$2
shift 2
[[ $prefix =~ ^[a-z0-9]{1,6}$ ]] || fail "PREFIX has 1 .. 6 small letters and digits"

hosts() { ip netns list | awk -v p="$prefix-" 'index($1, p) == 1 { print substr($1, length(p) + 1) }'; }
# The outer end of a host's cable; interface names have 15 characters at most.
port() { echo "$prefix-${1:0:8}"; }
# Launchers of one user and domain would take each other for the same cluster by their run files, so each host has a directory
# for them. It lies in the real one, which a cluster outside would remove with its mounts if it were empty.
run_files=/tmp/trunnion-0
runs() { echo "$run_files/hosts-$prefix/$1"; }

make_host() {
  ip netns add "$prefix-$1"
  ip -n "$prefix-$1" link set lo up
  mkdir -p "$(runs "$1")"
}

give_address() { # HOST ADDRESS
  ip -n "$prefix-$1" address add "$2/24" dev cable
  ip -n "$prefix-$1" link set cable up
  # A carrier that was lost empties the table of neighbours, and a question lost with it is repeated after 1 s only.
  ip netns exec "$prefix-$1" sysctl -qw net.ipv4.neigh.cable.retrans_time_ms=20
  ip -n "$prefix-$1" route add default dev cable # multicast goes this way too
}

case $verb in
  up)
    ip link add "$prefix-br" type bridge
    ip link set "$prefix-br" up
    for pair in "$@"; do
      host=${pair%%=*}
      make_host "$host"
      ip link add "$(port "$host")" type veth peer name cable netns "$prefix-$host"
      ip link set "$(port "$host")" master "$prefix-br" up
      give_address "$host" "${pair#*=}"
    done
    ;;
  bare)
    for pair in "$@"; do make_host "${pair%%=*}"; done
    ;;
  address)
    for pair in "$@"; do give_address "${pair%%=*}" "${pair#*=}"; done
    ;;
  exec)
    [ $# -ge 2 ] || fail "exec PREFIX HOST COMMAND..."
    host=$1
    shift
    exec ip netns exec "$prefix-$host" unshare --mount --uts bash -c \
      'hostname "$1"; mount --bind "$2" "$3"; shift 3; exec "$@"' exec "$host" "$(runs "$host")" "$run_files" "$@"
    ;;
  loss)
    [ $# -eq 1 ] || fail "loss PREFIX PERCENT"
    for host in $(hosts); do
      ip netns exec "$prefix-$host" iptables -F INPUT
      [ "$1" = 0 ] && continue
      ip netns exec "$prefix-$host" iptables -A INPUT -i cable -p udp \
        -m statistic --mode random --probability "$(awk -v p="$1" 'BEGIN { printf "%.6f", p / 100 }')" -j DROP
      ip netns exec "$prefix-$host" iptables -A INPUT -i cable -p udp # counts the others
    done
    ;;
  cut)
    [ $# -eq 2 ] || fail "cut PREFIX HOST SECONDS"
    ip link set "$(port "$1")" down
    sleep "$2"
    ip link set "$(port "$1")" up
    ;;
  down)
    for host in $(hosts); do
      ip netns pids "$prefix-$host" | xargs -r kill -9 2>/dev/null || true
      # Who has a socket there keeps the namespace, and with it the cable.
      if ip link show "$(port "$host")" >/dev/null 2>&1; then ip link del "$(port "$host")"; fi
      ip netns del "$prefix-$host"
    done
    if ip link show "$prefix-br" >/dev/null 2>&1; then ip link del "$prefix-br"; fi
    rm -rf "$run_files/hosts-$prefix"
    rmdir "$run_files" 2>/dev/null || true # another cluster's are in it
    ;;
  *) fail "unknown verb '$verb'" ;;
esac
