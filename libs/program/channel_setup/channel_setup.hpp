// SPDX-License-Identifier: Apache-2.0
// What one channel knows of its machine: axes, limits, transformation, tools and offsets, of one parameter
// revision. The channel, the report and the commands that work without a cluster read programs with it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>

#include "channel_setup/axis_box.hpp"
#include "channel_setup/control_macros.hpp"
#include "channel_setup/macro_settings.hpp"
#include "channel_setup/travel_search.hpp"
#include "contracts/types.hpp"
#include "geometry/chain.hpp"
#include "geometry/direction_path.hpp"
#include "language/environment.hpp"
#include "language/name_dialects.hpp"
#include "language/stroke_zone.hpp"
#include "machine/axes.hpp"
#include "machine/program_number.hpp"
#include "machine/spindle_acceleration.hpp"
#include "machine/stream_settings.hpp"
#include "motion/limits.hpp"
#include "parameter_store/machine_tables.hpp"

namespace trunnion::channel_setup {

/// The spindle that S turns and rigid tapping couples; `axis` is its logical number, nothing when the machine
/// has none.
struct TappingSpindle {
  static constexpr std::size_t gear_count = 5;

  std::optional<std::uint16_t> axis;
  machine::SpindleAcceleration ramp;
  double highest_speed = 0;                      ///< 1/min, 0 = no limit
  bool by_gears = false;                         ///< it is that of the highest gear (10a985), not 10a948
  std::array<double, gear_count> gear_speeds{};  ///< highest of each gear, 1/min; 0 = there is no such gear

  /// degrees/s^2 that it has at every speed up to `speed`, 1/min; where alarm 182 refuses its parameters,
  /// that of low speeds.
  double acceleration_up_to(double speed) const;
  /// highest_speed while `gear` is engaged, from 1; 0 = none is, or it is not known which.
  double highest_speed_in(std::size_t gear) const;
};

class ChannelSetup : public language::Environment {
 public:
  explicit ChannelSetup(std::uint16_t channel) : channel_(channel) {}
  /// Configured with the tables. Throws as configure() does.
  explicit ChannelSetup(const tool_tables::MachineTables& tables);

  /// Throws std::runtime_error when the kinematic parameters make no chain, the chain turns a letter that the
  /// channel does not have, or the parameters of the compensation, the list of M functions, the dialects of
  /// names or the codes that call programs are not valid.
  void configure(const machine::Parameters& parameters);
  void set_tools(const idl::parameters::ToolTable& tools);
  void set_offsets(const idl::parameters::WorkOffsets& offsets);
  /// Finds the texts of subprograms; null when there are none. The macros of the control come after them.
  std::function<language::TextSource*(std::string_view)> resolve;

