// SPDX-License-Identifier: Apache-2.0
// G22 and G23: moves are refused before they begin, and the zone lives as long as the frames of the program.
#include <gtest/gtest.h>

#include "flow_fixture.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::program_execution {
namespace {

using language::AlarmNumber;

struct Zones : flow_test::Flow {
  Ending read(const std::string& program) {
    reader = std::make_unique<ProgramReader>(machine);
    ends.clear();
    reader->on_command = [this](const language::Command&, const language::Command& move) {
      ends.push_back(move.target[language::X]);
    };
    language::StringSource from(program);
    return reader->read(from, {});
  }
  void expect_refused(const std::string& program, std::uint32_t line) {
    EXPECT_EQ(read(program), Ending::alarm) << program;
    EXPECT_EQ(reader->alarm().number, AlarmNumber::zone_entered) << program << reader->alarm_text();
    EXPECT_EQ(reader->alarm().line, line) << program;
  }

  std::unique_ptr<ProgramReader> reader;
  std::vector<double> ends;
};

const std::string box = "G22 X60 I50 Y5 J-5 Z5 K-5\n";

TEST_F(Zones, AMoveIntoTheBoxIsRefusedBeforeItBegins) {
  expect_refused("G1 X20 F1000\n" + box + "G1 X40\nX100\nM30\n", 4);
  EXPECT_EQ(ends, (std::vector<double>{20, 40}));
  EXPECT_NE(reader->alarm_text().find("it would enter it at X 50.0000 Y 0.0000 Z 0.0000"), std::string::npos)
      << reader->alarm_text();
  expect_refused(box + "G0 X100\n", 2);
  expect_refused(box + "G1 X100 F100\n", 2);
  expect_refused(box + "G31 X100 F100\n", 2);
  expect_refused(box + "G53 G0 X100\n", 2);
  expect_refused(box + "G28 X100\n", 2);
  expect_refused(box + "G0 Y-55 X0\nG2 X110 R55 F100\n", 3);
}

TEST_F(Zones, AWayRoundItAndTheEndOfTheZoneAreFree) {
  EXPECT_EQ(read(box + "G0 Y20\nX100\nY0\nM30\n"), Ending::end) << reader->alarm_text();
  EXPECT_EQ(read(box + "G23\nG0 X100\nM30\n"), Ending::end) << reader->alarm_text();
  EXPECT_EQ(read("G0 X100\nM30\n"), Ending::end) << "a program begins without a zone";
  // Inside, only G23 helps.
  EXPECT_EQ(read("G0 X55\n" + box + "G23\nG0 X0\nM30\n"), Ending::end) << reader->alarm_text();
  expect_refused("G0 X55\n" + box + "G0 X0\n", 3);
}

TEST_F(Zones, IsInMachineCoordinatesAndInTheUnitOfTheProgram) {
  expect_refused("G52 X30\n" + box + "G0 X19\nX21\n", 4);
  expect_refused("G20\nG22 X2 I1 Y1 J-1 Z1 K-1\nG21\nG0 X25\nX26\n", 5);
  // One pair of words: a zone without ends along Y and Z.
  expect_refused("G22 X60 I50\nG0 Y200\nX51\n", 3);
  // The corners in the other sequence.
  expect_refused("G22 X50 I60\nG0 X51\n", 2);
}

TEST_F(Zones, TheMachineSaysThatTheOutsideIsForbidden) {
  auto parameters = axes();
  parameters.values[40730] = {1, ""};
  machine.configure(parameters);
  expect_refused("G22 X60 I-60\nG0 X60\nX61\n", 3);
  EXPECT_EQ(read("G22 X60 I-60\nG0 X60 Y300\nX-60\nM30\n"), Ending::end) << reader->alarm_text();
}

TEST_F(Zones, AStartFromALineFindsTheZone) {
  Entry entry;
  entry.line = 3;
  start(box + "G0 Y20\nX55\nY0\n", entry);
  ASSERT_EQ(run(), FlowState::found) << flow.alarm_text();
  EXPECT_TRUE(flow.interpreter().frame().zone().active);
  trajectory->start({0, 20}, language::Transformation::none, 0);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), flow_test::number(AlarmNumber::zone_entered));
  EXPECT_EQ(flow.placed_alarm().line, 4u);
}

TEST_F(Zones, ALineOfManualDataInputFindsThatOfTheLineBefore) {
  start(box);
  ASSERT_EQ(run(), FlowState::end) << flow.alarm_text();
  language::StringSource next("G0 X100\n");
  const language::ModalState modal = flow.modal();
  flow.start(*trajectory, next, {}, modal, variables, {}, language::Beginning::line);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), flow_test::number(AlarmNumber::zone_entered));
}

}  // namespace
}  // namespace trunnion::program_execution
