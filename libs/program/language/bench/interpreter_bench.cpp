// SPDX-License-Identifier: Apache-2.0
// Blocks per second of whole programs in memory.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "language/interpreter.hpp"

namespace trunnion::language {
namespace {

constexpr int blocks = 200000;

/// Tables without content; frames that are the same, because the blocks do not change them.
struct PlainMachine : Environment {
  AxisValues work_offset(std::uint8_t) const override { return {10, 20, 30}; }
  std::optional<double> tool_length(std::uint16_t) const override { return 100; }
  std::optional<ToolOffset> tool_offset(std::uint16_t) const override { return ToolOffset{100, 0, 5, 0}; }
  AxisValues reference_position() const override { return {}; }
  AxisValues tip_from_machine(const AxisValues& machine, double) const override { return machine; }
  AxisValues machine_from_tip(const AxisValues& tip, double) const override { return tip; }
  std::uint16_t axes() const override { return 0b111111111; }
  double radius_deviation() const override { return 0.1; }
  TextSource* subprogram(std::string_view) override { return nullptr; }
};

void interpret(benchmark::State& state, const std::string& text, int lines = blocks) {
  PlainMachine machine;
  Interpreter interpreter(machine);
  while (state.KeepRunning()) {
    StringSource source(text);
    interpreter.start(source, {}, {});
    Command command;
    double sum = 0;
    Step step = interpreter.next(command);
    for (; step != Step::end && step != Step::alarm; step = interpreter.next(command))
      sum += command.target[X];
    if (step == Step::alarm) state.SkipWithError(interpreter.alarm().text.data());
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * lines);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void BM_ThreeAxisLines(benchmark::State& state) {
  std::string text = "%1\nG90 G54 G43 H1 G1 F2000\n";
  char line[120];
  for (int i = 0; i < blocks; ++i) {
    const double t = i * 0.001;
    std::snprintf(line, sizeof line, "X%.3f Y%.3f Z%.3f\n", 90 * std::sin(t), 90 * std::cos(t),
                  5 * std::sin(7 * t));
    text += line;
  }
  interpret(state, text + "M30\n");
}
BENCHMARK(BM_ThreeAxisLines)->Unit(benchmark::kMillisecond);

void BM_FiveAxisLines(benchmark::State& state) {
  std::string text = "%1\nG90 G54 G43.4 H1 F2000\n";
  char line[160];
  for (int i = 0; i < blocks; ++i) {
    const double t = i * 0.001;
    std::snprintf(line, sizeof line, "N%d G01 X%.4f Y%.4f Z%.4f A%.4f C%.4f\n", 10 * (i + 1),
                  90 * std::sin(t), 90 * std::cos(t), 5 * std::sin(7 * t), 30 * std::sin(3 * t), 0.05 * i);
    text += line;
  }
  interpret(state, text + "M30\n");
}
BENCHMARK(BM_FiveAxisLines)->Unit(benchmark::kMillisecond);

/// A square, compensated on its inside, again and again: a corner in every block.
void BM_CompensatedContour(benchmark::State& state) {
  std::string text = "%1\nF2000 G41 D1 G1 X10 Y0\n";
  for (int i = 0; i < blocks / 4; ++i) text += "X90\nY90\nX10\nY10\n";
  interpret(state, text + "G40 X0 Y0\nM30\n");
}
BENCHMARK(BM_CompensatedContour)->Unit(benchmark::kMillisecond);

void BM_TurnedLines(benchmark::State& state) {
  std::string text = "%1\nG51 X0 Y0 Z0 P2\nG68 X5 Y5 R30\nG91 G1 F2000\n";
  for (int i = 0; i < blocks; ++i) text += i % 2 == 0 ? "X10. Y5.\n" : "X-10. Y-5.\n";
  interpret(state, text + "M30\n");
}
BENCHMARK(BM_TurnedLines)->Unit(benchmark::kMillisecond);

void BM_Arcs(benchmark::State& state) {
  std::string text = "%1\nG91 G17 F2000\n";
  for (int i = 0; i < blocks; ++i) text += i % 2 == 0 ? "G3 X-10. Y10. I-10. J0\n" : "G2 X10. Y-10. R10.\n";
  interpret(state, text + "M30\n");
}
BENCHMARK(BM_Arcs)->Unit(benchmark::kMillisecond);

/// A spiral computed block by block: nine lines a turn.
void BM_MacroLoop(benchmark::State& state) {
  constexpr int turns = 20000;
  const std::string text =
      "%1\nG90 G54 G1 F2000\n#1=0\n#2=0\n"
      "WHILE [#1 LT " +
      std::to_string(turns) +
      "] DO1\n"
      "#3=10+#1*0.001\n"
      "#4=#3*COS[#2]\n"
      "#5=#3*SIN[#2]\n"
      "G1 X#4 Y#5 Z[-#1/1000]\n"
      "#2=#2+1.5\n"
      "IF [#2 LT 360] GOTO 10\n"
      "#2=#2-360\n"
      "N10 #1=#1+1\n"
      "END1\nM30\n";
  // WHILE, 7 lines, N10 and END a turn; the line behind GOTO only once in 240.
  interpret(state, text, turns * 9);
}
BENCHMARK(BM_MacroLoop)->Unit(benchmark::kMillisecond);

/// The same with the branches and loops of HNC.
void BM_MacroBranches(benchmark::State& state) {
  constexpr int turns = 20000;
  const std::string text =
      "%1\nG90 G54 G1 F2000\n#1=0\n"
      "WHILE #1 LT " +
      std::to_string(turns) +
      "\n"
      "#2=#1 MOD 3\n"
      "IF #2 EQ 0\n"
      "G1 X#1\n"
      "ELSEIF #2 EQ 1\n"
      "G1 Y#1\n"
      "ELSE\n"
      "G1 Z#1\n"
      "ENDIF\n"
      "#1=#1+1\n"
      "ENDW\nM30\n";
  // Run are WHILE, MOD, IF, G1, #1, ENDW and of the other branches' beginnings and ENDIF two of three on
  // average.
  interpret(state, text, turns * 8);
}
BENCHMARK(BM_MacroBranches)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion::language
