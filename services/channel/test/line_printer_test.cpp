// SPDX-License-Identifier: Apache-2.0
// Lines of DPRNT: each once and in the program's order, whoever has died in between.
#include "line_printer.hpp"

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/print_file.hpp"

namespace trunnion::channel::line_printer_test {
namespace {

using idl::program::Operation;
using idl::program::ProgramReply;
using idl::program::ProgramRequest;
using testing::CommandKind;
using Source = LinePrinter::Source;
using Outcome = LinePrinter::Outcome;

ProgramReply accepted(std::uint64_t end) {
  ProgramReply reply;
  reply.accepted = true, reply.offset = end;
  return reply;
}

ProgramReply refused(const machine::AlarmDefinition& alarm, std::uint64_t end) {
  ProgramReply reply;
  reply.alarm = alarm.number, reply.offset = end, reply.reason = "the disk is full";
  return reply;
}

std::string text_of(const ProgramRequest& request) { return {request.data.begin(), request.data.end()}; }

TEST(PrintFile, HasTheNameOfTheProgramAndOfAnotherChannel) {
  EXPECT_EQ(machine::print_file("part.nc", 0), "DPRNT-part.nc.txt");
  EXPECT_EQ(machine::print_file("part.nc", 12), "DPRNT-part.nc-12.txt");
  EXPECT_EQ(machine::print_file(std::string(64, 'p'), 12).size(), 64u);
  EXPECT_TRUE(machine::is_print_file("DPRNT-MDI.txt"));
  EXPECT_FALSE(machine::is_print_file("part.nc"));
}

TEST(LinePrinter, WritesAtTheEndOfTheFile) {
  LinePrinter printer;
  printer.start(false);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 10, 3, "X1"));
  auto request = printer.take_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->operation, Operation::WRITE);
  EXPECT_EQ(request->name, "DPRNT-a.txt");
  EXPECT_EQ(request->offset, 10u);
  EXPECT_EQ(text_of(*request), "X1\n");
  EXPECT_FALSE(printer.take_request()) << "once";
  EXPECT_EQ(printer.finish(accepted(13)), Outcome::done);
  EXPECT_EQ(printer.finish(accepted(13)), Outcome::not_open);
  EXPECT_EQ(printer.printed(), (PrintedLine{"DPRNT-a.txt", 3, 13}));
  // The list of the programs has not come yet.
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 10, 4, "X1"));
  EXPECT_EQ(printer.take_request()->offset, 13u);
}

TEST(LinePrinter, GoesToTheEndThatItIsToldOnceWhenTheFileWasDeleted) {
  LinePrinter printer;
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 10, 3, "X1"));
  printer.take_request();
  EXPECT_EQ(printer.finish(refused(alarm::request_invalid, 0)), Outcome::waits);
  EXPECT_EQ(printer.take_request()->offset, 0u);
  EXPECT_EQ(printer.finish(refused(alarm::request_invalid, 5)), Outcome::refused);
  EXPECT_TRUE(printer.at_rest());
}

// The list of the programs has the line already: only the answer, or the index of the store, is missing.
TEST(LinePrinter, ALineThatWasRefusedOrNotAnsweredIsSentAgainForTheSamePlace) {
  LinePrinter printer;
  printer.start(false);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 10, 3, "X1"));
  printer.take_request();
  EXPECT_EQ(printer.finish(refused(alarm::storage_failed, 10)), Outcome::refused);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 13, 3, "X1"));
  EXPECT_EQ(printer.take_request()->offset, 10u);
  printer.start(true);  // the drive has restarted before the answer
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 13, 3, "X1"));
  EXPECT_EQ(printer.take_request()->offset, 10u);
  EXPECT_EQ(printer.finish(accepted(13)), Outcome::done);
  // After a reset the same line is another one.
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 13, 4, "X1"));
  printer.take_request();
  printer.cancel();
  printer.start(false);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 16, 4, "X1"));
  EXPECT_EQ(printer.take_request()->offset, 16u);
}

TEST(LinePrinter, TheProcessBehindAKillFindsTheFirstLineOfAProgram) {
  LinePrinter killed;
  killed.start(false);
  ASSERT_TRUE(killed.begin(Source::program, "DPRNT-a.txt", 10, 3, "X1"));
  EXPECT_EQ(killed.printed(), (PrintedLine{"DPRNT-a.txt", 0, 10}));
  LinePrinter next;
  next.set_printed(killed.printed());
  next.start(true);
  ASSERT_TRUE(next.begin(Source::program, "DPRNT-a.txt", 13, 3, "X1"));
  EXPECT_EQ(next.take_request()->offset, 10u) << "where the killed process has sent it";
}

TEST(LinePrinter, TheAnswerToALineThatWasGivenUpIsNotThatToTheNext) {
  LinePrinter printer;
  printer.start(false);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 10, 3, "X1"));
  printer.take_request();
  printer.cancel();
  printer.start(false);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 10, 1, "X2"));
  EXPECT_EQ(printer.finish(accepted(13)), Outcome::not_open);
  EXPECT_TRUE(printer.open());
  EXPECT_TRUE(printer.take_request());
}

