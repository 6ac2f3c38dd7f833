// SPDX-License-Identifier: Apache-2.0
// A change of a table by itself.
#include "table_change.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

language::Command radius_wear_of_tool_3() {
  language::Command command;
  command.kind = language::CommandKind::table;
  command.table = language::Table::tool_radius_wear;
  command.number = 3;
  command.value = -0.05;
  return command;
}

TEST(TableChange, AsksTheOwnerOnceForWhoDemandsIt) {
  TableChange change(2);
  EXPECT_FALSE(change.take_request());
  idl::parameters::ToolTable tools;
  tools.tools = {{3, 100, 0.1, 5, 0.2, "End mill"}};
  change.set_tools(tools);
  change.begin(radius_wear_of_tool_3(), 1, "part.nc line 7 of channel 2");
  EXPECT_FALSE(change.at_rest());
  const auto request = change.take_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->role, 1);
  EXPECT_EQ(request->who, "part.nc line 7 of channel 2");
  ASSERT_EQ(request->tools.size(), 1u);
  EXPECT_EQ(request->tools[0].radius_wear, -0.05);
  EXPECT_EQ(request->tools[0].length, 100) << "as it was";
  EXPECT_FALSE(change.take_request()) << "sent once";
  EXPECT_FALSE(change.at_rest()) << "before the owner has answered";
}

TEST(TableChange, IsAnsweredOnceAndForgottenWhenCancelled) {
  TableChange change(0);
  EXPECT_FALSE(change.finish());
  change.begin(radius_wear_of_tool_3(), 0, "a test");
  ASSERT_TRUE(change.take_request());
  EXPECT_TRUE(change.finish());
  EXPECT_TRUE(change.at_rest());
  EXPECT_FALSE(change.finish());
  change.begin(radius_wear_of_tool_3(), 0, "a test");
  change.cancel();
  EXPECT_FALSE(change.finish());
  EXPECT_TRUE(change.take_request()) << "what was demanded is demanded";
}

// ParameterRequest has room for 64 characters.
TEST(TableChange, CutsOffWhatIsTooLongOfWhoDemandsIt) {
  TableChange change(0);
  change.begin(radius_wear_of_tool_3(), 0, std::string(100, 'a'));
  EXPECT_EQ(change.take_request()->who, std::string(64, 'a'));
}

}  // namespace
}  // namespace trunnion::channel
