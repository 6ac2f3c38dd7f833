// SPDX-License-Identifier: Apache-2.0
#include "language/modal_codes.hpp"

#include <cmath>
#include <cstdio>

#include "canonical/turning_speed.hpp"
#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

constexpr double metres_per_foot = 0.3048;

}  // namespace

Fault ModalCodes::stop_exactly(std::uint16_t) {
  output_.stop_exactly_once();
  return {};
}

Fault ModalCodes::set_units(std::uint16_t, bool metric) {
  state_.modal.metric = metric;
  return {};
}

Fault ModalCodes::set_feed_mode(std::uint16_t, FeedMode mode) {
  // A number of one mode is nonsense in another.
  if (mode != state_.modal.feed_mode) state_.modal.feed = 0;
  state_.modal.feed_mode = mode;
  return {};
}

// A code that gives the axis words a meaning of its own, or a cycle, moves at feed.
bool ModalCodes::takes_lead() const {
  // Its threads have their lead in K.
  if (words_.linuxcnc()) return false;
  const GCodes& g = words_.g();
  if (g.has(Group::one_block) && g.code(Group::one_block).axis_words == AxisWords::taken) return false;
  if (g.has(Group::motion))
    return g.is(Group::motion, 320) || g.is(Group::motion, 330) || g.is(Group::motion, 340);
  const bool cycle = g.has(Group::cycle) ? g.code(Group::cycle).tenths != 800 : state_.modal.cycle != 80;
  return !cycle && is_thread(state_.modal.motion);
}

bool ModalCodes::taps() const {
  const GCodes& g = words_.g();
  return g.is(Group::cycle, 840) || g.is(Group::one_block, 849);
}

Fault ModalCodes::feed_word() {
  const char lead_word = words_.lead_word();
  const bool has_lead = words_.has(lead_word) && takes_lead();
  if (has_lead) {
    words_.use(lead_word);
    const double lead = words_.value(lead_word);
    if (!(lead > 0)) return {AlarmNumber::thread_lead_missing, words_.offset(lead_word)};
    state_.thread_lead = lead * words_.length_scale();
  } else if (lead_word == 'K' && words_.has('K') && !taps()) {
    return {AlarmNumber::num_word, words_.offset('K')};
  }
  if (!words_.has('F') || (has_lead && lead_word == 'F')) return {};
  words_.use('F');
  const double feed = words_.value('F');
  if (!(feed > 0)) return {AlarmNumber::feed_not_positive, words_.offset('F')};
  const bool time = state_.modal.feed_mode == FeedMode::inverse_time;
  // LinuxCNC takes F before the units of its block.
  const bool metric = words_.linuxcnc() ? state_.at_block_begin().modal.metric : state_.modal.metric;
  state_.modal.feed = time || metric ? feed : feed * 25.4;
  return {};
}

Fault ModalCodes::set_spindle_mode(std::uint16_t, SpindleMode mode) {
  state_.modal.spindle_mode = mode;
  return {};
}

Fault ModalCodes::check_spindle_speed(double speed) {
  const double highest = environment_.highest_spindle_speed();
  if (highest == 0 || speed <= highest) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::spindle_speed_above;
  std::snprintf(detail.text.data(), detail.text.size(), "at most %.10g 1/min (%s)", highest,
                environment_.highest_speed_parameter());
  return {detail.number, words_.offset('S')};
}

// In whole 1/min, as the PLC has it, and not above the limit.
double ModalCodes::reached_speed(const ModalState& surface) const {
  return std::floor(canonical::turning_speed(surface.surface_speed, std::abs(state_.workpiece_position()[X]),
                                             speed_limit(surface)));
}

double ModalCodes::speed_limit(const ModalState& modal) const {
  return canonical::lower_limit(modal.spindle_limit, environment_.highest_spindle_speed());
}

