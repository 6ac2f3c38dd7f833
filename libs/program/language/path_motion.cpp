// SPDX-License-Identifier: Apache-2.0
#include "language/path_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

/// A helix lower than this (mm) is a circle.
constexpr double no_height = 1e-9;
constexpr std::uint32_t most_turns = 9999;
/// Of the speed of an axis: it must be able to follow a spindle that turns somewhat faster than S.
constexpr double thread_share = 0.95;

/// What LinuxCNC allows half the chord above a radius R, mm.
constexpr double linuxcnc_radius = 0.00127;

/// What LinuxCNC allows between the radii of an arc, mm, of which the one at the start is `radius`: a part in
/// a thousand, but between a hundredth and the whole of 2.83 mm, or 7.18 mm in inches.
double linuxcnc_deviation(bool metric, double radius) {
  const double most = metric ? 2 * std::numbers::sqrt2 : 0.2 * std::numbers::sqrt2 * 25.4;
  return std::clamp(0.001 * radius, most / 100, most);
}

}  // namespace

Fault PathMotion::move() {
  constexpr std::uint32_t arc_bits = letter_bits("IJKR");
  constexpr std::uint32_t vector_bits = letter_bits("IJK");
  const ModalState& modal = state_.modal;
  if (is_thread(modal.motion)) return cut_thread();
  const bool arc = modal.motion == 2 || modal.motion == 3;
  const bool drawn = words_.has(angle_word) && modal.motion == 1 && !modal.tool_vector;
  const std::uint32_t moving =
      words_.letters() & (axis_bits | (arc ? arc_bits : 0u) | (modal.tool_vector ? vector_bits : 0u) |
                          (drawn ? Block::bit(angle_word) : 0u));
  if (moving == 0) return {};
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  const std::uint16_t at = words_.offset_of_any(moving);
  if (modal.motion != 0) {
    if (const Fault fault = check_feed(at)) return fault;
  }
  AxisValues target = programmed_target(axes);
  const CommandKind kind = arc                 ? CommandKind::arc
                           : modal.motion == 1 ? CommandKind::line
                                               : CommandKind::rapid;
  std::optional<Corner> corner;
  if (const Fault fault = read_corner(corner)) return fault;
  if (drawn || state_.line_open) {
    DrawnEnd end{target};
    if (const Fault fault = complete_line(at, drawn, axes, corner, end)) return fault;
    if (end.waits) return {};
    target = end.target;
  }
  const bool cornered = modal.motion != 0 && !modal.tool_vector && (corner || output_.holds_corner());
  if (!arc && !modal.tool_vector && !cornered) return output_.move_straight({kind}, target);
  std::optional<Vector3> direction;
  std::uint16_t vector_at = 0;
  if (modal.tool_vector) {
    if (const Fault fault = vectors_.read(direction, vector_at)) return fault;
  }
  Command made;
  if (arc) {
    if (const Fault fault = find_arc(target, at, made.arc)) return fault;
  }
  if (cornered) {
    made.kind = kind;
    return output_.move_with_corner(made, target, corner);
  }
  if (direction && !output_.compensating()) {
    made.kind = kind;
    state_.to_command_frame(made);
    return vectors_.lead(kind, made.arc, *direction, vector_at, state_.command_from_program(target));
  }
  if (direction) {
    if (const Fault fault = vectors_.point(*direction, vector_at, target)) return fault;
  }
  return arc ? move_on_arc(made.arc, target) : output_.move_straight({kind}, target);
}

