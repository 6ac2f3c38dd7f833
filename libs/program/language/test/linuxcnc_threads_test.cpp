// SPDX-License-Identifier: Apache-2.0
// Threads of the LinuxCNC dialect. The moves are those that rs274 of LinuxCNC 2.9 gives, but for the way in
// before a tapered entry, which is a rapid here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

TEST(LinuxcncThreads, TheLeadIsAlongTheWay) {
  // The way is 5 mm and Z goes 4 of them: 0.8 mm of Z per revolution.
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33 X3 Z-4 K1\nZ-8 K2"),
              ElementsAre("S100", "M3", "thread X3 Z-4 lead0.8", "thread X3 Z-8 lead2"));
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33 X3 Z-4 K1\nZ-8"),
              ElementsAre("S100", "M3", "thread X3 Z-4 lead0.8", "alarm 1108 3:1"));
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33 Z-4 K1 F100"), ElementsAre("S100", "M3", "alarm 1107 2:12"));
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33 Z-4 K0"), ElementsAre("S100", "M3", "alarm 1128 2:9"));
  EXPECT_THAT(linuxcnc_blocks("S100\nG33 Z-4 K1"), ElementsAre("S100", "alarm 1129 2:1"));
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33 K1"), ElementsAre("S100", "M3", "alarm 1108 2:1"));
}

TEST(LinuxcncThreads, EveryThreadBeginsAtTheIndexMark) {
  TestMachine machine = linuxcnc_machine();
  const Interpretation result = run(machine, "S100 M3\nG33 Z-4 K1\nZ-8 K1\nM2\n");
  ASSERT_EQ(result.commands.size(), 6u);
  EXPECT_EQ(result.commands[2].number, 1u);
  EXPECT_EQ(result.commands[3].number, 1u);
  EXPECT_EQ(result.commands[3].modal.motion, 33);
}

TEST(LinuxcncThreads, RigidTappingGoesInAndOut) {
  EXPECT_THAT(linuxcnc_blocks("S100 M3 G0 Z2\nG33.1 Z-9 K1 I2"),
              ElementsAre("S100", "M3", "rapid Z2", "M5", "tap Z-9 lead1", "tap Z2 lead1 S200", "M3"));
  // Without an I above 1 the way out is as fast. The code stays.
  EXPECT_THAT(linuxcnc_blocks("S100 M4 G0 X2\nG33.1 X-9 K1.5 I.5\nX-3 K1"),
              ElementsAre("S100", "M4", "rapid X2", "M5", "tap X-9 lead-1.5", "tap X2 lead-1.5", "M4", "M5",
                          "tap X-3 lead-1", "tap X2 lead-1", "M4"));
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33.1 X1 Z-9 K1"), ElementsAre("S100", "M3", "alarm 1192 2:1"));
  EXPECT_THAT(linuxcnc_blocks("S100\nG33.1 Z-9 K1"), ElementsAre("S100", "alarm 1129 2:1"));
  EXPECT_THAT(linuxcnc_blocks("S100 M3\nG33.1 Z0 K1"), ElementsAre("S100", "M3", "alarm 1106 2:7"));
  TestMachine machine = linuxcnc_machine();
  machine.highest_speed = 150;
  EXPECT_THAT(stream(run(machine, "S100 M3\nG33.1 Z-9 K1 I2\nM2\n")),
              ElementsAre("S100", "M3", "alarm 1126 2:14"));
}

TEST(LinuxcncThreads, PassesGoDeeperUntilTheFullHeight) {
  const std::vector<std::string> cuts{"S100",
                                      "M3",
                                      "rapid X10 Z5",
                                      "rapid X10.4 Z5",
                                      "rapid X7.8 Z5",
                                      "thread X7.8 Z-10 lead1",
                                      "rapid X10.4 Z-10",
                                      "rapid X10.2 Z5",
                                      "rapid X7.6 Z5",
                                      "thread X7.6 Z-10 lead1",
                                      "rapid X10.2 Z-10",
                                      "rapid X10 Z5",
                                      "rapid X7.4 Z5",
                                      "thread X7.4 Z-10 lead1",
                                      "rapid X10 Z-10",
                                      "rapid X10 Z5",
                                      "rapid X7.4 Z5",
                                      "thread X7.4 Z-10 lead1",
                                      "rapid X10 Z-10"};
  EXPECT_THAT(linuxcnc_blocks("G18 S100 M3\nG0 X10 Z5\nG76 P1 Z-10 I-2 J.2 K.6 H1"), ElementsAreArray(cuts));
  // Where X is programmed as a diameter I J K are diameters.
  TestMachine machine = linuxcnc_machine();
  machine.diameter = true;
  std::vector<std::string> with_end = cuts;
  with_end.emplace_back("M5");
  with_end.emplace_back("end 2");
  EXPECT_THAT(stream(run(machine, "G18 S100 M3\nG0 X20 Z5\nG76 P1 Z-10 I-4 J.4 K1.2 H1\nM2\n")),
              ElementsAreArray(with_end));
}

