// SPDX-License-Identifier: Apache-2.0
#include "bus/former_names.hpp"

#include <gtest/gtest.h>

#include "bus/registry.hpp"
#include "contracts/topics.hpp"

namespace trunnion::bus {
namespace {

TEST(FormerNames, AreThoseOfTodayInTopicsHandlesAndSchemas) {
  EXPECT_EQ(with_names_of_today("trunnion/channel/path_frame/1"), topics::path_batch.name);
  EXPECT_EQ(with_names_of_today("trunnion/drive/feedback_frame/1"), topics::feedback.name);
  EXPECT_EQ(with_names_of_today("struct PathFrame { uint32 frames_ahead; };"),
            "struct PathBatch { uint32 cycles_ahead; };");
  EXPECT_EQ(with_names_of_today(""), "");
}

TEST(FormerNames, WholeNamesOnlyChange) {
  for (const auto* same : {"path_frame_2", "my_path_frame", "PathFrames", "trunnion/channel/state/1", "{};"})
    EXPECT_EQ(with_names_of_today(same), same);
}

TEST(FormerNames, NoTopicOfTodayHasOne) {
  for (const auto& entry : all_topics()) {
    EXPECT_EQ(with_names_of_today(entry.description.name), entry.description.name);
    EXPECT_EQ(with_names_of_today(entry.handle), entry.handle);
    EXPECT_EQ(with_names_of_today(entry.schema), entry.schema);
  }
}

TEST(FormerNames, FindTheirTopic) {
  EXPECT_EQ(find_topic("gantry_frame"), find_topic("gantry_batch"));
  EXPECT_NE(find_topic("gantry_frame"), nullptr);
}

}  // namespace
}  // namespace trunnion::bus
