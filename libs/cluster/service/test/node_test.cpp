// SPDX-License-Identifier: Apache-2.0
#include "service/node.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>

#include "bus/contract.hpp"
#include "machine/alarm_constants.hpp"
#include "testing_support/eventually.hpp"
#include "trunnion/version.hpp"

namespace trunnion::service {
namespace {

using testing_support::eventually;

Options options_of(const std::string& service, std::uint32_t channel = 0) {
  Options options;
  options.service = service;
  options.instance = 3;
  options.channel = channel;
  options.network.domain = 67;
  return options;
}

/// Axis 4 moves with channel 1.
class TestService : public Service {
 public:
  void pump() override {
    ++pumps;
    if (on_pump) on_pump();
  }
  double period() const override { return 0.005; }
  Health health() const override {
    Health health;
    health.lifecycle = idl::service::Lifecycle::ACTIVE;
    return health;
  }
  void alarms_reset(std::uint16_t channel) override { resets.push_back(channel); }
  bool axis_concerns(std::uint16_t axis, std::uint16_t channel) const override {
    return axis == 4 && channel == 1;
  }
  void end() override { ended = true; }

  std::function<void()> on_pump;
  std::vector<std::uint16_t> resets;
  int pumps = 0;
  bool ended = false;
};

void raise_and_release(AlarmBoard& board, const machine::AlarmDefinition& alarm, std::uint32_t part) {
  board.raise(alarm, part, "text");
  board.release(alarm, part);
}

TEST(Node, AResetOfOneChannelClearsWhatConcernsItAndNothingElse) {
  Node node(options_of("drive"));
  TestService service;
  auto& board = node.alarms();
  raise_and_release(board, alarm::revision_unknown, 0);
  raise_and_release(board, alarm::revision_unknown, 1);
  raise_and_release(board, alarm::following_error, 1);  // axis 1 is of another channel
  raise_and_release(board, alarm::following_error, 4);
  raise_and_release(board, alarm::setpoint_missing, 1);  // of the machine, whatever its part
  node.reset_alarms(service, 1);
  EXPECT_EQ(service.resets, std::vector<std::uint16_t>{1});
  EXPECT_TRUE(board.active(alarm::revision_unknown, 0));
  EXPECT_FALSE(board.active(alarm::revision_unknown, 1));
  EXPECT_TRUE(board.active(alarm::following_error, 1));
  EXPECT_FALSE(board.active(alarm::following_error, 4));
  EXPECT_TRUE(board.active(alarm::setpoint_missing, 1));
  node.reset_alarms(service, all_channels);
  EXPECT_FALSE(board.any());
}

TEST(Node, TheProcessOfAChannelHasOnlyAlarmsOfThatChannel) {
  Node node(options_of("channel", 1));
  TestService service;
  raise_and_release(node.alarms(), alarm::storage_failed, 1);
  raise_and_release(node.alarms(), alarm::redundancy_lost, 17);  // part: a replica of a stage
  node.reset_alarms(service, 0);
  EXPECT_TRUE(service.resets.empty());
  EXPECT_TRUE(node.alarms().active(alarm::storage_failed, 1));
  node.reset_alarms(service, 1);
  EXPECT_EQ(service.resets, std::vector<std::uint16_t>{1});
  EXPECT_FALSE(node.alarms().any());
}

TEST(Node, AnnouncesItsContractAndTheVersionOfTheProject) {
  Node node(options_of("drive"));
  auto reader = node.bus().reader(topics::announcement);
  idl::service::Announcement announcement;
  ASSERT_TRUE(eventually([&] { return reader.take(announcement); }));
  EXPECT_EQ(announcement.service, "drive");
  EXPECT_EQ(announcement.instance, 3u);
  EXPECT_EQ(announcement.contract, bus::contract_of("drive"));
  EXPECT_EQ(announcement.version, version);
}

TEST(Node, TheAlarmOfARefusedMessageNamesTopicWriterAndField) {
  Node node(options_of("drive"));
  TestService service;
  bus::NetworkSettings network{67};
  network.identity = "stranger";
  bus::Bus stranger(bus::Vendor::cyclonedds, network);
  auto writer = stranger.writer(topics::gantry_batch);
  auto reader = node.bus().reader(topics::gantry_batch);
  auto alarms = node.bus().reader(topics::alarm);
  idl::stream::AxisBatch batch;
  batch.setpoints = {std::numeric_limits<double>::quiet_NaN()};
  writer.write(batch);
  idl::service::Alarm alarm;
  service.on_pump = [&] {
    while (reader.take(batch)) {
    }
    const bool told = alarms.take(alarm) && alarm.number == alarm::message_refused.number;
    if (told || service.pumps > 4000) raise(SIGTERM);
  };
  EXPECT_EQ(node.run(service), 0);
  EXPECT_EQ(alarm.text.find("drive refused 1 of " + std::string(topics::gantry_batch.name) +
                            " from process " + std::to_string(getpid()) + " ("),
            0u)
      << alarm.text;
  EXPECT_NE(alarm.text.find(", which says it is stranger, the newest: setpoints"), std::string::npos)
      << alarm.text;
}

TEST(Node, RunsUntilItIsToldToEndAndPassesOnTheChannelOfAReset) {
  Node node(options_of("drive"));
  TestService service;
  auto resets = node.bus().writer(topics::alarm_reset);
  auto states = node.bus().reader(topics::service_state);
  idl::service::ServiceState state;
  bool active = false;
  service.on_pump = [&] {
    if (service.pumps == 1) resets.write({1, 1, 5});
    while (states.take(state)) active = active || state.lifecycle == idl::service::Lifecycle::ACTIVE;
    if ((active && !service.resets.empty()) || service.pumps > 4000) raise(SIGTERM);
  };
  ASSERT_TRUE(eventually([&] { return resets.matched() == 1; }));
  EXPECT_EQ(node.run(service), 0);
  EXPECT_TRUE(service.ended);
  EXPECT_TRUE(active) << "a change of lifecycle is published at once";
  EXPECT_EQ(service.resets, std::vector<std::uint16_t>{5});
  EXPECT_EQ(state.service, "drive");
}

}  // namespace
}  // namespace trunnion::service