TEST(LinuxcncThreads, TapersKeepThePitchAlongZ) {
  TestMachine machine = linuxcnc_machine();
  const Interpretation result =
      run(machine, "G61 G18 S100 M3\nG0 X10 Z5\nG76 P1 Z-10 I-2 J.5 K.6 E.5 L3\nM2\n");
  EXPECT_THAT(
      stream(result),
      ElementsAre("S100", "M3", "rapid X10 Z5", "rapid X10.1 Z5", "rapid X8.1 Z5", "thread X7.5 Z4.5 lead1.2",
                  "thread X7.5 Z-9.5 lead1", "thread X8.1 Z-10 lead1.2", "rapid X10.1 Z-10", "rapid X10 Z5",
                  "rapid X8 Z5", "thread X7.4 Z4.5 lead1.2", "thread X7.4 Z-9.5 lead1",
                  "thread X8 Z-10 lead1.2", "rapid X10 Z-10", "M5", "end 2"));
  // The three are one thread, in spite of G61.
  const std::size_t first = 5;
  ASSERT_GT(result.commands.size(), first + 3);
  EXPECT_EQ(result.commands[first].number, 1u);
  EXPECT_EQ(result.commands[first + 1].number, 0u);
  EXPECT_EQ(result.commands[first + 2].number, 0u);
  EXPECT_EQ(result.commands[first + 1].modal.path_control, PathControl::continuous);
  EXPECT_EQ(result.commands[first + 3].modal.path_control, PathControl::exact_stop);
}

TEST(LinuxcncThreads, TheSlideAngleMovesThePassesAlongZ) {
  ThreadPasses::Words words;
  words.pitch = 1;
  words.start_x = 10, words.start_z = 5, words.end_z = -10;
  words.peak = -2, words.first = 0.2, words.height = 0.6;
  words.degression = 2, words.angle = 30;
  ThreadPasses passes;
  passes.start(words);
  ThreadPasses::Pass pass;
  ASSERT_TRUE(passes.next(pass));
  EXPECT_NEAR(pass.begin_z, 4.8845, 5e-5);
  EXPECT_NEAR(pass.end_z, -9.7691, 5e-5);
  EXPECT_NEAR(pass.away_x, 10.4, 1e-9);
  ASSERT_TRUE(passes.next(pass));
  EXPECT_NEAR(pass.bottom_x, 7.7172, 5e-5);
  EXPECT_NEAR(pass.begin_z, 4.8367, 5e-5);
  // 0.2 * sqrt(9) is the full height: the ninth pass is the last.
  int count = 2;
  while (passes.next(pass)) ++count;
  EXPECT_EQ(count, 9);
  EXPECT_NEAR(pass.end_z, -10, 1e-9);
  // An inside thread in the other direction.
  words.end_z = 6, words.peak = 2, words.first = 0.5, words.degression = 1;
  passes.start(words);
  ASSERT_TRUE(passes.next(pass));
  EXPECT_NEAR(pass.begin_z, 5.2887, 5e-5);
  EXPECT_NEAR(pass.end_z, 5.9423, 5e-5);
  EXPECT_NEAR(pass.bottom_x, 12.5, 1e-9);
  EXPECT_NEAR(pass.away_x, 9.9, 1e-9);
}

TEST(LinuxcncThreads, WordsOfPassesAreChecked) {
  const auto alarm = [](const std::string& block) { return linuxcnc_blocks("G18 S100 M3\n" + block).back(); };
  EXPECT_EQ(alarm("G17 G76 P1 Z-9 I-2 J.2 K.6"), "alarm 1192 2:5");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2"), "alarm 1108 2:1");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2 K.6 X1"), "alarm 1107 2:24");
  EXPECT_EQ(alarm("G76 P0 Z-9 I-2 J.2 K.6"), "alarm 1128 2:5");
  EXPECT_EQ(alarm("G76 P1 Z-9 I0 J.2 K.6"), "alarm 1106 2:12");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J0 K.6"), "alarm 1106 2:16");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2 K.2"), "alarm 1106 2:20");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2 K.6 R.9"), "alarm 1106 2:24");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.001 K.6 R3"), "alarm 1106 2:26");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2 K.6 Q90"), "alarm 1106 2:24");
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2 K.6 E5 L1"), "alarm 1106 2:24");
  EXPECT_EQ(alarm("G76 P1 Z0 I-2 J.2 K.6"), "alarm 1106 2:8");
  EXPECT_EQ(alarm("M5\nG76 P1 Z-9 I-2 J.2 K.6"), "alarm 1129 3:1");
  // The code stays, its words do not.
  EXPECT_EQ(alarm("G76 P1 Z-9 I-2 J.2 K.6\nZ-10"), "alarm 1108 3:1");
}

}  // namespace
}  // namespace trunnion::language::test
