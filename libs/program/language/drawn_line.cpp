// SPDX-License-Identifier: Apache-2.0
#include "language/drawn_line.hpp"

#include <cmath>
#include <numbers>

namespace trunnion::language {
namespace {

constexpr double parallel = 1e-4 * std::numbers::pi / 180;  // rad

Vector2 direction_of(double degrees) {
  const double angle = std::remainder(degrees, 180.0);
  if (angle == 0) return {1, 0};
  if (std::abs(angle) == 90) return {0, 1};
  const double radians = angle * (std::numbers::pi / 180.0);
  return {std::cos(radians), std::sin(radians)};
}

}  // namespace

DrawnLine::DrawnLine(Vector2 point, double degrees) : point_(point), direction_(direction_of(degrees)) {}

std::optional<Vector2> DrawnLine::at_first(double u) const {
  if (!(std::abs(direction_.u) > parallel)) return std::nullopt;
  return Vector2{u, point_.v + (u - point_.u) / direction_.u * direction_.v};
}

std::optional<Vector2> DrawnLine::at_second(double v) const {
  if (!(std::abs(direction_.v) > parallel)) return std::nullopt;
  return Vector2{point_.u + (v - point_.v) / direction_.v * direction_.u, v};
}

std::optional<Vector2> DrawnLine::meets(const DrawnLine& other) const {
  const double sine = cross(direction_, other.direction_);
  if (!(std::abs(sine) > parallel)) return std::nullopt;
  return point_ + (cross(other.point_ - point_, other.direction_) / sine) * direction_;
}

MoveModes MoveModes::of(const ModalState& modal) {
  return {modal.feed, modal.feed_mode, modal.path_control, modal.path_tolerance, modal.smoothing};
}

void MoveModes::give_to(ModalState& modal) const {
  modal.feed = feed;
  modal.feed_mode = feed_mode;
  modal.path_control = path_control;
  modal.path_tolerance = path_tolerance;
  modal.smoothing = smoothing;
}

double DrawnLine::distance(Vector2 point) const { return std::abs(cross(direction_, point - point_)); }

}  // namespace trunnion::language
