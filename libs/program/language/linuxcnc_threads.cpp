// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_threads.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace trunnion::language {
namespace {

constexpr double shortest_ngc_tap = 0.001;  // mm
constexpr double steepest_slide = 80;       // degrees
constexpr std::uint32_t most_springs = 99;
constexpr std::uint32_t taper_in = 1, taper_out = 2;  // bits of L

}  // namespace

Fault LinuxcncThreads::read_lead(std::uint16_t at, double& lead) {
  if (words_.has('F')) return {AlarmNumber::unused_word, words_.offset('F')};
  if (!words_.has('K')) return {AlarmNumber::missing_word, at, needs('K')};
  lead = words_.length('K');
  return lead > 0 ? Fault{} : Fault{AlarmNumber::thread_lead_missing, words_.offset('K')};
}

double LinuxcncThreads::lead_of_farthest(double lead, const AxisValues& target) const {
  const AxisValues end = state_.command_from_program(target);
  double farthest = 0, square = 0;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (is_rotary(axis)) continue;
    const double way = std::abs(end[axis] - state_.position[axis]);
    farthest = std::max(farthest, way);
    square += way * way;
  }
  return square > 0 ? lead * farthest / std::sqrt(square) : lead;
}

Fault LinuxcncThreads::cut(std::uint16_t at) {
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  double lead = 0;
  if (const Fault fault = read_lead(at, lead)) return fault;
  const AxisValues target = programmed_target(axes);
  return motion_.thread_to(at, lead_of_farthest(lead, target), target, true);
}

Fault LinuxcncThreads::tap(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  if (axes != (1u << X) && axes != (1u << Y) && axes != (1u << Z))
    return {AlarmNumber::linuxcnc_function_missing, at, "G33.1 along more than one of X Y Z"};
  double lead = 0, return_speed = 0;
  if (const Fault fault = read_lead(at, lead)) return fault;
  ModalState& modal = state_.modal;
  const SpindleDirection turned = modal.spindle_direction;
  const bool speed = modal.spindle_mode == SpindleMode::speed && modal.spindle_speed > 0;
  if (!speed || turned == SpindleDirection::stopped) return {AlarmNumber::thread_spindle_stopped, at};
  if (const Fault fault = read_return(return_speed)) return fault;
  const AxisValues start = state_.program_position, bottom = programmed_target(axes);
  double depth = 0;
  for (const std::size_t axis : {X, Y, Z}) depth = std::max(depth, std::abs(bottom[axis] - start[axis]));
  if (depth < shortest_ngc_tap) return {AlarmNumber::value_range, words_.offset_of_any(axis_bits)};
  const bool clockwise = turned == SpindleDirection::cw;
  // A spindle is coupled at standstill.
  modal.spindle_direction = SpindleDirection::stopped;
  output_.push(CommandKind::auxiliary).number = 5;
  StraightMove stroke{CommandKind::tap};
  stroke.value = clockwise ? lead : -lead;
  stroke.hole_speed = return_speed;
  if (const Fault fault = output_.move_straight(stroke, bottom)) return fault;
  stroke.spindle_speed = return_speed;
  if (const Fault fault = output_.move_straight(stroke, start)) return fault;
  modal.spindle_direction = turned;
  output_.push(CommandKind::auxiliary).number = clockwise ? 3 : 4;
  return {};
}

// An I below 1 is 1 for LinuxCNC.
Fault LinuxcncThreads::read_return(double& speed) {
  if (!words_.has('I')) return {};
  words_.use('I');
  if (!(words_.value('I') > 1)) return {};
  speed = words_.value('I') * state_.modal.spindle_speed;
  const double highest = environment_.highest_spindle_speed();
  if (highest == 0 || speed <= highest) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::spindle_speed_above;
  std::snprintf(detail.text.data(), detail.text.size(), "S times I %.6g, at most %.6g 1/min (%s)", speed,
                highest, environment_.highest_speed_parameter());
  return {detail.number, words_.offset('I')};
}

Fault LinuxcncThreads::begin_passes(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  ThreadPasses::Words words;
  if (const Fault fault = read_passes(at, words)) return fault;
  if (const Fault fault = check_passes(at, words)) return fault;
  state_.thread_lead = words.pitch;
  if (const Fault fault = motion_.check_thread(at)) return fault;
  passes_.start(words);
  at_ = at;
  context_.activity = Activity::passes;
  return {};
}

double LinuxcncThreads::height(char letter) {
  return words_.length(letter) * (environment_.diameter_programming() ? 0.5 : 1.0);
}