Fault ModalCodes::spindle_word() {
  ModalState& modal = state_.modal;
  const ModalState& before = state_.at_block_begin().modal;
  const bool surface = modal.spindle_mode == SpindleMode::surface;
  const bool changes = modal.spindle_mode != before.spindle_mode;
  const bool limit = words_.g().is(Group::one_block, 920);
  const bool speed_given = words_.has('S') && !limit;
  // G97 without S: the spindle keeps the speed it has here.
  if (changes && !surface && !speed_given) modal.spindle_speed = reached_speed(before);
  if (words_.has('S')) {
    words_.use('S');
    const double speed = words_.value('S');
    if (speed < 0) return {AlarmNumber::value_range, words_.offset('S')};
    if (limit) {
      modal.spindle_limit = speed;
    } else if (surface) {
      modal.surface_speed = modal.metric ? speed : speed * metres_per_foot;
    } else {
      if (const Fault fault = check_spindle_speed(speed)) return fault;
      modal.spindle_speed = speed;
    }
  }
  if (surface) {
    const auto at = [&] {
      return words_.g().has(Group::spindle_mode) ? words_.g().offset(Group::spindle_mode)
                                                 : words_.offset('S');
    };
    if (!(modal.surface_speed > 0)) return {AlarmNumber::surface_speed_missing, at()};
    // At the centre of the spindle its speed would be beyond all measure.
    if (!(speed_limit(modal) > 0)) return {AlarmNumber::surface_speed_limit, at()};
  }
  const bool limited = surface && modal.spindle_limit != before.spindle_limit;
  if (speed_given || changes || limited)
    output_.push(CommandKind::spindle_speed).value = surface ? modal.surface_speed : modal.spindle_speed;
  return {};
}

Fault ModalCodes::tool_word() {
  // In a G10 without L the tool is the one the entry is for; nothing is selected.
  if (!words_.has('T') || (words_.g().is(Group::one_block, 100) && !words_.has('L'))) return {};
  std::uint32_t tool = 0;
  if (const Fault fault = words_.whole_number('T', 0, highest_tool, tool)) return fault;
  if (tool != 0 && !environment_.has_tool(tool)) return {AlarmNumber::tool_unknown, words_.offset('T')};
  state_.modal.selected_tool = static_cast<std::uint16_t>(tool);
  output_.push(CommandKind::tool).number = tool;
  return {};
}

Fault ModalCodes::set_plane(std::uint16_t at, Plane plane) {
  if (plane == state_.modal.plane) return {};
  if (state_.modal.rotated || state_.modal.polar) return {AlarmNumber::frame_plane, at};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  state_.modal.plane = plane;
  return {};
}

Fault ModalCodes::set_distance(std::uint16_t, bool absolute) {
  state_.modal.absolute = absolute;
  return {};
}

Fault ModalCodes::set_return_level(std::uint16_t, bool initial) {
  state_.modal.return_to_initial = initial;
  return {};
}

Fault ModalCodes::stop_at_every_end(std::uint16_t) {
  state_.modal.path_control = PathControl::exact_stop;
  return {};
}

Fault ModalCodes::set_continuous_path(std::uint16_t) {
  state_.modal.path_control = PathControl::continuous;
  state_.modal.path_tolerance = 0;
  for (const char letter : {'P', 'Q'}) {
    if (!words_.has(letter)) continue;
    const double tolerance = words_.length(letter);
    if (tolerance < 0) return {AlarmNumber::value_range, words_.offset(letter)};
    // Q allows merging collinear points; leaving every point in place stays within any Q.
    if (letter == 'P') state_.modal.path_tolerance = tolerance;
  }
  return {};
}

Fault ModalCodes::set_polar(std::uint16_t, bool on) {
  state_.modal.polar = on;
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  const double u = state_.program_position[plane.first];
  const double v = state_.program_position[plane.second];
  ProgramSettings& polar = state_.change_settings();
  polar.polar_centre = {};
  polar.polar_radius = std::hypot(u, v);
  polar.polar_angle = std::atan2(v, u) * degrees_per_radian;
  return {};
}

Fault ModalCodes::set_smoothing(std::uint16_t at) {
  if (!words_.has('Q')) return {AlarmNumber::missing_word, at, needs('Q')};
  std::uint32_t q = 0;
  if (const Fault fault = words_.whole_number('Q', 0, 2, q)) return fault;
  state_.modal.smoothing = static_cast<std::uint8_t>(q);
  return {};
}

Fault ModalCodes::set_motion(std::uint16_t, std::uint8_t motion) {
  state_.modal.motion = motion;
  state_.modal.cycle = 80;
  return {};
}

Fault ModalCodes::set_cycle(std::uint16_t, std::uint8_t cycle) {
  // The level a cycle comes back to is the one before the first of its kind.
  if (state_.modal.cycle == 80 && cycle != 80) {
    const double level = state_.program_position[plane_axes(state_.modal.plane).normal];
    state_.change_settings().cycle.hole.initial = level;
  }
  state_.modal.cycle = cycle;
  return {};
}

}  // namespace trunnion::language
