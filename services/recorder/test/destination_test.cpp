// SPDX-License-Identifier: Apache-2.0
// Parts and flight recordings: what is in which file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "flight_recorder.hpp"
#include "machine/alarm_constants.hpp"
#include "part_files.hpp"
#include "recording/mcap_reader.hpp"

namespace trunnion::recorder {
namespace {

constexpr std::uint16_t alarm_topic = 0, state_topic = 1, batch_topic = 2;
constexpr std::int64_t began = 1'000'000'000;  // the recorder's begin on the writers' clock, ns

class Destinations : public testing::Test {
 protected:
  Destinations() { std::filesystem::create_directory(folder); }
  ~Destinations() override { std::filesystem::remove_all(folder); }

  template <class T>
  Message message(std::uint16_t topic, const T& value) {
    Message m{topic, ++sequence[topic], began + ++clock, {}};
    bus::encode(value, m.cdr);
    return m;
  }
  Message batch(std::uint64_t first, std::size_t values = 4) {
    idl::stream::PathBatch batch;
    batch.first = first;
    batch.count = 1;
    // Not to be compressed away.
    for (std::size_t i = 0; i < values; ++i)
      batch.setpoints.push_back(std::sin(1e6 * double(first * 1000 + i)));
    return message(batch_topic, batch);
  }
  Message channel_state(std::uint16_t channel, std::uint32_t line) {
    idl::channel::ChannelState state;
    state.channel = channel;
    state.line = line;
    return message(state_topic, state);
  }
  Message alarm(std::uint32_t number, bool active, std::uint32_t occurrences,
                idl::service::Severity severity = idl::service::Severity::ERROR) {
    idl::service::Alarm alarm;
    alarm.number = number;
    alarm.active = active;
    alarm.occurrences = occurrences;
    alarm.severity = severity;
    alarm.source = "drive";
    alarm.text = "Following error";
    return message(alarm_topic, alarm);
  }

  struct Content {
    std::vector<std::uint64_t> batches;                           // first cycles
    std::vector<std::pair<std::uint16_t, std::uint32_t>> states;  // channel and line
    std::vector<std::uint32_t> alarms;
    recording::StringMap metadata;
  };
  static Content read(const std::string& path) {
    Content content;
    recording::FileSource source(path);
    recording::Reader reader(source);
    recording::MessageView view;
    while (reader.next(view)) {
      if (view.channel->topic == topics::path_batch.name) {
        idl::stream::PathBatch batch;
        EXPECT_TRUE(bus::decode(view.data, batch));
        content.batches.push_back(batch.first);
      } else if (view.channel->topic == topics::channel_state.name) {
        idl::channel::ChannelState state;
        EXPECT_TRUE(bus::decode(view.data, state));
        content.states.emplace_back(state.channel, state.line);
      } else {
        idl::service::Alarm alarm;
        EXPECT_TRUE(bus::decode(view.data, alarm));
        content.alarms.push_back(alarm.number);
      }
    }
    EXPECT_EQ(reader.ending(), recording::Ending::complete) << path << ": " << reader.problem();
    content.metadata = reader.metadata().at(0).values;
    return content;
  }

