// SPDX-License-Identifier: Apache-2.0
#include "bus/writer_origin.hpp"

#include <gtest/gtest.h>

#include "bus/bus.hpp"

namespace trunnion::bus {
namespace {

TEST(WriterOrigin, IsReadFromThePropertiesOfEitherVendor) {
  WriterOrigin cyclone;
  take_property(cyclone, "__Hostname", "mill");
  take_property(cyclone, "__ProcessName", "trunnion-plc");
  take_property(cyclone, "__Pid", "4711");
  take_property(cyclone, "__NetworkAddresses", "udp/10.77.0.3:7413@2,udp/10.78.0.3:7413@3");
  take_property(cyclone, "__Other", "no");
  EXPECT_EQ(to_text(cyclone), "process 4711 (trunnion-plc) on host mill, 10.77.0.3:7413");
  WriterOrigin fast;
  take_property(fast, "fastdds.physical_data.host", "mill");
  take_property(fast, "fastdds.physical_data.process", "4712");
  fast.identity = "gateway";
  EXPECT_EQ(to_text(fast), "process 4712 on host mill, which says it is gateway");
}

TEST(WriterOrigin, OfAProcessThatTellsNothingIsItsGuid) {
  const std::uint8_t guid[] = {1, 15, 0xab, 0, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 1, 2};
  WriterOrigin origin;
  EXPECT_EQ(to_text(origin), "a writer that has left");
  origin.participant = prefix_text(guid);
  EXPECT_EQ(to_text(origin), "a process, GUID prefix 010fab0005060708090a0b0c");
  origin.address = "10.77.0.9:7410";
  EXPECT_EQ(to_text(origin), "a process, 10.77.0.9:7410, GUID prefix 010fab0005060708090a0b0c");
}

TEST(WriterOrigin, OfAStrangerIsShortAndPrintable) {
  WriterOrigin origin;
  origin.pid = "1\n2", origin.host = std::string(500, 'h'), origin.process = "\xff";
  EXPECT_EQ(to_text(origin), "process 1?2 (?) on host " + std::string(40, 'h'));
}

// 250 characters of an alarm, less "compensation refused 4294967296 of trunnion/compensation/axis_batch/1
// from " (75) and ", the newest: " (14), leave 161: the 120 of a writer and 41 for the field and its value.
TEST(WriterOrigin, OfAStrangerLeavesRoomForTheFieldInAnAlarm) {
  const std::string lengthy(500, 'x');
  WriterOrigin origin{.identity = lengthy,
                      .host = lengthy,
                      .process = lengthy,
                      .pid = lengthy,
                      .address = lengthy,
                      .participant = lengthy};
  EXPECT_EQ(to_text(origin).size(), 120u);
  origin = {.identity = "compensation",
            .host = "mill-control",
            .process = "trunnion-compensation",
            .pid = "4194304",
            .address = "10.77.0.123:65535",
            .participant = lengthy};
  EXPECT_EQ(to_text(origin).substr(to_text(origin).size() - 12), "compensation") << "an honest one is whole";
}

/// Knows the process of every writer but 9.
class CountingBackend : public Backend {
 public:
  std::unique_ptr<RawWriter> writer(const TopicDescription&, const EndpointQos&) override { return nullptr; }
  std::unique_ptr<RawReader> reader(const TopicDescription&, const EndpointQos&, Signal*) override {
    return nullptr;
  }
  bool discover(std::vector<DiscoveredWriter>&) override { return false; }
  WriterOrigin origin_of(const WriterId& writer) override {
    ++asked;
    WriterOrigin origin;
    if (writer[0] != 9) origin.pid = std::to_string(writer[0]);
    return origin;
  }
  int asked = 0;
};

TEST(WriterOrigin, IsAskedForOnceOfAWriterThatFloodsATopicAndAgainWhileItIsNotKnown) {
  CountingBackend backend;
  Refusals refusals;
  refusals.backend = &backend;
  const auto flood = [&](std::uint8_t writer) {
    for (int beat = 0; beat < 3; ++beat) {
      refusals.writer.clear();  // told
      for (int message = 0; message < 100; ++message) refusals.add("count: 0", WriterId{writer});
    }
    return refusals.writer;
  };
  EXPECT_EQ(flood(1), "process 1");
  EXPECT_EQ(backend.asked, 1);
  EXPECT_EQ(flood(2), "process 2");
  EXPECT_EQ(backend.asked, 2);
  EXPECT_EQ(flood(9), "a writer that has left");
  EXPECT_EQ(backend.asked, 2 + 3) << "once in each of the three beats";
  EXPECT_EQ(refusals.count, 900u);
}

}  // namespace
}  // namespace trunnion::bus
