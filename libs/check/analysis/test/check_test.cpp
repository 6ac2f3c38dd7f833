// SPDX-License-Identifier: Apache-2.0
// The summary, the tool rows, and programs in files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"
#include "analysis/program_folders.hpp"
#include "analysis/summary.hpp"
#include "channel_setup/channel_setup.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::analysis {
namespace {

using testing::HasSubstr;

std::string summary_of(const std::string& program, const CheckOptions& options = {}) {
  DefaultMachine machine({});
  language::StringSource source(program);
  std::ostringstream out;
  check_program(
      source, machine, {}, options, [](std::uint32_t number) { return number == 0 ? "part.nc" : "other"; },
      out);
  return out.str();
}

TEST(Summary, MovesLengthsTimesToolsAndExtents) {
  // Rapid 5, line 10 at 100, half a circle of radius 5 (15.708) at 50: 0.1 + 0.31416 min.
  EXPECT_EQ(summary_of("G21 G90 G54 T3 M6 S500 M3\nG0 X3 Y4\nG1 X13 F100\nG3 X3 I-5 F50\nG4 P500\nM30\n"),
            "blocks   6\n"
            "moves    1 rapid, 1 lines, 1 arcs\n"
            "path     5.000 mm rapid, 25.708 mm at feed\n"
            "time     0.41 min at feed, 0.50 s dwell\n"
            "tools    T3\n"
            "X        0.0000 .. 13.0000 (machine)\n"
            "Y        0.0000 .. 9.0000 (machine)\n"
            "Z        0.0000 .. 0.0000 (machine)\n");
}

// 50 um of X and 30 degrees of A with F500: 30 / 500 min = 3.6 s together, 0.05 / 500 min = 0.006 s of X
// alone.
TEST(Summary, WarnsWhereTheTimeDependsOnWhatFCounts) {
  const auto summary_on = [](bool combined, const std::string& program) {
    auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
    if (!combined) tables.parameters.values[parameter::rotary_feed.number()].value = 1;
    channel_setup::ChannelSetup machine(tables);
    language::StringSource source(program);
    std::ostringstream out;
    check_program(
        source, machine, machine.reference_position(), {}, [](std::uint32_t) { return "part.nc"; }, out);
    return out.str();
  };
  const std::string mixed = "G1 X0.05 A30 F500\nM30\n";
  const auto both = summary_on(true, mixed), linear = summary_on(false, mixed);
  EXPECT_THAT(both, HasSubstr("time     0.06 min at feed"));
  EXPECT_THAT(linear, HasSubstr("time     0.00 min at feed"));
  for (const auto& text : {both, linear})
    EXPECT_THAT(
        text,
        HasSubstr("warning  1 moves of linear and rotary axes, the first in line 1: 3.60 s when F counts "
                  "both (04c919 = 0), 0.01 s when it counts the linear ones (1)\n"));
  for (const char* program :
       {"G1 X10 A5 F500\n", "G1 A30 F500\n", "G1 X10 F500\n", "G43.4 H1\nG1 X0.05 A30 F500\n"})
    EXPECT_EQ(summary_on(true, program).find("04c919"), std::string::npos) << program;
}

TEST(Summary, WarnsWherePOfATiltedPlaneMeansSomethingElseOnOtherControls) {
  const auto summary_on = [](bool by_p, const std::string& p) {
    auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
    if (by_p) tables.parameters.values[parameter::plane_angles.number()].value = 1;
    channel_setup::ChannelSetup machine(tables);
    const auto program = "G68.2 X0 Y0 Z0 I0 J10 K0 " + p + "\nG53.1\nG69\nM30\n";
    language::StringSource source(program);
    std::ostringstream out;
    check_program(
        source, machine, machine.reference_position(), {}, [](std::uint32_t) { return "part.nc"; }, out);
    return out.str();
  };
  EXPECT_THAT(summary_on(false, "P1"),
              HasSubstr("warning  line 1: P1 of a tilted plane chooses the solution"));
  EXPECT_EQ(summary_on(false, "P0").find("of a tilted plane"), std::string::npos);
  EXPECT_EQ(summary_on(true, "P1").find("of a tilted plane"), std::string::npos);
}

// The table turns 0.5 degrees on over the full turn, in tool tip control too, and has no travel limits.
TEST(Summary, ATableThatCountsModulo360GoesOnOverTheFullTurn) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[parameter::rotary_way.number(4)].value = 1;
  channel_setup::ChannelSetup machine(tables);
  const auto c_of = [&](const std::string& program) {
    language::StringSource source(program);
    std::ostringstream out;
    EXPECT_TRUE(check_program(
        source, machine, machine.reference_position(), {}, [](std::uint32_t) { return "part.nc"; }, out))
        << out.str();
    const auto text = out.str();
    return text.substr(text.find("C  "));
  };
  EXPECT_EQ(c_of("G54 G43.4 H1\nG0 X30 Y0 Z50 A30 C359\nG1 Z0 F2000\nX30.1 C359.5\nX30.2 C0\nX30.3 C0.5\n"),
            "C        -1.0000 .. 0.5000 (machine)\n");
  EXPECT_EQ(c_of("G91 G0 C36000000\nG90 C90\n"), "C        0.0000 .. 36000090.0000 (machine)\n");
}

