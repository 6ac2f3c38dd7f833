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

constexpr std::uint32_t measuring_cycle = 9960;  // CYCLE9960, which touches

/// Byte of the first of `letters` in the line; 0 when the block has none.
std::size_t first_of(const Block& block, std::uint32_t letters) {
  std::size_t first = SIZE_MAX;
  for (std::uint32_t rest = block.letters & letters; rest != 0; rest &= rest - 1)
    first = std::min<std::size_t>(first, block.offsets[static_cast<std::size_t>(std::countr_zero(rest))]);
  return first == SIZE_MAX ? 0 : first;
}

/// Byte of M`number` in the line; 0 when the block does not have it.
std::size_t m_offset(const Block& block, double number) {
  for (std::size_t i = 0; i < block.m_count; ++i)
    if (block.m[i].value == number) return block.m[i].offset;
  return 0;
}

WarningPlace place_of(const SeenBlock& seen, std::size_t offset) {
  return place_in(seen.program, seen.number, seen.line, offset);
}

}  // namespace

BlockChecks::BlockChecks(const language::Environment& environment, bool functions_known, Warnings& warnings)
    : warnings_(warnings),
      functions_known_(functions_known),
      makes_ready_(environment.two_tool_words() == language::TwoToolWords::change_and_ready),
      block_calls_(environment) {}

void BlockChecks::see(const SeenBlock& seen) {
  const Block& block = seen.block;
  program_ = seen.program, number_ = seen.number;
  offset_ = first_of(block, language::axis_bits);
  line_.assign(seen.line);
  one_block_ = 0;
  num_ = seen.dialect == language::ProgramDialect::num;
  const bool linuxcnc = is_linuxcnc(block);
  if (!num_ && !linuxcnc) check_condition(seen);
  const bool called = block.statement == language::Statement::call_cycle;
  probes_ = probes_ || (called && block.program_number == measuring_cycle);
  if (block.empty() && block.statement == language::Statement::none) return;
  if (seen.program == 0) last_line_ = seen.number, returns_ = has_m(block, 99);
  calls_ = block_calls_.find(seen) && block_calls_.takes_letters();
  if (calls_ || block.empty()) return;
  const SeenBlock rest{block_calls_.rest(), seen.line,     seen.program, seen.number,
                       seen.modal,          seen.position, seen.dialect};
  check_change(rest);
  check_length(rest);
  check_radius(rest);
  check_return(rest);
  check_m(rest);
  if (!num_ && !linuxcnc) check_cycle(rest);
  note(rest);
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
  // G31, G31.1 to G31.3; G38.2 and G38.3 of LinuxCNC.
  const FoundCode motion = code_of(block, Group::motion);
  probes_ =
      probes_ || (positions && tenths_of(*positions.code) / 10 == 31) || motion.is(382) || motion.is(383);
}

// M6 of other controls ends a cycle, here it goes on. A return may be the end of the program: it is named
// when a hole follows.
void BlockChecks::check_cycle(const SeenBlock& seen) {
  const Block& block = seen.block;
  check_cycle_level(seen);
  const bool ends = code_of(block, Group::cycle) || code_of(block, Group::motion);
  if (seen.modal.cycle == 80 || ends) {
    returned_.reset();
    return;
  }
  const auto warn = [&](const WarningPlace& place, std::uint32_t about, const char* at) {
    if (auto* const warning = warnings_.add(WarningKind::cycle_active, place, about))
      warning->detail = fmt::format("G{} at {}", seen.modal.cycle, at);
    returned_.reset();
  };
  const FoundCode code = code_of(block, Group::one_block);
  if (has_m(block, 6)) {
    warn(place_of(seen, m_offset(block, 6)), 6, "M6");
  } else if (code.is(280) || code.is(300)) {
    returned_ = place_of(seen, code.offset);
  } else if (returned_ && !code && (block.letters & (language::axis_bits | Block::bit('R'))) != 0) {
    warn(*returned_, 28, "G28 or G30");
  }
}

// In the plane that the spindle is square to. Where the block changes what Z means, and in a cycle that was
// active before with G91, its level is not known.
void BlockChecks::check_cycle_level(const SeenBlock& seen) {
  constexpr double noticed = 1e-3;  // mm
  const Block& block = seen.block;
  const FoundCode cycle = code_of(block, Group::cycle), plane = code_of(block, Group::plane);
  const bool begins = cycle && !cycle.is(800);
  const bool continues = !cycle && !code_of(block, Group::motion) && seen.modal.cycle != 80;
  const bool bores_back = begins ? cycle.is(870) : seen.modal.cycle == 87;
  const bool square = plane ? plane.is(170) : seen.modal.plane == language::Plane::xy;
  if (!block.has('R') || !(begins || continues) || bores_back || !square) return;
  for (const Group group : {Group::one_block, Group::tool_length, Group::work_offset, Group::scaling,
                            Group::mirror, Group::rotation, Group::setting_error})
    if (code_of(block, group)) return;
  if (block.has('L') && block.value('L') == 0) return;
  const bool absolute = absolute_in(seen);
  if (!absolute && seen.modal.cycle != 80) return;
  const double level = seen.position[language::Z];
  const double r = block.value('R') * length_scale_in(seen) + (absolute ? 0.0 : level);
  if (!(level < r - noticed)) return;
  if (auto* const warning = warnings_.add(WarningKind::cycle_below, place_of(seen, block.offset('R'))))
    warning->detail = fmt::format("Z is at {:.3f}, R at {:.3f} mm", level, r);
}

// A T may be in the block of its M6 or in one before.
void BlockChecks::check_change(const SeenBlock& seen) {
  const Block& block = seen.block;
  selected_ = selected_ || block.has('T');
  if (!has_m(block, 6)) return;
  if (!selected_) warnings_.add(WarningKind::change_without_tool, place_of(seen, m_offset(block, 6)));
  selected_ = block.two_tools && makes_ready_;
}

double BlockChecks::changed_to(const SeenBlock& seen) const {
  const Block& block = seen.block;
  if (!block.has('T')) return seen.modal.selected_tool;
  return block.value(block.two_tools && !makes_ready_ ? language::second_tool_word : 'T');
}

void BlockChecks::check_length(const SeenBlock& seen) {
  const Block& block = seen.block;
  const FoundCode length = code_of(block, Group::tool_length);
  if (!length || length.is(490) || !block.has('H')) return;
  double tool = seen.modal.tool;
  if (has_m(block, 6)) tool = changed_to(seen);
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
