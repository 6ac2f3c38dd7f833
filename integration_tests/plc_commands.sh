#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# plc_commands.sh TRUNNION MACHINES EXAMPLES DOCS: the commands plc check, run and test, the programs of the repository in
# Structured Text with their tests, and the programs of the tutorial.
set -euo pipefail
trunnion=$1 machines=$2 examples=$3 docs=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*" >&2; exit 1; }
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', there is '$2'"; }

# Every machine's programs in Structured Text, without warnings, and every test.
for directory in "$examples/plc-ladder" "$examples/plc-pid" "$examples/plc-tool-changer" $(ls -d "$machines"/*/plc); do
  ls "$directory"/*.st > /dev/null 2>&1 || continue
  is "$directory" "$(find "$directory/" -name "*.st" -o -name "*.xml" -o -name devices.yaml -o -name messages.yaml -o -name modbus.yaml | sort | xargs "$trunnion" plc check | grep -v '^No errors\|: at most [0-9]* statements in one run$' || true)" ""
  ! grep -lq '^TEST' "$directory"/*.st || "$trunnion" plc test "$directory" > "$work/tests" || fail "$(cat "$work/tests")"
done

# The logic refuses every M code that the parameters do not list, and knows every one that they list.
for directory in "$machines"/*/; do
  rm -rf "$work/logic"
  cp -rL "$directory/plc" "$work/logic"
  for channel in $(sed -nE 's/^"04([0-9])000":.*/\1/p' "$directory/parameters.yaml"); do
    # Beside M0, M1, M2 and M30, which are the control's.
    listed=$(sed -nE "s/^\"04${channel}944\": (.*)/\1/p" "$directory/parameters.yaml" | tr ';' ' ' | xargs -n1 echo | sed 's/.*/ OR m = &/' | tr -d '\n')
    [ -n "$listed" ] || fail "$directory: parameter 04${channel}944 lists no M function"
    variable=unknown
    [ "$channel" = 0 ] || variable=second_unknown
    cat > "$work/logic/m_functions_$channel.st" <<END
TEST 'the M functions of channel $channel'
VAR m : INT; END_VAR
m_strobe_$channel := TRUE;
FOR m := 0 TO 999 DO
  m_code_$channel := INT_TO_UINT(m);
  main();
  ASSERT_EQ(main.$variable, NOT (m = 0 OR m = 1 OR m = 2 OR m = 30$listed));
  ASSERT_TRUE(fin_failed_$channel OR NOT main.$variable);
END_FOR;
END_TEST
END
  done
  "$trunnion" plc test "$work/logic" > "$work/tests" || fail "$directory: $(cat "$work/tests")"
  grep -q 'passed  the M functions of channel' "$work/tests" || fail "$directory: the M functions were not tested"
done

cd "$work"
cat > good.st <<'END'
FUNCTION area : LREAL
VAR_INPUT width, height : LREAL := 2.0; END_VAR
area := width * height;
END_FUNCTION
PROGRAM main
VAR n : INT; t : TON; on AT %X0.3 : BOOL; list : ARRAY[1..3] OF INT; END_VAR
n := n + 1;
t(IN := on, PT := T#20ms);
list[2] := list[2] + n;
END_PROGRAM
END
is function "$("$trunnion" plc run good.st --call area --set width=1.5)" "$(printf 'width = 1.5\nheight = 2.0\narea = 3.0')"
is scans "$("$trunnion" plc run good.st --scans 3 --set main.list[2]=10 | grep list)" "main.list = [0, 16, 0]"
is register "$("$trunnion" plc run good.st --scans 3 --set %X0.3=TRUE | grep main.t)" "main.t = (IN := TRUE, PT := T#20ms, Q := TRUE, ET := T#20ms)"
printf 'main.n,%%X0.3\n5,1\n,0\n' > inputs.csv
is inputs "$("$trunnion" plc run good.st --scans 2 --inputs inputs.csv | grep -c 'main.n = 7\|main.on = FALSE')" 2
is json "$("$trunnion" plc run good.st --json | grep -c '"main.n":"1"')" 1
is "second run" "$("$trunnion" plc run good.st --scans 5)" "$("$trunnion" plc run good.st --scans 5)"

refused() {  # WHAT SENTENCE COMMAND...
  local what=$1 sentence=$2 status=0
  shift 2
  "$trunnion" plc "$@" > out 2>&1 || status=$?
  is "$what" $status 1
  grep -qF -- "$sentence" out || fail "$what: $(cat out)"
}
refused "a variable" "'nothing': there is no such variable" run good.st --set nothing=1
refused "a value" "'x' is no INT: write a whole number -32768 .. 32767" run good.st --set main.n=x
refused "a name" "--call other: there is no such program or function" run good.st --call other
refused "a file" "none.st: cannot be read" check none.st
refused "no test" "has no TEST" test "$work"
printf 'main.n\n1,2\n' > wrong.csv
refused "a row" "wrong.csv:2: more values than the first row has names" run good.st --inputs wrong.csv
printf 'PROGRAM main\nVAR i : INT; END_VAR\ni := 1.5;\nj := 2;\nEND_PROGRAM\n' > bad.st
refused "two errors" "bad.st:4:1: error: there is no variable 'j'" check bad.st
refused "the other" "bad.st:3:6: error: expected a whole number (INT), found a number with a decimal point" check bad.st
printf 'PROGRAM main\nVAR i, n : INT; END_VAR\nn := 1 / i;\nEND_PROGRAM\n' > fault.st
refused "a fault" "fault.st:3:8: division by zero" run fault.st

# A configuration, the largest number of statements, what two tasks write, the cross reference.
cat > line.st <<'END'
CONFIGURATION plant
RESOURCE plc ON PLC
TASK quick(INTERVAL := T#1ms);
TASK slow(INTERVAL := T#20ms);
PROGRAM left WITH quick : conveyor(start := %X9.0);
PROGRAM right WITH slow : conveyor(start := TRUE);
END_RESOURCE
END_CONFIGURATION
PROGRAM conveyor
VAR_INPUT start : BOOL; END_VAR
VAR moved, i : INT; END_VAR
IF start THEN moved := moved + 1; END_IF;
FOR i := 1 TO 5 DO %W10 := 1; END_FOR;
WHILE moved > 100 DO moved := 0; END_WHILE;
END_PROGRAM
END
is instances "$("$trunnion" plc run line.st --scans 4 | grep moved)" "$(printf 'left.moved = 0\nright.moved = 2')"
"$trunnion" plc check line.st --cross-reference > out
for line in "fast: no limit of its statements is known, because of the loop at line.st:14:1" "%W10" "  line.st:13:20: writes" \
  "line.st:13:20: warning: the register %W10 is written by the tasks main and fast (line.st:13:20): the one that runs last decides"; do
  grep -qxF -- "$line" out || fail "check of a configuration: no '$line' in $(cat out)"
done
sed -i /^WHILE/d line.st
# The call of the program and its entry, IF with one, FOR with five times one and the way back.
is statements "$("$trunnion" plc check line.st | grep '^main')" "main: at most 15 statements in one run"
is "cross reference" "$("$trunnion" plc check line.st --cross-reference --json | grep -o '"name":"conveyor.start"')" '"name":"conveyor.start"'

# Instruction lists: errors with their places, the cross reference together with that of other files.
printf 'LD %%X9.0\nAND M7\nST %%Y9.0\n' > wrong.il
refused "an instruction list" "wrong.il:2:5: error: there is no variable 'M7'" check wrong.il
"$trunnion" plc check wrong.il --json > out 2>&1 || true
grep -q '"severity":"error","file":"wrong.il","line":2,"column":5' out || fail "$(cat out)"
printf 'VAR\n  lamp AT %%Y9.0 : BOOL\nEND_VAR\nLD %%X9.0\nST lamp\nLD %%W10\nADD 1\nST %%W11\n' > fast.il
sed -i '/quick/d' line.st
"$trunnion" plc check line.st fast.il --cross-reference > out || fail "$(cat out)"
grep -A1 -x "%Y9.0  fast.lamp" out | grep -qx "  fast.il:5:4: writes" || fail "$(cat out)"
grep -A2 -x "%W10" out | grep -qx "  fast.il:6:4: reads" || fail "$(cat out)"
"$trunnion" plc check fast.il > out || fail "$(cat out)"

# The blocks of the tutorial: each is a whole unit or a part of one that step 3 begins.
awk '/^## Tutorial/ { tutorial = 1 } !tutorial { next } /^```/ { inside = !inside; if (inside) ++n; next } inside { print > ("tutorial_" n ".st") }' "$docs/plc.md"
for n in 1 2 3; do
  "$trunnion" plc check tutorial_$n.st > out || fail "block $n of the tutorial: $(cat out)"
done
mkdir steps
cp tutorial_3.st steps/tool_changer.st
cp tutorial_4.st steps/changer_test.st
refused "the test of step 4" "changer_test.st:6:1: the assertion is not met" test steps
sed -i "/^arm_forward := state/e cat $work/tutorial_5.st" steps/tool_changer.st
"$trunnion" plc test steps > out || fail "$(cat out)"
# Step 5, and steps 6 and 7 with the files of the example: what the tutorial builds passes the example's tests.
sed -i -e '/^VAR_INPUT/s/END_VAR/limit : TIME := T#2s; END_VAR/' -e '/^VAR state/s/END_VAR/watch : TON; END_VAR/' \
  -e "/^CASE/e cat $work/tutorial_6.st" -e 's/NOT spindle_at_rest) THEN/NOT spindle_at_rest OR watch.Q) THEN/' steps/tool_changer.st
example=$examples/plc-tool-changer
diff tutorial_7.st <(grep -v SPDX "$example/devices.yaml") > out || fail "step 6 of the tutorial is not the example: $(cat out)"
diff tutorial_8.st <(grep -v SPDX "$example/main.st") > out || fail "step 7 of the tutorial is not the example: $(cat out)"
cp tutorial_7.st steps/devices.yaml
cp tutorial_8.st steps/main.st
cp "$example/changer_test.st" steps/
"$trunnion" plc test steps > out || fail "the changer of the tutorial with the tests of the example: $(cat out)"
