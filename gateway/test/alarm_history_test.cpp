// SPDX-License-Identifier: Apache-2.0
#include "core/alarm_history.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

idl::service::Alarm alarm(std::uint32_t number, bool active = true, std::uint32_t instance = 1) {
  idl::service::Alarm made{};
  made.instance = instance;
  made.number = number;
  made.active = active;
  made.severity = idl::service::Severity::ERROR;
  made.source = "channel";
  made.text = "text of " + std::to_string(number);
  made.occurrences = 1;
  return made;
}

TEST(AlarmHistory, HasWhenAnAlarmWasRaisedAndClearedNewestFirst) {
  AlarmHistory history;
  history.apply(alarm(110), "T1");
  history.apply(alarm(140), "T2");
  history.apply(alarm(110, false), "T3");
  const auto past = *history.newest();
  ASSERT_EQ(past.size(), 2u);
  EXPECT_EQ(past[0].alarm.number, 140u);
  EXPECT_EQ(past[0].cleared, "");
  EXPECT_EQ(past[1].raised, "T1");
  EXPECT_EQ(past[1].cleared, "T3");
}

TEST(AlarmHistory, ARepetitionIsTheSameAlarmAndOneAfterItsEndIsAnother) {
  AlarmHistory history;
  history.apply(alarm(110), "T1");
  auto again = alarm(110);
  again.occurrences = 7;
  history.apply(again, "T2");
  EXPECT_EQ(history.newest()->size(), 1u);
  EXPECT_EQ(history.newest()->front().alarm.occurrences, 7u);
  EXPECT_EQ(history.newest()->front().raised, "T1");
  history.apply(alarm(110, false), "T3");
  history.apply(alarm(110, false), "T4");
  history.apply(alarm(110), "T5");
  EXPECT_EQ(history.newest()->size(), 2u);
  EXPECT_EQ(history.newest()->back().cleared, "T3") << "cleared once";
}

TEST(AlarmHistory, AnAlarmOfAProcessThatHasEndedIsCleared) {
  AlarmHistory history;
  history.apply(alarm(110), "T1");
  history.apply(alarm(140), "T1");
  history.keep([](const auto& one) { return one.number == 140; }, "T2");
  EXPECT_EQ(history.newest()->back().cleared, "T2");
  EXPECT_EQ(history.newest()->front().cleared, "");
}

TEST(AlarmHistory, IsTheSameAfterARestart) {
  AlarmHistory before;
  std::string file;
  const auto write = [&] { file += before.take_lines(); };
  before.apply(alarm(110), "T1"), write();
  before.apply(alarm(140), "T2"), write();
  before.apply(alarm(110, false), "T3"), write();
  before.apply(alarm(150), "T4"), write();
  AlarmHistory after;
  EXPECT_EQ(after.restore(file), 0u);
  ASSERT_EQ(after.newest()->size(), 3u);
  EXPECT_EQ(after.lines(), before.lines());
  // 140 is still active and is heard of again, from a process of another instance; 150 has ended meanwhile.
  after.apply(alarm(140, true, 9), "T5");
  after.keep([](const auto&) { return true; }, "T6");
  after.settle("T7");
  ASSERT_EQ(after.newest()->size(), 3u) << "no second 140";
  EXPECT_EQ(after.newest()->at(0).cleared, "T7");
  EXPECT_EQ(after.newest()->at(1).raised, "T2");
  EXPECT_EQ(after.newest()->at(1).cleared, "");
  after.apply(alarm(140, false, 9), "T8");
  EXPECT_EQ(after.newest()->at(1).cleared, "T8");
  after.apply(alarm(160), "T9");
  EXPECT_EQ(after.newest()->size(), 4u);
}

TEST(AlarmHistory, LinesThatAreDamagedAreLeftOutAndCounted) {
  AlarmHistory history;
  history.apply(alarm(110), "T1");
  history.apply(alarm(140), "T2");
  auto file = history.take_lines();
  auto beyond = file.substr(0, file.find('\n') + 1);
  beyond.replace(beyond.find("\"number\":110"), 12, "\"number\":1e56");
  file.insert(0, "no json\n{\"id\":7}\n" + beyond);
  file.resize(file.size() - 10);
  AlarmHistory after;
  EXPECT_EQ(after.restore(file), 4u);
  ASSERT_EQ(after.newest()->size(), 1u);
  EXPECT_EQ(after.newest()->front().alarm.text, "text of 110");
}

TEST(AlarmHistory, KeepsTheNewestOfMany) {
  AlarmHistory history;
  for (std::uint32_t i = 0; i < AlarmHistory::most + 10; ++i) {
    history.apply(alarm(i), "T1");
    history.apply(alarm(i, false), "T2");
  }
  EXPECT_EQ(history.newest()->size(), AlarmHistory::most);
  EXPECT_EQ(history.newest()->back().alarm.number, 10u);
  AlarmHistory after;
  after.restore(history.take_lines());
  EXPECT_EQ(after.newest()->size(), AlarmHistory::most);
  EXPECT_EQ(after.newest()->back().alarm.number, 10u);
}

TEST(AlarmHistory, IsSearchedByNumberTextAndSource) {
  const PastAlarm past{1, alarm(140), "T1", ""};
  EXPECT_TRUE(matches(past, ""));
  EXPECT_TRUE(matches(past, "14"));
  EXPECT_TRUE(matches(past, "TEXT OF"));
  EXPECT_TRUE(matches(past, "Chan"));
  EXPECT_FALSE(matches(past, "drive"));
}

}  // namespace
}  // namespace trunnion::gateway
