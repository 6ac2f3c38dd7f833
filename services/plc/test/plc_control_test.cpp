// SPDX-License-Identifier: Apache-2.0
// What the registers decide of the channels: inhibits, reasons, overrides; answers to orders.
#include <gtest/gtest.h>

#include "plc_core.hpp"
#include "running_core.hpp"

namespace trunnion::plc {
namespace {

struct Controlled {
  explicit Controlled(const std::string& messages = "") {
    machine::Parameters p;
    p.values[100000] = {0, "X"};
    core.configure(p, true);
    SourceFiles files = {{"main.st",
                          "PROGRAM fast\nEND_PROGRAM\nPROGRAM main\n%G2563 := %X20;\n"
                          "%G2565 := %X22;\n%G2566 := %X23;\n%G2567 := %X24;\n"
                          "message_12 := %X25.0;\nmessage_13 := %X25.1;\nmessage_255 := %X25.2;\n"
                          "start_inhibit_3 := %X25.3;\nEND_PROGRAM\n"}};
    if (!messages.empty()) files.push_back({"messages.yaml", messages});
    core.load(translate(files, true));
  }
  void input(std::uint32_t address, std::uint32_t value) {
    request(idl::plc::PanelRequestKind::FORCE_INPUT, address, value);
  }
  void request(idl::plc::PanelRequestKind kind, std::uint32_t address, std::uint32_t value) {
    idl::plc::PanelRequest request;
    request.kind = kind, request.address = address, request.value = value;
    EXPECT_EQ(core.panel(request), "");
    core.advance(tick += 10);
  }
  std::int32_t value(const std::string& name, std::size_t channel) {
    return load(core.memory().registers, interface_address(name, channel));
  }
  PlcCore core;
  std::uint64_t tick = 100;
};

TEST(PlcControl, NothingIsSaidOfChannelsOfWhichTheProgramsDecideNothing) {
  Controlled plc;
  plc.input(25, 0);
  EXPECT_TRUE(plc.core.outputs().channels.empty());
  plc.input(25, 8);
  const auto channels = plc.core.outputs().channels;
  ASSERT_EQ(channels.size(), 4u);
  EXPECT_FALSE(channels[0].start_inhibit);
  EXPECT_FALSE(channels[2].sets_overrides);
  EXPECT_TRUE(channels[3].start_inhibit);
  EXPECT_EQ(channels[3].reason, "");
}

TEST(PlcControl, AStopOfATapIsThatOfItsRegister) {
  Controlled plc;
  plc.input(20, 16);  // bit 4
  const auto channels = plc.core.outputs().channels;
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_TRUE(channels[0].tap_stop);
  EXPECT_FALSE(channels[0].start_inhibit);
  plc.input(20, 0);
  EXPECT_TRUE(plc.core.outputs().channels.empty());
}

TEST(PlcControl, InhibitsAndOverridesAreThoseOfTheRegistersWithinTheirLimits) {
  Controlled plc;
  plc.input(20, 3);
  EXPECT_TRUE(plc.core.outputs().channels.at(0).start_inhibit);
  EXPECT_TRUE(plc.core.outputs().channels.at(0).manual_inhibit);
  EXPECT_FALSE(plc.core.outputs().channels.at(0).sets_overrides);
  plc.input(20, 4), plc.input(22, 85), plc.input(23, 25), plc.input(24, 110);
  auto control = plc.core.outputs().channels.at(0);
  EXPECT_FALSE(control.start_inhibit);
  EXPECT_EQ(control.feed_override, 0.85);
  EXPECT_EQ(control.rapid_override, 0.25);
  EXPECT_EQ(control.spindle_override, 1.1);
  plc.input(22, 200), plc.input(23, 200), plc.input(24, 0);
  control = plc.core.outputs().channels.at(0);
  EXPECT_EQ(control.feed_override, 1.5);
  EXPECT_EQ(control.rapid_override, 1);
  EXPECT_EQ(control.spindle_override, 0.5);
}

TEST(PlcControl, AMessageInhibitsAndIsTheReason) {
  Controlled plc(
      "12: {text: \"the door is open, close it\", inhibits: [start], channel: 0}\n"
      "13: {text: no air, inhibits: [manual]}\n255: {text: oil}\n");
  plc.input(25, 1);
  auto channels = plc.core.outputs().channels;
  ASSERT_EQ(channels.size(), 1u) << "of channel 0 only";
  EXPECT_TRUE(channels[0].start_inhibit);
  EXPECT_FALSE(channels[0].manual_inhibit);
  EXPECT_EQ(channels[0].reason, "the door is open, close it (message 12)");
  EXPECT_TRUE(plc.core.shows_message(12));
  plc.input(25, 7);
  channels = plc.core.outputs().channels;
  ASSERT_EQ(channels.size(), 8u);
  EXPECT_EQ(channels[0].reason, "the door is open, close it (message 12); no air (message 13)");
  EXPECT_TRUE(channels[0].manual_inhibit);
  EXPECT_EQ(channels[7].reason, "no air (message 13)");
  EXPECT_FALSE(channels[7].start_inhibit);
  EXPECT_TRUE(plc.core.shows_message(255));
  plc.input(25, 4);
  EXPECT_TRUE(plc.core.outputs().channels.empty()) << "a message that only informs inhibits nothing";
}

TEST(PlcControl, ALongReasonIsCutBetweenCharacters) {
  std::string text;
  for (int i = 0; i < 70; ++i) text += "ü";  // 140 bytes
  Controlled plc("12: {text: " + text + ", inhibits: [start]}\n13: {text: " + text +
                 ", inhibits: [start]}\n");
  plc.input(25, 3);
  const auto reason = plc.core.outputs().channels.at(0).reason;
  // 140 + 13 for " (message 12)" + 2 for "; ": with the mark of four bytes no character of the second one
  // fits into 160.
  EXPECT_EQ(reason, text + " (message 12); ...");
}

TEST(PlcControl, TheAnswerToAnOrderIsShownUntilTheNextOneIsAccepted) {
  Controlled plc;
  plc.request(idl::plc::PanelRequestKind::CHANNEL_ANSWER, 1, 40123);
  EXPECT_EQ(plc.value("order_refused", 1), 1);
  EXPECT_EQ(plc.value("order_alarm", 1), 40123);
  EXPECT_EQ(plc.value("order_refused", 0), 0);
  plc.request(idl::plc::PanelRequestKind::CHANNEL_ANSWER, 1, 0);
  EXPECT_EQ(plc.value("order_refused", 1), 0);
  EXPECT_EQ(plc.value("order_alarm", 1), 40123) << "of the last refusal";
  idl::plc::PanelRequest request;
  request.kind = idl::plc::PanelRequestKind::CHANNEL_ANSWER;
  request.address = 8;
  EXPECT_EQ(plc.core.panel(request), "there is no channel 8");
  request.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
  request.address = 512;
  EXPECT_EQ(plc.core.panel(request), "input byte 512 is outside 0 .. 511");
}

struct Counted {
  Counted()
      : plc("PROGRAM main\n"
            "VAR before : BOOL; presses : UDINT; stops : UDINT; button : BOOL; END_VAR\n"
            "IF %X20.3 AND NOT before THEN presses := presses + 1; END_IF; before := %X20.3;\n"
            "IF %X0.0 AND NOT button THEN stops := stops + 1; END_IF; button := %X0.0;\n"
            "END_PROGRAM\n") {}
  void panel(idl::plc::PanelRequestKind kind) {
    idl::plc::PanelRequest request;
    request.kind = kind, request.client = 7, request.number = ++number;
    EXPECT_EQ(plc.core.panel(request), "");
  }
  Running plc;
  std::uint64_t number = 0;
};

TEST(PlcControl, EveryChangeOfAKeyIsSeenByThePrograms) {
  Counted counted;
  auto& plc = counted.plc;
  // All within one scan: press, release, press, release.
  for (const std::uint32_t value : {8u, 0u, 8u, 0u}) plc.input(20, value);
  plc.pass(1);
  EXPECT_EQ(plc.value("main.presses"), "2");
  // Another key of the same byte in between, and another byte.
  for (const std::uint32_t value : {8u, 9u, 1u, 9u}) plc.input(20, value), plc.input(21, value);
  plc.pass(1);
  EXPECT_EQ(plc.value("main.presses"), "4");
  EXPECT_EQ(plc.core.memory().registers.x[20], 9);
  EXPECT_EQ(plc.core.memory().registers.x[21], 9);
}

TEST(PlcControl, ChangesOfOneByteTakeNoTime) {
  Counted counted;
  auto& plc = counted.plc;
  const auto tick = plc.core.memory().tick, scans = plc.core.memory().scans;
  for (int i = 0; i < 1000; ++i) plc.input(20, i % 2 == 0 ? 8 : 0);
  EXPECT_EQ(plc.core.memory().tick, tick);
  EXPECT_EQ(plc.core.memory().scans, scans);
  plc.pass(1);
  EXPECT_EQ(plc.value("main.presses"), "500");
}

TEST(PlcControl, TheEmergencyStopIsSeenAlsoWhenItIsReleasedWithinTheSameScan) {
  Counted counted;
  counted.panel(idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);
  counted.panel(idl::plc::PanelRequestKind::RELEASE_EMERGENCY_STOP);
  counted.plc.pass(1);
  EXPECT_EQ(counted.plc.value("main.stops"), "1");
}

}  // namespace
}  // namespace trunnion::plc
