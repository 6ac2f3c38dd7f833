// SPDX-License-Identifier: Apache-2.0
// Taps and threads of the NUM dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "num_program.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

// The example of the document, from EH 2: 202 mm at 1.25 mm per revolution, out at 2.5 times 500 1/min.
TEST(NumDialect, ATapHasItsLeadAndTheSpeedOfItsWayOut) {
  EXPECT_THAT(num_stream("G71 S500 M3\nG0 Z10\nG84 Z-200 K1.25 EK2.5 EH2 M5\nM2"),
              ElementsAre("S500", "M3", "rapid Z10", "rapid Z2", "M5", "tap Z-200 lead1.25",
                          "tap Z2 lead1.25 S1250", "M5", "end 2"));
  // 60 1/min times 2.
  EXPECT_THAT(num_stream("S60 M3 Z4\nG84 Z1 K1 EK2\nM2"),
              ElementsAre("S60", "M3", "rapid Z4", "M5", "tap Z1 lead1", "tap Z4 lead1 S120", "M3", "end 2"));
  TestMachine machine = num_machine();
  machine.highest_speed = 100;
  EXPECT_EQ(std::string(run(machine, "S60 M3 G84 Z-1 K1 EK2").alarm.text.data()),
            std::string(alarm_text(AlarmNumber::spindle_speed_above)) +
                ": EK, S times EK 120, at most 100 1/min (10a948)");
}

// 500 1/min times 2.5.
TEST(NumDialect, BothStrokesOfATapTellTheFasterOne) {
  const auto speeds = [](const std::string& text) {
    TestMachine machine = num_machine();
    const Interpretation result = run(machine, text);
    std::vector<double> fastest;
    for (const Command& command : result.commands)
      if (command.kind == CommandKind::tap) fastest.push_back(fastest_stroke(command));
    return fastest;
  };
  EXPECT_THAT(speeds("S500 M3\nG84 Z-200 K1.25 EK2.5 EH2\nM2"), ElementsAre(1250, 1250));
  EXPECT_THAT(speeds("S500 M3\nG84 Z-200 K1.25 EK.5 EH2\nM2"), ElementsAre(500, 250));
  EXPECT_THAT(speeds("S500 M3\nG84 Z-200 K1.25 EH2\nM2"), ElementsAre(500, 500));
}

TEST(NumDialect, BehindATapTheSpindleTurnsAsBeforeOrStandsWithM5) {
  TestMachine machine = num_machine();
  EXPECT_EQ(run(machine, "S60 M4 G84 Z-1 K1\nM2").modal.spindle_direction, SpindleDirection::ccw);
  EXPECT_EQ(run(machine, "S60 M4 G84 Z-1 K1 M5\nM2").modal.spindle_direction, SpindleDirection::stopped);
  // M4 cuts a left-hand thread. F is the feed behind it, G80 ends the cycle.
  EXPECT_THAT(num_stream("S60 M4 Z1\nG84 Z-1 K1 F200\nL0=[.RG80]\nG80\nG1 Z3 XL0\nM2"),
              ElementsAre("S60", "M4", "rapid Z1", "M5", "tap Z-1 lead-1", "tap Z1 lead-1", "M4",
                          "line X84 Z3 F200", "end 2"));
}

TEST(NumDialect, LeadAndLevelsOfATapAreInTheUnitOfTheProgram) {
  // 0.05 inch = 1.27 mm, 0.1 = 2.54 mm, 0.5 = 12.7 mm; EK is a ratio.
  EXPECT_THAT(num_stream("G70 S500 M3\nG84 Z-1 K.05 EK2 EH.1 ER.5\nM2"),
              ElementsAre("S500", "M3", "rapid Z12.7", "rapid Z2.54", "M5", "tap Z-25.4 lead1.27",
                          "tap Z2.54 lead1.27 S1000", "M3", "rapid Z12.7", "end 2"));
  EXPECT_THAT(
      num_stream("L1=1.25 S500 M3\nG84 Z-1 KL1 EKL1 EH1\nM2"),
      ElementsAre("S500", "M3", "rapid Z1", "M5", "tap Z-1 lead1.25", "tap Z1 lead1.25 S625", "M3", "end 2"));
  // X is a diameter, and so are EH and ER of a tap along it; K is not.
  TestMachine machine = num_machine();
  machine.diameter = true;
  EXPECT_THAT(stream(run(machine, "S100 M3 Z-7\nG84 X20 K2 EH40 ER44\nM2")),
              ElementsAre("S100", "M3", "rapid Z-7", "rapid X22 Z-7", "rapid X20 Z-7", "M5",
                          "tap X10 Z-7 lead2", "tap X20 Z-7 lead2", "M3", "rapid X22 Z-7", "end 2"));
}

