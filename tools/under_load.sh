#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# under_load.sh [--until-fail] N [CTEST OPTIONS...]: the tests N times beside a bounded load, four busy loops and a writer on the
# disk, which end with it. Prints a table: run, seconds, tests, failed. With --until-fail it stops at the first run that fails,
# with its output in build/under-load: how a test is examined that has failed once.
#   tools/under_load.sh --until-fail 50 -R cluster.Rights
set -euo pipefail
cd "$(dirname "$0")/.."
until_fail=0
if [ "${1:-}" = --until-fail ]; then
  until_fail=1
  shift
fi
[[ "${1:-}" =~ ^[1-9][0-9]*$ ]] || { sed -n '3,6s/^# //p' "$0"; exit 2; }
runs=$1
shift
build=build/release
[ -e $build/CTestTestfile.cmake ] || { echo "under_load: run make build first"; exit 2; }
logs=build/under-load
rm -rf $logs
mkdir -p $logs

load=()
trap 'kill "${load[@]}" 2> /dev/null || true; rm -f $logs/written' EXIT
for _ in 1 2 3 4; do
  # A session of its own: Linux shares the processors out by sessions, and every cluster is one.
  setsid sh -c 'while :; do :; done' &
  load+=($!)
done
setsid sh -c "while :; do dd if=/dev/zero of=$logs/written bs=1M count=64 conv=fsync status=none; done" &
load+=($!)

printf '%5s %8s %6s  %s\n' run seconds tests failed
bad=0
for run in $(seq "$runs"); do
  log=$logs/$run.log begin=$SECONDS status=0
  {
    ctest --test-dir $build --output-on-failure -j "$(nproc)" -LE realtime "$@" || status=$?
    ctest --test-dir $build --output-on-failure -L realtime "$@" || status=$?
  } > "$log" 2>&1
  tests=$(sed -nE 's/.* tests failed out of ([0-9]+)$/\1/p' "$log" | awk '{n += $1} END {print n + 0}')
  failed=$(sed -nE 's/^\s*[0-9]+ - (.*) \((Failed|Timeout|SEGFAULT|Exception).*/\1/p' "$log" | paste -sd ' ')
  printf '%5d %8d %6d  %s\n' "$run" $((SECONDS - begin)) "$tests" "${failed:--}"
  [ "$tests" -gt 0 ] || { echo "no test was run"; exit 1; }
  if [ $status != 0 ]; then
    bad=$((bad + 1))
    [ $until_fail = 0 ] || { echo "the output is in $log"; exit 1; }
  fi
done
echo "$((runs - bad)) of $runs runs passed"
[ $bad = 0 ]
