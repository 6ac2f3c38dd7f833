// SPDX-License-Identifier: Apache-2.0
#include "analysis/program_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/block_codes.hpp"
#include "language/arc_geometry.hpp"
#include "language/codes.hpp"
#include "language/foreign_words.hpp"

namespace trunnion::analysis {
namespace {

using language::AxisValues;
using language::Command;
using language::CommandKind;
using language::SeenBlock;

constexpr std::size_t most_named = 1000;  // of a list: a program of another kind could fill the memory
constexpr std::uint32_t tool_change = 6;
constexpr double seconds_of_minute = 60;
constexpr double highest_program = 999999999;
constexpr std::array<std::uint16_t, 4> machine_places = {270, 280, 300, 530};  // tenths of the codes

WarningPlace line_of(const Command& command) { return {command.program, command.line, 1}; }

void add_once(std::vector<std::uint16_t>& list, std::uint16_t value) {
  if (value == 0 || list.size() == most_named) return;
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// The entry when it is the first of its name; else null.
NamedFigure* add_named(std::vector<NamedFigure>& list, const std::string& name, const SeenBlock& seen,
                       std::size_t offset) {
  for (NamedFigure& known : list) {
    if (known.name != name) continue;
    ++known.blocks;
    return nullptr;
  }
  if (list.size() == most_named) return nullptr;
  const auto place = place_in(seen.program, seen.number, seen.line, offset);
  return &list.emplace_back(NamedFigure{name, place, 1, {}});
}

std::string g_name(const language::GCode& code) {
  const unsigned tenths = tenths_of(code), whole = tenths / 10u, tenth = tenths % 10u;
  return tenth == 0 ? fmt::format("G{}", whole) : fmt::format("G{}.{}", whole, tenth);
}

bool is_pattern(std::uint16_t tenths) {
  return tenths == 700 || tenths == 710 || tenths == 780 || tenths == 790;
}

/// s of a way, begun and ended at rest.
double rapid_seconds(double way, const motion::AxisLimits& limits) {
  const double speed = limits.rapid_velocity, acceleration = limits.acceleration;
  if (!(way > 0) || !(speed > 0) || !(acceleration > 0)) return 0;
  const bool reaches = way >= speed * speed / acceleration;
  return reaches ? way / speed + speed / acceleration : 2 * std::sqrt(way / acceleration);
}

}  // namespace

void Range::include(double value) {
  low = any ? std::min(low, value) : value;
  high = any ? std::max(high, value) : value;
  any = true;
}

std::string work_offset_name(std::size_t index) {
  constexpr std::size_t first_numbers = 6, first_code = 54;
  return index < first_numbers ? fmt::format("G{}", first_code + index)
                               : fmt::format("G54.1 P{}", index - first_numbers + 1);
}

ProgramFigures::ProgramFigures(const language::Environment& environment,
                               const channel_setup::ChannelSetup* machine,
                               const language::MFunctions* functions)
    : machine_(machine), functions_(functions), block_calls_(environment) {}

void ProgramFigures::begin(const SeenBlock& seen) {
  block_program_ = seen.program, block_line_ = seen.number;
  in_machine_coordinates_ = false;
  if (seen.block.statement == language::Statement::call_cycle)
    add_named(calls_, fmt::format("CYCLE{}", seen.block.program_number), seen, seen.block.at);
  if (seen.block.empty() || note_calls(seen)) return;
  note_codes(
      {block_calls_.rest(), seen.line, seen.program, seen.number, seen.modal, seen.position, seen.dialect});
}

bool ProgramFigures::note_calls(const SeenBlock& seen) {
  note_subprograms(seen);
  if (!block_calls_.find(seen)) return false;
  language::Call call = block_calls_.call();
  const bool complete = call.by_code || !language::read_call(seen.block, call);
  if (!complete || call.kind == language::CallKind::modal_cancel) return true;
  const bool cycle = call.kind == language::CallKind::cycle;
  const std::string name =
      cycle ? fmt::format("G{}", call.number) : std::string(language::ProgramName(call.number).view());
  add_named(calls_, name, seen, call.offset);
  return block_calls_.takes_letters();
}

// Of M98 with Q alone, and of Haas' M97, the sequence number of the same program.
void ProgramFigures::note_subprograms(const SeenBlock& seen) {
  const auto& block = seen.block;
  const bool label = block.called == 0 && (block.local_call || !block.has('P'));
  const char letter = block.has('P') ? 'P' : 'Q';
  if (block.called == 0 && !block.has(letter)) return;
  const double word = block.called != 0 ? block.called : block.value(letter);
  if (!(word >= 0 && word <= highest_program)) return;
  for (std::size_t i = 0; i < block.m_count; ++i) {
    if (block.m[i].value != 98 && block.m[i].value != 198) continue;
    const auto number = static_cast<std::uint32_t>(word);
    const std::string name =
        label ? fmt::format("N{}", number) : std::string(language::ProgramName(number).view());
    add_named(calls_, name, seen, block.m[i].offset);
  }
}

bool ProgramFigures::is_unknown(std::uint16_t m) const {
  const bool flow = language::m_code(m).group == language::MGroup::flow;
  return functions_ != nullptr && !flow && !language::is_granted(m) && !functions_->has(m);
}

void ProgramFigures::note_codes(const SeenBlock& seen) {
  const auto& block = seen.block;
  for (std::size_t i = 0; i < block.g_count; ++i) {
    const auto* const code = g_code_of(block, block.g[i]);
    if (code == nullptr) continue;
    const std::uint16_t tenths = tenths_of(*code);
    const bool drills = code->group == language::Group::cycle && tenths != 800;
    if (drills || is_pattern(tenths)) add_named(cycles_, g_name(*code), seen, block.g[i].offset);
    const bool to_machine =
        std::find(machine_places.begin(), machine_places.end(), tenths) != machine_places.end();
    in_machine_coordinates_ = in_machine_coordinates_ || to_machine;
    const char* const reason = code->no_effect;
    if (reason == nullptr) continue;
    if (auto* const named = add_named(without_effect_, g_name(*code), seen, block.g[i].offset))
      named->text = reason;
  }
  for (std::size_t i = 0; i < block.m_count; ++i) {
    const double value = block.m[i].value;
    if (!(value >= 0 && value <= language::highest_m) || value != std::floor(value)) continue;
    const auto number = static_cast<std::uint16_t>(value);
    if (functions_ == nullptr) {
      const bool flow = language::m_code(number).group == language::MGroup::flow;
      if (!flow && !language::is_named_m(number))
        add_named(other_m_, fmt::format("M{}", number), seen, block.m[i].offset);
      continue;
    }
    if (!is_unknown(number)) continue;
    auto* const named = add_named(unknown_m_, fmt::format("M{}", number), seen, block.m[i].offset);
    const auto* const word = language::foreign_m(number);
    if (named != nullptr && word != nullptr)
      named->text = fmt::format("{}: {}. Here: {}", word->control, word->meaning, word->here);
  }
}

ToolFigures& ProgramFigures::tool(const Command& command) {
  const std::uint16_t number = command.modal.tool;
  if (tool_ < tools_.size() && tools_[tool_].number == number) return tools_[tool_];
  const auto found = std::find_if(tools_.begin(), tools_.end(),
                                  [&](const ToolFigures& known) { return known.number == number; });
  tool_ = static_cast<std::size_t>(found - tools_.begin());
  if (found == tools_.end()) {
    tools_.emplace_back();
    tools_.back().number = number;
    tools_.back().first = line_of(command);
  }
  return tools_[tool_];
}

void ProgramFigures::see(const Command& command, const Command& move, const AxisValues& from,
                         const std::optional<Motion>& motion, const language::Interpreter& interpreter) {
  if (command.kind == CommandKind::dwell) time_.dwell += command.dwell_seconds;
  if (command.kind == CommandKind::print) ++printed_;
  if (command.kind == CommandKind::auxiliary && command.number == tool_change) {
    ++changes_;
    ++tool(command).changes;
    if (machine_ != nullptr) time_.change += machine_->tool_change_seconds();
  }
  if (!motion) return;
  ToolFigures& used = tool(command);
  add_once(used.lengths, command.modal.length_offset);
  if (command.modal.cutter_side != language::CutterSide::off)
    add_once(used.radii, command.modal.radius_offset);
  if (motion->kind == CommandKind::rapid)
    note_rapid(*motion, used);
  else
    note_feed(command, *motion, used);
  note_tip(command, from, interpreter);
  if (machine_ == nullptr) return;
  const auto box = channel_setup::extent_of(from, move, machine_->chain());
  if (axes_)
    axes_->include(box);
  else
    axes_ = box;
}

// From place to place at rest: rapids are not joined.
void ProgramFigures::note_rapid(const Motion& motion, ToolFigures& tool) {
  rapid_length_ += motion.length;
  if (machine_ == nullptr) return;
  double seconds = 0;
  for (const auto axis : machine_->channel_axes().index) {
    const double way = std::abs(motion.mcs[axis] - motion.from[axis]);
    seconds = std::max(seconds, rapid_seconds(way, machine_->limits().axes[axis]));
  }
  tool.rapid += seconds;
  time_.rapid += seconds;
}

void ProgramFigures::note_feed(const Command& command, const Motion& motion, ToolFigures& tool) {
  const auto& modal = command.modal;
  cut_length_ += motion.length;
  const bool turns = modal.spindle_mode == language::SpindleMode::speed && modal.spindle_speed > 0 &&
                     modal.spindle_direction != language::SpindleDirection::stopped;
  if (turns) {
    tool.speed.include(modal.spindle_speed);
    if (modal.spindle_speed > highest_speed_.value) highest_speed_ = {modal.spindle_speed, line_of(command)};
  }
  if (!motion.feed || !(*motion.feed > 0)) return;
  const double seconds = motion.counted / *motion.feed * seconds_of_minute;
  tool.cut += seconds;
  time_.cut += seconds;
  tool.feed.include(*motion.feed);
  if (*motion.feed > highest_feed_.value) highest_feed_ = {*motion.feed, line_of(command)};
}

// A rapid comes from anywhere: its begin is the end of the move before.
void ProgramFigures::note_tip(const Command& command, const AxisValues& from,
                              const language::Interpreter& interpreter) {
  const bool current = command.program == block_program_ && command.line == block_line_;
  if (current && in_machine_coordinates_) return;
  OffsetFigures& figures = offsets_[command.modal.work_offset];
  Command place = command;
  const auto include = [&](const AxisValues& point) {
    place.target = point;
    const AxisValues at = interpreter.workpiece(place);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      figures.low[axis] = figures.used ? std::min(figures.low[axis], at[axis]) : at[axis];
      figures.high[axis] = figures.used ? std::max(figures.high[axis], at[axis]) : at[axis];
    }
    figures.used = true;
  };
  include(command.target);
  if (command.kind != CommandKind::rapid) include(from);
  if (command.kind != CommandKind::arc) return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double share : language::turning_shares(from, command.arc, axis))
      if (share > 0) include(language::point_on_arc(from, command.target, command.arc, share));
}

std::optional<double> ProgramFigures::reserve(std::size_t axis) const {
  constexpr double without_end = 1e9;
  if (machine_ == nullptr || !axes_) return std::nullopt;
  const auto& travel = machine_->travel(static_cast<std::uint8_t>(axis));
  if (travel.positive - travel.negative > without_end) return std::nullopt;
  return std::min(axes_->low[axis] - travel.negative, travel.positive - axes_->high[axis]);
}

}  // namespace trunnion::analysis
