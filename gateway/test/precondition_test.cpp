// SPDX-License-Identifier: Apache-2.0
#include "core/precondition.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

idl::program::ProgramList stored(const std::string& name, std::uint64_t revision) {
  idl::program::ProgramList list;
  list.programs.resize(1);
  list.programs[0].name = name;
  list.programs[0].revision = revision;
  return list;
}

TEST(Precondition, WithoutAConditionEverythingMayBeStored) {
  EXPECT_EQ(Precondition{}.failed(nullptr, "a.nc"), "");
}

TEST(Precondition, IfMatchNamesTheRevisionThatIsStored) {
  const auto list = stored("a.nc", 7);
  EXPECT_EQ((Precondition{"\"7\"", ""}.failed(&list, "a.nc")), "");
  EXPECT_EQ((Precondition{"*", ""}.failed(&list, "a.nc")), "");
  EXPECT_EQ((Precondition{"\"6\"", ""}.failed(&list, "a.nc")),
            "a.nc has revision 7 by now, and the change was made on \"6\"");
  EXPECT_EQ((Precondition{"7", ""}.failed(&list, "a.nc")).empty(), false) << "a tag has quotes";
  EXPECT_EQ((Precondition{"\"7\"", ""}.failed(&list, "b.nc")), "there is no program b.nc");
  EXPECT_NE((Precondition{"\"7\"", ""}.failed(nullptr, "a.nc")), "");
}

TEST(Precondition, WhatWasStoredJustNowCountsBeforeTheListHasIt) {
  const auto list = stored("a.nc", 7);
  EXPECT_NE((Precondition{"\"7\"", ""}.failed(&list, "a.nc", 8)), "");
  EXPECT_EQ((Precondition{"\"8\"", ""}.failed(&list, "a.nc", 8)), "");
  EXPECT_EQ((Precondition{"\"7\"", ""}.failed(&list, "a.nc", 6)), "") << "the list is newer";
  EXPECT_NE((Precondition{"", "*"}.failed(&list, "b.nc", 1)), "");
}

TEST(Precondition, IfNoneMatchWantsANewName) {
  const auto list = stored("a.nc", 7);
  EXPECT_EQ((Precondition{"", "*"}.failed(&list, "b.nc")), "");
  EXPECT_EQ((Precondition{"", "*"}.failed(&list, "a.nc")), "a.nc is stored already, revision 7");
}

TEST(EntityTag, OfParametersChangesWithActiveAndPendingValues) {
  idl::parameters::ParameterSet set;
  set.revision = 5;
  const auto tag = entity_tag(set);
  EXPECT_EQ(entity_tag(set), tag);
  set.pending.push_back({100034, 1, ""});
  const auto pending = entity_tag(set);
  EXPECT_NE(pending, tag);
  set.pending[0].value = 2;
  EXPECT_NE(entity_tag(set), pending) << "another value that waits";
  set.pending.clear();
  EXPECT_EQ(entity_tag(set), tag);
  set.revision = 6;
  EXPECT_NE(entity_tag(set), tag);
}

}  // namespace
}  // namespace trunnion::gateway
