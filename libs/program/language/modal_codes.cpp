// SPDX-License-Identifier: Apache-2.0
#include "language/modal_codes.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "canonical/turning_speed.hpp"
#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

constexpr double metres_per_foot = 0.3048;

/// Machining modes, as ModalState::smoothing.
constexpr std::uint8_t usual_mode = 0, high_precision = 1, high_speed = 2;

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
    // At the centre of the spindle its speed would be beyond all measure. LinuxCNC has the limit of the
    // machine, and there may be no machine.
    const bool unknown = words_.linuxcnc() && environment_.m_functions() == nullptr;
    if (!(speed_limit(modal) > 0) && !unknown) return {AlarmNumber::surface_speed_limit, at()};
  }
  const bool limited = surface && modal.spindle_limit != before.spindle_limit;
  if (speed_given || changes || limited)
    output_.push(CommandKind::spindle_speed).value = surface ? modal.surface_speed : modal.spindle_speed;
  return {};
}

Fault ModalCodes::tool_word() {
  // In a G10 without L the tool is the one the entry is for; nothing is selected.
  if (!words_.has('T') || (words_.g().is(Group::one_block, 100) && !words_.has('L'))) return {};
  if (!words_.two_tools()) return select_tool('T');
  switch (environment_.two_tool_words()) {
    case TwoToolWords::refused:
      break;
    case TwoToolWords::last:
      words_.use('T');
      return select_tool(second_tool_word);
    case TwoToolWords::change_and_ready:
      return select_tool('T');
  }
  return {AlarmNumber::two_tools, words_.offset(second_tool_word)};
}

Fault ModalCodes::ready_tool() {
  if (!words_.two_tools() || words_.used(second_tool_word)) return {};
  return select_tool(second_tool_word);
}

Fault ModalCodes::select_tool(char word) {
  std::uint32_t tool = 0;
  if (const Fault fault = words_.whole_number(word, 0, highest_tool, tool)) return fault;
  if (tool != 0 && !environment_.has_tool(tool)) return {AlarmNumber::tool_unknown, words_.offset(word)};
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

Fault ModalCodes::set_centres(std::uint16_t, bool absolute) {
  state_.modal.absolute_centres = absolute;
  return {};
}

Fault ModalCodes::set_return_level(std::uint16_t, bool initial) {
  state_.modal.return_to_initial = initial;
  return {};
}

void ModalCodes::set_path_control(PathControl control, bool accurate) {
  state_.modal.path_control = control;
  state_.accurate_path = accurate;
  set_mode(state_.machining_mode);
}

// G61.1 needs one of high precision: the program's own, or that of G5.1 Q1.
void ModalCodes::set_mode(std::uint8_t mode) {
  state_.machining_mode = mode;
  state_.modal.smoothing = state_.accurate_path && mode == usual_mode ? high_precision : mode;
}

Fault ModalCodes::stop_at_every_end(std::uint16_t) {
  set_path_control(PathControl::exact_stop, false);
  return {};
}

Fault ModalCodes::set_accurate_path(std::uint16_t) {
  set_path_control(PathControl::continuous, true);
  state_.modal.path_tolerance = 0;
  return {};
}

Fault ModalCodes::follow_path(std::uint16_t) {
  set_path_control(PathControl::continuous, false);
  state_.modal.path_tolerance = 0;
  return {};
}

Fault ModalCodes::set_continuous_path(std::uint16_t at) {
  follow_path(at);
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

// P10000 is the high-precision contour control of Fanuc, P1 to P3 the high-speed machining of Mitsubishi and
// Mazak.
Fault ModalCodes::set_contour_control(std::uint16_t at) {
  constexpr std::uint32_t highest_high_speed = 3, contour_control = 10000, highest = 99999;
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t p = 0;
  if (const Fault fault = words_.whole_number('P', 0, highest, p)) return fault;
  if (p > highest_high_speed && p != contour_control)
    return {AlarmNumber::value_range, words_.offset('P'), "G5 takes P0, P1 to P3 and P10000"};
  set_mode(p == 0 ? usual_mode : p == contour_control ? high_precision : high_speed);
  return {};
}

Fault ModalCodes::set_smoothing(std::uint16_t at) {
  constexpr std::uint32_t highest_level = 10, highest_speed_level = 5;
  if (!words_.has('Q')) return {AlarmNumber::missing_word, at, needs('Q')};
  std::uint32_t q = 0;
  if (const Fault fault = words_.whole_number('Q', 0, 3, q)) return fault;
  if (q >= high_speed) {
    if (const Fault fault = take_named_axes()) return fault;
  }
  auto mode = static_cast<std::uint8_t>(q < high_speed ? q : high_speed);
  // R counts from speed to precision. Beside other words it is theirs.
  const bool alone = words_.g().present() == group_bit(Group::smoothing) &&
                     (words_.letters() & axis_bits) == 0 && state_.modal.cycle == 80;
  if (q == 1 && alone && words_.has('R')) {
    std::uint32_t level = 0;
    if (const Fault fault = words_.whole_number('R', 1, highest_level, level)) return fault;
    if (level <= highest_speed_level) mode = high_speed;
  }
  set_mode(mode);
  return {};
}

// With Q2 and Q3 a Fanuc control takes X0 Y0 Z0 for the axes whose path it smooths, and moves nothing.
Fault ModalCodes::take_named_axes() {
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0 && words_.axis(axis) != 0)
      return {AlarmNumber::value_range, words_.offset(axis_letters[axis]),
              "only names an axis here: write 0"};
  }
  words_.use_axes();
  return {};
}

Fault ModalCodes::set_look_ahead(std::uint16_t at) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t p = 0;
  if (const Fault fault = words_.whole_number('P', 0, 1, p)) return fault;
  set_mode(p == 0 ? usual_mode : high_precision);
  return {};
}

// P1 roughs, P3 finishes.
Fault ModalCodes::set_finish(std::uint16_t) {
  constexpr std::array<std::uint8_t, 3> modes{usual_mode, high_speed, high_precision};
  std::uint32_t p = 1;
  if (words_.has('P')) {
    if (const Fault fault = words_.whole_number('P', 1, modes.size(), p)) return fault;
  }
  const double tolerance = words_.length('E');
  if (tolerance < 0) return {AlarmNumber::value_range, words_.offset('E')};
  set_mode(modes[p - 1]);
  state_.modal.path_tolerance = tolerance;
  return {};
}

Fault ModalCodes::pass_condition(std::uint16_t) {
  words_.use('P');
  words_.use('Q');
  return {};
}

Fault ModalCodes::set_motion(std::uint16_t, std::uint8_t motion) {
  state_.modal.motion = motion;
  state_.modal.cycle = 80;
  return {};
}

Fault ModalCodes::set_cycle(std::uint16_t, std::uint8_t cycle) {
  if (cycle != 80) {
    const double level = state_.program_position[plane_axes(state_.modal.plane).normal];
    state_.change_settings().cycle.begin(state_.modal.cycle, cycle, level);
  }
  state_.modal.cycle = cycle;
  return {};
}

}  // namespace trunnion::language
