// SPDX-License-Identifier: Apache-2.0
#include "surface_speeds.hpp"

#include <algorithm>
#include <cmath>

#include "canonical/turning_speed.hpp"

namespace trunnion::drive {
namespace {

/// 0 also for what is no number.
double above_zero(double value) { return value > 0 ? value : 0; }

}  // namespace

// The PLC repeats its orders: the radius of one that was taken is older than that of the setpoints.
void SurfaceSpeeds::demand(const std::vector<idl::plc::SurfaceSpeed>& speeds) {
  for (auto& order : orders_) order.speed = 0;
  for (const auto& order : speeds) {
    if (order.spindle >= orders_.size() || order.channel >= places_.size()) continue;
    orders_[order.spindle] = order;
    auto& place = places_[order.channel];
    if (place.ordered != order.radius) place = {order.radius, order.radius};
  }
}

void SurfaceSpeeds::turn_at(std::uint16_t channel, double radius) {
  if (channel < places_.size()) places_[channel].radius = radius;
}

void SurfaceSpeeds::pass(std::uint16_t channel) {
  if (channel >= places_.size() || places_[channel].ordered < 0) return;
  const bool followed = std::any_of(orders_.begin(), orders_.end(), [&](const auto& order) {
    return order.speed != 0 && order.channel == channel;
  });
  if (!followed) places_[channel].ordered = -1;
}

double SurfaceSpeeds::speed(std::size_t spindle) const {
  const auto& order = orders_[spindle];
  const double radius = above_zero(places_[order.channel].radius), limit = above_zero(order.limit);
  return std::copysign(canonical::turning_speed(std::abs(order.speed), radius, limit), order.speed);
}

bool SurfaceSpeeds::any() const {
  return std::any_of(orders_.begin(), orders_.end(), [](const auto& order) { return order.speed != 0; }) ||
         std::any_of(places_.begin(), places_.end(), [](const auto& place) { return place.ordered >= 0; });
}

}  // namespace trunnion::drive
