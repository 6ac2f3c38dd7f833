// SPDX-License-Identifier: Apache-2.0
// Lines of manual data input by themselves.
#include "mdi.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "channel_fixture.hpp"
#include "channel_path.hpp"

namespace trunnion::channel {
namespace {

struct MdiAlone : ::testing::Test {
  MdiAlone() {
    machine.configure(*testing::three_axes());
    path.build(machine.limits());
    path.start({});
    mdi.set_modal(machine.power_on());
  }
  void enter(const std::string& line, std::uint8_t role = 1) {
    idl::channel::ChannelRequest request;
    request.block = line, request.who = "a setter", request.role = role;
    mdi.enter(request);
    path.start({});
    mdi.start(path.trajectory(), path.position(), *variables);
    EXPECT_NE(mdi.flow().fill(false), program_execution::FlowState::alarm) << mdi.flow().alarm_text();
  }
  channel_setup::ChannelSetup machine{0};
  ChannelPath path{machine};
  Mdi mdi{machine};
  std::unique_ptr<language::VariableStore> variables = std::make_unique<language::VariableStore>();
};

TEST_F(MdiAlone, ContinuesInTheModalStateOfTheLineBeforeWithTheToolInTheSpindle) {
  ASSERT_TRUE(mdi.modal().absolute);
  enter("G91");
  EXPECT_TRUE(mdi.modal().absolute) << "until it has ended";
  mdi.end(3);
  EXPECT_FALSE(mdi.modal().absolute);
  EXPECT_EQ(mdi.modal().tool, 3);
}

TEST_F(MdiAlone, KeepsTheFramesOfItsLinesUntilTheyAreForgotten) {
  enter("G92 X5");
  EXPECT_FALSE(mdi.frames_kept()) << "until it has ended";
  mdi.end(0);
  EXPECT_TRUE(mdi.frames_kept());
  mdi.forget_frames();
  EXPECT_FALSE(mdi.frames_kept());
  EXPECT_EQ(mdi.frame(), nullptr);
}

TEST_F(MdiAlone, ChangesWhatItsOperatorMayOrTheOneWhoStoredWhatItCalls) {
  enter("G91", 2);
  EXPECT_EQ(mdi.who(), "a setter");
  EXPECT_EQ(mdi.role_of_line(), 2);
  EXPECT_EQ(mdi.role(), 2);
  idl::program::ProgramList stored;
  stored.programs.resize(1);
  stored.programs[0].name = "9001.nc", stored.programs[0].role = 1;
  ASSERT_NE(mdi.texts().call(stored, "9001"), nullptr);
  EXPECT_EQ(mdi.role(), 1);
  enter("G90", 2);
  EXPECT_EQ(mdi.role(), 2) << "the texts were those of the line before";
}

}  // namespace
}  // namespace trunnion::channel
