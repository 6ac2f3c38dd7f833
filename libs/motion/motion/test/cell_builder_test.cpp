// SPDX-License-Identifier: Apache-2.0
// The cutting of a path into cells alone: blocks made by hand, and limits that a sheet of paper gives.
#include "motion/cell_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <variant>

namespace trunnion::motion {
namespace {

using canonical::A;
using canonical::Y;
using canonical::Z;

constexpr double degree = std::numbers::pi / 180;
constexpr double feed_limit = 100, rapid_limit = 200, acceleration = 1000, jerk = 60000;

ModeLimits limits() {
  ModeLimits modes;
  for (Limits& mode : modes) mode.axes.fill({feed_limit, rapid_limit, acceleration, jerk});
  return modes;
}

PathBlock block_of(const PathSegment& segment, double feed = 1000) {
  PathBlock block;
  block.path = segment;
  block.feed = feed;
  return block;
}

PathSegment circle(double radius, double sweep) {
  const double end = sweep * degree;
  canonical::Arc arc;
  arc.sweep = sweep;
  return PathSegment::arc({radius}, {radius * std::cos(end), radius * std::sin(end)}, arc);
}

BlendedPath path_of(const std::vector<PathBlock>& blocks) {
  BlendedPath path;
  for (PathBlock block : blocks) {
    path.rate_join(block);
    path.push(block);
  }
  path.update(true);
  return path;
}

std::vector<LimitCell> cells_of(const BlendedPath& path, const ModeLimits& modes = limits(),
                                const geometry::Chain* chain = nullptr) {
  CellBuilder builder;
  builder.start(modes, chain, 0);
  CellRing ring;
  builder.extend(path, ring, 0);
  EXPECT_EQ(builder.next_block(), path.size());
  std::vector<LimitCell> cells;
  for (std::uint64_t k = 0; k < ring.size(); ++k) cells.push_back(ring[k]);
  return cells;
}

// One after the other from 0 to the end of the path, without a gap.
void expect_to_cover(const std::vector<LimitCell>& cells, const BlendedPath& path) {
  ASSERT_FALSE(cells.empty());
  EXPECT_EQ(cells.front().at, 0);
  EXPECT_EQ(cells.back().end, path.end());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    EXPECT_GT(cells[k].end, cells[k].at) << k;
    if (k > 0) {
      EXPECT_EQ(cells[k].at, cells[k - 1].end) << k;
    }
  }
}

// An axis with these derivatives must permit what a cell allows at each of its levels:
// q'v, q''v^2 + q'a, q'''v^3 + 3q''va + q'j.
void expect_within_axis_limits(const LimitCell& cell, double first, double second, double third,
                               double tolerance) {
  first = std::abs(first), second = std::abs(second), third = std::abs(third);
  for (std::size_t k = 0; k < LimitCell::levels; ++k) {
    const double v = LimitCell::shares[k] * cell.speed;
    const RampLimits& ramp = cell.ramps[k];
    EXPECT_GT(ramp.acceleration, 0);
    EXPECT_GT(ramp.jerk, 0);
    EXPECT_LE(first * v, feed_limit * (1 + tolerance));
    EXPECT_LE(second * v * v + first * ramp.acceleration, acceleration * (1 + tolerance));
    EXPECT_LE(third * v * v * v + 3 * second * v * ramp.acceleration + first * ramp.jerk,
              jerk * (1 + tolerance));
  }
}

// Along (0.6, 0.8) Y moves with 0.8 of the path: 100 / 0.8 = 125 mm/s, 1000 / 0.8 = 1250 mm/s^2 and
// 60000 / 0.8 = 75000 mm/s^3. A feed of 80 mm/s at the highest override of 150 % stays below: 120 mm/s. A
// rapid may take 200 / 0.8 = 250 mm/s, whatever the feed.
TEST(CellBuilder, a_line_is_one_cell_with_the_limits_of_its_weakest_axis) {
  const PathSegment line = PathSegment::line({}, {30, 40});
  PathBlock rapid = block_of(line, 80);
  rapid.rapid = true;
  for (const auto& [block, speed] :
       {std::pair{block_of(line), 125.0}, std::pair{block_of(line, 80), 120.0}, std::pair{rapid, 250.0}}) {
    const BlendedPath path = path_of({block});
    const auto cells = cells_of(path);
    ASSERT_EQ(cells.size(), 1u);
    expect_to_cover(cells, path);
    EXPECT_NEAR(cells[0].end, 50, 1e-12);
    EXPECT_NEAR(cells[0].speed, speed, 1e-9);
    EXPECT_NEAR(cells[0].top, speed, 1e-9);
    EXPECT_EQ(cells[0].feed, block.feed);
    EXPECT_EQ(cells[0].rapid, block.rapid);
    EXPECT_TRUE(cells[0].uniform);
    EXPECT_TRUE(cells[0].stop) << "the path begins at rest";
    for (const RampLimits& ramp : cells[0].ramps) {
      EXPECT_NEAR(ramp.acceleration, 1250, 1e-8);
      EXPECT_NEAR(ramp.jerk, 75000, 1e-6);
    }
  }
}

// At R = 10 mm an axis needs v^2 / 10 times the cosine of its angle for the circle: with 1000 mm/s^2 no more
// than 100 mm/s where it alone bears it, 119 where two axes share it. Cells that leave something to
// acceleration keep below that; checked axis by axis nearly all of it can be used. A cell is not longer than
// 0.025 rad and is evaluated at its ends: in the middle a sine is at most 1 / cos(0.0125) times as large.
TEST(CellBuilder, the_cells_of_an_arc_keep_the_axes_within_their_limits_and_use_most_of_them) {
  const double radius = 10, middle = 1 / std::cos(0.0125) - 1;
  const BlendedPath path = path_of({block_of(circle(radius, 180))});
  const auto cells = cells_of(path);
  EXPECT_EQ(cells.size(), 126u) << "pi / 0.025, rounded up";
  expect_to_cover(cells, path);
  for (const LimitCell& cell : cells) {
    EXPECT_FALSE(cell.uniform);
    EXPECT_LE(cell.end - cell.at, 0.025 * radius * (1 + 1e-9));
    double most = 0;
    for (const double angle : {cell.at / radius, cell.end / radius})
      most = std::max({most, std::abs(std::cos(angle)), std::abs(std::sin(angle))});
    const double fastest = 100 / std::sqrt(most);
    EXPECT_LT(cell.speed, fastest);
    EXPECT_GT(cell.speed, 0.8 * fastest);
    EXPECT_LE(cell.top, fastest);
    EXPECT_GT(cell.top, 0.99 * fastest);
    for (int k = 0; k <= 8; ++k) {
      const double angle = (cell.at + (cell.end - cell.at) * k / 8) / radius;
      const double c = std::cos(angle), s = std::sin(angle);
      expect_within_axis_limits(cell, s, c / radius, s / (radius * radius), middle);
      expect_within_axis_limits(cell, c, s / radius, c / (radius * radius), middle);
    }
  }
  // Both axes with their derivatives at the ends: at the start the tangent is Y and the centre lies at -X.
  const LimitCell& cell = cells.front();
  ASSERT_EQ(cell.axis_count, 2);
  EXPECT_NEAR(cell.axes[0].begin[0], 0, 1e-6);
  EXPECT_NEAR(cell.axes[0].begin[1], -0.1, 1e-6);
  EXPECT_NEAR(cell.axes[1].begin[0], 1, 1e-6);
  EXPECT_NEAR(cell.axes[1].begin[2], -0.01, 1e-6);
  const double angle = cell.end / radius;
  EXPECT_NEAR(cell.axes[0].end[0], -std::sin(angle), 1e-6);
  EXPECT_NEAR(cell.axes[1].end[1], -std::sin(angle) / radius, 1e-6);
}

// 200 mm/s^2 towards the centre at R = 10 mm: sqrt(2000) mm/s. A line has no centre.
TEST(CellBuilder, the_centripetal_limit_slows_arcs_and_no_lines) {
  auto modes = limits();
  for (Limits& mode : modes) mode.centripetal_acceleration = 200;
  for (const LimitCell& cell : cells_of(path_of({block_of(circle(10, 90))}), modes)) {
    EXPECT_NEAR(cell.speed, std::sqrt(2000.0), 1e-6);
    EXPECT_NEAR(cell.top, std::sqrt(2000.0), 1e-6);
  }
  EXPECT_NEAR(cells_of(path_of({block_of(PathSegment::line({}, {5}))}), modes)[0].speed, feed_limit, 1e-9);
}

// The rounding of X into Y with the reach w has q'' = (w - |x|) / w^2 and q''' = 1 / w^2 in both axes. With
// w = 0.6 mm, v^2 / w <= 1000 allows sqrt(600) = 24.5 mm/s and v^3 / w^2 <= 60000 allows 27.8.
TEST(CellBuilder, a_rounding_is_cut_at_its_ends_and_its_middle_and_what_is_beside_it_is_not_slowed) {
  const double reach = 0.6;
  PathBlock second = block_of(PathSegment::line({10}, {10, 10}));
  second.stop = false;
  BlendedPath path = path_of({block_of(PathSegment::line({}, {10})), second});
  path[1].reach = reach;
  const auto cells = cells_of(path);
  ASSERT_EQ(cells.size(), 4u);
  expect_to_cover(cells, path);
  EXPECT_NEAR(cells[1].at, 10 - reach, 1e-12);
  EXPECT_NEAR(cells[2].at, 10, 1e-12);
  EXPECT_NEAR(cells[3].at, 10 + reach, 1e-12);
  EXPECT_EQ(cells[1].block, 0u);
  EXPECT_EQ(cells[2].block, 1u);
  for (const std::size_t beside : {0, 3}) {
    EXPECT_TRUE(cells[beside].uniform);
    EXPECT_NEAR(cells[beside].speed, feed_limit, 1e-9);
  }
  for (const std::size_t k : {1, 2}) {
    const LimitCell& cell = cells[k];
    EXPECT_FALSE(cell.uniform);
    EXPECT_FALSE(cell.stop);
    EXPECT_LT(cell.speed, std::sqrt(acceleration * reach));
    EXPECT_GT(cell.speed, 0.8 * std::sqrt(acceleration * reach));
    for (int n = 0; n <= 8; ++n) {
      // The slope of X falls from 1 to 0 with the rest squared: 1/2 at the corner.
      const double x = cell.at + (cell.end - cell.at) * n / 8 - 10, rest = reach - std::abs(x);
      const double part = rest * rest / (2 * reach * reach), slope = x < 0 ? 1 - part : part;
      for (const double first : {slope, 1 - slope})
        expect_within_axis_limits(cell, first, rest / (reach * reach), 1 / (reach * reach), 1e-9);
    }
  }
}

// A table turns about X under a tip at rest 100 mm beside its axis: Y and Z go round a circle of 100 mm,
// 100 cos(a) and 100 sin(a), so with 1 degree of the path Z goes 1.745 cos(a) mm. It may move at 20 mm/s:
// 11.46 / cos(a) degrees/s.
TEST(CellBuilder, through_a_chain_the_linear_axes_that_follow_limit_the_turn) {
  geometry::ChainParameters parameters;
  parameters.table_2 = geometry::RotaryAxis{{1, 0, 0}, {0, 0, 0}, 0};
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(parameters));
  auto modes = limits();
  for (Limits& mode : modes) mode.axes[Z].velocity = 20;
  AxisValues from{}, to{};
  from[Y] = to[Y] = 100;
  to[A] = 10;
  const BlendedPath path = path_of({block_of(PathSegment::line(from, to))});
  ASSERT_EQ(path[0].path.unit(), LengthUnit::degree);
  const auto cells = cells_of(path, modes, &chain);
  ASSERT_EQ(cells.size(), 5u) << "2 degrees each";
  expect_to_cover(cells, path);
  for (const LimitCell& cell : cells) {
    const double slowest = 20 / (100 * degree * std::cos(cell.at * degree));
    EXPECT_LE(cell.speed, slowest);
    EXPECT_GT(cell.speed, 0.99 * slowest);
    for (int k = 0; k <= 8; ++k) {
      const double angle = (cell.at + (cell.end - cell.at) * k / 8) * degree;
      const double c = 100 * std::cos(angle), s = 100 * std::sin(angle);
      expect_within_axis_limits(cell, s * degree, c * degree * degree, s * degree * degree * degree, 0);
      expect_within_axis_limits(cell, c * degree, s * degree * degree, c * degree * degree * degree, 0);
      expect_within_axis_limits(cell, 1, 0, 0, 0);
    }
  }
  // The same move without the chain turns nothing but A.
  EXPECT_NEAR(cells_of(path, modes)[0].speed, feed_limit, 1e-9);
}

