#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# rollover.sh TRUNNION MACHINES PYTHON: the table C of the delivered AC table counts modulo 360: in contact it goes on over 0,
# many turns away it is exact, a restart and a start from a line keep the turn, and tool tip control keeps the tip.
set -euo pipefail
trunnion=$1 python=$3
. "$(dirname "$0")/cluster.sh"
machine=$2/ac-table
start_cluster "$machine"
mdi() { "$trunnion" mdi "$1" --domain "$domain" > "$work/said" 2>&1 || fail "$1: $(cat "$work/said")"; }
# c SHOWN TURNED: of the channel at rest, and of the drive, which does not lose the turns, once it has executed as much.
c() {
  await_idle
  timeout 20 "$python" - "$work/state.json" "$1" "$2" <(exec "$trunnion" topic echo feedback --json --domain "$domain") "$work/at" \
    <<'END' || fail "not $1 and $2: $(cat "$work/at")"
import json, sys
state, shown, turned = json.load(open(sys.argv[1])), float(sys.argv[2]), float(sys.argv[3])
column = state["letters"].index("C")
for line in open(sys.argv[4]):
    batch = json.loads(line)
    if batch["first"] + batch["count"] < state["cycle"]: continue
    found = state["machine"][column], batch["position"][column]
    print(f"C is shown at {found[0]}, the drive is at {found[1]}", file=open(sys.argv[5], "w"))
    if abs(found[0] - shown) < 1e-2 and abs(found[1] - turned) < 1e-3: break
else:
    sys.exit(1)
END
}
automatic() { "$trunnion" channel mode auto --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"; }
mdi "G90 G1 C359.5 F3000"
c 359.5 -0.5
mdi "C0"
c 0 0
mdi "G91 C3600"
mdi "G90 C10"
c 10 3610
stop_cluster
start_cluster "$machine"
c 10 3610
mdi "G90 G1 C350 F3000"
c 350 3590

# A start from a line restores C where it is: no turn is taken back.
cat > "$work/turns.nc" <<'END'
G54 G90 G94
G1 X0 Y0 Z-50 C0 F6000
G1 C100
G1 C200
G1 C300
G1 X10
M30
END
"$trunnion" program put "$work/turns.nc" --domain "$domain" > "$work/put" 2>&1 || fail "$(cat "$work/put")"
automatic
run_to_end turns.nc
c 300 3900
mdi "G90 G1 X0 C250"
c 250 3850
automatic
select_program turns.nc
"$trunnion" channel start --from-line 6 --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
"$trunnion" channel start --domain "$domain" > "$work/said" 2>&1 || fail "$(cat "$work/said")"
await_idle
c 300 3900

# The tip stays where it is while C turns under it; the turns do not take its place away.
cat > "$work/tip.nc" <<'END'
G54 G90 G94 G17
G43.4 H1
G1 X20 Y0 Z30 C0 F3000
C90
C180
C270
C360
C450
G49
M30
END
"$trunnion" program put "$work/tip.nc" --domain "$domain" > "$work/put" 2>&1 || fail "$(cat "$work/put")"
run_to_end tip.nc
c 90 4410
