// SPDX-License-Identifier: Apache-2.0
// Each warning of a check with its place, and that good programs have none.
#include "analysis/warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "analysis/block_checks.hpp"
#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"
#include "analysis/file_source.hpp"
#include "analysis/program_folders.hpp"
#include "channel_setup/channel_setup.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// The warnings among the lines of a check.
std::vector<std::string> warnings_in(const std::string& text) {
  std::vector<std::string> warnings;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("warning")) warnings.push_back(line);
  return warnings;
}

std::string name_of_text(std::uint32_t program) { return program == 0 ? "part.nc" : "other"; }

/// On the AC table with its tool 1, 100 mm long, and with other values of parameters.
std::vector<std::string> warnings_of(const std::string& program,
                                     const std::map<std::uint32_t, double>& parameters = {}) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  for (const auto& [number, value] : parameters) tables.parameters.values[number].value = value;
  channel_setup::ChannelSetup machine(tables);
  language::StringSource source(program);
  std::ostringstream out;
  check_program(source, machine, machine.reference_position(), {}, name_of_text, out);
  return warnings_in(out.str());
}

std::vector<std::string> warnings_without_machine(const std::string& program) {
  DefaultMachine machine({});
  language::StringSource source(program);
  std::ostringstream out;
  check_program(source, machine, {}, {}, name_of_text, out);
  return warnings_in(out.str());
}

/// Four lines that begin a good program; tool 1 with its length is in the spindle, which turns.
const std::string prelude = "G21 G90 G54 G17\nT1 M6\nS1000 M3\nG43 H1\n";

struct Doubtful {
  WarningKind kind;
  std::string program;
  const char* place;
  const char* detail;
};