// The thread is modal, and still the K of G84 is that of the tap. 500 1/min times 2.
TEST(NumDialect, ATapBetweenThreadsHasItsOwnLead) {
  EXPECT_THAT(num_stream("M3 S500\nG38 K2 Z-1\nG84 Z-5 K1 EK2\nG38 K3 Z-9\nZ-10\nM2"),
              ElementsAre("S500", "M3", "thread Z-1 lead2", "M5", "tap Z-5 lead1", "tap Z-1 lead1 S1000",
                          "M3", "thread Z-9 lead3", "thread Z-10 lead3", "end 2"));
}

// Ten millimetres at a lead of 1.2 mm; clockwise with M3 whatever the direction. The PLC gets no M3, M4 and
// range.
TEST(NumDialect, ATapIsRemovedInTheSenseThatIsWritten) {
  EXPECT_THAT(num_stream("M64 G39+ M3 M41 S200 K1.2 Z10\nX1\nM2"),
              ElementsAre("M64", "S200", "tap Z10 lead1.2", "end 2"));
  EXPECT_THAT(num_stream("G39+M4S200K1.2Z10"), ElementsAre("S200", "tap Z10 lead-1.2", "end 2"));
  // The distance is incremental, also with G90, and in the unit of the program.
  EXPECT_THAT(num_stream("G70 G90 X1 Z1\nG39+ M4 S200 K.1 X.5\nM2"),
              ElementsAre("rapid X25.4 Z25.4", "S200", "tap X38.1 Z25.4 lead-2.54", "end 2"));
}

TEST(NumDialect, TheRemovalOfATapEndsTheProgramsThatHaveCalledIt) {
  EXPECT_THAT(num_stream("G77 H5\nX50\nM2\n%5\nG77 H6\nX40\n%6\nG39+ M4 S200 K1 Z10\n"),
              ElementsAre("S200", "tap Z10 lead-1", "end 2"));
  // An M2 of the program itself still returns.
  EXPECT_THAT(num_stream("G77 H5\nX50\nM2\n%5\nM2\n"), ElementsAre("rapid X50", "end 2"));
}

TEST(NumThreads, AThreadAndTheBlocksThatContinueIt) {
  EXPECT_THAT(num_stream("G0 Z5\nM3 S500\nG38 K2 Z-13 (first)\nX4 Z-15 K3\nN9 X5\nG0 X20\nM2"),
              ElementsAre("rapid Z5", "S500", "M3", "thread Z-13 lead2", "thread X4 Z-15 lead3",
                          "thread X5 Z-15 lead3", "rapid X20 Z-15", "end 2"));
  // F is a feed, also between threads; a block without an end is not one of the thread.
  EXPECT_THAT(num_stream("M3 S500\nG38 F100 K2 Z-1\nM8 F300\nG1 Z-2\nM2"),
              ElementsAre("S500", "M3", "thread Z-1 lead2", "M8", "line Z-2 F300", "end 2"));
  EXPECT_THAT(num_stream("M3 S500 G38 K2 Z-1\nL0=[.RG0]\nG0 XL0\nM2"),
              ElementsAre("S500", "M3", "thread Z-1 lead2", "rapid X38 Z-1", "end 2"));
}

