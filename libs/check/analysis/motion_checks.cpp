// SPDX-License-Identifier: Apache-2.0
#include "analysis/motion_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <string>

namespace trunnion::analysis {
namespace {

using language::AxisValues;
using language::Command;
using language::CommandKind;

constexpr double noticed_way = 0.1;    // mm of a rapid, along Z and beside it
constexpr double noticed_turn = 1e-6;  // mm, degrees
constexpr std::uint16_t rotary_axes = 1u << language::A | 1u << language::B | 1u << language::C;
// Codes of the block in tenths.
constexpr std::array<std::uint16_t, 3> swings = {531, 532, 536};

bool at_feed(CommandKind kind) {
  return kind == CommandKind::line || kind == CommandKind::arc || kind == CommandKind::tap ||
         kind == CommandKind::thread || kind == CommandKind::skip;
}

bool cuts(CommandKind kind) { return kind == CommandKind::line || kind == CommandKind::arc; }

double farthest(const AxisValues& from, const AxisValues& to, std::initializer_list<std::size_t> axes) {
  double most = 0;
  for (const auto axis : axes) most = std::max(most, std::abs(to[axis] - from[axis]));
  return most;
}

}  // namespace

MotionChecks::MotionChecks(const language::Environment& environment, bool lengths_known,
                           const BlockChecks& blocks, Warnings& warnings)
    : environment_(environment),
      blocks_(blocks),
      warnings_(warnings),
      lengths_known_(lengths_known),
      several_rotary_(std::popcount(static_cast<unsigned>(environment.axes() & rotary_axes)) > 1) {}

void MotionChecks::see(const Command& command, const AxisValues& from, const std::optional<Motion>& motion) {
  const auto& modal = command.modal;
  if (modal.tool != tool_) tool_ = modal.tool, length_seen_ = false;
  length_seen_ = length_seen_ || modal.length_offset != 0;
  if (command.kind == CommandKind::end) ended_ = command.number != 0;
  probes_ = probes_ || command.kind == CommandKind::skip || command.kind == CommandKind::cycle;
  if (!motion || command.kind == CommandKind::home) return;
  const std::uint16_t code = blocks_.has(command) ? blocks_.one_block() : std::uint16_t{0};
  if (code == 0) check_stated(command);
  if (std::find(swings.begin(), swings.end(), code) != swings.end()) return;
  const double down = from[language::Z] - command.target[language::Z];
  if (command.kind == CommandKind::rapid && code == 0) check_rapid(command, from, *motion);
  if (!at_feed(command.kind)) return;
  check_feed(command);
  check_spindle(command);
  if (code == 0) check_length(command, down);
  check_tip(command, from);
  note_cut(command, from, *motion);
}

// With compensation the moves come behind blocks that are read ahead.
WarningPlace MotionChecks::place(const Command& command) const {
  return blocks_.has(command) ? blocks_.place() : WarningPlace{command.program, command.line, 1};
}

void MotionChecks::check_stated(const Command& command) {
  if (head_checked_) return;
  head_checked_ = true;
  const Stated& stated = blocks_.stated();
  std::string missing;
  const auto add = [&](bool there, const char* codes) {
    if (!there) missing += fmt::format("{}{}", missing.empty() ? "" : ", ", codes);
  };
  add(stated.units, blocks_.num() ? "G70 or G71" : "G20 or G21");
  add(stated.distance, "G90 or G91");
  add(stated.work_offset || blocks_.num(), "G54 to G59");
  if (missing.empty()) return;
  if (auto* const warning = warnings_.add(WarningKind::head, place(command))) warning->detail = missing;
}

void MotionChecks::check_feed(const Command& command) {
  const bool takes_default = cuts(command.kind) && command.modal.feed_mode == language::FeedMode::per_minute;
  if (!takes_default || blocks_.stated().feed || !environment_.feeds_without_word()) return;
  if (auto* const warning = warnings_.add(WarningKind::feed_missing, place(command)))
    warning->detail = fmt::format("it has {:g} mm/min (040030)", environment_.default_feed());
}

void MotionChecks::check_spindle(const Command& command) {
  if (first_feed_seen_ || !cuts(command.kind)) return;
  first_feed_seen_ = true;
  const bool turns = command.modal.spindle_direction != language::SpindleDirection::stopped;
  if (!turns && !blocks_.spindle_by_logic()) without_spindle_ = place(command);
}

// In ZX it is a lathe, whose tools have their place in the table and no length.
void MotionChecks::check_length(const Command& command, double down) {
  const auto& modal = command.modal;
  const bool expected = tool_ != 0 && !length_seen_ && modal.plane != language::Plane::zx &&
                        modal.transformation == language::Transformation::none;
  if (!expected || !(down > noticed_turn)) return;
  const double length = environment_.tool_length(tool_).value_or(0);
  if (lengths_known_ && length == 0) return;
  auto* const warning = warnings_.add(WarningKind::length_missing, place(command), tool_);
  if (warning == nullptr) return;
  warning->detail =
      lengths_known_ ? fmt::format("T{} is {:g} mm long", tool_, length) : fmt::format("T{}", tool_);
}

void MotionChecks::check_tip(const Command& command, const AxisValues& from) {
  const bool free = command.modal.transformation == language::Transformation::none;
  if (!several_rotary_ || !free || !cuts(command.kind)) return;
  if (farthest(from, command.target, {language::A, language::B, language::C}) <= noticed_turn) return;
  if (farthest(from, command.target, {language::X, language::Y, language::Z}) <= noticed_turn) return;
  warnings_.add(WarningKind::tip_control, place(command));
}

void MotionChecks::check_rapid(const Command& command, const AxisValues& from, const Motion& motion) {
  const auto& modal = command.modal;
  const double down = from[language::Z] - command.target[language::Z];
  const double beside = farthest(from, command.target, {language::X, language::Y});
  const bool known = cut_ && modal.work_offset == cut_offset_ && modal.plane != language::Plane::zx;
  if (!known || !(down > noticed_way) || !(beside > noticed_way)) return;
  const double end = motion.wcs[language::Z];
  if (!(end < cut_level_ - noticed_turn)) return;
  if (auto* const warning = warnings_.add(WarningKind::rapid_down, place(command)))
    warning->detail = fmt::format("to Z{:.3f}, at Z{:.3f} it has cut", end, cut_level_);
}

// The lower end of a move at feed that goes sideways: a plunge begins in the air.
void MotionChecks::note_cut(const Command& command, const AxisValues& from, const Motion& motion) {
  const double beside = farthest(from, command.target, {language::X, language::Y});
  const bool sideways = command.kind == CommandKind::arc || beside > noticed_way;
  if (!cuts(command.kind) || !sideways || command.modal.tilt.active) return;
  const double down = from[language::Z] - command.target[language::Z];
  const double end = motion.wcs[language::Z], level = std::min(end, end + down);
  const bool same = cut_ && command.modal.work_offset == cut_offset_;
  cut_level_ = same ? std::max(cut_level_, level) : level;
  cut_offset_ = command.modal.work_offset;
  cut_ = true;
}

void MotionChecks::end(bool whole) {
  if (without_spindle_ && !probes_ && !blocks_.probes())
    warnings_.add(WarningKind::spindle_stopped, *without_spindle_);
  if (whole && !ended_ && !blocks_.returns())
    warnings_.add(WarningKind::end_missing, {0, blocks_.last_line(), 1});
}

}  // namespace trunnion::analysis
