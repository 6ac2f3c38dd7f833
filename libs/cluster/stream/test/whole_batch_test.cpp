// SPDX-License-Identifier: Apache-2.0
#include "stream/whole_batch.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "contracts/topics.hpp"
#include "stream/batch_reader.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::stream {
namespace {

using idl::stream::AxisBatch;
using idl::stream::Feedback;
using idl::stream::PathBatch;

PathBatch whole_path() {
  PathBatch f;
  f.first = 100, f.count = 4;
  f.setpoints.assign(36, 1.5), f.lines.assign(4, 7);
  return f;
}

AxisBatch whole_axes() {
  AxisBatch f;
  f.first = 100, f.count = 4, f.axes = {0, 5, 31};
  f.setpoints.assign(12, 1.5), f.lines.assign(4, 7), f.spindle.assign(4, 0.5);
  return f;
}

Feedback whole_feedback() {
  Feedback f;
  f.first = 100, f.count = 2, f.axis_count = 3;
  f.commanded.assign(6, 1), f.actual.assign(6, 1), f.position.assign(3, 1), f.velocity.assign(3, 1);
  f.torque.assign(3, 0), f.enabled.assign(3, 1), f.spindle_speed = {100}, f.spindle_angle.assign(2, 0);
  f.channels.resize(1);
  return f;
}

template <class Batch>
std::string after(Batch batch, const std::function<void(Batch&)>& change) {
  change(batch);
  return fault_of(batch);
}

TEST(WholeBatch, BatchesOfTheStreamAreWhole) {
  EXPECT_EQ(fault_of(whole_path()), "");
  EXPECT_EQ(fault_of(whole_axes()), "");
  EXPECT_EQ(fault_of(whole_feedback()), "");
  EXPECT_EQ(fault_of(Feedback{}), "") << "of a drive that only tells its state";
}

TEST(WholeBatch, APathBatchWhoseRowsAreNotThereIsNot) {
  const auto fault = [](const std::function<void(PathBatch&)>& change) {
    return after(whole_path(), change);
  };
  EXPECT_EQ(fault([](auto& f) { f.count = 0; }), "count: 0, must be 1 to 64");
  EXPECT_EQ(fault([](auto& f) { f.count = 65; }), "count: 65, must be 1 to 64");
  EXPECT_EQ(fault([](auto& f) { f.count = 5; }), "setpoints: 36 values, must be 5 rows of 9");
  EXPECT_EQ(fault([](auto& f) { f.lines.clear(); }), "lines: 0 values, must be 4 rows of 1");
  EXPECT_EQ(fault([](auto& f) { f.states.resize(8); }), "states: 8, must be 0 to 4");
  EXPECT_EQ(fault([](auto& f) { f.spindle = {1}; }), "spindle: 1 values, must be 4 rows of 1");
  EXPECT_EQ(fault([](auto& f) { f.turning_radius = {1}; }), "turning_radius: 1 values, must be 4 rows of 1");
  EXPECT_EQ(fault([](auto& f) { f.turning_radius.assign(4, 40); }), "");
  EXPECT_EQ(fault([](auto& f) { f.setpoints[35] = 1e300; }), "setpoints: farther than 1e12 mm or deg");
  EXPECT_EQ(fault([](auto& f) { f.follows_spindle = true; }), "spindle: 0 values, must be 4 rows of 1")
      << "a thread whose angles are not there";
  EXPECT_NE(fault([](auto& f) { f.setpoints[0] = std::numeric_limits<double>::quiet_NaN(); }), "");
  EXPECT_EQ(fault([](auto& f) { f.first = ~0ull - 2; }).substr(0, 27), "first: 18446744073709551613");
}

TEST(WholeBatch, AnAxisBatchOfAxesThatNoMachineHasIsNot) {
  const auto fault = [](const std::function<void(AxisBatch&)>& change) {
    return after(whole_axes(), change);
  };
  EXPECT_EQ(fault([](auto& f) { f.axes.clear(); }), "axes: 0, must be 1 to 32");
  EXPECT_EQ(fault([](auto& f) { f.axes[1] = 32; }), "axes: 32, must be 0 to 31");
  EXPECT_EQ(fault([](auto& f) { f.axes[1] = 65535; }), "axes: 65535, must be 0 to 31");
  EXPECT_EQ(fault([](auto& f) { f.axes[2] = 0; }), "axes: axis 0 twice");
  EXPECT_EQ(fault([](auto& f) { f.axes = {0, 5}; }), "setpoints: 12 values, must be 4 rows of 2");
  EXPECT_EQ(fault([](auto& f) { f.count = 0; }), "count: 0, must be 1 to 64");
}

TEST(WholeBatch, FeedbackOfRowsThatAreNotThereIsNot) {
  const auto fault = [](const std::function<void(Feedback&)>& change) {
    return after(whole_feedback(), change);
  };
  EXPECT_EQ(fault([](auto& f) { f.axis_count = 65535; }), "axis_count: 65535, must be 0 to 32");
  EXPECT_EQ(fault([](auto& f) { f.count = ~0u; }), "count: 4294967295, must be 0 to 2048");
  EXPECT_EQ(fault([](auto& f) { f.actual.clear(); }), "actual: 0 values, must be 2 rows of 3");
  EXPECT_EQ(fault([](auto& f) { f.velocity = {1}; }), "velocity: 1 values, must be 1 rows of 3");
  EXPECT_EQ(fault([](auto& f) { f.position[0] = -1e300; }), "position: farther than 1e12 mm or deg");
  EXPECT_NE(fault([](auto& f) { f.tick = ~0ull; }), "");
  EXPECT_NE(fault([](auto& f) { f.first = last_cycle; }), "");
  EXPECT_NE(fault([](auto& f) { f.channels[0].start = ~0ull; }), "");
}

TEST(BatchReader, RefusesAndCountsWhatIsNotWhole) {
  bus::Bus foreign(bus::Vendor::cyclonedds, {69}), own(bus::Vendor::cyclonedds, {69});
  auto writer = foreign.writer(topics::gantry_batch);
  BatchReader<AxisBatch> reader(own, topics::gantry_batch);
  auto batch = whole_axes();
  batch.count = 0;
  for (int i = 0; i < 3; ++i) writer.write(batch);
  writer.write(whole_axes());
  AxisBatch taken;
  ASSERT_TRUE(testing_support::eventually([&] { return reader.take(taken); }));
  EXPECT_EQ(taken, whole_axes());
  const auto& refusals = own.refusals().at(topics::gantry_batch.name);
  EXPECT_EQ(refusals.count, 3u);
  EXPECT_EQ(refusals.newest, "count: 0, must be 1 to 64");
}

}  // namespace
}  // namespace trunnion::stream
