// SPDX-License-Identifier: Apache-2.0
#include "program_cache.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace trunnion::channel {
namespace {

// The name of the stored program that a call takes, which is fetched next; empty: none.
std::string called(std::vector<std::string> stored, const char* call) {
  std::sort(stored.begin(), stored.end());  // as the list is
  idl::program::ProgramList list;
  for (const auto& name : stored) {
    auto& entry = list.programs.emplace_back();
    entry.name = name, entry.size = 1;
  }
  ProgramCache cache;
  auto* text = cache.call(list, call);
  if (text == nullptr) return "";
  char buffer[1];
  text->read(0, buffer, sizeof buffer);
  const auto wanted = cache.wanted();
  return wanted ? wanted->name : "nothing is wanted";
}

TEST(ProgramCache, ACallTakesTheProgramOfItsNameWithOrWithoutAnExtension) {
  EXPECT_EQ(called({"O9990"}, "O9990"), "O9990");
  EXPECT_EQ(called({"O9990.nc"}, "O9990"), "O9990.nc");
  EXPECT_EQ(called({"O9990.nc.txt"}, "O9990"), "O9990.nc.txt");
  EXPECT_EQ(called({"O9990", "O9990.nc"}, "O9990"), "O9990") << "the first of the list";
  EXPECT_EQ(called({"9001.nc"}, "9001"), "9001.nc");
  EXPECT_EQ(called({"USERDEF.CYC"}, "USERDEF.CYC"), "USERDEF.CYC");
  for (const char* other : {"O99901", "O99901.nc", "O9990x.nc", "9990.nc", "o9990", "PO9990", "O999"})
    EXPECT_EQ(called({other}, "O9990"), "") << other;
}

// By its name the text may have a dialect of its own.
TEST(ProgramCache, ATextHasTheNameOfItsProgram) {
  idl::program::ProgramEntry entry;
  entry.name = "part.haas";
  ProgramCache cache;
  EXPECT_EQ(cache.open(entry).name(), "part.haas");
  idl::program::ProgramList list;
  list.programs.emplace_back().name = "O9990.ngc";
  EXPECT_EQ(cache.call(list, "O9990")->name(), "O9990.ngc");
}

// Program 9990.9 homes the axis that L0 names: in the place of 9990 it would home another one than the rest.
TEST(ProgramCache, AnIndexOfTheNumDialectIsAnotherProgramAndNoExtension) {
  EXPECT_EQ(called({"O9990.9"}, "O9990"), "");
  EXPECT_EQ(called({"O9990.9.nc"}, "O9990"), "");
  EXPECT_EQ(called({"O9990.9", "O9990.nc"}, "O9990"), "O9990.nc");
  EXPECT_EQ(called({"O9990", "O9990.9"}, "O9990"), "O9990");
  EXPECT_EQ(called({"O9990", "O9990.9"}, "O9990.9"), "O9990.9");
  EXPECT_EQ(called({"O9990.9.nc"}, "O9990.9"), "O9990.9.nc");
  EXPECT_EQ(called({"O9990", "O9990.8", "O9990.nc"}, "O9990.9"), "");
}

}  // namespace
}  // namespace trunnion::channel
