// SPDX-License-Identifier: Apache-2.0
// The cross reference, and warnings of what two tasks write.
#include <gmock/gmock.h>

#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"
#include "plcopen_documents.hpp"

namespace trunnion::st {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> lines_of(const std::string& source) {
  return compile({{"t.st", source}}, interface_registers()).lines();
}

/// The bodies of fast (line 3) and main (line 6).
std::string tasks(const std::string& fast, const std::string& main, const std::string& before = "") {
  return before + "\nPROGRAM fast\n" + fast + "\nEND_PROGRAM\nPROGRAM main\n" + main +
         "\nEND_PROGRAM\nVAR_GLOBAL g : WORD; END_VAR\n";
}

TEST(TaskWrites, AreNamedWithBothPlaces) {
  EXPECT_THAT(
      lines_of(tasks("g := 1;", "g := 2;")),
      ElementsAre(
          "t.st:6:1: warning: 'g' is written by the tasks main and fast (t.st:3:1): the one that runs "
          "last decides"));
  EXPECT_THAT(
      lines_of(tasks("g := 1; %Y9.0 := TRUE;", "%Y9.0 := FALSE;")),
      ElementsAre(
          "t.st:6:1: warning: the register %Y9.0 is written by the tasks main and fast (t.st:3:9): the "
          "one that runs last decides"));
}

TEST(TaskWrites, OfAWholeRegisterAreNamed) {
  EXPECT_THAT(lines_of("PROGRAM fast\n%R5 := 1;\nEND_PROGRAM\nPROGRAM main\n%R5 := 2;\nEND_PROGRAM\n"),
              ElementsAre("t.st:5:1: warning: the register %R5 is written by the tasks main and fast "
                          "(t.st:2:1): the one that runs last decides"));
}

TEST(TaskWrites, AreFoundThroughNamesPartsAndBlocks) {
  const std::string expected = "is written by the tasks main and fast (t.st:";
  for (const auto& [fast, main] :
       {std::pair{"%W9 := 1;", "VAR w AT %W9 : WORD; END_VAR\nw := 2;"},  // a name of the register
        {"VAR_EXTERNAL g : WORD; END_VAR\ng := 1;", "g := 2;"},           // VAR_EXTERNAL
        {"%R9 := 1;", "%R9.3 := TRUE;"},                                  // a bit of it
        {"g.%X3 := TRUE;", "g.%B0 := 7;"},                                // parts that overlap
        {"%W11 := 1;", "VAR w AT %W10 : ARRAY[0..3] OF UINT; i : INT; END_VAR\nw[i] := 2;"},  // any element
        {"Put(x := g);", "Put(x := g);"},        // in a function that both call
        {"shared(x := 1);", "shared(x := 2);"},  // a block of both
        {"Get(x => g);", "g := 1;"},             // an output
        {"Change(x := g);", "g := 1;"}})         // VAR_IN_OUT
    EXPECT_THAT(lines_of(tasks(fast, main,
                               "FUNCTION Put VAR_INPUT x : WORD; END_VAR g := x; END_FUNCTION "
                               "FUNCTION Get VAR_OUTPUT x : WORD; END_VAR x := 1; END_FUNCTION "
                               "FUNCTION Change VAR_IN_OUT x : WORD; END_VAR x := 1; END_FUNCTION "
                               "FUNCTION_BLOCK Keep VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK "
                               "VAR_GLOBAL shared : Keep; END_VAR")),
                ElementsAre(HasSubstr(expected)))
        << fast << " " << main;
}

TEST(TaskWrites, OfDifferentPartsAndOfOneTaskAreNone) {
  for (const auto& [fast, main] : {std::pair{"g := 1;", "VAR i : WORD; END_VAR\ni := g;"},
                                   {"%R9.0 := TRUE;", "%R9.3 := TRUE;"},
                                   {"g.%X3 := TRUE;", "g.%B1 := 7;"},
                                   {"g := 1; g := 2;", ""},
                                   {"VAR w AT %W11 : UINT; END_VAR\nw := 1;",
                                    "VAR w AT %W10 : ARRAY[0..3] OF UINT; END_VAR\nw[0] := 2;"}})
    EXPECT_THAT(lines_of(tasks(fast, main)), IsEmpty()) << fast << " " << main;
}

std::string described(const Compilation& compilation, const std::string& name) {
  for (const auto& entry : compilation.references) {
    if (entry.name != name) continue;
    auto text = entry.type + entry.location;
    for (const auto& one : entry.names) text += "," + one;
    for (const auto& use : entry.uses)
      text += " " + std::to_string(use.at.line) + ":" + std::to_string(use.at.column) +
              (use.reads ? "r" : "") + (use.writes ? "w" : "") + (use.calls ? "c" : "");
    return text;
  }
  return "none";
}

TEST(CrossReference, HasEveryPlaceOfVariablesAndRegisters) {
  const auto result =
      compile({{"t.st",
                "VAR_GLOBAL total : INT; END_VAR\n"
                "PROGRAM main\n"
                "VAR t : TON; a : ARRAY[0..3] OF INT; i : INT; door AT %X9.0 : BOOL; END_VAR\n"
                "t(IN := door, PT := T#1s);\n"
                "IF t.Q AND %X9.0 THEN\n"
                "  a[i] := a[i] + total;\n"
                "END_IF;\n"
                "FOR i := 0 TO 3 DO Raise(x := a[i]); END_FOR;\n"
                "END_PROGRAM\n"
                "FUNCTION Raise\nVAR_IN_OUT x : INT; END_VAR\nx := x + 1;\nEND_FUNCTION\n"}},
              interface_registers());
  ASSERT_TRUE(result.good()) << testing::PrintToString(result.lines());
  EXPECT_EQ(described(result, "total"), "INT 6:18r");
  EXPECT_EQ(described(result, "main.t"), "TON 4:1c 5:4r");
  EXPECT_EQ(described(result, "main.a"), "ARRAY[0..3] OF INT 6:3w 6:11r 8:31rw");
  EXPECT_EQ(described(result, "main.i"), "INT 6:5r 6:13r 8:5w 8:33r");
  EXPECT_EQ(described(result, "main.door"), "BOOL%X9.0 4:9r");
  EXPECT_EQ(described(result, "%X9.0"), ",main.door 4:9r 5:12r");
  EXPECT_EQ(described(result, "Raise.x"), "INT 12:1w 12:6r");
}

TEST(CrossReference, NamesTheElementsOfADiagram) {
  DiagramText d;
  const auto rail = d.rail();
  d.coil("%Y9.1", {d.contact("%X9.1", {rail})});
  const auto result =
      compile({{"l.xml", project(pou("main", "program", "", d.ladder()))}}, interface_registers());
  ASSERT_TRUE(result.good()) << testing::PrintToString(result.lines());
  ASSERT_EQ(result.references.size(), 2u);
  EXPECT_EQ(result.references[0].name, "%X9.1");
  ASSERT_EQ(result.references[1].uses.size(), 1u);
  EXPECT_TRUE(result.references[1].uses[0].writes);
  EXPECT_EQ(result.references[1].uses[0].element, "POU 'main', network 1, coil with localId 3");
}

}  // namespace
}  // namespace trunnion::st
