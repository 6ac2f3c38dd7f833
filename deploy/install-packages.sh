#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# install-packages.sh [run|test|nightly]: installs what building and running Trunnion needs on Debian 12 (run), what its tests,
# benchmarks and checks need besides (test, the default), or also what `make nightly` needs. Does nothing when all of it is
# there.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache mold git python3 python3-yaml pkg-config
  libfastrtps-dev libfastcdr-dev libasio-dev libtinyxml2-dev libssl-dev cyclonedds-dev
  cyclonedds-tools libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev  # small, and CMake asks for them
  libeigen3-dev libyaml-cpp-dev libfmt-dev nlohmann-json3-dev libcli11-dev libboost-dev libzstd-dev zlib1g-dev libpugixml-dev libmodbus-dev libargon2-dev libarchive-dev procps
  libfcl-dev libompl-dev libboost-serialization-dev libboost-filesystem-dev libboost-system-dev  # collision
)
case "${1:-test}" in
  run) ;;
  test | nightly)
    packages+=(
      clang-14 clang-tidy-14 clang-format-14 clang-tools-14 libclang-rt-14-dev
      linuxcnc-uspace linuxcnc-uspace-dev  # for machines behind its HAL: docs/hal.md
      chromium curl file libxml2-utils iproute2 iptables util-linux openssl hostname systemd locales
    )
    [ "${1:-}" != nightly ] || packages+=(gcovr)
    ;;
  *) echo "usage: $0 [run|test|nightly]" >&2; exit 2 ;;
esac

# Another Node.js than Debian's (18) will do from version 18 on.
node_version=$(node --version 2>/dev/null | sed 's/^v\([0-9]*\).*/\1/' || true)
if [ "${node_version:-0}" -lt 18 ] || ! command -v npm >/dev/null; then
  packages+=(nodejs npm)
fi

if ! grep -q '^ID=debian' /etc/os-release 2>/dev/null || ! grep -q '^VERSION_ID="12"' /etc/os-release; then
  if [ "${TRUNNION_PACKAGES:-}" = ready ]; then exit 0; fi
  echo "This is not Debian 12. Install what these Debian packages contain, then set TRUNNION_PACKAGES=ready:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

sudo=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "Run as root, or install sudo, to install: ${missing[*]}" >&2; exit 1; }
  sudo=(sudo)
fi
echo "Installing ${#missing[@]} packages: ${missing[*]}"
# Shows how far apt is: every package it brings along is unpacked once and set up once.
progress() {
  awk '/newly installed/ { total = 2 * ($1 + $3) }
    /^(Unpacking|Setting up) / { ++done; if (done % 20 == 0 || done == total) print "  packages: step " done " of " total; fflush() }'
}
"${sudo[@]}" apt-get update -qq
"${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" 2>&1 > >(progress) |
  grep -v '^debconf: delaying' >&2 || true
for package in "${missing[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
    { echo "$package could not be installed; run: apt-get install $package" >&2; exit 1; }
done
