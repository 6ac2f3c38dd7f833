// SPDX-License-Identifier: Apache-2.0
// The summary of a program, as JSON and as text.
#include "analysis/program_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "analysis/default_machine.hpp"
#include "analysis/summary_report.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string text_name(std::uint32_t program) { return program == 0 ? "part.nc" : "called.nc"; }

/// The AC table: tool 1 is 100 mm long, tool 2 120 mm; G54 is 380 mm below the zero of the machine.
SurveyedMachine ac_table() {
  return SurveyedMachine(tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table"));
}

struct Summarized {
  bool good = false;
  std::string text;
  nlohmann::json json;
};

template <class Machine>
Summarized summarize(Machine& machine, const std::string& program, const language::AxisValues& start) {
  Summarized result;
  for (const bool json : {false, true}) {
    language::StringSource source(program);
    std::ostringstream out;
    CheckOptions options;
    options.json = json;
    result.good = summarize_program(source, machine, start, options, text_name, out);
    if (json)
      result.json = nlohmann::json::parse(out.str());
    else
      result.text = out.str();
  }
  return result;
}

Summarized on_ac_table(const std::string& program) {
  auto machine = ac_table();
  return summarize(machine, program, machine.reference_position());
}

const std::string one_tool =
    "G21 G90 G54 G17\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z50\nG1 X100 F500\nG2 I0 J-10\nG4 P2000\nM30\n";

// 100 mm and a circle of radius 10 mm at 500 mm/min: 12 s and 2 pi 10 / 500 min. The rapid goes from the
// reference, 0, to 50 + 100 - 380 = -230 mm.
TEST(ProgramSummary, TimesWithTheirShares) {
  auto machine = ac_table();
  const auto summary = summarize(machine, one_tool, machine.reference_position());
  EXPECT_TRUE(summary.good) << summary.text;
  const double cut = 12 + 2 * std::numbers::pi * 10 / 500 * 60;
  const auto& axis = machine.limits().axes[language::Z];
  const double rapid = 230 / axis.rapid_velocity + axis.rapid_velocity / axis.acceleration;
  const auto& seconds = summary.json["seconds"];
  EXPECT_NEAR(seconds["cut"].get<double>(), cut, 1e-6);
  EXPECT_NEAR(seconds["rapid"].get<double>(), rapid, 1e-6);
  EXPECT_EQ(seconds["dwell"], 2);
  EXPECT_EQ(seconds["tool_change"], 10) << "04c820";
  EXPECT_NEAR(seconds["total"].get<double>(), cut + rapid + 12, 1e-6);
  EXPECT_EQ(summary.json["tool_changes"], 1);
  EXPECT_EQ(summary.json["lines"], 9);
  EXPECT_EQ(summary.json["blocks"], 9);
  EXPECT_THAT(summary.text, HasSubstr("program  9 lines, 9 blocks executed\n"));
  EXPECT_THAT(summary.text, HasSubstr(": cutting 19.5 s ("));
  EXPECT_THAT(summary.text, HasSubstr(", 1 tool change 10.0 s ("));
}

TEST(ProgramSummary, TheTimeOfAToolChangeIsAParameter) {
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[parameter::tool_change_time.number()].value = 4;
  SurveyedMachine machine(tables);
  EXPECT_EQ(summarize(machine, one_tool, machine.reference_position()).json["seconds"]["tool_change"], 4);
}

TEST(ProgramSummary, ToolsInTheOrderOfTheirUse) {
  const auto one = on_ac_table(one_tool).json["tools"];
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0]["tool"], 1);
  EXPECT_EQ(one[0]["line"], 2);
  EXPECT_EQ(one[0]["h"], nlohmann::json::parse("[1]"));
  EXPECT_EQ(one[0]["d"], nlohmann::json::array());
  EXPECT_EQ(one[0]["length"], 100);
  EXPECT_EQ(one[0]["radius"], 10);
  EXPECT_EQ(one[0]["speed"], nlohmann::json::parse(R"({"from":1000.0,"to":1000.0})"));
  EXPECT_EQ(one[0]["feed"], nlohmann::json::parse(R"({"from":500.0,"to":500.0})"));
  const auto summary = on_ac_table(
      "G21 G90 G54\nT2 M6\nS100 M3\nG43 H2 G0 Z50\nG1 X10 F100\nT1 M6\nG43 H1\nG1 X0 F200\n"
      "T2 M6\nG43 H2 S300\nG1 X20 F400\nM30\n");
  const auto& tools = summary.json["tools"];
  ASSERT_EQ(tools.size(), 2u) << summary.text;
  EXPECT_EQ(tools[0]["tool"], 2);
  EXPECT_EQ(tools[0]["changes"], 2);
  EXPECT_EQ(tools[0]["speed"]["to"], 300);
  EXPECT_EQ(tools[0]["feed"]["from"], 100);
  EXPECT_NEAR(tools[0]["cut_seconds"].get<double>(), 6 + 3, 1e-9);  // 10 / 100 and 20 / 400 min
  EXPECT_EQ(tools[1]["tool"], 1);
  EXPECT_THAT(summary.text,
              HasSubstr("tool     T2 H2, from line 2:1; 120 mm long, radius 3 mm; cutting 9.0 s, "));
  EXPECT_THAT(summary.text, HasSubstr("; S100 .. 300; F100 .. 400\n"));
}

