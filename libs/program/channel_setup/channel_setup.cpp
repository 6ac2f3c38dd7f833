// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/channel_setup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compensation/channel_compensation.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/gantry_pairs.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::channel_setup {
namespace {

constexpr double straight_on = 180;  // degrees: interior angle and turn of a corner together
constexpr int first_plane = 17;      // G17

// An axis that the chain turns and that nothing moves would stay at zero without a word.
void check_chain_axes(const geometry::Chain& chain, const machine::ChannelAxes& axes, std::uint16_t channel) {
  for (std::size_t i = 0; i < geometry::angle_count; ++i) {
    const auto letter = language::A + i;
    if (!chain.turns(i) || std::find(axes.index.begin(), axes.index.end(), letter) != axes.index.end())
      continue;
    const auto at = static_cast<std::uint32_t>(letter);
    throw machine::KinematicsError(
        alarm::kinematics_invalid,
        "parameter " + machine::number_text(parameter::channel_axis.number(channel, at)) + " (" +
            parameter::channel_axis.name + "): the kinematic chain of channel " + std::to_string(channel) +
            " turns " + language::axis_letters[letter] + ", which is no axis of the channel (parameters " +
            machine::number_text(parameter::head_type.number(channel)) + ", " +
            machine::number_text(parameter::table_type.number(channel)) + ")");
  }
}

constexpr const char* usual_functions = "3 4 5 19; 6; 7 8 9";

language::MFunctions m_functions(const machine::Parameters& p, std::uint32_t channel) {
  constexpr std::uint32_t lists = 6;
  language::MFunctions functions;
  bool empty = true;
  for (std::uint32_t i = 0; i < lists; ++i) {
    const auto text = p.text(parameter::m_functions, channel, i);
    empty = empty && text.empty();
    try {
      functions.add(text);
    } catch (const std::runtime_error& e) {
      throw std::runtime_error("parameter " +
                               machine::number_text(parameter::m_functions.number(channel, i)) + " (" +
                               parameter::m_functions.name + "): " + e.what());
    }
  }
  if (empty) functions.add(usual_functions);
  return functions;
}

language::NameDialects name_dialects(const machine::Parameters& p, std::uint32_t channel) {
  language::NameDialects dialects;
  try {
    dialects.add(p.text(parameter::program_dialects, channel));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(fmt::format("parameter {} ({}): {}",
                                         machine::number_text(parameter::program_dialects.number(channel)),
                                         parameter::program_dialects.name, e.what()));
  }
  return dialects;
}

}  // namespace

double TappingSpindle::acceleration_up_to(double speed) const {
  const double lowest = ramp.at(speed);
  return lowest > 0 ? lowest : ramp.acceleration;
}

double TappingSpindle::highest_speed_in(std::size_t gear) const {
  const double of_gear = gear >= 1 && gear <= gear_speeds.size() ? gear_speeds[gear - 1] : 0;
  return of_gear > 0 ? std::min(highest_speed, of_gear) : highest_speed;
}

ChannelSetup::ChannelSetup(const tool_tables::MachineTables& tables) : ChannelSetup(tables.channel) {
  configure(tables.parameters);
  set_tools(tables.tools);
  set_offsets(tables.offsets);
}