Fault PathMotion::complete_line(std::uint16_t at, bool drawn, std::uint32_t axes,
                                const std::optional<Corner>& corner, DrawnEnd& end) {
  if (state_.line_open) return drawn ? close_line(at, axes, end.target) : Fault{AlarmNumber::angle_open, at};
  words_.use(angle_word);
  const std::uint16_t angle_at = words_.offset(angle_word);
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  const bool first = ((axes >> plane.first) & 1u) != 0, second = ((axes >> plane.second) & 1u) != 0;
  if (state_.modal.polar)
    return {AlarmNumber::angle_undetermined, angle_at, "not in polar coordinates (G16)"};
  if (!first && !second) {
    end.waits = true;
    return open_line(axes, corner);
  }
  const DrawnLine line(in_plane(state_.program_position, plane), words_.value(angle_word));
  const Vector2 words = in_plane(end.target, plane);
  if (first && second) {
    if (line.distance(words) <= radius_deviation_) return {};
    return {AlarmNumber::angle_undetermined, angle_at, "it does not pass through the end"};
  }
  const std::optional<Vector2> point = first ? line.at_first(words.u) : line.at_second(words.v);
  if (!point) return {AlarmNumber::angle_undetermined, angle_at, "it never reaches the coordinate"};
  end.target[plane.first] = point->u;
  end.target[plane.second] = point->v;
  return {};
}

Fault PathMotion::open_line(std::uint32_t axes, const std::optional<Corner>& corner) {
  if (axes != 0)
    return {AlarmNumber::angle_undetermined, words_.offset(angle_word), "needs a coordinate of the plane"};
  const ModalState& modal = state_.modal;
  const CommandOutput::Place place = output_.place();
  OpenLine open;
  open.degrees = words_.value(angle_word);
  open.corner = corner;
  open.program = place.program;
  open.line = place.line;
  open.frame = state_.frame().revision();
  open.plane = modal.plane;
  open.side = modal.cutter_side;
  open.modes = MoveModes::of(modal);
  state_.change_settings().open_line = open;
  state_.line_open = true;
  return {};
}

// The second block has its end and its angle, so the corner is where both lines meet.
Fault PathMotion::close_line(std::uint16_t at, std::uint32_t axes, const AxisValues& target) {
  words_.use(angle_word);
  const OpenLine open = state_.settings().open_line;
  const ModalState& modal = state_.modal;
  const PlaneAxes plane = plane_axes(modal.plane);
  const bool whole = axes == ((1u << plane.first) | (1u << plane.second)) && modal.absolute && !modal.polar;
  const bool same =
      open.plane == modal.plane && open.side == modal.cutter_side && open.frame == state_.frame().revision();
  if (!whole || !same) return {AlarmNumber::angle_open, at};
  const DrawnLine first(in_plane(state_.program_position, plane), open.degrees);
  const auto corner = first.meets(DrawnLine(in_plane(target, plane), words_.value(angle_word)));
  if (!corner)
    return {AlarmNumber::angle_undetermined, words_.offset(angle_word), "parallel to the line before"};
  state_.line_open = false;
  return move_to_corner(open, *corner);
}

// As its own block would have made it.
Fault PathMotion::move_to_corner(const OpenLine& open, Vector2 corner) {
  const PlaneAxes plane = plane_axes(open.plane);
  AxisValues end = state_.program_position;
  end[plane.first] = corner.u;
  end[plane.second] = corner.v;
  const CommandOutput::Place here = output_.place();
  const MoveModes now = MoveModes::of(state_.modal);
  output_.set_place({open.program, open.line});
  open.modes.give_to(state_.modal);
  Fault fault;
  if (open.corner || output_.holds_corner()) {
    Command made;
    made.kind = CommandKind::line;
    fault = output_.move_with_corner(made, end, open.corner);
  } else {
    fault = output_.move_straight({CommandKind::line}, end);
  }
  now.give_to(state_.modal);
  output_.set_place(here);
  return fault;
}