PathBlock overlapping(const PathSegment& segment) {
  PathBlock block = block_of(segment);
  block.overlap = true;
  block.rules = {0.01, 0.05};
  return block;
}

// At the same time t the first motion is j t^3 / 6 short of the corner and the second as far behind it; with
// 0.01 mm and 60000 mm/s^3 each takes 0.01 s for that. A little of the tolerance is left to rounding.
TEST(CellBuilder, stops_overlap_as_long_as_the_tolerance_of_the_corner_allows) {
  const PathSegment along_x = PathSegment::line({}, {10});
  const auto overlap = [&](const PathBlock& second) {
    const auto cells = cells_of(path_of({block_of(along_x), second}));
    EXPECT_EQ(cells.size(), 2u);
    EXPECT_TRUE(cells.back().stop);
    return cells.back().overlap;
  };
  const double corner = overlap(overlapping(PathSegment::line({10}, {10, 10})));
  EXPECT_LE(corner, 0.02);
  EXPECT_GT(corner, 0.0198);
  EXPECT_EQ(overlap(overlapping(PathSegment::line({10}, {0}))), 0) << "X would need twice its acceleration";
  EXPECT_EQ(overlap(block_of(PathSegment::line({10}, {10, 10}))), 0) << "the stop is exact";
  AxisValues turned{10};
  turned[A] = 10;
  EXPECT_EQ(overlap(overlapping(PathSegment::line({10}, turned))), 0) << "mm cannot be weighed by degrees";
  // 0.0001 mm are gone after (6e-4 / 60000)^(1/3) s: the next stretch must not be over before the first is.
  EXPECT_NEAR(overlap(overlapping(PathSegment::line({10}, {10, 1e-4}))), std::cbrt(1e-8), 1e-9);
}

