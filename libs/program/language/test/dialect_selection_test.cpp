// SPDX-License-Identifier: Apache-2.0
// Which dialect a text is read in: its head, its name, the channel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "language/head_dialect.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test::dialect_selection {
namespace {

using testing::ElementsAre;
using Kind = HeadLine::Kind;

// G4 F2 is a dwell of 2 s in the NUM dialect and alarm 1540 in the ISO dialect, G4 P2000 the same in the ISO
// dialect and alarm 1154 in the NUM dialect.

TestMachine machine_of(ProgramDialect dialect) {
  TestMachine machine;
  machine.dialect = dialect;
  return machine;
}

void store(TestMachine& machine, const char* name, const char* text, std::string_view file = {},
           std::optional<ProgramDialect> own = std::nullopt) {
  machine.programs[name] = std::make_unique<StringSource>(text, file, own);
}

TEST(HeadDialect, IsInACommentOfAnyStyleAndCase) {
  for (const char* line :
       {"(DIALECT: HAAS)", "  (dialect:haas)", "O1234 (DIALECT: Haas)", "% (DIALECT: HAAS)",
        "%1234 (part 7) ( DIALECT = HAAS )", "N10 (DIALECT: HAAS) G0 X1", ":1234(DIALECT:HAAS)",
        "; dialect: haas", "* DIALECT: HAAS\r", "O<PART> (DIALECT: HAAS)", "(DIALECT: HAAS"}) {
    const HeadLine head = read_head_line(line);
    EXPECT_EQ(head.kind, Kind::named) << line;
    EXPECT_EQ(head.dialect, ProgramDialect::haas) << line;
  }
  EXPECT_EQ(read_head_line("(DIALECT: ISO)").kind, Kind::named);
  EXPECT_EQ(read_head_line("(DIALECT: NUM)").dialect, ProgramDialect::num);
  EXPECT_EQ(read_head_line("(DIALECT: LINUXCNC)").dialect, ProgramDialect::linuxcnc);
}

TEST(HeadDialect, EndsWithTheFirstBlockThatDoesSomething) {
  for (const char* line : {"", "%", "O1234", "N10", "(T1 D6 MILL)", "; a word of the dialect",
                           "(DIALECTS: 2)", "(THE DIALECT: HAAS)", "%1234.5 (PART)"})
    EXPECT_EQ(read_head_line(line).kind, Kind::open) << line;
  for (const char* line : {"G90", "/ (DIALECT: HAAS)", "T1 (DIALECT: HAAS)", "#1=2", "o100 sub", "$HELLO"})
    EXPECT_EQ(read_head_line(line).kind, Kind::closed) << line;
}

TEST(HeadDialect, AnUnknownNameIsOneWithItsPlace) {
  const HeadLine head = read_head_line("O1 (DIALECT: HAAS NGC)");
  EXPECT_EQ(head.kind, Kind::unknown);
  EXPECT_EQ(head.offset, 13) << "behind `O1 (DIALECT: `";
  EXPECT_EQ(read_head_line("(DIALECT:)").kind, Kind::unknown);
}

TEST(DialectSelection, TheHeadGoesBeforeNameAndChannel) {
  TestMachine iso = machine_of(ProgramDialect::iso);
  TestMachine num = machine_of(ProgramDialect::num);
  EXPECT_THAT(stream(run(iso, "%1\n(a part)\n(DIALECT: NUM)\nG4 F2\nM2")), ElementsAre("dwell 2", "end 2"));
  EXPECT_THAT(stream(run(num, "(DIALECT: ISO)\nG4 P2000\nM30")), ElementsAre("dwell 2", "end 30"));
  iso.names.add(".num num");
  StringSource named("(DIALECT: ISO)\nG4 P2000\nM30", "part.num");
  EXPECT_THAT(stream(run(iso, named)), ElementsAre("dwell 2", "end 30"));
}

TEST(DialectSelection, ACommentBehindTheHeadIsOne) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  EXPECT_THAT(stream(run(machine, "G0 X1\n(DIALECT: NUM)\nG4 F2\nM2")),
              ElementsAre("rapid X1", "alarm 1540 3:1"));
}

