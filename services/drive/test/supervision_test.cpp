// SPDX-License-Identifier: Apache-2.0
// What the drive does about an axis that does not follow.
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "queued_hardware.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::AxisBatch;
using idl::stream::StreamRequestKind;
using testing::QueuedHardware;

constexpr std::size_t queue = 5;

/// X: a following error of 2 mm stops it, of 4 mm switches it off. 0.1 mm per cycle.
struct Supervision : ::testing::Test {
  QueuedHardware* hardware = new QueuedHardware(queue);
  DriveCore core{std::unique_ptr<DriveHardware>(hardware)};
  machine::Parameters p;
  std::vector<std::uint32_t> alarms;
  std::vector<std::string> texts;

  void SetUp() override {
    p.revision = 1;
    p.values[40001] = {0, ""};
    p.values[100000] = {0, "X"};
    p.values[100034] = {60000, ""};
    p.values[100037] = {2, ""};
    accelerate(4000);
  }
  void accelerate(double most) {
    p.values[100036] = {most, ""};
    core.configure(p, false);
    core.set_enables({1}, false);
  }
  static double path(std::uint64_t n) { return n < 100 ? 0.1 * n * n / 200.0 : 0.1 * (n - 50.0); }
  void move() {
    core.request({0, 1, StreamRequestKind::NEW_EPOCH, 1, 0});
    for (std::uint64_t first = 0; first < 1000; first += 8) {
      AxisBatch f;
      f.epoch = 1, f.first = first, f.count = 8, f.starts = first == 0, f.revision = 1, f.axes = {0};
      for (std::uint64_t n = first; n < first + 8; ++n) f.setpoints.push_back(path(n));
      f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {}}};
      ASSERT_TRUE(core.put(f));
    }
    periods(300);
  }
  void periods(int count) {
    idl::stream::Feedback feedback;
    for (int i = 0; i < count; ++i) {
      core.step();
      core.fill(feedback);
    }
    for (auto& event : core.take_events()) alarms.push_back(event.alarm->number), texts.push_back(event.text);
  }
  /// Periods until the drives are off.
  int off_after(int most) {
    int n = 0;
    while (n < most && core.mode() != Mode::OFF) periods(1), ++n;
    return n;
  }
};
using Numbers = std::vector<std::uint32_t>;

// 2 mm are 20 periods of 0.1 mm; then the queue and 100 * 100 / 2000 = 5 mm of braking add more than
// another 2.
TEST_F(Supervision, AnErrorThatGrowsWhileTheAxisBrakesTakesTheEnableAway) {
  accelerate(1000);
  move();
  hardware->encoders_lost = true;
  periods(21);
  EXPECT_EQ(core.mode(), Mode::BRAKING);
  EXPECT_EQ(alarms, Numbers{alarm::following_error.number});
  // Without braking another 20 periods; it takes longer the more the axis has braked.
  EXPECT_LE(off_after(100), 30);
  EXPECT_EQ(alarms, (Numbers{alarm::following_error.number, alarm::following_error_excessive.number}));
  ASSERT_FALSE(texts.empty());
  EXPECT_EQ(texts.back().substr(0, 43), "Axis X does not follow: following error 4.0") << texts.back();
  periods(1);
  EXPECT_FALSE(hardware->newest.enable);
  periods(100);
  EXPECT_EQ(core.mode(), Mode::OFF) << "until the alarms are reset";
  core.acknowledge();
  periods(1);
  EXPECT_TRUE(hardware->newest.enable);
}

// 100 * 100 / 8000 = 1.25 mm of braking and 0.5 mm of the queue: less than 4 mm in all.
TEST_F(Supervision, AnErrorThatIsThereStillWhenTheAxisShouldRestTakesTheEnableAway) {
  move();
  hardware->encoders_lost = true;
  const int periods = off_after(1000);
  EXPECT_GT(periods, 20 + 25) << "2 mm, and what braking takes";
  EXPECT_LE(periods, 20 + 25 + 10 + static_cast<int>(settling_periods)) << "and the time to settle";
  EXPECT_EQ(alarms, (Numbers{alarm::following_error.number, alarm::following_error_excessive.number}));
}

TEST_F(Supervision, AnAxisThatComesBackWhileItBrakesStaysUnderControl) {
  move();
  hardware->beside[0] = -3;
  periods(10);
  hardware->beside[0] = -1.9;
  periods(1000);
  EXPECT_EQ(core.mode(), Mode::HELD);
  EXPECT_EQ(alarms, Numbers{alarm::following_error.number});
}

