// SPDX-License-Identifier: Apache-2.0
// The form of programs: heads, what stands in front of them and behind their end, block skip, numbers, and
// words that controls read in different ways.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

using Stream = std::vector<std::string>;

std::vector<std::string> stream_of(const std::string& text, SkipLevels skip = 0) {
  TestMachine machine;
  return stream(run(machine, text, {}, {}, InterpreterOptions{skip, true}));
}

std::string nul(std::size_t count) { return std::string(count, '\0'); }

TEST(ProgramText, HeadsOfAnyFormBeginAProgram) {
  for (const char* head : {":1000 (COLON)",
                           ": 1000",
                           "O1000(NAME)",
                           "o1000",
                           "O 1000",
                           "O00000001",
                           "%1000",
                           "%O1000(NAME)",
                           "% :1000",
                           "%\nO1000",
                           "% TITLE 12\nO1000",
                           "% (TITLE) REV B\r\n:1000",
                           "(c)\n\n  (d) O1000 (e)",
                           "(c) :1000",
                           "(c) %",
                           "<NAME-1>",
                           "O<NAME.2> (c)",
                           "%\n<NAME>",
                           "\xef\xbb\xbf%\nO1000",
                           "/1 O1000",
                           "\x11%\x13\nO1000"})
    EXPECT_EQ(stream_of(std::string(head) + "\nG0 X1\nM30\n%\n"), (Stream{"rapid X1", "end 30"})) << head;
}

TEST(ProgramText, ColonAndCommentAreFoundByCallsAndTheNumberIsThatOfTheProgram) {
  EXPECT_THAT(stream_of("M98 P20\nM98 P30\nM98 P40\nM30\n:20\nX1\nM99\n(c) O30\nX2\nM99\n%O40\nX3\nM99\n"),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "end 30"));
  EXPECT_THAT(stream_of(":1234\nX#4115\n"), ElementsAre("rapid X1234", "end 0"));
}

TEST(ProgramText, WhatStandsInFrontOfTheMarkOfTheTapeIsPassed) {
  const std::string program = "%\nO1000\nG0 X1\nM30\n%\n";
  for (const std::string& leader :
       {nul(4), nul(4) + "\r\n" + nul(2), std::string("\x11\x13"), std::string("~\x7f\xff{"),
        std::string("PART 12\n"), std::string("2024-05-01 LIST\r(c)\r\r"), std::string("50% OFF\n"),
        std::string("(not closed\n"), nul(3) + "TEXT\n" + nul(2) + "\n"})
    EXPECT_EQ(stream_of(leader + program), (Stream{"rapid X1", "end 30"})) << leader;
  EXPECT_EQ(stream_of("$FLANGE.MIN%\r\nO1000\r\nG0 X1\r\n"), (Stream{"rapid X1", "end 0"})) << "Okuma's";
  EXPECT_EQ(stream_of(nul(3) + "O1000\nG0 X1\n"), (Stream{"rapid X1", "end 0"}))
      << "blank tape needs no mark";
}

// As posts write it for the operator, who enters the number.
TEST(ProgramText, OAndANameBehindTheMarkIsAHead) {
  for (const char* head :
       {"ONONAME ( BANDB_MFG )", "OWASHER(Washer)", "opart-1_a", "OFinal ToolPath", "O ENTER LAST 3 DIGITS"})
    EXPECT_THAT(stream_of("%\n(POST)\n\n" + std::string(head) + "\nG0 X1\nM30\n%\n"),
                ElementsAre("rapid X1", "end 30"))
        << head;
  EXPECT_THAT(stream_of("%\nONAME\nG0 X1\nGOTO 5\nX9\nN5 X2\n%\nX3\n"),
              ElementsAre("rapid X1", "rapid X2", "end 0"));
  // Without the mark, behind a block, with more in the line, and a word of another control.
  EXPECT_THAT(stream_of("ONAME\nG0 X1\n"), ElementsAre("alarm 1005 1:1"));
  EXPECT_THAT(stream_of("%\nG0 X1\nONAME\nX2\n"), ElementsAre("rapid X1", "alarm 1005 3:1"));
  EXPECT_THAT(stream_of("%\nONAME G0 X1\n"), ElementsAre("alarm 1005 2:1"));
  EXPECT_THAT(stream_of("%\nO PART X5\nG0 X1\n"), ElementsAre("alarm 1005 2:1"));
  EXPECT_THAT(stream_of("%\nORIWKS\nG0 X1\n"), ElementsAre("alarm 1540 2:1"));
}

