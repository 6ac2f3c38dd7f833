// SPDX-License-Identifier: Apache-2.0
// Constant surface speed (G96): the speed of a spindle follows the radius at which a channel turns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "contracts/types.hpp"

namespace trunnion::drive {

/// The radius comes with the setpoints, in every cycle that is passed; until one has come it is that of the
/// order. It stays while the channel is at rest, and while its axes are moved by hand.
class SurfaceSpeeds {
 public:
  /// Not cyclic.
  void configure(std::size_t spindles) { orders_.resize(spindles); }
  /// All that the PLC orders now.
  void demand(const std::vector<idl::plc::SurfaceSpeed>& speeds);
  /// A setpoint of the channel is passed, `radius` mm from the centre of the spindle.
  void turn_at(std::uint16_t channel, double radius);
  /// A setpoint of the channel without a radius is passed: unless a spindle follows the channel now, the next
  /// order tells where it is.
  void pass(std::uint16_t channel);

  bool follows(std::size_t spindle) const { return orders_[spindle].speed != 0; }
  /// 1/min, signed.
  double speed(std::size_t spindle) const;
  /// Something is ordered, or an order was and its radius is known.
  bool any() const;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("orders", self.orders_), visit("places", self.places_);
  }

 private:
  // Of a channel, mm; below 0 = not known.
  struct Place {
    double ordered = -1;  // radius of the newest order
    double radius = -1;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("ordered", self.ordered), visit("radius", self.radius);
    }
  };

  std::vector<idl::plc::SurfaceSpeed> orders_;  // of each spindle; speed 0 = none
  std::array<Place, 32> places_{};
};

}  // namespace trunnion::drive
