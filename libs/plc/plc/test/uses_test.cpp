// SPDX-License-Identifier: Apache-2.0
// The places that use a variable, by its path while the programs run.
#include <gtest/gtest.h>

#include "plc/library/register_names.hpp"
#include "plc/tools/uses.hpp"

namespace trunnion::st {
namespace {

std::string described(const std::vector<SourceUse>& uses) {
  std::string text;
  for (const auto& [file, use] : uses)
    text += (text.empty() ? "" : " ") + file + ":" + std::to_string(use.at.line) + ":" +
            std::to_string(use.at.column) + (use.reads ? "r" : "") + (use.writes ? "w" : "") +
            (use.calls ? "c" : "");
  return text;
}

const char* const conveyor_sources =
    "FUNCTION_BLOCK Changer\n"                                      // 1
    "VAR_INPUT limit : INT; END_VAR\n"                              // 2
    "VAR_OUTPUT place : INT; END_VAR\n"                             // 3
    "IF place < limit THEN place := place + 1; END_IF;\n"           // 4
    "END_FUNCTION_BLOCK\n"                                          // 5
    "TYPE Pair : STRUCT a : INT; b : INT; END_STRUCT; END_TYPE\n"   // 6
    "VAR_GLOBAL shared : Pair; END_VAR\n"                           // 7
    "PROGRAM main\n"                                                // 8
    "VAR left, right : Changer; list : ARRAY[1..2] OF Changer;\n"   // 9
    "    i : INT; door AT %X9.0 : BOOL; END_VAR\n"                  // 10
    "left(limit := 3);\n"                                           // 11
    "shared.a := left.place; shared.b := right.place;\n"            // 12
    "FOR i := 1 TO 2 DO list[i](limit := i); END_FOR;\n"            // 13
    "IF door AND NOT emergency_stop THEN %Y9.1 := TRUE; END_IF;\n"  // 14
    "IF %X9 > 3 THEN i := list[2].limit + shared.a; END_IF;\n"      // 15
    "END_PROGRAM\n";                                                // 16

Compilation compiled() {
  auto result = compile({{"m.st", conveyor_sources}}, interface_registers());
  EXPECT_TRUE(result.good()) << testing::PrintToString(result.lines());
  return result;
}

TEST(Uses, OfAVariableInABlockAreThoseInTheBlockAndThoseThatNameItsInstance) {
  const Uses uses(compiled());
  EXPECT_EQ(described(uses.of("main.left.place")), "m.st:4:4r m.st:4:23w m.st:4:32r m.st:11:1c m.st:12:13r");
  EXPECT_EQ(described(uses.of("main.right.place")), "m.st:4:4r m.st:4:23w m.st:4:32r m.st:12:37r");
  EXPECT_EQ(described(uses.of("left.limit")), "m.st:4:12r m.st:11:1c") << "without its program";
  EXPECT_EQ(described(uses.of("main.list[2].limit")), "m.st:4:12r m.st:13:20c m.st:15:22r");
  EXPECT_EQ(described(uses.of("Changer.limit")), "m.st:4:12r") << "as the cross reference names it";
}

TEST(Uses, OfAnInputWithAnEdgeAreThoseInTheBody) {
  const Uses uses(
      compile({{"m.st",
                "FUNCTION_BLOCK Press\nVAR_INPUT up : BOOL R_EDGE; END_VAR\nVAR_OUTPUT n : INT; END_VAR\n"
                "IF up THEN n := n + 1; END_IF;\nEND_FUNCTION_BLOCK\n"
                "PROGRAM main\nVAR p : Press; END_VAR\np(up := TRUE);\nEND_PROGRAM\n"}},
              interface_registers()));
  EXPECT_EQ(described(uses.of("Press.up")), "m.st:2:21r m.st:4:4r") << "the call of its R_TRIG is at R_EDGE";
}

TEST(Uses, OfAFieldLeaveOutTheOtherFields) {
  const Uses uses(compiled());
  EXPECT_EQ(described(uses.of("shared.a")), "m.st:12:1w m.st:15:38r");
  EXPECT_EQ(described(uses.of("shared.b")), "m.st:12:25w");
  EXPECT_EQ(described(uses.of("shared")), "m.st:12:1w m.st:12:25w m.st:15:38r");
}

TEST(Uses, OfARegisterHaveItsBitsItsNamesAndTheVariableAtIt) {
  const Uses uses(compiled());
  for (const char* path : {"%X9.0", "main.door", "%x9.0"})
    EXPECT_EQ(described(uses.of(path)), "m.st:14:4r m.st:15:4r") << path;
  EXPECT_EQ(described(uses.of("%X9.1")), "m.st:15:4r") << "the whole byte is read";
  EXPECT_EQ(described(uses.of("%X9")), "m.st:14:4r m.st:15:4r");
  EXPECT_EQ(described(uses.of("emergency_stop")), "m.st:14:17r");
  EXPECT_EQ(described(uses.of("%Y9.1")), "m.st:14:37w");
  EXPECT_EQ(described(uses.of("%Y9.2")), "");
}

TEST(Uses, OfAnInstructionListAreAmongThem) {
  const auto compilation =
      compile({{"m.st", conveyor_sources},
               {"fast.il",
                "VAR\n  lamp AT Y9.1 : BOOL\nEND_VAR\nLD X9.0\nANDN emergency_stop\nST lamp\n"
                "LD G7\nADD 1\nST %W3\n"}},
              interface_registers());
  ASSERT_TRUE(compilation.good()) << testing::PrintToString(compilation.lines());
  const Uses uses(compilation);
  EXPECT_EQ(described(uses.of("%X9.0")), "m.st:14:4r m.st:15:4r fast.il:4:4r");
  EXPECT_EQ(described(uses.of("%Y9.1")), "m.st:14:37w fast.il:6:4w");
  EXPECT_EQ(described(uses.of("%G7")), "fast.il:7:4r");
  EXPECT_EQ(described(uses.of("%W3")), "fast.il:9:4w");
  std::vector<std::string> registers;
  for (const auto& one : compilation.references)
    if (one.name.starts_with('%')) registers.push_back(one.name);
  const auto at = std::find(registers.begin(), registers.end(), "%Y9.1");
  ASSERT_NE(at, registers.end());
  EXPECT_EQ(std::count(registers.begin(), registers.end(), "%Y9.1"), 1);
  EXPECT_EQ(registers.front(), "%X9");
  EXPECT_EQ(registers.back(), "%W3") << "in the order of the areas";
}

TEST(Uses, OfWhatDoesNotExistAreRefusedInOneLine) {
  const Uses uses(compiled());
  for (const char* path : {"nothing", "main.nothing", "%X9.9", "%Q", "", "main."}) {
    try {
      EXPECT_EQ(described(uses.of(path)), "none") << path;
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << path;
    }
  }
}

}  // namespace
}  // namespace trunnion::st
