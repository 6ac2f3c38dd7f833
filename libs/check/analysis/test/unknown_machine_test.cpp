// SPDX-License-Identifier: Apache-2.0
// What a check grants a program when no machine is named, and says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"
#include "analysis/program_summary.hpp"
#include "analysis/rotary_words.hpp"

namespace trunnion::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string name_of_any(std::uint32_t) { return "part.nc"; }

/// As `trunnion check`, with or without --summary.
std::string checked(const std::string& program, bool summary = false) {
  language::StringSource source(program);
  DefaultMachine machine({});
  machine.rotary_axes = rotary_words(source);
  std::ostringstream out;
  const bool good = summary ? summarize_program(source, machine, {}, {}, name_of_any, out)
                            : check_program(source, machine, {}, {}, name_of_any, out);
  return (good ? "good\n" : "bad\n") + out.str();
}

constexpr const char* prelude_of_any = "G21 G90 G54 G17\n";

TEST(UnknownMachine, MCodesOfBuildersAreForTheLogic) {
  const std::string program = std::string(prelude_of_any) + "M165 P9832\nM22\nM8\nM72 Q1 R2 H3\nM22\nM30\n";
  for (const bool summary : {false, true}) {
    const auto text = checked(program, summary);
    EXPECT_THAT(text, testing::StartsWith("good\n"));
    EXPECT_THAT(text, HasSubstr(summary ? "\nm codes  M165 M22 M72: for the logic"
                                        : "\nm codes  M22 M72 M165: for the logic"));
    EXPECT_THAT(checked(std::string(prelude_of_any) + "M8\nM30\n", summary), Not(HasSubstr("m codes")));
  }
  // Those of the control have the words that they have, and axes move.
  EXPECT_THAT(checked("M8 P1\n"), HasSubstr("1107: word has no meaning in this block: P1"));
  EXPECT_THAT(checked("M22 E1\n"), HasSubstr("1107: word has no meaning in this block: E1"));
  EXPECT_THAT(checked("M22 U5\n"), HasSubstr("1109: channel does not have this axis: U5"));
}

TEST(UnknownMachine, FurtherReferencesAreTheFirst) {
  EXPECT_THAT(checked(std::string(prelude_of_any) + "G0 X5 Z9\nG91 G30 P4 X0 Z0\nM30\n"),
              testing::StartsWith("good\n"));
}

TEST(UnknownMachine, TheControlHasItsMacros) {
  DefaultMachine machine({});
  for (const char* macro : {"O9810", "O90120", "O90370", "O90800"})
    EXPECT_NE(machine.subprogram(macro), nullptr) << macro;
  EXPECT_EQ(machine.subprogram("O9021"), nullptr);
  language::StringSource own("O90120\nM99\n");
  machine.resolve = [&](std::string_view) { return &own; };
  EXPECT_EQ(machine.subprogram("O90120"), &own) << "a stored one goes before it";
}

TEST(UnknownMachine, RotaryAxesAreThoseThatTheProgramNames) {
  const auto text = checked(std::string(prelude_of_any) + "G0 X1 A0.\nG1 X5 A-90. F100\nM30\n");
  EXPECT_THAT(text, testing::StartsWith("good\n"));
  EXPECT_THAT(text, HasSubstr("\nrotary   A: words without kinematics, since no machine is named\n"));
  EXPECT_THAT(text, HasSubstr("\nA        -90.0000 .. 0.0000 (machine)\n"));
  EXPECT_THAT(checked(std::string(prelude_of_any) + "G0 X1\nM30\n"), Not(HasSubstr("rotary")));
  EXPECT_THAT(checked("G0 X1 A5\nU3\n"), HasSubstr("1109: channel does not have this axis: U3"));
}

std::uint16_t rotary_of(const char* text) {
  language::StringSource source(text);
  return rotary_words(source);
}

TEST(RotaryWords, AreThoseOfAxes) {
  constexpr std::uint16_t a = 1u << language::A, b = 1u << language::B, c = 1u << language::C;
  EXPECT_EQ(rotary_of("G0 X1\n"), 0);
  EXPECT_EQ(rotary_of("G0X1A5\nB-.5\nG1 c#1\n"), a | b | c);
  EXPECT_EQ(rotary_of("N10 A[#1+2]\r\nC + 5"), a | c);
  for (const char* none : {"(A5)", "; A5", "G65 P9000 A1 B2 C3", "g66.1 P1 A1", "#1=ABS[#2]", "G1 X5 ,C2",
                           "X1 ,A30", "IF [#1 EQ 5] GOTO 10", "(C1 (A2)) X5", "A", "WHILE [#1 LT 5] DO 1",
                           "DPRNT[A#1[53] C5]", "CYCLE800(1,\"A1\")"})
    EXPECT_EQ(rotary_of(none), 0) << none;
}

}  // namespace
}  // namespace trunnion::analysis
