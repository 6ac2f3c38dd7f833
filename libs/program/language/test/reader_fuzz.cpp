// SPDX-License-Identifier: Apache-2.0
// Any line, read in every dialect: no crash, words within their range, and a look at a line agrees with
// reading it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "language/decimal.hpp"
#include "language/foreign_words.hpp"
#include "language/interpreter.hpp"

namespace trunnion::language {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

struct NoSystem : SystemVariables {
  AlarmNumber read(const VariableRange&, std::uint32_t index, Value& value) const override {
    value = Value::of(index);
    return AlarmNumber::none;
  }
  AlarmNumber write(const VariableRange&, std::uint32_t, Value) override { return AlarmNumber::none; }
  AlarmNumber read_linuxcnc(LinuxcncValue, std::uint32_t index, double& value) const override {
    value = index;
    return AlarmNumber::none;
  }
};

/// What an outline says of the text behind the word of a line that a jump may pass.
void check_behind(const Outline& outline, const Block& block, const Fault& fault) {
  const bool passed = block.statement == Statement::else_ || block.statement == Statement::end_if ||
                      block.statement == Statement::end_while || block.statement == Statement::end_do ||
                      block.statement == Statement::end_repeat;
  const bool of_the_rest =
      fault.number == AlarmNumber::text_behind_statement || fault.number == AlarmNumber::open_comment;
  if (block.skipped || block.head != Head::none || !passed || (fault && !of_the_rest)) return;
  require(outline.statement == block.statement);
  require(outline.behind.number == fault.number && outline.behind.offset == fault.offset);
}

/// What can be read as a block is never text in front of a program.
void check_leader(const Dialect& dialect, std::string_view line, const Block& block, const Fault& fault) {
  const Leader leader = dialect.leader(line);
  if (leader.mark != Leader::no_mark)
    require(leader.passes && leader.mark < line.size() && line[leader.mark] == '%');
  const bool means = block.has_more() || block.statement != Statement::none || block.head == Head::program;
  if (!fault && !block.skipped && means && (leader.mark == Leader::no_mark || block.head == Head::none))
    require(!leader.passes);
}

/// Wherever in the line a fault is, what is found begins in it.
void check_foreign(const Fault& fault, std::string_view line) {
  for (const std::size_t offset : {std::size_t{fault.offset}, line.size() / 2, line.size()}) {
    const Fault there{fault.number, static_cast<std::uint16_t>(offset)};
    std::uint16_t at = there.offset;
    const ForeignWord* const word = find_foreign_word(there, line, at);
    require(word == nullptr ? at == there.offset : at < line.size());
  }
}

void check(const Dialect& dialect, std::string_view line, SkipLevels skip, Variables& variables,
           Block& block) {
  const Outline outline = dialect.outline(line, skip);
  const Fault fault = dialect.read_block(line, skip, variables, block);
  check_behind(outline, block, fault);
  check_leader(dialect, line, block, fault);
  if (fault) {
    require(fault.offset <= line.size());
    const Alarm alarm = make_alarm(fault, line, 0, 1);
    require(alarm.text.back() == '\0');
    check_foreign(fault, line);
    return;
  }
  for (std::size_t i = 0; i < 26; ++i) {
    if (((block.letters >> i) & 1u) != 0) require(std::abs(block.values[i]) <= largest_number);
  }
  require(block.g_count <= max_g_codes && block.m_count <= max_m_codes &&
          block.centre_count <= max_call_centres);
  if (block.head == Head::none) {
    const bool found = is_structure(block.statement) || outline.name != 0;
    require(found ? outline.statement == block.statement : outline.statement == Statement::none);
    require(outline.name == 0 || outline.name == block.name);
  }
  if (block.statement == Statement::begin_do || block.statement == Statement::end_do) {
    require(outline.label == block.label);
  }
  if (!block.skipped && block.head == Head::none && block.has('N') && block.value('N') >= 0 &&
      block.value('N') == std::floor(block.value('N'))) {
    require(outline.sequence_number == static_cast<std::uint32_t>(block.value('N')) ||
            !line.starts_with('N'));
  }
  if (block.statement == Statement::else_if) {
    bool condition = false;
    static_cast<void>(dialect.read_condition(line, block.rest, variables, condition));
  }
}

}  // namespace
}  // namespace trunnion::language

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::language;
  static NoSystem system;
  static Variables variables(system);
  static Block block;
  variables.start(no_variables);
  std::string_view text(reinterpret_cast<const char*>(data), size);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end <= max_line_length) {
      for (const auto name :
           {ProgramDialect::iso, ProgramDialect::num, ProgramDialect::linuxcnc, ProgramDialect::haas})
        check(Interpreter::dialect_of(name), text.substr(0, end), 0b10, variables, block);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
}
