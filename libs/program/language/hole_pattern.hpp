// SPDX-License-Identifier: Apache-2.0
// Where the holes of a pattern are.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion::language {

/// Points in a plane, first and second axis in mm, given one after the other without a list of them.
class HolePattern {
 public:
  using Point = std::array<double, 2>;

  /// `count` holes, each `step` on from the one before: repetitions (step 0 in G90) and lines (G78).
  void line(Point first, Point step, std::uint32_t count);
  /// `count` holes on a circle from the angle `first` on, each `step` degrees on (G70, G71).
  void circle(Point centre, double radius, double first, double step, std::uint32_t count);
  /// Rows of `columns` holes, each row walked against the one before (G79).
  void grid(Point first, double column_step, std::uint32_t columns, double row_step, std::uint32_t rows);
  void clear() { count_ = next_ = 0; }

  /// False behind the last hole.
  bool next(Point& point);

 private:
  Point at(std::uint32_t index) const;

  enum class Kind : std::uint8_t { line, circle, grid };
  Kind kind_ = Kind::line;
  Point origin_{};
  Point step_{};
  double radius_ = 0;
  double angle_ = 0;
  std::uint32_t columns_ = 1;
  std::uint32_t count_ = 0;
  std::uint32_t next_ = 0;
};

}  // namespace trunnion::language
