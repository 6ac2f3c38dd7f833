// SPDX-License-Identifier: Apache-2.0
#include "emergency_press.hpp"

#include <gtest/gtest.h>

namespace trunnion::drive {
namespace {

TEST(EmergencyPress, IsHeldUntilThePlcNamesIt) {
  EmergencyPress press;
  idl::plc::Outputs outputs;
  EXPECT_FALSE(press.held());
  press.press({7, 3}, outputs);
  EXPECT_TRUE(press.held());
  EXPECT_EQ(press.which(), (idl::plc::Press{7, 3}));
  outputs.presses = {{7, 2}, {8, 3}};
  press.release(outputs);
  EXPECT_TRUE(press.held()) << "other presses";
  outputs.presses = {{9, 1}, {7, 3}};
  press.release(outputs);
  EXPECT_FALSE(press.held());
  EXPECT_EQ(press.which().number, 0U);
}

TEST(EmergencyPress, ThatThePlcHasTakenAlreadyIsNotHeld) {
  EmergencyPress press;
  idl::plc::Outputs outputs;
  outputs.presses = {{7, 3}};
  press.press({7, 3}, outputs);
  EXPECT_FALSE(press.held()) << "sent again, or read later than by the PLC";
}

}  // namespace
}  // namespace trunnion::drive
