// SPDX-License-Identifier: Apache-2.0
// What --jsonl writes, read back with a JSON parser.
#include "analysis/json_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/check_program.hpp"
#include "analysis/default_machine.hpp"

namespace trunnion::analysis {
namespace {

using Json = nlohmann::ordered_json;

/// The lines of a program on the default machine.
std::vector<Json> lines_of(const std::string& program, bool* good = nullptr,
                           std::optional<ToolRows> tools = {}) {
  DefaultMachine machine(std::move(tools));
  language::StringSource source(program);
  std::ostringstream out;
  CheckOptions options;
  options.json_lines = true;
  const bool result = check_program(
      source, machine, {}, options, [](std::uint32_t) { return "program.nc"; }, out);
  if (good != nullptr) *good = result;
  std::vector<Json> lines;
  std::istringstream text(out.str());
  for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
  return lines;
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> result;
  for (const auto& [key, value] : object.items()) result.push_back(key);
  return result;
}

using testing::ElementsAre;

TEST(JsonLines, RapidAndLineWithTheirFeed) {
  bool good = false;
  const auto lines = lines_of("G54 G90\nG0 X1 Y-2.5\nG1 Z3 F100\nM30\n", &good);
  EXPECT_TRUE(good);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(keys(lines[0]), ElementsAre("n", "kind", "mcs", "wcs", "feed"));
  EXPECT_EQ(lines[0], Json::parse(R"({"n":2,"kind":"rapid","mcs":{"X":1,"Y":-2.5,"Z":0},
                                      "wcs":{"X":1,"Y":-2.5,"Z":0},"feed":null})"));
  EXPECT_EQ(lines[1], Json::parse(R"({"n":3,"kind":"line","mcs":{"X":1,"Y":-2.5,"Z":3},
                                      "wcs":{"X":1,"Y":-2.5,"Z":3},"feed":100})"));
  EXPECT_EQ(lines[2], Json::parse(R"({"end":true,"mcs":{"X":1,"Y":-2.5,"Z":3}})"));
}

TEST(JsonLines, ArcHasCentrePlaneDirectionAndTurns) {
  // A quarter from (10,0) about (0,0), then a full circle twice, then a helix in ZX.
  const auto lines = lines_of("G0 X10\nG3 X0 Y10 I-10 F50\nG2 J-10 L2\nG18 G2 Z20 K10\n");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(keys(lines[1]),
              ElementsAre("n", "kind", "mcs", "wcs", "feed", "center", "plane", "cw", "turns"));
  EXPECT_EQ(lines[1]["kind"], "arc");
  EXPECT_EQ(lines[1]["center"], Json::parse("[0,0,0]"));
  EXPECT_EQ(lines[1]["plane"], "XY");
  EXPECT_EQ(lines[1]["cw"], false);
  EXPECT_EQ(lines[1]["turns"], 1);
  EXPECT_EQ(lines[2]["cw"], true);
  EXPECT_EQ(lines[2]["turns"], 2);
  EXPECT_EQ(lines[3]["plane"], "ZX");
  EXPECT_EQ(lines[3]["center"], Json::parse("[0,10,10]"));
}

TEST(JsonLines, ToolLengthIsInMachineAndNotInWorkpieceCoordinates) {
  const auto lines = lines_of("G43 H2 Z5\nG49\nZ5\n", nullptr, ToolRows{{2, {50, 3}}});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0]["mcs"]["Z"], 55);
  EXPECT_EQ(lines[0]["wcs"]["Z"], 5);
  EXPECT_EQ(lines[1]["mcs"]["Z"], 5);
}

TEST(JsonLines, MoveWithoutLengthIsLeftOut) {
  EXPECT_EQ(lines_of("G0 X1\nX1\nG91 X0\nG90 G1 X1 F5\n").size(), 2u);  // one move and the end
}

TEST(JsonLines, FeedOfEveryMode) {
  const auto lines = lines_of("G93 G1 X10 F2\nG94 X20 F7\nG95 X30 F0.5\nS200 X40\nG20 G94 X2 F1\n");
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0]["feed"], 20);  // 10 mm twice a minute
  EXPECT_EQ(lines[1]["feed"], 7);
  EXPECT_TRUE(lines[2]["feed"].is_null());  // no spindle speed yet
  EXPECT_EQ(lines[3]["feed"], 100);         // 0.5 mm * 200 / min
  EXPECT_NEAR(lines[4]["feed"].get<double>(), 25.4, 1e-12);
}

TEST(JsonLines, AlarmIsTheLastLine) {
  bool good = true;
  const auto lines = lines_of("G0 X1\nG0 X2 Q\"5\n", &good);
  EXPECT_FALSE(good);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(
      lines[1],
      Json::parse(R"({"error":{"line":2,"column":7,"number":1005,"text":"letter without a number: Q"}})"));
}

TEST(JsonLines, AlarmAtAWordOfAnotherControlHasARemedy) {
  const auto lines = lines_of("TRAFOOF\n");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["error"]["number"], 1540);
  EXPECT_EQ(lines[0]["error"]["remedy"], "Siemens: transformation off. Here: G49.");
}

TEST(JsonLines, AlarmInASubprogramSaysWhoCalled) {
  const auto lines = lines_of("G0 X1\nM98 P7\nM30\nO7\nG65 P8\nM99\nO8\n#3000=1(\"STOP\\NOW\")\nM99\n");
  ASSERT_EQ(lines.size(), 2u);
  const Json& error = lines[1]["error"];
  EXPECT_EQ(error["line"], 8);
  EXPECT_EQ(error["text"], "alarm of the program: #3000=1(\"STOP\\NOW\")");
  EXPECT_EQ(error["called_from"], Json::parse(R"([{"line":5},{"line":2}])"));
}

TEST(JsonLines, RotaryWordOnTheDefaultMachineIsAnAlarm) {
  const auto lines = lines_of("G0 A10\n");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0]["error"]["number"], 1109);
}

TEST(JsonLines, ManyLinesAreWrittenWhole) {
  std::string program = "G91 G1 F100\n";
  for (int i = 0; i < 5000; ++i) program += "X0.001 Y-0.123456789\n";
  const auto lines = lines_of(program);
  ASSERT_EQ(lines.size(), 5001u);
  EXPECT_NEAR(lines[4999]["mcs"]["X"].get<double>(), 5, 1e-9);
}

TEST(JsonLines, StringsAreEscaped) {
  EXPECT_EQ(Json::parse(json_string("a\"b\\c\n\t\x01 ä")), "a\"b\\c\n\t\x01 ä");
}

}  // namespace
}  // namespace trunnion::analysis