TEST(ProgramText, NothingThatCouldBeABlockIsPassed) {
  // 1011: unknown instruction, 1003: unknown character, 1002: no UTF-8, all at the begin of the first line.
  EXPECT_THAT(stream_of("TITLE\nG0 X1\nM30\n%\n"), ElementsAre("alarm 1011 1:1"));
  EXPECT_THAT(stream_of("GO X5\nG1 Z-5 F1\nM30\n%\nG0 X2\n"), ElementsAre("alarm 1011 1:1"));
  EXPECT_THAT(stream_of("TITLE\nO1\nG0 X1\n%\nG0 X2\n"), ElementsAre("alarm 1011 1:1"));
  EXPECT_THAT(stream_of("TITLE\nWHILE [#1 LT 2]\n%\nG0 X2\n"), ElementsAre("alarm 1011 1:1"));
  EXPECT_THAT(stream_of("~G0 X1\n%\nG0 X2\n"), ElementsAre("alarm 1003 1:1"));
  EXPECT_THAT(stream_of("G0 X1\nTEXT\n%\nX2\n"), ElementsAre("rapid X1", "alarm 1011 2:1"));
}

// Two bytes a character, bytes that were never written, or nothing but text.
TEST(ProgramText, AProgramThatCannotBeReadDoesNotEndWithoutAWord) {
  std::string wide = "\xff\xfe";
  for (const char c : std::string("%\r\nO1\r\nG0 X1\r\nM30\r\n%\r\n")) wide += std::string(1, c) + nul(1);
  EXPECT_THAT(stream_of(wide), ElementsAre("alarm 1002 1:1"));
  EXPECT_THAT(stream_of(nul(4096)), ElementsAre("alarm 1003 1:1"));
  EXPECT_THAT(stream_of("TITLE\n%\n"), ElementsAre("alarm 1011 1:1"));
  EXPECT_THAT(stream_of("TITLE\n%\n%\n(c)\n"), ElementsAre("alarm 1011 1:1"));
  std::string long_leader;
  while (long_leader.size() < 20000) long_leader += "TEXT\n";
  EXPECT_THAT(stream_of(long_leader + "%\nG0 X1\n"), ElementsAre("alarm 1011 1:1"));
  EXPECT_THAT(stream_of("G0 X1\nX" + nul(3) + "2\n"), ElementsAre("rapid X1", "alarm 1005 2:1"));
}

TEST(ProgramText, M99GoesBackToTheMarkAndChunksChangeNothing) {
  TestMachine machine;
  const std::string text = nul(3) + "TEXT\r\n" + nul(5) + "%\r\nG0 X1\nX2\nM99\n";
  SlowSource slow(text, 1);
  const Interpretation result = run(machine, slow, {}, {}, {}, 5);
  EXPECT_THAT(stream(result), ElementsAre("rapid X1", "rapid X2", "rapid X1", "rapid X2", "rapid X1"));
  ASSERT_EQ(result.commands.size(), 5u);
  EXPECT_EQ(result.commands[0].line, 3u) << "lines count from the begin of the text";
}

