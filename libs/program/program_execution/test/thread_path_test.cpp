// SPDX-License-Identifier: Apache-2.0
// The way of a thread over the angle of the spindle. Axes of 1000 mm/s^2 and 60000 mm/s^3; at S 600 with the
// margin of 1.6 the spindle turns 16 times a second.
#include "program_execution/thread_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trunnion::program_execution {
namespace {

using language::X;
using language::Z;

motion::Limits thread_limits() {
  motion::Limits limits;
  for (auto& axis : limits.axes) axis.acceleration = 1000, axis.jerk = 60000;
  return limits;
}

ThreadLeg leg_to(double x, double z, double lead, double change = 0) {
  ThreadLeg leg;
  leg.target[X] = x, leg.target[Z] = z;
  leg.lead = lead, leg.lead_change = change;
  return leg;
}

ThreadPath path_of(const std::vector<ThreadLeg>& legs, double speed = 600, bool clockwise = true) {
  ThreadPath path;
  EXPECT_EQ(path.build({}, legs, speed, clockwise, thread_limits()), ThreadPath::Fault::none);
  return path;
}

double z_at(const ThreadPath& path, double angle) { return path.at(angle).position[Z]; }

// The acceleration needs 2 * 16^2 / 1000 = 0.512 revolutions before and behind the start, more than the jerk
// with sqrt(2 * 16^3 / 60000) = 0.370: over 1.024 revolutions the tool goes half as far as on the pitch line,
// 1.024 mm.
TEST(ThreadPath, RunInBeginsBeforeTheStartAngleAndRunOutEndsBehindThatOfTheEnd) {
  const auto path = path_of({leg_to(0, -20, 2)});
  EXPECT_NEAR(path.length_of_run_in(), 1.024, 1e-12);
  EXPECT_NEAR(path.length_of_run_out(), 1.024, 1e-12);
  EXPECT_TRUE(path.waits(-0.5120001));
  EXPECT_FALSE(path.waits(-0.5119999));
  EXPECT_NEAR(z_at(path, -0.512), 0, 1e-12);
  // At the start angle the parabola has gone a twelfth of the 1.024 revolutions times the lead.
  EXPECT_NEAR(z_at(path, 0), -2 * 1.024 / 12, 1e-12);
  EXPECT_NEAR(z_at(path, 0.512), -1.024, 1e-12);
  EXPECT_NEAR(z_at(path, 5), -10, 1e-12);
  EXPECT_NEAR(z_at(path, 9.488), -18.976, 1e-12);
  EXPECT_NEAR(z_at(path, 10), -20 + 2 * 1.024 / 12, 1e-12);
  EXPECT_FALSE(path.done(10.5119999));
  EXPECT_TRUE(path.done(10.5120001));
  EXPECT_EQ(z_at(path, 11), -20);
}

// A program continues behind a thread of which all is done: in the run-out, and where it was braked, it is
// not.
TEST(ThreadPath, IsDoneOnlyAtRestAtItsEnd) {
  auto path = path_of({leg_to(0, -10, 2), leg_to(1, -20, 2)});
  EXPECT_LT(path.at(4.9999999999).fraction, 1) << "another leg follows";
  EXPECT_LT(path.at(10.3).fraction, 1) << "the run-out ends 0.512 revolutions behind the end";
  EXPECT_EQ(path.at(10.6).fraction, 1);
  path.brake_from(7);
  ASSERT_TRUE(path.done(9));
  EXPECT_LT(path.at(9).fraction, 1);
  auto waiting = path_of({leg_to(0, -20, 2)});
  waiting.brake_from(-2);
  EXPECT_LT(waiting.at(-1.9).fraction, 1);
}

// At S 200 the spindle turns 16/3 times a second: 0.057 revolutions for the acceleration, and for the jerk
// sqrt(2 * (16/3)^3 / 60000) = 0.071; the cube is 4096/27.
TEST(ThreadPath, AtALowSpeedTheJerkDecides) {
  const auto path = path_of({leg_to(0, -20, 2)}, 200);
  EXPECT_NEAR(path.length_of_run_in(), 2 * std::sqrt(2 * 4096.0 / 27 / 60000), 1e-12);
}

TEST(ThreadPath, IsInPhaseAtEverySpeed) {
  auto slow = path_of({leg_to(0, -20, 1)}, 300), fast = path_of({leg_to(0, -20, 1)}, 1500);
  // 8^2 / 1000 revolutions, sqrt(8^3 / 60000) are more; 40^2 / 1000 = 1.6.
  EXPECT_NEAR(slow.length_of_run_in(), std::sqrt(512.0 / 60000), 1e-12);
  EXPECT_NEAR(fast.length_of_run_in(), 1.6, 1e-12);
  slow.set_origin(100.25), fast.set_origin(37.25);
  for (double turned = 2; turned < 18; turned += 0.125) {
    EXPECT_NEAR(z_at(slow, 100.25 + turned), -turned, 1e-9);
    EXPECT_NEAR(z_at(fast, 37.25 + turned), -turned, 1e-9);
  }
}

// 90 degrees are 0.25 revolutions behind the mark; the run-in begins 0.512 before.
TEST(ThreadPath, BeginsAtTheFirstPassageOfTheStartAngleBeforeWhichTheRunInHasRoom) {
  auto leg = leg_to(0, -20, 2);
  leg.start_angle = 90;
  const auto right = path_of({leg});
  EXPECT_NEAR(right.first_origin(7.0, 0.1), 8.25, 1e-12) << "7 + 0.1 + 0.512 is beyond 7.25";
  EXPECT_NEAR(right.first_origin(6.6, 0.1), 7.25, 1e-12);
  // Counter-clockwise the angle falls: 90 degrees behind mark -7 is -7.25.
  const auto left = path_of({leg}, 600, false);
  EXPECT_NEAR(left.first_origin(-7.0, 0.1), -8.25, 1e-12);
  EXPECT_NEAR(left.first_origin(-6.6, 0.1), -7.25, 1e-12);
  leg.start_angle = 0;
  EXPECT_NEAR(path_of({leg}).first_origin(-3.2, 0.1), -2, 1e-12) << "-3.2 + 0.612 = -2.588";
}

TEST(ThreadPath, StartsOfAMultipleThreadAreAnAngleApart) {
  auto first = leg_to(0, -20, 2), second = first;
  second.start_angle = 180;
  auto one = path_of({first}), two = path_of({second});
  one.set_origin(one.first_origin(0, 0.1));
  two.set_origin(two.first_origin(0, 0.1));
  // 0.612 rounded up to a mark, and to half a revolution behind one.
  EXPECT_NEAR(one.origin(), 1, 1e-12);
  EXPECT_NEAR(two.origin(), 1.5, 1e-12);
  EXPECT_NEAR(z_at(one, 5) - z_at(two, 5), -1, 1e-9) << "half the lead";
}

TEST(ThreadPath, CounterClockwiseItIsTheMirrorImage) {
  const auto right = path_of({leg_to(0, -20, 2)}), left = path_of({leg_to(0, -20, 2)}, 600, false);
  for (double turned = -1; turned < 12; turned += 0.0625) {
    EXPECT_EQ(left.at(-turned).position, right.at(turned).position);
    EXPECT_EQ(left.at(-turned).velocity, right.at(turned).velocity);
    EXPECT_EQ(left.done(-turned), right.done(turned));
  }
}

// Z goes 20 mm and X 5: the lead of 2 is that of Z, X makes a quarter of it. At 45 degrees both have it.
TEST(ThreadPath, TheLeadOfATaperIsThatOfTheAxisThatGoesFarthest) {
  const auto taper = path_of({leg_to(5, -20, 2)});
  EXPECT_NEAR(z_at(taper, 5), -10, 1e-12);
  EXPECT_NEAR(taper.at(5).position[X], 2.5, 1e-12);
  const auto equal = path_of({leg_to(20, -20, 2)});
  EXPECT_NEAR(equal.at(5).position[X], 10, 1e-12);
}

// Lead 1 growing by 0.1: 10 mm are (sqrt(1 + 2 * 0.1 * 10) - 1) / 0.1 = 7.3205 revolutions.
TEST(ThreadPath, AVariableLeadGrowsEvenlyWithTheAngle) {
  const auto path = path_of({leg_to(0, -10, 1, 0.1)});
  for (double turned = 1; turned < 6; turned += 0.25) {
    EXPECT_NEAR(z_at(path, turned), -(turned + 0.05 * turned * turned), 1e-9);
    EXPECT_NEAR(path.at(turned).velocity[Z], -(1 + 0.1 * turned), 1e-9);
  }
  const double last = (std::sqrt(3.0) - 1) / 0.1;
  EXPECT_FALSE(path.done(last));
  EXPECT_TRUE(path.done(last + 1));
  EXPECT_EQ(z_at(path, last + 1), -10);
}

// 10 mm of lead 2 are 5 revolutions, 9 mm of lead 3 are 3.
TEST(ThreadPath, ChainedLegsAreOnePathWithEveryLegOnItsOwnPitchLine) {
  const auto path = path_of({leg_to(0, -10, 2), leg_to(1, -19, 3)});
  EXPECT_NEAR(z_at(path, 4), -8, 1e-12);
  EXPECT_NEAR(z_at(path, 6.5), -14.5, 1e-9);
  EXPECT_NEAR(path.at(6.5).position[X], 0.5, 1e-9);
  EXPECT_EQ(path.at(4).leg, 0u);
  EXPECT_NEAR(path.at(4).fraction, 0.8, 1e-12);
  EXPECT_EQ(path.at(6.5).leg, 1u);
  EXPECT_NEAR(path.at(6.5).fraction, 0.5, 1e-12);
}

/// The path over time at the highest speed that it is made for, in steps of 0.1 ms.
void expect_limits(const ThreadPath& path, double last) {
  constexpr double dt = 1e-4, rate = 16;
  AxisValues before{}, velocity{}, acceleration{};
  before = path.at(-1).position;
  const auto limits = thread_limits();
  int step = 0;
  for (double turned = -1; turned < last; turned += rate * dt, ++step) {
    const auto place = path.at(turned);
    for (std::size_t axis = 0; axis < before.size(); ++axis) {
      const double v = (place.position[axis] - before[axis]) / dt;
      const double a = step > 1 ? (v - velocity[axis]) / dt : 0;
      const double j = step > 2 ? (a - acceleration[axis]) / dt : 0;
      ASSERT_LE(std::abs(a), limits.axes[axis].acceleration * (1 + 1e-3)) << axis << " at " << turned;
      ASSERT_LE(std::abs(j), limits.axes[axis].jerk * 1.01) << axis << " at " << turned;
      if (step > 0) {
        // The velocity is the derivative of the position: half a step of it apart.
        ASSERT_NEAR(v, rate * place.velocity[axis], 1000 * dt) << axis << " at " << turned;
      }
      velocity[axis] = v, acceleration[axis] = a;
    }
    before = place.position;
  }
}

TEST(ThreadPath, PositionAndVelocityAreContinuousAndKeepToTheLimitsUpToTheMargin) {
  expect_limits(path_of({leg_to(0, -20, 2)}), 11);
  expect_limits(path_of({leg_to(0, -10, 2), leg_to(1, -19, 3)}), 9);
  expect_limits(path_of({leg_to(0, -10, 1, 0.1)}), 9);
  expect_limits(path_of({leg_to(0, -10, 1), leg_to(4, -20, 1, 0.1), leg_to(6, -30, 1.5, -0.05)}), 30);
  // A square corner.
  expect_limits(path_of({leg_to(0, -20, 1), leg_to(20, -20, 1)}), 42);
}

// 2 mm ten times a second, and 1.25 times as much. With a lead from 1 to sqrt(1 + 2 * 0.1 * 10) = 1.7320508 Z
// goes 17.320508 mm/s at the end.
TEST(ThreadPath, TheSlowestAxisSaysHowMuchFasterTheSpindleMayTurn) {
  EXPECT_EQ(path_of({leg_to(0, -20, 2)}).highest_share(), ThreadPath::speed_margin);
  auto limits = thread_limits();
  limits.axes[Z].velocity = 25;
  ThreadPath path;
  const std::vector<ThreadLeg> even{leg_to(5, -20, 2)}, growing{leg_to(0, -10, 1, 0.1)};
  ASSERT_EQ(path.build({}, even, 600, true, limits), ThreadPath::Fault::none);
  EXPECT_NEAR(path.highest_share(), 1.25, 1e-12);
  limits.axes[Z].velocity = 20;
  ASSERT_EQ(path.build({}, growing, 600, true, limits), ThreadPath::Fault::none);
  EXPECT_NEAR(path.highest_share(), 20 / (10 * std::sqrt(3.0)), 1e-12);
}

TEST(ThreadPath, ALegWithoutRoomForItsEndsIsRefused) {
  ThreadPath path;
  // 0.512 revolutions at either end are 2.048 mm of the pitch line.
  const std::vector<ThreadLeg> enough{leg_to(0, -2.06, 2)}, too_short{leg_to(0, -2.04, 2)};
  EXPECT_EQ(path.build({}, enough, 600, true, thread_limits()), ThreadPath::Fault::none);
  EXPECT_EQ(path.build({}, too_short, 600, true, thread_limits()), ThreadPath::Fault::too_short);
  const std::vector<ThreadLeg> second_too_short{leg_to(0, -20, 2), leg_to(0.5, -20, 2)};
  EXPECT_EQ(path.build({}, second_too_short, 600, true, thread_limits()), ThreadPath::Fault::too_short);
  EXPECT_EQ(path.faulty_leg(), 1u);
  // 16^2 * 5 are 1280 mm/s^2.
  const std::vector<ThreadLeg> too_fast{leg_to(0, -20, 1, 5)};
  EXPECT_EQ(path.build({}, too_fast, 600, true, thread_limits()), ThreadPath::Fault::acceleration);
}

TEST(ThreadPath, BrakesAlongThePitchLine) {
  auto path = path_of({leg_to(0, -20, 2)});
  const double before = z_at(path, 5);
  path.brake_from(5);
  EXPECT_NEAR(z_at(path, 5), before, 1e-12);
  EXPECT_FALSE(path.done(6.01));
  EXPECT_TRUE(path.done(6.03)) << "1.024 revolutions, as the run-out";
  EXPECT_NEAR(path.end()[Z], -11.024, 1e-9);
  EXPECT_EQ(z_at(path, 7), path.end()[Z]);
  expect_limits(path, 7);
}

TEST(ThreadPath, ABrakeInTheRunInWaitsForItsEndAndOneInTheRunOutChangesNothing) {
  auto early = path_of({leg_to(0, -20, 2)});
  early.brake_from(0);
  EXPECT_NEAR(early.end()[Z], -2.048, 1e-9) << "1.024 mm of run-in and 1.024 mm to stop";
  expect_limits(early, 3);
  auto late = path_of({leg_to(0, -20, 2)});
  late.brake_from(9.7);
  EXPECT_EQ(late.end()[Z], -20);
  EXPECT_FALSE(late.done(10.4));
  auto waiting = path_of({leg_to(0, -20, 2)});
  waiting.brake_from(-2);
  EXPECT_TRUE(waiting.done(-1.9));
  EXPECT_EQ(z_at(waiting, 3), 0);
}

// The corner at 5 revolutions takes 0.512 before and behind it.
TEST(ThreadPath, ABrakeBeforeACornerDoesNotGoBeyondIt) {
  auto path = path_of({leg_to(0, -10, 2), leg_to(10, -10, 2)});
  path.brake_from(4.48);
  EXPECT_NEAR(path.end()[Z], -9.984, 1e-9) << "4.48 + 0.512 revolutions are before the corner";
  auto beyond = path_of({leg_to(0, -10, 2), leg_to(10, -10, 2)});
  beyond.brake_from(4.6);
  EXPECT_EQ(beyond.end()[Z], -10) << "the corner has begun";
  EXPECT_NEAR(beyond.end()[X], 2.048, 1e-9) << "0.512 revolutions behind the corner and 0.512 more";
  expect_limits(beyond, 8);
}

TEST(ThreadPath, AsALineItHasTheMeanLeadTimesTheSpeed) {
  language::Command thread;
  thread.kind = language::CommandKind::thread;
  thread.value = 2;
  thread.target[X] = 3, thread.target[Z] = -4;
  thread.modal.feed_mode = language::FeedMode::per_revolution;
  thread.modal.spindle_speed = 300;
  // Z makes 600 mm/min, the path 5/4 of it.
  const auto line = thread_line(thread, {});
  EXPECT_EQ(line.kind, language::CommandKind::line);
  EXPECT_EQ(line.modal.feed_mode, language::FeedMode::per_minute);
  EXPECT_NEAR(line.modal.feed, 750, 1e-9);
  // From 2 to sqrt(4 + 2 * 1.5 * 4) = 4: 3 on the average.
  thread.lead_change = 1.5;
  EXPECT_NEAR(thread_line(thread, {}).modal.feed, 1125, 1e-9);
}

}  // namespace
}  // namespace trunnion::program_execution
