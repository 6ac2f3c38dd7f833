// SPDX-License-Identifier: Apache-2.0
// From registers before and after a scan to requests: keys, held jog keys, the handwheel.
#include "panel_orders.hpp"

#include <gtest/gtest.h>

#include <random>

#include "address.hpp"

namespace trunnion::plc {
namespace {

using idl::channel::CommandKind;
using idl::channel::Mode;

// Channel 0 with the axes 0, 1, 2 and 5; jog speeds 3000 and so on; a jog lasts 0.25 s.
struct Panel {
  Panel() {
    JogLimits limits;
    limits.speed = {3000, 3000, 2000, 0, 0, 900};
    limits.renewal_us.fill(250000);
    orders.configure(limits);
    orders.set_axes(0, {0, 1, 2, 5});
    orders.begin(registers);
  }
  void set(const std::string& name, std::size_t index, std::int64_t value) {
    store(registers, interface_address(name, index), value);
  }
  /// A scan one millisecond later.
  void scan() { orders.after_scan(registers, now += 1000); }
  /// Everything that is ordered now; each is accepted.
  std::vector<ChannelRequest> all(std::size_t channel = 0) {
    std::vector<ChannelRequest> result;
    while (auto request = orders.take(channel, now)) {
      result.push_back(*request);
      orders.answered(*request, true);
    }
    return result;
  }
  std::vector<CommandKind> kinds(std::size_t channel = 0) {
    std::vector<CommandKind> result;
    for (const auto& request : all(channel)) result.push_back(request.command);
    return result;
  }
  /// Sets the bit for a scan and takes what it orders.
  std::vector<ChannelRequest> press(const std::string& name, std::size_t index = 0) {
    set(name, index, 1);
    scan();
    auto result = all();
    set(name, index, 0);
    scan();
    return result;
  }
  Registers registers;
  PanelOrders orders{100};
  std::uint64_t now = 0;
};

using Kinds = std::vector<CommandKind>;

TEST(PanelOrders, AKeyOrdersOnceAtItsRisingEdge) {
  Panel panel;
  const struct {
    const char* key;
    CommandKind command;
    Mode mode;
  } keys[] = {{"order_auto", CommandKind::SET_MODE, Mode::AUTO},
              {"order_mdi", CommandKind::SET_MODE, Mode::MDI},
              {"order_jog", CommandKind::SET_MODE, Mode::JOG},
              {"order_ref", CommandKind::SET_MODE, Mode::REF},
              {"order_start", CommandKind::CYCLE_START, {}},
              {"order_hold", CommandKind::FEED_HOLD, {}},
              {"order_reset", CommandKind::RESET, {}}};
  for (const auto& [key, command, mode] : keys) {
    panel.set(key, 0, 1);
    panel.scan();
    const auto orders = panel.all();
    ASSERT_EQ(orders.size(), 1u) << key;
    EXPECT_EQ(orders[0].command, command) << key;
    EXPECT_EQ(orders[0].mode, mode) << key;
    EXPECT_EQ(orders[0].channel, 0);
    for (int i = 0; i < 1000; ++i) panel.scan();
    EXPECT_TRUE(panel.all().empty()) << key;
    panel.set(key, 0, 0);
    panel.scan();
    EXPECT_TRUE(panel.all().empty()) << key;
  }
}

TEST(PanelOrders, SwitchesAreOrderedWhenTheyChange) {
  Panel panel;
  for (const auto& [name, command] : {std::pair{"order_single_block", CommandKind::SINGLE_BLOCK},
                                      {"order_optional_stop", CommandKind::OPTIONAL_STOP},
                                      {"order_dry_run", CommandKind::DRY_RUN}})
    for (const bool on : {true, false}) {
      panel.set(name, 0, on);
      panel.scan();
      const auto orders = panel.all();
      ASSERT_EQ(orders.size(), 1u) << name;
      EXPECT_EQ(orders[0].command, command);
      EXPECT_EQ(orders[0].on, on);
    }
  panel.set("order_block_skip", 0, 0b100000001);
  panel.scan();
  const auto orders = panel.all();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].command, CommandKind::BLOCK_SKIP);
  EXPECT_EQ(orders[0].levels, 0b100000001);
}

