// SPDX-License-Identifier: Apache-2.0
// The recorder as a process: what was on the bus is in the file, on both vendors.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <thread>

#include "bus/bus.hpp"
#include "bus/json.hpp"
#include "contracts/topics.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_reader.hpp"
#include "storage/temporary_directory.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::recorder {
namespace {

// A child with its standard output and standard error at our end of a pipe.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("pipe");
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], 1);
      dup2(ends[1], 2);
      close(ends[0]);
      close(ends[1]);
      std::vector<char*> argv;
      for (auto& argument : arguments) argv.push_back(argument.data());
      argv.push_back(nullptr);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    output_ = fdopen(ends[0], "r");
  }
  ~Process() {
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
    fclose(output_);
  }
  std::string line() {
    char text[4096] = "";
    return fgets(text, sizeof text, output_) != nullptr ? text : "";
  }
  void signal(int number) const { kill(pid_, number); }
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t pid_;
  FILE* output_;
};

class RecorderProcess : public testing::TestWithParam<std::pair<bus::Vendor, std::uint32_t>> {
 protected:
  std::string file = testing::TempDir() + "/recorder_" + bus::to_string(GetParam().first) +
                     std::to_string(getpid()) + ".mcap";
  void TearDown() override { std::filesystem::remove(file); }
  Process start(std::uint32_t domain) const {
    return Process({RECORDER, "--output", file, "--domain", std::to_string(domain), "--vendor",
                    bus::to_string(GetParam().first), "--json"});
  }
};

