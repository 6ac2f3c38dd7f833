// SPDX-License-Identifier: Apache-2.0
// The figures that documents name are those of the code.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "timeouts.hpp"

namespace trunnion::drive {
namespace {

std::string document(const std::string& name) {
  std::ifstream in(std::string(TRUNNION_DOCUMENTS) + "/" + name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Documents, TheWaitForAMissingSetpointInVirtualTimeIsTheOneOfTheCode) {
  EXPECT_NE(
      document("architecture.md")
          .find(fmt::format("In virtual time it waits {:g} s of wall time first", missing_setpoint_timeout)),
      std::string::npos);
}

TEST(Documents, TheTimeWithoutASignOfThePlcIsTheOneOfTheCode) {
  EXPECT_NE(document("faults.md").find(fmt::format("{:g} s without a message of the PLC", plc_timeout)),
            std::string::npos);
}

TEST(Documents, TheTimeThatDrivesTakeToComeOnIsTheOneOfTheCode) {
  EXPECT_NE(document("hal.md").find(fmt::format("comes again {:g} s after the enable", drives_on_timeout)),
            std::string::npos);
}

TEST(Documents, TheTimeThatSynchronizedSpindlesHaveToComeToRestIsTheOneOfTheCode) {
  EXPECT_NE(
      document("spindles.md").find(fmt::format("{:g} s after the end of the ramp", spindle_rest_timeout)),
      std::string::npos);
}

TEST(Documents, TheTimeThatASpindleHasToComeToItsAngleIsTheOneOfTheCode) {
  EXPECT_NE(document("drives.md").find(fmt::format("{:g} s and two turns at 10a947", orientation_timeout)),
            std::string::npos);
}

}  // namespace
}  // namespace trunnion::drive