TEST(DialectSelection, TheNameGoesBeforeTheChannel) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  machine.names.add(".num num");
  StringSource named("G4 F2\nM2", "PART.NUM");
  EXPECT_THAT(stream(run(machine, named)), ElementsAre("dwell 2", "end 2"));
  StringSource other("G4 P2000\nM2", "part.nc");
  EXPECT_THAT(stream(run(machine, other)), ElementsAre("dwell 2", "end 2"));
}

TEST(DialectSelection, ACalledTextIsReadInItsOwnAndTheCallerGoesOnInIts) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  machine.names.add(".num num");
  store(machine, "O0010", "(DIALECT: NUM)\nG4 F2\n");
  store(machine, "O0020", "G4 F2\n", "O0020.num");
  store(machine, "O0030", "G4 P3000\nM99\n");
  const std::string calls = "M98 P10\nG4 P1000\nM98 P20\nM98 P30\nM98 P10 L2\nG4 P1000\nM30";
  EXPECT_THAT(stream(run(machine, calls)), ElementsAre("dwell 2", "dwell 1", "dwell 2", "dwell 3", "dwell 2",
                                                       "dwell 2", "dwell 1", "end 30"));
  // A program in the text that calls is in the dialect of that text.
  EXPECT_THAT(stream(run(machine, "(DIALECT: NUM)\nG77 H40\nM2\n%40\nG4 F2\n")),
              ElementsAre("dwell 2", "end 2"));
}

TEST(DialectSelection, TextsOfTheControlAreTheSameInEveryChannel) {
  TestMachine machine = machine_of(ProgramDialect::num);
  store(machine, "O9810", "G4 P2000\nM99\n", {}, ProgramDialect::iso);
  EXPECT_THAT(stream(run(machine, "G77 H9810\nG4 F1\nM2")), ElementsAre("dwell 2", "dwell 1", "end 2"));
  // USERDEF.CYC has the cycles of ISO programs.
  store(machine, "USERDEF.CYC", "%1007\nG4 P#0\nM99\n");
  EXPECT_THAT(stream(run(machine, "(DIALECT: ISO)\nG1007 A2000\nM30")), ElementsAre("dwell 2", "end 30"));
}

// P of G4 is in seconds in the LinuxCNC dialect.
TEST(DialectSelection, AnOWordCallsALinuxcncFileUnlessItsHeadSaysOtherwise) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  store(machine, "pocket", "o<pocket> sub\nG4 P#1\no<inner> call\no<pocket> endsub\n");
  store(machine, "O0030", "G4 P3000\nM99\n");
  EXPECT_THAT(stream(run(machine,
                         "(DIALECT: LINUXCNC)\no<inner> sub\nG4 P2\no<inner> endsub\n"
                         "o<pocket> call [3]\nM98 P30\no<pocket> call [4]\nG4 P1\nM2\n")),
              ElementsAre("dwell 3", "dwell 2", "dwell 3", "dwell 4", "dwell 2", "dwell 1", "end 2"));
  store(machine, "other", "(DIALECT: ISO)\no<other> sub\nG4 P1\no<other> endsub\n");
  EXPECT_THAT(stream(run(machine, "(DIALECT: LINUXCNC)\no<other> call\nM2\n")),
              ElementsAre("alarm 1401 2:1"));
  store(machine, "wrong", "\n(DIALECT: EMC)\n");
  const Interpretation result = run(machine, "(DIALECT: LINUXCNC)\no<wrong> call\nM2\n");
  EXPECT_THAT(stream(result), ElementsAre("alarm 1530 2:11"));
  EXPECT_STREQ(result.alarm.file_name.data(), "wrong");
}

TEST(DialectSelection, AProgramBeginsAsItsHeadSays) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  const std::string drill = "F100 G0 Z3\nG81 X1 Z-1 R2\nM2\n";
  EXPECT_THAT(
      stream(run(machine, "(DIALECT: LINUXCNC)\n" + drill)),
      ElementsAre("rapid Z3", "rapid X1 Z3", "rapid X1 Z2", "line X1 Z-1 F100", "rapid X1 Z2", "end 2"));
  EXPECT_THAT(stream(run(machine, drill)), ElementsAre("rapid Z3", "rapid X1 Z3", "rapid X1 Z2",
                                                       "line X1 Z-1 F100", "rapid X1 Z3", "end 2"));
}