TEST(CellBuilder, a_wait_is_of_the_cell_at_whose_start_motion_stops) {
  PathBlock second = block_of(PathSegment::line({10}, {10, 10}));
  second.wait_cycles = 70;
  const auto cells = cells_of(path_of({block_of(PathSegment::line({}, {10})), second}));
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0].wait_cycles, 0);
  EXPECT_TRUE(cells[1].stop);
  EXPECT_EQ(cells[1].wait_cycles, 70);
}

TEST(CellBuilder, only_what_is_settled_of_the_path_is_cut) {
  BlendedPath path;
  path.push(block_of(PathSegment::line({}, {1})));
  PathBlock second = block_of(PathSegment::line({1}, {1, 1}));
  second.rules = {0.01, 0.05};
  path.rate_join(second);
  second.stop = false;
  path.push(second);
  path.update(false);
  CellBuilder builder;
  builder.start(limits(), nullptr, 0);
  CellRing cells;
  builder.extend(path, cells, 0);
  EXPECT_EQ(cells.size(), 0u) << "the rounding is not known yet";
  path.update(true);
  builder.extend(path, cells, 0);
  EXPECT_EQ(builder.next_block(), 2u);
  EXPECT_EQ(cells[cells.size() - 1].end, path.end());
}

// A line, an arc behind a stop, and a line that runs on from it.
BlendedPath mixed_path() {
  PathBlock after = block_of(PathSegment::line({0, 10}, {-8, 10}));
  after.stop = false;
  return path_of({block_of(PathSegment::line({20, -5}, {10, 0})), block_of(circle(10, 90)), after});
}