// The circles begin at X10 Y0 behind a line along +X. Half of the way to Y9.9997 is 4.99985: R5 has its
// centre sqrt(0.00015 * 9.99985) = 0.039 mm beside it. To Y0.1 R-5 goes 360 - 2 asin(0.05 / 5) = 358.85
// degrees.
std::vector<Doubtful> doubtful_programs() {
  using enum WarningKind;
  return {
      {WarningKind::head, "T1 M6\nS1000 M3\nG43 H1\nG0 X1 Y1 Z50\nG1 Z40 F500\nM30\n", "line 4:4",
       "G20 or G21, G90 or G91, G54 to G59"},
      {change_without_tool, prelude + "G0 Z50\nM6\nG43 H1\nM30\n", "line 6:1", ""},
      {other_length, "G21 G90 G54 G17\nT1 M6\nS1000 M3\nG43 H2\nG0 Z50\nM30\n", "line 4:5", "H2 with T1"},
      {length_missing, "G21 G90 G54 G17\nT1 M6\nS1000 M3\nG0 X0 Y0 Z50\nG1 Z10 F500\nM30\n", "line 5:4",
       "T1 is 100 mm long"},
      {radius_missing, prelude + "G0 X0 Y0 Z50\nG41 G1 X10 F500\nX20\nG40 X30\nM30\n", "line 6:1", ""},
      {radius_missing, prelude + "G0 X0 Y0 Z50\nG42 D0 G1 X10 F500\nX20\nG40 X30\nM30\n", "line 6:5", ""},
      {feed_missing, prelude + "G0 X0 Y0 Z50\nG1 X10\nM30\n", "line 6:4", "1000 mm/min (040030)"},
      {spindle_stopped, "G21 G90 G54 G17\nT1 M6\nG43 H1\nG0 X0 Y0 Z50\nG1 X10 F500\nM30\n", "line 5:4", ""},
      {tip_control, prelude + "G0 X0 Y0 Z50 A0 C0\nG1 X10 A5 F500\nX20 A6\nM30\n", "line 6:4 and 1 more", ""},
      {rapid_down, prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG0 X20 Z60\nX30 Z45\nM30\n", "line 8:1",
       "to Z45.000, at Z50.000"},
      {return_over_zero, prelude + "G0 X0 Y0 Z50\nG28 Z0\nM30\n", "line 6:5", "G28 Z0"},
      {arc_side, prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG2 X10 Y10 R5\nG1 X0\nM30\n", "line 7:12", ""},
      {arc_half, prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X10 Y9.9997 R5\nM30\n", "line 7:16",
       "the centre 0.039 mm beside it"},
      {arc_full, prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X10 Y0.1 R-5\nM30\n", "line 7:13",
       "358.85 degrees, its ends are 0.1000 mm apart"},
      {arc_end, prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X15.02 Y5 I0 J5\nM30\n", "line 7:14",
       "radius 5.0000 mm at the start, 5.0200 mm at the end"},
      {condition_brackets, prelude + "#1=1\nIF #1 EQ 2 GOTO 10\nN10 M30\n", "line 6:4", ""},
      {condition_order, prelude + "#1=1\nIF [#1 EQ 1 AND #2 EQ 0] GOTO 10\nN10 M30\n", "line 6:4", ""},
      {cycle_active, prelude + "G0 Z50\nG81 X5 Y5 Z10 R40 F300\nT2 M6\nG80\nG43 H2\nM30\n", "line 7:4",
       "G81 at M6"},
      {cycle_active, prelude + "G0 Z50\nG83 X5 Y5 Z10 R40 Q9 F300\nG91 G28 Z0\nM8\nG90 X9\nG80\nM30\n",
       "line 7:5", "G83 at G28 or G30"},
      {cycle_below, prelude + "G0 Z30\nG81 X5 Y5 Z10 R40 F300\nG80\nG0 Z60\nM30\n", "line 6:15",
       "Z is at 30.000, R at 40.000 mm"},
      {cycle_below, prelude + "G0 Z30\nG91 G81 X5 Y5 Z-3 R1.5 F300\nG80\nG90 G0 Z60\nM30\n", "line 6:19",
       "Z is at 30.000, R at 31.500 mm"},
      {end_missing, prelude + "G0 Z50\n", "line 5:1", ""},
  };
}

TEST(Warnings, NameTheirPlaceAndTheRemedy) {
  for (const Doubtful& doubtful : doubtful_programs()) {
    const auto& rule = warning_rules[static_cast<std::size_t>(doubtful.kind)];
    const auto warnings = warnings_of(doubtful.program);
    SCOPED_TRACE(doubtful.program);
    EXPECT_THAT(warnings, ElementsAre(testing::AllOf(
                              StartsWith(std::string("warning  ") + doubtful.place + ": "),
                              HasSubstr(rule.text), HasSubstr(doubtful.detail), HasSubstr(rule.remedy))));
  }
}

TEST(Warnings, EachKindHasATestAndIsInTheDocument) {
  std::set<WarningKind> tested{WarningKind::foreign_m};  // below
  for (const Doubtful& doubtful : doubtful_programs()) tested.insert(doubtful.kind);
  EXPECT_EQ(tested.size(), warning_rules.size());
  std::ifstream file(std::string(REPOSITORY) + "/docs/program-check.md");
  std::ostringstream document;
  document << file.rdbuf();
  for (const WarningRule& rule : warning_rules)
    EXPECT_THAT(document.str(), HasSubstr(std::string("| `") + rule.name + "` |"));
}

TEST(Warnings, MCodesOfOtherControlsWhereNoMachineIsNamed) {
  EXPECT_THAT(warnings_without_machine("G21 G90 G54\nM128\nM129\nM8\nM30\n"),
              ElementsAre(HasSubstr("line 2:1: "), HasSubstr("line 3:1: ")));
  EXPECT_THAT(warnings_without_machine("M128\nM30\n")[0],
              HasSubstr("M128 of Heidenhain: tool tip control on"));
}

// What is right beside what is doubtful.
TEST(Warnings, GoodProgramsHaveNone) {
  for (const std::string& program : {
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG0 X20 Z60\nX30 Z55\nM30\n",         // down, but in the air
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG0 Z60\nX30\nZ45\nM30\n",            // one after the other
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG91 G28 Z0\nG90\nM30\n",             //
           prelude + "G0 X0 Y0 Z50\nG28 Z60\nM30\n",                                  // a point above
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X10 Y10 R5\nG1 X0\nM30\n",        // exactly half a turn
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X15 Y5 R5\nG1 Y10\nM30\n",        // a rounded corner
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG2 X15 Y5 R5\nG1 Y10\nM30\n",        // one cut out
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X15.001 Y5 I0 J5\nM30\n",         // rounded to 1 um
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 I0 J5\nG1 X20\nM30\n",            // a whole circle
           prelude + "G0 X0 Y0 Z50\nG41 D1 G1 X10 F500\nX40\nG40 X60\nM30\n",         //
           prelude + "G0 X0 Y0 Z50 A0 C0\nG1 A5 F500\nG1 X10\nM30\n",                 // not together
           prelude + "G43.4 H1\nG0 X0 Y0 Z50 A0 C0\nG1 X10 A5 F500\nG49\nM30\n",      //
           prelude + "G93\nG0 X0 Y0 Z50\nG1 X10 F5\nM30\n",                           //
           prelude + "#1=1\nIF [[#1 EQ 1] AND [#2 EQ 0]] GOTO 10\nN10 M30\n",         //
           prelude + "#1=1\nWHILE [#1 LT 3] DO 1\n#1=#1+1\nEND 1\nM30\n",             //
           prelude + "T2\nG0 Z50\nM6\nG43 H2\nM30\n",                                 // made ready before
           prelude + "G0 Z50\nG81 X5 Y5 Z10 R40 F300\nX10\nG80\nG0 X0 Z60\nM30\n",    //
           prelude + "G0 Z50\nG81 X5 Y5 Z10 R40 F300\nG91 G28 Z0\nM30\n",             // the end
           prelude + "G0 Z50\nG81 X5 Y5 Z10 R40 F300\nG91 G28 Z0\nG90 G0 X9\nM30\n",  // G0 ends the cycle
           prelude + "G0 Z50\nG81 X5 Y5 Z10 R50 F300\nX9 R45\nG80\nG0 Z60\nM30\n",    // not below R
           prelude + "G0 Z50\nG91 G81 X5 Y5 Z-9 R-9 F300\nG80\nG90 G0 Z60\nM30\n",    //
           std::string("G21 G90 G54 G17\nT1 M6\nG43 H1\nG0 X0 Y0 Z50\nG1 X10 F500\nG31 L1 X20\nM30\n"),
           std::string(
               "G21 G90 G54 G17\nG53 G0 Z0\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z50\nG1 Z40 F500\nM30\n"),
           // A quarter and half a degree about X10 Y5.
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG90.1\nG3 X9.9564 Y9.9998 I10 J5\nG1 X0\nM30\n",
           // Words of a rotation, of which R would be a circle of nearly a full turn.
           prelude + "G0 X0 Y0 Z50\nG1 X10 F500\nG3 X2 Y0 I-4 J0\nG68 X0 Y0 R-1\nG69\nG1 X0\nM30\n",
           prelude + "G0 Z50\nM99\n",
       })
    EXPECT_THAT(warnings_of(program), IsEmpty()) << program;
}

TEST(Warnings, OfASubprogramNameItsText) {
  channel_setup::ChannelSetup machine(
      tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table"));
  language::StringSource called("O7\nG41 G1 X10 F500\nX20\nG40 X30\nM99\n");
  machine.resolve = [&](std::string_view name) { return name == "O0007" ? &called : nullptr; };
  const std::string text = prelude + "G0 X0 Y0 Z50\nM98 P7\nM30\n";
  language::StringSource source(text);
  std::ostringstream out;
  check_program(source, machine, machine.reference_position(), {}, name_of_text, out);
  EXPECT_THAT(warnings_in(out.str()),
              ElementsAre(StartsWith("warning  other line 2:1: G41 or G42 without D")))
      << out.str();
}

TEST(Warnings, FollowTheDialectOfTheText) {
  EXPECT_THAT(warnings_of("(DIALECT: NUM)\nG71 G90\nG0 X5\nM2\n"), IsEmpty());
  EXPECT_THAT(warnings_of("(DIALECT: NUM)\nG0 X5\nM2\n"),
              ElementsAre(HasSubstr(": G70 or G71, G90 or G91;")));
  EXPECT_THAT(warnings_of("(DIALECT: ISO)\nG21 G90\nG0 X5\nM2\n", {{parameter::program_dialect.number(), 1}}),
              ElementsAre(HasSubstr(": G54 to G59;")));
}

TEST(Warnings, ASecondToolWordIsForTheNextChange) {
  const std::string changes = "G21 G90 G54 G17\nT1 T2 M6\nG43 H1\nM6\nG43 H2\nG0 Z50\nM30\n";
  EXPECT_THAT(warnings_of(changes, {{parameter::two_tool_words.number(), 2}}), IsEmpty());
  EXPECT_THAT(warnings_of(changes, {{parameter::two_tool_words.number(), 1}}),
              ElementsAre(StartsWith("warning  line 3:5: "), StartsWith("warning  line 4:1: ")))
      << "the second tool is in the spindle, and none is ready";
}

// The machine changes tools by a program, in which M6 is the ordinary one.
TEST(Warnings, ACodeThatCallsAProgramIsNoChangeOfItsOwn) {
  const std::string change = "G21 G90 G54 G17\nT1 M6\nG43 H1\nG0 Z50\nM30\nO9001\nM6\nM99\n";
  EXPECT_THAT(warnings_of(change, {{parameter::subprogram_m_code.number(), 6}}), IsEmpty());
}

TEST(Conditions, AreFoundWithWhatIsBehindThem) {
  EXPECT_EQ(condition_of("N10 IF [#1 EQ 2] THEN #2=3"), " [#1 EQ 2] ");
  EXPECT_EQ(condition_of("/2 while#1LT3do1"), "#1LT3");
  EXPECT_EQ(condition_of("WH [#1 LT 3] DO 1"), " [#1 LT 3] ");
  EXPECT_EQ(condition_of("IF [#1 EQ 2] TH #2=#3"), " [#1 EQ 2] ");
  EXPECT_EQ(condition_of("(IF) G0 X1"), "");
  EXPECT_EQ(condition_of("G0 X1 (IF #1)"), "");
  EXPECT_EQ(condition_of("IF #1 EQ 2 (THEN)"), " #1 EQ 2 ");
  EXPECT_TRUE(in_brackets(" [1]"));
  EXPECT_FALSE(in_brackets("#1"));
}

TEST(Conditions, MixTheirOrderWithoutBrackets) {
  for (const char* mixed :
       {"#1 EQ 1 AND #2 EQ 1", "[#1 LT 2 OR #3]", "[[#1==1] + [#2 > 3 XOR 1]]", "1AND#2>=3"})
    EXPECT_TRUE(mixes_order(mixed)) << mixed;
  for (const char* clear : {"[#1 EQ 1] AND [#2 EQ 1]", "[#1 AND 2] EQ 2", "#1 EQ 1 && #2 EQ 1",
                            "ROUND[#1] LE 2", "#1 MOD 2 EQ 0", "#1 AND #2", "", "]", "[["})
    EXPECT_FALSE(mixes_order(clear)) << clear;
}

/// Every part program that is delivered: for a machine's folder that machine, else the AC table.
struct Delivered {
  std::filesystem::path file;
  std::string machine;
  bool num = false;
};

std::vector<Delivered> delivered_programs() {
  namespace fs = std::filesystem;
  std::vector<Delivered> programs;
  const auto add = [&](const fs::path& folder, const std::string& machine, bool num) {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".nc") programs.push_back({entry.path(), machine, num});
  };
  for (const auto& machine : fs::directory_iterator(MACHINES_DIRECTORY))
    if (fs::exists(machine.path() / "programs"))
      add(machine.path() / "programs", machine.path().filename().string(), false);
  const fs::path examples = fs::path(REPOSITORY) / "examples";
  for (const char* folder : {"probe-sphere", "calibration", "calibration/programs", "measuring-cycles"})
    add(examples / folder, "ac-table", false);
  add(examples / "num-lathe", "lathe", true);
  return programs;
}

TEST(Warnings, DeliveredProgramsHaveNone) {
  const auto programs = delivered_programs();
  EXPECT_GT(programs.size(), 25u);
  for (const Delivered& program : programs) {
    const std::string directory = std::string(MACHINES_DIRECTORY) + "/" + program.machine;
    auto tables = tool_tables::load_machine_tables(directory);
    if (program.num) tables.parameters.values[parameter::program_dialect.number()].value = 1;
    channel_setup::ChannelSetup machine(tables);
    ProgramFolders folders({program.file.parent_path().string(), directory + "/programs",
                            std::string(REPOSITORY) + "/examples/calibration/programs"});
    machine.resolve = [&](std::string_view name) { return folders.find(name); };
    FileSource text(program.file.string());
    std::ostringstream out;
    check_program(text, machine, machine.reference_position(), {}, name_of_text, out);
    EXPECT_THAT(warnings_in(out.str()), IsEmpty()) << program.file << "\n" << out.str();
  }
}

}  // namespace
}  // namespace trunnion::analysis
