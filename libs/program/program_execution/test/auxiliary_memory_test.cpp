// SPDX-License-Identifier: Apache-2.0
// The state that a program's auxiliary functions add up to.
#include "program_execution/auxiliary_memory.hpp"

#include <gtest/gtest.h>

namespace trunnion::program_execution {
namespace {

using language::Command;
using language::CommandKind;

Command auxiliary(std::uint32_t m) {
  Command command;
  command.kind = CommandKind::auxiliary;
  command.number = m;
  return command;
}

using Codes = std::vector<std::pair<AuxiliaryKind, std::uint32_t>>;
using enum AuxiliaryKind;

Codes codes(const std::vector<AuxiliaryFunction>& functions) {
  Codes list;
  for (const auto& function : functions) list.emplace_back(function.kind, function.code);
  return list;
}

TEST(AuxiliaryMemory, KeepsTheSurfaceSpeedWithItsLimit) {
  AuxiliaryMemory memory;
  Command speed;
  speed.kind = CommandKind::spindle_speed;
  speed.value = 200;
  speed.modal.spindle_mode = language::SpindleMode::surface;
  speed.modal.spindle_limit = 3000;
  memory.pass(speed);
  EXPECT_TRUE(memory.functions().at(0).surface);
  EXPECT_EQ(memory.functions().at(0).value, 200);
  EXPECT_EQ(memory.functions().at(0).limit, 3000);
  speed.value = 795;
  speed.modal.spindle_mode = language::SpindleMode::speed;
  memory.pass(speed);
  EXPECT_FALSE(memory.functions().at(0).surface);
  EXPECT_EQ(memory.functions().at(0).limit, 0);
}

TEST(AuxiliaryMemory, GivesTheFunctionsThatAddUpToTheStateInOneSequence) {
  AuxiliaryMemory memory;
  for (const auto m : {8u, 3u, 7u, 4u, 50u}) memory.pass(auxiliary(m));
  Command speed;
  speed.kind = CommandKind::spindle_speed;
  speed.value = 1200;
  memory.pass(speed);
  EXPECT_EQ(codes(memory.functions()), (Codes{{S, 0}, {M, 4}, {M, 7}, {M, 8}}));
  EXPECT_EQ(memory.functions()[0].value, 1200);
  EXPECT_EQ(memory.not_repeated(), 1u) << "M50 has no state";
  memory.pass(auxiliary(9));
  memory.pass(auxiliary(5));
  EXPECT_EQ(codes(memory.functions()), (Codes{{S, 0}, {M, 5}, {M, 9}}));
}

TEST(AuxiliaryMemory, CountsOrdersAndSignalsThatItDoesNotRepeat) {
  AuxiliaryMemory memory;
  Command signal;
  signal.kind = CommandKind::spindle_order;
  signal.number = 1100;
  memory.pass(signal);
  EXPECT_EQ(memory.not_repeated(), 1u);
  EXPECT_TRUE(memory.functions().empty());
}

TEST(AuxiliaryMemory, KeepsTheAngleOfM19UntilAnotherFunctionOfTheSpindle) {
  AuxiliaryMemory memory;
  auto orient = auxiliary(19);
  orient.value = 90, orient.has_value = true;
  memory.pass(orient);
  ASSERT_EQ(codes(memory.functions()), (Codes{{M, 19}}));
  EXPECT_TRUE(memory.functions()[0].has_value);
  EXPECT_EQ(memory.functions()[0].value, 90);
  memory.pass(auxiliary(19));
  EXPECT_FALSE(memory.functions()[0].has_value);
}

TEST(AuxiliaryMemory, GivesOnlyTheGroupsAgainThatWereChangedMeanwhile) {
  AuxiliaryMemory program, by_hand;
  program.pass(auxiliary(3));
  program.pass(auxiliary(8));
  EXPECT_TRUE(program.functions_changed_by(by_hand).empty());
  by_hand.pass(auxiliary(5));
  EXPECT_EQ(codes(program.functions_changed_by(by_hand)), (Codes{{M, 3}}));
  by_hand.pass(auxiliary(7));  // mist, which the program does not want: both off, flood on again
  EXPECT_EQ(codes(program.functions_changed_by(by_hand)), (Codes{{M, 9}, {M, 3}, {M, 8}}));
}

}  // namespace
}  // namespace trunnion::program_execution
