// SPDX-License-Identifier: Apache-2.0
// What the vendors' threads call: nothing is locked in a listener.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <pthread.h>

#include <chrono>
#include <thread>

#include "../fastdds/discovery.hpp"
#include "bus/endpoint.hpp"

namespace {
thread_local long locks_of_this_thread = 0;
}  // namespace

// Takes the place of the C library's in this program, so that locks can be counted.
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  ++locks_of_this_thread;
  return lock(mutex);
}

namespace trunnion::bus {
namespace {

TEST(Signal, NotifyingTakesNoLockWhetherTheThreadWaitsOrNot) {
  Signal signal;
  const long before = locks_of_this_thread;
  signal.notify();
  signal.notify();
  EXPECT_EQ(locks_of_this_thread, before);
  EXPECT_TRUE(signal.wait(10));
  std::thread waiting([&] { EXPECT_TRUE(signal.wait(10)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const long then = locks_of_this_thread;
  signal.notify();
  EXPECT_EQ(locks_of_this_thread, then);
  waiting.join();
}

TEST(Signal, NotificationsBeforeAWaitEndItOnce) {
  Signal signal;
  signal.notify();
  signal.notify();
  EXPECT_TRUE(signal.wait(10));
  EXPECT_FALSE(signal.wait(0.001));
  EXPECT_FALSE(signal.wait(0));
  signal.notify();
  EXPECT_TRUE(signal.wait(0)) << "a wait of no length still says whether there was a notification";
}

TEST(Signal, NoNotificationIsLostBetweenTwoThreads) {
  Signal ping, pong;
  constexpr int rounds = 20000;
  std::thread other([&] {
    for (int i = 0; i < rounds && ping.wait(30); ++i) pong.notify();
  });
  int done = 0;
  for (; done < rounds; ++done) {
    ping.notify();
    if (!pong.wait(30)) break;
  }
  other.join();
  EXPECT_EQ(done, rounds);
}

TEST(Discovery, HearingOfAWriterTakesNoLockAndTheThreadThatAsksKnowsTheWritersThatAreLeft) {
  using eprosima::fastrtps::rtps::WriterDiscoveryInfo;
  Discovery discovery;
  std::vector<DiscoveredWriter> writers;
  EXPECT_FALSE(discovery.take_changes(writers));
  const auto hear = [&](std::uint8_t number, const char* topic,
                        WriterDiscoveryInfo::DISCOVERY_STATUS status) {
    eprosima::fastrtps::rtps::WriterProxyData data(1, 1);
    eprosima::fastrtps::rtps::GUID_t guid;
    guid.entityId.value[3] = number;
    data.guid(guid);
    data.topicName(topic);
    data.typeName("a_type");
    data.m_qos.m_userData.setValue({'a', number});
    WriterDiscoveryInfo found(data);
    found.status = status;
    const long before = locks_of_this_thread;
    discovery.on_publisher_discovery(nullptr, std::move(found));
    EXPECT_EQ(locks_of_this_thread, before);
  };
  hear(1, "one", WriterDiscoveryInfo::DISCOVERED_WRITER);
  hear(2, "two", WriterDiscoveryInfo::DISCOVERED_WRITER);
  hear(3, "three", WriterDiscoveryInfo::DISCOVERED_WRITER);
  hear(2, "two", WriterDiscoveryInfo::REMOVED_WRITER);
  hear(3, "three again", WriterDiscoveryInfo::CHANGED_QOS_WRITER);
  ASSERT_TRUE(discovery.take_changes(writers));
  ASSERT_EQ(writers.size(), 2u);
  EXPECT_EQ(writers[0].topic, "one");
  EXPECT_EQ(writers[0].wire_type, "a_type");
  EXPECT_EQ(writers[0].user_data, "a\x01");
  EXPECT_EQ(writers[1].topic, "three again") << "the newest that was heard of a writer";
  EXPECT_FALSE(discovery.take_changes(writers)) << "nothing has changed";
  EXPECT_EQ(writers.size(), 2u);
  hear(1, "one", WriterDiscoveryInfo::REMOVED_WRITER);  // is still on the list when the object ends
}

void hear_process(Discovery& discovery, std::uint8_t number, bool there = true) {
  using eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
  eprosima::fastrtps::rtps::ParticipantProxyData data(
      eprosima::fastrtps::rtps::RTPSParticipantAllocationAttributes{});
  data.m_guid.guidPrefix.value[11] = number;
  data.m_userData.setValue({'a', 'n', 'n'});
  ParticipantDiscoveryInfo found(data);
  found.status = there ? ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT
                       : ParticipantDiscoveryInfo::DROPPED_PARTICIPANT;
  const long before = locks_of_this_thread;
  discovery.on_participant_discovery(nullptr, std::move(found));
  EXPECT_EQ(locks_of_this_thread, before);
}

TEST(Discovery, AWriterIsOfTheProcessThatIsThereAndAProcessIsNoNewsOfWriters) {
  Discovery discovery;
  hear_process(discovery, 7);
  hear_process(discovery, 8);
  hear_process(discovery, 8, false);
  WriterId writer{};
  writer[11] = 7, writer[15] = 3;
  EXPECT_EQ(discovery.origin_of(writer).identity, "ann");
  writer[11] = 8;
  EXPECT_EQ(discovery.origin_of(writer).identity, "") << "it has left";
  EXPECT_EQ(discovery.origin_of(writer).participant, "000000000000000000000008");
  std::vector<DiscoveredWriter> writers;
  EXPECT_FALSE(discovery.take_changes(writers));
}

// Command-line tools come and go for as long as a machine is on. A message is more than 300 bytes, so that
// 20000 of them would be more than 6 MB.
TEST(Discovery, WhatComesAndGoesIsNotKeptByAServiceThatNeverAsks) {
  Discovery discovery;
  hear_process(discovery, 7);
  discovery.keep_up();
  const auto before = mallinfo2().uordblks;
  for (int n = 0; n < 20000; ++n) {
    hear_process(discovery, 8, n % 2 == 0);
    if (n % 100 == 99) discovery.keep_up();
  }
  EXPECT_LT(mallinfo2().uordblks, before + 1'000'000);
  WriterId writer{};
  writer[11] = 7;
  EXPECT_EQ(discovery.origin_of(writer).identity, "ann");
}

TEST(Discovery, NothingOfSeveralThreadsIsLost) {
  Discovery discovery;
  constexpr int threads = 4, each = 500;
  std::vector<std::thread> vendors;
  for (int t = 0; t < threads; ++t)
    vendors.emplace_back([&discovery, t] {
      for (int n = 0; n < each; ++n) {
        eprosima::fastrtps::rtps::WriterProxyData data(1, 1);
        eprosima::fastrtps::rtps::GUID_t guid;
        guid.entityId.value[1] = static_cast<std::uint8_t>(t);
        guid.entityId.value[2] = static_cast<std::uint8_t>(n / 256);
        guid.entityId.value[3] = static_cast<std::uint8_t>(n % 256);
        data.guid(guid);
        discovery.on_publisher_discovery(nullptr, eprosima::fastrtps::rtps::WriterDiscoveryInfo(data));
      }
    });
  std::vector<DiscoveredWriter> writers;
  for (int look = 0; look < 100; ++look) discovery.take_changes(writers);
  for (auto& vendor : vendors) vendor.join();
  discovery.take_changes(writers);
  EXPECT_EQ(writers.size(), static_cast<std::size_t>(threads * each));
}

}  // namespace
}  // namespace trunnion::bus
