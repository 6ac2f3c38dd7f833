// SPDX-License-Identifier: Apache-2.0
#include "plc/devices/message_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing_support/refusal.hpp"

namespace trunnion::st {
namespace {

using testing::StartsWith;

std::string message_refusal(const std::string& yaml) {
  return testing_support::refusal_of([&] { read_messages(yaml, "messages.yaml"); });
}

TEST(MessageFile, HasTextsReactionsAndWhatTheyInhibit) {
  const auto file = read_messages(
      "12: {text: the door is open, german: die Tür ist offen, inhibits: [start, manual], channel: 1}\n"
      "0: {text: oil, reaction: axis_stop}\n"
      "255: {text: air, reaction: feed_hold, inhibits: [start]}\n",
      "messages.yaml");
  ASSERT_EQ(file.size(), 3u);
  EXPECT_EQ(file.at(12).text, "the door is open");
  EXPECT_EQ(file.at(12).german, "die Tür ist offen");
  EXPECT_EQ(file.at(12).reaction, MessageReaction::show);
  EXPECT_TRUE(file.at(12).inhibits_start);
  EXPECT_TRUE(file.at(12).inhibits_manual);
  EXPECT_EQ(file.at(12).channel, 1);
  EXPECT_EQ(file.at(0).reaction, MessageReaction::axis_stop);
  EXPECT_FALSE(file.at(0).inhibits_start);
  EXPECT_EQ(file.at(255).reaction, MessageReaction::feed_hold);
  EXPECT_TRUE(file.at(255).inhibits_start);
  EXPECT_FALSE(file.at(255).inhibits_manual);
  EXPECT_FALSE(file.at(255).channel);
}

TEST(MessageFile, WhatIsWrongIsRefusedWithItsPlace) {
  const struct {
    const char* yaml;
    const char* refusal;
  } cases[] = {
      {"256: {text: a}", "messages.yaml:1:1: error: 256 is not within 0 .. 255"},
      {"-1: {text: a}", "messages.yaml:1:1: error: -1 is not within 0 .. 255"},
      {"1.5: {text: a}", "messages.yaml:1:1: error: expected a whole number"},
      {"door: {text: a}", "messages.yaml:1:1: error: 'door' is not a number"},
      {"1: {text: a}\n1: {text: b}", "messages.yaml:2:1: error: message 1 is there twice"},
      {"1: {reaction: show}", "messages.yaml:1:4: error: 'text' is missing"},
      {"1: {text: ''}", "messages.yaml:1:11: error: expected one line of text, at most 140 bytes of UTF-8"},
      {"1: {text: \"a\\nb\"}", "messages.yaml:1:11: error: expected one line"},
      {"1: {text: a, reaction: stop}",
       "messages.yaml:1:24: error: 'stop' is none of axis_stop, feed_hold, show"},
      {"1: {text: a, inhibits: start}", "messages.yaml:1:24: error: expected a list of start and manual"},
      {"1: {text: a, inhibits: [jog]}", "messages.yaml:1:25: error: 'jog' is none of manual, start"},
      {"1: {text: a, inhibits: [start], channel: 8}", "messages.yaml:1:42: error: 8 is not within 0 .. 7"},
      {"1: {text: a, channel: 0}", "messages.yaml:1:4: error: 'channel' is of 'inhibits', which is missing"},
      {"1: {text: a, part: 0}", "messages.yaml:1:14: error: unknown key 'part'"},
      {"[1]", "messages.yaml:1:1: error: expected messages by their numbers"},
  };
  for (const auto& one : cases) EXPECT_THAT(message_refusal(one.yaml), StartsWith(one.refusal)) << one.yaml;
  EXPECT_THAT(message_refusal("1: {text: " + std::string(141, 'a') + "}"),
              StartsWith("messages.yaml:1:11: error: "));
  EXPECT_EQ(message_refusal("1: {text: " + std::string(140, 'a') + "}"), "taken");
}

}  // namespace
}  // namespace trunnion::st
