// SPDX-License-Identifier: Apache-2.0
// Splines of LinuxCNC in the plane XY: G5, G5.1 and the blocks between G5.2 and G5.3.
#pragma once

#include <array>
#include <span>

#include "language/block_context.hpp"
#include "language/nurbs_curve.hpp"

namespace trunnion::language {

/// Given out as chords, as G6.2 is.
class LinuxcncCurves : private BlockHandler {
 public:
  explicit LinuxcncCurves(BlockContext& context) : BlockHandler(context) {}

  /// Forgets a curve that is not complete.
  void reset() {
    curve_.stop();
    open_ = closing_ = false;
  }
  /// G5.3 must come.
  bool open() const { return open_; }
  /// An open curve admits G5.2 and G5.3 and no other codes.
  Fault check() const;
  /// The program may end.
  Fault check_end(std::uint16_t at) const { return open_ ? Fault{AlarmNumber::linuxcnc_curve, at} : Fault{}; }

  Fault cubic(std::uint16_t at);      ///< G5
  Fault quadratic(std::uint16_t at);  ///< G5.1
  Fault begin(std::uint16_t at);      ///< G5.2
  /// A block behind G5.2.
  Fault add_block();
  Fault close(std::uint16_t at);  ///< G5.3
  /// The next chord, or the end of the activity until the next block.
  Fault next_chord();

 private:
  using Place = std::array<double, 2>;  // X Y, mm, program coordinates

  Fault check_curve(std::uint16_t at);
  /// The end by X and Y.
  Fault read_end(Place& end);
  Fault read_point(std::uint16_t at);
  Fault read_weight(double& weight);
  Fault add(const Place& place, double weight, std::uint16_t at);
  /// A curve of one span, tangential to its first and last legs.
  Fault draw(std::span<const Place> points, std::uint16_t at);

  NurbsCurve curve_;
  bool open_ = false;
  bool closing_ = false;      // the knots behind the last point are due
  std::uint32_t order_ = 0;   // of the open curve
  std::uint32_t points_ = 0;  // of it so far
  Place last_leg_{};          // P Q of the newest G5
};

}  // namespace trunnion::language
