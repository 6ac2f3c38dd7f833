// SPDX-License-Identifier: Apache-2.0
#include "verification/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sample_recording.hpp"

namespace trunnion::verification {
namespace {

TEST(Schedule, StatesFromBeforeTheRecordingAreDueAtOnceAndTheRestInItsTimeAtTheRate) {
  StoredRecording recording;
  constexpr std::uint64_t second = 1'000'000'000;
  recording.messages = {stored(topics::path_batch, path_batch(0, true, false), 100 * second),
                        stored(topics::path_batch, path_batch(8, false, true), 103 * second),
                        parameters(1, 5 * second)};
  const auto due = schedule(recording, {}, 2);
  ASSERT_EQ(due.size(), 3u);
  EXPECT_EQ(due[0].message->topic->handle, "parameter_set");
  EXPECT_EQ(due[0].seconds, 0);
  EXPECT_EQ(due[1].seconds, 0);
  EXPECT_EQ(due[2].seconds, 1.5) << "three seconds at twice the rate";
}

TEST(Schedule, BatchesGoByEpochAndCycleWhateverTheOrderTheyWereHeardIn) {
  StoredRecording recording;
  recording.messages = {stored(topics::path_batch, path_batch(8, false, true), 10),
                        stored(topics::path_batch, path_batch(0, true, false), 20),
                        stored(topics::path_batch, path_batch(4, true, true, 2), 15)};
  const auto due = schedule(recording, {}, 1);
  std::vector<std::uint64_t> firsts;
  for (const auto& d : due) {
    idl::stream::PathBatch batch;
    ASSERT_TRUE(bus::decode(d.message->cdr, batch));
    firsts.push_back(batch.first);
  }
  EXPECT_EQ(firsts, (std::vector<std::uint64_t>{0, 8, 4})) << "epoch 2 begins at cycle 4";
  EXPECT_TRUE(std::is_sorted(due.begin(), due.end(),
                             [](const Due& a, const Due& b) { return a.seconds < b.seconds; }));
}

TEST(Schedule, OnlyTheTopicsAskedFor) {
  const auto recording = sample_recording(5);
  EXPECT_EQ(schedule(recording, {"kinematics_batch"}, 1).size(), 5u);
  EXPECT_EQ(schedule(recording, {}, 1).size(), recording.messages.size());
  const StoredRecording empty;
  EXPECT_TRUE(schedule(empty, {}, 1).empty());
}

}  // namespace
}  // namespace trunnion::verification