TEST(CellBuilder, backwards_the_same_cells_come_in_reverse_with_the_coordinate_negated) {
  const BlendedPath path = mixed_path();
  const auto there = cells_of(path);
  CellBuilder builder;
  builder.start(limits(), nullptr, 0);
  builder.resume(2, path.end());
  CellRing back;
  EXPECT_TRUE(builder.extend_back(path, back, 0, 0));
  ASSERT_EQ(back.size(), there.size());
  for (std::size_t k = 0; k < there.size(); ++k) {
    const LimitCell &cell = back[k], &same = there[there.size() - 1 - k];
    EXPECT_EQ(cell.at, -same.end) << k;
    EXPECT_EQ(cell.end, -same.at) << k;
    EXPECT_EQ(cell.block, same.block) << k;
    EXPECT_EQ(cell.speed, same.speed) << k;
    EXPECT_EQ(cell.ramps[0].acceleration, same.ramps[0].acceleration) << k;
    ASSERT_EQ(cell.axis_count, same.axis_count) << k;
    for (int axis = 0; axis < cell.axis_count; ++axis) {
      const AxisOnCell &turned = cell.axes[axis], &straight = same.axes[axis];
      // By a coordinate that runs the other way the odd derivatives change their sign.
      EXPECT_EQ(turned.begin[0], -straight.end[0]) << k;
      EXPECT_EQ(turned.begin[1], straight.end[1]) << k;
      EXPECT_EQ(turned.begin[2], -straight.end[2]) << k;
      EXPECT_EQ(turned.end[0], -straight.begin[0]) << k;
    }
    // It stops where the motion forwards stopped: before the cell that follows the stop.
    const bool stopped = k > 0 && there[there.size() - k].stop;
    EXPECT_EQ(cell.stop, stopped) << k;
  }
}

