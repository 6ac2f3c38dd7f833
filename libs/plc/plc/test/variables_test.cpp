// SPDX-License-Identifier: Apache-2.0
// Variables by their path, and what new programs keep of the old ones.
#include "plc/tools/variables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "plc/library/register_names.hpp"

namespace trunnion::st {
namespace {

Compilation compiled(const std::string& source) {
  auto result = compile({{"t.st", source}}, interface_registers());
  EXPECT_TRUE(result.good()) << testing::PrintToString(result.lines());
  return result;
}

constexpr const char* conveyor =
    "TYPE Limits : STRUCT low, high : INT; END_STRUCT; Mode : (idle, moving); END_TYPE\n"
    "FUNCTION_BLOCK Conveyor\n"
    "VAR_INPUT start : BOOL; END_VAR VAR_IN_OUT total : DINT; END_VAR\n"
    "VAR timer : TON; mode : Mode; lamp AT %Y3.1 : BOOL; END_VAR VAR CONSTANT most : INT := 9; END_VAR\n"
    "timer(IN := start, PT := T#1s); IF start THEN mode := moving; lamp := TRUE; total := total + most; "
    "END_IF;\n"
    "END_FUNCTION_BLOCK\n"
    "PROGRAM fast\n"
    "VAR conveyor : Conveyor; limits : ARRAY[1..2, 0..1] OF Limits; sum : DINT; word AT %G300 : INT; "
    "END_VAR\n"
    "VAR RETAIN hours : UDINT; END_VAR VAR CONSTANT pi : REAL := 3.14; END_VAR\n"
    "conveyor(start := limits[1,0].low > 0, total := sum); hours := hours + 1; word := REAL_TO_INT(pi);\n"
    "END_PROGRAM\n";

std::string refusal(const Variables& variables, const std::string& path) {
  try {
    variables.find_elementary(path);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(Variables, AreFoundByPathInBlocksArraysAndStructures) {
  const auto compilation = compiled(conveyor);
  const Variables variables(compilation);
  EXPECT_EQ(variables.find("FAST.conveyor.TIMER.et").path, "fast.conveyor.timer.ET");
  EXPECT_EQ(variables.find("conveyor.mode").type->name, "Mode");
  // Elements of two cells; [2,1] is the last of four.
  const auto first = variables.find("fast.limits[1,0].low"), last = variables.find("fast.limits[2,1].high");
  EXPECT_EQ(last.address, first.address + 7);
  EXPECT_TRUE(variables.find("hours").retained);
  EXPECT_FALSE(variables.find("sum").retained);
  const auto lamp = variables.find("fast.conveyor.lamp");
  EXPECT_TRUE(lamp.is_register());
  EXPECT_EQ(lamp.bit, 1);
}

TEST(Variables, RegistersAreFoundByAddressAndByNameWithTheirUnit) {
  const Variables variables;
  EXPECT_EQ(variables.find("spindle_speed_1").unit, "1/min");
  EXPECT_EQ(variables.find("%G2972").address, variables.find("spindle_speed_1").address);
  // As the manuals print them, and their names.
  const std::map<std::string, std::string> named = {{"%G2960.3", "external_reset"},
                                                    {"%F2636.10", "lathe_0"},
                                                    {"%F2716.10", "lathe_1"},
                                                    {"%G2622.0", "jog_exchanged_0"},
                                                    {"%G2621.0", "handwheel_exchanged_0"},
                                                    {"%K15.6", "slave_off_switch"},
                                                    {"%W50", "pid_spindle_output"},
                                                    {"%B30", "pid_target"},
                                                    {"%B31", "pid_sample"},
                                                    {"%B44", "pid_output"},
                                                    {"%B188", "lathe_tool_0"},
                                                    {"%B197", "milling_tool_0"},
                                                    {"%B204", "milling_tool_1"},
                                                    {"%X4.5", "probe_contact"},
                                                    {"%Y485.1", "pid_start"},
                                                    {"%G420", "pid_feedback_5"},
                                                    {"%G160.11", "slave_off_2"},
                                                    {"%G220", "control_mode_2"}};
  for (const auto& [printed, name] : named) {
    const auto at = variables.find(printed);
    EXPECT_EQ(at.path, printed);
    EXPECT_EQ(variables.find(name).address, at.address) << name;
    EXPECT_EQ(variables.find(name).bit, at.bit) << name;
  }
  EXPECT_TRUE(variables.find("%K15.6").retained);
}

TEST(Variables, AreRefusedInOneLineThatSaysWhy) {
  const Variables variables(compiled(conveyor));
  EXPECT_EQ(refusal(variables, "fast.none"), "'fast.none': there is no such variable");
  EXPECT_EQ(refusal(variables, "fast.conveyor.none"), "'fast.conveyor.none': there is no variable 'NONE'");
  EXPECT_EQ(refusal(variables, "fast.conveyor"), "'fast.conveyor': it is Conveyor; name one of its elements");
  EXPECT_EQ(refusal(variables, "fast.limits[3,0].low"),
            "'fast.limits[3,0].low': the index is outside 1 .. 2");
  EXPECT_EQ(refusal(variables, "fast.limits[1].low").substr(0, 22), "'fast.limits[1].low': ");
  EXPECT_EQ(refusal(variables, "fast.sum.x"), "'fast.sum.x': DINT has no members");
  EXPECT_EQ(refusal(variables, "fast.pi"), "'fast.pi': it is a constant");
  EXPECT_EQ(refusal(variables, "conveyor.most"), "'conveyor.most': it is a constant");
  EXPECT_EQ(refusal(variables, "conveyor.total"),
            "'conveyor.total': it is VAR_IN_OUT and has no value of its own");
  EXPECT_EQ(refusal(variables, "%G4000"), "'%G4000': the number is outside 0 .. 3359");
}

TEST(Variables, EveryElementIsListedOnceAndIsFoundByItsPath) {
  const Variables variables(compiled(conveyor));
  const auto all = variables.all();
  std::set<std::string> paths;
  for (const auto& at : all) {
    EXPECT_TRUE(paths.insert(at.path).second) << at.path;
    const auto found = variables.find(at.path);
    EXPECT_EQ(found.address, at.address) << at.path;
    EXPECT_EQ(found.bit, at.bit) << at.path;
    if (!at.is_register()) {
      EXPECT_EQ(variables.path_at(at.address, -1), at.path);
    }
  }
  // conveyor: start, mode, lamp and those of the timer; limits 8, sum, word, hours.
  EXPECT_TRUE(paths.contains("fast.conveyor.timer.Q"));
  EXPECT_EQ(std::count_if(all.begin(), all.end(),
                          [](const auto& at) { return at.path.starts_with("fast.limits"); }),
            8);
}

TEST(Variables, AnIntegerAtARegisterWithoutSignHasItsSign) {
  const Variables variables(compiled(conveyor));
  const auto word = variables.find("fast.word");
  EXPECT_EQ(value_cell(word, 65534), static_cast<std::uint64_t>(-2));
  EXPECT_EQ(register_number_of(word, static_cast<std::uint64_t>(-2)), 65534);
}

TEST(Changeover, KeepsWhatHasTheSamePathAndTypeAndNamesTheRest) {
  const Variables running(compiled(conveyor));
  auto text = std::string(conveyor);
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("sum : DINT; word", "first, sum : DINT; extra : REAL; word");
  replace("hours : UDINT", "hours : ULINT");
  replace("Mode : (idle, moving)", "Mode : (idle, braking, moving)");
  const Variables next(compiled(text));
  const Changeover change(running, next);
  EXPECT_EQ(change.moved(running.find("fast.sum").address), next.find("fast.sum").address);
  EXPECT_EQ(change.moved(running.find("fast.limits[2,1].high").address),
            next.find("fast.limits[2,1].high").address);
  EXPECT_EQ(change.moved(running.find("fast.hours").address), std::nullopt);
  EXPECT_EQ(change.losses(),
            (std::vector<std::string>{
                "fast.conveyor.mode (Mode) becomes Mode: it begins with its initial value",
                "fast.first (DINT) is new: it begins with its initial value",
                "fast.extra (REAL) is new: it begins with its initial value",
                "fast.hours (UDINT, RETAIN) becomes ULINT: it begins with its initial value"}));
  const Changeover back(next, running);
  EXPECT_NE(std::find(back.losses().begin(), back.losses().end(),
                      "fast.extra (REAL) is not in the new programs: its value is lost"),
            back.losses().end());
}

// Random declarations before and after: exactly what has the same name and type is moved, each to its own
// place. The oracle is the list of declarations.
TEST(Changeover, MovesExactlyTheCommonVariables) {
  const char* types[] = {"INT", "DINT", "BOOL", "LREAL", "STRING[9]", "ARRAY[0..3] OF INT", "TON"};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    std::map<std::string, std::string> declared[2];
    std::string sources[2];
    for (int side = 0; side < 2; ++side) {
      std::vector<std::string> names;
      for (int i = 0; i < 12; ++i) names.push_back("v" + std::to_string(i));
      std::shuffle(names.begin(), names.end(), random);
      names.resize(7);
      sources[side] = "PROGRAM main VAR ";
      for (const auto& name : names) {
        declared[side][name] = types[random() % std::size(types)];
        sources[side] += name + " : " + declared[side][name] + "; ";
      }
      sources[side] += "END_VAR END_PROGRAM";
    }
    const Variables running(compiled(sources[0])), next(compiled(sources[1]));
    const Changeover change(running, next);
    std::set<std::uint32_t> targets;
    for (const auto& at : running.all()) {
      const auto name = at.path.substr(5, at.path.find_first_of(".[", 5) - 5);
      const auto other = declared[1].find(name);
      const bool common = other != declared[1].end() && other->second == declared[0][name];
      const auto moved = change.moved(at.address);
      // An element of an array is no INT of that name, so the whole declaration decides.
      ASSERT_EQ(moved.has_value(), common) << "seed " << seed << " " << at.path;
      if (!common) continue;
      EXPECT_EQ(*moved, next.find(at.path).address) << "seed " << seed << " " << at.path;
      EXPECT_TRUE(targets.insert(*moved).second);
    }
  }
}

}  // namespace
}  // namespace trunnion::st
