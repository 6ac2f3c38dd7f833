// SPDX-License-Identifier: Apache-2.0
#include "cluster/executables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing_support/refusal.hpp"

namespace trunnion::cluster {
namespace {

using testing::HasSubstr;

std::string refusal(const std::vector<std::string>& texts) {
  return testing_support::refusal_of([&] { read_executables(texts); });
}

TEST(Executables, AreReadAndWrittenAsArguments) {
  const auto executables = read_executables({"kinematics=/bin/true", "compensation=/bin/../bin/false"});
  EXPECT_EQ(executables, (Executables{{"kinematics", "/bin/true"}, {"compensation", "/bin/false"}}));
  EXPECT_EQ(executable_arguments(executables), (std::vector<std::string>{"--exec", "compensation=/bin/false",
                                                                         "--exec", "kinematics=/bin/true"}));
}

TEST(Executables, ThatCannotBeStartedAreOneLine) {
  EXPECT_THAT(refusal({"kinematics"}), HasSubstr("--exec kinematics: expected SERVICE=PATH"));
  EXPECT_THAT(refusal({"=/bin/true"}), HasSubstr("expected SERVICE=PATH"));
  EXPECT_THAT(refusal({"coffee=/bin/true"}),
              HasSubstr("--exec coffee=/bin/true: there is no service of this name"));
  EXPECT_THAT(refusal({"drive=/nowhere"}), HasSubstr("there is no executable /nowhere"));
  EXPECT_THAT(refusal({"drive=/etc"}), HasSubstr("there is no executable /etc"));
  EXPECT_THAT(refusal({"drive=/bin/true", "drive=/bin/false"}),
              HasSubstr("the service has an executable already"));
}

}  // namespace
}  // namespace trunnion::cluster
