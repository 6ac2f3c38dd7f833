// SPDX-License-Identifier: Apache-2.0
#include "language/hole_pattern.hpp"

#include <cmath>
#include <numbers>

namespace trunnion::language {

void HolePattern::line(Point first, Point step, std::uint32_t count) {
  kind_ = Kind::line;
  origin_ = first;
  step_ = step;
  count_ = count;
  next_ = 0;
}

void HolePattern::circle(Point centre, double radius, double first, double step, std::uint32_t count) {
  kind_ = Kind::circle;
  origin_ = centre;
  radius_ = radius;
  angle_ = first;
  step_ = {step, 0};
  count_ = count;
  next_ = 0;
}

void HolePattern::grid(Point first, double column_step, std::uint32_t columns, double row_step,
                       std::uint32_t rows) {
  kind_ = Kind::grid;
  origin_ = first;
  step_ = {column_step, row_step};
  columns_ = columns;
  count_ = columns * rows;
  next_ = 0;
}

bool HolePattern::next(Point& point) {
  if (next_ == count_) return false;
  point = at(next_++);
  return true;
}

HolePattern::Point HolePattern::at(std::uint32_t index) const {
  switch (kind_) {
    case Kind::line:
      return {origin_[0] + step_[0] * index, origin_[1] + step_[1] * index};
    case Kind::circle: {
      const double angle = (angle_ + step_[0] * index) * (std::numbers::pi / 180.0);
      return {origin_[0] + radius_ * std::cos(angle), origin_[1] + radius_ * std::sin(angle)};
    }
    case Kind::grid:
      break;
  }
  const std::uint32_t row = index / columns_;
  const std::uint32_t along = index % columns_;
  const std::uint32_t column = row % 2 == 0 ? along : columns_ - 1 - along;
  return {origin_[0] + step_[0] * column, origin_[1] + step_[1] * row};
}

}  // namespace trunnion::language
