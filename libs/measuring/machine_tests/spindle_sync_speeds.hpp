// SPDX-License-Identifier: Apache-2.0
// The speeds at which synchronized spindles can be tested. A gear is changed at rest only, so while a spindle
// follows another one each keeps its gear.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "machine/axes.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine_tests {

/// Speeds in 1/min, of the gears that the drive reports.
class SpindleSyncSpeeds {
 public:
  /// `spindles` as of machine::spindles(), which `feedback` has all.
  SpindleSyncSpeeds(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& spindles,
                    const idl::stream::Feedback& feedback);

  /// Of all spindles: what each can turn at.
  double lowest() const;
  double highest() const;  ///< infinite without a limit
  /// 1000 and 2000 where the spindles have them, else as near as they come; one when there are no two. Throws
  /// std::runtime_error when the spindles have no speed in common.
  std::vector<double> choice() const;
  /// Why `speed` cannot be tested, in one line; empty when it can.
  std::string refusal(double speed) const;
  /// "0 .. 1000 1/min (S1 in gear 1: 0 .. 1000 1/min; S2 without gears: 0 .. 4000 1/min)"
  std::string text() const;

 private:
  struct Gear {
    unsigned number = 0;  // from 1: M41
    double lowest = 0, highest = 0;
  };
  struct Spindle {
    std::string name;
    unsigned gear = 0;  // in force; 0 = it has none
    double lowest = 0, highest = std::numeric_limits<double>::infinity();
    std::uint32_t lowest_number = 0, highest_number = 0;  // of the parameters; 0 = no limit
    std::vector<Gear> others;
  };
  static std::string words(const Spindle& spindle);
  std::string all_words() const;

  std::vector<Spindle> spindles_;
};

}  // namespace trunnion::machine_tests