  const std::string folder = testing::TempDir() + "/destination_" + std::to_string(getpid());
  const std::string path = folder + "/run.mcap";
  const FileHeader header{
      {bus::find_topic("alarm"), bus::find_topic("channel_state"), bus::find_topic("path_batch")},
      {{"machine", "bench"}}};
  std::array<std::uint32_t, 3> sequence{};
  std::int64_t clock = 0;
};

TEST_F(Destinations, WithoutLimitsEverythingIsInTheOneFile) {
  PartFiles files(path, header, {}, 0);
  for (int i = 0; i < 10; ++i) {
    auto m = batch(static_cast<std::uint64_t>(i));
    files.take(m, i);
  }
  files.finish(10);
  ASSERT_EQ(files.files().size(), 1u);
  EXPECT_EQ(files.files()[0].path, path);
  EXPECT_EQ(files.files()[0].messages, 10u);
  EXPECT_EQ(files.files()[0].bytes, std::filesystem::file_size(path));
  EXPECT_EQ(read(path).batches.size(), 10u);
}

TEST_F(Destinations, PartsBySizeLoseNothingAndBeginWithTheStatesThatHold) {
  constexpr std::uint64_t count = 3000;
  PartFiles files(path, header, {3 << 20, 0, 0}, 0);
  auto first = channel_state(0, 7), second = channel_state(1, 8), third = channel_state(0, 9);
  for (auto* m : {&first, &second, &third}) files.take(*m, 0);
  for (std::uint64_t i = 0; i < count; ++i) {
    auto m = batch(i, 570);  // 4.6 kB: 13.7 MB in all
    files.take(m, 0);
  }
  files.finish(0);
  ASSERT_GE(files.files().size(), 4u);
  std::uint64_t next = 0;
  for (std::size_t part = 0; part < files.files().size(); ++part) {
    const auto content = read(files.files()[part].path);
    for (const auto cycle : content.batches) EXPECT_EQ(cycle, next++);
    using Lines = std::vector<std::pair<std::uint16_t, std::uint32_t>>;
    // The first part has them as they came, the others the newest of each channel.
    EXPECT_EQ(content.states, part == 0 ? (Lines{{0, 7}, {1, 8}, {0, 9}}) : (Lines{{0, 9}, {1, 8}}));
    EXPECT_EQ(content.metadata.at("part"), std::to_string(part + 1));
    EXPECT_EQ(content.metadata.at("machine"), "bench");
    // A chunk of 1 MiB may be under way when the limit is passed.
    EXPECT_LE(files.files()[part].bytes, (3u << 20) + (2u << 20));
  }
  EXPECT_EQ(next, count);
  EXPECT_EQ(read(files.files()[1].path).metadata.at("previous"), "run-0001.mcap");
}

TEST_F(Destinations, PartsByTimeKeepTheNewestOnly) {
  PartFiles files(path, header, {0, 10, 2}, 0);
  for (std::uint64_t i = 0; i < 45; ++i) {
    auto m = batch(i);
    files.take(m, static_cast<double>(i));
  }
  files.finish(45);
  // Parts begin at 0, 10, 20, 30 and 40 s; the last two stay.
  ASSERT_EQ(files.files().size(), 2u);
  EXPECT_EQ(files.files()[0].path, folder + "/run-0004.mcap");
  EXPECT_EQ(read(files.files()[0].path).batches.front(), 30u);
  EXPECT_EQ(read(files.files()[1].path).batches.size(), 5u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
}

TEST_F(Destinations, PartsOfAnEarlierRunStay) {
  for (const auto* name : {"run-0001.mcap", "run-0007.mcap", "run-old.mcap", "run-0009.txt"})
    fclose(fopen((folder + "/" + name).c_str(), "w"));
  PartFiles files(path, header, {0, 10, 0}, 0);
  files.finish(0);
  EXPECT_EQ(files.files()[0].path, folder + "/run-0008.mcap");
}

TEST_F(Destinations, AnAlarmSavesTheSecondsBeforeItAndAfterIt) {
  FlightRecorder recorder(path, header, {30, 2, 1 << 20}, began);
  auto state = channel_state(0, 5);
  recorder.take(state, 0);
  for (int t = 0; t <= 100; ++t) {
    auto m = batch(static_cast<std::uint64_t>(t));
    recorder.take(m, t);
    if (t == 50) {
      auto a = alarm(110, true, 1);
      recorder.take(a, 50.5);
    }
  }
  recorder.finish(100);
  ASSERT_EQ(recorder.files().size(), 1u);
  EXPECT_EQ(recorder.files()[0].why, "alarm 110 of drive: Following error");
  const auto content = read(folder + "/run-0001.mcap");
  // Saved at 52.5 s, noticed with the message of 53 s: from 20.5 s on.
  EXPECT_EQ(content.batches.front(), 21u);
  EXPECT_EQ(content.batches.back(), 53u);
  EXPECT_EQ(content.batches.size(), 33u);
  EXPECT_EQ(content.alarms, std::vector<std::uint32_t>{110});
  EXPECT_EQ(content.states.size(), 1u) << "the state of second 0 still held";
  EXPECT_EQ(content.metadata.at("saved_because"), "alarm 110 of drive: Following error");
}

TEST_F(Destinations, AlarmsThatAreNoNewsSaveNothing) {
  FlightRecorder recorder(path, header, {30, 0, 1 << 20, idl::service::Severity::WARNING}, began);
  double now = 0;
  const auto take = [&](Message m) {
    recorder.take(m, ++now);
    recorder.idle(now);
    return recorder.files().size();
  };
  auto old = alarm(100, true, 1);
  old.source_time = began - 1;
  EXPECT_EQ(take(old), 0u) << "from before the recorder";
  EXPECT_EQ(take(alarm(100, true, 1)), 0u) << "the same again";
  EXPECT_EQ(take(alarm(101, true, 1, idl::service::Severity::HINT)), 0u) << "too small";
  EXPECT_EQ(take(alarm(100, false, 1)), 0u) << "over";
  EXPECT_EQ(take(alarm(100, true, 1)), 1u) << "raised again by a restarted source";
  EXPECT_EQ(take(alarm(100, true, 2)), 2u) << "once more";
}

// A warning that the disk is almost full must not fill it.
TEST_F(Destinations, AlarmsOfRecordersSaveNothing) {
  FlightRecorder recorder(path, header, {30, 0, 1 << 20, idl::service::Severity::WARNING}, began);
  for (const auto number : {alarm::recording_space_low.number, alarm::recording_ended.number}) {
    auto m = alarm(number, true, 1);
    recorder.take(m, 1);
  }
  EXPECT_TRUE(recorder.files().empty());
}

TEST_F(Destinations, AlarmsThatFollowSoonAreInTheFileOfTheFirst) {
  FlightRecorder recorder(path, header, {30, 5, 1 << 20}, began);
  auto first = alarm(100, true, 1), second = alarm(110, true, 1);
  recorder.take(first, 10);
  recorder.take(second, 12);
  recorder.finish(13);  // the recorder is stopped before the 5 s are over
  ASSERT_EQ(recorder.files().size(), 1u);
  EXPECT_EQ(read(recorder.files()[0].path).alarms, (std::vector<std::uint32_t>{100, 110}));
}

TEST_F(Destinations, AFlightRecorderKeepsWithinItsMemory) {
  FlightRecorder recorder(path, header, {1e9, 0, 1 << 20}, began);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    auto m = batch(i, 570);
    recorder.take(m, static_cast<double>(i));
  }
  auto a = alarm(100, true, 1);
  recorder.take(a, 2000);
  ASSERT_EQ(recorder.files().size(), 1u);
  const auto content = read(recorder.files()[0].path);
  EXPECT_EQ(content.batches.back(), 1999u);
  // 4560 bytes of values and less than 0.8 kB beside them in each message.
  EXPECT_LE(content.batches.size(), (1u << 20) / 4560u);
  EXPECT_GE(content.batches.size(), (1u << 20) / 5360u);
}

TEST_F(Destinations, WhatHasEndedIsWholeAndTakesNothingMore) {
  PartFiles files(path, header, {0, 5, 0}, 0);
  auto before = batch(0), after = batch(1);
  files.take(before, 0);
  EXPECT_FALSE(files.ended());
  files.end("the disk is full");
  EXPECT_TRUE(files.ended());
  const auto bytes = std::filesystem::file_size(path.substr(0, path.size() - 5) + "-0001.mcap");
  files.take(after, 10);  // it would begin another part
  files.idle(10);
  files.finish(11);
  ASSERT_EQ(files.files().size(), 1u);
  EXPECT_EQ(std::filesystem::file_size(files.files()[0].path), bytes);
  EXPECT_EQ(files.files()[0].bytes, bytes);
  EXPECT_EQ(read(files.files()[0].path).batches, std::vector<std::uint64_t>{0});
  EXPECT_EQ(files.unwritten(), 1u);
  EXPECT_EQ(files.problem(), "the disk is full");
}

TEST_F(Destinations, AWriteErrorEndsTheRecording) {
  PartFiles files("/dev/full", header, {}, 0);
  auto m = batch(0);
  files.take(m, 0);
  files.idle(2);  // writes the chunk
  EXPECT_TRUE(files.ended());
  EXPECT_EQ(files.problem(), "/dev/full: No space left on device; the file ends at byte 0");
}

TEST_F(Destinations, AFlightRecorderWaitsForSpace) {
  FlightRecorder recorder(path, header, {30, 0, 1 << 20}, began);
  recorder.end("the disk is full");
  EXPECT_FALSE(recorder.ended());
  auto m = alarm(100, true, 1);
  recorder.take(m, 1);
  EXPECT_EQ(recorder.files().size(), 1u);
}

TEST_F(Destinations, AFileThatCannotBeMadeIsToldAndTheWatchGoesOn) {
  const std::string away = folder + "/later";
  FlightRecorder recorder(away + "/run.mcap", header, {30, 0, 1 << 20}, began);
  auto first = alarm(100, true, 1);
  recorder.take(first, 1);
  EXPECT_EQ(recorder.problem(), away + "/run-0001.mcap: No such file or directory");
  EXPECT_EQ(recorder.unwritten(), 1u);
  std::filesystem::create_directory(away);
  auto second = alarm(100, true, 2);
  recorder.take(second, 2);
  ASSERT_EQ(recorder.files().size(), 1u);
  EXPECT_EQ(read(recorder.files()[0].path).alarms, (std::vector<std::uint32_t>{100, 100}));
}

}  // namespace
}  // namespace trunnion::recorder
