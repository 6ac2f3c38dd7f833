// SPDX-License-Identifier: Apache-2.0
#include "language/haas_dialect.hpp"

#include <algorithm>

#include "language/haas_codes.hpp"
#include "language/haas_variables.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

/// Turns the functions of a block that was read into those of g_codes and m_codes.
class HaasBlock {
 public:
  explicit HaasBlock(Block& block) : block_(block) {}

  Fault complete() {
    block_.haas = true;
    if (const Fault fault = complete_g_words()) return fault;
    if (const Fault fault = complete_m_words()) return fault;
    return check_tables();
  }

 private:
  Fault complete_g_words() {
    std::uint8_t kept = 0;
    for (std::size_t i = 0; i < block_.g_count; ++i) {
      CodeWord word = block_.g[i];
      const HaasCode* const code = haas_code(haas_g_codes, word.value);
      bool keep = true;
      if (code == nullptr) {
        refuse({AlarmNumber::haas_g_unknown, word.offset});
      } else {
        const auto written = static_cast<std::uint16_t>(word.value);
        if (const Fault fault = complete(*code, word, keep)) return fault;
        word.written = written;
      }
      if (keep) block_.g[kept++] = word;
    }
    block_.g_count = kept;
    return {};
  }

  Fault complete(const HaasCode& code, CodeWord& word, bool& keep) {
    constexpr double additional_offset = 54.1, before_first = 109;  // G110 is G154 P1
    const bool axes = (block_.letters & axis_bits) != 0;
    switch (code.use) {
      case HaasUse::not_here:
        refuse({AlarmNumber::haas_function_missing, word.offset, code.meaning});
        return {};
      case HaasUse::no_effect:
        keep = false;
        if (!calls()) block_.letters &= ~Block::bit('P');
        return {};
      case HaasUse::offset:
        block_.work_offset = static_cast<std::uint8_t>(word.value - before_first);
        word.value = additional_offset;
        return {};
      case HaasUse::machine:
        keep = axes;
        break;
      case HaasUse::reference:
        block_.every_axis = !axes;
        break;
      case HaasUse::mirror:
        if (const Fault fault = check_mirror()) return fault;
        break;
      case HaasUse::pattern:
        if (const Fault fault = check_pattern(code, word.offset)) return fault;
        break;
      default:
        break;
    }
    word.value = code.code;
    return {};
  }

  /// The first one counts.
  void refuse(const Fault& fault) {
    if (!block_.refused) block_.refused = fault;
  }

  /// M97 and M98 take P, and so does M99.
  bool calls() const {
    const auto is_call = [](const CodeWord& m) { return m.value >= 97 && m.value <= 99; };
    return std::any_of(block_.m.begin(), block_.m.begin() + block_.m_count, is_call);
  }

  /// The manual has only zero behind the letters: the mirror is about the zero of the program.
  Fault check_mirror() const {
    for (const char letter : axis_letters)
      if (block_.has(letter) && block_.value(letter) != 0)
        return {AlarmNumber::value_range, block_.offset(letter), "mirror about zero: the axis with 0"};
    return {};
  }

  Fault check_pattern(const HaasCode& code, std::uint16_t at) {
    for (const char letter : {'I', 'L'})
      if (!block_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
    if (code.first == 71 && !block_.has('K')) return {AlarmNumber::missing_word, at, needs('K')};
    if (!block_.has('J')) store('J', 0, at);
    return {};
  }

  Fault complete_m_words() {
    for (std::size_t i = 0; i < block_.m_count; ++i) {
      CodeWord& word = block_.m[i];
      const HaasCode* const code = haas_code(haas_m_codes, word.value);
      if (code == nullptr) continue;
      if (code->use == HaasUse::not_here) {
        refuse({AlarmNumber::haas_function_missing, word.offset, code->meaning});
        continue;
      }
      block_.local_call = block_.local_call || code->use == HaasUse::local_call;
      word.written = code->first;
      word.value = code->code;
    }
    return {};
  }

  /// P0 of G10 L2 is the offset of G52 there, and that which is added to all others here.
  Fault check_tables() const {
    const auto is_table = [](const CodeWord& g) { return g.value == 10; };
    const bool table = std::any_of(block_.g.begin(), block_.g.begin() + block_.g_count, is_table);
    const bool common =
        table && block_.has('L') && block_.value('L') == 2 && block_.has('P') && block_.value('P') == 0;
    return common ? Fault{AlarmNumber::value_range, block_.offset('P'), "P0 is G52: write G52"} : Fault{};
  }

  void store(char letter, double value, std::uint16_t at) {
    const auto index = static_cast<std::size_t>(letter - 'A');
    block_.letters |= Block::bit(letter);
    block_.values[index] = value;
    block_.offsets[index] = at;
  }

  Block& block_;
};

}  // namespace

DialectRules HaasDialect::rules() const {
  DialectRules rules;
  rules.number_counts = false;
  rules.system_number = haas_system_number;
  rules.tool_diameters = rules.tool_times = true;
  return rules;
}

Fault HaasDialect::read_block(std::string_view line, SkipLevels skip, Variables& variables,
                              Block& block) const {
  if (const Fault fault = words_.read_block(line, skip, variables, block)) return fault;
  return block.skipped ? Fault{} : HaasBlock(block).complete();
}

}  // namespace trunnion::language
