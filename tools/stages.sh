# SPDX-License-Identifier: Apache-2.0
# For .ci/run and tools/nightly.sh, which source it: `stage NAME COMMAND...` begins with a line `== NAME`, and the script ends
# with the first stage that fails. `stage_within SECONDS NAME COMMAND...` ends a stage that takes longer, and goes on: the table
# says that it was left out. stages_table prints what every stage took, did, and took from memory (tools/memory.py).
stages_work=$(mktemp -d)
stages_rows=()

stage() { stage_within "" "$@"; }

stage_within() {
  local within=$1 name=$2 begin=$SECONDS status=0 log=$stages_work/$2 done remembered
  shift 2
  echo "== $name"
  ${within:+timeout --kill-after=10 "$within"} "$@" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  # 137 is also the status of what something else has killed.
  if [ -n "$within" ] && [ $((SECONDS - begin)) -ge "$within" ] && { [ "$status" = 124 ] || [ "$status" = 137 ]; }; then
    echo "$name: not done within $within s, left out"
    stages_rows+=("$(printf '%-14s %7d %7s' "$name" $((SECONDS - begin)) "left out")")
    return
  fi
  # The last lines of tools/run_tests.py and tools/lint.py, and those of ctest.
  done=$(sed -nE "s/^[a-z]+: ([0-9]+) (tests passed|files clean), .*/\1/p" "$log" | tail -n 1)
  remembered=$(sed -nE "s/^[a-z]+: ([0-9]+) .*, all of them remembered$/\1/p; s/^[a-z]+: .*, ([0-9]+) of them remembered$/\1/p" "$log" | tail -n 1)
  [ -n "$done" ] || done=$(sed -nE 's/.* tests failed out of ([0-9]+)$/\1/p' "$log" | awk '{n += $1} END {if (NR > 0) print n}')
  stages_rows+=("$(printf '%-14s %7d %7s %11s' "$name" $((SECONDS - begin)) "${done:--}" "${remembered:--}")")
  [ "$status" = 0 ] || { stages_table; echo "$name failed"; exit "$status"; }
}

stages_table() {
  printf '\n%-14s %7s %7s %11s\n' stage seconds checked remembered
  printf '%s\n' "${stages_rows[@]}"
}
