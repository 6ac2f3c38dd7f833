// SPDX-License-Identifier: Apache-2.0
// Every pair of vendors in one process, each test in a domain of its own.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <thread>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::bus {
namespace {

using testing_support::eventually;

struct Pair {
  Vendor writer, reader;
  std::uint32_t domain;
};

class BusOverVendors : public testing::TestWithParam<Pair> {};

TEST_P(BusOverVendors, KeyedStateReachesALateJoinerWithTheNewestOfEachKey) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain}), b(to, {domain});
  auto writer = a.writer(topics::stream_request);
  for (std::uint16_t channel = 0; channel < 3; ++channel)
    for (std::uint32_t request = 1; request <= 4; ++request)
      writer.write({channel, request, idl::stream::StreamRequestKind::START, 0});
  auto reader = b.reader(topics::stream_request);
  std::vector<int> newest(3);
  EXPECT_TRUE(eventually([&] {
    idl::stream::StreamRequest request;
    while (reader.take(request)) newest[request.channel] = static_cast<int>(request.request);
    return newest == std::vector<int>{4, 4, 4};
  }));
}

TEST_P(BusOverVendors, BatchesArriveInOrderAndHistoryIsAsDeepAsAsked) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain + 4}, {16}), b(to, {domain + 4});
  auto writer = a.writer(topics::gantry_batch);
  idl::stream::AxisBatch batch;
  for (batch.first = 1; batch.first <= 40; ++batch.first) writer.write(batch);
  auto reader = b.reader(topics::gantry_batch);
  std::vector<std::uint64_t> seen;
  const auto drain = [&] {
    idl::stream::AxisBatch in;
    while (reader.take(in)) seen.push_back(in.first);
    return !seen.empty() && seen.back() == batch.first - 1;
  };
  ASSERT_TRUE(eventually(drain));
  EXPECT_EQ(seen.size(), 16u) << "the writer keeps its last 16";
  for (; batch.first <= 200; ++batch.first) writer.write(batch);
  ASSERT_TRUE(eventually(drain));
  ASSERT_EQ(seen.size(), 176u);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], 25 + i);
}

TEST_P(BusOverVendors, AnotherContractDoesNotMatch) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain + 8}), b(to, {domain + 8});
  auto other = topics::alarm;
  other.wire_type = "trunnion::service::Alarm_00000000";
  auto stranger = a.writer(other);
  auto writer = a.backend().writer(describe(topics::cluster), {true, 1});
  auto reader = b.reader(topics::alarm);
  auto known = b.reader(topics::cluster);
  ASSERT_TRUE(eventually([&] { return known.matched() == 1; })) << "discovery of the pair that does match";
  EXPECT_EQ(reader.matched(), 0);
}

TEST_P(BusOverVendors, ASampleOf60KilobytesIsDelivered) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain + 12}), b(to, {domain + 12});
  auto writer = a.writer(topics::program_reply);
  auto reader = b.reader(topics::program_reply);
  idl::program::ProgramReply reply, in;
  for (int i = 0; i < 60000; ++i) reply.data.push_back(static_cast<std::uint8_t>(i * 7));
  writer.write(reply);
  ASSERT_TRUE(eventually([&] { return reader.take(in); }));
  EXPECT_EQ(in, reply);
}

// The participant lives on, so no lease ends the match: only the word that the reader is gone does.
TEST_P(BusOverVendors, AWriterHearsThatAReaderHasLeft) {
  const auto [from, to, domain] = GetParam();
  Bus a(from, {domain + 16}), b(to, {domain + 16});
  auto writer = a.backend().writer(describe(topics::gantry_batch), {true, 16});
  auto reader = std::make_unique<Reader<idl::stream::AxisBatch>>(b.reader(topics::gantry_batch));
  ASSERT_TRUE(eventually([&] { return writer->matched() == 1; }));
  reader.reset();
  EXPECT_TRUE(eventually([&] { return writer->matched() == 0; }));
}