// The sign of the encoder or of the motor is wrong: what is to correct the error makes it larger.
TEST_F(Supervision, AnAxisThatRunsAwayFromRestIsSwitchedOff) {
  periods(10);
  for (int n = 1; n <= 4; ++n) {
    hardware->beside[0] = n;
    periods(1);
    EXPECT_NE(core.mode(), Mode::OFF);
  }
  hardware->beside[0] = 5;
  periods(1);
  EXPECT_EQ(core.mode(), Mode::OFF);
  EXPECT_EQ(alarms, (Numbers{alarm::following_error.number, alarm::following_error_excessive.number}));
}

TEST_F(Supervision, WithoutALimitNothingIsSupervised) {
  p.values[100037] = {0, ""};
  accelerate(4000);
  move();
  hardware->encoders_lost = true;
  periods(500);
  EXPECT_EQ(alarms, Numbers{});
}

TEST_F(Supervision, DrivesThatDoNotComeOnAreAnAlarmAfterEachReset) {
  hardware->on = false;
  periods(1);
  EXPECT_EQ(alarms, Numbers{alarm::drive_fault.number});
  core.acknowledge();
  periods(2000);
  EXPECT_EQ(alarms.size(), 1u) << "2 s";
  periods(1);
  ASSERT_EQ(alarms, (Numbers{alarm::drive_fault.number, alarm::drive_fault.number}));
  EXPECT_EQ(texts.back().substr(0, 45), "The drives are not on 2 s after their enable:");
  periods(1);
  EXPECT_FALSE(hardware->newest.enable);
  periods(5000);
  EXPECT_EQ(alarms.size(), 2u) << "once";
  core.set_enables({1}, true);
  core.acknowledge();
  periods(5000);
  EXPECT_EQ(alarms.size(), 2u) << "an emergency stop has them off";
  core.set_enables({1}, false);
  hardware->fault[0] = true;
  periods(2001);
  ASSERT_EQ(alarms.size(), 3u);
  EXPECT_EQ(texts.back().substr(0, 36), "The drive of axis X reports a fault;");
  hardware->fault[0] = false;
  hardware->on = true;
  core.acknowledge();
  periods(1);
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
}

TEST_F(Supervision, ASearchThatTheHardwareEndsHasFailed) {
  using idl::stream::ReferenceSearch;
  p.values[100920] = {1, ""};  // X has a home switch
  core.configure(p, false);
  const auto search = [&] {
    idl::stream::Feedback feedback;
    core.fill(feedback);
    return feedback.channels.at(0).search;
  };
  core.request({0, 1, StreamRequestKind::HOME, 0, 0});
  periods(10);
  EXPECT_EQ(core.mode(), Mode::HOMING);
  EXPECT_EQ(search(), ReferenceSearch::SEARCHES);
  hardware->starved = 3;
  periods(1);
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_EQ(search(), ReferenceSearch::SEARCH_FAILED) << "it had no setpoints";
  core.request({0, 2, StreamRequestKind::HOME, 0, 0});
  periods(10);
  EXPECT_EQ(search(), ReferenceSearch::SEARCHES);
  hardware->on = false;
  periods(1);
  EXPECT_EQ(core.mode(), Mode::OFF);
  EXPECT_EQ(search(), ReferenceSearch::SEARCH_FAILED);
}

/// A spindle follows the row in force, or the one `late` before, until it is jammed.
class TurningHardware : public QueuedHardware {
 public:
  TurningHardware() : QueuedHardware(queue) {}
  void exchange(const SetpointRow& row, DriveStatus& out, EncoderRowSink& rows) override {
    coupled = row.spindles[0].coupled;
    angles_.push_back(coupled ? row.spindles[0].angle : spindle[0].angle);
    if (angles_.size() > queue + late) {
      if (!jammed) spindle[0].angle = angles_.front();
      angles_.pop_front();
    }
    QueuedHardware::exchange(row, out, rows);
  }
  std::size_t late = 0;
  bool jammed = false, coupled = false;

 private:
  std::deque<double> angles_;
};

/// The spindle has axis 5, and its following error is limited to 2 deg. A revolution for 10 mm of X: 3.6 deg
/// in a cycle.
struct TapSupervision : ::testing::Test {
  TurningHardware* hardware = new TurningHardware;
  DriveCore core{std::unique_ptr<DriveHardware>(hardware)};
  std::vector<DriveEvent> events;

