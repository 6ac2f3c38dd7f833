#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# test_packages.sh BUILD SOURCE DOMAIN: makes the Debian packages and installs them in a clean root, where neither the source
# nor the build directory exists: an overlay over this system in a mount namespace of its own. There an ordinary user starts a
# machine, runs a program and stops the machine; a service of somebody else's is built against trunnion-dev; then the packages
# are purged, and nothing of theirs may be left. Needs root (exit status 77 without).
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$2")
domain=$3
[ "$(id -u)" -eq 0 ] || { echo "skipped: overlay mounts need root"; exit 77; }
if [ -z "${TRUNNION_PACKAGES_NAMESPACE:-}" ]; then
  (cd "$build" && cpack --config CPackConfig.cmake > packages.log 2>&1) || { cat "$build/packages.log"; exit 1; }
  exec env TRUNNION_PACKAGES_NAMESPACE=1 unshare --mount --propagation private "$0" "$@"
fi

work=$(mktemp -d)
mount -t tmpfs none "$work"
mkdir "$work"/{upper,work,root,packages}
cp "$build"/packages/*.deb "$work/packages"
mount -t overlay overlay -o "lowerdir=/,upperdir=$work/upper,workdir=$work/work" "$work/root"
root=$work/root
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs none "$root/tmp"
mkdir -p "$root$source"  # where it is below /tmp, which is new here
mount -t tmpfs none "$root$source"
trap 'chroot "$root" pkill -f /usr/lib/trunnion/bin || true; umount -lR "$root"; umount -l "$work"; rmdir "$work"' EXIT
mkdir "$root/tmp/packages"
cp "$work"/packages/*.deb "$root/tmp/packages"
chmod -R a+rX "$root/tmp/packages"

in_root() { chroot "$root" env -i PATH=/usr/bin:/usr/sbin:/bin:/sbin HOME=/tmp/home LANG=C.UTF-8 "$@"; }
as_user() { in_root setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; }
# Every path but what programs other than ours keep for themselves.
files() { in_root find /etc /home /opt /srv /usr /var -xdev \( -path /var/lib/dpkg -o -path /var/log -o -path /var/cache \) -prune -o -print | sort; }

in_root mkdir -p /tmp/home
in_root chown 65534:65534 /tmp/home
files > "$root/tmp/before"
echo "== install"
in_root bash -c 'dpkg -i /tmp/packages/*.deb' > "$root/tmp/dpkg.log" 2>&1 || { cat "$root/tmp/dpkg.log"; exit 1; }

echo "== as an ordinary user"
as_user trunnion --version
as_user bash -c 'source /usr/share/bash-completion/completions/trunnion && COMP_WORDS=(trunnion sta) && COMP_CWORD=1 && _trunnion && echo "completion: ${COMPREPLY[*]}"' | grep -q 'completion: .*status'
grep -q '^\.TH TRUNNION' "$root/usr/share/man/man1/trunnion.1"
as_user trunnion up ac-table --time virtual --domain "$domain" --port "$((18000 + domain))" > "$root/tmp/up.log" 2>&1 || { cat "$root/tmp/up.log"; exit 1; }
as_user curl -fsS "http://127.0.0.1:$((18000 + domain))/" | grep -q '<html' || { echo "the page is not served"; exit 1; }
as_user env PYTHONDONTWRITEBYTECODE=1 python3 /usr/share/doc/python3-trunnion/examples/following_error.py "http://127.0.0.1:$((18000 + domain))" rtcp.nc
as_user trunnion down --domain "$domain"
as_user bash -c "cd /tmp/home && trunnion run ac-table nas979_cone --report /tmp/home/report" | tail -n 3
[ -f "$root/tmp/home/report/path.svg" ] || { echo "the run has left no report"; exit 1; }

if compgen -G "$root/tmp/packages/trunnion-hal_*.deb" > /dev/null; then
  echo "== a machine behind HAL"
  # HAL's shared memory has one key for each computer: an IPC namespace of its own keeps other machines apart. What does not
  # come up is missing: the drive starts the session, which loads HAL, whose pins of the PLC connect.
  in_root unshare --ipc setpriv --reuid=65534 --regid=65534 --clear-groups bash -c "
    trunnion up hal-sim-xyz --domain $domain --port $((18000 + domain)) && timeout 60 bash -c '
      until halcmd getp io.connected | grep -q TRUE && halcmd gets drives-on | grep -q TRUE; do sleep 0.1; done' &&
    trunnion down --domain $domain" > "$root/tmp/hal.log" 2>&1 || { cat "$root/tmp/hal.log"; exit 1; }
fi

echo "== every program of the packages"
for program in "$root"/usr/lib/trunnion/bin/*; do
  program=${program#"$root"}
  usage=$(as_user "$program" --help 2>&1) || true
  grep -qi "${program##*/}" <<< "$usage" || { echo "$program does not start: $usage"; exit 1; }