Fault PathMotion::cut_thread() {
  if ((words_.letters() & axis_bits) == 0) return {};
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  const std::uint16_t at = words_.offset_of_any(axis_bits);
  // On NUM controls a block that continues a thread has its end and perhaps its lead, and nothing else.
  if (words_.lead_word() == 'K' && !words_.g().has(Group::motion)) {
    if (words_.has_codes()) return {AlarmNumber::num_word, words_.first_offset()};
    if (words_.shows_message()) return {AlarmNumber::num_word, at};
    const std::uint32_t others = words_.letters() & ~(axis_bits | letter_bits("KN"));
    if (others != 0) return {AlarmNumber::num_word, words_.offset_of_any(others)};
  }
  if (const Fault fault = check_thread(at)) return fault;
  StraightMove move{CommandKind::thread};
  move.value = state_.thread_lead;
  move.number = words_.thread() == ThreadBlock::chained ? 0 : 1;
  if (state_.modal.motion == 34) {
    if (!words_.has('K')) return {AlarmNumber::missing_word, at, needs('K')};
    move.lead_change = words_.length('K');
  }
  if (words_.has('Q')) {
    words_.use('Q');
    move.start_angle = words_.value('Q');
    if (!(move.start_angle >= 0 && move.start_angle < 360))
      return {AlarmNumber::value_range, words_.offset('Q'), "degrees, from 0 to below 360"};
  }
  const AxisValues target = programmed_target(axes);
  if (words_.has(taught_angle_word)) {
    if (const Fault fault = resume_thread(target, move.start_angle)) return fault;
  }
  if (const Fault fault = check_lead(at, state_.command_from_program(target), move)) return fault;
  if (words_.thread() == ThreadBlock::alone) output_.stop_exactly_once();
  return output_.move_straight(move, target);
}

Fault PathMotion::thread_to(std::uint16_t at, double lead, const AxisValues& target, bool begins) {
  state_.thread_lead = lead;
  if (const Fault fault = check_thread(at)) return fault;
  StraightMove move{CommandKind::thread};
  move.value = lead;
  move.number = begins ? 1 : 0;
  if (const Fault fault = check_lead(at, state_.command_from_program(target), move)) return fault;
  return output_.move_straight(move, target);
}

// On the pitch line the spindle has the taught angle where the axis with the lead is at the taught place.
Fault PathMotion::resume_thread(const AxisValues& target, double& start_angle) {
  const AxisValues end = state_.command_from_program(target);
  AxisValues way{};
  std::size_t axis = X;
  for (std::size_t a = 0; a < axis_count; ++a) {
    if (is_rotary(a)) continue;
    way[a] = end[a] - state_.position[a];
    if (std::abs(way[a]) > std::abs(way[axis])) axis = a;
  }
  const double farthest = std::abs(way[axis]);
  const auto leads = [&](std::size_t a) { return farthest - std::abs(way[a]) <= no_distance; };
  double distance = 0;
  if (words_.has('J')) {
    // Of axes that go equally far the one in whose direction J is.
    for (std::size_t a = 0; a < axis_count; ++a) {
      if (is_rotary(a) || !leads(a) || (way[a] > 0) != (words_.value('J') > 0)) continue;
      axis = a;
      break;
    }
    distance = words_.along('J', axis);
  } else {
    axis = words_.has(taught_x_word) ? X : Z;
    const char word = axis == X ? taught_x_word : taught_z_word;
    if (!leads(axis))
      return {AlarmNumber::num_thread_data, words_.offset(word),
              axis == X ? "X does not go farthest" : "Z does not go farthest"};
    distance = words_.along(word, axis) - state_.program_position[axis];
  }
  words_.use(taught_angle_word);
  const bool clockwise = state_.modal.spindle_direction == SpindleDirection::cw;
  const double taught = words_.value(taught_angle_word);
  const double turns = (way[axis] > 0 ? distance : -distance) / state_.thread_lead;
  start_angle = std::fmod((clockwise ? taught : -taught) - 360 * turns, 360.0);
  if (start_angle < 0) start_angle += 360;
  if (!(start_angle > 0 && start_angle < 360)) start_angle = 0;
  return {};
}