  void SetUp() override {
    machine::Parameters p;
    p.revision = 1;
    p.values[40001] = {0, ""};
    p.values[100000] = {0, "X"};
    p.values[100034] = {60000, ""};
    p.values[100036] = {4000, ""};
    p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
    p.values[105037] = {2, ""};
    core.configure(p, false);
    core.set_enables({1}, false);
    core.request({0, 1, StreamRequestKind::NEW_EPOCH, 1, 0});
    for (std::uint64_t first = 0; first < 1000; first += 8) {
      AxisBatch f;
      f.epoch = 1, f.first = first, f.count = 8, f.starts = first == 0, f.revision = 1, f.axes = {0};
      f.spindle_axis = 5;
      for (std::uint64_t n = first; n < first + 8; ++n) {
        f.setpoints.push_back(Supervision::path(n));
        f.spindle.push_back(Supervision::path(n) / 10);
      }
      f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {}}};
      ASSERT_TRUE(core.put(f));
    }
  }
  void periods(int count) {
    idl::stream::Feedback feedback;
    for (int i = 0; i < count; ++i) {
      core.step();
      core.fill(feedback);
    }
    for (auto& event : core.take_events()) events.push_back(event);
  }
};

TEST_F(TapSupervision, ASpindleThatFollowsItsPathSomePeriodsLateIsLeftAlone) {
  hardware->late = 3;
  periods(500);
  EXPECT_TRUE(hardware->coupled);
  EXPECT_TRUE(events.empty());
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
}

// Braking takes 25 periods.
TEST_F(TapSupervision, AJammedSpindleStopsTheAxesAndTheyDoNotGoOnWithoutIt) {
  periods(300);
  ASSERT_TRUE(events.empty());
  hardware->jammed = true;
  periods(100);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::following_error);
  EXPECT_EQ(events[0].part, 5u);
  EXPECT_EQ(events[0].text.substr(0, 37), "Spindle S does not follow the axes: f") << events[0].text;
  EXPECT_NE(events[0].text.find("parameter 105037"), std::string::npos) << events[0].text;
  EXPECT_EQ(core.mode(), Mode::HELD);
  core.acknowledge();
  core.request({0, 2, StreamRequestKind::RESUME, 1, 0});
  for (int i = 0; i < 1000 && core.mode() != Mode::FOLLOWING; ++i) periods(1);
  ASSERT_EQ(core.mode(), Mode::FOLLOWING);
  for (int i = 0; i < 1000 && core.mode() == Mode::FOLLOWING; ++i) periods(1);
  EXPECT_EQ(events.size(), 2u);
  EXPECT_EQ(core.mode(), Mode::BRAKING);
}

// Otherwise the alarm would come again with the reset, and whoever reset it would not see that it had ended.
TEST_F(Supervision, AResetInThePeriodOfTheAlarmGivesTheDrivesTheirWholeTimeAgain) {
  hardware->on = false;
  periods(1);
  for (std::size_t resets = 1; resets <= 3; ++resets) {
    core.acknowledge();
    periods(2000);
    EXPECT_EQ(alarms.size(), resets) << "2 s";
    periods(1);
    ASSERT_EQ(alarms.size(), resets + 1);
  }
}

// Travel to 20 mm; the setpoint rests at 0.
TEST_F(Supervision, TheTravelHoldsForTheEncoderToo) {
  p.values[100006] = {20, ""}, p.values[100007] = {-20, ""}, p.values[100037] = {0, ""};
  accelerate(4000);
  periods(10);
  hardware->beside[0] = 20.4;
  periods(1);
  hardware->beside[0] = 20.3;
  periods(2);
  EXPECT_EQ(alarms, Numbers{}) << "0.5 mm are left for an overshoot";
  hardware->beside[0] = 21;
  periods(1);
  ASSERT_EQ(alarms, Numbers{alarm::over_travel.number});
  EXPECT_EQ(texts.back(), "Axis X at 21.0000 is beyond its travel -20.0000 .. 20.0000");
  core.acknowledge();
  hardware->beside[0] = 20.8;
  periods(10);
  EXPECT_EQ(alarms.size(), 1u) << "it may come back";
}

}  // namespace
}  // namespace trunnion::drive
