// SPDX-License-Identifier: Apache-2.0
#include "verification/shown_state.hpp"
#include "machine/parameter_constants.hpp"

#include <gtest/gtest.h>

#include "machine/parameters.hpp"
#include "operator_recording.hpp"

namespace trunnion::verification {
namespace {

using bus::Json;

bus::Json shown_of(const StoredRecording& recording) {
  ShownState shown;
  for (const auto& message : recording.messages) shown.observe(message);
  return shown.document();
}

idl::service::Alarm alarm_of_channel(bool active = true) {
  idl::service::Alarm alarm{};
  alarm.instance = channel_instance;
  alarm.number = 110;
  alarm.active = active;
  alarm.source = "channel";
  return alarm;
}

TEST(ShownState, IsTheNewestOfEachTopic) {
  auto recording = shown_recording();
  recording.messages.push_back(stored(topics::channel_state, channel_state(2.5), 11));
  const auto document = shown_of(recording);
  EXPECT_EQ(document["cluster"]["machine"], "bench");
  EXPECT_EQ(document["channels"]["0"]["machine"], Json::array({2.5}));
  EXPECT_EQ(document["services"]["3"]["pid"], 100);
  EXPECT_EQ(document["services"]["3"]["uptime"], 2.0) << "2.75 s in whole seconds";
  EXPECT_EQ(document["revisions"]["parameters"], 1);
}

TEST(ShownState, TheMeasurementIsInTheStreamAndItsResultIsReadBesideIt) {
  auto recording = shown_recording();
  EXPECT_FALSE(shown_of(recording).contains("measurement")) << "a machine without the service";
  idl::measurement::MeasurementState state;
  state.measurement = 3, state.phase = idl::measurement::Phase::WAITING, state.poses = 5;
  idl::measurement::MeasurementResult result;
  result.measurement = 3, result.touch_deviation = 0.001;
  recording.messages.push_back(stored(topics::measurement_state, state, 11));
  recording.messages.push_back(stored(topics::measurement_result, result, 12));
  EXPECT_EQ(shown_of(recording)["measurement"]["phase"], "WAITING");
  ShownState shown;
  for (const auto& message : recording.messages) shown.observe(message);
  const auto answer = shown.answers().at("/api/measurement");
  EXPECT_EQ(answer["state"]["poses"], 5);
  EXPECT_EQ(answer["result"]["touch_deviation"], 0.001);
}

TEST(ShownState, ASpindleIsShownWithItsAngleInHundredthsOfADegree) {
  StoredRecording recording;
  auto batch = feedback(100, 0);
  batch.spindles.resize(2);
  batch.spindles[0].angle = -0.25;      // turns: 270 deg
  batch.spindles[1].angle = 2.9999999;  // 359.99996 deg, which rounds to a whole turn
  recording.messages.push_back(stored(topics::feedback, batch, 1));
  const auto spindles = shown_of(recording)["drive"]["spindles"];
  EXPECT_EQ(spindles.size(), 2u);
  EXPECT_EQ(spindles[0]["angle"], 270.0);
  EXPECT_EQ(spindles[1]["angle"], 0.0);
  recording.messages.push_back(stored(topics::feedback, feedback(100, 0), 2));
  EXPECT_FALSE(shown_of(recording)["drive"].contains("spindles")) << "a machine without a spindle";
}

// 0.00125 rev are 0.45 deg; 0.0000004 rev are 0.000144 deg, which rounds to 0.
TEST(ShownState, ASpindleThatFollowsIsShownWithMasterErrorAndCorrection) {
  StoredRecording recording;
  auto batch = feedback(100, 0);
  batch.spindles.resize(2);
  auto& slave = batch.spindles[1];
  slave.reference = -999.004;
  slave.master = 0;
  slave.synchronization_error = -0.00125;
  slave.correction = 1.256;
  batch.spindles[0].master = -1;
  batch.spindles[0].synchronization_error = 0.0000004;
  recording.messages.push_back(stored(topics::feedback, batch, 1));
  const auto spindles = shown_of(recording)["drive"]["spindles"];
  ASSERT_EQ(spindles.size(), 2u);
  EXPECT_EQ(spindles[0]["master"], -1);
  EXPECT_EQ(spindles[0]["synchronization_error"], 0.0);
  EXPECT_EQ(spindles[1]["reference"], -999.0);
  EXPECT_EQ(spindles[1]["master"], 0);
  EXPECT_EQ(spindles[1]["synchronization_error"], -0.45);
  EXPECT_EQ(spindles[1]["correction"], 1.26);
}

TEST(ShownState, AxesAreTheLastRowOfTheFeedbackUnderTheirLogicalNumbers) {
  StoredRecording recording;
  idl::parameters::ParameterSet set;
  set.revision = 1;
  const auto name = parameter::axis_name.number();
  set.values = {{name, 0, "X"}, {name + 3000, 0, "A"}};
  recording.messages.push_back(stored(topics::parameter_set, set, 1));
  auto batch = feedback(100, 2);
  batch.commanded = {1, 2, 3, 4};
  batch.actual = {1, 2, 2.5, 4};
  recording.messages.push_back(stored(topics::feedback, batch, 2));
  // A batch without a cycle (a hold) leaves the positions where they are.
  recording.messages.push_back(stored(topics::feedback, feedback(102, 0), 3));
  const auto document = shown_of(recording);
  EXPECT_EQ(document["axes"].size(), 2u);
  EXPECT_EQ(document["axes"]["0"]["commanded"], 3.0);
  EXPECT_EQ(document["axes"]["0"]["following_error"], 0.5);
  EXPECT_EQ(document["axes"]["3"]["actual"], 4.0);
  EXPECT_EQ(document["drive"]["executed"], 102);
}

TEST(ShownState, BeforeTheFirstCycleAxesAreWhereTheyStand) {
  StoredRecording recording;
  idl::parameters::ParameterSet set;
  set.revision = 1;
  set.values = {{parameter::axis_name.number(), 0, "X"}};
  recording.messages.push_back(stored(topics::parameter_set, set, 1));
  auto batch = feedback(100, 0);
  batch.axis_count = 1;
  batch.position = {7.5};
  recording.messages.push_back(stored(topics::feedback, batch, 2));
  const auto axis = shown_of(recording)["axes"]["0"];
  EXPECT_EQ(axis["commanded"], 7.5);
  EXPECT_EQ(axis["actual"], 7.5);
  EXPECT_EQ(axis["following_error"], 0.0);
}

TEST(ShownState, AnAlarmEndsWithItselfOrWithTheProcessThatRaisedIt) {
  auto recording = shown_recording();
  recording.messages.push_back(stored(topics::alarm, alarm_of_channel(), 20));
  EXPECT_TRUE(shown_of(recording)["alarms"].contains("3/110/0"));
  auto over = recording;
  over.messages.push_back(stored(topics::alarm, alarm_of_channel(false), 21));
  EXPECT_TRUE(shown_of(over)["alarms"].empty());
  // The successor's first heartbeat: the predecessor's alarm goes, unless it may be the successor's own.
  auto replaced = recording;
  replaced.messages.push_back(stored(topics::service_state, beat(channel_instance, 100), 22));
  replaced.messages.push_back(stored(topics::service_state, beat(channel_instance, 101), 23));
  EXPECT_TRUE(shown_of(replaced)["alarms"].empty());
  recording.messages.push_back(stored(topics::service_state, beat(channel_instance, 101), 23));
  EXPECT_EQ(shown_of(recording)["alarms"].size(), 1u);
}

TEST(ShownState, ByTheClockIsTakenOutAndNothingElse) {
  auto document = Json::parse(R"({"trace": {}, "services": {"3": {"alive": true, "pid": 1}, "9": {"pid": 2}},
      "alarms": {"3/110/0": {"since": "now", "text": "t"}, "9/101/0": {}},
      "axes": {"0": {"actual": 1.5, "following_peak": 0.1}}, "revisions": {}})");
  take_out_clock(document, gateway_instance);
  EXPECT_EQ(document, Json::parse(R"({"services": {"3": {"pid": 1}}, "alarms": {"3/110/0": {"text": "t"}},
      "axes": {"0": {"actual": 1.5}}, "revisions": {}})"));
  // A process that was replaced is shown until its last heartbeat is too old.
  const auto replaced =
      R"({"cluster": {"title": "Mill", "domain": 3}, "run_times": {"0": {"ticks": 7}}, "services": {"3": {"expected": true}, "4": {"expected": false}}})";
  document = Json::parse(replaced);
  take_out_clock(document, gateway_instance);
  EXPECT_EQ(document, Json::parse(R"({"cluster": {"domain": 3}, "services": {"3": {"expected": true}}})"));
  for (auto odd : {Json(), Json(3), Json::parse(R"({"services": 1, "alarms": [], "axes": {"0": 2}})")})
    EXPECT_NO_THROW(take_out_clock(odd, 1)) << "a document from outside is looked at before it is used";
}

TEST(ShownState, ADifferenceIsNamedByItsPathAndBothValues) {
  const auto expected =
      Json::parse(R"({"axes": {"0": {"actual": 1.5}}, "channels": {"0": {"machine": [1.0]}}})");
  auto shown = expected;
  EXPECT_EQ(shown_difference(expected, shown), "");
  shown["axes"]["0"]["actual"] = 1.5000004;
  EXPECT_EQ(shown_difference(expected, shown), "") << "rounded to the nanometre";
  shown["axes"]["0"]["actual"] = 1.500001;
  EXPECT_EQ(shown_difference(expected, shown), "axes.0.actual: expected 1.5, shown 1.500001");
  shown = expected;
  shown["channels"]["0"]["machine"][0] = 1.0000000000000002;
  EXPECT_NE(shown_difference(expected, shown).find("channels.0.machine.0: "), std::string::npos)
      << "one bit of what is not rounded";
  shown = expected;
  shown.erase("axes");
  EXPECT_EQ(shown_difference(expected, shown), "document: axes is not shown");
  shown = expected;
  shown["channels"]["1"] = 1;
  EXPECT_EQ(shown_difference(expected, shown), "channels: 1 is shown, but no topic has it");
}

}  // namespace
}  // namespace trunnion::verification
