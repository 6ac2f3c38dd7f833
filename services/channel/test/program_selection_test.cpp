// SPDX-License-Identifier: Apache-2.0
// Which program is selected, without a channel core around it.
#include "program_selection.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace trunnion::channel {
namespace {

idl::program::ProgramEntry stored_program(const std::string& name, std::uint64_t revision = 3) {
  idl::program::ProgramEntry entry;
  entry.name = name;
  entry.revision = revision;
  entry.crc32 = static_cast<std::uint32_t>(70 + revision);
  return entry;
}

struct Selection : ::testing::Test {
  void store(std::initializer_list<idl::program::ProgramEntry> entries) {
    idl::program::ProgramList list;
    list.programs = entries;
    selection.set_programs(list);
  }
  const std::string& selected() const { return selection.selected().name; }
  ProgramSelection selection;
};

TEST_F(Selection, IsOfAStoredProgramOnly) {
  store({stored_program("a.nc")});
  EXPECT_FALSE(selection.select("b.nc"));
  EXPECT_EQ(selected(), "");
  EXPECT_TRUE(selection.select("a.nc"));
  EXPECT_EQ(selected(), "a.nc");
}

TEST_F(Selection, KeepsAProgramAsItWasUntilItIsRenewedAndThatIsDeleted) {
  store({stored_program("a.nc")});
  selection.select("a.nc");
  store({stored_program("a.nc", 4)});
  EXPECT_EQ(selection.selected().revision, 3u);
  selection.renew();
  EXPECT_EQ(selection.selected().revision, 4u);
  store({});
  selection.renew();
  EXPECT_EQ(selected(), "a.nc");
}

TEST_F(Selection, ReturnsFromTemporaryProgramsToTheOneBefore) {
  store({stored_program("a.nc"), stored_program("b.tmp.nc"), stored_program("c.tmp.nc")});
  selection.select("a.nc");
  selection.leave_temporary();
  EXPECT_EQ(selected(), "a.nc");
  selection.select("b.tmp.nc");
  selection.select("c.tmp.nc");
  EXPECT_EQ(selection.before_temporary(), "a.nc");
  selection.leave_temporary();
  EXPECT_EQ(selected(), "a.nc");
  EXPECT_EQ(selection.before_temporary(), "");
}

TEST_F(Selection, OfNothingFollowsATemporaryProgramWhenTheOneBeforeIsNoLongerStored) {
  store({stored_program("a.nc"), stored_program("b.tmp.nc")});
  selection.select("a.nc");
  selection.select("b.tmp.nc");
  store({stored_program("b.tmp.nc")});
  selection.leave_temporary();
  EXPECT_EQ(selected(), "");
}

TEST_F(Selection, OfAProgramThatWasLeftNeedsTheSameText) {
  store({stored_program("a.nc", 4)});
  LeftProgram left;
  left.name = "a.nc", left.revision = 3, left.crc = 73;
  EXPECT_FALSE(selection.select(left));
  left.revision = 4;
  EXPECT_FALSE(selection.select(left));
  left.crc = 74;
  EXPECT_TRUE(selection.select(left));
  EXPECT_EQ(selected(), "a.nc");
}

TEST_F(Selection, IsFoundByItsText) {
  store({stored_program("a.nc", 4), stored_program("b.nc", 5)});
  selection.select_text(75, 4);
  EXPECT_EQ(selected(), "");
  selection.select_text(75, 5);
  EXPECT_EQ(selected(), "b.nc");
}

TEST_F(Selection, IsTakenOverFromTheProcessBefore) {
  store({stored_program("a.nc"), stored_program("b.tmp.nc")});
  selection.take_over("b.tmp.nc", "a.nc");
  EXPECT_EQ(selected(), "b.tmp.nc");
  selection.leave_temporary();
  EXPECT_EQ(selected(), "a.nc");
}

}  // namespace
}  // namespace trunnion::channel
