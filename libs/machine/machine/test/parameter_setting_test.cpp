// SPDX-License-Identifier: Apache-2.0
#include "machine/parameter_setting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing_support/refusal.hpp"

namespace trunnion::machine {
namespace {

using testing::HasSubstr;

TEST(ParameterSettings, SetAParameterByItsNumber) {
  Parameters p;
  apply_setting(p, 0, "040426=-1");
  apply_setting(p, 0, "40428=0.5");
  EXPECT_EQ(p.at(40426), -1);
  EXPECT_EQ(p.at(40428), 0.5);
}

// Of a head, so the parameters are the vector towards the workpiece.
TEST(ParameterSettings, SetACorrectionByItsName) {
  Parameters p;
  p.values[40984] = {0, "CORR_SP"};
  apply_setting(p, 0, "CORR_SP=0.5,-1,2");
  EXPECT_EQ(p.at(40969), -0.5);
  EXPECT_EQ(p.at(40970), 1);
  EXPECT_EQ(p.at(40971), -2);
}

TEST(ParameterSettings, KeepTheLimitsOfTheParameters) {
  Parameters p;
  p.values[40984] = {0, "CORR_SP"};
  const auto refusal = [&](const char* setting) {
    return testing_support::refusal_of([&] { apply_setting(p, 0, setting); });
  };
  EXPECT_EQ(refusal("040426"), "--set 040426: expected NUMBER=VALUE or NAME=X,Y,Z");
  EXPECT_EQ(refusal("CORR_SP=1,2"), "--set CORR_SP: expected NAME=X,Y,Z");
  EXPECT_EQ(refusal("CORR_SP=2000,0,0"),
            "parameter 040969 (head_correction_2): -2000 is outside -1000 .. 1000 mm");
  EXPECT_THAT(refusal("040952=0"), HasSubstr("--set 040952=0"));
  EXPECT_THAT(refusal("040952=0"), HasSubstr("outside 0.1 .. 1000"));
}

}  // namespace
}  // namespace trunnion::machine
