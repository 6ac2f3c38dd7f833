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

std::vector<std::pair<int, int>> codes(const std::vector<AuxiliaryFunction>& functions) {
  std::vector<std::pair<int, int>> list;
  for (const auto& function : functions) list.emplace_back(static_cast<int>(function.kind), function.code);
  return list;
}

TEST(AuxiliaryMemory, GivesTheFunctionsThatAddUpToTheStateInOneSequence) {
  AuxiliaryMemory memory;
  for (const auto m : {8u, 3u, 7u, 4u, 50u}) memory.pass(auxiliary(m));
  Command speed;
  speed.kind = CommandKind::spindle_speed;
  speed.value = 1200;
  memory.pass(speed);
  EXPECT_EQ(codes(memory.functions()), (std::vector<std::pair<int, int>>{{2, 0}, {1, 4}, {1, 7}, {1, 8}}));
  EXPECT_EQ(memory.functions()[0].value, 1200);
  EXPECT_EQ(memory.not_repeated(), 1u) << "M50 has no state";
  memory.pass(auxiliary(9));
  memory.pass(auxiliary(5));
  EXPECT_EQ(codes(memory.functions()), (std::vector<std::pair<int, int>>{{2, 0}, {1, 5}, {1, 9}}));
}

TEST(AuxiliaryMemory, GivesOnlyTheGroupsAgainThatWereChangedMeanwhile) {
  AuxiliaryMemory program, by_hand;
  program.pass(auxiliary(3));
  program.pass(auxiliary(8));
  EXPECT_TRUE(program.functions_changed_by(by_hand).empty());
  by_hand.pass(auxiliary(5));
  EXPECT_EQ(codes(program.functions_changed_by(by_hand)), (std::vector<std::pair<int, int>>{{1, 3}}));
  by_hand.pass(auxiliary(7));  // mist, which the program does not want: both off, flood on again
  EXPECT_EQ(codes(program.functions_changed_by(by_hand)),
            (std::vector<std::pair<int, int>>{{1, 9}, {1, 3}, {1, 8}}));
}

}  // namespace
}  // namespace trunnion::program_execution
