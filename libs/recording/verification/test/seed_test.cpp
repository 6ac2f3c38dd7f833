// SPDX-License-Identifier: Apache-2.0
#include "verification/seed.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "sample_recording.hpp"

namespace trunnion::verification {
namespace {

using idl::service::ServiceSnapshot;
using idl::service::SnapshotKind;

constexpr std::uint32_t instance = 5;

ServiceSnapshot snapshot(std::uint64_t time, std::int32_t pid = 100,
                         SnapshotKind kind = SnapshotKind::GIVEN) {
  ServiceSnapshot head;
  head.instance = instance;
  head.pid = pid;
  head.number = time;
  head.time = time;
  head.kind = kind;
  head.detail = kind == SnapshotKind::LATER ? "in motion" : "";
  head.taken = {{topics::parameter_set.name, time - 10}, {topics::channel_request.name, time - 5}};
  return head;
}

class SeedTest : public testing::Test {
 protected:
  void request(std::uint64_t time) {
    recording_.messages.push_back(stored(topics::snapshot_request, {1, 1}, time));
  }
  void give(const ServiceSnapshot& head, const std::string& state = "{}") {
    for (const auto& part : snapshot::parts_of(head, state))
      recording_.messages.push_back(stored(topics::service_snapshot, part, head.time + 1));
  }
  void announce(std::int32_t pid, std::uint64_t time) {
    recording_.messages.push_back(
        stored(topics::announcement, {instance, "channel", "cyclonedds", "host", pid, "", ""}, time));
  }
  StoredMessage parameters(std::uint64_t revision, std::uint64_t time) {
    idl::parameters::ParameterSet set;
    set.revision = revision;
    return stored(topics::parameter_set, set, time);
  }
  std::optional<Seed> first_seed() const {
    const auto seeds = find_seeds(recording_, instance);
    return seeds.empty() ? std::nullopt : std::optional(seeds.front());
  }
  StoredRecording recording_;
};

TEST_F(SeedTest, ARecordingWithoutRequestsHasNone) { EXPECT_TRUE(find_seeds(recording_, instance).empty()); }

TEST_F(SeedTest, AStateFromBeforeTheFirstRequestDoesNotCount) {
  give(snapshot(500));
  request(1000);
  give(snapshot(1100), "{\"a\":1}");
  const auto seed = first_seed();
  ASSERT_TRUE(seed);
  EXPECT_EQ(seed->time, 1100u);
  EXPECT_EQ(seed->snapshot.state, "{\"a\":1}");
}

TEST_F(SeedTest, AServiceThatCouldNotGiveItsStateIsNamedWithItsReason) {
  request(1000);
  give(snapshot(1100, 100, SnapshotKind::LATER));
  try {
    first_seed();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "it cannot be verified: the recording has no state of the service to start from; in motion");
  }
  give(snapshot(2000));
  EXPECT_EQ(first_seed()->time, 2000u) << "as soon as it could";
  EXPECT_EQ(first_seed()->refused, "in motion");
}

TEST_F(SeedTest, AServiceThatNeedsNoneStartsWithoutOne) {
  request(1000);
  give(snapshot(1100, 100, SnapshotKind::NOT_NEEDED));
  EXPECT_TRUE(find_seeds(recording_, instance).empty());
}

TEST_F(SeedTest, EndsWhenAnotherProcessIsTheServiceAndTheLongestLifeIsTaken) {
  request(1000);
  announce(100, 10);
  give(snapshot(1100));
  announce(200, 2000);
  recording_.messages.push_back(parameters(1, 2500));
  auto seed = first_seed();
  ASSERT_TRUE(seed);
  EXPECT_EQ(seed->until, 2000u);
  EXPECT_TRUE(seed->covers(parameters(1, 1999)));
  EXPECT_FALSE(seed->covers(parameters(1, 2000)));
  give(snapshot(2100, 200));
  recording_.messages.push_back(parameters(1, 9000));
  seed = first_seed();
  EXPECT_EQ(seed->time, 2100u);
}

TEST_F(SeedTest, KnowsWhatTheServiceHadTaken) {
  request(1000);
  give(snapshot(1100));
  const auto seed = *first_seed();
  EXPECT_TRUE(seed.had_taken(parameters(1, 1090)));
  EXPECT_FALSE(seed.had_taken(parameters(1, 1091))) << "on its way";
  // A topic that the service does not take itself: the time of the snapshot.
  EXPECT_TRUE(seed.had_taken(stored(topics::tool_table, {}, 1100)));
  EXPECT_FALSE(seed.had_taken(stored(topics::tool_table, {}, 1101)));
}

TEST_F(SeedTest, AnEventFromBeforeTheProcessNeverReachedIt) {
  request(1000);
  announce(100, 10);
  announce(200, 2000);
  auto head = snapshot(9000, 200);
  head.taken = {{topics::panel_request.name, 0}, {topics::parameter_set.name, 0}};  // it has taken none yet
  give(head);
  const auto seed = *first_seed();
  EXPECT_TRUE(seed.had_taken(stored(topics::panel_request, {}, 1999)));
  EXPECT_FALSE(seed.had_taken(stored(topics::panel_request, {}, 2000)));
  EXPECT_FALSE(seed.had_taken(parameters(1, 1999))) << "a state reaches a process that comes later";
}

TEST_F(SeedTest, NeedsTheNewestTablesThatItHadAndTheDriveOlderParametersToo) {
  request(1000);
  give(snapshot(1100));
  for (std::uint64_t revision = 1; revision <= 3; ++revision)
    recording_.messages.push_back(parameters(revision, 1000 + 40 * revision));  // 1040, 1080, 1120
  const auto seed = *first_seed();
  const auto times = [&](bool older) {
    std::vector<std::uint64_t> found;
    for (const auto* message : seed.needed_to_start(recording_, older)) found.push_back(message->time);
    return found;
  };
  EXPECT_EQ(times(false), (std::vector<std::uint64_t>{1080}));
  EXPECT_EQ(times(true), (std::vector<std::uint64_t>{1040, 1080}));
}

}  // namespace
}  // namespace trunnion::verification