Fault PathMotion::check_thread(std::uint16_t at) const {
  const ModalState& modal = state_.modal;
  const char* obstacle = modal.tilt.active                              ? "a tilted plane is active"
                         : modal.transformation == Transformation::rtcp ? "tool tip control is active"
                         : output_.compensating()                       ? "cutter compensation is active"
                         : modal.feed_mode == FeedMode::inverse_time    ? "G93 is active"
                         : modal.spindle_mode == SpindleMode::surface   ? "G96 is active"
                                                                        : nullptr;
  if (obstacle != nullptr) return {AlarmNumber::thread_impossible, at, obstacle};
  if (!(state_.thread_lead > 0)) return {AlarmNumber::thread_lead_missing, at};
  const bool turns = modal.spindle_direction != SpindleDirection::stopped && modal.spindle_speed > 0;
  return turns ? Fault{} : Fault{AlarmNumber::thread_spindle_stopped, at};
}

// The lead grows evenly with the angle, so its square grows evenly along the thread.
Fault PathMotion::check_lead(std::uint16_t at, const AxisValues& target, const StraightMove& move) {
  AxisValues way{};
  double farthest = 0;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    way[axis] = std::abs(target[axis] - state_.position[axis]);
    if (is_rotary(axis) && way[axis] > no_distance)
      return {AlarmNumber::thread_impossible, at, "a rotary axis moves"};
    if (!is_rotary(axis)) farthest = std::max(farthest, way[axis]);
  }
  if (!(farthest > no_distance)) return {};
  const double square = move.value * move.value + 2 * move.lead_change * farthest;
  if (!(square > 0)) return {AlarmNumber::thread_lead_change, at};
  const double lead = std::max(move.value, std::sqrt(square));
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (is_rotary(axis)) continue;
    const double feed = lead * state_.modal.spindle_speed * (way[axis] / farthest);
    const double highest = thread_share * environment_.highest_feed(axis);
    if (highest == 0 || feed <= highest) continue;
    FaultDetail& detail = context_.detail;
    detail.number = AlarmNumber::thread_speed;
    std::snprintf(detail.text.data(), detail.text.size(), "%c %.7g mm/min, at most %.7g", axis_letters[axis],
                  feed, highest);
    return {detail.number, at};
  }
  return {};
}

// In a rapid and with a tool vector the words have no meaning, which BlockWords reports.
Fault PathMotion::read_corner(std::optional<Corner>& corner) {
  if (state_.modal.motion == 0 || state_.modal.tool_vector) return {};
  for (const char word : {chamfer_word, rounding_word}) {
    if (!words_.has(word)) continue;
    if (corner) return {AlarmNumber::codes_compete, words_.offset(word)};
    const double size = words_.length(word);
    if (size < 0) return {AlarmNumber::value_range, words_.offset(word)};
    corner = Corner{word == chamfer_word ? Corner::Kind::chamfer : Corner::Kind::rounding, size};
  }
  if (corner && corner->size == 0) corner.reset();
  return {};
}

Fault PathMotion::set_turns(const AxisValues& target, Arc& arc) {
  const std::uint8_t normal = plane_axes(arc.plane).normal;
  const char lead_letter = static_cast<char>('I' + normal);
  if (words_.linuxcnc()) {
    // LinuxCNC has no meaning for the word; posts that write all three letters write 0.
    if (words_.has(lead_letter) && words_.value(lead_letter) == 0) words_.use(lead_letter);
    return {};
  }
  if (!words_.has(lead_letter) || (state_.modal.tool_vector && words_.has('R'))) return {};
  // The third centre letter is the lead of a helix: how far it goes in a turn, hence how many turns. Posts
  // that write all three letters write 0, which says nothing, also of an arc in the plane.
  const double height = std::abs(target[normal] - state_.program_position[normal]);
  if (height < no_height && words_.value(lead_letter) != 0) return {};
  const double lead = std::abs(words_.length(lead_letter));
  if (words_.has('L') || lead == 0) return {};
  if (height / lead > most_turns) return {AlarmNumber::value_range, words_.offset(lead_letter)};
  const double turns = std::round(height / lead - arc.sweep / 360);
  if (turns > 0) arc.sweep += 360 * turns;
  return {};
}