TEST(ProgramText, WhatStandsBehindTheLastMarkIsNotRead) {
  EXPECT_THAT(stream_of("%\nG0 X1\n%\nthis is \xff @ text\nX2\n"), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(stream_of("%\nG0 X1\nM30\n% END\n" + nul(9)), ElementsAre("rapid X1", "end 30"));
}

TEST(ProgramText, CharactersOfATransmissionMeanNothing) {
  EXPECT_THAT(
      stream_of("G0 X1\x11 Y2\x13\nX3\x04\n\x0cN10 X4\nGOTO 20\nX9\n\x0c\x11N20 X5\n#1=6 \x13\nX#1\x1a"),
      ElementsAre("rapid X1 Y2", "rapid X3 Y2", "rapid X4 Y2", "rapid X5 Y2", "rapid X6 Y2", "end 0"));
}

TEST(ProgramText, BlockSkipAnywhereAndOfSeveralLevels) {
  const std::string text = "G0 X1 /2 Y1\n/1/3 X2\nX3 / Y3\nN7 /2 X4\n";
  EXPECT_THAT(stream_of(text),
              ElementsAre("rapid X1 Y1", "rapid X2 Y1", "rapid X3 Y3", "rapid X4 Y3", "end 0"));
  EXPECT_THAT(stream_of(text, 0b1), ElementsAre("rapid X1 Y1", "rapid X3 Y1", "rapid X4 Y1", "end 0"));
  EXPECT_THAT(stream_of(text, 0b10), ElementsAre("rapid X1", "rapid X2", "rapid X3 Y3", "end 0"));
  EXPECT_THAT(stream_of(text, 0b100), ElementsAre("rapid X1 Y1", "rapid X3 Y3", "rapid X4 Y3", "end 0"));
}

TEST(ProgramText, InstructionsOfTwoLetters) {
  EXPECT_THAT(stream_of("O4 (WH)\n#1=0\nWH[#1LT3]DO1\n#1=#1+1\nEN1\nIF [#1 EQ 3] TH #2=5\nG0 X#1 Y#2\nM30\n"),
              ElementsAre("rapid X3 Y5", "end 30"));
  EXPECT_THAT(stream_of("wh[0]do1\nX9\nen1\nX1\nIF[0]TH\nX8\nELSEIF[1]TH\nX3\nENDIF\nIF[#1EQ4]THX7\n"),
              ElementsAre("rapid X1", "rapid X3", "alarm 1013 10:10"));
  EXPECT_THAT(stream_of("GO 10\nN10\n"), ElementsAre("alarm 1011 1:1")) << "GO is too near to G0";
}

TEST(ProgramText, FormsOfNumbers) {
  for (const auto& [word, value] : {std::pair{"X.5", "0.5"},
                                    {"X5.", "5"},
                                    {"X+5", "5"},
                                    {"X-.5", "-0.5"},
                                    {"X - .5", "-0.5"},
                                    {"x 1 . 5", "1.5"},
                                    {"X1. 5", "1.5"},
                                    {"X1 .5", "1.5"},
                                    {"X\t0007.250", "7.25"},
                                    {"N123456789 X1", "1"},
                                    {"n0005x1", "1"}})
    EXPECT_EQ(stream_of("g00 " + std::string(word) + "\n")[0], "rapid X" + std::string(value)) << word;
  for (const auto& [line, alarm] : {std::pair{"G0 X--5", "alarm 1005 1:4"},
                                    {"G0 X+-5", "alarm 1005 1:4"},
                                    {"G0 X5 5", "alarm 1003 1:7"},
                                    {"G0 X1.5 5", "alarm 1003 1:9"},
                                    {"G0 X1.2.3", "alarm 1003 1:8"},
                                    {"G0 X1 -.5", "alarm 1003 1:7"},
                                    {"N1 0 X1", "alarm 1003 1:4"},
                                    {"N X1", "alarm 1005 1:1"},
                                    {"G0 X1e-3", "alarm 1107 1:6"}})
    EXPECT_EQ(stream_of(std::string(line) + "\n"), Stream{alarm}) << line;
}

TEST(ProgramText, AHeadMayHaveACodeOfEachGroup) {
  EXPECT_THAT(stream_of("G00 G17 G21 G40 G49 G50 G54 G64 G69 G80 G90 G94 G97 G98 G15 G50.1 G91.1\nX1\n"),
              ElementsAre("rapid X1", "end 0"));
}

TEST(ProgramText, CommentsOfEveryKindAndLength) {
  EXPECT_THAT(stream_of("(MSG,TOOL 1) G0 (F\xdcR) X1 (\xb0) ; (open ) ( \xe9\n*** (\nY1\n"),
              ElementsAre("rapid X1", "rapid X1 Y1", "end 0"));
  EXPECT_THAT(stream_of("(" + std::string(16000, 'x') + ") X1\n"), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(stream_of("(" + std::string(17000, 'x') + ") X1\n"), ElementsAre("alarm 1001 1:1"));
  EXPECT_THAT(stream_of("X1 (A ( B) Y1\n"), ElementsAre("rapid X1 Y1", "end 0")) << "one ) ends it";
  EXPECT_THAT(stream_of("X1 (A (B)) Y1 ((C) (D) )\n"), ElementsAre("rapid X1 Y1", "end 0"));
  EXPECT_THAT(stream_of("(FROM (48.5, 53.5) TO (59.5, 71) ) X1 (NOT (1) X2) Y1\n"),
              ElementsAre("rapid X1 Y1", "end 0"));
  // What other controls would read is read.
  EXPECT_THAT(stream_of("(A (B) X1 (C)\n"), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(stream_of("X1 (A ((B) Y1 )\n"), ElementsAre("alarm 1174 1:7"));
  EXPECT_THAT(stream_of("X1 (A (B)) Y1 ((C ((D) ) )\n"), ElementsAre("rapid X1 Y1", "end 0"));
  EXPECT_THAT(stream_of("X1 (A (B) ) Y1 ) Z1\n"), ElementsAre("alarm 1003 1:16")) << "of no comment";
}

TEST(ProgramText, G53WithoutAnAxisMovesNothing) {
  EXPECT_THAT(stream_of("G53\nG0 X1\nG53 G0\nG3 G53\nG0 G53 X2\n"),
              ElementsAre("rapid X1", "rapid X2", "end 0"));
}

TEST(ProgramText, ACallNoTimesIsNone) {
  EXPECT_THAT(stream_of("M98 P9 L0\nG0 X1\nM30\nO9\nX9\nM99\n"), ElementsAre("rapid X1", "end 30"));
}

Stream moves_with_lengths(const std::string& text) {
  TestMachine machine;
  machine.lengths = {{1, 50.0}, {2, 60.0}};
  Stream moves = stream(run(machine, text));
  std::erase_if(
      moves, [](const std::string& command) { return !command.starts_with("rapid") && command[0] != 'a'; });
  return moves;
}

TEST(ProgramText, ToolLengthWithoutHIsThatOfTheBlockBeforeWhileTheToolIsTheSame) {
  EXPECT_THAT(moves_with_lengths("G43 H1\nG0 Z5\nG49\nG43 Z6\nG44 Z7\nG49 H0\n"),
              ElementsAre("rapid Z55", "rapid Z56", "rapid Z-43"));
  EXPECT_THAT(moves_with_lengths("T1 M6\nG43 H2 Z1\nT1 M6\nG43 Z2\nH1 Z3\nG43 Z4\n"),
              ElementsAre("rapid Z61", "rapid Z62", "rapid Z53", "rapid Z54"));
  EXPECT_THAT(moves_with_lengths("T1 M6\nG43 H1 Z1\nT2 M6\nG43 H2 Z2\nG49\nG43 Z3\n"),
              ElementsAre("rapid Z51", "rapid Z62", "rapid Z63"));
  EXPECT_THAT(moves_with_lengths("T1 M6\nG43 H1 Z1\nT2 M6\nG43.4\n"),
              ElementsAre("rapid Z51", "alarm 1176 4:1"));
  TestMachine machine;
  machine.lengths = {{1, 50.0}, {2, 60.0}};
  const Interpretation result = run(machine, "G43 H2\nG49\nG43.4\n");
  EXPECT_EQ(result.last, Step::end) << result.alarm.text.data();
  EXPECT_TRUE(result.modal.tip_control());
  EXPECT_EQ(result.modal.tool_length, 60);
}

TEST(ProgramText, TwoToolWordsAreReadAsTheMachineSays) {
  TestMachine machine;
  machine.two_tools = TwoToolWords::last;
  EXPECT_THAT(stream(run(machine, "T01 T02 M06\n")), ElementsAre("T2", "M6", "end 0"));
  EXPECT_EQ(run(machine, "T01 T02 M06\n").modal.tool, 2);
  machine.two_tools = TwoToolWords::change_and_ready;
  const Interpretation result = run(machine, "T01 T02 M06\nT3\n");
  EXPECT_THAT(stream(result), ElementsAre("T1", "M6", "T2", "T3", "end 0"));
  EXPECT_EQ(result.modal.tool, 1);
  EXPECT_THAT(stream(run(machine, "T1 T2\n")), ElementsAre("alarm 1107 1:4"))
      << "no M6, so nothing for the second";
  EXPECT_THAT(stream(run(machine, "T1 T99 M6\n")), ElementsAre("alarm 1709 1:4")) << "no such tool";
}

// About (10, 0): from (0, 0) half a turn to (20, 0), and back.
TEST(ProgramText, CentresAreAbsoluteBehindG901) {
  EXPECT_THAT(
      stream_of("G90.1 G2 X20 Y0 I10 J0 F100\nG3 X0 Y0 I10 J0\nG91.1 G2 X20 I10\nG90.1 G91 G3 X-20 I10 J0\n"),
      ElementsAre("arc X20 cw 10 0 0 180deg F100", "arc ccw 10 0 0 180deg F100",
                  "arc X20 cw 10 0 0 180deg F100", "arc ccw 10 0 0 180deg F100", "end 0"));
  EXPECT_THAT(stream_of("G90.1 G20 G2 X2 Y0 I1 J0 F1\n"),
              ElementsAre("arc X50.8 cw 25.4 0 0 180deg F25.4", "end 0"));
}

}  // namespace
}  // namespace trunnion::language::test
