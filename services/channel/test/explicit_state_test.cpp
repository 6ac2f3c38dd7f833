// SPDX-License-Identifier: Apache-2.0
// A channel that continues from the explicit state of another at rest writes what that one writes.
#include "bus/json.hpp"
#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;

struct ExplicitState : Channel {
  std::string given() {
    round();  // takes everything away
    std::string why_not;
    const auto state = core->explicit_state(why_not);
    return why_not.empty() ? bus::text_of(state) : why_not;
  }
  // A new process in the place of the channel, which has received the same tables.
  void continue_from(const std::string& state) {
    start_process();
    store();
    core->continue_from(bus::Json::parse(state));
  }
  // What the drive executes from here on.
  std::vector<std::vector<double>> go_on() {
    const auto from = static_cast<long>(drive.rows.size());
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
    EXPECT_TRUE(ask(CommandKind::JOG_AXIS, "", 600, 2.5).accepted);
    run();
    round();
    return {drive.rows.begin() + from, drive.rows.end()};
  }
};

TEST_F(ExplicitState, OfAChannelThatHasRunAProgramContinuesWithTheSameBits) {
  // The variable makes the second run go elsewhere than the first.
  load("#500=#500+1.7\nM3 S500\nG1 X[#500*3] Y2 F3000\nG0 X1\nM5\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::IDLE);
  ask(CommandKind::FEED_OVERRIDE, "", 0.7);
  const auto before = given();
  const auto drive_before = drive;
  const auto written = go_on();
  ASSERT_GT(written.size(), 300u);
  const auto after = given();

  drive = drive_before;
  continue_from(before);
  EXPECT_EQ(given(), before) << "nothing is lost on the way";
  EXPECT_EQ(go_on(), written);
  EXPECT_EQ(given(), after);
}

TEST_F(ExplicitState, IsGivenAtRestOnly) {
  load("G1 X20 F600\nM30\n");
  EXPECT_EQ(given().front(), '{');
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 5; ++i) round();
  EXPECT_EQ(given().substr(0, 14), "the channel is");
  ask(CommandKind::FEED_HOLD);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_EQ(given().substr(0, 14), "the channel is");
  ask(CommandKind::RESET);
  run();
  round();
  EXPECT_EQ(given().front(), '{');
}

TEST_F(ExplicitState, IsNotGivenWhileFramesOfAnMdiLineAct) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G92 X5").accepted);
  run();
  EXPECT_NE(given().find("MDI"), std::string::npos);
  ask(CommandKind::RESET);
  EXPECT_EQ(given().front(), '{');
}

TEST_F(ExplicitState, HasTheProgramBehindATemporaryOne) {
  load("G0 X1\nM30\n");
  subprograms["servo-test.tmp.nc"] = {"M30\n", 4};
  store();
  ASSERT_TRUE(ask(CommandKind::SELECT_PROGRAM, "servo-test.tmp.nc").accepted);
  continue_from(given());
  ask(CommandKind::RESET);
  EXPECT_EQ(core->state().program, "part.nc");
}

TEST_F(ExplicitState, HasWhatTheRecordOfTheProgramHas) {
  load("G0 X1\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  ASSERT_TRUE(ask({.command = CommandKind::TOOL_IN_SPINDLE, .tool = 1}).accepted);
  const auto before = core->running_program();
  ASSERT_GT(before.tool_since, 0u);
  ASSERT_EQ(before.parts, 1u);
  continue_from(given());
  EXPECT_EQ(core->running_program(), before);
}

TEST_F(ExplicitState, HasThePlaceOfTheNextLineThatIsPrinted) {
  load("DPRNT[A]\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_TRUE(core->take_print_request());
  idl::program::ProgramReply reply;
  reply.accepted = true, reply.offset = 2;
  core->on_printed(reply);
  run();
  const auto before = core->printed();
  ASSERT_EQ(before.end, 2u);
  continue_from(given());
  EXPECT_EQ(core->printed(), before);
}

// They refuse a tap, also before the drive has said it again.
TEST_F(ExplicitState, HasTheSpindlesThatAreSynchronized) {
  EXPECT_EQ(given().find("\"synchronized\""), std::string::npos);
  drive.spindle_states = [](std::uint64_t) {
    std::vector<idl::stream::SpindleState> states(2);
    states[0].master = -1, states[1].master = 0;
    states[1].condition = idl::stream::SpindleCondition::SPINDLE_SYNCHRONIZED;
    return states;
  };
  round();
  continue_from(given());
  std::string why_not;
  EXPECT_EQ(core->explicit_state(why_not).at("synchronized"), 3);
}

}  // namespace
}  // namespace trunnion::channel
