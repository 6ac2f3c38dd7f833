// SPDX-License-Identifier: Apache-2.0
#include "hand_over.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace trunnion::channel {
namespace {

HandOver example() {
  HandOver h;
  h.mode = idl::channel::Mode::MDI;
  h.program = "part 7.nc";
  h.program_revision = 12;
  h.modal.plane = language::Plane::yz;
  h.modal.absolute = false;
  h.modal.work_offset = 3;
  h.modal.transformation = language::Transformation::rtcp;
  h.modal.tool_length = 0.1 + 0.2;  // not a short decimal
  h.modal.tilt.active = true;
  h.modal.tilt.solution = 2;
  h.modal.tilt.matrix[5] = -1.0 / 3.0;
  h.tool = 4;
  h.switches.feed_override = 0.7;
  h.switches.single_block = h.switches.dry_run = h.switches.auxiliary_lock = true;
  h.switches.block_skip = 5;
  h.reset_count = 9;
  return h;
}

TEST(HandOver, IsReadBackToTheBit) {
  HandOver read;
  ASSERT_TRUE(read_hand_over(write_hand_over(example(), "b1"), "f", "b1", read));
  EXPECT_EQ(read.mode, idl::channel::Mode::MDI);
  EXPECT_EQ(read.program, "part 7.nc");
  EXPECT_EQ(read.program_revision, 12u);
  EXPECT_EQ(read.modal.plane, language::Plane::yz);
  EXPECT_FALSE(read.modal.absolute);
  EXPECT_EQ(read.modal.work_offset, 3);
  EXPECT_EQ(read.modal.transformation, language::Transformation::rtcp);
  EXPECT_EQ(read.modal.tool_length, 0.1 + 0.2);
  EXPECT_EQ(read.modal, example().modal);
  EXPECT_EQ(read.tool, 4u);
  EXPECT_EQ(read.switches.feed_override, 0.7);
  EXPECT_TRUE(read.switches.single_block && read.switches.dry_run && read.switches.auxiliary_lock);
  EXPECT_EQ(read.switches.block_skip, 5);
  EXPECT_EQ(read.reset_count, 9u);
  // Every field that is written is read: the text of what was read is the same text.
  EXPECT_EQ(write_hand_over(read, "b1"), write_hand_over(example(), "b1"));
}

// One that is older writes every field that it knows, and refuses a line that it does not know.
TEST(HandOver, OfAnotherBuildIsRead) {
  HandOver read;
  ASSERT_TRUE(
      read_hand_over("boot b\nmode 1\nprogram part 7.nc\ntool 4\nfeed_override 0.7\nrapid_override 1\n"
                     "single_block 1\nmodal.plane 2\nmodal.absolute 0\nmodal.tilt.active 1\n"
                     "modal.tilt.origin.2 -5\nmodal.tilt.matrix.5 -0.25\n",
                     "f", "b", read));
  EXPECT_EQ(read.mode, idl::channel::Mode::MDI);
  EXPECT_EQ(read.program, "part 7.nc");
  EXPECT_EQ(read.tool, 4u);
  EXPECT_EQ(read.switches.feed_override, 0.7);
  EXPECT_TRUE(read.switches.single_block);
  EXPECT_EQ(read.modal.plane, language::Plane::yz);
  EXPECT_FALSE(read.modal.absolute);
  EXPECT_TRUE(read.modal.tilt.active);
  EXPECT_EQ(read.modal.tilt.origin[2], -5);
  EXPECT_EQ(read.modal.tilt.matrix[5], -0.25);
  EXPECT_EQ(write_hand_over({}, "b"), "boot b\n") << "nothing that an older build may not know";
}

TEST(HandOver, OfAnotherStartOfTheClusterIsNotUsed) {
  HandOver read;
  EXPECT_FALSE(read_hand_over(write_hand_over(example(), "b1"), "f", "b2", read));
  EXPECT_TRUE(read.program.empty());
  EXPECT_FALSE(read_hand_over("", "f", "b2", read));
}

TEST(HandOver, WhatItDoesNotKnowIsRefusedWithItsPlaceAndNothingIsHalfTaken) {
  for (const char* bad :
       {"tool x", "tool 4 5", "tool", "nothing 1", "feed_override inf", "single_block 2", ""}) {
    HandOver read;
    const std::string text = std::string("boot b\nreset_count 7\n") + bad + "\n";
    try {
      read_hand_over(text, "file", "b", read);
      ADD_FAILURE() << bad;
    } catch (const std::runtime_error& e) {
      EXPECT_THAT(e.what(), ::testing::StartsWith("file:3: ")) << bad;
    }
    EXPECT_EQ(read.reset_count, 0u);
  }
}

// Property over 2000 seeded texts with one byte changed or cut off: read or refused, nothing else.
TEST(HandOver, DamageIsReadOrRefused) {
  const auto good = write_hand_over(example(), "b");
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    auto text = good;
    if (i % 2 == 0)
      text[random() % text.size()] = static_cast<char>(random());
    else
      text.resize(random() % text.size());
    HandOver read;
    try {
      read_hand_over(text, "file", "b", read);
    } catch (const std::runtime_error& e) {
      ASSERT_THAT(e.what(), ::testing::StartsWith("file:"));
    }
  }
}

}  // namespace
}  // namespace trunnion::channel
