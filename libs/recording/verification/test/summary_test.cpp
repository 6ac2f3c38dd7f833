// SPDX-License-Identifier: Apache-2.0
#include "verification/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sample_recording.hpp"
#include "verification/csv.hpp"

namespace trunnion::verification {
namespace {

Summary summary_of(const StoredRecording& recording) {
  const auto file = file_of(recording);
  recording::MemorySource source(file);
  return summarize(source);
}

TEST(Summary, CountsTopicsCyclesAndGapsAndNamesTheContract) {
  auto recording = sample_recording(100);
  // Batches 20 and 21 of kinematics, cycles 160 to 175, are lost.
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    idl::stream::AxisBatch f;
    return m.topic->handle == "kinematics_batch" && bus::decode(m.cdr, f) && f.first >= 160 && f.first < 176;
  });
  idl::service::Announcement announcement;
  announcement.service = "drive", announcement.vendor = "fastdds", announcement.version = "0.1.0";
  announcement.contract = "abc";
  recording.messages.push_back(stored(topics::announcement, announcement, 50));
  const auto s = summary_of(recording);
  EXPECT_TRUE(s.complete);
  EXPECT_TRUE(s.same_contract);
  EXPECT_EQ(s.metadata.at("machine"), "bench");
  EXPECT_EQ(s.compressions, (std::map<std::string, std::uint64_t>{{"zstd", 1}})) << "a chunk has 1 MiB";
  EXPECT_NE(text_of(s).find("chunks     1, compression zstd\n"), std::string::npos) << text_of(s);
  EXPECT_EQ(json_of(s)["compressions"]["zstd"], 1);
  EXPECT_EQ(s.revisions, (std::set<std::uint64_t>{1}));
  EXPECT_EQ(s.participants, (std::set<std::string>{"drive fastdds 0.1.0 abc"}));
  ASSERT_EQ(s.streams.size(), 3u);
  EXPECT_EQ(s.streams[0].handle, "path_batch") << "in the order of the stream";
  EXPECT_EQ(s.streams[0].cycles, 800u);
  EXPECT_EQ(s.streams[0].lost, 0u);
  EXPECT_EQ(s.streams[1].lost, 16u);
  EXPECT_EQ(s.streams[1].gaps, (std::vector<recording::CycleRange>{{160, 16}}));
  const auto path = std::find_if(s.topics.begin(), s.topics.end(),
                                 [](const TopicSummary& t) { return t.handle == "path_batch"; });
  ASSERT_NE(path, s.topics.end());
  EXPECT_EQ(path->messages, 100u);
  EXPECT_EQ(path->known, Known::same);
  EXPECT_EQ(json_of(s)["streams"][1]["gaps"][0]["first"], 160);
  EXPECT_NE(text_of(s).find("missing 160..175"), std::string::npos);
}

TEST(Summary, RateIsMessagesBetweenTheFirstAndTheLast) {
  TopicSummary t;
  t.messages = 11, t.first_time = 1'000'000'000, t.last_time = 3'000'000'000;
  EXPECT_DOUBLE_EQ(t.rate(), 5.0) << "ten intervals in two seconds";
  t.messages = 1;
  EXPECT_DOUBLE_EQ(t.rate(), 0.0);
}

TEST(Summary, MessagesTheRecorderCountedAndLeftOutAreMissing) {
  recording::MemorySink sink;
  recording::Writer writer(sink);
  const auto& entry = *bus::find_topic("alarm");
  const auto channel = writer.add_channel(entry.description.name, entry.type, entry.schema);
  const auto alarm = stored(topics::alarm, {}, 1);
  for (const std::uint32_t sequence : {4u, 5u, 9u}) writer.write(channel, sequence, sequence, alarm.cdr);
  writer.finish();
  recording::MemorySource source(sink.data);
  EXPECT_EQ(summarize(source).topics.at(0).missing, 3u) << "6, 7 and 8";
}

TEST(Summary, TopicsOfAnotherContractAreNamedAndNotDecoded) {
  recording::MemorySink sink;
  recording::Writer writer(sink);
  const auto& entry = *bus::find_topic("alarm");
  const auto other = writer.add_channel(entry.description.name, entry.type, "struct Alarm { long a; };");
  const auto unknown = writer.add_channel("elsewhere/topic", "T", "struct T { long a; };");
  writer.write(other, 1, 1, recording::Bytes{0, 1, 0, 0, 9});
  writer.write(unknown, 1, 2, recording::Bytes{1});
  writer.finish();
  recording::MemorySource source(sink.data), again(sink.data);
  const auto s = summarize(source);
  ASSERT_EQ(s.topics.size(), 2u);
  EXPECT_EQ(s.topics[0].known, Known::unknown_topic);
  EXPECT_EQ(s.topics[1].known, Known::other_type);
  const auto recording = load_recording(again);
  EXPECT_TRUE(recording.messages.empty());
  EXPECT_EQ(recording.foreign, (std::set<std::string>{"elsewhere/topic", entry.description.name}));
}

