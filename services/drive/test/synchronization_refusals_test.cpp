// SPDX-License-Identifier: Apache-2.0
// What refuses the synchronization of two spindles, or ends it.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "synchronized_spindles.hpp"
#include "three_spindles.hpp"

namespace trunnion::drive::synchronized_spindles_test {
namespace {

using idl::stream::SpindleCondition;
using Problem = SynchronizationProblem;

TEST(SynchronizedSpindles, ASpindleThatIsNotHomedIsRefusedOnceUntilTheRequestComesAgain) {
  for (const std::size_t unknown : {0u, 1u}) {
    Shop shop;
    shop.status[unknown].homed = false;
    shop.spindles.couple({following(1, 0)});
    shop.run(10);
    ASSERT_EQ(shop.found.size(), 1u);
    EXPECT_EQ(shop.found[0].problem, Problem::not_homed);
    const auto event = event_of(shop.found[0], shop.spindles.axes());
    EXPECT_EQ(event.alarm->number, 183u);
    EXPECT_EQ(event.part, 5 + unknown) << "the spindle that is not homed";
    EXPECT_EQ(event.text, "Spindle S2 is not synchronized with Spindle S1: Spindle " +
                              std::string(unknown == 0 ? "S1" : "S2") +
                              " has not passed its index mark since the start; turn it; withdraw the "
                              "request, then give it again");
    shop.status[unknown].homed = true;
    shop.run(10);
    EXPECT_EQ(shop.state(1).master, -1) << "it does not begin by itself";
    shop.spindles.couple({following(1, 0)});
    shop.run(10);
    EXPECT_EQ(shop.state(1).master, -1) << "the same request";
    shop.spindles.couple({});
    shop.spindles.couple({following(1, 0)});
    shop.run(10);
    EXPECT_EQ(shop.state(1).master, 0);
    EXPECT_EQ(shop.found.size(), 1u);
  }
}

TEST(SynchronizedSpindles, RequestsThatMakeNoSenseAreRefused) {
  const auto problem_of = [](const std::vector<idl::plc::SpindleCoupling>& couplings) {
    Shop shop;
    shop.spindles.couple(couplings);
    shop.run(10);
    if (shop.found.size() != 1) return Problem::none;
    EXPECT_EQ(event_of(shop.found[0], shop.spindles.axes()).alarm->number, 184u);
    EXPECT_EQ(shop.state(shop.found[0].slave < 3 ? shop.found[0].slave : 0).master, -1);
    return shop.found[0].problem;
  };
  EXPECT_EQ(problem_of({following(1, 1)}), Problem::own_master);
  EXPECT_EQ(problem_of({following(1, 3)}), Problem::master_missing);
  EXPECT_EQ(problem_of({following(4, 0)}), Problem::slave_missing);
  EXPECT_EQ(problem_of({following(1, 0), following(2, 1)}), Problem::chain);
  EXPECT_EQ(problem_of({following(0, 1), following(1, 2)}), Problem::chain);
  EXPECT_EQ(problem_of({following(1, 0), following(1, 2)}), Problem::none) << "the first one counts";
  Shop shop;
  shop.spindles.couple({following(0, 1), following(1, 0)});
  shop.run(10);
  EXPECT_EQ(shop.found.size(), 2u) << "each other's master";
}

TEST(SynchronizedSpindles, AMasterThatIsToFollowAnotherSpindleKeepsItsSlave) {
  Shop shop;
  shop.spindles.couple({following(2, 1)});
  shop.run(10);
  shop.spindles.couple({following(2, 1), following(1, 0)});
  shop.run(10);
  ASSERT_EQ(shop.found.size(), 1u);
  EXPECT_EQ(shop.found[0].problem, Problem::chain);
  EXPECT_EQ(shop.found[0].slave, 1u);
  EXPECT_EQ(shop.state(2).master, 1);
  EXPECT_EQ(shop.state(1).master, -1);
}

// The other spindle has its own order then: what keeps a path away from spindles that hold a part is the
// channel.
TEST(SynchronizedSpindles, ThePathOfEitherSpindleEndsIt) {
  for (const int tapping : {0, 1}) {
    Shop shop;
    shop.spindles.couple({following(1, 0)});
    shop.spindles.demand_speeds({300, 100});
    shop.run(1000);
    ASSERT_EQ(shop.state(1).master, 0);
    EXPECT_NEAR(shop.row[1].speed, 300, 0.1);
    const auto tap = static_cast<std::size_t>(tapping), other = 1 - tap;
    const double angle = shop.status[tap].angle;
    shop.spindles.coupling(tapping).couple(0, angle);
    shop.run(10);
    EXPECT_TRUE(shop.row[tap].coupled);
    EXPECT_EQ(shop.row[tap].angle, angle);
    EXPECT_FALSE(shop.row[other].coupled);
    EXPECT_EQ(shop.row[other].speed, other == 0 ? 300 : 100);
    ASSERT_EQ(shop.found.size(), 1u);
    EXPECT_EQ(shop.found[0].problem, Problem::follows_path);
    const auto event = event_of(shop.found[0], shop.spindles.axes());
    EXPECT_EQ(event.alarm->number, 184u);
    EXPECT_EQ(event.text, "Spindle S2 is not synchronized with Spindle S1: Spindle " +
                              std::string(tapping == 0 ? "S1" : "S2") +
                              " follows the path (tapping); withdraw the request, then give it again");
    EXPECT_EQ(shop.state(1).master, -1);
    shop.spindles.coupling(tapping).release();
    shop.run(10);
    EXPECT_EQ(shop.state(1).master, -1) << "it does not begin again by itself";
  }
}

TEST(SynchronizedSpindles, ASlaveThatSlipsByMoreThanHalfATurnIsAnAlarmAndGoesOnFollowing) {
  Shop shop;
  shop.spindles.couple({following(1, 0)});
  shop.spindles.demand_speeds({600});
  shop.run(3000);
  shop.status[1].angle -= 0.6;
  shop.run(1);
  ASSERT_EQ(shop.found.size(), 1u);
  const auto event = event_of(shop.found[0], shop.spindles.axes());
  EXPECT_EQ(event.alarm->number, 184u);
  EXPECT_EQ(event.part, 6u);
  EXPECT_EQ(event.text.substr(0, 21), "Spindle S2 is 216.0 d") << event.text;
  shop.run(10);
  EXPECT_EQ(shop.state(1).master, 0);
}

// A part may hold both: they keep the ramp of before, and can come to rest by it.
TEST(SynchronizedSpindles, ParametersWithoutAnAccelerationCountWhenItHasEnded) {
  for (const std::uint32_t spindle : {0u, 1u}) {
    auto p = three_spindles();
    Shop shop(p);
    shop.spindles.couple({following(1, 0)});
    shop.spindles.demand_speeds({300});
    shop.run(1000);
    p.values[105971 + 1000 * spindle] = {1, ""};  // the base speed is 0
    shop.spindles.configure(p, period);
    for (const double speed : {300.0, -500.0, 0.0}) {
      shop.spindles.demand_speeds({speed});
      shop.run(1000);
      EXPECT_NEAR(shop.status[0].speed, speed, 1e-6) << spindle;
      EXPECT_NEAR(shop.status[1].speed, speed, 0.1) << spindle;
      EXPECT_NEAR(shop.beside(1, 0), 0, 1) << spindle;
      EXPECT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED) << spindle;
    }
    EXPECT_TRUE(shop.found.empty());
    shop.spindles.couple({});
    shop.run(1);
    shop.spindles.couple({following(1, 0)});
    shop.run(10);
    ASSERT_EQ(shop.found.size(), 1u);
    EXPECT_EQ(shop.found[0].problem, Problem::no_acceleration);
    EXPECT_EQ(event_of(shop.found[0], shop.spindles.axes()).text,
              "Spindle S2 is not synchronized with Spindle S1: the acceleration of Spindle S" +
                  std::to_string(spindle + 1) +
                  " cannot be computed (alarm 182); withdraw the request, then give it again");
    EXPECT_EQ(shop.state(1).master, -1);
  }
}

// With 500 deg/s2 the slave gains 0.083 1/min in a period: 10 periods are not enough for 1000.
TEST(SynchronizedSpindles, ParametersWithoutAnAccelerationEndItBeforeTheSlaveHasItsSpeed) {
  auto p = three_spindles();
  p.values[106036] = {500, ""};
  Shop shop(p);
  shop.spindles.demand_speeds({1000});
  shop.run(1000);
  shop.spindles.couple({following(1, 0)});
  shop.run(10);
  ASSERT_EQ(shop.state(1).master, 0);
  p.values[106971] = {1, ""};
  shop.spindles.configure(p, period);
  shop.run(10);
  ASSERT_EQ(shop.found.size(), 1u);
  EXPECT_EQ(shop.found[0].problem, Problem::no_acceleration);
  EXPECT_EQ(shop.state(1).master, -1);
  EXPECT_EQ(shop.row[0].speed, 1000);
  EXPECT_EQ(shop.row[1].speed, 0);
}

}  // namespace
}  // namespace trunnion::drive::synchronized_spindles_test