Fault LinuxcncThreads::read_passes(std::uint16_t at, ThreadPasses::Words& words) {
  if (state_.modal.plane != Plane::zx)
    return {AlarmNumber::linuxcnc_function_missing, at, "G76 outside of G18"};
  for (const char letter : {'P', 'Z', 'I', 'J', 'K'})
    if (!words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
  const std::uint32_t others = words_.letters() & axis_bits & ~Block::bit('Z');
  if (others != 0) return {AlarmNumber::unused_word, words_.offset_of_any(others)};
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  words.start_x = state_.program_position[X];
  words.start_z = state_.program_position[Z];
  words.end_z = programmed_target(axes)[Z];
  words.pitch = words_.length('P');
  words.peak = height('I');
  words.first = height('J');
  words.height = height('K');
  if (words_.has('R')) {
    words_.use('R');
    words.degression = words_.value('R');
  }
  if (words_.has('Q')) {
    words_.use('Q');
    words.angle = words_.value('Q');
  }
  if (words_.has('H')) {
    if (const Fault fault = words_.whole_number('H', 0, most_springs, words.springs)) return fault;
  }
  return read_taper(words);
}

Fault LinuxcncThreads::read_taper(ThreadPasses::Words& words) {
  std::uint32_t ends = 0;
  if (words_.has('L')) {
    if (const Fault fault = words_.whole_number('L', 0, taper_in | taper_out, ends)) return fault;
  }
  words.taper_in = (ends & taper_in) != 0;
  words.taper_out = (ends & taper_out) != 0;
  words.taper = words_.length('E');
  const double half = std::abs(words.end_z - words.start_z) / 2;
  const bool good = words.taper >= 0 && words.taper <= half;
  return good ? Fault{} : Fault{AlarmNumber::value_range, words_.offset('E'), "0 to half of the way along Z"};
}

Fault LinuxcncThreads::check_passes(std::uint16_t at, const ThreadPasses::Words& words) const {
  const auto out_of_range = [&](char letter, const char* why) {
    return Fault{AlarmNumber::value_range, words_.offset(letter), why};
  };
  if (!(words.pitch > 0)) return {AlarmNumber::thread_lead_missing, words_.offset('P')};
  if (words.peak == 0) return out_of_range('I', "the thread needs a distance from the start");
  if (!(words.first > 0)) return out_of_range('J', "above 0");
  if (!(words.height > words.first)) return out_of_range('K', "above J");
  if (!(words.degression >= 1)) return out_of_range('R', "at least 1");
  if (!(words.angle >= 0 && words.angle <= steepest_slide)) return out_of_range('Q', "0 to 80 degrees");
  if (!(std::abs(words.end_z - words.start_z) > no_distance))
    return out_of_range('Z', "the thread has no length");
  if (!(ThreadPasses::passes_before_full(words) <= ThreadPasses::most_passes))
    return {AlarmNumber::value_range, words_.has('R') ? words_.offset('R') : at, "more than 9999 passes"};
  return {};
}

Fault LinuxcncThreads::next_pass() {
  ThreadPasses::Pass pass;
  const ThreadPasses::Words& words = passes_.words();
  if (!passes_.next(pass)) {
    context_.activity = Activity::none;
    return rapid_to(words.start_x, words.end_z);
  }
  if (const Fault fault = rapid_to(pass.away_x, pass.begin_z)) return fault;
  if (const Fault fault = rapid_to(pass.begin_x, pass.begin_z)) return fault;
  // An exact stop would begin another thread where a taper ends.
  const PathControl control = std::exchange(state_.modal.path_control, PathControl::continuous);
  Fault fault;
  if (pass.tapered_in) fault = thread_to(pass.bottom_x, pass.bottom_from_z, true);
  if (!fault) fault = thread_to(pass.bottom_x, pass.bottom_to_z, !pass.tapered_in);
  if (!fault && pass.tapered_out) fault = thread_to(pass.end_x, pass.end_z, false);
  state_.modal.path_control = control;
  return fault ? fault : rapid_to(pass.away_x, pass.end_z);
}

Fault LinuxcncThreads::rapid_to(double x, double z) {
  AxisValues target = state_.program_position;
  target[X] = x;
  target[Z] = z;
  return output_.move_straight({CommandKind::rapid}, target);
}

// Along Z the lead is the pitch in a taper, too.
Fault LinuxcncThreads::thread_to(double x, double z, bool begins) {
  AxisValues target = state_.program_position;
  const double along = std::abs(z - target[Z]), across = std::abs(x - target[X]);
  target[X] = x;
  target[Z] = z;
  const double pitch = passes_.words().pitch;
  return motion_.thread_to(at_, across > along ? pitch * across / along : pitch, target, begins);
}

}  // namespace trunnion::language
