// SPDX-License-Identifier: Apache-2.0
#include "machine/program_number.hpp"

#include <gtest/gtest.h>

namespace trunnion::machine {
namespace {

TEST(ProgramNumber, OfANameIsTheSameWithAndWithoutLetterZerosAndExtension) {
  for (const char* name : {"O9990", "o9990", "%9990", "9990", "O09990", "O9990.nc", "9990.nc", "O9990.nc.txt",
                           "O9990.0", "O9990.10", "O9990.9th", "O9990."})
    EXPECT_EQ(number_in_name(name), (ProgramNumber{9990, 0})) << name;
  for (const char* name : {"O9990.9", "o9990.9", "%9990.9", "9990.9", "O9990.9.nc"})
    EXPECT_EQ(number_in_name(name), (ProgramNumber{9990, 9})) << name;
  EXPECT_EQ(number_in_name("O99901"), (ProgramNumber{99901, 0}));
  EXPECT_EQ(number_in_name("O123456789"), (ProgramNumber{123456789, 0}));
  for (const char* name :
       {"", "O", "O.9", ".9", "part", "O9990x", "O9990-9", "PO9990", "USERDEF.CYC", "O1234567890"})
    EXPECT_EQ(number_in_name(name), std::nullopt) << name;
}

TEST(ProgramNumber, ProgramsThatTheControlStoresForItselfAreTemporary) {
  EXPECT_TRUE(is_temporary("O99601.tmp.nc"));
  EXPECT_FALSE(is_temporary("part.nc"));
  EXPECT_FALSE(is_temporary("tmp.nc"));
}

TEST(ProgramNumber, OfAHeadNeedsItsLetterAndEndsWhereItsDigitsEnd) {
  EXPECT_EQ(number_in_head("%9990.9(homing)"), (ProgramNumber{9990, 9}));
  EXPECT_EQ(number_in_head("%9990(homing)"), (ProgramNumber{9990, 0}));
  EXPECT_EQ(number_in_head("O100G0"), (ProgramNumber{100, 0}));
  EXPECT_EQ(number_in_head("O100.25"), (ProgramNumber{100, 0})) << "two digits are no index";
  for (const char* text : {"", "9990", "G0", "%", "%(a)", "O1234567890"})
    EXPECT_EQ(number_in_head(text), std::nullopt) << text;
}

}  // namespace
}  // namespace trunnion::machine
