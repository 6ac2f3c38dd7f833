// SPDX-License-Identifier: Apache-2.0
#include "stream/batch_difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trunnion::stream {
namespace {

using idl::stream::AxisBatch;
using idl::stream::Stage;
using testing::HasSubstr;

AxisBatch batch() {
  AxisBatch f;
  f.stage = Stage::COMPENSATION, f.replica = 0, f.epoch = 2, f.first = 400, f.count = 4, f.revision = 7;
  f.axes = {0, 1, 5};
  for (int i = 0; i < 12; ++i) f.setpoints.push_back(0.1 * i);
  f.states = {{Stage::KINEMATICS, 403, {}}, {Stage::COMPENSATION, 403, {1, 2, 3}}};
  return f;
}

TEST(BatchDifference, EqualBatchesHaveNone) {
  auto other = batch();
  other.replica = 1;
  EXPECT_TRUE(same_values(batch(), other));
  EXPECT_FALSE(difference(batch(), other));
}

TEST(BatchDifference, NamesStageCopiesCycleColumnAndBothValuesToTheLastBit) {
  auto other = batch();
  other.replica = 1;
  other.setpoints[7] = std::nextafter(other.setpoints[7], 1.0);  // row 2, column 1
  ASSERT_FALSE(same_values(batch(), other));
  const auto found = difference(batch(), other);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cycle, 402u);
  // 0.1 * 7 is 0.70000000000000007 (17 digits tell doubles apart), its neighbour above 0.70000000000000018.
  EXPECT_EQ(found->text,
            "Replicas 0 and 1 of compensation differ in cycle 402, column 1: 0.70000000000000007 and "
            "0.70000000000000018");
}

TEST(BatchDifference, NamesTheStateThatDiffers) {
  auto other = batch();
  other.states[1].values[2] = 4;
  const auto found = difference(batch(), other);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cycle, 403u);
  EXPECT_THAT(found->text, HasSubstr("state of compensation, value 2: 3 and 4"));
}

TEST(BatchDifference, NamesTheFieldOfTheChannelsSnapshot) {
  auto other = batch();
  other.snapshot.cycle = 403, other.snapshot.tool = 7;
  auto own = batch();
  own.snapshot.cycle = 403, own.snapshot.tool = 5;
  EXPECT_FALSE(same_values(own, other));
  const auto found = difference(own, other);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cycle, 403u);
  EXPECT_THAT(found->text, HasSubstr("snapshot of the channel, tool: 5 and 7"));
}

TEST(BatchDifference, ShapeCounts) {
  auto other = batch();
  other.axes = {0, 1, 4};
  EXPECT_THAT(difference(batch(), other)->text, HasSubstr("axis 2: 5 and 4"));
  other = batch();
  other.count = 3, other.setpoints.resize(9);
  EXPECT_THAT(difference(batch(), other)->text, HasSubstr("count: 4 and 3"));
  other = batch();
  other.follows_spindle = true;
  EXPECT_FALSE(same_values(batch(), other));
  EXPECT_THAT(difference(batch(), other)->text, HasSubstr("follows spindle: 0 and 1"));
  other = batch();
  other.turning_radius = {40};
  EXPECT_FALSE(same_values(batch(), other));
  EXPECT_THAT(difference(batch(), other)->text, HasSubstr("length of turning radius: 0 and 1"));
  other = batch();
  other.ends = true;
  EXPECT_THAT(difference(batch(), other)->text, HasSubstr("ends: 0 and 1"));
}

TEST(BatchDifference, OfPathBatchesTheToolAndTheBatchCount) {
  idl::stream::PathBatch a;
  a.first = 8, a.count = 1;
  a.setpoints.assign(9, 0.0);
  auto b = a;
  b.tool_length = 100;
  EXPECT_THAT(difference(a, b)->text, HasSubstr("of channel differ in cycle 8, tool length: 0 and 100"));
  b = a;
  b.transformation = idl::stream::Transformation::RTCP;
  EXPECT_THAT(difference(a, b)->text, HasSubstr("transformation: 0 and 1"));
  b = a;
  b.follows_spindle = true;
  EXPECT_FALSE(same_values(a, b));
  EXPECT_THAT(difference(a, b)->text, HasSubstr("follows spindle: 0 and 1"));
}

// Property over 2000 seeded changes of one value: found exactly when the batches are not the same, and in the
// cycle whose row was changed.
TEST(BatchDifference, FindsEveryChangeOfOneSetpoint) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    auto other = batch();
    const auto at = random() % other.setpoints.size();
    const bool change = random() % 2 == 0;
    if (change) other.setpoints[at] += std::ldexp(1.0, -static_cast<int>(random() % 40));
    const auto found = difference(batch(), other);
    ASSERT_EQ(found.has_value(), !same_values(batch(), other));
    ASSERT_EQ(found.has_value(), change);
    if (found) {
      ASSERT_EQ(found->cycle, 400 + at / 3);
    }
  }
}

}  // namespace
}  // namespace trunnion::stream
