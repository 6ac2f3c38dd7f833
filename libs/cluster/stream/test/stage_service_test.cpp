// SPDX-License-Identifier: Apache-2.0
#include "stream/stage_service.hpp"

#include <gtest/gtest.h>

#include "testing_support/eventually.hpp"

namespace trunnion::stream {
namespace {

using idl::stream::AxisBatch;
using idl::stream::PathBatch;
using testing_support::eventually;

constexpr std::uint32_t stage_domain = 70;

/// X as it is.
class FirstColumn : public StageCore<PathBatch> {
 public:
  void configure(const machine::Parameters&, std::uint16_t) override {}
  bool process(const PathBatch& in, const FeedbackWindow&, AxisBatch& out) override {
    out.axes = {0};
    out.setpoints.clear();
    for (std::uint32_t i = 0; i < in.count; ++i) out.setpoints.push_back(in.setpoints[9 * i]);
    return true;
  }
  void load(std::span<const double>) override {}
  void save(StateValues& state) const override { state.clear(); }
};

PathBatch stage_input(std::uint32_t epoch, std::uint64_t first, std::uint64_t revision) {
  PathBatch f;
  f.epoch = epoch, f.first = first, f.count = 8, f.revision = revision, f.starts = true;
  f.setpoints.assign(72, 2), f.lines.assign(8, 1);
  return f;
}

/// A stage in the midst of a drive, a channel and parameters that the test plays.
struct StageBeforeTheDrive : testing::Test {
  StageBeforeTheDrive()
      : node(options()),
        outside(bus::Vendor::cyclonedds, {stage_domain}),
        parameters(outside.writer(topics::parameter_set)),
        feedback(outside.writer(topics::feedback)),
        input(outside.writer(topics::path_batch)),
        output(outside.reader(topics::kinematics_batch)),
        stage(node, Stage::KINEMATICS, topics::path_batch, topics::kinematics_batch,
              [] { return std::make_unique<FirstColumn>(); }) {
    idl::parameters::ParameterSet set;
    set.revision = 1;
    set.values = {{100000, 0, "X"}, {40001, 0, ""}};
    parameters.write(set);
  }
  static service::Options options() {
    service::Options options;
    options.service = "kinematics";
    options.network.domain = stage_domain;
    options.machine.services.resize(1);
    options.machine.services[0].service = "channel";
    return options;
  }
  void pump() {
    idl::stream::Feedback batch;
    batch.first = 100, batch.axis_count = 1, batch.position = {0};
    batch.channels.resize(1);
    batch.channels[0].epoch = drive_epoch, batch.channels[0].next = 100;
    feedback.write(batch);
    stage.pump();
  }
  template <class Condition>
  bool until(Condition condition) {
    return eventually([&] {
      pump();
      return condition();
    });
  }
  bool is_computed(std::uint32_t epoch) {
    AxisBatch batch;
    while (output.take(batch))
      if (batch.epoch == epoch) return true;
    return false;
  }

  service::Node node;
  bus::Bus outside;
  bus::Writer<idl::parameters::ParameterSet> parameters;
  bus::Writer<idl::stream::Feedback> feedback;
  bus::Writer<PathBatch> input;
  bus::Reader<AxisBatch> output;
  std::uint32_t drive_epoch = 3;
  StageService<PathBatch> stage;
};

struct StageInACluster : StageBeforeTheDrive {
  StageInACluster() {
    EXPECT_TRUE(until([&] { return stage.health().in_step && stage.health().detail.empty(); }));
  }
};

// The drive is at cycle 100 of epoch 3, so the motion of cycles 40 .. 47 is over.
TEST_F(StageBeforeTheDrive, LeavesOutAMotionOfItsHistoryWhoseParametersAreGone) {
  EXPECT_TRUE(eventually([&] {
    stage.pump();
    return stage.health().detail == "waiting for the drive";
  }));
  input.write(stage_input(3, 40, 77));
  EXPECT_TRUE(eventually([&] {
    stage.pump();
    return stage.health().messages_in == 1;
  }));
  EXPECT_TRUE(until([&] { return stage.health().in_step && stage.health().detail.empty(); }))
      << stage.health().detail;
  input.write(stage_input(4, 100, 1));
  EXPECT_TRUE(until([&] { return is_computed(4); }));
}

TEST_F(StageInACluster, GoesOnAfterBatchesThatAreNotWholeOrOfNoChannel) {
  auto hostile = stage_input(4, 100, 1);
  hostile.count = 0;
  input.write(hostile);
  hostile = stage_input(4, 100, 1);
  hostile.channel = 31;
  input.write(hostile);
  input.write(stage_input(4, 100, 1));
  EXPECT_TRUE(until([&] { return is_computed(4); }));
  EXPECT_EQ(node.bus().refusals().at(topics::path_batch.name).count, 2u);
  EXPECT_TRUE(stage.health().in_step) << stage.health().detail;
}

TEST_F(StageInACluster, PassesTheAnglesOfAThreadOnAsTheyAre) {
  auto in = stage_input(4, 100, 1);
  in.spindle_axis = 5, in.follows_spindle = true;
  for (int i = 0; i < 8; ++i) in.spindle.push_back(-3 - 0.05 * i);
  in.turning_radius.assign(8, 40);
  in.snapshot.in_thread = true, in.snapshot.thread_origin = -2.5;
  input.write(in);
  AxisBatch out;
  EXPECT_TRUE(until([&] {
    while (output.take(out))
      if (out.epoch == 4) return true;
    return false;
  }));
  EXPECT_TRUE(out.follows_spindle);
  EXPECT_EQ(out.spindle_axis, 5);
  EXPECT_EQ(out.spindle, in.spindle);
  EXPECT_EQ(out.turning_radius, in.turning_radius);
  EXPECT_EQ(out.snapshot, in.snapshot);
}

TEST_F(StageInACluster, AResetEndsTheWaitForParametersThatNobodyHas) {
  input.write(stage_input(4, 100, 77));
  EXPECT_TRUE(until([&] { return node.alarms().active(alarm::revision_unknown, 0); }));
  node.reset_alarms(stage, service::all_channels);
  EXPECT_TRUE(until([&] { return !node.alarms().active(alarm::revision_unknown, 0); }));
  input.write(stage_input(4, 100, 1));
  EXPECT_TRUE(until([&] { return is_computed(4); }));
}

TEST_F(StageInACluster, AResetLeadsBackFromAForeignStart) {
  input.write(stage_input(4'000'000'000, 5000, 1));
  EXPECT_TRUE(until([&] { return is_computed(4'000'000'000); }));
  node.reset_alarms(stage, service::all_channels);
  // Until the stage has heard of the drive anew its starts are stale: a channel starts again and again.
  EXPECT_TRUE(until([&] {
    input.write(stage_input(4, 100, 1));
    return is_computed(4);
  }));
}

}  // namespace
}  // namespace trunnion::stream
