// SPDX-License-Identifier: Apache-2.0
// The interpolation alone: a path of blocks made by hand, and places and tails in the stead of a speed stage.
#include "motion/interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trunnion::motion {
namespace {

// A power of two, so that the times left of a tail are exact.
constexpr double interpolation_cycle = 1.0 / 1024;

PathBlock line_block(const AxisValues& from, const AxisValues& to, std::uint32_t number) {
  PathBlock block;
  block.path = PathSegment::line(from, to);
  block.line = 10 * number;
  block.sequence = number;
  return block;
}

// 10 mm along X, a rapid of 20 mm along Y, 5 mm down: all of them between stops.
BlendedPath three_lines() {
  BlendedPath path;
  path.push(line_block({}, {10}, 1));
  PathBlock rapid = line_block({10}, {10, 20}, 2);
  rapid.rapid = true;
  path.push(rapid);
  path.push(line_block({10, 20}, {10, 20, -5}, 3));
  return path;
}

PathPlace at(std::uint64_t block, double s) {
  PathPlace place;
  place.block = block;
  place.s = s;
  place.speed = 50;
  place.started = true;
  return place;
}

TEST(Interpolation, a_block_ends_on_its_target_bit_for_bit_and_the_next_begins_there) {
  const AxisValues corner{0.1, 0.7, -0.3, 0, 0, 1.0 / 3};
  BlendedPath path;
  path.push(line_block({}, corner, 1));
  path.push(line_block(corner, {2, 3, 4}, 2));
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({});
  EXPECT_EQ(interpolation.follow(path, at(0, 0)).position, AxisValues{});
  const Setpoint end = interpolation.follow(path, at(0, path[0].end()));
  EXPECT_EQ(end.position, corner);
  EXPECT_EQ(end.distance_to_go, AxisValues{});
  EXPECT_EQ(interpolation.position(), corner);
  const Setpoint next = interpolation.follow(path, at(1, path[1].at));
  EXPECT_EQ(next.position, corner);
  EXPECT_EQ(next.feed, 0);
}

TEST(Interpolation, line_sequence_and_fraction_change_with_the_block) {
  const BlendedPath path = three_lines();
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({});
  const auto expect = [&](const PathPlace& place, std::uint32_t number, double fraction) {
    const Setpoint s = interpolation.follow(path, place);
    EXPECT_EQ(s.line, 10 * number) << place.s;
    EXPECT_EQ(s.sequence, number) << place.s;
    EXPECT_DOUBLE_EQ(s.fraction, fraction) << place.s;
    EXPECT_EQ(s.rapid, number == 2) << place.s;
    EXPECT_EQ(s.path_speed, 50);
  };
  expect(at(0, 0), 1, 0);
  expect(at(0, 2.5), 1, 0.25);
  expect(at(0, 10), 1, 1);  // the border is the end of the one
  expect(at(1, 10), 2, 0);  // and the start of the other
  expect(at(1, 25), 2, 0.75);
  expect(at(2, 30), 3, 0);
  expect(at(2, 35), 3, 1);
}

// A quarter of the command lay before the block: half of the block is 1/4 + 3/4 * 1/2 of the command.
TEST(Interpolation, the_fraction_counts_what_of_the_command_lay_before_the_block) {
  BlendedPath path;
  PathBlock block = line_block({}, {10}, 1);
  block.fraction_offset = 0.25;
  path.push(block);
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({});
  EXPECT_DOUBLE_EQ(interpolation.follow(path, at(0, 0)).fraction, 0.25);
  EXPECT_DOUBLE_EQ(interpolation.follow(path, at(0, 5)).fraction, 0.625);
  EXPECT_DOUBLE_EQ(interpolation.follow(path, at(0, 10)).fraction, 1);
}

TEST(Interpolation, a_dwell_stands_on_the_border_at_fraction_0_while_it_waits_and_1_behind_it) {
  BlendedPath path;
  path.push(line_block({}, {10}, 1));
  path.push(line_block({10}, {10}, 2));
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({});
  EXPECT_FALSE(interpolation.follow(path, at(0, 10)).dwelling);
  PathPlace place = at(1, 10);
  place.waiting = true;
  place.speed = 0;
  for (int k = 0; k < 3; ++k) {
    const Setpoint s = interpolation.follow(path, place);
    EXPECT_TRUE(s.dwelling);
    EXPECT_EQ(s.sequence, 2u);
    EXPECT_EQ(s.fraction, 0);
    EXPECT_EQ(s.position, AxisValues{10});
    EXPECT_EQ(s.feed, 0);
    EXPECT_EQ(s.path_speed, 0);
  }
  place.waiting = false;
  const Setpoint over = interpolation.follow(path, place);
  EXPECT_FALSE(over.dwelling);
  EXPECT_EQ(over.fraction, 1);
}

TEST(Interpolation, the_axes_stay_until_the_path_is_entered_and_without_a_path) {
  const BlendedPath path = three_lines();
  Interpolation interpolation(interpolation_cycle);
  const AxisValues here{-1, -2, -3};
  interpolation.start(here);
  EXPECT_EQ(interpolation.stay().line, 0u);
  PathPlace place = at(0, 0);
  place.started = false;
  EXPECT_EQ(interpolation.follow(path, place).position, here);
  const Setpoint last = interpolation.follow(path, at(1, 15));
  const Setpoint idle = interpolation.stay();
  EXPECT_EQ(idle.position, last.position);
  EXPECT_EQ(idle.line, last.line);
  EXPECT_EQ(idle.sequence, last.sequence);
  EXPECT_EQ(idle.fraction, last.fraction);
  EXPECT_EQ(idle.distance_to_go, AxisValues{});
  EXPECT_EQ(idle.feed, 0);
  EXPECT_EQ(idle.path_speed, 0);
  EXPECT_FALSE(idle.rapid);
  interpolation.start({});
  EXPECT_EQ(interpolation.stay().sequence, 0u);
  EXPECT_EQ(interpolation.stay().fraction, 0);
}

// 3 mm in X and 4 in Y within a cycle are 5 mm in 1/1024 s; the 7 degrees of A are no feed.
TEST(Interpolation, the_feed_is_the_speed_of_x_y_z_and_the_distance_to_go_counts_every_axis) {
  BlendedPath path;
  path.push(line_block({}, {6, 8, 0, 14}, 1));
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({});
  interpolation.follow(path, at(0, 0));
  const Setpoint s = interpolation.follow(path, at(0, 5));
  EXPECT_NEAR(s.feed, 5 * 1024, 1e-9);
  const AxisValues rest{3, 4, 0, 7};
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(s.distance_to_go[i], rest[i], 1e-12) << i;
}

// The corner between X and Y with a reach of w is left by D w / 6, D = (-1, 1).
TEST(Interpolation, a_rounded_corner_is_passed_beside_it) {
  BlendedPath path;
  path.push(line_block({}, {10}, 1));
  PathBlock block = line_block({10}, {10, 10}, 2);
  path.rate_join(block);
  block.stop = false;
  path.push(block);
  path[1].reach = 0.6;
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({});
  const Setpoint s = interpolation.follow(path, at(1, 10));
  EXPECT_NEAR(s.position[0], 9.9, 1e-12);
  EXPECT_NEAR(s.position[1], 0.1, 1e-12);
  EXPECT_EQ(interpolation.follow(path, at(1, 20)).position, (AxisValues{10, 10}));
}

// n cycles before its end a tail is j (n / 1024)^3 / 6 short of the corner; with j = 6 * 1024^3 / 1e6 that is
// n^3 / 1e6 mm. What the next stretch has done meanwhile is added.
TEST(Interpolation, a_tail_is_added_to_the_next_stretch_until_it_is_over) {
  const BlendedPath path = three_lines();
  Interpolation interpolation(interpolation_cycle);
  interpolation.start({10});
  Tail tail;
  tail.end = 10;
  tail.time = 4 * interpolation_cycle;
  tail.jerk = 6.0 * 1024 * 1024 * 1024 / 1e6;
  interpolation.begin_tail(tail, 0);
  double along = 0;
  for (int left = 4; left > 0; --left) {
    EXPECT_TRUE(interpolation.overlapping());
    const Setpoint s = interpolation.follow(path, at(1, 10 + along));
    EXPECT_NEAR(s.position[0], 10 - left * left * left / 1e6, 1e-12) << left;
    EXPECT_NEAR(s.position[1], along, 1e-12) << left;
    EXPECT_EQ(s.sequence, 2u);
    interpolation.pass_cycle();
    along += 0.5;
  }
  EXPECT_FALSE(interpolation.overlapping());
  EXPECT_EQ(interpolation.follow(path, at(1, 12)).position, (AxisValues{10, 2}));
}

TEST(Interpolation, a_tail_that_is_dropped_is_not_added) {
  const BlendedPath path = three_lines();
  Interpolation interpolation(interpolation_cycle);
  for (const bool by_start : {false, true}) {
    interpolation.start({10});
    interpolation.begin_tail({10, 4 * interpolation_cycle, 1e6, 0}, 0);
    by_start ? interpolation.start({10}) : interpolation.drop_tail();
    EXPECT_FALSE(interpolation.overlapping());
    EXPECT_EQ(interpolation.follow(path, at(1, 10)).position, AxisValues{10});
  }
}

TEST(Interpolation, backwards_it_gives_the_same_positions_and_progress_in_reverse) {
  const BlendedPath path = three_lines();
  std::vector<PathPlace> places;
  for (std::uint64_t block = 0; block < path.size(); ++block)
    for (int k = 0; k <= 8; ++k)
      places.push_back(at(block, path[block].at + path[block].path.length() * k / 8));
  Interpolation forwards(interpolation_cycle), backwards(interpolation_cycle);
  forwards.start({});
  std::vector<Setpoint> there;
  for (const PathPlace& place : places) there.push_back(forwards.follow(path, place));
  backwards.start(there.back().position);
  for (std::size_t k = places.size(); k-- > 0;) {
    const Setpoint s = backwards.follow(path, places[k]);
    EXPECT_EQ(s.position, there[k].position) << k;
    EXPECT_EQ(s.distance_to_go, there[k].distance_to_go) << k;
    EXPECT_EQ(s.sequence, there[k].sequence) << k;
    EXPECT_EQ(s.fraction, there[k].fraction) << k;
    const double feed_there = k + 1 < there.size() ? there[k + 1].feed : 0;
    EXPECT_DOUBLE_EQ(s.feed, feed_there) << k;
  }
  EXPECT_EQ(backwards.position(), AxisValues{});
}

}  // namespace
}  // namespace trunnion::motion