// The circle about (100, -10) goes from X90 to X110 and down to Y-20.
TEST(ProgramSummary, EnvelopeOfTheTipAndReserveOfTheAxes) {
  const auto summary = on_ac_table(one_tool);
  const auto& offsets = summary.json["work_offsets"];
  ASSERT_EQ(offsets.size(), 1u);
  EXPECT_EQ(offsets[0]["offset"], "G54");
  const auto& tip = offsets[0]["tip"];
  EXPECT_NEAR(tip["X"]["from"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(tip["X"]["to"].get<double>(), 110, 1e-6);
  EXPECT_NEAR(tip["Y"]["from"].get<double>(), -20, 1e-6);
  EXPECT_NEAR(tip["Y"]["to"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(tip["Z"]["from"].get<double>(), 50, 1e-9);
  EXPECT_NEAR(tip["Z"]["to"].get<double>(), 50, 1e-9);
  // Travel X -400 .. 400, Y -300 .. 300, Z -500 .. 100; C turns without end.
  const auto& axes = summary.json["axes"];
  EXPECT_NEAR(axes["X"]["reserve"].get<double>(), 290, 1e-3);
  EXPECT_NEAR(axes["Y"]["reserve"].get<double>(), 280, 1e-3);
  EXPECT_NEAR(axes["Z"]["from"].get<double>(), -230, 1e-6);
  EXPECT_NEAR(axes["Z"]["reserve"].get<double>(), 100, 1e-6);
  EXPECT_FALSE(axes["C"].contains("reserve"));
  EXPECT_THAT(summary.text,
              HasSubstr("G54      tool tip X 0.0000 .. 110.0000, Y -20.0000 .. 0.0000, Z 50.0000"));
  EXPECT_THAT(summary.text,
              HasSubstr("Z        machine -230.0000 .. 0.0000, travel -500 .. 100, reserve 100.0000\n"));
}

TEST(ProgramSummary, MovesInMachineCoordinatesAreNotInAWorkOffset) {
  const auto summary = on_ac_table("G21 G90 G55\nG53 G0 Z-20\nG0 X5\nG91 G28 Z0\nM30\n");
  const auto& offsets = summary.json["work_offsets"];
  ASSERT_EQ(offsets.size(), 1u);
  EXPECT_EQ(offsets[0]["offset"], "G55");
  EXPECT_EQ(offsets[0]["tip"]["X"]["from"], 5);
  EXPECT_EQ(offsets[0]["tip"]["X"]["to"], 5);
}

TEST(ProgramSummary, WhatItCallsAndTheHighestSpeedAndFeed) {
  const auto summary = on_ac_table(
      "G21 G90 G54\nT1 M6\nS1000 M3\nG43 H1 G0 Z50\nM98 P7\nM98 P7\nG65 P8 A1\nM30\n"
      "O7\nG81 X5 Y5 Z40 R45 F300\nG80\nM99\nO8\nG1 X0 F700 S2000\nM99\n");
  EXPECT_TRUE(summary.good) << summary.text;
  const auto& calls = summary.json["calls"];
  ASSERT_EQ(calls.size(), 2u);
  EXPECT_EQ(calls[0]["name"], "O0007");
  EXPECT_EQ(calls[0]["blocks"], 2);
  EXPECT_EQ(calls[1]["name"], "O0008");
  EXPECT_EQ(calls[1]["line"], 7);
  ASSERT_EQ(summary.json["cycles"].size(), 1u);
  EXPECT_EQ(summary.json["cycles"][0]["name"], "G81");
  EXPECT_EQ(summary.json["highest"]["speed"]["value"], 2000);
  EXPECT_EQ(summary.json["highest"]["feed"]["value"], 700);
  EXPECT_EQ(summary.json["highest"]["feed"]["line"], 14);
  EXPECT_THAT(summary.text, HasSubstr("calls    O0007 (2 blocks), O0008\n"));
  EXPECT_THAT(summary.text, HasSubstr("cycles   G81 (2 blocks)\n"));
  EXPECT_THAT(summary.text, HasSubstr("highest  S2000 1/min in line 14:1, F700 mm/min in line 14:1\n"));
}

TEST(ProgramSummary, NamesEveryMCodeThatTheMachineDoesNotHave) {
  const auto summary = on_ac_table("G21 G90 G54\nM13\nG0 X1 M128\nM8\nM13\nG0 X3\nM500\nM30\n");
  EXPECT_FALSE(summary.good);
  const auto& unknown = summary.json["unknown_m"];
  ASSERT_EQ(unknown.size(), 3u) << summary.text;
  EXPECT_EQ(unknown[0]["name"], "M13");
  EXPECT_EQ(unknown[0]["blocks"], 2);
  EXPECT_EQ(unknown[1]["name"], "M128");
  EXPECT_EQ(unknown[1]["column"], 7);
  EXPECT_EQ(unknown[2]["line"], 7);
  EXPECT_FALSE(summary.json.contains("error"));
  EXPECT_EQ(summary.json["work_offsets"][0]["tip"]["X"]["to"], 3) << "what is behind them counts";
  EXPECT_THAT(summary.text, HasSubstr("unknown M code line 3:7: M128, Heidenhain: tool tip control on"));
  EXPECT_TRUE(on_ac_table("G21 G90 G54\nG0 X1 M8\nM30\n").good);
}

// M29 asks for what is always so.
TEST(ProgramSummary, MCodesThatNeedNoLogicAreKnown) {
  const auto rigid = on_ac_table("G21 G90 G54\nM29 S500\nG0 X1\nM30\n");
  EXPECT_TRUE(rigid.good) << rigid.text;
  EXPECT_TRUE(rigid.json["unknown_m"].empty());
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[parameter::macro_m_code.number()].value = 200;
  tables.parameters.values[parameter::subprogram_m_code.number()].value = 201;
  SurveyedMachine machine(tables);
  const auto calls =
      summarize(machine, "G21 G90 G54\nM200 X5\nM201 M8\nM30\nO9020\nG0 X#24\nM99\nO9001\nG0 Y3\nM99\n",
                machine.reference_position());
  EXPECT_TRUE(calls.good) << calls.text;
  EXPECT_TRUE(calls.json["unknown_m"].empty());
  EXPECT_THAT(calls.text, HasSubstr("calls    O9020, O9001\n"));
}

TEST(ProgramSummary, CountsTheLinesThatAreWrittenToAFile) {
  const auto summary = on_ac_table("G21 G90 G54\nG0 X1\nDPRNT[A]\nDPRNT[B]\nM30\n");
  EXPECT_EQ(summary.json["printed_lines"], 2);
  EXPECT_THAT(summary.text, HasSubstr("prints   2 lines of DPRNT\n"));
  EXPECT_THAT(on_ac_table("G21 G90 G54\nG0 X1\nM30\n").text, Not(HasSubstr("DPRNT")));
}

TEST(ProgramSummary, SequenceNumbersAndM198AreCallsToo) {
  const auto summary = on_ac_table("G21 G90 G54\nM98 Q10\nM198 P7\nM30\nN10 G0 X1\nM99\nO7\nG0 X2\nM99\n");
  EXPECT_TRUE(summary.good) << summary.text;
  EXPECT_THAT(summary.text, HasSubstr("calls    N10, O0007\n"));
}

// Turned by 90 degrees about Z as it is clamped, the tip still goes 10 mm along the X of the drawing.
TEST(ProgramSummary, TheTipIsInTheWorkpieceAsItIsClamped) {
  auto machine = ac_table();
  const auto summary =
      summarize(machine,
                "G21 G90 G54 G17\nG10 L23 P1 X5 Y7 Z0 A0 B0 C90\nT1 M6\nS1000 M3\nG43 H1\nG54.4 P1\n"
                "G0 X0 Y0 Z50\nG1 X10 F500\nG54.4 P0\nM30\n",
                machine.reference_position());
  EXPECT_TRUE(summary.good) << summary.text;
  const auto& tip = summary.json["work_offsets"][0]["tip"];
  EXPECT_NEAR(tip["X"]["from"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(tip["X"]["to"].get<double>(), 10, 1e-9);
  EXPECT_NEAR(tip["Y"]["from"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(tip["Y"]["to"].get<double>(), 0, 1e-9);
}

TEST(ProgramSummary, AnAlarmIsAtItsEnd) {
  const auto summary = on_ac_table("G21 G90 G54\nG0 X1\nG0 X9000\nM30\n");
  EXPECT_FALSE(summary.good);
  EXPECT_EQ(summary.json["error"]["number"], 140);
  EXPECT_EQ(summary.json["error"]["line"], 3);
  EXPECT_THAT(summary.json["error"]["text"].get<std::string>(), HasSubstr("X would go to 9000.0000"));
  EXPECT_THAT(summary.text, HasSubstr("part.nc:3: 140: X would go to 9000.0000"));
  const auto foreign = on_ac_table("TRAORI\n");
  EXPECT_EQ(foreign.json["error"]["number"], 1540);
  EXPECT_THAT(foreign.json["error"]["remedy"].get<std::string>(), HasSubstr("Siemens: "));
}

TEST(ProgramSummary, WithoutAMachineRapidsHaveNoTime) {
  DefaultMachine machine({});
  const auto summary = summarize(machine, one_tool, {});
  EXPECT_TRUE(summary.good) << summary.text;
  EXPECT_FALSE(summary.json["seconds"].contains("rapid"));
  EXPECT_FALSE(summary.json["seconds"].contains("total"));
  EXPECT_NEAR(summary.json["seconds"]["cut"].get<double>(), 19.5398224, 1e-6);
  EXPECT_EQ(summary.json["axes"], nlohmann::json::object());
  EXPECT_FALSE(summary.json["tools"][0].contains("length"));
  EXPECT_THAT(summary.text, HasSubstr("rapids over 50.000 mm have no time without --machine\n"));
  EXPECT_THAT(summary.text, Not(HasSubstr("mm long")));
}

TEST(ProgramSummary, HasTheWarnings) {
  const auto summary =
      on_ac_table("G21 G90 G54 G17\nT1 M6\nS1000 M3\nG43 H1 G0 Z50\nG41 G1 X10 F500\nX20\nG40 X30\nM30\n");
  ASSERT_EQ(summary.json["warnings"].size(), 1u) << summary.text;
  EXPECT_EQ(summary.json["warnings"][0]["warning"], "radius_missing");
  EXPECT_EQ(summary.json["warnings"][0]["line"], 5);
  EXPECT_EQ(summary.json["warnings"][0]["column"], 1);
  EXPECT_THAT(summary.text, HasSubstr("warning  line 5:1: G41 or G42 without D"));
}

TEST(ProgramSummary, ALoopWithoutEndIsCountedOnce) {
  const auto summary = on_ac_table("N1 G0 X1\nX2\nM99 P1\n");
  EXPECT_TRUE(summary.good);
  EXPECT_EQ(summary.json["repeats_from"], 1);
  EXPECT_THAT(summary.text, HasSubstr("part.nc:1: the program repeats for ever from line 1;"));
}

TEST(ProgramSummary, ProgressEndsAtTheLastLine) {
  auto machine = ac_table();
  language::StringSource source(one_tool);
  std::ostringstream out;
  CheckOptions options;
  std::uint64_t line = 0, lines = 0;
  options.progress = [&](std::uint64_t at, std::uint64_t of) { line = at, lines = of; };
  summarize_program(source, machine, machine.reference_position(), options, text_name, out);
  EXPECT_EQ(line, 9u);
  EXPECT_EQ(lines, 9u);
}

TEST(ProgramSummary, DurationsAndOffsetsAsPeopleReadThem) {
  EXPECT_EQ(duration(0), "0.0 s");
  EXPECT_EQ(duration(99.94), "99.9 s");
  EXPECT_EQ(duration(100), "0:01:40 h");
  EXPECT_EQ(duration(3725.6), "1:02:06 h");
  EXPECT_EQ(work_offset_name(0), "G54");
  EXPECT_EQ(work_offset_name(5), "G59");
  EXPECT_EQ(work_offset_name(6), "G54.1 P1");
  EXPECT_EQ(work_offset_name(53), "G54.1 P48");
}

}  // namespace
}  // namespace trunnion::analysis
