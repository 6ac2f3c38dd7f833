// SPDX-License-Identifier: Apache-2.0
// A stretch of the path ahead, cut into pieces of about the same time, with the rows that bound its speed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "motion/limit_cell.hpp"
#include "motion/speed_plan.hpp"

namespace trunnion::motion {

/// What is asked of a stretch.
struct SpeedRequest {
  std::uint64_t cell = 0;  ///< of the start
  PathState from;          ///< there
  double feed = 1;         ///< overrides
  double rapid = 1;
  bool lower = false;    ///< the plan in force may be faster than the feed allows now: it is drawn down to it
  double horizon = 0.4;  ///< s of motion about
};

/// |c b| <= 1 for an acceleration, |c b| sqrt(b) <= 1 for a jerk; c over three coefficients.
struct SpeedRow {
  std::array<double, 3> c{};
  std::int16_t sample = 0;
  bool jerk = false;
};

/// A place at which rows are set up, by the basis of b there.
struct SpeedSample {
  std::array<double, 3> basis{};
  std::int16_t piece = 0;
};

/// b is a quadratic spline with a continuous first derivative over the nodes: piece k has the coefficients k,
/// k + 1 and k + 2.
class SpeedWindow {
 public:
  static constexpr std::size_t most_pieces = 200, most_cells = 6000, most_samples = 1400;
  static constexpr std::size_t most_rows = 12 * most_samples;

  SpeedWindow();

  /// False when the stretch is too short to be planned, or an axis of it cannot be. `before` is the plan in
  /// force from the start on, or nullptr: where it is faster than the feed now allows, so may the new one be.
  bool build(const CellRing& cells, const SpeedRequest& request, const SpeedPlan* before);

  std::size_t pieces() const { return nodes_.size() - 1; }
  /// Node k, extended evenly beyond both ends.
  double node(std::ptrdiff_t k) const;
  /// Basis of b on piece k at s, its first and second derivative.
  using Basis = std::array<double, 3>;
  void basis(std::size_t k, double s, Basis& value, Basis& first, Basis& second) const;

  const std::vector<SpeedSample>& samples() const { return samples_; }
  std::vector<SpeedRow>& rows() { return rows_; }
  /// Rows of piece k begin here.
  std::size_t rows_from(std::size_t k) const { return row_from_[k]; }
  /// Highest values of the coefficients.
  const std::vector<double>& caps() const { return caps_; }
  /// A first guess of the speed on each piece.
  const std::vector<double>& guess() const { return guess_; }
  /// Weights in the objective of the time on a piece, and of b where it has to fall below what `before` has:
  /// together they are least a little below the speed asked for.
  const std::vector<double>& weight() const { return weight_; }
  const std::vector<double>& pull() const { return pull_; }
  /// Somewhere it is faster than the feed allows.
  bool drawn() const { return drawn_; }
  double end_speed() const { return end_speed_; }
  /// It ends where the path is known to end, or at a stop.
  bool reaches_end() const { return reaches_end_; }

  /// Largest use of the limits of acceleration and jerk on piece k by b with these coefficients.
  double use(const CellRing& cells, std::size_t k, const double* b) const;

 private:
  struct Span {  // cells with the same third derivatives
    double at = 0, end = 0;
    std::uint64_t cell = 0;
    double speed = 0, cap = 0, reachable = 0;
  };
  bool scan(const CellRing& cells, const SpeedRequest& request);
  bool cut(const SpeedRequest& request);
  bool add_rows(const CellRing& cells);
  void add_sample(const CellRing& cells, std::uint64_t& cell, double s, double inside, std::size_t piece,
                  bool acceleration);
  void bound(const SpeedRequest& request, const SpeedPlan* before);
  double near_speed(const Span& span, double s) const;

  std::vector<Span> spans_;
  std::vector<double> nodes_, caps_, guess_, pull_, feed_, reach_, weight_;
  std::vector<SpeedSample> samples_;
  std::vector<SpeedRow> rows_;
  std::vector<std::size_t> row_from_, span_of_;
  PathState from_;
  double end_ = 0, end_speed_ = 0, ramp_ = 0;
  bool reaches_end_ = false, drawn_ = false;
};

}  // namespace trunnion::motion
