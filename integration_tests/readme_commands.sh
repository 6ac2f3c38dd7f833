#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# readme_commands.sh README BUILD: the commands under "A machine's life in a few commands" run as they are printed, one after the
# other, on a computer of its own (namespaces), with a home of its own and without the clusters of others.
set -euo pipefail
readme=$1 build=$2
if [ "${3:-}" != inside ]; then
  # A user number of its own: the run directory /tmp/trunnion-UID is then not one that a cluster of this user removes when it
  # ends, which would also take away whatever is mounted there in another namespace.
  user=$((200000 + $$))
  isolated=(unshare --net --mount --pid --fork --kill-child --mount-proc --user --map-user="$user" --keep-caps)
  "${isolated[@]}" true 2> /dev/null || exit 77  # the computer allows no namespaces
  exec "${isolated[@]}" bash "$0" "$readme" "$build" inside
fi
ip link set lo up
running=/tmp/trunnion-$(id -u)
work=$(mktemp -d)
export HOME=$work/home
mkdir -p "$HOME" "$work/build"
ln -s "$build" "$work/build/release"
ln -s "$(dirname "$readme")/configs" "$work/configs"
cd "$work"
trap 'PATH=$build/bin:$PATH; trunnion down > /dev/null 2>&1 || true; cd /; rm -rf "$work"' EXIT
printf 'G21 G90 G94 G54\nG0 X5 Y5\nG1 X10 F1000\nM30\n' > part.nc  # the user's program

awk '/^## /{inside = /A machine.s life/} inside && /^```/{code = !code; next} inside && code' "$readme" > commands
[ "$(wc -l < commands)" -ge 10 ] || { echo "$readme: hardly any command was found"; exit 1; }
number=0
while IFS= read -r command <&3; do
  number=$((number + 1))
  if ! eval "$command" > said 2>&1; then
    echo "$command"
    cat said
    exit 1
  fi
done 3< commands
[ ! -e "$running" ] || { echo "left behind:"; ls -A "$running"; exit 1; }
echo "$number commands ran as printed"