TEST(LinePrinter, PassesOverWhatWasPrintedBeforeTheProgramWasContinued) {
  LinePrinter printer;
  printer.set_printed({"DPRNT-a.txt", 5, 100});
  printer.start(true);
  EXPECT_FALSE(printer.begin(Source::program, "DPRNT-a.txt", 120, 5, "X1"));
  // What the process before has sent in addition is found behind the line that it knew of.
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 120, 6, "X2"));
  EXPECT_EQ(printer.take_request()->offset, 100u);
  printer.cancel();
  // A line of MDI is no line of the program.
  ASSERT_TRUE(printer.begin(Source::line, "DPRNT-MDI.txt", 7, 1, "X3"));
  EXPECT_EQ(printer.take_request()->offset, 7u);
  EXPECT_EQ(printer.finish(accepted(10)), Outcome::done);
  EXPECT_EQ(printer.printed(), (PrintedLine{"DPRNT-a.txt", 5, 100}));
  // From its beginning the program prints everything again, behind everything.
  printer.start(false);
  ASSERT_TRUE(printer.begin(Source::program, "DPRNT-a.txt", 120, 5, "X1"));
  EXPECT_EQ(printer.take_request()->offset, 120u);
}

TEST(LinePrinter, TheRecordOfTheChannelKeepsTheNewestLine) {
  RunningProgram program{{"a.nc", 1, 2, 3}};
  program.printed = {"DPRNT-a.nc.txt", 7, 1ull << 33};
  EXPECT_EQ(read_record(write_record(program), "f"), program);
}

struct Printing : testing::Channel {
  std::vector<std::string> lines;
  std::uint64_t end = 0;

  void answer() {
    const auto request = core->take_print_request();
    if (!request) return;
    EXPECT_EQ(request->offset, end);
    lines.push_back(text_of(*request));
    end += request->data.size();
    core->on_printed(accepted(end));
  }
  void go_on(int rounds = 100000) {
    for (int i = 0; i < rounds; ++i) {
      round();
      answer();
      if (core->run_state() != RunState::RUNNING && core->run_state() != RunState::WAITING) break;
    }
  }
};

TEST_F(Printing, TheAxesStandAndTheProgramWaitsUntilTheLineIsWritten) {
  load("G90\nG1 X10 F6000\n#1=5\nDPRNT[A#1[10]]\nX20\nM30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_EQ(core->run_state(), RunState::WAITING);
  EXPECT_EQ(drive.rows.back()[0], 10);
  EXPECT_NE(core->state().detail.find("DPRNT"), std::string::npos);
  const auto request = core->take_print_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->name, "DPRNT-part.nc.txt");
  EXPECT_EQ(text_of(*request), "A 5\n");
  core->on_printed(accepted(4));
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 20);
  EXPECT_EQ(core->printed().end, 4u);
}

TEST_F(Printing, ARefusedLineHoldsTheProgramAndCycleStartWritesItAgain) {
  load("G90\nDPRNT[A]\nG1 X10 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_TRUE(core->take_print_request());
  core->on_printed(refused(alarm::storage_failed, 0));
  EXPECT_EQ(core->run_state(), RunState::HELD);
  const auto reported = core->take_events();
  ASSERT_FALSE(reported.empty());
  EXPECT_EQ(reported.back().alarm, &alarm::print_refused);
  EXPECT_NE(reported.back().text.find("part.nc:2: the line of DPRNT was not written: the disk is full"),
            std::string::npos)
      << reported.back().text;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  go_on();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(lines, std::vector<std::string>{"A\n"});
  EXPECT_EQ(drive.rows.back()[0], 10);
}

TEST_F(Printing, AResetGivesTheLineUp) {
  load("G90\nDPRNT[A]\nG1 X10 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_EQ(core->run_state(), RunState::WAITING);
  ask(CommandKind::RESET);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  core->on_printed(accepted(2));
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(drive.rows.empty());
}

TEST_F(Printing, ARestartOfTheDrivePrintsNoLineTwice) {
  load("G90\nDPRNT[A]\nG1 X100 F6000\nDPRNT[B]\nX0\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  go_on(40);
  ASSERT_EQ(lines, std::vector<std::string>{"A\n"});
  drive.forget();
  go_on(1);
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  go_on();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(lines, (std::vector<std::string>{"A\n", "B\n"}));
}

TEST_F(Printing, AStartFromALinePrintsOnlyWhatIsBehindIt) {
  load("G90\nDPRNT[A]\nG1 X10 F6000\nX20\nDPRNT[B]\nM30\n");
  ASSERT_TRUE(ask(CommandKind::START_FROM_LINE, "", 4).accepted);
  go_on();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  go_on();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(lines, std::vector<std::string>{"B\n"});
}

// The program is interpreted again from its beginning, where no part was counted.
TEST_F(Printing, AProcessThatContinuesAProgramReadsTheNumberOfPartsOfItsStart) {
  load("G90\n#3901=#3901+40\n#500=#3901\nG1 X100 F6000\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  go_on(40);
  const auto kept = core->running_program();
  ASSERT_EQ(kept.parts, 40u);
  EXPECT_EQ(read_record(write_record(kept), "f"), kept);
  begin(kept);
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  go_on();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(core->parts(), 41u);
  const auto* variables = core->take_variables();
  ASSERT_NE(variables, nullptr);
  EXPECT_EQ(variables->kept[0].number, 40);
}

TEST_F(Printing, AProgramSetsTheNumberOfPartsThatItsEndCounts) {
  load("#100=#3901\n#3901=#3901+40\nM30\n");
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->parts(), 41u);
}

}  // namespace
}  // namespace trunnion::channel::line_printer_test
