// SPDX-License-Identifier: Apache-2.0
// The interpreter's own copy of the tables a program can change.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "language/environment.hpp"

namespace trunnion::language {

inline constexpr std::uint32_t highest_tool = 65535;
/// Ends the alarm of a number beyond G54.1 P48.
inline constexpr const char* additional_work_offsets = "this control has P1 to P48";

/// Work offsets and tool entries as the environment gives them at the start of a program, with the changes
/// the program makes (G10). Room for a fixed number of changed tools; allocates nothing.
class OffsetTables {
 public:
  static constexpr std::size_t most_changed_tools = 200;

  /// Takes the tables of `environment`, which must outlive the reading, and forgets all changes.
  void load(const Environment& environment);

  /// `index` as ModalState::work_offset, external_work_offset, or the row of a setting error.
  const AxisValues& work_offset(std::uint8_t index) const { return work_offsets_[index]; }
  /// As Environment::workpiece_zero().
  AxisValues workpiece_zero(std::uint8_t index) const;
  /// As Environment::setting_error().
  const AxisValues& setting_error(std::uint8_t number) const {
    return work_offsets_[static_cast<std::size_t>(external_work_offset) + number];
  }
  void set_work_offset(std::uint8_t index, const AxisValues& values) { work_offsets_[index] = values; }

  /// Entry `number` from 1, or nothing when neither the table nor the program defines it.
  std::optional<ToolOffset> tool(std::uint16_t number) const;
  /// False when the program has changed too many different tools.
  bool set_tool(std::uint16_t number, const ToolOffset& tool);

 private:
  const Environment* environment_ = nullptr;
  std::array<AxisValues, offset_row_count> work_offsets_{};
  struct Changed {
    std::uint16_t number = 0;
    ToolOffset tool;
  };
  std::array<Changed, most_changed_tools> changed_{};
  std::size_t changed_count_ = 0;
};

}  // namespace trunnion::language
