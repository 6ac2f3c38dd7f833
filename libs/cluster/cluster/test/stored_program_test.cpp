// SPDX-License-Identifier: Apache-2.0
#include "cluster/stored_program.hpp"

#include <gtest/gtest.h>

namespace trunnion::cluster {
namespace {

idl::program::ProgramList stored(const std::vector<std::string>& names) {
  idl::program::ProgramList list;
  for (const auto& name : names) list.programs.emplace_back().name = name;
  return list;
}

TEST(StoredPrograms, AreFoundWithAndWithoutTheirEnding) {
  EXPECT_EQ(find_program(stored({"a", "part.nc", "z"}), "part")->name, "part.nc");
  EXPECT_EQ(find_program(stored({"a", "part", "z"}), "part.nc")->name, "part");
  EXPECT_EQ(find_program(stored({"a", "part", "part.nc"}), "part.nc")->name, "part.nc");
  EXPECT_FALSE(find_program(stored({"a", "part.nc", "z"}), "par"));
}

}  // namespace
}  // namespace trunnion::cluster
