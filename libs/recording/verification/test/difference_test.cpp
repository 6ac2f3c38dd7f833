// SPDX-License-Identifier: Apache-2.0
#include "verification/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "sample_recording.hpp"

namespace trunnion::verification {
namespace {

// Changes one setpoint of the batch of kinematics that has `cycle`.
void change(StoredRecording& recording, std::uint64_t cycle, std::size_t axis, double (*to)(double)) {
  for (auto& message : recording.messages) {
    if (message.topic->handle != "kinematics_batch") continue;
    idl::stream::AxisBatch batch;
    ASSERT_TRUE(bus::decode(message.cdr, batch));
    if (cycle < batch.first || cycle >= batch.first + batch.count) continue;
    auto& value = batch.setpoints[(cycle - batch.first) * 2 + axis];
    value = to(value);
    bus::encode(batch, message.cdr);
  }
}

const TopicDifference& topic(const Difference& d, const std::string& handle) {
  for (const auto& t : d.topics)
    if (t.topic == handle) return t;
  throw std::runtime_error(handle + " was not compared");
}

TEST(Difference, ARecordingEqualsItself) {
  const auto a = sample_recording();
  const auto d = difference(a.messages, a.messages, {});
  EXPECT_TRUE(d.equal());
  EXPECT_EQ(topic(d, "path_batch").compared, 100u * batch_cycles);
  EXPECT_EQ(topic(d, "parameter_set").compared, 1u);
  EXPECT_EQ(d.cycles, 3u * 100u * batch_cycles) << "path, kinematics and feedback";
}

TEST(Difference, OneBitIsFoundWithItsCycleFieldAndNeighbourhood) {
  const auto a = sample_recording();
  auto b = a;
  change(b, 413, 1, [](double x) { return std::nextafter(x, 1e9); });
  const auto d = difference(a.messages, b.messages, {});
  ASSERT_FALSE(d.equal());
  EXPECT_EQ(d.first->topic, "kinematics_batch");
  EXPECT_EQ(d.first->field, "setpoint.axis1");
  EXPECT_EQ(d.first->series, "channel 0");
  EXPECT_EQ(d.first->index, 413u);
  ASSERT_EQ(d.first->around.size(), 7u) << "three cycles before and after";
  EXPECT_EQ(d.first->around[0].index, 410u);
  EXPECT_EQ(d.first->around[0].a, d.first->around[0].b);
  EXPECT_EQ(d.first->around[3].a, "413.10000000000002") << "413 + 0.1, to 17 digits";
  EXPECT_NE(d.first->around[3].a, d.first->around[3].b);
  const auto& field = topic(d, "kinematics_batch").fields.at("setpoint.axis1");
  EXPECT_EQ(field.count, 1u);
  EXPECT_EQ(field.largest, std::nextafter(413.1, 1e9) - 413.1);
  EXPECT_TRUE(topic(d, "path_batch").equal());
}

TEST(Difference, AngleOfASpindleAndSpindleOfATapAreCompared) {
  auto a = sample_recording();
  for (auto& message : a.messages) {
    idl::stream::Feedback executed;
    if (message.topic->handle != "feedback" || !bus::decode(message.cdr, executed)) continue;
    executed.spindle_speed = {60};
    for (std::uint32_t i = 0; i < executed.count; ++i)
      executed.spindle_angle.push_back(0.001 * static_cast<double>(executed.first + i));
    bus::encode(executed, message.cdr);
  }
  EXPECT_TRUE(difference(a.messages, a.messages, {}).equal());
  auto b = a;
  for (auto& message : b.messages) {
    idl::stream::Feedback executed;
    if (message.topic->handle != "feedback" || !bus::decode(message.cdr, executed) || executed.first != 400)
      continue;
    executed.spindle_angle[5] = std::nextafter(executed.spindle_angle[5], 1);
    bus::encode(executed, message.cdr);
  }
  const auto turned = difference(a.messages, b.messages, {});
  ASSERT_FALSE(turned.equal());
  EXPECT_EQ(turned.first->topic, "feedback");
  EXPECT_EQ(turned.first->field, "spindle_angle[0]");
  EXPECT_EQ(turned.first->index, 405u);

  b = a;
  for (auto& message : b.messages) {
    idl::stream::PathBatch batch;
    if (message.topic->handle != "path_batch" || !bus::decode(message.cdr, batch) || batch.first != 400)
      continue;
    batch.spindle_axis = 4;
    batch.spindle.assign(batch_cycles, 0.25);
    bus::encode(batch, message.cdr);
  }
  const auto tapped = difference(a.messages, b.messages, {});
  ASSERT_FALSE(tapped.equal());
  EXPECT_EQ(tapped.first->topic, "path_batch");
  EXPECT_EQ(tapped.first->index, 400u);
}

TEST(Difference, OfOneCycleTheEarlierStageComesFirstAndOfTwoTheEarlierCycle) {
  const auto a = sample_recording();
  auto b = a;
  change(b, 500, 0, [](double x) { return x + 1; });
  for (auto& message : b.messages)
    if (message.topic->handle == "path_batch") {
      idl::stream::PathBatch batch;
      ASSERT_TRUE(bus::decode(message.cdr, batch));
      if (batch.first == 496) batch.setpoints[4 * 9 + 2] += 1;  // Z of cycle 500
      bus::encode(batch, message.cdr);
    }
  EXPECT_EQ(difference(a.messages, b.messages, {}).first->topic, "path_batch");
  change(b, 499, 0, [](double x) { return x + 1; });
  const auto d = difference(a.messages, b.messages, {});
  EXPECT_EQ(d.first->topic, "kinematics_batch");
  EXPECT_EQ(d.first->index, 499u);
}

TEST(Difference, ToleranceIsOfTheLongestBeginningOfTheFieldsName) {
  const auto a = sample_recording();
  auto b = a;
  change(b, 100, 0, [](double x) { return x + 1e-6; });
  change(b, 200, 1, [](double x) { return x + 1e-3; });
  DiffOptions options;
  add_tolerance(options, "1e-5");
  EXPECT_EQ(difference(a.messages, b.messages, options).first->index, 200u);
  add_tolerance(options, "setpoint.axis1=0.01");
  EXPECT_TRUE(difference(a.messages, b.messages, options).equal());
  EXPECT_NEAR(
      topic(difference(a.messages, b.messages, {}), "kinematics_batch").fields.at("setpoint.axis1").largest,
      1e-3, 1e-12);
  add_tolerance(options, "setpoint.axis1=1e-4");
  EXPECT_FALSE(difference(a.messages, b.messages, options).equal());
  for (const auto* bad : {"", "x", "1e-3x", "-1", "a=", "nan"})
    EXPECT_THROW(add_tolerance(options, bad), std::runtime_error) << bad;
}

TEST(Difference, NotANumberDiffersFromEveryNumberWhateverTheTolerance) {
  const auto a = sample_recording();
  auto b = a;
  change(b, 100, 0, [](double) { return std::nan(""); });
  DiffOptions options;
  add_tolerance(options, "1e9");
  EXPECT_FALSE(difference(a.messages, b.messages, options).equal());
  EXPECT_TRUE(difference(b.messages, b.messages, options).equal());
}

TEST(Difference, BatchesCutOtherwiseAreEqualCycleByCycle) {
  const auto a = sample_recording();
  auto b = a;
  for (auto it = b.messages.begin(); it != b.messages.end(); ++it) {
    if (it->topic->handle != "kinematics_batch") continue;
    idl::stream::AxisBatch whole, half[2];
    ASSERT_TRUE(bus::decode(it->cdr, whole));
    for (std::uint32_t i = 0; i < 2; ++i) {
      half[i] = whole;
      half[i].first = whole.first + i * 4;
      half[i].count = 4;
      half[i].starts = whole.starts && i == 0;
      half[i].ends = whole.ends && i == 1;
      half[i].setpoints.assign(whole.setpoints.begin() + 8 * i, whole.setpoints.begin() + 8 * (i + 1));
      half[i].lines.resize(4);
    }
    half[0].states.clear();  // the state after cycle 4 of the batch: only batches cut so tell it
    bus::encode(half[0], it->cdr);
    it = b.messages.insert(it + 1, stored(topics::kinematics_batch, half[1], it->time));
  }
  const auto d = difference(a.messages, b.messages, {});
  EXPECT_TRUE(d.equal()) << text_of(d, "a", "b");
  EXPECT_EQ(topic(d, "kinematics_batch").compared, 800u);
}

TEST(Difference, CyclesThatOnlyOneHasAreADifferenceUnlessOnlyTheCommonOnesCount) {
  const auto a = sample_recording(100), b = sample_recording(90);
  auto d = difference(a.messages, b.messages, {});
  ASSERT_FALSE(d.equal());
  EXPECT_EQ(topic(d, "kinematics_batch").only_a, 10u * batch_cycles);
  EXPECT_EQ(topic(d, "kinematics_batch").only_b, 0u);
  EXPECT_EQ(d.first->index, 719u) << "the last of 90 batches says that the motion ends there";
  EXPECT_EQ(d.first->field, "ends");
  DiffOptions options;
  options.common = true;
  options.ignored = {"path_batch.ends", "kinematics_batch.ends"};
  EXPECT_TRUE(difference(a.messages, b.messages, options).equal());
}

TEST(Difference, OfACycleThatWasWrittenAgainTheNewestEpochCounts) {
  auto a = sample_recording(10);  // cycles 0..79 of epoch 1
  auto b = a;
  add_motion(b, 40, 5, 2);                           // 40..79 again
  change(b, 79, 0, [](double x) { return x + 1; });  // in both epochs
  const auto d = difference(a.messages, b.messages, {});
  EXPECT_EQ(topic(d, "kinematics_batch").compared, 80u);
  EXPECT_EQ(topic(d, "kinematics_batch").fields.at("starts").first_index, 40u);
}

TEST(Difference, StatesAreComparedByKeyAndRepetitionsDoNotCount) {
  StoredRecording a, b;
  const auto done = [](std::uint16_t channel, std::uint32_t number) {
    return stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{channel, number, false}, 5);
  };
  a.messages = {done(0, 1), done(1, 1), done(0, 2)};
  b.messages = {done(1, 1), done(0, 1), done(0, 1), done(0, 2), done(0, 2)};
  EXPECT_TRUE(difference(a.messages, b.messages, {}).equal());
  b.messages.push_back(done(1, 3));
  const auto d = difference(a.messages, b.messages, {});
  EXPECT_EQ(topic(d, "auxiliary_done").only_b, 1u);
  EXPECT_TRUE(d.first->field.empty());
}

TEST(Difference, NamesATopicThatDoesNotExist) {
  DiffOptions options;
  options.topics = {"path_farme"};
  EXPECT_THROW(difference({}, {}, options), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::verification