// Lead 2, taught at Z-13 with the spindle at 90 deg. From Z5 it is 18 mm, 9 revolutions; from Z5.5 9.25.
TEST(NumThreads, AResumedThreadBeginsAtTheAngleThatPutsTheToolIntoThePitch) {
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5\nG38+ J-18 EC90 K2 Z-20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "end 2"));
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5.5\nG38+J-18.5EC90K2Z-20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5.5", "thread Z-20 lead2", "end 2"));
  // The parameters may be variables; a whole turn more of EC is the same angle.
  EXPECT_THAT(num_stream("M3 S500 L1=-18 L2=450\nG0 Z5\nG38+ JL1 ECL2 K2 Z-20\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "end 2"));
}

TEST(NumThreads, ItsStartAngleCountsInTheDirectionOfTheThreadAndOfTheSpindle) {
  const auto thread = [](const std::string& program) {
    for (const auto& command : num_stream(program + "\nM2"))
      if (command.rfind("thread", 0) == 0) return command;
    return std::string("none");
  };
  // From Z-20 upwards to Z-13: 3.5 revolutions, 90 - 1260 = -1170 = 270 - 4 * 360.
  EXPECT_EQ(thread("M3 S500\nG0 Z-20\nG38+ J7 EC90 K2 Z5"), "thread Z5 lead2 from270");
  // The taught place is 2.5 mm behind the start: 1.25 revolutions before it, 90 + 450 = 540.
  EXPECT_EQ(thread("M3 S500\nG0 Z-15.5\nG38+ J2.5 EC90 K2 Z-20"), "thread Z-20 lead2 from180");
  // M4: the angle falls. 225 deg in its direction is 135; 9.125 revolutions less, 135 - 3285 = 90 - 9 * 360.
  EXPECT_EQ(thread("M4 S500\nG0 Z5.25\nG38+ J-18.25 EC90 K2 Z-20"), "thread Z-20 lead2 from225");
  // A taper: X goes farther and has the lead; 2.5 revolutions.
  EXPECT_EQ(thread("M3 S500\nG38+ J-5 EC0 K2 X-10 Z-8"), "thread X-10 Z-8 lead2 from180");
  // At 45 degrees J belongs to the axis of its direction, so that the taught place is ahead: 1.25
  // revolutions.
  EXPECT_EQ(thread("M3 S500\nG38+ J-2.5 EC180 K2 X10 Z-10"), "thread X10 Z-10 lead2 from90");
  EXPECT_EQ(thread("M3 S500\nG38+ J2.5 EC180 K2 X10 Z-10"), "thread X10 Z-10 lead2 from90");
  // 1.0125 inches are 10.125 leads of 0.1 inch: 90 - 3645 = 45 - 10 * 360.
  EXPECT_EQ(thread("G70 M3 S500\nG38+ J-1.0125 EC90 K.1 Z-2"), "thread Z-50.8 lead2.54 from45");
}

TEST(NumThreads, JAndEXOfADiameterAreDiameters) {
  TestMachine machine = num_machine();
  machine.diameter = true;
  // J: 5 mm, 2.5 revolutions. EX: from 30 to 15 in diameter are 7.5 mm, 3.75 revolutions.
  EXPECT_THAT(
      stream(run(machine, "M3 S500\nG38+ J-10 EC0 K2 X-40\nG0 X30\nG33 X10 K2 EC0 EX15\nM2")),
      ElementsAre("S500", "M3", "thread X-20 lead2 from180", "rapid X15", "thread X5 lead2 from90", "end 2"));
}

TEST(NumThreads, G33IsOnePassAndResumesByTheTaughtPosition) {
  TestMachine machine = num_machine();
  const Interpretation plain = run(machine, "M3 S500\nG33 Z-13 K2\nX20\nM2");
  EXPECT_THAT(stream(plain), ElementsAre("S500", "M3", "thread Z-13 lead2", "rapid X20 Z-13", "end 2"));
  EXPECT_EQ(plain.commands[2].number, 1u);
  EXPECT_EQ(plain.commands[2].modal.path_control, PathControl::exact_stop);
  EXPECT_EQ(plain.modal.path_control, PathControl::continuous);
  EXPECT_EQ(plain.modal.motion, 0);
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5\nG33 Z-20 K2 EC90 EZ-13\nM2"),
              ElementsAre("S500", "M3", "rapid Z5", "thread Z-20 lead2 from90", "end 2"));
  // The taught position is no incremental word.
  EXPECT_THAT(num_stream("M3 S500\nG0 Z5.5\nG91 G33 Z-25.5 K2 EC90 EZ-13\nM2"),
              ElementsAre("S500", "M3", "rapid Z5.5", "thread Z-20 lead2", "end 2"));
  // Radial: 15 mm, 7.5 revolutions, 90 - 2700 = 270 - 8 * 360.
  EXPECT_THAT(num_stream("M3 S500\nG0 X30\nG33 X10 K2 EC90 EX15\nM2"),
              ElementsAre("S500", "M3", "rapid X30", "thread X10 lead2 from270", "end 2"));
  // At 45 degrees either: 3 mm, 1.5 revolutions.
  for (const char* taught : {"EX3", "EZ-3"})
    EXPECT_THAT(num_stream(std::string("M3 S500\nG33 X10 Z-10 K2 EC0 ") + taught + "\nM2"),
                ElementsAre("S500", "M3", "thread X10 Z-10 lead2 from180", "end 2"));
}

// The program of docs/threads.md: 90 - 360 * 18.5 / 2 = -3240 = 0, and from Z5 -3150 = 90 - 9 * 360.
TEST(NumThreads, TheIsoDialectTakesAThreadUpByItsStartAngle) {
  for (const bool farther : {true, false}) {
    TestMachine iso;
    const std::string start = farther ? "5.5" : "5";
    EXPECT_THAT(stream(run(iso, "M3 S500\n#1=-13 #2=90 #3=" + start +
                                    " #4=2     (taught Z, taught angle, start, lead)\n"
                                    "#5=#2-360*[#3-#1]/#4         (towards -Z, M3)\n"
                                    "#5=#5-360*FIX[#5/360]\nIF [#5 LT 0] THEN #5=#5+360\nG0 Z#3\n"
                                    "G33 Z-20 F#4 Q#5\nM2")),
                ElementsAre("S500", "M3", "rapid Z" + start,
                            farther ? "thread Z-20 lead2" : "thread Z-20 lead2 from90", "end 2"));
  }
}

TEST(NumThreads, OnlyAResumedThreadBeginsAnotherOne) {
  TestMachine machine = num_machine();
  const Interpretation result =
      run(machine, "M3 S500\nG38 K2 Z-1\nG38 K2 Z-2\nG38+ J-1 EC0 K2 Z-3\nZ-4\nG33 Z-5 K2\nZ-6\nM2");
  std::vector<std::uint32_t> begins;
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::thread) begins.push_back(command.number);
  EXPECT_THAT(begins, ElementsAre(0u, 0u, 1u, 0u, 1u, 0u));
}

}  // namespace
}  // namespace trunnion::language::test