  AxisValues work_offset(std::uint8_t index) const override {
    return index < offsets_.size() ? offsets_[index] : AxisValues{};
  }
  AxisValues external_offset() const override { return offsets_[language::external_work_offset]; }
  AxisValues setting_error(std::uint8_t number) const override {
    return offsets_.at(static_cast<std::size_t>(language::external_work_offset) + number);
  }
  std::optional<double> tool_length(std::uint16_t h) const override;
  bool has_tool(std::uint32_t number) const override { return tools_.empty() || tools_.contains(number); }
  std::optional<language::ToolOffset> tool_offset(std::uint16_t number) const override;
  AxisValues reference_position() const override { return reference_; }
  std::optional<AxisValues> numbered_reference(std::uint8_t number) const override;
  AxisValues approach() const override { return approach_; }
  bool diameter_programming() const override { return diameter_programming_; }
  double scaling_unit() const override { return scaling_unit_; }
  double default_feed() const override { return default_feed_; }
  bool feeds_without_word() const override { return true; }
  canonical::RotaryWay rotary_way(std::size_t axis) const override { return rotary_ways_[axis]; }
  language::ModalState power_on() const override { return power_on_; }
  /// Half of parameter 000010; the other half is left to the smoothing of the joints.
  double curve_tolerance() const override { return limits_.arc_tolerance / 2; }
  const language::MFunctions* m_functions() const override { return &m_functions_; }
  language::AngleMCodes angle_m_codes() const override { return angle_m_codes_; }
  language::DwellPoint dwell_point() const override { return dwell_point_; }
  language::TwoToolWords two_tool_words() const override { return two_tool_words_; }
  language::ProgramDialect program_dialect() const override { return program_dialect_; }
  /// What the control has stored for itself is ISO.
  std::optional<language::ProgramDialect> dialect_by_name(std::string_view name) const override {
    return machine::is_temporary(name) ? language::ProgramDialect::iso : name_dialects_.of(name);
  }
  /// In place of what the parameters say for the channel and for names of programs.
  void set_program_dialect(language::ProgramDialect dialect) {
    program_dialect_ = dialect;
    name_dialects_ = {};
  }
  bool haas_radius_offsets() const override { return haas_radius_offsets_; }
  language::CodeCalls code_calls() const override { return macro_settings_.calls; }
  bool prints_blanks() const override { return macro_settings_.prints_blanks; }
  bool offsets_by_axis() const override { return macro_settings_.offsets_by_axis; }
  std::optional<double> parameter(std::uint32_t number) const override;
  /// Those that are parameters of a spindle, which count from 1 in the order of their axis numbers.
  std::optional<double> external_parameter(std::uint32_t number) const override;
  language::ParameterChanges external_changes(std::uint32_t number, double value) const override;
  bool zone_forbids_outside() const override { return zone_forbids_outside_; }
  bool plane_angles_by_p() const override { return plane_angles_by_p_; }
  bool combined_feed() const override { return limits_.combined_feed; }
  language::CycleSettings cycle_settings() const override { return cycles_; }
  language::SkipSettings skip_settings(std::uint32_t number) const override { return skips_.at(number - 1); }
  language::LengthMeasuring length_measuring() const override { return length_measuring_; }
  language::CutterSettings cutter_settings() const override { return cutter_; }
  std::optional<std::array<language::Vector3, 3>> plane_points(std::uint8_t index) const override;
  /// Within the travel of the rotary axes, by the closed form of geometry::OrientationSolver.
  std::optional<AxisValues> orient(const language::Vector3& direction, const AxisValues& current,
                                   language::RotaryChoice choice) const override;
  std::optional<language::Vector3> nearest_direction(const language::Vector3& direction,
                                                     const AxisValues& current) const override;
  /// Over the great circle by geometry::DirectionPath, with the pole handling of parameter 04c100.
  language::VectorPath vector_path(const AxisValues& current,
                                   const language::Vector3& direction) const override;
  AxisValues on_vector_path(const AxisValues& current, const language::Vector3& direction,
                            double s) const override;
  std::optional<language::TravelBreach> vector_breach(const AxisValues& start, const language::Command& move,
                                                      const language::Vector3& direction) const override;
  std::uint16_t cycle_m_code(std::size_t index) const override { return cycle_m_codes_.at(index); }
  AxisValues tip_from_machine(const AxisValues& machine, double tool_length) const override;
  AxisValues machine_from_tip(const AxisValues& tip, double tool_length) const override;
  std::uint16_t axes() const override { return mask_; }
  std::uint16_t spindle_axes() const override { return spindle_mask_; }
  double highest_spindle_speed() const override { return tapping_spindles_[0].highest_speed; }
  const char* highest_speed_parameter() const override {
    return tapping_spindles_[0].by_gears ? "10a985" : Environment::highest_speed_parameter();
  }
  double highest_feed(std::size_t axis) const override { return limits_.axes[axis].velocity * 60; }
  double radius_deviation() const override { return radius_deviation_; }
  language::TextSource* subprogram(std::string_view name) override {
    auto* stored = resolve ? resolve(name) : nullptr;
    return stored != nullptr ? stored : control_macro(name);
  }

  /// Empty, or one line about an axis that would leave its travel anywhere on the way from `from` to the end
  /// of `move`.
  std::string travel_error(const AxisValues& from, const language::Command& move) const;
  /// The same of a way that stays in `box`, with `offset` added in machine coordinates.
  std::string travel_error(const AxisBox& box, const AxisValues& offset, std::uint32_t line) const;

  /// Empty, or how a move that begins at `from`, with `offset` added in machine coordinates, would come where
  /// `zone` forbids.
  std::string zone_error(const AxisValues& from, const language::Command& move,
                         const language::StrokeZone& zone, const AxisValues& offset) const;

