// SPDX-License-Identifier: Apache-2.0
// What a thread makes of the angles of the spindle. At S 600 the spindle turns 0.01 revolutions in a cycle.
#include "thread_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace trunnion::channel {
namespace {

using language::Z;

/// Rows of the feedback come when the drive has executed them: a lead before the newest cycle, or earlier.
struct ThreadBench : ::testing::Test {
  void begin(std::function<double(std::uint64_t)> angle_of, double start_angle = 0, bool clockwise = true,
             double speed = 600) {
    angle = std::move(angle_of);
    ThreadLeg leg;
    leg.target[Z] = -20;
    leg.lead = 2;
    leg.start_angle = start_angle;
    ThreadSpindle spindle;
    spindle.speed = speed;
    spindle.clockwise = clockwise;
    ASSERT_EQ(run.begin({}, std::vector<ThreadLeg>{leg}, limits, spindle), ThreadPath::Fault::none);
    run.stream_starts(0);
  }
  /// Until it ends, or `most` cycles more.
  void go(std::size_t most, bool abandoned = false, bool held = false) {
    const std::size_t last = cycles.size() + most;
    while (cycles.size() < last && (cycles.empty() || !cycles.back().at_rest)) {
      const std::uint64_t first = cycles.size();
      for (; known + 28 < first + early; ++known) {
        idl::stream::Feedback row;
        row.first = known;
        row.count = 1;
        row.spindle_speed = {600};
        row.spindle_angle = {angle(known)};
        row.spindles.resize(1);
        row.spindles[0].homed = known >= homed_from;
        run.on_feedback(row);
      }
      run.begin_batch(first, abandoned || held);
      for (std::uint64_t i = 0; i < 4; ++i) cycles.push_back(run.step(first + i, abandoned, held));
    }
  }
  ThreadRun run;
  motion::Limits limits;
  std::function<double(std::uint64_t)> angle;
  std::vector<ThreadCycle> cycles;
  std::uint64_t known = 0, early = 0, homed_from = 0;
};

std::function<double(std::uint64_t)> steady(double from, double rate) {
  return [=](std::uint64_t cycle) { return from + rate * static_cast<double>(cycle); };
}

// 16 rows up to 33 cycles before: known from cycle 48 on. The run-in takes 1.024 revolutions, half of them
// before the start angle. 3.7 + 0.48 + 0.36 for a lead and a batch + 0.512 are 5.052: the next start angle
// is 5.25.
TEST_F(ThreadBench, TheToolGoesWithTheAngleThatTheSpindleWillHave) {
  begin(steady(3.7, 0.01), 90);
  go(100000);
  ASSERT_TRUE(run.ended());
  EXPECT_EQ(run.broken(), "");
  EXPECT_FALSE(cycles[47].angle);
  ASSERT_TRUE(cycles[48].angle);
  EXPECT_NEAR(run.path().origin(), 5.25, 1e-12);
  int steady_cycles = 0;
  for (std::size_t i = 48; i < cycles.size(); ++i) {
    const double at = 3.7 + 0.01 * static_cast<double>(i);
    ASSERT_NEAR(*cycles[i].angle, at, 1e-9);
    if (at < 5.25 - 0.513) {
      ASSERT_EQ(cycles[i].position[Z], 0);
    }
    if (at < 5.25 + 0.52 || at > 5.25 + 9.48) continue;
    ASSERT_NEAR(cycles[i].position[Z], -2 * (at - 5.25), 1e-8);
    ASSERT_NEAR(cycles[i].speed, 20, 1e-6) << "2 mm ten times a second";
    ++steady_cycles;
  }
  EXPECT_GT(steady_cycles, 890) << "8.96 revolutions";
  EXPECT_EQ(cycles.back().position[Z], -20);
}

TEST_F(ThreadBench, CounterClockwiseTheAngleFalls) {
  begin(steady(0.2, -0.01), 90, false);
  go(100000);
  EXPECT_EQ(run.broken(), "");
  EXPECT_EQ(cycles.back().position[Z], -20);
  const double origin = run.path().origin();
  EXPECT_NEAR(origin - std::floor(origin), 0.75, 1e-12) << "90 degrees behind the mark in its direction";
  const std::size_t middle = static_cast<std::size_t>(std::lround((0.2 - (origin - 5)) / 0.01));
  EXPECT_NEAR(cycles.at(middle).position[Z], -2 * (origin - *cycles.at(middle).angle), 1e-8);
}

TEST_F(ThreadBench, DoesNotDependOnHowEarlyTheFeedbackComes) {
  const auto turns = [](std::uint64_t cycle) {
    const double t = static_cast<double>(cycle);
    return 0.01 * t + 0.02 * std::sin(t / 50);
  };
  begin(turns);
  go(100000);
  auto late = std::move(cycles);
  cycles.clear();
  known = 0, early = 20;
  run.end();
  begin(turns);
  go(100000);
  ASSERT_EQ(cycles.size(), late.size());
  for (std::size_t i = 0; i < late.size(); ++i) ASSERT_EQ(cycles[i].position, late[i].position) << i;
}

// 0.002 in a thousand cycles: half the acceleration of 2e-6 times the square of 40.5 cycles, less that of the
// rows.
TEST_F(ThreadBench, AChangeOfSpeedShiftsTheAngleByWhatTheLineMisses) {
  const auto turns = [](std::uint64_t cycle) {
    const double t = static_cast<double>(cycle);
    return 0.01 * t + 1e-6 * t * t;
  };
  begin(turns);
  go(600);
  ASSERT_EQ(run.broken(), "");
  for (std::size_t i = 48; i < cycles.size(); ++i) {
    const double missed = turns(i) - *cycles[i].angle;
    ASSERT_NEAR(missed, 1e-6 * (40.5 * 40.5 - 255.0 / 12), 1e-9);
  }
}

TEST_F(ThreadBench, WaitsForTheSpeedAndTakesNoSpindleThatTurnsTheOtherWay) {
  begin(steady(0, -0.01));
  go(9000);
  EXPECT_FALSE(run.following());
  EXPECT_EQ(run.broken(), "");
  go(2000);
  EXPECT_TRUE(run.ended()) << "10 s are over";
  EXPECT_EQ(run.broken(), "the spindle turns at -600 1/min, S is 600 1/min");
  EXPECT_EQ(cycles.back().position[Z], 0);
}

// 2 mm ten times a second are 20 mm/s: the axis can do 5 % more.
TEST_F(ThreadBench, ASpindleFasterThanAnAxisCanFollowIsNotFollowed) {
  limits.axes[Z].velocity = 21;
  begin(steady(0, 0.0104));
  go(100000);
  EXPECT_EQ(run.broken(), "");
  EXPECT_EQ(cycles.back().position[Z], -20);
  cycles.clear();
  known = 0;
  begin(steady(0, 0.0106));
  go(11000);
  EXPECT_EQ(run.broken(), "the spindle turns at 636 1/min, S is 600 1/min, the axes can follow 630 1/min");
  EXPECT_EQ(cycles.back().position[Z], 0);
}

// The mark is passed in cycle 130, and the count steps by 0.37. The first batch whose 16 rows all count from
// it begins with cycle 180: its oldest row is that of cycle 132.
TEST_F(ThreadBench, ItDoesNotBeginBeforeTheAnglesCountFromTheIndexMark) {
  homed_from = 130;
  begin([](std::uint64_t cycle) { return 0.01 * static_cast<double>(cycle) - (cycle >= 130 ? 0.37 : 0); });
  go(100000);
  EXPECT_EQ(run.broken(), "");
  EXPECT_FALSE(cycles[179].angle);
  ASSERT_TRUE(cycles[180].angle);
  EXPECT_NEAR(*cycles[180].angle, 1.8 - 0.37, 1e-9);
  EXPECT_EQ(run.path().origin(), std::floor(run.path().origin()));
  EXPECT_EQ(cycles.back().position[Z], -20);
}

// After 10 s at 0.01 revolutions in a cycle.
TEST_F(ThreadBench, ASpindleWhoseIndexMarkDoesNotPassBreaksItOff) {
  homed_from = 1000000;
  begin(steady(0, 0.01));
  go(9000);
  EXPECT_FALSE(run.ended());
  EXPECT_EQ(run.waits_for(), "the thread waits for the index mark of the spindle");
  go(2000);
  EXPECT_TRUE(run.ended());
  EXPECT_EQ(run.broken(), "no index mark of the spindle has passed in 100 revolutions: see its encoder");
  EXPECT_EQ(run.waits_for(), "");
  EXPECT_EQ(cycles.back().position[Z], 0);
}

// At 5 1/min a revolution takes 12 s: two of them 24 s.
TEST_F(ThreadBench, ASlowSpindleHasTwoRevolutionsForItsIndexMark) {
  homed_from = 1000000;
  begin(steady(0, 5.0 / 60000), 0, true, 5);
  go(20000);
  EXPECT_FALSE(run.ended());
  go(5000);
  EXPECT_TRUE(run.ended());
  EXPECT_EQ(run.broken(), "no index mark of the spindle has passed in 2 revolutions: see its encoder");
}

// The PLC orders 400 1/min for half of 801, and a spindle at 150 % may be 1 % faster.
TEST_F(ThreadBench, ASpindleAtEitherEndOfItsOverrideIsFollowedToTheEnd) {
  for (const double share : {400 / 801.0, 0.46, 1.5 * 1.01, 1.59}) {
    cycles.clear();
    known = 0;
    begin(steady(0, 0.01 * share));
    go(100000);
    EXPECT_EQ(run.broken(), "") << share;
    EXPECT_EQ(cycles.back().position[Z], -20) << share;
    EXPECT_EQ(cycles.back().fraction, 1) << share;
  }
  for (const double share : {0.44, 1.61}) {
    cycles.clear();
    known = 0;
    begin(steady(0, 0.01 * share));
    go(11000);
    EXPECT_NE(run.broken(), "") << share;
  }
}

// Half of 5 1/min is 2 in whole numbers.
TEST_F(ThreadBench, ALowSpeedMayBeLessThanHalfByThePartThatIsNotOrdered) {
  begin(steady(0, 2.0 / 60000), 0, true, 5);
  go(400);
  EXPECT_TRUE(run.following());
}

TEST_F(ThreadBench, ASpindleThatStandsEndsItAfterASecond) {
  begin(steady(7, 0));
  go(1000);
  EXPECT_FALSE(run.ended());
  go(100);
  EXPECT_TRUE(run.ended());
  EXPECT_EQ(run.broken(), "the spindle is at rest");
}

TEST_F(ThreadBench, WithoutAnglesOfTheSpindleItEndsAfterASecond) {
  begin(steady(0, 0.01));
  known = 1000000;  // none come
  go(1000);
  EXPECT_FALSE(run.ended());
  go(100);
  EXPECT_TRUE(run.ended());
  EXPECT_EQ(run.broken(), "the drive reports no angles of the spindle");
}

TEST_F(ThreadBench, AHoldBeforeItBeginsStopsAtOnceAndItBeginsAnewAfterwards) {
  begin(steady(0, 0.004));  // 40 %: not at speed
  go(200);
  go(4, false, true);
  EXPECT_TRUE(cycles.back().at_rest);
  EXPECT_FALSE(run.ended());
  EXPECT_TRUE(run.cutting());
}

// Half the speed in a second: below 45 % it is broken off, and the axes come to rest on the pitch line.
TEST_F(ThreadBench, ASpindleThatSlowsDownBreaksTheThreadOff) {
  const auto turns = [](std::uint64_t cycle) {
    const double t = std::min(static_cast<double>(cycle), 1600.0);
    return 0.01 * t - (t > 600 ? 0.005e-3 * (t - 600) * (t - 600) : 0);  // stands from cycle 1600 on
  };
  begin(turns);
  go(100000);
  EXPECT_TRUE(run.ended());
  EXPECT_NE(run.broken().find("S is 600 1/min"), std::string::npos) << run.broken();
  EXPECT_GT(cycles.back().position[Z], -20);
  for (std::size_t i = 1; i < cycles.size(); ++i)
    ASSERT_LT(std::abs(cycles[i].position[Z] - cycles[i - 1].position[Z]), 0.025) << "2 mm times 0.0125";
}

TEST_F(ThreadBench, AnAbandonedThreadIsLeftAtTheNextOccasion) {
  begin(steady(0, 0.01));
  go(600);
  const double z = cycles.back().position[Z];
  ASSERT_LT(z, -4);
  go(1000, true);
  EXPECT_TRUE(run.ended());
  EXPECT_EQ(run.broken(), "");
  // The pitch line ends 0.512 revolutions behind the first abandoned cycle, which is one behind z.
  EXPECT_NEAR(cycles.back().position[Z], z - 2 * (0.512 + 0.01), 1e-6);
  EXPECT_LT(cycles.back().fraction, 1);
}

TEST_F(ThreadBench, AThreadThatTheAxesCannotCutIsRefused) {
  ThreadLeg leg;
  leg.target[Z] = -1;
  leg.lead = 2;
  ThreadSpindle spindle;
  spindle.speed = 600;
  EXPECT_EQ(run.begin({}, std::vector<ThreadLeg>{leg}, motion::Limits{}, spindle),
            ThreadPath::Fault::too_short);
  EXPECT_FALSE(run.cutting());
}

}  // namespace
}  // namespace trunnion::channel
