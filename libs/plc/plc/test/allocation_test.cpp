// SPDX-License-Identifier: Apache-2.0
// A machine allocates when it is made, and never while it runs, also when a run is interrupted or faulty.
#include "testing_support/allocation_count.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

using testing_support::allocations;

constexpr const char* functions_that_are_called =
    "FUNCTION inner : INT VAR_INPUT v : INT; END_VAR inner := v + 1; END_FUNCTION\n"
    "FUNCTION outer : INT VAR_INPUT v : INT; END_VAR VAR i : INT; END_VAR\n"
    "FOR i := 1 TO 5 DO outer := outer + inner(v); END_FOR; END_FUNCTION\n";
constexpr const char* variables_of_every_kind =
    "VAR i, y, m, day : INT; a : ARRAY[0..9] OF INT; s : STRING[40]; w : WSTRING[20]; on : TON; count : "
    "CTU_ULINT;\n"
    "controller : PID_CONTROL; x : LREAL; r : ARRAY[0..15] OF DINT; out : DINT; b : BYTE; END_VAR";
// X0: 0 runs to the end; 1 an index, 2 a division, 3 a loop without end.
constexpr const char* statements_of_every_kind =
    "FOR i := 0 TO 9 DO a[i] := outer(i) + a[(i + 1) MOD 10]; END_FOR;\n"
    "s := CONCAT(INT_TO_STRING(a[3]), LEFT('abcdef', 3), s); w := STRING_TO_WSTRING(s);\n"
    "s := REPLACE(s, 'xy', 1, 2); i := FIND(s, 'xy') + LEN(w);\n"
    "on(IN := NOT on.Q, PT := T#5ms); count(CU := on.Q, PV := 3);\n"
    "x := SIN(x) + 0.1; controller(AUTO := TRUE, SP := x, TI := LT#1s, TD := LT#10ms);\n"
    "IF PID(100, 0, r, out) THEN b := UINT_TO_BCD_BYTE(INT_TO_UINT(i)); END_IF;\n"
    "SPLIT_DATE(IN := CONCAT_DATE(2026, 11, 25), YEAR => y, MONTH => m, DAY => day);\n"
    "CASE %X0 OF 1: i := 10; a[i] := 1; 2: i := 0; i := 1 / i; 3: WHILE TRUE DO i := i + 1; END_WHILE; "
    "END_CASE;";

TEST(Allocation, NoneWhileAMachineRunsToTheEndInPartsOrToAFault) {
  Translated program(variables_of_every_kind, statements_of_every_kind, functions_that_are_called);
  auto& machine = program.run.machine();
  std::int64_t now = 0;
  for (const auto& [input, kind] : {std::pair{"0", FaultKind::none},
                                    {"1", FaultKind::index},
                                    {"2", FaultKind::division},
                                    {"3", FaultKind::budget}}) {
    program.set("%X0", input);
    const auto before = allocations;
    std::size_t parts = 0;
    for (int scan = 0; scan < 100; ++scan) {
      now += 1000000;
      const auto whole = machine.run(0, now, 5000);
      Progress progress;
      Fault fault;
      do {
        fault = machine.run_part(0, now, 5000, 7, progress);
        ++parts;
      } while (fault.kind == FaultKind::none && progress.interrupted != 0);
      if (whole.kind != kind || fault.kind != kind) break;
    }
    EXPECT_EQ(allocations, before) << input;
    EXPECT_GT(parts, 1000u) << "100 scans of more than 70 statements each with the expected end: " << input;
  }
}

}  // namespace
}  // namespace trunnion::st
