// SPDX-License-Identifier: Apache-2.0
// `collision: warn` and `stop` on the AC trunnion machine: programs, MDI, jog and handwheel.
#include <cmath>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"
#include "parameter_store/machine_tables.hpp"

namespace trunnion::channel {
namespace {
using namespace testing;
using machine::CollisionMode;

// The ball is at the spindle face, which is at the machine's zero with X Y Z at zero; the posts stand around
// it and on the table. The pins are beside the table, on the table.
constexpr const char* bodies = R"(
structure: "[w C' A' b X Y Z (S) t]"
clearance_mm: 1
bodies:
  - {name: head, on: spindle, sphere: {diameter_mm: 20}}
  - {name: stop +X, on: base, box: {size_mm: [20, 300, 300]}, position_mm: [110, 0, 0]}
  - {name: stop -X, on: base, box: {size_mm: [20, 300, 300]}, position_mm: [-110, 0, 0]}
  - {name: stop +Y, on: base, box: {size_mm: [300, 20, 300]}, position_mm: [0, 110, 0]}
  - {name: stop -Y, on: base, box: {size_mm: [300, 20, 300]}, position_mm: [0, -110, 0]}
  - {name: table, on: C, box: {size_mm: [60, 60, 20]}, position_mm: [0, 0, -210]}
  - {name: pin, on: C, sphere: {diameter_mm: 10}, position_mm: [0, 60, -100]}
)";

class Guard : public Channel {
 protected:
  void SetUp() override {
    drive = FakeDrive(5);
    auto machine = std::make_shared<machine::Parameters>(
        tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table").parameters);
    machine->values[902] = {16, ""}, machine->values[903] = {32, ""};
    parameters = machine;
    restart(CollisionMode::stop);
  }
  void restart(CollisionMode mode, const char* text = bodies) {
    core.reset();
    begin();
    if (mode != CollisionMode::off) core->guard(mode, {"bodies.yaml", text});
  }
  Answer jog(std::uint8_t axis, double speed, double increment) {
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
    const auto answer = ask(CommandKind::JOG_AXIS, "", speed, increment, Mode::JOG, axis);
    run();
    return answer;
  }
  void mdi(const std::string& line) {
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
    answer_ = ask(CommandKind::MDI_LINE, line);
    run();
  }
  bool raised(const machine::AlarmDefinition& alarm) const {
    return std::any_of(events.begin(), events.end(), [&](const auto& e) { return e.alarm == &alarm; });
  }
  std::string text_of(const machine::AlarmDefinition& alarm) const {
    for (const auto& e : events)
      if (e.alarm == &alarm) return e.text;
    return "";
  }
  double at(std::size_t axis) const { return drive.rows.empty() ? 0 : drive.rows.back()[axis]; }
  Answer answer_;
};

// The resolution of the check and the clearance.
constexpr double stop_at = 100 - 10 - 1, early = 0.03, within = 0.031;

TEST_F(Guard, JogOfEachAxisStopsBeforeTheBodiesAndMayGoAway) {
  struct Case {
    std::uint8_t axis;
    double speed, stops;
  };
  for (const auto& c :
       {Case{0, 3000, stop_at}, Case{0, -3000, -stop_at}, Case{1, 3000, stop_at}, Case{1, -3000, -stop_at}}) {
    events.clear();
    ASSERT_TRUE(jog(c.axis, c.speed, 150).accepted);
    EXPECT_NEAR(at(c.axis), c.stops - std::copysign(early, c.speed), within) << int{c.axis};
    EXPECT_TRUE(raised(alarm::bodies_would_meet));
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    const double there = at(c.axis);
    const auto towards = jog(c.axis, c.speed, 1);
    EXPECT_FALSE(towards.accepted) << "towards";
    EXPECT_EQ(towards.alarm, alarm::bodies_would_meet.number);
    EXPECT_EQ(at(c.axis), there);
    ASSERT_TRUE(jog(c.axis, -c.speed, std::abs(there)).accepted) << "away";
    EXPECT_NEAR(at(c.axis), 0, 1e-9);
  }
  // Down to the table whose top is at -200.
  ASSERT_TRUE(jog(2, -3000, 250).accepted);
  EXPECT_NEAR(at(2), -189 + early, within);
  ASSERT_TRUE(jog(2, 3000, 189).accepted);
}

TEST_F(Guard, JogOfARotaryAxisStopsBeforeItsBodyMeetsTheHead) {
  // The pin is 60 mm from C; the head beside it at the same radius and height, 90 degrees on.
  mdi("G53 G0 X60");
  mdi("G53 G0 Z-100");
  ASSERT_NEAR(at(2), -100, 1e-9) << answer_.reason;
  // They touch at a chord of 2 * 60 sin(phi / 2) = 5 + 10; the clearance adds 1.
  const double phi = 2 * std::asin(16.0 / 120) * 180 / M_PI;
  for (const double direction : {1.0, -1.0}) {
    events.clear();
    ASSERT_TRUE(jog(4, direction * 1000, 360).accepted);
    EXPECT_TRUE(raised(alarm::bodies_would_meet));
    const double c = std::fmod(std::abs(at(5)), 360);
    // From the pin at +Y the head at +X is 90 degrees one way and 270 the other way.
    EXPECT_TRUE(std::abs(c - (90 - phi)) < 0.1 || std::abs(c - (270 - phi)) < 0.1) << at(5) << " " << phi;
    ASSERT_TRUE(jog(4, -direction * 1000, std::abs(at(5))).accepted) << "away";
  }
}

TEST_F(Guard, AProgramStopsAtTheEndOfTheBlockBeforeAndTheChannelCanBeJoggedAway) {
  load("G90 G53 G0 Z-150\nG1 X20 F2000\nG1 Z-195\nG1 X0\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(at(2), -150, 1e-9);
  EXPECT_NEAR(at(0), 20, 1e-9);
  const auto text = text_of(alarm::bodies_would_meet);
  EXPECT_EQ(text.rfind("part.nc:3: 'head' and 'table' would be ", 0), 0u) << text;
  EXPECT_NE(text.find(" mm apart (clearance 1 mm) at X20.000 Y0.000 Z-18"), std::string::npos) << text;
  EXPECT_TRUE(jog(2, 3000, 100).accepted);
}

TEST_F(Guard, TheSameStopAfterTheChannelWasKilled) {
  load("G90 G53 G0 Z-150\nG1 X80 F2000\nG1 X20\nG1 Z-195\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 60; ++i) round();
  ASSERT_EQ(core->run_state(), RunState::RUNNING);
  restart(CollisionMode::stop);
  events.clear();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(at(0), 20, 1e-9);
  EXPECT_NEAR(at(2), -150, 1e-9);
  EXPECT_EQ(text_of(alarm::bodies_would_meet).rfind("part.nc:4: ", 0), 0u);
}

TEST_F(Guard, AnMdiLineThatLeadsIntoTheTableDoesNotMove) {
  mdi("G53 G0 Z-150");
  const double before = at(2);
  events.clear();
  mdi("G53 G0 Z-195");
  EXPECT_TRUE(!answer_.accepted || raised(alarm::bodies_would_meet));
  EXPECT_EQ(at(2), before);
  mdi("G53 G0 Z-100");
  EXPECT_TRUE(answer_.accepted);
  EXPECT_NEAR(at(2), -100, 1e-9);
}

TEST_F(Guard, WarnShowsTheAlarmAndGoesOn) {
  restart(CollisionMode::warn);
  load("G90 G53 G0 Z-150\nG1 Z-195 F2000\nG1 Z-194\nG1 Z-100\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_NEAR(at(2), -100, 1e-9);
  EXPECT_EQ(text_of(alarm::bodies_near).rfind("part.nc:2: ", 0), 0u);
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const auto& e) { return e.alarm == &alarm::bodies_near; }),
            1);
  events.clear();
  ASSERT_TRUE(jog(2, -3000, 95).accepted);
  EXPECT_NEAR(at(2), -195, 1e-9);
  EXPECT_TRUE(raised(alarm::bodies_near));
}

TEST_F(Guard, TheHandwheelEndsBeforeTheBodies) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ASSERT_TRUE(ask(CommandKind::HANDWHEEL, "", 200, 1).accepted);  // 200 mm
  run();
  EXPECT_NEAR(at(0), stop_at - early, within);
  EXPECT_TRUE(ask(CommandKind::HANDWHEEL, "", -50, 1).accepted);
  run();
  EXPECT_NEAR(at(0), stop_at - early - 50, within);
}

TEST_F(Guard, NothingMovesWithBodiesThatCannotBeUsed) {
  restart(CollisionMode::stop, "bodies: [{name: a}]");
  round();
  EXPECT_TRUE(raised(alarm::bodies_invalid));
  const auto answer = jog(0, 3000, 10);
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, alarm::bodies_invalid.number);
  EXPECT_EQ(answer.reason.rfind("bodies.yaml:1:", 0), 0u) << answer.reason;
}

