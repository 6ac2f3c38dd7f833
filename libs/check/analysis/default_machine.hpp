// SPDX-License-Identifier: Apache-2.0
// The machine of `trunnion check` when none is named: three linear axes, every table zero, and whatever a
// program may ask of a machine nothing is known of.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "channel_setup/control_macros.hpp"
#include "language/environment.hpp"

namespace trunnion::analysis {

struct ToolRow {
  double length = 0;  ///< mm
  double radius = 0;  ///< mm
};
using ToolRows = std::map<std::uint16_t, ToolRow>;

/// Reads CSV rows `number,length,radius` (radius may be left out; empty lines, lines that begin with # and a
/// first line of column names, which has no digit, are passed over). Throws std::runtime_error with
/// file:line.
ToolRows read_tool_rows(const std::string& text, const std::string& file);

class DefaultMachine : public language::Environment {
 public:
  /// Without `tools` every tool exists and has length and radius 0; with them only those.
  explicit DefaultMachine(std::optional<ToolRows> tools) : tools_(std::move(tools)) {}

  /// Finds the texts of subprograms; null when there are none.
  std::function<language::TextSource*(std::string_view)> resolve;
  language::ProgramDialect dialect = language::ProgramDialect::iso;
  /// Of A B C, bit a for Axis a: their words are angles that move nothing else (rotary_words()).
  std::uint16_t rotary_axes = 0;

  language::ProgramDialect program_dialect() const override { return dialect; }
  language::AxisValues work_offset(std::uint8_t) const override { return {}; }
  std::optional<double> tool_length(std::uint16_t h) const override;
  std::optional<language::ToolOffset> tool_offset(std::uint16_t number) const override;
  language::AxisValues reference_position() const override { return {}; }
  std::optional<language::AxisValues> numbered_reference(std::uint8_t) const override {
    return reference_position();
  }
  bool m_codes_take_words() const override { return true; }
  language::AxisValues tip_from_machine(const language::AxisValues& machine,
                                        double tool_length) const override;
  language::AxisValues machine_from_tip(const language::AxisValues& tip, double tool_length) const override;
  std::uint16_t axes() const override { return static_cast<std::uint16_t>(linear_axes | rotary_axes); }
  /// Every letter that is no axis: the spindle of a machine nothing is known of may have any.
  std::uint16_t spindle_axes() const override {
    constexpr unsigned every_axis = 0b111111111;
    return static_cast<std::uint16_t>(every_axis & ~unsigned{axes()});
  }
  double radius_deviation() const override { return 0.1; }
  language::TextSource* subprogram(std::string_view name) override {
    auto* const stored = resolve ? resolve(name) : nullptr;
    return stored != nullptr ? stored : channel_setup::control_macro(name);
  }

 private:
  static constexpr std::uint16_t linear_axes = 0b111;
  std::optional<ToolRows> tools_;
};

}  // namespace trunnion::analysis