done

echo "== the unit"
verified=$(in_root systemd-analyze verify /usr/lib/systemd/system/trunnion@.service 2>&1 | grep -i trunnion || true)
[ -z "$verified" ] || { echo "$verified"; exit 1; }

echo "== a service of somebody else's"
mkdir "$root/tmp/other"
cat > "$root/tmp/other/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(other CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(trunnion 0.3 REQUIRED)
add_executable(trunnion-other main.cpp)
target_link_libraries(trunnion-other trunnion::service)
CMAKE
cat > "$root/tmp/other/main.cpp" <<'CPP'
#include "service/node.hpp"

class Other : public trunnion::service::Service {
 public:
  explicit Other(trunnion::service::Node& node) : feedback_(node.bus().reader(trunnion::topics::feedback)) {}
  void pump() override {
    while (feedback_.take(batch_)) ++taken_;
  }
  trunnion::service::Health health() const override { return {}; }

 private:
  trunnion::bus::Reader<trunnion::idl::stream::Feedback> feedback_;
  trunnion::idl::stream::Feedback batch_;
  int taken_ = 0;
};

int main(int argc, char** argv) { return trunnion::service::service_main<Other>(argc, argv, "other"); }
CPP
in_root bash -c 'cmake -S /tmp/other -B /tmp/other/build && cmake --build /tmp/other/build' > "$root/tmp/other.log" 2>&1 || { cat "$root/tmp/other.log"; exit 1; }
in_root /tmp/other/build/trunnion-other --help | head -n 1
for example in compensation-in-c listener-in-c listener-in-cpp; do
  in_root bash -c "cp -r /usr/share/doc/trunnion-dev/examples/$example /tmp/$example && cmake -S /tmp/$example -B /tmp/$example/build && cmake --build /tmp/$example/build" \
    > "$root/tmp/$example.log" 2>&1 || { cat "$root/tmp/$example.log"; exit 1; }
  echo "$example built against the package"
done
in_root bash -c 'cd /tmp && trunnion new service my-stage && cmake -S my-stage -B my-stage/build && cmake --build my-stage/build' > "$root/tmp/my-stage.log" 2>&1 ||
  { cat "$root/tmp/my-stage.log"; exit 1; }
# Its tests: the state, and a recording made with it, as an ordinary user and twice, so that the second run compares.
in_root chown -R 65534:65534 /tmp/my-stage
for run in 1 2; do
  as_user ctest --test-dir /tmp/my-stage/build --output-on-failure > "$root/tmp/my-stage.log" 2>&1 || { cat "$root/tmp/my-stage.log"; exit 1; }
done
echo "my-stage: written, built against the package, its tests passed twice"

echo "== purge"
in_root bash -c 'dpkg -P $(dpkg-query -W -f "\${Package} " "trunnion*" python3-trunnion)' > "$root/tmp/purge.log" 2>&1 || { cat "$root/tmp/purge.log"; exit 1; }
files > "$root/tmp/after"
# Adding and removing a user leaves backups of the tables of users, and an updated count of none of our files.
left=$(diff "$root/tmp/before" "$root/tmp/after" | grep -vE '^[<>] /etc/(passwd|group|shadow|gshadow|subuid|subgid)-?$|^[0-9,]+[acd][0-9,]+$' || true)
[ -z "$left" ] || { echo "left behind or taken away:"; echo "$left"; exit 1; }
in_root getent passwd trunnion > /dev/null && { echo "the user trunnion is left"; exit 1; }
echo "packages: all good"