void ChannelSetup::configure(const machine::Parameters& p) {
  auto chain = machine::make_chain(p, channel_);
  // What the compensation would refuse is refused here, before setpoints need it.
  compensation::ChannelCompensation::read(p, channel_);
  const auto functions = channel_setup::m_functions(p, channel_);
  const auto dialects = channel_setup::name_dialects(p, channel_);
  const auto macros = macro_settings(p, channel_);
  const auto axes = machine::channel_axes(p, channel_);
  check_chain_axes(chain, axes, channel_);
  channel_axes_ = axes;
  m_functions_ = functions;
  name_dialects_ = dialects;
  macro_settings_ = macros;
  chain_ = chain;
  const auto drive = machine::drive_axes(p);
  columns_.clear();
  mask_ = 0;
  limits_ = {};
  // The rest belongs to the volumetric compensation, which adds to the setpoints of the path.
  const double share = p.integer(parameter::volumetric_type, channel_) != 0
                           ? 1 - p.get(parameter::volumetric_reserve, channel_)
                           : 1;
  for (std::size_t i = 0; i < channel_axes_.index.size(); ++i) {
    const auto index = channel_axes_.index[i];
    const auto a = channel_axes_.number[i];
    columns_.push_back(machine::column_of(drive, a));
    mask_ = static_cast<std::uint16_t>(mask_ | (1u << index));
    limits_.axes[index] = {
        share * p.get(parameter::maximum_feed, a) / 60, share * p.get(parameter::rapid_feed, a) / 60,
        share * p.get(parameter::maximum_acceleration, a), share * p.get(parameter::maximum_jerk, a)};
    rotary_ways_[index] = machine::rotary_way(p, a);
    const auto travel = machine::travel_of(p, a);
    travel_[index] = {travel.negative, travel.positive};
    reference_[index] = p.get(parameter::reference_coordinate, a);
    jog_feed_[index] = p.get(parameter::jog_feed, a);
    reference_feed_[index] = p.get(parameter::reference_feed, a);
    approach_[index] = p.get(parameter::single_direction_approach, a);
    for (std::uint32_t k = 0; k < 3; ++k)
      numbered_references_[k][index] = p.get(parameter::numbered_reference, a, k);
  }
  find_tapping_spindles(p);
  find_external_parameters(p);
  solver_.emplace(*chain_);
  rotary_travel_ = machine::rotary_travels(p, channel_);
  avoid_poles_ = p.integer(parameter::pole_handling, channel_) != 0;
  pole_range_ = p.get(parameter::pole_range, channel_);
  diameter_programming_ = p.integer(parameter::diameter_programming, channel_) != 0;
  scaling_unit_ = p.get(parameter::scaling_unit, channel_);
  power_on_.motion = static_cast<std::uint8_t>(p.integer(parameter::power_on_motion, channel_));
  power_on_.plane =
      static_cast<language::Plane>(p.integer(parameter::power_on_plane, channel_) - first_plane);
  power_on_.feed_mode = p.integer(parameter::power_on_feed_mode, channel_) == 0
                            ? language::FeedMode::per_minute
                            : language::FeedMode::per_revolution;
  default_feed_ = p.get(parameter::default_feed, channel_);
  dry_run_feed_ = p.get(parameter::dry_run_feed, channel_);
  handwheel_share_ = p.get(parameter::handwheel_share, channel_);
  jog_renewal_seconds_ = p.get(parameter::jog_renewal_time, channel_);
  tool_change_seconds_ = p.get(parameter::tool_change_time, channel_);
  plane_angles_by_p_ = p.integer(parameter::plane_angles, channel_) == 1;
  zone_forbids_outside_ = p.integer(parameter::zone_forbidden, channel_) == 1;
  program_dialect_ = static_cast<language::ProgramDialect>(p.integer(parameter::program_dialect, channel_));
  haas_radius_offsets_ = p.integer(parameter::haas_tool_offsets, channel_) != 0;
  dwell_point_ = static_cast<language::DwellPoint>(p.integer(parameter::dwell_point, channel_));
  two_tool_words_ = static_cast<language::TwoToolWords>(p.integer(parameter::two_tool_words, channel_));
  cycles_ = {p.get(parameter::cycle_retract, channel_), p.get(parameter::cycle_clearance, channel_),
             p.integer(parameter::cycle_shift_axis, channel_),
             static_cast<language::OneStroke>(p.integer(parameter::drilling_in_one_stroke, channel_))};
  for (std::uint32_t i = 0; i < skips_.size(); ++i)
    skips_[i] = {static_cast<std::uint32_t>(p.integer(parameter::skip_code_input, channel_, i)),
                 p.get(parameter::skip_code_feed, channel_, i)};
  length_measuring_ = {p.get(parameter::length_measuring_distance, channel_),
                       p.get(parameter::length_measuring_range, channel_),
                       p.get(parameter::length_measuring_feed, channel_),
                       static_cast<std::uint32_t>(p.integer(parameter::length_measuring_input, channel_))};
  cutter_ = {p.integer(parameter::cutter_feed_at_contour) != 0,
             p.integer(parameter::cutter_wear_sign) != 0 ? 1 : -1,
             p.integer(parameter::cutter_interference_check) != 0,
             static_cast<unsigned>(p.integer(parameter::cutter_check_blocks))};
  for (std::uint32_t i = 0; i < 180; ++i)
    planes_[i / 9][i / 3 % 3][i % 3] = p.get(parameter::tilted_plane_points, channel_, i);
  for (std::uint32_t i = 0; i < cycle_m_codes_.size(); ++i)
    cycle_m_codes_[i] = static_cast<std::uint16_t>(p.integer(parameter::cycle_m_code, 0, i));
  for (std::uint32_t i = 0; i < angle_m_codes_.size(); ++i)
    angle_m_codes_[i] = static_cast<std::int16_t>(p.integer(parameter::angle_m_code, 0, i));
  limits_.smoothing_cycles = p.integer(parameter::smoothing_cycles, channel_);
  limits_.contour_tolerance = p.get(parameter::contour_tolerance, channel_);
  limits_.combined_feed = p.integer(parameter::rotary_feed, channel_) == 0;
  limits_.arc_tolerance = p.get(parameter::arc_tolerance);
  limits_.smooth_corner_angle = straight_on - p.get(parameter::smooth_corner_angle, channel_);
  limits_.centripetal_acceleration = p.get(parameter::centripetal_acceleration, channel_);
  limits_.orientation_tolerance = p.get(parameter::orientation_tolerance, channel_);
  for (std::uint32_t k = 0; k < limits_.modes.size(); ++k)
    limits_.modes[k] = {p.integer(parameter::mode_smoothing_cycles, channel_, k),
                        p.get(parameter::mode_contour_tolerance, channel_, k),
                        p.get(parameter::mode_orientation_tolerance, channel_, k),
                        straight_on - p.get(parameter::mode_smooth_corner_angle, channel_, k),
                        p.get(parameter::mode_centripetal_acceleration, channel_, k)};
  radius_deviation_ = p.get(parameter::radius_deviation);
  cycle_seconds_ = p.get(parameter::interpolation_cycle) * 1e-6;
  stream_real_ = {p, false};
  stream_virtual_ = {p, true};
  has_gantry_ = !machine::gantry_pairs(p, channel_).empty();
  checks_exact_stops_ = p.get(parameter::exact_stop_check_time) > 0;
  revision_ = p.revision;
  parameters_ = p;
}

