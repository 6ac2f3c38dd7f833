// SPDX-License-Identifier: Apache-2.0
// The gear of a spindle: which one is in force, and the speed that it permits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "machine/parameters.hpp"

namespace trunnion::drive {

inline constexpr std::size_t gear_count = 5;  ///< M41 .. M45

/// Highest speeds of the gears of a spindle, 1/min (10a985 ..); 0 = it has no such gear.
using GearSpeeds = std::array<double, gear_count>;
GearSpeeds gear_speeds(const machine::Parameters& parameters, std::uint16_t spindle);

class SpindleGear {
 public:
  /// Not cyclic.
  void configure(const GearSpeeds& highest) { highest_ = highest; }
  /// From 1; 0 = none.
  void engage(std::uint8_t gear) { engaged_ = gear; }
  std::uint8_t engaged() const { return engaged_; }
  /// The engaged gear when the spindle has it, else 0.
  std::uint8_t in_force() const {
    return engaged_ >= 1 && engaged_ <= gear_count && highest_[engaged_ - 1u] > 0 ? engaged_
                                                                                  : std::uint8_t{0};
  }
  /// 1/min, of the gear in force; infinite without one.
  double highest() const;

  /// No fields, configure() sets them: highest_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("engaged", self.engaged_);
  }

 private:
  GearSpeeds highest_{};
  std::uint8_t engaged_ = 0;
};

}  // namespace trunnion::drive