TEST(Summary, CountsTheLinesThatAreWrittenToAFile) {
  EXPECT_THAT(summary_of("G0 X1\nDPRNT[A]\nDPRNT[B]\nM30\n"), HasSubstr("prints   2 lines of DPRNT\n"));
  EXPECT_THAT(summary_of("G0 X1\nM30\n"), testing::Not(HasSubstr("DPRNT")));
}

TEST(Summary, AlarmNamesFileLineColumnAndNumber) {
  EXPECT_THAT(summary_of("G0 X1\nG0 X2 Q\n"), HasSubstr("part.nc:2:7: 1005: letter without a number: Q\n"));
  EXPECT_THAT(summary_of("M98 P2\nM30\nO2\nG77\nM99"), HasSubstr("part.nc:4:1: 1101: unknown G code: G77\n"
                                                                 "  called from part.nc:1\n"));
}

TEST(Summary, AnAlarmAtAWordOfAnotherControlHasItsRowBesides) {
  EXPECT_THAT(summary_of("G0 X1\nTRAFOOF\n"),
              HasSubstr("part.nc:2:1: 1540: word of another control: TRAFOOF, Siemens: write G49\n"
                        "  Siemens: transformation off. Here: G49.\n"));
}

TEST(Summary, AMotionBeyondTheTravelEndsTheCheckWithItsLineAndAxis) {
  channel_setup::ChannelSetup machine(
      tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table"));
  language::StringSource source("G54 G0 X3\nX9000\nX70\nM30\n");
  std::ostringstream out;
  EXPECT_FALSE(check_program(
      source, machine, machine.reference_position(), {}, [](std::uint32_t) { return "part.nc"; }, out));
  EXPECT_THAT(out.str(), HasSubstr("part.nc:2: 140: X would go to 9000.0000, its travel is "));
  EXPECT_THAT(out.str(), HasSubstr("1 rapid"));
}

TEST(Summary, SkippedBlocks) {
  const std::string program = "/G0 X1\n/2 X2\n/9 X3\nX4\n";
  EXPECT_THAT(summary_of(program), HasSubstr("4 rapid"));
  CheckOptions options;
  options.skip_blocks = true;
  EXPECT_THAT(summary_of(program, options), HasSubstr("1 rapid"));
}

TEST(Summary, MainProgramThatRepeatsIsRunOnce) {
  EXPECT_THAT(summary_of("G0 X1\nX2\nM99\n"), HasSubstr("2 rapid"));
}

// The second pass shows that the first was no beginning of something else.
TEST(Summary, AProgramThatRepeatsForEverIsSaidOnce) {
  const std::string from = "part.nc:1: the program repeats for ever from line 1;";
  EXPECT_THAT(summary_of("N1 G0 X1\nX2\nM99 P1\n"), testing::AllOf(HasSubstr(from), HasSubstr("4 rapid")));
  for (const char* program : {
           "N1 G91 G0 X1\nGOTO 1\n",                                         // the position grows
           "N5 GOTO 5\n",                                                    // without motion
           "WHILE [1 EQ 1]\nENDW\n",                                         //
           "N1 #1=0\nWHILE [#1 LT 3] DO1\n#1=#1+1\nG0 X#1\nEND1\nM99 P1\n",  // with a loop that ends in it
           "N1 M98 P7\nGOTO 1\nO7\nG0 X1\nM99\n",                            //
           "N1 G68 X0 Y0 R90\nG0 X1\nG69\nGOTO 1\n",                         // makes frames
       })
    EXPECT_THAT(summary_of(program), HasSubstr(from)) << program;
  EXPECT_THAT(summary_of("G0 X1\nM98 P7\nM30\nO7\nN1 G0 X2\nGOTO 1\n"),
              HasSubstr("part.nc:2: the program repeats for ever from line 2;"))
      << "the line of the call";
}

// Four modal calls may be active: the fifth pass is the alarm 1402.
TEST(Summary, AProgramWhoseModalCallsNestInEachPassHasTheirAlarm) {
  const auto summary = summary_of("N1 G66 P7\nGOTO 1\nO7\nM99\n");
  EXPECT_THAT(summary, HasSubstr(": 1402: "));
  EXPECT_EQ(summary.find("for ever"), std::string::npos) << summary;
}

TEST(Summary, ALoopThatEndsRunsToItsEnd) {
  for (const char* program : {
           "#1=0\nWHILE [#1 LT 100] DO1\n#1=#1+1\nG4 P10\nEND1\nM30\n",
           "#500=0\nN1 #500=#500+1\nG4 P10\nIF [#500 LT 100] GOTO 1\nM30\n",
           "M98 P7 L100\nM30\nO7\nG4 P10\nM99\n",
           "G91\nN1 G0 X1\nG4 P10\nIF [#5041 LT 100] GOTO 1\nM30\n",  // by where the axis is
           "G65 P7 A100\nM30\nO7\nN1 #1=#1-1\nG4 P10\nIF [#1 GT 0] GOTO 1\nM99\n",
       }) {
    const auto summary = summary_of(program);
    EXPECT_THAT(summary, HasSubstr("1.00 s dwell")) << program;
    EXPECT_EQ(summary.find("for ever"), std::string::npos) << program;
  }
}

TEST(Summary, ArcsReachBeyondTheirEnds) {
  // From (5,0) three quarters anticlockwise about 0 to (0,-5): through (0,5) and (-5,0).
  const std::string text = summary_of("G0 X5\nG3 X0 Y-5 I-5 F10\n");
  EXPECT_THAT(text, HasSubstr("X        -5.0000 .. 5.0000"));
  EXPECT_THAT(text, HasSubstr("Y        -5.0000 .. 5.0000"));
  // Clockwise it is one quarter, within its ends.
  EXPECT_THAT(summary_of("G0 X5\nG2 X0 Y-5 I-5 F10\n"), HasSubstr("X        0.0000 .. 5.0000"));
}

TEST(Summary, HelixReachesHighestWhereItTurns) {
  // Three turns of radius 5 about (0, 0) from (5, 0), 30 up: the last time at X 5 is its end.
  const std::string text = summary_of("G0 X5\nG3 X5 Y0 Z30 I-5 L3 F10\n");
  EXPECT_THAT(text, HasSubstr("X        -5.0000 .. 5.0000"));
  EXPECT_THAT(text, HasSubstr("Z        0.0000 .. 30.0000"));
  // 3 * 2 * pi * 5 = 94.248 around, 30 up.
  EXPECT_THAT(text, HasSubstr("98.907 mm at feed"));
}

TEST(Summary, CircleInATiltedPlane) {
  // Half a circle of radius 10 about (0, 0, 0), turned 45 degrees about X: through (0, 7.0711, 7.0711).
  Motion motion;
  motion.kind = language::CommandKind::arc;
  motion.from = {10};
  motion.mcs = {-10};
  motion.length = 31.4159;
  motion.arc.sweep = 180;
  motion.arc.normal = {0, -std::sqrt(0.5), std::sqrt(0.5)};
  Summary summary(0b111);
  summary.add(motion);
  EXPECT_NEAR(summary.highest()[0], 10, 1e-9);
  EXPECT_NEAR(summary.highest()[1], 7.0710678, 1e-6);
  EXPECT_NEAR(summary.highest()[2], 7.0710678, 1e-6);
  EXPECT_NEAR(summary.lowest()[1], 0, 1e-9);
}

TEST(ToolRows, ReadsRowsNamesAndComments) {
  const ToolRows rows =
      read_tool_rows("number,length,radius\n# mills\n1,50.5,3\n\n 12 , -7 \r\n", "tools.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.at(1).length, 50.5);
  EXPECT_EQ(rows.at(1).radius, 3);
  EXPECT_EQ(rows.at(12).length, -7);
  EXPECT_EQ(rows.at(12).radius, 0);
  EXPECT_TRUE(read_tool_rows("", "tools.csv").empty());
  const std::string mark = "\xef\xbb\xbf";  // of a spreadsheet's file
  EXPECT_EQ(read_tool_rows(mark + "1,50,3\n", "tools.csv").at(1).length, 50);
}

TEST(ToolRows, AFirstLineWithNumbersIsNoLineOfNames) {
  EXPECT_EQ(read_tool_rows("1,50,3\n2,60,3\n", "tools.csv").size(), 2u);
  for (const char* first : {"T1,50,3", "1;50;3", "T1;50;3", "end mill,50,3"}) {
    try {
      read_tool_rows(first + std::string("\n2,60,3\n"), "tools.csv");
      ADD_FAILURE() << first;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("tools.csv:1: tool number must be a whole number")) << first;
    }
  }
}

TEST(ToolRows, WrongRowIsRefusedWithItsLine) {
  for (const char* row : {"0,1,1", "1.5,1,1", "65536,1,1", "1", "1,x,1", "1,1,-1", "1,1,1,1", "1,nan,1",
                          "1,1e9,1", "x,1,1", "1,1,1\n1,2,2"}) {
    try {
      read_tool_rows("2,1,1\n" + std::string(row), "tools.csv");
      ADD_FAILURE() << row;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("tools.csv:")) << row;
    }
  }
}