// The letters that are spindles count from the one that is coupled without J.
void ChannelSetup::find_tapping_spindles(const machine::Parameters& p) {
  const auto spindles = machine::spindles(p);
  const int first = p.integer(parameter::tapping_spindle, channel_);
  auto next = std::find_if(spindles.begin(), spindles.end(),
                           [&](const auto& spindle) { return first < 0 || spindle.number == first; });
  const auto spindle = [&](auto at) {
    TappingSpindle found;
    if (at == spindles.end()) return found;
    found.axis = at->number;
    found.ramp = {p.get(parameter::maximum_acceleration, at->number),
                  p.integer(parameter::speed_dependent_acceleration, at->number) != 0,
                  p.get(parameter::base_speed, at->number), p.get(parameter::power_speed, at->number)};
    found.highest_speed = p.get(parameter::maximum_speed, at->number);
    double of_gears = 0;
    for (std::uint32_t gear = 0; gear < TappingSpindle::gear_count; ++gear) {
      found.gear_speeds[gear] = p.get(parameter::gear_highest_speed, at->number, gear);
      of_gears = std::max(of_gears, found.gear_speeds[gear]);
    }
    found.by_gears = of_gears > 0 && (found.highest_speed == 0 || of_gears < found.highest_speed);
    if (found.by_gears) found.highest_speed = of_gears;
    return found;
  };
  tapping_spindles_ = {};
  tapping_spindles_[0] = spindle(next);
  spindle_mask_ = 0;
  for (std::uint32_t letter = language::A; letter < language::axis_count; ++letter) {
    if (p.integer(parameter::channel_axis, channel_, letter) != machine::spindle_letter) continue;
    spindle_mask_ = static_cast<std::uint16_t>(spindle_mask_ | (1u << letter));
    tapping_spindles_[letter - language::A + 1] = spindle(next);
    if (next != spindles.end()) ++next;
  }
}