Fault PathMotion::find_arc(const AxisValues& target, std::uint16_t at, Arc& arc) {
  arc.plane = state_.modal.plane;
  arc.clockwise = state_.modal.motion == 2;
  if (!state_.frame().keeps_circles(arc.plane)) return {AlarmNumber::arc_scaled_unequally, at};
  if (const Fault fault = find_circle(target, at, arc)) return fault;
  if (const Fault fault = set_turns(target, arc)) return fault;
  const AxisValues middle{arc.centre[0], arc.centre[1], arc.centre[2], 0, 0, 0, 0, 0, 0};
  const AxisValues contour_centre = state_.frame().contour_from_program(middle);
  arc.centre = {contour_centre[X], contour_centre[Y], contour_centre[Z]};
  if (state_.frame().flips(arc.plane)) arc.clockwise = !arc.clockwise;
  return {};
}

// With G43.5 and R the letters I J K are the tool's.
Fault PathMotion::find_circle(const AxisValues& target, std::uint16_t& at, Arc& arc) {
  const bool vector = state_.modal.tool_vector && words_.has('R');
  const PlaneAxes plane = plane_axes(arc.plane);
  const AxisValues& start = state_.program_position;
  const bool absolute = state_.modal.absolute_centres;
  std::array<double, 3> centre_offset{};
  bool centre = false;
  const bool linuxcnc = words_.linuxcnc();
  char absent = '\0';
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const char letter = static_cast<char>('I' + axis);
    if (!words_.has(letter) || vector) {
      absent = letter;
      continue;
    }
    at = words_.offset(letter);
    centre_offset[axis] = words_.length(letter) - (absolute ? start[axis] : 0);
    centre = true;
  }
  if (absolute && centre && absent != '\0') return {AlarmNumber::missing_word, at, needs(absent)};
  std::uint32_t turns = 1;
  const char turn_letter = linuxcnc ? 'P' : 'L';
  if (words_.has(turn_letter)) {
    if (const Fault fault = words_.whole_number(turn_letter, 1, most_turns, turns)) return fault;
  }
  if (words_.has('R')) {
    at = words_.offset('R');
    const double radius = words_.length('R');
    if (centre) return {AlarmNumber::arc_centre_and_radius, at};
    const double deviation = linuxcnc ? linuxcnc_radius : radius_deviation_;
    return {arc_from_radius(start, target, radius, turns, deviation, arc), at};
  }
  if (!centre) {
    const bool modal = !words_.g().has(Group::motion);
    return {AlarmNumber::arc_centre_missing, at,
            modal ? "R, I, J and K hold for their block alone" : nullptr};
  }
  const double radius = std::hypot(centre_offset[plane.first], centre_offset[plane.second]);
  const double deviation = linuxcnc ? linuxcnc_deviation(state_.modal.metric, radius) : radius_deviation_;
  const AlarmNumber number = arc_from_centre(start, target, centre_offset, turns, deviation, arc);
  if (number == AlarmNumber::arc_radii_differ) note_radii(target, arc);
  return {number, at};
}

void PathMotion::note_radii(const AxisValues& target, const Arc& arc) {
  const PlaneAxes plane = plane_axes(arc.plane);
  const auto radius = [&](const AxisValues& point) {
    return std::hypot(point[plane.first] - arc.centre[plane.first],
                      point[plane.second] - arc.centre[plane.second]);
  };
  const double start = radius(state_.program_position), end = radius(target);
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::arc_radii_differ;
  std::snprintf(detail.text.data(), detail.text.size(), "%.4f and %.4f mm, %.4f mm apart", start, end,
                std::abs(start - end));
}

Fault PathMotion::move_on_arc(const Arc& arc, const AxisValues& target) {
  Command command;
  command.kind = CommandKind::arc;
  command.arc = arc;
  if (output_.compensating()) return output_.move_compensated(command, target);
  const AxisValues end = state_.command_from_program(target);
  if (output_.turns_in_plane(end)) return {AlarmNumber::plane_rotary, 0};
  state_.to_command_frame(command);
  state_.reach(end, target);
  output_.push(CommandKind::arc).arc = command.arc;
  return {};
}

}  // namespace trunnion::language
