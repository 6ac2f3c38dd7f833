// SPDX-License-Identifier: Apache-2.0
#include "core/program_plan.hpp"

#include <gtest/gtest.h>

#include "parameter_store/machine_tables.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

class ProgramPlan : public testing::Test {
 protected:
  Json plan(
      std::string_view text, const std::function<bool()>& stop = [] { return false; }) {
    language::StringSource source(text);
    return plan_document(source, machine_, stop);
  }
  channel_setup::ChannelSetup machine_{tool_tables::load_machine_tables(MACHINES_DIRECTORY "/ac-table")};
};

TEST_F(ProgramPlan, HasTheTimeOfTheMotionLineByLine) {
  // 60 mm at 600 mm/min are 6 s, and the dwell is 2 s; speeding up and braking add less than 0.1 s.
  const auto answer = plan("G54 G0 X-10 Y0\nG1 X50 F600\nG4 P2000\nG1 Y6 F600\nM30\n");
  EXPECT_TRUE(answer["complete"]);
  EXPECT_FALSE(answer.contains("alarm")) << answer["alarm"];
  const auto& line = answer["lines"]["line"];
  const auto& begin = answer["lines"]["begin"];
  ASSERT_EQ(line.size(), begin.size());
  const auto begin_of = [&](unsigned wanted) {
    for (std::size_t i = 0; i < line.size(); ++i)
      if (line[i] == wanted) return begin[i].get<double>();
    return -1.0;
  };
  EXPECT_NEAR(begin_of(4) - begin_of(2), 8, 0.1);
  EXPECT_NEAR(answer["seconds"].get<double>() - begin_of(4), 0.6, 0.1);
  const auto& path = answer["path"];
  EXPECT_EQ(path["x"].size(), path["seconds"].size());
  EXPECT_NEAR(path["x"].back().get<double>(), 50, 1e-3);
  EXPECT_NEAR(path["y"].back().get<double>(), 6, 1e-3);
  EXPECT_EQ(path["rapid"][1], true);
}

TEST_F(ProgramPlan, SaysInWhichDialectTheTextIsRead) {
  EXPECT_EQ(plan("G0 X1\nM30\n")["dialect"], "iso");
  EXPECT_EQ(plan("(DIALECT: HAAS)\nG0 X1.\nM30\n")["dialect"], "haas");
}

TEST_F(ProgramPlan, EndsAtTheLineThatCannotBeExecutedAndSaysWhy) {
  const auto answer = plan("G54 G0 X0 Y0\nG1 X60 F600\nG1 X9000\nG1 X0\n");
  ASSERT_TRUE(answer.contains("alarm"));
  EXPECT_NE(answer["alarm"].get<std::string>().find("3"), std::string::npos) << answer["alarm"];
  EXPECT_NEAR(answer["path"]["x"].back().get<double>(), 60, 1e-3) << "what is before it is on the path";
}

TEST_F(ProgramPlan, GoesOnBehindACycleOfAnotherService) {
  const auto answer = plan("G54 G0 X0\nG65 P9010\nG1 X[20+#3100] F6000\nM30\nO9010\n#3100=12\nM99\n");
  EXPECT_FALSE(answer.contains("alarm")) << answer["alarm"];
  EXPECT_NEAR(answer["path"]["x"].back().get<double>(), 20, 1e-3) << "the cycle has no parts";
}

TEST_F(ProgramPlan, IsNotCompleteWhenItsTimeIsOver) {
  int asked = 0;
  const auto answer = plan("G54 G0 X0\nG1 X60 F60\nM30\n", [&] { return ++asked > 10; });
  EXPECT_EQ(answer["complete"], false);
  EXPECT_LT(answer["seconds"].get<double>(), 30);
  EXPECT_GT(answer["path"]["x"].size(), 1u);
}

TEST_F(ProgramPlan, OfAProgramThatRepeatsWithoutAMoveIsStoppedToo) {
  int asked = 0;
  const auto answer = plan("WHILE [1 EQ 1]\n#1=#1+1\nENDW\nM30\n", [&] { return ++asked > 0; });
  EXPECT_EQ(asked, 1) << "it reads some millions of blocks in between";
  EXPECT_EQ(answer["complete"], false);
  EXPECT_EQ(answer["seconds"], 0);
}

TEST_F(ProgramPlan, RepeatsTheLinesOfALoopInTheirOrder) {
  const auto answer =
      plan("#1=0\nG54 G0 X0 Y0 Z0\nWHILE [#1 LT 3]\nG1 X10 F6000\nG1 X0\n#1=#1+1\nENDW\nM30\n");
  std::vector<unsigned> lines;
  for (const auto& one : answer["lines"]["line"])
    if (one == 4u || one == 5u) lines.push_back(one);
  EXPECT_EQ(lines, (std::vector<unsigned>{4, 5, 4, 5, 4, 5}));
}

}  // namespace
}  // namespace trunnion::gateway