struct Folder {
  Folder() : path(std::filesystem::path(testing::TempDir()) / "check_programs") {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
  std::filesystem::path path;
};

TEST(ProgramFolders, FindsProgramsByNumberInAnyForm) {
  const Folder folder;
  folder.write("o12.nc", "a");
  folder.write("O0013", "b");
  folder.write("14.NC", "c");
  folder.write("userdef.cyc", "d");
  folder.write("O12345.txt", "e");
  folder.write("part.nc", "f");
  ProgramFolders programs({"/does/not/exist", folder.path.string()});
  for (const char* name : {"O0012", "O0013", "O0014", "USERDEF.CYC", "O12345"}) {
    EXPECT_NE(programs.find(name), nullptr) << name;
  }
  folder.write("O9990.9", "g");
  folder.write("O7.1.nc", "h");
  for (const char* name : {"O9990.9", "O0007.1"}) EXPECT_NE(programs.find(name), nullptr) << name;
  for (const char* name : {"O9990", "O0007", "O0012.1"}) EXPECT_EQ(programs.find(name), nullptr) << name;
  for (const char* name : {"O0001", "O1234", "O0002"}) EXPECT_EQ(programs.find(name), nullptr) << name;
  EXPECT_EQ(programs.find("O0012"), programs.find("O0012"));
  EXPECT_THAT(programs.path("O0012"), HasSubstr("o12.nc"));
  EXPECT_EQ(programs.path("O0099"), "O0099");
}

TEST(FileSource, ReadsAnywhereAndSaysWhatIsWrong) {
  const Folder folder;
  folder.write("a", "0123456789");
  const std::string path = (folder.path / "a").string();
  FileSource source(path);
  char buffer[4];
  EXPECT_EQ(source.read(7, buffer, 4).size, 3u);
  EXPECT_EQ(std::string(buffer, 3), "789");
  EXPECT_EQ(source.read(10, buffer, 4).status, language::ReadStatus::end);
  EXPECT_THROW(FileSource(path + "x"), std::runtime_error);
  EXPECT_THROW(FileSource(folder.path.string()), std::runtime_error);
}

TEST(Check, ProgramOfManyFilesCallsThroughThem) {
  const Folder folder;
  folder.write("main.nc", "G0 X1\nM98 P12\nG1007 Y5\nM30\n");
  folder.write("O0012.nc", "X2\nM99\n");
  folder.write("USERDEF.CYC", "%1007\nG0 Y#24\nM99\n");
  FileSource text((folder.path / "main.nc").string());
  ProgramFolders programs({folder.path.string()});
  DefaultMachine machine({});
  machine.resolve = [&](std::string_view name) { return programs.find(name); };
  std::ostringstream out;
  EXPECT_TRUE(check_program(
      text, machine, {}, {}, [](std::uint32_t) { return ""; }, out));
  EXPECT_THAT(out.str(), HasSubstr("3 rapid"));
}

TEST(Check, TheDialectOfTheMachineIsThatOfProgramsWithoutTheirOwn) {
  const auto checks = [](language::ProgramDialect dialect, const char* program) {
    DefaultMachine machine({});
    machine.dialect = dialect;
    language::StringSource source(program);
    std::ostringstream out;
    return check_program(
        source, machine, {}, {}, [](std::uint32_t) { return "part.nc"; }, out);
  };
  EXPECT_TRUE(checks(language::ProgramDialect::num, "G4 F2\nM2\n"));
  EXPECT_FALSE(checks(language::ProgramDialect::iso, "G4 F2\nM2\n"));
  EXPECT_TRUE(checks(language::ProgramDialect::iso, "(DIALECT: NUM)\nG4 F2\nM2\n"));
}

TEST(Check, TheNameOfAFileIsThatOfItsText) {
  const Folder folder;
  folder.write("part.ngc", "G0 X1\nM30\n");
  EXPECT_EQ(FileSource((folder.path / "part.ngc").string()).name(), "part.ngc");
}

}  // namespace
}  // namespace trunnion::analysis
