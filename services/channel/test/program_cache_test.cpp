// SPDX-License-Identifier: Apache-2.0
#include "program_cache.hpp"

#include <gtest/gtest.h>

#include <string>

namespace trunnion::channel {
namespace {

// NUM has programs of one number and several indices.
TEST(ProgramCache, ACallMeansTheProgramOfItsNameWithAnyExtension) {
  const auto found = [](const std::string& stored, const std::string& name) {
    idl::program::ProgramList list;
    list.programs.resize(1);
    list.programs[0].name = stored;
    ProgramCache cache;
    return cache.call(list, name) != nullptr;
  };
  for (const char* stored : {"O9990", "O9990.nc", "O9990.NC", "O9990.ngc", "O9990.txt"})
    EXPECT_TRUE(found(stored, "O9990")) << stored;
  for (const char* stored : {"O9990.9", "O9990.9.nc", "O99901", "O99901.nc", "O999", "o9990", "9990.nc"})
    EXPECT_FALSE(found(stored, "O9990")) << stored;
  EXPECT_TRUE(found("O9990.9", "O9990.9"));
  EXPECT_TRUE(found("O9990.9.nc", "O9990.9"));
  EXPECT_FALSE(found("O9990.nc", "O9990.9"));
}

}  // namespace
}  // namespace trunnion::channel