TEST(DialectSelection, ALabelAndALoopAreLookedForInTheDialectOfTheText) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  store(machine, "O0010", "(DIALECT: NUM)\nG79 N30\nG4 F9\nN30 G4 F2\n");
  store(machine, "O0011", "(DIALECT: NUM)\nL0=0\nWHILE L0<2 DO\nL0=L0+1 G4 F2\nENDW\n");
  EXPECT_THAT(stream(run(machine, "M98 P11\nM30")), ElementsAre("dwell 2", "dwell 2", "end 30"));
  EXPECT_THAT(stream(run(machine, "M98 P10\nM30")), ElementsAre("dwell 2", "end 30"));
}

TEST(DialectSelection, AnUnknownNameInACalledTextIsAnAlarmThere) {
  TestMachine machine;
  store(machine, "O0010", "O10\n(DIALECT: FANUC)\nG0 X1\nM99");
  const Interpretation result = run(machine, "G0 X1\nM98 P10\nM30");
  EXPECT_THAT(stream(result), ElementsAre("rapid X1", "alarm 1530 2:11"));
  EXPECT_EQ(result.alarm.program, 10u);
  ASSERT_EQ(result.alarm.calls, 1);
  EXPECT_EQ(result.alarm.chain[0].line, 2u);
}

TEST(DialectSelection, IsThatOfTheStartedTextForWhoAsks) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  Interpreter interpreter(machine);
  StringSource first("(DIALECT: NUM)\nX1\nM2"), second("X1\nM2");
  Command command;
  interpreter.start(first, {}, {});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(interpreter.dialect(), ProgramDialect::num);
  EXPECT_EQ(command.line, 2u);
  interpreter.start(second, {}, {});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(interpreter.dialect(), ProgramDialect::iso);
}

TEST(DialectSelection, DoesNotDependOnHowTheTextArrives) {
  const std::string text = "%1\n(part)\n(DIALECT: NUM)\nG4 F2\nM2";
  for (const std::size_t chunk : {std::size_t{1}, std::size_t{7}, std::size_t{64}}) {
    TestMachine machine = machine_of(ProgramDialect::iso);
    SlowSource slow(text, chunk);
    EXPECT_THAT(stream(run(machine, slow)), ElementsAre("dwell 2", "end 2")) << chunk;
  }
}

TEST(DialectSelection, StopsBeforeALineOfTheTextItself) {
  TestMachine machine = machine_of(ProgramDialect::iso);
  Interpreter interpreter(machine);
  StringSource text("(DIALECT: NUM)\nX1\nG4 F2\nM2");
  Command command;
  interpreter.start(text, {}, {});
  interpreter.stop_before_line(1);
  EXPECT_EQ(interpreter.next(command), Step::line);
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.line, 2u);
  EXPECT_EQ(interpreter.lines(), 3u) << "lines of the head that are read for the dialect do not count";
}

TEST(NameDialects, AreThoseOfTheLongestEnding) {
  NameDialects dialects;
  dialects.add(".ngc linuxcnc; .NC haas;;  -old.nc   num ");
  EXPECT_EQ(dialects.of("part.NGC"), ProgramDialect::linuxcnc);
  EXPECT_EQ(dialects.of("Part.nc"), ProgramDialect::haas);
  EXPECT_EQ(dialects.of("part-OLD.nc"), ProgramDialect::num);
  EXPECT_EQ(dialects.of("part.mpf"), std::nullopt);
  EXPECT_EQ(dialects.of("nc"), std::nullopt);
  EXPECT_EQ(dialects.of(""), std::nullopt);
}

TEST(NameDialects, SayWhichRuleIsWrong) {
  const auto wrong = [](const char* text) {
    try {
      NameDialects().add(text);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(wrong(".ngc"), "'.ngc' needs one dialect: iso, num, linuxcnc, haas");
  EXPECT_EQ(wrong(".ngc fanuc"), "'.ngc' needs one dialect: iso, num, linuxcnc, haas");
  EXPECT_EQ(wrong(".ngc linuxcnc haas"), "'.ngc' needs one dialect: iso, num, linuxcnc, haas");
  EXPECT_EQ(wrong(".ngc linuxcnc; .NGC haas"), "'.NGC' is there twice");
  EXPECT_EQ(wrong(""), "");
}

}  // namespace
}  // namespace trunnion::language::test::dialect_selection
