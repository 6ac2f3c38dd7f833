// SPDX-License-Identifier: Apache-2.0
// Statements per second, and the translation of a long program.
#include <benchmark/benchmark.h>
#include <algorithm>

#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"
#include "plc/machine/machine.hpp"

namespace trunnion::st {
namespace {

void run(benchmark::State& state, const std::string& source) {
  const auto result = compile({{"b.st", source}}, interface_registers());
  if (!result.good()) return state.SkipWithError(result.lines().front().c_str());
  Machine machine(result.code);
  std::int64_t statements = 0;
  for (auto _ : state) {
    if (machine.run(0, 0, 1000000000).kind != FaultKind::none) return state.SkipWithError("fault");
    statements += machine.statements();
  }
  state.counters["statements"] =
      benchmark::Counter(static_cast<double>(statements), benchmark::Counter::kIsRate);
}

/// Assignments, comparisons and logic, as a machine's program has them.
void simple_statements(benchmark::State& state) {
  std::string body;
  for (int i = 0; i < 1000; ++i)
    body += "x := x + 1;\nb := x > y AND NOT c;\nIF b THEN y := y + 3; ELSE c := b; END_IF;\n";
  run(state, "PROGRAM main\nVAR x, y : DINT; b, c : BOOL; END_VAR\n" + body + "END_PROGRAM\n");
}
BENCHMARK(simple_statements);

void loop_over_an_array(benchmark::State& state) {
  run(state,
      "PROGRAM main\nVAR i : INT; s : DINT; a : ARRAY[0..999] OF DINT; END_VAR\nFOR i := 0 TO 999 DO s := s "
      "+ a[i]; a[i] := s; END_FOR;\nEND_PROGRAM\n");
}
BENCHMARK(loop_over_an_array);

void translate_5000_lines(benchmark::State& state) {
  std::string source;
  for (int unit = 0; unit < 50; ++unit) {
    const auto n = std::to_string(unit);
    source += "FUNCTION_BLOCK Block" + n +
              "\nVAR_INPUT e : BOOL; v : INT; END_VAR\nVAR_OUTPUT q : BOOL; END_VAR\n"
              "VAR t : TON; x, y : DINT; a : ARRAY[0..9] OF INT; END_VAR\n";
    for (int i = 0; i < 31; ++i)
      source +=
          "x := x * 2 + a[v MOD 10];\nIF e AND x > y THEN y := x; t(IN := q, PT := T#5ms); END_IF;\na[" +
          std::to_string(i % 10) + "] := v;\n";
    source += "q := t.Q;\nEND_FUNCTION_BLOCK\n";
  }
  source += "PROGRAM main\nVAR b : Block49; END_VAR\nb(e := TRUE);\nEND_PROGRAM\n";
  state.counters["lines"] = static_cast<double>(std::count(source.begin(), source.end(), '\n'));
  for (auto _ : state)
    if (!compile({{"b.st", source}}, interface_registers()).good()) return state.SkipWithError("error");
}
BENCHMARK(translate_5000_lines)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion::st