TEST_P(RecorderProcess, WritesEveryMessageAndFinishesOnSigterm) {
  const auto [vendor, domain] = GetParam();
  bus::Bus bus(vendor, {domain}, {64});
  auto batches = bus.writer(topics::path_batch);
  auto alarms = bus.writer(topics::alarm);
  idl::service::Alarm alarm;
  alarm.text = "written before the recorder came";
  alarms.write(alarm);
  Process recorder({RECORDER, "--output", file, "--domain", std::to_string(domain), "--vendor",
                    bus::to_string(vendor), "--machine", "bench", "--json"});
  ASSERT_EQ(recorder.line(), "recording " + file + "\n");
  ASSERT_TRUE(testing_support::eventually([&] { return alarms.matched() > 0; }));
  EXPECT_EQ(batches.matched(), 0) << "batches of this host are not sent to it";
  idl::stream::PathBatch batch;
  batch.count = 8;
  constexpr std::uint64_t count = 500;
  for (std::uint64_t i = 0; i < count; ++i) {
    batch.first = 8 * i + (i >= 300 ? 16 : 0);  // sixteen cycles without a writer
    batch.starts = i == 0;
    batch.setpoints.assign(72, static_cast<double>(i));
    ASSERT_TRUE(batches.write(batch));
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  recorder.signal(SIGTERM);
  const auto summary = bus::Json::parse(recorder.line());
  EXPECT_EQ(recorder.wait(), 0);
  EXPECT_EQ(summary["topics"]["path_batch"]["messages"], count);
  EXPECT_EQ(summary["topics"]["path_batch"]["cycles"], 8 * count);
  EXPECT_EQ(summary["topics"]["path_batch"]["lost_cycles"], 16);
  EXPECT_EQ(summary["dropped_messages"], 0);
  EXPECT_EQ(summary["bytes"], std::filesystem::file_size(file));

  recording::FileSource source(file);
  recording::Reader reader(source);
  recording::MessageView message;
  std::uint64_t seen = 0, last_time = 0;
  bool alarm_seen = false;
  while (reader.next(message)) {
    if (message.channel->topic == topics::alarm.name) {
      idl::service::Alarm read;
      ASSERT_TRUE(bus::decode(message.data, read));
      alarm_seen = read.text == alarm.text;
    }
    if (message.channel->topic != topics::path_batch.name) continue;
    idl::stream::PathBatch read;
    ASSERT_TRUE(bus::decode(message.data, read));
    EXPECT_EQ(read.setpoints, std::vector<double>(72, static_cast<double>(seen)));
    EXPECT_EQ(message.sequence, ++seen);
    EXPECT_GE(message.log_time, last_time) << "one writer's source time stamps ascend";
    last_time = message.log_time;
  }
  EXPECT_EQ(reader.ending(), recording::Ending::complete) << reader.problem();
  EXPECT_EQ(seen, count);
  EXPECT_TRUE(alarm_seen) << "state from before is in the recording";
  ASSERT_EQ(reader.metadata().size(), 1u);
  EXPECT_EQ(reader.metadata()[0].values.at("machine"), "bench");
  EXPECT_EQ(reader.metadata()[0].values.at("contract"), topics::contract_hash);
}

// One writer is in memory, the other not, as a service from elsewhere; and it comes while the recording runs.
TEST_P(RecorderProcess, TakesEachBatchOnceWhetherItComesFromMemoryOrByDds) {
  const auto [vendor, domain] = GetParam();
  bus::Bus bus(vendor, {domain + 3}, {64});
  auto in_memory = bus.writer(topics::path_batch);
  Process recorder = start(domain + 3);
  ASSERT_EQ(recorder.line(), "recording " + file + "\n");
  idl::stream::PathBatch batch;
  batch.count = 8;
  bus::Bytes bytes;
  std::unique_ptr<bus::RawWriter> by_dds;
  for (int phase = 0; phase < 3; ++phase) {
    if (phase == 1) {
      by_dds = bus.backend().writer(bus::describe(topics::path_batch), {true, 64});
      batch.replica = 1;
      bus::encode(batch, bytes);
      by_dds->write(bytes);  // before the recorder knows of it
      ASSERT_TRUE(testing_support::eventually([&] { return by_dds->matched() > 0; }));
    }
    for (int i = 0; i < 100; ++i) {
      batch.replica = 0;
      in_memory.write(batch);
      batch.replica = 1;
      bus::encode(batch, bytes);
      if (phase == 1) by_dds->write(bytes);
      batch.first += 8;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    if (phase == 1) {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      by_dds.reset();
      EXPECT_TRUE(testing_support::eventually([&] { return in_memory.matched() == 0; }))
          << "it is no longer sent to the recorder when that is not needed";
    }
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  recorder.signal(SIGTERM);
  const auto summary = bus::Json::parse(recorder.line());
  EXPECT_EQ(recorder.wait(), 0);
  EXPECT_EQ(summary["overwritten_messages"], 0);
  recording::FileSource source(file);
  recording::Reader reader(source);
  recording::MessageView message;
  std::array<int, 2> seen{};
  while (reader.next(message)) {
    if (message.channel->topic != topics::path_batch.name) continue;
    ASSERT_TRUE(bus::decode(message.data, batch));
    ++seen.at(batch.replica);
  }
  EXPECT_EQ(seen[0], 300);
  EXPECT_EQ(seen[1], 101);
}

// A suspended recorder, as one without processor time, loses the oldest messages and reports this.
TEST_P(RecorderProcess, SaysHowManyBatchesWereOverwrittenBeforeItCouldTakeThem) {
  const auto [vendor, domain] = GetParam();
  bus::Bus bus(vendor, {domain + 4}, {64});
  auto batches = bus.writer(topics::path_batch);
  Process recorder = start(domain + 4);
  ASSERT_EQ(recorder.line(), "recording " + file + "\n");
  idl::stream::PathBatch batch;
  batches.write(batch);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  recorder.signal(SIGSTOP);
  batch.count = 64;
  batch.setpoints.assign(576, 1);
  bus::Bytes bytes;
  bus::encode(batch, bytes);
  const std::size_t written = (std::size_t{6} << 20) / bytes.size();  // half as much again as there is room
  for (std::size_t i = 0; i < written; ++i) batches.write(batch);
  recorder.signal(SIGCONT);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  recorder.signal(SIGTERM);
  const auto summary = bus::Json::parse(recorder.line());
  EXPECT_EQ(recorder.wait(), 1) << "something is missing";
  const auto taken = summary["topics"]["path_batch"]["messages"].get<std::size_t>();
  EXPECT_GT(taken, written / 2);
  EXPECT_EQ(taken + summary["overwritten_messages"].get<std::size_t>(), written + 1);
}

TEST_P(RecorderProcess, TakesOnlyTheTopicsAskedForAndStopsAfterItsDuration) {
  const auto [vendor, domain] = GetParam();
  bus::Bus bus(vendor, {domain + 1});
  auto alarms = bus.writer(topics::alarm);
  auto clusters = bus.writer(topics::cluster);
  alarms.write({});
  clusters.write({});
  Process recorder({RECORDER, "--output", file, "--domain", std::to_string(domain + 1), "--vendor",
                    bus::to_string(vendor), "--topics", "alarm,path_batch", "--duration", "1"});
  ASSERT_EQ(recorder.line(), "recording " + file + "\n");
  EXPECT_EQ(recorder.wait(), 0);
  recording::FileSource source(file);
  recording::Reader reader(source);
  recording::MessageView message;
  int count = 0;
  while (reader.next(message)) {
    EXPECT_EQ(message.channel->topic, topics::alarm.name);
    ++count;
  }
  EXPECT_EQ(count, 1);
}

// Nobody stops it: it ends by itself.
TEST_P(RecorderProcess, AFullDiskEndsItWithOneLine) {
  const auto [vendor, domain] = GetParam();
  Process recorder({RECORDER, "--output", "/dev/full", "--domain", std::to_string(domain + 2), "--vendor",
                    bus::to_string(vendor)});
  std::string error, line;
  while (!(line = recorder.line()).empty())
    if (line.starts_with("trunnion-recorder: error:")) error += line;
  EXPECT_EQ(error, "trunnion-recorder: error: /dev/full: No space left on device; the file ends at byte 0\n");
  EXPECT_EQ(recorder.wait(), 1);
}

INSTANTIATE_TEST_SUITE_P(Vendors, RecorderProcess,
                         testing::Values(std::pair{bus::Vendor::cyclonedds, 56u},
                                         std::pair{bus::Vendor::fastdds, 14u}),
                         [](const auto& it) { return std::string(bus::to_string(it.param.first)); });

// One of two services is silent, as one that hangs, and then answers.
TEST(RecorderStart, NamesAServiceThatDoesNotGiveItsStateAndAsksUntilItDoes) {
  constexpr std::uint32_t domain = 19;
  const storage::TemporaryDirectory directory("trunnion-recorder-test");
  const auto file = (directory.path() / "silent.mcap").string();
  bus::Bus bus(bus::Vendor::cyclonedds, {domain});
  auto clusters = bus.writer(topics::cluster);
  auto states = bus.writer(topics::service_state);
  auto snapshots = bus.writer(topics::service_snapshot);
  auto requests = bus.reader(topics::snapshot_request);
  constexpr std::uint32_t silent = 1, quick = 2;
  idl::service::Cluster cluster;
  for (const auto instance : {silent, quick}) {
    idl::service::ClusterService listed;
    listed.instance = instance;
    listed.service = instance == silent ? "parameters" : "kinematics";
    listed.pid = getpid();
    cluster.services.push_back(listed);
    idl::service::ServiceState state;
    state.instance = instance;
    states.write(state);
  }
  clusters.write(cluster);
  std::atomic<bool> answers = false, over = false;
  std::thread services([&] {
    idl::service::SnapshotRequest request;
    idl::service::ServiceSnapshot snapshot;
    snapshot.parts = 1;
    for (; !over; bus.signal().wait(0.01))
      while (requests.take(request))
        for (const auto instance : {silent, quick}) {
          if (instance == silent && !answers) continue;
          snapshot.instance = instance;
          snapshot.time = static_cast<std::uint64_t>(bus::source_time());
          snapshots.write(snapshot);
        }
  });
  Process recorder({RECORDER, "--output", file, "--domain", std::to_string(domain), "--json", "--topics",
                    "cluster,service_state,snapshot_request,service_snapshot"});
  std::set<std::string> said{recorder.line(), recorder.line()};
  EXPECT_EQ(said,
            (std::set<std::string>{
                "recording " + file + "\n",
                "trunnion-recorder: warning: parameters has not given its state within 15 s: it is asked "
                "again, and cannot be verified before it answers\n"}));
  answers = true;
  EXPECT_EQ(recorder.line(), "trunnion-recorder: parameters has given its state\n");
  over = true;
  services.join();
  recorder.signal(SIGTERM);
  EXPECT_EQ(bus::Json::parse(recorder.line())["without_state"], bus::Json::array());
  EXPECT_EQ(recorder.wait(), 0);
}

TEST(RecorderCommandLine, RefusesToStartWithTooLittleSpace) {
  const std::string file = testing::TempDir() + "/unused.mcap";
  Process recorder({RECORDER, "--output", file, "--free-space", "1e9"});
  const auto said = recorder.line();
  EXPECT_TRUE(said.starts_with("trunnion-recorder: error: " + file + ": ")) << said;
  EXPECT_NE(said.find(" are free on its disk, a recording needs 1000000.0 GB: "), std::string::npos) << said;
  EXPECT_EQ(recorder.wait(), 1);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(RecorderCommandLine, NamesATopicThatDoesNotExist) {
  Process recorder({RECORDER, "--output", testing::TempDir() + "/unused.mcap", "--topics", "path_farme"});
  EXPECT_EQ(recorder.line(), "trunnion-recorder: error: unknown topic 'path_farme'\n");
  EXPECT_EQ(recorder.wait(), 1);
}

}  // namespace
}  // namespace trunnion::recorder