TEST(Summary, NamesTheServicesThatHaveNotGivenTheirState) {
  idl::service::Cluster cluster;
  StoredRecording recording;
  std::uint64_t time = 10;
  const auto give = [&](std::uint32_t instance, idl::service::SnapshotKind kind, const std::string& detail) {
    idl::service::ServiceSnapshot snapshot;
    snapshot.instance = instance;
    snapshot.kind = kind;
    snapshot.detail = detail;
    recording.messages.push_back(stored(topics::service_snapshot, snapshot, ++time));
  };
  for (const std::string name : {"parameters", "channel", "plc", "kinematics", "drive"}) {
    idl::service::ClusterService service;
    service.instance = static_cast<std::uint32_t>(cluster.services.size());
    service.service = name;
    service.pid = name == "drive" ? 0 : 100;
    cluster.services.push_back(service);
  }
  recording.messages = {stored(topics::cluster, cluster, 1)};
  EXPECT_TRUE(summary_of(recording).without_state.empty()) << "nobody was asked";
  recording.messages.push_back(stored(topics::snapshot_request, {1, 1}, 2));
  give(1, idl::service::SnapshotKind::LATER, "in motion");
  give(2, idl::service::SnapshotKind::LATER, "in motion");
  give(2, idl::service::SnapshotKind::GIVEN, "");
  give(3, idl::service::SnapshotKind::NOT_NEEDED, "");
  const auto s = summary_of(recording);
  EXPECT_EQ(s.without_state, (std::vector<std::string>{"parameters", "channel: in motion"}));
  EXPECT_NE(text_of(s).find("\nno state   parameters\nno state   channel: in motion\n"), std::string::npos);
  EXPECT_EQ(json_of(s)["without_state"][0], "parameters");
}

// What a crash or a full disk leaves is read up to the last whole chunk, byte by byte of the last ones.
TEST(Summary, AFileCutOffAnywhereInItsLastChunksGivesWhatIsWhole) {
  const auto recording = sample_recording(60);
  const auto file = file_of(recording, 2000);
  const auto whole = recording.messages.size();
  std::size_t most = 0;
  bool complete = false;
  for (std::size_t size = file.size() - std::min<std::size_t>(file.size(), 2500); size <= file.size();
       ++size) {
    const auto part = std::span(file).first(size);
    recording::MemorySource source(part), again(part);
    const auto s = summarize(source);
    const auto loaded = load_recording(again);
    ASSERT_EQ(s.messages, loaded.messages.size());
    ASSERT_EQ(s.complete, s.problem.empty());
    ASSERT_GE(loaded.messages.size(), most) << "a longer file gives no less";
    most = loaded.messages.size();
    for (std::size_t i = 0; i < most; ++i) ASSERT_EQ(loaded.messages[i].cdr, recording.messages[i].cdr);
    EXPECT_TRUE(s.complete || !complete);
    complete = s.complete;
    EXPECT_TRUE(most == whole || !complete);
  }
  EXPECT_EQ(most, whole);
  EXPECT_TRUE(complete);
}

TEST(Csv, WritesALineForEachCycleThatReadsBackToTheSameBits) {
  const auto recording = sample_recording(2);
  std::ostringstream out;
  EXPECT_EQ(write_csv(recording, *bus::find_topic("kinematics_batch"), out), 16u);
  std::istringstream in(out.str());
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line,
            "cycle,channel,epoch,revision,starts,ends,line,setpoint.axis0,setpoint.axis1,state.KINEMATICS[0],"
            "time_utc");
  std::getline(in, line);
  EXPECT_EQ(line, "0,0,1,1,true,false,7,0,0.10000000000000001,,1970-01-01T00:00:00.000000022Z")
      << "the state is told after the batch only; add_motion() writes the batch at 1 + 10 + 10 + 1 ns";
  for (int i = 1; i < 8; ++i) std::getline(in, line);
  EXPECT_EQ(line, "7,0,1,1,false,false,7,7,7.0999999999999996,0,1970-01-01T00:00:00.000000022Z");
  EXPECT_EQ(std::stod("7.0999999999999996"), 7 + 0.1);
}

TEST(Csv, QuotesTextsAndLeavesEmptyWhatAMessageDoesNotHave) {
  StoredRecording recording;
  idl::service::Alarm alarm;
  alarm.text = "a \"quoted\", text";
  recording.messages = {stored(topics::alarm, alarm, 42)};
  std::ostringstream out;
  EXPECT_EQ(write_csv(recording, *bus::find_topic("alarm"), out), 1u);
  EXPECT_NE(out.str().find(",\"a \"\"quoted\"\", text\","), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("\n42,"), std::string::npos);
  EXPECT_TRUE(out.str().ends_with(",1970-01-01T00:00:00.000000042Z\n")) << out.str();
}