TEST_P(BusOverVendors, ARefusedMessageNamesTheProcessThatHasWrittenIt) {
  const auto [from, to, domain] = GetParam();
  NetworkSettings network{domain + 20};
  Bus b(to, network);
  network.identity = "stranger";
  Bus a(from, network);
  auto writer = a.writer(topics::gantry_batch);
  auto reader = b.reader(topics::gantry_batch);
  idl::stream::AxisBatch batch, taken;
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), 0.0}) {
    batch.setpoints = {value};
    writer.write(batch);
  }
  ASSERT_TRUE(eventually([&] { return reader.take(taken); }));
  const auto& refusals = b.refusals().at(topics::gantry_batch.name);
  EXPECT_EQ(refusals.count, 1u);
  EXPECT_EQ(refusals.writer.find("process " + std::to_string(getpid())), 0u) << refusals.writer;
  EXPECT_NE(refusals.writer.find(" on host "), std::string::npos) << refusals.writer;
  EXPECT_NE(refusals.writer.find("which says it is stranger"), std::string::npos) << refusals.writer;
  b.refusals_told();
  EXPECT_EQ(refusals.writer, "");
  EXPECT_EQ(refusals.count, 1u);
}

INSTANTIATE_TEST_SUITE_P(Vendors, BusOverVendors,
                         testing::Values(Pair{Vendor::cyclonedds, Vendor::cyclonedds, 20},
                                         Pair{Vendor::fastdds, Vendor::fastdds, 21},
                                         Pair{Vendor::cyclonedds, Vendor::fastdds, 22},
                                         Pair{Vendor::fastdds, Vendor::cyclonedds, 23}),
                         [](const auto& vendors) {
                           return std::string(to_string(vendors.param.writer)) + "_to_" +
                                  to_string(vendors.param.reader);
                         });

/// The local addresses of the UDP sockets of this process, as /proc/net/udp writes them.
std::vector<std::string> udp_addresses() {
  std::set<std::string> inodes;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    const auto target = std::filesystem::read_symlink(entry.path(), gone).string();
    if (target.starts_with("socket:[")) inodes.insert(target.substr(8, target.size() - 9));
  }
  std::vector<std::string> addresses;
  std::ifstream table("/proc/net/udp");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string field, local, inode;
    for (int i = 0; i < 10 && fields >> field; ++i) {
      if (i == 1) local = field;
      if (i == 9) inode = field;
    }
    if (inodes.contains(inode)) addresses.push_back(local.substr(0, local.find(':')));
  }
  return addresses;
}

TEST(Bus, AnUnsecuredDomainOfOneHostIsNotReachableFromOthers) {
  const Bus cyclone(Vendor::cyclonedds, {77}), fast(Vendor::fastdds, {77});
  const auto addresses = udp_addresses();
  EXPECT_GE(addresses.size(), 4u) << "each vendor receives discovery and data";
  for (const auto& address : addresses) EXPECT_EQ(address, "0100007F") << "127.0.0.1, the lowest byte first";
}

TEST(Bus, WhatIsOpenedIsLoggedWithItsIdentityWhenAskedFor) {
  const auto file =
      std::filesystem::temp_directory_path() / ("trunnion-endpoints-" + std::to_string(getpid()));
  setenv("TRUNNION_ENDPOINTS", file.c_str(), 1);
  for (const auto vendor : {Vendor::cyclonedds, Vendor::fastdds}) {
    NetworkSettings network{77};
    network.identity = to_string(vendor);
    Bus bus(vendor, network);
    bus.writer(topics::alarm);
    bus.reader(topics::feedback);
  }
  unsetenv("TRUNNION_ENDPOINTS");
  {
    Bus bus(Vendor::cyclonedds, {77});
    bus.reader(topics::alarm);
  }
  std::ostringstream logged;
  logged << std::ifstream(file).rdbuf();
  std::string expected;
  for (const std::string vendor : {"cyclonedds", "fastdds"})
    expected +=
        vendor + " writes " + topics::alarm.name + "\n" + vendor + " reads " + topics::feedback.name + "\n";
  EXPECT_EQ(logged.str(), expected);
  std::filesystem::remove(file);
  setenv("TRUNNION_ENDPOINTS", "/nowhere/endpoints", 1);
  Bus bus(Vendor::cyclonedds, {77});
  EXPECT_THROW(bus.reader(topics::alarm), std::runtime_error);
  unsetenv("TRUNNION_ENDPOINTS");
}

}  // namespace
}  // namespace trunnion::bus