TEST(PanelOrders, WhatIsHeldAtTheBeginningOrdersNothingBeforeItWasReleased) {
  Panel panel;
  panel.set("order_start", 0, 1), panel.set("jog_plus", 1, 1), panel.set("order_single_block", 0, 1);
  panel.set("handwheel_axis", 0, 1), panel.set("handwheel_counter", 0, 700);
  panel.orders.begin(panel.registers);
  for (int i = 0; i < 1000; ++i) panel.scan();
  EXPECT_TRUE(panel.all().empty());
  panel.set("order_start", 0, 0), panel.set("jog_plus", 1, 0);
  panel.scan();
  EXPECT_TRUE(panel.all().empty()) << "no stop either: the jog was another process'";
  EXPECT_EQ(panel.press("order_start").size(), 1u);
}

TEST(PanelOrders, AHeldJogKeyIsRenewedWithItsPressAndStopsWithIt) {
  Panel panel;
  panel.set("jog_feed", 0, 1200);
  panel.set("jog_minus", 5, 1);  // the fourth axis of the channel
  panel.scan();
  auto orders = panel.all();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].command, CommandKind::JOG_AXIS);
  EXPECT_EQ(orders[0].axis, 3);
  EXPECT_EQ(orders[0].speed, -900) << "the axis is not faster";
  EXPECT_EQ(orders[0].increment, 0);
  const auto press = orders[0].press;
  EXPECT_NE(press, 0u);
  // Every 62.5 ms, a quarter of 0.25 s; in 1000 scans of 1 ms at each 63rd: 15 times.
  int renewals = 0;
  for (int i = 0; i < 1000; ++i) {
    panel.scan();
    for (const auto& request : panel.all()) {
      EXPECT_EQ(request.command, CommandKind::JOG_RENEW);
      EXPECT_EQ(request.press, press);
      ++renewals;
    }
  }
  EXPECT_EQ(renewals, 15);
  panel.set("jog_minus", 5, 0);
  panel.scan();
  EXPECT_EQ(panel.kinds(), Kinds{CommandKind::JOG_STOP});
  for (int i = 0; i < 1000; ++i) panel.scan();
  EXPECT_TRUE(panel.all().empty());
  EXPECT_NE(panel.press("jog_minus", 5).at(0).press, press) << "another press has another number";
}

TEST(PanelOrders, TheRapidKeyGivesTheSpeedOfTheAxisAndAnIncrementEndsByItself) {
  Panel panel;
  panel.set("jog_feed", 0, 500), panel.set("jog_rapid", 0, 1), panel.set("jog_increment", 0, 10);
  panel.set("jog_plus", 2, 1);
  panel.scan();
  const auto orders = panel.all();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].speed, 2000);
  EXPECT_EQ(orders[0].increment, 0.01) << "10 um";
  for (int i = 0; i < 1000; ++i) panel.scan();
  EXPECT_TRUE(panel.all().empty()) << "an increment is not renewed";
  panel.set("jog_plus", 2, 0);
  panel.scan();
  EXPECT_TRUE(panel.all().empty()) << "and goes to its end without the key";
}

TEST(PanelOrders, BothDirectionsAnInhibitOrARefusalEndTheJog) {
  Panel panel;
  panel.set("jog_feed", 0, 500);
  const auto begin = [&] {
    panel.set("jog_plus", 0, 1);
    panel.scan();
    return panel.kinds() == Kinds{CommandKind::JOG_AXIS};
  };
  ASSERT_TRUE(begin());
  panel.set("jog_minus", 0, 1);
  panel.scan();
  EXPECT_EQ(panel.kinds(), Kinds{CommandKind::JOG_STOP});
  panel.set("jog_minus", 0, 0);
  panel.scan();
  EXPECT_TRUE(panel.all().empty()) << "the key that is still held is no new press";
  panel.set("jog_plus", 0, 0);
  panel.scan();
  ASSERT_TRUE(begin());
  panel.set("jog_plus_inhibit", 0, 1);
  panel.scan();
  EXPECT_EQ(panel.kinds(), Kinds{CommandKind::JOG_STOP});
  panel.set("jog_plus", 0, 0);
  panel.scan();
  EXPECT_TRUE(panel.press("jog_plus").empty()) << "inhibited";
  EXPECT_EQ(panel.press("jog_minus").size(), 1u) << "the other direction is free";
  panel.set("jog_plus_inhibit", 0, 0);
  panel.scan();
  panel.all();
  panel.set("jog_plus", 0, 1);
  panel.scan();
  const auto request = panel.orders.take(0, panel.now);
  ASSERT_TRUE(request);
  panel.orders.answered(*request, false);
  for (int i = 0; i < 1000; ++i) panel.scan();
  panel.set("jog_plus", 0, 0);
  panel.scan();
  EXPECT_TRUE(panel.all().empty()) << "nothing moves: nothing is renewed or stopped";
}