TEST(CellBuilder, backwards_it_begins_where_it_is_told_and_ends_at_the_oldest_block_wanted) {
  const BlendedPath path = mixed_path();
  CellBuilder builder;
  builder.start(limits(), nullptr, 0);
  const double from = path[2].at + 3;
  builder.resume(2, from);
  CellRing back;
  EXPECT_TRUE(builder.extend_back(path, back, 0, 1));
  EXPECT_EQ(back[0].at, -from);
  EXPECT_EQ(back[back.size() - 1].end, -path[1].at);
  for (std::uint64_t k = 1; k < back.size(); ++k) EXPECT_EQ(back[k].at, back[k - 1].end) << k;
}

// 500 turns are 62,832 cells of 0.05 rad and more: two rings. What was cut is read again before it is given
// up, so no call may overwrite a cell from `keep` on.
TEST(CellBuilder, never_more_cells_than_the_ring_has_room_for_and_none_is_lost) {
  const BlendedPath path = path_of({block_of(circle(10, 360 * 500))});
  for (const bool backwards : {false, true}) {
    CellBuilder builder;
    builder.start(limits(), nullptr, 0);
    if (backwards) builder.resume(0, path.end());
    CellRing cells;
    std::uint64_t keep = 0, checked = 0;
    double at = backwards ? -path.end() : 0;
    bool full = false, complete = false;
    for (int call = 0; call < 2000 && !complete; ++call) {
      const std::uint64_t before = cells.size();
      if (backwards) {
        complete = builder.extend_back(path, cells, keep, 0);
      } else {
        builder.extend(path, cells, keep);
        complete = builder.next_block() == 1;
      }
      ASSERT_LE(cells.size() - keep, CellRing::capacity);
      if (cells.size() > before) continue;
      full = true;
      EXPECT_GT(cells.size() - keep, CellRing::capacity * 9 / 10) << "no more, although there is room";
      for (; checked + 10 < cells.size(); ++checked) {
        ASSERT_EQ(cells[checked].at, at) << checked;
        at = cells[checked].end;
      }
      keep = checked;
    }
    ASSERT_TRUE(complete);
    EXPECT_TRUE(full);
    EXPECT_GT(cells.size(), CellRing::capacity);
    for (; checked < cells.size(); ++checked) {
      ASSERT_EQ(cells[checked].at, at) << checked;
      at = cells[checked].end;
    }
    EXPECT_EQ(at, backwards ? 0 : path.end());
  }
}

}  // namespace
}  // namespace trunnion::motion
