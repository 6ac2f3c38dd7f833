// SPDX-License-Identifier: Apache-2.0
#include "core/program_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "parameter_store/machine_tables.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

class ProgramCheck : public testing::Test {
 protected:
  Json check(std::string_view text, const std::function<bool()>& stop = {}) {
    language::StringSource source(text);
    return check_program(source, machine_, guard_, stop);
  }
  program_execution::MoveGuard* guard_ = nullptr;
  channel_setup::ChannelSetup machine_{tool_tables::load_machine_tables(MACHINES_DIRECTORY "/ac-table")};
};

TEST_F(ProgramCheck, AProgramWithoutErrorsGivesItsPathByLines) {
  const auto answer = check("G54 G0 X5 Y0\nG1 X10 F100\nG0 Y-5\nM30\n");
  EXPECT_TRUE(answer["complete"]);
  EXPECT_FALSE(answer.contains("error")) << answer["error"];
  EXPECT_EQ(answer["moves"], 3);
  const auto& path = answer["path"];
  ASSERT_EQ(path["x"].size(), 4u) << "the start and three ends";
  EXPECT_TRUE(path["whole"]);
  EXPECT_EQ(path["x"][2], 10);
  EXPECT_EQ(path["y"][3], -5);
  EXPECT_EQ(path["line"], Json({1, 1, 2, 3}));
  EXPECT_EQ(path["rapid"], Json({true, true, false, true}));
}

TEST_F(ProgramCheck, TheFirstErrorHasLineColumnNumberAndText) {
  const auto answer = check("G0 X1\nG1 X2 Q5 F100\nG999\n");
  ASSERT_TRUE(answer.contains("error"));
  EXPECT_EQ(answer["error"]["line"], 2);
  EXPECT_EQ(answer["error"]["column"], 7) << "Q is the seventh character";
  EXPECT_EQ(answer["error"]["number"], 1107);
  EXPECT_EQ(answer["moves"], 1) << "what is before the error is on the path";
}

TEST_F(ProgramCheck, SaysInWhichDialectTheTextIsRead) {
  EXPECT_EQ(check("G0 X0\nM30\n")["dialect"], "iso");
  const auto num = check("(DIALECT: NUM)\nG4 F2\nM2\n");
  EXPECT_EQ(num["dialect"], "num");
  EXPECT_FALSE(num.contains("error")) << num["error"];
}

TEST_F(ProgramCheck, AMoveBeyondTheTravelIsTheErrorOfItsLine) {
  const auto answer = check("G54 G0 X0\n\nG0 X9000\n");
  ASSERT_TRUE(answer.contains("error"));
  EXPECT_EQ(answer["error"]["line"], 3);
  EXPECT_EQ(answer["error"]["number"], 140);
}

TEST_F(ProgramCheck, AnArcIsPointsOnItsCircle) {
  const auto answer = check("G54 G0 X10 Y0\nG3 X10 Y0 I-10 F500\nM30\n");
  const auto& path = answer["path"];
  ASSERT_GE(path["x"].size(), 60u) << "360 degrees in pieces of 6";
  for (std::size_t i = 1; i < path["x"].size(); ++i)
    EXPECT_NEAR(std::hypot(path["x"][i].get<double>(), path["y"][i].get<double>()), 10, 1e-3);
}

TEST_F(ProgramCheck, TheErrorOfASubprogramIsShownAtItsCall) {
  language::StringSource other("O7\nG1 X1 F100\nG1 Q3\nM99\n");
  machine_.resolve = [&](std::string_view name) { return name == "O0007" ? &other : nullptr; };
  const auto answer = check("G0 X0\nM98 P7\nM30\n");
  ASSERT_TRUE(answer.contains("error"));
  EXPECT_EQ(answer["error"]["line"], 2);
  EXPECT_EQ(answer["error"]["program_line"], 3);
  EXPECT_EQ(answer["error"]["program"], "O0007");
}

TEST_F(ProgramCheck, AMoveOfASubprogramIsThatOfTheLineThatCallsIt) {
  language::StringSource other("O7\nG0 X20\nM99\n"), far("O8\nG0 X9000\nM99\n");
  machine_.resolve = [&](std::string_view name) {
    return name == "O0007" ? &other : name == "O0008" ? &far : nullptr;
  };
  const auto answer = check("G54 G0 X5 Y0\n\nM98 P7\nM98 P8\nM30\n");
  EXPECT_EQ(answer["path"]["line"], Json({1, 1, 3}));
  EXPECT_EQ(answer["error"]["line"], 4);
  EXPECT_EQ(answer["error"]["number"], 140);
  EXPECT_EQ(answer["error"]["program"], "O0008");
  EXPECT_EQ(answer["error"]["program_line"], 2);
}

TEST_F(ProgramCheck, WhatMotionRefusesIsAnError) {
  const auto answer = check("G54 G0 X0\nG95 G1 X10 F0.1\nM30\n");
  ASSERT_TRUE(answer.contains("error")) << "the spindle has no speed";
  EXPECT_EQ(answer["error"]["line"], 2);
  EXPECT_EQ(answer["error"]["number"], 1112);
}

/// A body beyond X20, found at the second time it is asked for.
class BodyBeyond final : public program_execution::MoveGuard {
 public:
  void begin_run() override {}
  void begin_call() override {}
  Verdict check(const language::AxisValues&, const language::Command& move) override {
    if (++asked_ % 2 == 1) return Verdict::unfinished;
    if (move.target[language::X] <= 20) return Verdict::free;
    text_ = std::to_string(move.line) + ": head and post would come nearer than 2 mm" + std::string(200, '.');
    return Verdict::contact;
  }
  const std::string& contact_text() const override { return text_; }

 private:
  unsigned asked_ = 0;
  std::string text_;
};

TEST_F(ProgramCheck, BodiesThatWouldMeetAreAnErrorWithTheirWholeText) {
  BodyBeyond body;
  guard_ = &body;
  const auto answer = check("G54 G0 X5\nX20\nX25\nM30\n");
  ASSERT_TRUE(answer.contains("error"));
  EXPECT_EQ(answer["error"]["line"], 3);
  EXPECT_EQ(answer["error"]["number"], 176);
  EXPECT_EQ(answer["error"]["text"].get<std::string>(),
            "head and post would come nearer than 2 mm" + std::string(200, '.'));
  EXPECT_EQ(answer["moves"], 2);
}

TEST_F(ProgramCheck, AProgramThatRepeatsForEverIsCompleteAtItsReturn) {
  const auto answer = check("G54 G0 X0\nN1 X5\nX0\nGOTO 1\n");
  EXPECT_TRUE(answer["complete"]);
  EXPECT_FALSE(answer.contains("error"));
}

TEST_F(ProgramCheck, AnEndlessProgramIsStopped) {
  unsigned asked = 0;
  const auto answer = check("N1 IF [#3001 LT 1] GOTO 1\nM30\n", [&] { return ++asked > 3; });
  EXPECT_FALSE(answer["complete"]);
  EXPECT_FALSE(answer.contains("error"));
}

TEST_F(ProgramCheck, ALongPathIsCutOffAndSaysSo) {
  const auto answer = check("G54 G0 X0 Y0\nWHILE [#1 LT 10001] DO 1\nG1 X1 F100\nG1 X0\n#1=#1+1\nEND 1\n");
  EXPECT_FALSE(answer["path"]["whole"]);
  EXPECT_EQ(answer["path"]["x"].size(), most_path_points);
}

}  // namespace
}  // namespace trunnion::gateway