TEST(PanelOrders, AStopComesFirstAndEndsWhatWaits) {
  Panel panel;
  panel.set("jog_feed", 0, 500), panel.set("handwheel_axis", 0, 1), panel.set("handwheel_increment", 0, 1);
  panel.scan();
  panel.set("order_jog", 0, 1), panel.set("order_start", 0, 1), panel.set("jog_plus", 0, 1);
  panel.set("handwheel_counter", 0, 5), panel.set("order_reference", 1, 1);
  panel.scan();
  panel.set("order_hold", 0, 1);
  panel.scan();
  EXPECT_EQ(panel.kinds(), (Kinds{CommandKind::FEED_HOLD, CommandKind::SET_MODE}));
  panel.set("order_start", 0, 0), panel.set("order_hold", 0, 0);
  panel.scan();
  panel.set("order_start", 0, 1), panel.set("order_reset", 0, 1);
  panel.scan();
  EXPECT_EQ(panel.kinds(), Kinds{CommandKind::RESET}) << "start and reset in one scan: only the reset";
  panel.set("order_start", 0, 0), panel.set("jog_plus", 0, 0), panel.set("order_reference", 1, 0);
  panel.set("order_reset", 0, 0);
  panel.scan();
  panel.all();
  EXPECT_EQ(panel.press("order_reference", 1).at(0).axis, 1);
}

TEST(PanelOrders, EveryCountOfTheHandwheelIsOrderedOnceThroughWrapsAndChangesOfAxis) {
  // Counts of each axis and increment, at random, against their sum.
  Panel panel;
  std::mt19937 random(1);
  std::map<std::pair<int, double>, std::int64_t> expected, ordered;
  int axis = 1, increment = 10;
  std::uint16_t counter = 65530;
  panel.set("handwheel_counter", 0, counter);
  panel.set("handwheel_axis", 0, axis), panel.set("handwheel_increment", 0, increment);
  panel.orders.begin(panel.registers);
  for (int i = 0; i < 20000; ++i) {
    if (random() % 50 == 0) axis = static_cast<int>(random() % 4) + 1;
    if (random() % 50 == 0) increment = std::array{1, 10, 100, 1000}[random() % 4];
    const auto by = static_cast<int>(random() % 4001) - 1000;  // mostly forwards: it wraps
    counter = static_cast<std::uint16_t>(counter + by);
    panel.set("handwheel_counter", 0, counter);
    panel.set("handwheel_axis", 0, axis), panel.set("handwheel_increment", 0, increment);
    panel.scan();
    expected[{axis - 1, increment / 1000.0}] += by;
    if (random() % 8 == 0)
      for (const auto& request : panel.all()) {
        ASSERT_EQ(request.command, CommandKind::HANDWHEEL);
        ASSERT_LE(std::abs(request.counts), 10000);
        ordered[{request.axis, request.increment}] += request.counts;
      }
  }
  for (const auto& request : panel.all()) ordered[{request.axis, request.increment}] += request.counts;
  EXPECT_EQ(ordered, expected);
  panel.set("handwheel_axis", 0, 0);
  panel.set("handwheel_counter", 0, counter + 100);
  panel.scan();
  EXPECT_TRUE(panel.all().empty()) << "no axis is selected";
}

TEST(PanelOrders, AChannelThatDoesNotAnswerGetsNoOldOrders) {
  Panel panel;
  panel.set("order_start", 0, 1), panel.set("handwheel_axis", 0, 1), panel.set("handwheel_counter", 0, 9);
  panel.scan();
  panel.orders.drop(0);
  EXPECT_TRUE(panel.all().empty());
}

TEST(PanelOrders, EachChannelHasItsKeysAndAnAxisThoseOfItsChannel) {
  Panel panel;
  panel.orders.set_axes(1, {7});
  panel.set("jog_feed", 1, 60);
  JogLimits limits;
  limits.speed.fill(1000);
  limits.renewal_us.fill(250000);
  panel.orders.configure(limits);
  panel.set("order_start", 1, 1), panel.set("jog_plus", 7, 1), panel.set("order_start", 2, 1);
  panel.scan();
  EXPECT_TRUE(panel.all(0).empty());
  EXPECT_EQ(panel.kinds(1), (Kinds{CommandKind::CYCLE_START, CommandKind::JOG_AXIS}));
  EXPECT_TRUE(panel.all(2).empty()) << "there is no channel 2";
}

}  // namespace
}  // namespace trunnion::plc
