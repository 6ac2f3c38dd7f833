// SPDX-License-Identifier: Apache-2.0
#include "analysis/block_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

#include "analysis/block_codes.hpp"
#include "language/foreign_words.hpp"
#include "language/letters.hpp"

namespace trunnion::analysis {
namespace {

using language::Block;
using language::Group;
using language::SeenBlock;

/// Byte of the first of `letters` in the line; 0 when the block has none.
std::size_t first_of(const Block& block, std::uint32_t letters) {
  std::size_t first = SIZE_MAX;
  for (std::uint32_t rest = block.letters & letters; rest != 0; rest &= rest - 1)
    first = std::min<std::size_t>(first, block.offsets[static_cast<std::size_t>(std::countr_zero(rest))]);
  return first == SIZE_MAX ? 0 : first;
}

WarningPlace place_of(const SeenBlock& seen, std::size_t offset) {
  return place_in(seen.program, seen.number, seen.line, offset);
}

}  // namespace

BlockChecks::BlockChecks(const language::Environment& environment, bool functions_known, Warnings& warnings)
    : warnings_(warnings),
      functions_known_(functions_known),
      iso_(environment.program_dialect() != language::ProgramDialect::num) {
  for (std::size_t i = 0; i < cycle_m_codes_.size(); ++i)
    cycle_m_codes_[i] = iso_ ? environment.cycle_m_code(i) : std::uint16_t{0};
}

void BlockChecks::see(const SeenBlock& seen) {
  const Block& block = seen.block;
  program_ = seen.program, number_ = seen.number;
  offset_ = first_of(block, language::axis_bits);
  line_.assign(seen.line);
  one_block_ = 0;
  const bool linuxcnc = is_linuxcnc(block);
  if (iso_ && !linuxcnc) check_condition(seen);
  if (block.statement == language::Statement::call_cycle) probes_ = true;
  if (block.empty() && block.statement == language::Statement::none) return;
  if (seen.program == 0) last_line_ = seen.number, returns_ = has_m(block, 99);
  language::Call call;
  calls_ = !linuxcnc && language::find_call(block, cycle_m_codes_, call);
  if (calls_ || block.empty()) return;
  check_change(seen);
  check_length(seen);
  check_radius(seen);
  check_return(seen);
  check_m(seen);
  note(seen);
}

void BlockChecks::note(const SeenBlock& seen) {
  const Block& block = seen.block;
  const FoundCode positions = code_of(block, Group::one_block);
  if (positions) one_block_ = tenths_of(*positions.code);
  stated_.units = stated_.units || code_of(block, Group::units);
  stated_.distance = stated_.distance || code_of(block, Group::distance);
  stated_.work_offset = stated_.work_offset || code_of(block, Group::work_offset);
  // F of a search for references is its speed, and no feed.
  stated_.feed = stated_.feed || (block.has('F') && !positions.is(282) && !positions.is(1590));
  const FoundCode motion = code_of(block, Group::motion);
  probes_ = probes_ || positions.is(310) || motion.is(382) || motion.is(383);
}

// A T may be in the block of its M6 or in one before.
void BlockChecks::check_change(const SeenBlock& seen) {
  const Block& block = seen.block;
  selected_ = selected_ || block.has('T');
  if (!has_m(block, 6)) return;
  if (!selected_) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < block.m_count; ++i)
      if (block.m[i].value == 6) at = block.m[i].offset;
    warnings_.add(WarningKind::change_without_tool, place_of(seen, at));
  }
  selected_ = false;
}

void BlockChecks::check_length(const SeenBlock& seen) {
  const Block& block = seen.block;
  const FoundCode length = code_of(block, Group::tool_length);
  if (!length || length.is(490) || !block.has('H')) return;
  double tool = seen.modal.tool;
  if (has_m(block, 6)) tool = block.has('T') ? block.value('T') : seen.modal.selected_tool;
  const double entry = block.value('H');
  if (!(tool > 0) || !(entry > 0) || entry == tool) return;
  auto* const warning = warnings_.add(WarningKind::other_length, place_of(seen, block.offset('H')),
                                      static_cast<std::uint32_t>(tool));
  if (warning != nullptr) warning->detail = fmt::format("H{:g} with T{:g}", entry, tool);
}

void BlockChecks::check_radius(const SeenBlock& seen) {
  const Block& block = seen.block;
  const FoundCode side = code_of(block, Group::cutter_compensation);
  if (!side || side.is(400)) return;
  const bool of_spindle = is_linuxcnc(block) && !(block.has('D') && block.value('D') != 0);
  const double entry = of_spindle       ? seen.modal.tool
                       : block.has('D') ? block.value('D')
                                        : seen.modal.radius_offset;
  if (entry != 0) return;
  warnings_.add(WarningKind::radius_missing,
                place_of(seen, block.has('D') ? block.offset('D') : side.offset));
}

// G28 Z0 is meant as "from here"; with G90 it goes to Z0 of the workpiece first.
void BlockChecks::check_return(const SeenBlock& seen) {
  const Block& block = seen.block;
  const FoundCode code = code_of(block, Group::one_block);
  if ((!code.is(280) && !code.is(300)) || !absolute_in(seen)) return;
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    const char letter = language::axis_letters[axis];
    if (canonical::is_rotary(axis) || !block.has(letter) || block.value(letter) != 0) continue;
    auto* const warning = warnings_.add(WarningKind::return_over_zero, place_of(seen, block.offset(letter)));
    if (warning != nullptr) warning->detail = fmt::format("G{} {}0", tenths_of(*code.code) / 10, letter);
    return;
  }
}

// Of a machine that is known the codes that it does not have are alarms.
void BlockChecks::check_m(const SeenBlock& seen) {
  const Block& block = seen.block;
  for (std::size_t i = 0; i < block.m_count; ++i) {
    const double value = block.m[i].value;
    if (!(value >= 0 && value <= language::highest_m)) continue;
    const auto number = static_cast<std::uint32_t>(value);
    spindle_by_logic_ = spindle_by_logic_ || number == 13 || number == 14;
    if (functions_known_) continue;
    const auto* const word = language::foreign_m(number);
    if (word == nullptr) continue;
    auto* const warning = warnings_.add(WarningKind::foreign_m, place_of(seen, block.m[i].offset), number);
    if (warning != nullptr)
      warning->detail =
          fmt::format("M{} of {}: {}. Here: {}", number, word->control, word->meaning, word->here);
  }
}

void BlockChecks::check_condition(const SeenBlock& seen) {
  const auto condition = condition_of(seen.line);
  if (condition.empty()) return;
  const auto at = static_cast<std::size_t>(condition.data() - seen.line.data()) +
                  std::min(condition.find_first_not_of(" \t"), condition.size());
  if (!in_brackets(condition)) warnings_.add(WarningKind::condition_brackets, place_of(seen, at));
  if (mixes_order(condition)) warnings_.add(WarningKind::condition_order, place_of(seen, at));
}

}  // namespace trunnion::analysis