// The dialect counts four spindles: E90310 is the first one's window, E90311 the second one's.
void ChannelSetup::find_external_parameters(const machine::Parameters& p) {
  constexpr std::uint32_t most_spindles = 4;
  constexpr double parts_per_degree = 65536.0 / 360, thousandths = 1000;
  external_parameters_.clear();
  std::uint32_t b = 0;
  for (const auto& spindle : machine::spindles(p)) {
    if (b == most_spindles) break;
    const auto of = [&](const machine::NumericParameter& parameter, double scale = 1) {
      return ExternalParameter{p.get(parameter, spindle.number) * scale, parameter.number(spindle.number),
                               scale, 0};
    };
    external_parameters_[90310 + b] = of(parameter::synchronization_window, parts_per_degree);
    external_parameters_[90320 + b] = of(parameter::synchronization_gain);
    external_parameters_[90330 + b] = of(parameter::maximum_acceleration);
    auto lead = of(parameter::synchronization_phase_lead, thousandths);
    const auto& by_speed = parameter::speed_dependent_acceleration;
    lead.further = by_speed.number(spindle.number);
    if (!(lead.value > 0)) lead.value = p.integer(by_speed, spindle.number);
    external_parameters_[90360 + b] = lead;
    external_parameters_[90370 + b] = of(parameter::base_speed);
    external_parameters_[90380 + b] = of(parameter::power_speed);
    external_parameters_[98024 + b] = of(parameter::synchronization_integral_time);
    ++b;
  }
}

std::optional<double> ChannelSetup::parameter(std::uint32_t number) const {
  const auto* definition = machine::Catalogue::instance().find(number);
  if (definition == nullptr || definition->type == machine::ParameterType::text) return std::nullopt;
  return parameters_.at(number);
}

std::optional<double> ChannelSetup::external_parameter(std::uint32_t number) const {
  const auto found = external_parameters_.find(number);
  return found == external_parameters_.end() ? std::nullopt : std::optional(found->second.value);
}

// Above 0 ACCKFNB switches the acceleration by speed on, which acts on a master, above 1 the phase lead,
// which acts on a slave: which of the two a spindle will be is not known yet.
language::ParameterChanges ChannelSetup::external_changes(std::uint32_t number, double value) const {
  const auto found = external_parameters_.find(number);
  if (found == external_parameters_.end()) return {};
  const auto& parameter = found->second;
  language::ParameterChanges changes;
  const bool off = parameter.further != 0 && value <= 1;
  changes.list[changes.count++] = {parameter.parameter, off ? 0 : value / parameter.scale};
  if (parameter.further != 0) changes.list[changes.count++] = {parameter.further, value > 0 ? 1.0 : 0.0};
  return changes;
}

void ChannelSetup::set_tools(const idl::parameters::ToolTable& table) {
  tools_.clear();
  for (const auto& tool : table.tools)
    tools_[tool.number] = {tool.length, tool.length_wear, tool.radius, tool.radius_wear};
}

void ChannelSetup::set_offsets(const idl::parameters::WorkOffsets& table) {
  offsets_ = {};
  for (const auto& offset : table.offsets)
    if (offset.channel == channel_ && offset.index < offsets_.size())
      std::copy_n(offset.values.begin(), std::min(offset.values.size(), language::axis_count),
                  offsets_[offset.index].begin());
}

std::optional<double> ChannelSetup::tool_length(std::uint16_t h) const {
  const auto found = tools_.find(h);
  if (found == tools_.end()) return std::nullopt;
  return found->second.length + found->second.length_wear;
}

