// What the interpreter has to know of the machine and its tables.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "language/canonical.hpp"
#include "language/text_source.hpp"

namespace trunnion::language {

/// Everything a program's meaning depends on besides its text. The answers must not change between start()
/// and the end of the program, so that interpreting it again up to a command gives that command again.
class Environment {
 public:
  virtual ~Environment() = default;
  /// Machine coordinates of the zero of work offset `index`: 0 = G54 .. 5 = G59; mm and degrees.
  virtual AxisValues work_offset(std::uint8_t index) const = 0;
  /// Tool length of table entry `h` (from 1) in mm, or nothing when there is no such entry.
  virtual std::optional<double> tool_length(std::uint16_t h) const = 0;
  /// Machine coordinates of the reference position of each axis (G28); mm and degrees.
  virtual AxisValues reference_position() const = 0;
  /// Machine coordinates of the control point to the frame of Transformation::rtcp: the linear axes change,
  /// the rotary ones stay. `tool_length` in mm along the tool axis.
  virtual AxisValues tip_from_machine(const AxisValues& machine, double tool_length) const = 0;
  /// The inverse of tip_from_machine for the same rotary axes and tool length.
  virtual AxisValues machine_from_tip(const AxisValues& tip, double tool_length) const = 0;
  /// The axes the channel has: bit a for Axis a.
  virtual std::uint16_t axes() const = 0;
  /// Largest difference of an arc's radii at its start and its end in mm (parameter 000011, default 0.1).
  virtual double radius_deviation() const = 0;
  /// The text of a subprogram that is not in the calling text, or nullptr. `name` is O and at least four
  /// digits ("O0012"), or "USERDEF.CYC" for the file of canned cycles. The text must live until the program's
  /// end; it may be pending at first or fail later.
  virtual TextSource* subprogram(std::string_view name) = 0;
  /// The M code that calls canned cycle G1007 + `index`, index 0 to 7, or 0 (parameters 010170 .. 010177).
  virtual std::uint16_t cycle_m_code(std::size_t index) const {
    (void)index;
    return 0;
  }
};

}  // namespace trunnion::language
