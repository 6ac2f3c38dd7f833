// SPDX-License-Identifier: Apache-2.0
// Circles as they are written: whether their words are consistent, and smooth with the moves beside them.
#pragma once

#include <array>

#include "analysis/warnings.hpp"
#include "language/block_watch.hpp"
#include "language/environment.hpp"

namespace trunnion::analysis {

class ArcChecks {
 public:
  /// `environment` and `warnings` must outlive the checks.
  ArcChecks(const language::Environment& environment, Warnings& warnings);

  /// `calls`: the letters of the block are arguments.
  void see(const language::SeenBlock& seen, bool calls);
  /// The program has ended at `position`, program coordinates.
  void end(const language::AxisValues& position) { finish(position); }

 private:
  using Flat = std::array<double, 2>;  // along the axes of the plane
  enum class Kind : std::uint8_t { none, straight, centre, radius };
  struct Path {
    Kind kind = Kind::none;
    WarningPlace place;
    language::Plane plane = language::Plane::xy;
    double turn = 1;  ///< 1 anticlockwise, -1 clockwise
    language::AxisValues start{};
    Flat centre{};      ///< from the start, mm
    double radius = 0;  ///< R, mm
  };
  /// Angles of the direction of a path in its plane, radians.
  struct Ends {
    double begin = 0, end = 0;
  };

  Path path_of(const language::SeenBlock& seen, bool calls) const;
  void finish(const language::AxisValues& position);
  Ends by_centre(const Path& path, const Flat& way);
  Ends by_radius(const Path& path, const Flat& way);
  void check_side(const Path& path, const Flat& way, double sweep, const Ends& own);
  void compare_with_next(double begin);

  const language::Environment& environment_;
  Warnings& warnings_;
  Path path_;
  bool before_known_ = false;
  double before_ = 0;  // the direction in which the path before ends
  // A circle that turns back at its begin, the direction of its end, and those of its other sides.
  bool doubtful_ = false;
  WarningPlace doubtful_place_;
  double own_end_ = 0;
  std::array<double, 2> other_ends_{};
  std::array<bool, 2> other_fits_{};
};

}  // namespace trunnion::analysis