TEST_F(Guard, TheSetpointsOfAFreeProgramAreThoseWithoutTheCheck) {
  const std::string program =
      "G90 G53 G0 Z-50\nG1 X50 Y20 A2 F3000\nG3 X20 Y40 R80\nG1 A0 C90\nG0 X0 Y0\nM30\n";
  const auto rows = [&](CollisionMode mode) {
    drive = FakeDrive(5);
    restart(mode);
    load(program);
    ask(CommandKind::CYCLE_START);
    run();
    return drive.rows;
  };
  const auto with = rows(CollisionMode::stop);
  EXPECT_FALSE(raised(alarm::bodies_would_meet)) << text_of(alarm::bodies_would_meet);
  EXPECT_GT(with.size(), 1000u);
  EXPECT_EQ(with, rows(CollisionMode::off));
}

TEST_F(Guard, AHandwheelOffsetIsRefused) {
  EXPECT_FALSE(ask(CommandKind::HANDWHEEL_OFFSET, "", 1).accepted);
  restart(CollisionMode::off);
  EXPECT_TRUE(ask(CommandKind::HANDWHEEL_OFFSET, "", 1).accepted);
}

/// Without a channel core around them.
struct BodiesAlone : ::testing::Test {
  channel_setup::ChannelSetup machine{
      tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table")};
  ChannelBodies alone{machine};
  void demand(CollisionMode mode, const char* text = bodies) {
    alone.demand(mode, {"bodies.yaml", text});
    const auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
    alone.configure(tables.parameters, 0);
  }
};

TEST_F(BodiesAlone, LetEverythingPassUntilTheCheckIsDemanded) {
  AxisMove move{0, 150, 1000};
  EXPECT_FALSE(alone.guard_jog(move, {}, {150}, {}));
  EXPECT_EQ(move.target, 150);
  EXPECT_FALSE(alone.guard_reference(move, {}, {150}, {}));
  EXPECT_FALSE(alone.jog_arrived({150}));
  EXPECT_FALSE(alone.stop());
}

TEST_F(BodiesAlone, CutAJogShortAndTellItWhereItArrives) {
  demand(CollisionMode::stop);
  ASSERT_EQ(alone.error(), "");
  AxisMove move{0, 150, 1000};
  ASSERT_FALSE(alone.guard_jog(move, {}, {150}, {}));
  EXPECT_NEAR(move.target, stop_at - early, within);
  EXPECT_FALSE(alone.jog_arrived({move.target - 1}));
  const auto text = alone.jog_arrived({move.target});
  ASSERT_TRUE(text);
  EXPECT_EQ(text->rfind("JOG X: ", 0), 0u) << *text;
  EXPECT_FALSE(alone.jog_arrived({move.target})) << "once";
}

TEST_F(BodiesAlone, RefuseAReferenceReturnThatWouldHaveToBeCutShort) {
  demand(CollisionMode::stop);
  EXPECT_TRUE(alone.guard_reference({0, 150, 1000}, {}, {150}, {}));
  EXPECT_FALSE(alone.jog_arrived({150}));
  EXPECT_FALSE(alone.guard_reference({0, 50, 1000}, {}, {50}, {}));
}

TEST_F(BodiesAlone, OnlyReportWithWarn) {
  demand(CollisionMode::warn);
  AxisMove move{0, 150, 1000};
  EXPECT_FALSE(alone.guard_jog(move, {}, {150}, {}));
  EXPECT_EQ(move.target, 150);
  EXPECT_TRUE(alone.jog_arrived({150}));
}

TEST_F(BodiesAlone, SayWhatIsWrongWithTheirFile) {
  demand(CollisionMode::stop, "bodies: [{name: a}]");
  EXPECT_EQ(alone.error().rfind("bodies.yaml:1:", 0), 0u) << alone.error();
}

}  // namespace
}  // namespace trunnion::channel