std::vector<std::string> csv_lines(const StoredMessage& message) {
  StoredRecording recording;
  recording.messages = {message};
  std::stringstream csv;
  write_csv(recording, *message.topic, csv);
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  return lines;
}

TEST(Csv, HasTheAngleOfTheSpindlesInEachCycleAndTheirSpeedInTheLastOfABatch) {
  auto turned = feedback(0, 2);
  turned.spindle_angle = {0.5, 0.75};
  turned.spindle_speed = {1000};
  turned.spindle_oriented = {1};
  turned.velocity = {1, 2};
  turned.torque = {0.5, 0.25};
  const auto lines = csv_lines(stored(topics::feedback, turned, 7));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "cycle,channel,epoch,revision,commanded[0],commanded[1],actual[0],actual[1],spindle_angle[0],"
            "spindle_speed[0],spindle_oriented[0],velocity[0],velocity[1],torque[0],torque[1],time_utc");
  EXPECT_EQ(lines[1], "0,0,0,0,1,1,0.5,0.5,0.5,,,,,,,1970-01-01T00:00:00.000000007Z");
  EXPECT_EQ(lines[2], "1,0,0,0,1,1,0.5,0.5,0.75,1000,1,1,2,0.5,0.25,1970-01-01T00:00:00.000000007Z");
}

TEST(Csv, HasTheStateOfEachSpindleWhereItWasRecorded) {
  auto turned = feedback(0, 1);
  turned.spindle_angle = {0.5};
  turned.spindle_speed = {1000};
  turned.spindles.resize(1);
  turned.spindles[0].condition = idl::stream::SpindleCondition::SPINDLE_ACCELERATING;
  turned.spindles[0].reference = 1500.5;
  turned.spindles[0].homed = true;
  turned.spindles[0].gear = 2;
  turned.spindles[0].master = -1;
  const auto lines = csv_lines(stored(topics::feedback, turned, 7));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            "cycle,channel,epoch,revision,commanded[0],commanded[1],actual[0],actual[1],spindle_angle[0],"
            "spindle_speed[0],spindle_condition[0],spindle_reference[0],spindle_homed[0],spindle_gear[0],"
            "spindle_master[0],spindle_synchronization_error[0],spindle_correction[0],time_utc");
  EXPECT_EQ(lines[1],
            "0,0,0,0,1,1,0.5,0.5,0.5,1000,SPINDLE_ACCELERATING,1500.5,1,2,-1,0,0,"
            "1970-01-01T00:00:00.000000007Z");
}

TEST(Csv, HasMasterErrorAndCorrectionOfASpindleThatFollows) {
  auto turned = feedback(0, 1);
  turned.spindles.resize(2);
  turned.spindles[0].master = -1;
  turned.spindles[1].condition = idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZED;
  turned.spindles[1].master = 0;
  turned.spindles[1].synchronization_error = -0.125;
  turned.spindles[1].correction = 1.5;
  const auto lines = csv_lines(stored(topics::feedback, turned, 7));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(lines[0].ends_with(
      ",spindle_condition[1],spindle_reference[1],spindle_homed[1],spindle_gear[1],spindle_master[1],"
      "spindle_synchronization_error[1],spindle_correction[1],time_utc"))
      << lines[0];
  EXPECT_TRUE(lines[1].ends_with(",SPINDLE_SYNCHRONIZED,0,0,0,0,-0.125,1.5,1970-01-01T00:00:00.000000007Z"))
      << lines[1];
}

TEST(Csv, HasTheSetpointOfACoupledSpindle) {
  auto tapping = path_batch(0, true, false);
  tapping.spindle_axis = 4;
  tapping.spindle.assign(batch_cycles, 0.25);
  const auto lines = csv_lines(stored(topics::path_batch, tapping, 7));
  ASSERT_EQ(lines.size(), 1 + std::size_t{batch_cycles});
  EXPECT_TRUE(lines[0].ends_with(",setpoint.W,spindle_axis,spindle,time_utc")) << lines[0];
  EXPECT_TRUE(lines[1].ends_with(",4,0.25,1970-01-01T00:00:00.000000007Z")) << lines[1];
  tapping.follows_spindle = true;
  const auto thread = csv_lines(stored(topics::path_batch, tapping, 7));
  EXPECT_TRUE(thread[0].ends_with(",spindle_axis,spindle,follows_spindle,time_utc")) << thread[0];
}

TEST(Csv, HasTheRadiusAtWhichAProgramTurns) {
  auto turning = path_batch(0, true, false);
  turning.turning_radius.assign(batch_cycles, 40.5);
  const auto lines = csv_lines(stored(topics::path_batch, turning, 7));
  ASSERT_EQ(lines.size(), 1 + std::size_t{batch_cycles});
  EXPECT_TRUE(lines[0].ends_with(",setpoint.W,turning_radius,time_utc")) << lines[0];
  EXPECT_TRUE(lines[1].ends_with(",40.5,1970-01-01T00:00:00.000000007Z")) << lines[1];
}

}  // namespace
}  // namespace trunnion::verification
