// SPDX-License-Identifier: Apache-2.0
#include "stream/gantry_synchronization.hpp"

#include <gtest/gtest.h>

#include "machine/alarm_constants.hpp"

namespace trunnion::stream {
namespace {

// Axis 1 is the master, axis 2 its slave at 0.5 mm more.
machine::Parameters gantry() {
  machine::Parameters p;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y1"}, p.values[102000] = {0, "Y2"};
  p.values[10050] = {1, ""}, p.values[10051] = {2, ""};
  p.values[102100] = {1, ""}, p.values[102101] = {1, ""};
  p.values[102129] = {0.5, ""};
  p.values[102107] = {0.2, ""}, p.values[102108] = {600, ""}, p.values[102109] = {3, ""};
  p.values[101940] = {20, ""}, p.values[102940] = {10, ""};
  return p;
}

idl::stream::Feedback feedback() {
  idl::stream::Feedback f;
  f.axis_count = 3;
  f.position = {0, 100, 100.5}, f.velocity = {0, 0, 0}, f.torque = {0, 0, 0}, f.enabled = {1, 1, 1};
  return f;
}

std::vector<std::uint32_t> raised(const machine::Parameters& p, const idl::stream::Feedback& f,
                                  double offset = 0) {
  const auto pair = machine::gantry_pairs(p).at(0);
  std::vector<std::uint32_t> numbers;
  if (!is_coupled(pair, f)) return {0};
  for (const auto& finding : gantry_findings(pair, gantry_difference(pair, f, offset)))
    if (finding.text) numbers.push_back(finding.alarm->number);
  return numbers;
}
using Numbers = std::vector<std::uint32_t>;

TEST(GantrySynchronization, ThePositionAboveItsLimitIsAnAlarmWithTheValueInIt) {
  auto f = feedback();
  EXPECT_EQ(raised(gantry(), f), Numbers{});
  f.position[2] = 100.69;
  EXPECT_EQ(raised(gantry(), f), Numbers{});
  f.position[2] = 100.75;
  EXPECT_EQ(raised(gantry(), f), Numbers{121});
  EXPECT_EQ(raised(gantry(), f, 0.2), Numbers{}) << "0.2 mm of it are compensation";
  const auto pair = machine::gantry_pairs(gantry()).at(0);
  EXPECT_EQ(*gantry_findings(pair, gantry_difference(pair, f, 0))[0].text,
            "Slave axis 2 is off its master axis 1 by 0.2500 mm, limit 0.2000 mm (parameter 102107)");
}

TEST(GantrySynchronization, TheSpeedsAreComparedInMillimetresPerMinute) {
  auto f = feedback();
  f.velocity = {0, 100, 110};  // 10 mm/s are 600 mm/min
  EXPECT_EQ(raised(gantry(), f), Numbers{});
  f.velocity[2] = 110.1;
  EXPECT_EQ(raised(gantry(), f), Numbers{122});
}

TEST(GantrySynchronization, TheCurrentsFollowFromTheRatedCurrents) {
  auto f = feedback();
  f.torque = {0, 0.2, 0.4};  // 4 A and 4 A
  EXPECT_EQ(raised(gantry(), f), Numbers{});
  f.torque[2] = 0.71;  // 7.1 A
  EXPECT_EQ(raised(gantry(), f), Numbers{123});
  auto p = gantry();
  p.values[102942] = {1011, ""};
  EXPECT_EQ(raised(p, f), Numbers{}) << "PB64, thousands 1: the current is not checked";
}

TEST(GantrySynchronization, AMirroredSlaveIsComparedWithTheOppositeSigns) {
  auto p = gantry();
  p.values[102127] = {1, ""};
  auto f = feedback();
  f.position[2] = -99.5, f.velocity = {0, 100, -100}, f.torque = {0, 0.2, -0.4};
  EXPECT_EQ(raised(p, f), Numbers{});
  p.values[102128] = {1, ""};  // the positive direction is reversed, too: both cancel
  EXPECT_EQ(raised(p, f), (Numbers{121, 122, 123}));
}

TEST(GantrySynchronization, ALimitOfZeroIsOff) {
  auto p = gantry();
  p.values[102107] = p.values[102108] = p.values[102109] = {0, ""};
  auto f = feedback();
  f.position[2] = 0, f.velocity[2] = 1000, f.torque[2] = 5;
  EXPECT_EQ(raised(p, f), Numbers{});
}

TEST(GantrySynchronization, NothingIsComparedWithTheDrivesOffTheSlaveOffOrWhileReferencesAreSearched) {
  auto f = feedback();
  f.position[2] = 200;
  f.enabled = {1, 1, 3};
  EXPECT_EQ(raised(gantry(), f), Numbers{0});
  f.enabled = {0, 0, 0};
  EXPECT_EQ(raised(gantry(), f), Numbers{0});
  f.enabled = {1, 1, 1};
  f.mode = idl::stream::DriveMode::HOMING;
  EXPECT_EQ(raised(gantry(), f), Numbers{0});
  f = {};
  EXPECT_EQ(raised(gantry(), f), Numbers{0}) << "feedback without axes";
}

}  // namespace
}  // namespace trunnion::stream
