// SPDX-License-Identifier: Apache-2.0
// Any bytes, in chunks of any size, read in every dialect: no crash, finite commands, and the same stream for
// every chunk size.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

constexpr int most_steps = 400;

struct ChunkedSource : TextSource {
  ChunkedSource(std::string_view text, std::size_t size) : whole(text), chunk(size) {}
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    if (chunk != 0 && ++reads % 3 == 0) return {ReadStatus::pending, 0};
    return whole.read(offset, buffer, chunk == 0 ? capacity : std::min(chunk, capacity));
  }
  StringSource whole;
  std::size_t chunk;
  unsigned reads = 0;
};

void require(bool condition) {
  if (!condition) std::abort();
}

void check(const Command& command) {
  for (const double value : command.target) require(std::isfinite(value));
  if (command.kind == CommandKind::arc) {
    require(command.arc.sweep > 0 && std::isfinite(command.arc.sweep));
    for (const double value : command.arc.centre) require(std::isfinite(value));
  }
  if (command.kind == CommandKind::line || command.kind == CommandKind::arc) require(command.modal.feed > 0);
}

struct Stepper {
  Stepper(Environment& machine, std::string_view text, std::size_t chunk, InterpreterOptions options)
      : source(text, chunk), interpreter(machine, options) {
    interpreter.start(source, {}, {});
  }
  /// The next command, end or alarm; working when the program goes on without one.
  Step next(Command& command) {
    Step step = Step::pending;
    while (step == Step::pending || step == Step::position || step == Step::answer || step == Step::value) {
      step = interpreter.next(command);
      if (step == Step::position) interpreter.set_position(skip);
      if (step == Step::answer) interpreter.answer(0);
      if (step == Step::value) interpreter.give_value(static_cast<double>(values++ % 3));
    }
    if (step == Step::command && command.kind == CommandKind::skip) skip = command.target;
    return step;
  }
  ChunkedSource source;
  Interpreter interpreter;
  AxisValues skip{};
  unsigned values = 0;
};

void interpret(const std::uint8_t* data, std::size_t size, ProgramDialect dialect) {
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  TestMachine machine;
  machine.dialect = dialect;
  machine.lengths = {{1, 100.0}, {2, 55.5}};
  machine.tools = {{3, {10, 0, 4, 0.1}}, {1, {100, 0, 5, 0}}};
  machine.further_references[2] = {1, 2, 3};
  machine.planes[1] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}};
  machine.last_way = {0.5, 0.5};
  machine.offsets[1] = {10, 20, 30, 0, 0, 45, 0, 0, 0};
  machine.added = {0.5, 0, -0.5};
  machine.setting_errors[1] = {1, 2, 3, 1, -2, 3};
  machine.axis_mask = 0b000111111;
  machine.programs["O0009"] = std::make_unique<StringSource>("G91 X1\n#100=#100+1\nM99\n");
  machine.programs["O0009.1"] = std::make_unique<StringSource>("G91 G1 F100 XL0\nL100=L100+1 G77 H8\n");
  machine.programs["O90120"] = std::make_unique<StringSource>("D#7\nG#[#10-10] X[#4-#4199] I#20 F#9\nM99\n");
  machine.programs["O90370"] = std::make_unique<StringSource>("G31 P#30 Z#26 F#29\n#[2000+#11]=#5063\nM99\n");
  machine.programs["O90800"] = std::make_unique<StringSource>(
      "IF [#2 EQ 0] THEN G69\nG68.3 X#5 Y#6 Z#7 I#8 J#9 K#10 P4\nG53.1\nM99\n");
  machine.programs["O0010"] = std::make_unique<StringSource>("o10 sub\nG91 X#1\no10 endsub [#1+1]\n");
  machine.programs["sub"] =
      std::make_unique<StringSource>("o<sub> sub\n#<a>=#1\no10 call [#<a>]\no<sub> endsub\n");
  machine.programs["USERDEF.CYC"] = std::make_unique<StringSource>(
      "%1007\nWHILE #1 LT #0\n#1=#1+1\nX#1\nENDW\nM99\n%1010\nIF AR[#7] EQ 0\nM99 P5\nENDIF\nG1007 "
      "A[#7]\nM99\n");
  machine.cycle_m_codes[3] = 130;
  machine.calls.g = {150};
  machine.calls.m = {70};
  machine.calls.m_subprograms = {60};
  machine.programs["O9010"] = std::make_unique<StringSource>("G91 X#24\nDPRNT[X#24[53] #16[10]]\nM99\n");
  machine.programs["O9020"] = std::make_unique<StringSource>("M60\nM70\nM98 P9 H2 L#1\nM99\n");
  machine.programs["O9001"] = std::make_unique<StringSource>("N1 #100=BCD[#100]\nG65 P9010 X1\nM99\n");
  const InterpreterOptions options{static_cast<SkipLevels>(data[0] >> 6), true};
  Stepper whole(machine, text, 0, options);
  Stepper pieces(machine, text, 1 + (data[0] & 63u), options);
  for (int i = 0; i < most_steps; ++i) {
    Command a;
    Command b;
    const Step step = whole.next(a);
    // Working depends on how often the reader had to ask, so the two may pass it at different calls.
    if (step == Step::working) break;
    Step other = pieces.next(b);
    for (int k = 0; other == Step::working && k < 8; ++k) other = pieces.next(b);
    require(step == other);
    if (step == Step::command) {
      check(a);
      require(a.kind == b.kind && a.line == b.line && a.sequence == b.sequence && a.target == b.target);
      require(a.sequence == static_cast<std::uint32_t>(i + 1));
      require(a.kind != CommandKind::print ||
              whole.interpreter.print_text() == pieces.interpreter.print_text());
      continue;
    }
    if (step == Step::alarm) {
      require(whole.interpreter.alarm().number == pieces.interpreter.alarm().number);
      require(whole.interpreter.alarm().line == pieces.interpreter.alarm().line);
      require(whole.interpreter.alarm().column == pieces.interpreter.alarm().column);
      require(whole.interpreter.alarm().text == pieces.interpreter.alarm().text);
      require(whole.interpreter.alarm().calls == pieces.interpreter.alarm().calls);
      for (std::size_t k = 0; k < max_nesting; ++k) {
        require(whole.interpreter.alarm().chain[k].line == pieces.interpreter.alarm().chain[k].line);
      }
    }
    break;
  }
  for (const Value& value : whole.interpreter.variables().common) {
    require(std::isfinite(value.number) && (value.given || value.number == 0));
  }
}

}  // namespace
}  // namespace trunnion::language::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::language;
  if (size == 0) return 0;
  test::interpret(data, size, ProgramDialect::iso);
  test::interpret(data, size, ProgramDialect::num);
  test::interpret(data, size, ProgramDialect::haas);
  test::interpret(data, size, ProgramDialect::linuxcnc);
  return 0;
}