std::optional<language::ToolOffset> ChannelSetup::tool_offset(std::uint16_t number) const {
  const auto found = tools_.find(number);
  return found == tools_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<AxisValues> ChannelSetup::numbered_reference(std::uint8_t number) const {
  if (number < 2 || number > 4) return std::nullopt;
  return numbered_references_[number - 2u];
}

std::optional<std::array<language::Vector3, 3>> ChannelSetup::plane_points(std::uint8_t index) const {
  if (index < 1 || index > planes_.size()) return std::nullopt;
  const auto& plane = planes_[index - 1u];
  if (plane[0] == plane[1] && plane[1] == plane[2]) return std::nullopt;  // nobody has entered it
  return plane;
}

AxisValues ChannelSetup::tip_from_machine(const AxisValues& machine, double tool_length) const {
  AxisValues result = machine;
  const auto tip = chain_->tip_from_machine({machine[0], machine[1], machine[2]},
                                            geometry::angles_of(machine.data()), tool_length);
  std::copy_n(tip.data(), 3, result.begin());
  return result;
}

AxisValues ChannelSetup::machine_from_tip(const AxisValues& tip, double tool_length) const {
  AxisValues result = tip;
  const auto machine =
      chain_->machine_from_tip({tip[0], tip[1], tip[2]}, geometry::angles_of(tip.data()), tool_length);
  std::copy_n(machine.data(), 3, result.begin());
  return result;
}

std::optional<language::TravelBreach> ChannelSetup::breach_of(const AxisValues& from,
                                                              const language::Command& move,
                                                              const geometry::DirectionPath* way) const {
  const bool rtcp = move.modal.transformation == language::Transformation::rtcp;
  const auto path = move.kind == language::CommandKind::arc
                        ? motion::PathSegment::arc(from, move.target, move.arc)
                        : motion::PathSegment::line(from, move.target);
  const double length = path.length();
  const auto at = [&](double share) {
    AxisValues place = share >= 1 ? move.target : path.position(length * share);
    if (way != nullptr) {
      const auto angles = way->angles(share);
      for (std::size_t i = 0; i < angles.size(); ++i)
        if (chain_->turns(i)) place[i + 3] = angles[i];
    }
    return rtcp ? machine_from_tip(place, move.modal.tool_length) : place;
  };
  double degrees = move.kind == language::CommandKind::arc ? move.arc.sweep : 0;
  if (rtcp)
    for (std::size_t i = 3; i < from.size(); ++i)
      if (chain_->turns(i - 3)) degrees += std::abs(at(1)[i] - at(0)[i]);
  return farthest_breach(at, degrees, channel_axes_.index, travel_);
}

std::string ChannelSetup::travel_error(const AxisValues& from, const language::Command& move) const {
  const auto breach = breach_of(from, move, nullptr);
  return breach ? words_of(*breach, move.line) : "";
}

std::string ChannelSetup::travel_error(const AxisBox& box, const AxisValues& offset,
                                       std::uint32_t line) const {
  constexpr double slack = 1e-6;
  for (const auto index : channel_axes_.index)
    for (const double position : {box.low[index] + offset[index], box.high[index] + offset[index]})
      if (travel_[index].excess(position) > slack)
        return words_of({static_cast<language::Axis>(index), position}, line);
  return "";
}

std::string ChannelSetup::words_of(const language::TravelBreach& breach, std::uint32_t line) const {
  const Travel& travel = travel_[breach.axis];
  return fmt::format("{}: {} would go to {:.4f}, its travel is {:.4f} .. {:.4f}", line,
                     language::axis_letters[breach.axis], breach.position, travel.negative, travel.positive);
}

std::optional<language::TravelBreach> ChannelSetup::vector_breach(const AxisValues& start,
                                                                  const language::Command& move,
                                                                  const language::Vector3& direction) const {
  const auto made = direction_path(start, direction);
  const auto* way = std::get_if<geometry::DirectionPath>(&made);
  if (way == nullptr) return std::nullopt;
  // At a pole the axes turn before the tip goes.
  language::Command turn = move;
  turn.kind = language::CommandKind::line;
  turn.target = start;
  const auto angles = way->start();
  std::copy(angles.begin(), angles.end(), turn.target.begin() + 3);
  const auto breach = breach_of(start, turn, nullptr);
  return breach ? breach : breach_of(start, move, way);
}

}  // namespace trunnion::channel_setup