  const machine::ChannelAxes& channel_axes() const { return channel_axes_; }
  const std::vector<int>& columns() const { return columns_; }
  const motion::Limits& limits() const { return limits_; }
  const geometry::Chain& chain() const { return *chain_; }
  bool configured() const { return chain_.has_value(); }
  /// Of a stroke, by language::Command::number of kind tap.
  const TappingSpindle& tapping_spindle(std::uint32_t tapping_axis = 0) const {
    return tapping_spindles_.at(tapping_axis);
  }
  const Travel& travel(std::uint8_t axis) const { return travel_[axis]; }
  double jog_feed(std::uint8_t axis) const { return jog_feed_[axis]; }
  /// Feed of a dry run in mm/min (deg/min where only rotary axes move).
  double dry_run_feed() const { return dry_run_feed_; }
  /// Share of every limit of the axes that a handwheel offset may take.
  double handwheel_share() const { return handwheel_share_; }
  /// Machine time that a jog movement without an increment lasts without a renewal.
  double jog_renewal_seconds() const { return jog_renewal_seconds_; }
  /// What a summary of a program counts for M6.
  double tool_change_seconds() const { return tool_change_seconds_; }
  double reference_feed(std::uint8_t axis) const { return reference_feed_[axis]; }
  double cycle_seconds() const { return cycle_seconds_; }
  const machine::StreamSettings& stream(bool virtual_time) const {
    return virtual_time ? stream_virtual_ : stream_real_;
  }
  std::uint64_t lead() const { return stream_real_.lead; }
  /// Axes are checked at an exact stop (parameter 010166), which then takes at least lead() + 2 cycles.
  bool checks_exact_stops() const { return checks_exact_stops_; }
  /// The slave of a gantry belongs to the channel: the gantry stage uses feedback in all its motions.
  bool has_gantry() const { return has_gantry_; }
  std::uint64_t revision() const { return revision_; }

 private:
  void find_tapping_spindles(const machine::Parameters& parameters);
  void find_external_parameters(const machine::Parameters& parameters);
  std::string words_of(const language::TravelBreach& breach, std::uint32_t line) const;
  /// Of a move whose tool goes `way`, or rotary axes in proportion when that is null.
  std::optional<language::TravelBreach> breach_of(const AxisValues& from, const language::Command& move,
                                                  const geometry::DirectionPath* way) const;
  std::variant<geometry::DirectionPath, geometry::DirectionPathFault> direction_path(
      const AxisValues& current, const language::Vector3& direction) const;
  geometry::OrientationAnswer orientation(const language::Vector3& direction, const AxisValues& current,
                                          language::RotaryChoice choice) const;

  std::uint16_t channel_;
  machine::ChannelAxes channel_axes_;
  std::vector<int> columns_;
  motion::Limits limits_;
  std::optional<geometry::Chain> chain_;
  std::optional<geometry::OrientationSolver> solver_;
  geometry::AngleTravels rotary_travel_{};
  bool avoid_poles_ = false;
  double pole_range_ = 0;
  std::array<AxisValues, language::offset_row_count> offsets_{};
  std::map<std::uint32_t, language::ToolOffset> tools_;
  AxisValues reference_{}, approach_{};
  std::array<AxisValues, 3> numbered_references_{};
  bool diameter_programming_ = false;
  double scaling_unit_ = 1;
  double default_feed_ = 1000, dry_run_feed_ = 2000, handwheel_share_ = 0.2;
  double jog_renewal_seconds_ = 0.25, tool_change_seconds_ = 10;
  language::ModalState power_on_;
  language::MFunctions m_functions_;
  bool plane_angles_by_p_ = false, haas_radius_offsets_ = false, zone_forbids_outside_ = false;
  language::DwellPoint dwell_point_ = language::DwellPoint::refused;
  language::TwoToolWords two_tool_words_ = language::TwoToolWords::refused;
  language::ProgramDialect program_dialect_ = language::ProgramDialect::iso;
  language::NameDialects name_dialects_;
  MacroSettings macro_settings_;
  machine::Parameters parameters_;
  struct ExternalParameter {
    double value = 0;
    std::uint32_t parameter = 0;
    double scale = 1;           ///< times the parameter is the value
    std::uint32_t further = 0;  ///< ACCKFNB: that of the acceleration; 0 = none
  };
  std::map<std::uint32_t, ExternalParameter> external_parameters_;
  language::CycleSettings cycles_;
  std::array<language::SkipSettings, 3> skips_{};
  language::LengthMeasuring length_measuring_;
  language::CutterSettings cutter_;
  std::array<std::array<language::Vector3, 3>, 20> planes_{};
  std::array<std::uint16_t, 8> cycle_m_codes_{};
  language::AngleMCodes angle_m_codes_{};
  std::array<TappingSpindle, 7> tapping_spindles_;  // without J, and of J1..J6
  std::uint16_t spindle_mask_ = 0;
  std::array<Travel, language::axis_count> travel_{};
  std::array<canonical::RotaryWay, language::axis_count> rotary_ways_{};
  AxisValues jog_feed_{}, reference_feed_{};
  std::uint16_t mask_ = 0;
  double radius_deviation_ = 0.1, cycle_seconds_ = 0.001;
  std::uint64_t revision_ = 0;
  bool checks_exact_stops_ = false, has_gantry_ = false;
  machine::StreamSettings stream_real_, stream_virtual_;
};

}  // namespace trunnion::channel_setup
