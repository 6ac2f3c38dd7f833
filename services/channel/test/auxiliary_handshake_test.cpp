// SPDX-License-Identifier: Apache-2.0
// The handshake with the PLC by itself.
#include "auxiliary_handshake.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

using program_execution::AuxiliaryKind;
using Outcome = AuxiliaryHandshake::Outcome;

idl::plc::AuxiliaryDone done(std::uint32_t number, bool failed = false) { return {2, number, failed}; }

TEST(AuxiliaryHandshake, NamesTheOpenFunctionAsAProgramWritesIt) {
  AuxiliaryHandshake handshake(2);
  EXPECT_EQ(handshake.function(), "");
  handshake.begin({AuxiliaryKind::M, 6, 0}, 1);
  EXPECT_EQ(handshake.function(), "M6");
  handshake.cancel();
  handshake.begin({AuxiliaryKind::T, 12, 0}, 1);
  EXPECT_EQ(handshake.function(), "T12");
  handshake.cancel();
  handshake.begin({AuxiliaryKind::E, 94125, 24, true}, 1);
  EXPECT_EQ(handshake.function(), "E94125");
  handshake.begin({AuxiliaryKind::E, 0, 90, true}, 1);
  EXPECT_EQ(handshake.function(), "EC");
  handshake.begin({AuxiliaryKind::E, 1003, 0, false}, 1);
  EXPECT_EQ(handshake.function(), "#1003");
  EXPECT_EQ(
      handshake.refusal(),
      "the PLC did not carry out #1003: its programs do not use the register macro_input_2. Correct the "
      "program or the PLC, then reset");
  handshake.begin({AuxiliaryKind::S, 0, 2500}, 1);
  EXPECT_EQ(handshake.function(), "S2500");
  EXPECT_EQ(handshake.refusal(), "the PLC did not carry out S2500. Check the machine, then reset");
}

TEST(AuxiliaryHandshake, RaisesTheStrobeAndLowersItWhenThePlcHasDoneExactlyThisFunction) {
  AuxiliaryHandshake handshake(2);
  EXPECT_FALSE(handshake.take_request());
  handshake.begin({AuxiliaryKind::S, 0, 800}, 1234);
  const auto raised = handshake.take_request();
  ASSERT_TRUE(raised);
  EXPECT_EQ(raised->channel, 2);
  EXPECT_EQ(raised->kind, AuxiliaryKind::S);
  EXPECT_EQ(raised->value, 800);
  EXPECT_EQ(raised->cycle, 1234u);
  EXPECT_FALSE(handshake.take_request()) << "once";
  EXPECT_EQ(handshake.finish(done(raised->number + 1)), Outcome::not_open);
  EXPECT_FALSE(handshake.take_request());
  EXPECT_EQ(handshake.finish(done(raised->number)), Outcome::done);
  const auto lowered = handshake.take_request();
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->kind, AuxiliaryKind::NO_AUXILIARY);
  EXPECT_EQ(lowered->number, raised->number);
  EXPECT_EQ(handshake.finish(done(raised->number)), Outcome::not_open) << "a second answer is stale";
}

TEST(AuxiliaryHandshake, CarriesTheAngleOfM19) {
  AuxiliaryHandshake handshake(0);
  handshake.begin({AuxiliaryKind::M, 19, 90, true}, 7);
  const auto raised = handshake.take_request();
  ASSERT_TRUE(raised);
  EXPECT_TRUE(raised->has_value);
  EXPECT_EQ(raised->value, 90);
  EXPECT_EQ(raised->cycle, 7u);
  EXPECT_EQ(handshake.function(), "M19");
}

TEST(AuxiliaryHandshake, CarriesASurfaceSpeedWithItsLimitAndTheRadius) {
  AuxiliaryHandshake handshake(0);
  handshake.begin({AuxiliaryKind::S, 0, 200, false, true, 3000, 40}, 7);
  const auto raised = handshake.take_request();
  ASSERT_TRUE(raised);
  EXPECT_TRUE(raised->surface);
  EXPECT_EQ(raised->value, 200);
  EXPECT_EQ(raised->limit, 3000);
  EXPECT_EQ(raised->radius, 40);
  EXPECT_FALSE(raised->has_value);
}

TEST(AuxiliaryHandshake, CountsFunctionsAndContinuesBehindThoseOfTheProcessBefore) {
  AuxiliaryHandshake handshake(0);
  handshake.continue_numbers(3);
  handshake.begin({AuxiliaryKind::M, 8, 0}, 0);
  EXPECT_EQ(handshake.take_request()->number, 4u * 4096 + 1);
  handshake.begin({AuxiliaryKind::M, 9, 0}, 0);
  EXPECT_EQ(handshake.take_request()->number, 4u * 4096 + 2);
}

TEST(AuxiliaryHandshake, AFunctionThatFailedLowersTheStrobeToo) {
  AuxiliaryHandshake handshake(0);
  handshake.begin({AuxiliaryKind::T, 5, 0}, 0);
  const auto raised = handshake.take_request();
  EXPECT_FALSE(handshake.function().empty());
  EXPECT_EQ(handshake.finish(done(raised->number, true)), Outcome::failed);
  EXPECT_EQ(handshake.function(), "") << "no longer open";
  EXPECT_EQ(handshake.take_request()->kind, AuxiliaryKind::NO_AUXILIARY);
}

TEST(AuxiliaryHandshake, ACancelLowersAnOpenStrobeOnly) {
  AuxiliaryHandshake handshake(0);
  handshake.cancel();
  EXPECT_FALSE(handshake.take_request());
  handshake.begin({AuxiliaryKind::M, 3, 0}, 0);
  const auto raised = handshake.take_request();
  handshake.cancel();
  EXPECT_EQ(handshake.take_request()->kind, AuxiliaryKind::NO_AUXILIARY);
  EXPECT_EQ(handshake.finish(done(raised->number)), Outcome::not_open);
}

}  // namespace
}  // namespace trunnion::channel
