// SPDX-License-Identifier: Apache-2.0
// The tap that is in its hole, or was left there: what its removal is compared with.
#pragma once

#include <string>

#include "language/canonical.hpp"

namespace trunnion::program_execution {

/// Positions are machine coordinates of the control point, mm.
struct TapInHole {
  double lead = 0;                ///< mm per revolution, negative left-hand; 0 = there is none
  language::Vector3 start{};      ///< where the tap was before the hole
  language::Vector3 direction{};  ///< unit vector into the hole

  /// Of a stroke with `lead` from the first position to the second, which are not the same.
  static TapInHole of(double lead, const language::AxisValues& from, const language::AxisValues& to);
  /// How deep the tap is in the hole when the axes are at `position`, mm; 0 before the hole and beside it.
  double depth(const language::AxisValues& position) const;
  /// For the operator, of a tap that is `depth` mm in its hole: "right-hand thread, lead 1.25 mm, 6.500 mm
  /// deep".
  std::string words(double depth) const;
  /// From inside, a stroke with `stroke_lead`, a Command::value, would not follow the thread out. One of U V
  /// W does not either: what moved the tap in was X, Y or Z.
  bool contradicts(const language::AxisValues& from, const language::AxisValues& to,
                   double stroke_lead) const;

  bool operator==(const TapInHole&) const = default;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("lead", self.lead), visit("start", self.start), visit("direction", self.direction);
  }
};

}  // namespace trunnion::program_execution
