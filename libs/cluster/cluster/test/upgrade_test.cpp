// SPDX-License-Identifier: Apache-2.0
#include "cluster/upgrade.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "testing_support/refusal.hpp"

namespace trunnion::cluster {
namespace {

using idl::service::SwapReply;
using idl::service::SwapRequest;
using testing::ElementsAre;

std::vector<Replacement> three_services() {
  std::vector<Replacement> all;
  for (const auto* name : {"kinematics", "plc", "drive"}) {
    Replacement one;
    one.shown = one.request.service = name;
    one.request.executable = std::string("new/") + name;
    one.running = std::string("old/") + name;
    all.push_back(one);
  }
  return all;
}

// Refuses the executables that are named, and notes what it is asked for.
struct AnsweringLauncher {
  std::vector<std::string> refused, asked;
  SwapReply operator()(const SwapRequest& request) {
    asked.push_back(request.executable);
    SwapReply reply;
    reply.accepted = std::find(refused.begin(), refused.end(), request.executable) == refused.end();
    if (!reply.accepted) reply.reason = "it differs";
    return reply;
  }
};

std::string refusal_with(AnsweringLauncher& launcher) {
  auto all = three_services();
  return testing_support::refusal_of(
      [&] { replace_all(all, std::ref(launcher), [](const Replacement&, std::size_t) {}); });
}

TEST(Upgrade, TakesStagesFirstAndTheDriveLast) {
  EXPECT_LT(place_in_order("kinematics"), place_in_order("parameters"));
  EXPECT_LT(place_in_order("parameters"), place_in_order("gateway"));
  EXPECT_LT(place_in_order("channel"), place_in_order("drive"));
}

TEST(Upgrade, ReplacesOneAfterTheOther) {
  AnsweringLauncher launcher;
  auto all = three_services();
  std::vector<std::string> told;
  replace_all(all, std::ref(launcher), [&](const Replacement& one, std::size_t count) {
    told.push_back(one.shown + " " + std::to_string(count));
  });
  EXPECT_THAT(launcher.asked, ElementsAre("new/kinematics", "new/plc", "new/drive"));
  EXPECT_THAT(told, ElementsAre("kinematics 1", "plc 2", "drive 3"));
  EXPECT_TRUE(all.back().reply.accepted);
}

TEST(Upgrade, PutsBackWhatItHasReplacedTheNewestFirst) {
  AnsweringLauncher launcher{{"new/drive"}, {}};
  EXPECT_EQ(refusal_with(launcher), "drive: it differs; the 2 services before it were put back");
  EXPECT_THAT(launcher.asked,
              ElementsAre("new/kinematics", "new/plc", "new/drive", "old/plc", "old/kinematics"));
}

TEST(Upgrade, NamesWhatCannotBePutBack) {
  AnsweringLauncher launcher{{"new/drive", "old/plc"}, {}};
  EXPECT_EQ(refusal_with(launcher), "drive: it differs; these could not be put back: plc (it differs)");
  AnsweringLauncher first{{"new/kinematics"}, {}};
  EXPECT_EQ(refusal_with(first), "kinematics: it differs; nothing was replaced");
}

}  // namespace
}  // namespace trunnion::cluster
