// SPDX-License-Identifier: Apache-2.0
// Signals that programs of the channels set and read: #1100 and #1000.
#include <gtest/gtest.h>

#include "core_bench.hpp"
#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::plc::signals_test {
namespace {

/// A PLC whose main task is the source.
PlcCore core_of(const std::string& source) {
  const auto compiled = st::compile({{"main.st", source}}, st::interface_registers());
  EXPECT_TRUE(compiled.good()) << testing::PrintToString(compiled.lines());
  PlcCore core;
  core.configure(two_axes_and_spindles(), true);
  StructuredPrograms programs{compiled.code, compiled.layout(), {std::nullopt, std::size_t{0}}};
  core.load(StructuredText(std::move(programs)));
  return core;
}

constexpr std::uint64_t tick = 100, cycle = 10;

/// The drive has executed the cycles before `cycle`, and channels 0 and 1 are at rest.
void stand_still(PlcCore& core) {
  idl::stream::Feedback feedback;
  feedback.first = cycle;
  feedback.channels.resize(2);
  feedback.channels[1].channel = 1;
  core.set_feedback(feedback);
  core.advance(tick);
}

constexpr const char* echo = R"(PROGRAM main
macro_input_0 := macro_output_0;
macro_input_1 := 5;
END_PROGRAM
)";

struct Signals : testing::Test {
  Signals() : core(core_of(echo)) { stand_still(core); }
  idl::plc::AuxiliaryDone ask(std::uint32_t code, double value, bool sets, std::uint16_t channel = 0) {
    core.set_request({channel, ++number, AuxiliaryKind::E, code, value, sets, cycle});
    core.advance(tick);
    const auto done = core.take_done();
    EXPECT_EQ(done.size(), 1u) << "#" << code;
    return done.empty() ? idl::plc::AuxiliaryDone{} : done.front();
  }
  void set(std::uint32_t code, double value) {
    const auto done = ask(code, value, true);
    EXPECT_FALSE(done.failed);
    EXPECT_FALSE(core.signal_read(done)) << "it was set and not read";
  }
  int read(std::uint32_t code, std::uint16_t channel = 0) {
    const auto done = ask(code, 0, false, channel);
    const auto signal = core.signal_read(done);
    if (!signal) return -1;
    EXPECT_EQ(signal->channel, channel);
    EXPECT_EQ(signal->number, number);
    return signal->value;
  }
  PlcCore core;
  std::uint32_t number = 0;
};

TEST_F(Signals, OfAProgramReachThePlcAndItsAnswerIsThereWithTheNextBlock) {
  set(1103, 1);
  EXPECT_EQ(read(1003), 1) << "the main task has run with it";
  EXPECT_EQ(read(1002), 0);
  EXPECT_EQ(read(1032), 8) << "2 to the power of 3";
  EXPECT_EQ(read(1103), 1);
  set(1103, 0);
  EXPECT_EQ(read(1032), 0);
}

TEST_F(Signals, AWordIsAllOfThemAndItsSignIsTheHighest) {
  set(1132, -32768);
  EXPECT_EQ(read(1115), 1);
  EXPECT_EQ(read(1032), 32768);
  set(1132, 65535);
  set(1101, 0);
  EXPECT_EQ(read(1132), 65533);
}

TEST_F(Signals, EachChannelHasItsOwn) {
  set(1100, 1);
  EXPECT_EQ(read(1032, 1), 5);
  EXPECT_EQ(read(1032), 1);
}

TEST_F(Signals, NoStrobeRisesForThem) {
  auto other = core_of(
      "PROGRAM main\nmacro_input_0 := macro_output_0;\nIF e_strobe_0 THEN %Y16.0 := TRUE; END_IF;\n"
      "END_PROGRAM\n");
  stand_still(other);
  other.set_request({0, 1, AuxiliaryKind::E, 1100, 1, true, cycle});
  other.advance(tick);
  EXPECT_EQ(other.take_done().size(), 1u);
  EXPECT_EQ(other.image().y[16], 0);
}

TEST_F(Signals, ThatNoProgramUsesAreRefused) {
  auto other = core_of("PROGRAM main\nmacro_input_0 := 1;\nEND_PROGRAM\n");
  stand_still(other);
  std::uint32_t asked = 0;
  const auto failed = [&](std::uint32_t code, bool sets) {
    other.set_request({0, ++asked, AuxiliaryKind::E, code, 1, sets, cycle});
    other.advance(tick);
    const auto done = other.take_done();
    EXPECT_EQ(done.size(), 1u);
    return done.empty() || done.front().failed;
  };
  EXPECT_FALSE(failed(1000, false));
  EXPECT_TRUE(failed(1100, true));
  EXPECT_TRUE(failed(1132, false));
}

// 5000 passes of the loop are 51 scans of at most 200 statements, more than those at one time.
TEST_F(Signals, AreAnsweredWhenAWholeRunOfTheMainTaskHasHadThem) {
  auto other = core_of(R"(PROGRAM main
VAR i : INT; n : DINT; seen : UINT; END_VAR
seen := macro_output_0;
FOR i := 1 TO 5000 DO
  n := n + 1;
END_FOR;
macro_input_0 := seen;
END_PROGRAM
)");
  stand_still(other);
  other.set_request({0, 1, AuxiliaryKind::E, 1104, 1, true, cycle});
  std::uint64_t now = tick;
  while (other.take_done().empty() && now < tick + 300) other.advance(++now);
  EXPECT_LT(now, tick + 300);
  EXPECT_EQ(other.image().g[interface_address("macro_input", 0).index], 16);
}

TEST_F(Signals, ARestartedProcessGivesTheValueThatWasRead) {
  set(1100, 1);
  EXPECT_EQ(read(1000), 1);
  auto restarted = core_of(echo);
  restarted.restore(core.memory());
  const auto done = restarted.all_done();
  ASSERT_EQ(done.size(), 1u);
  ASSERT_TRUE(restarted.signal_read(done.front()));
  EXPECT_EQ(restarted.signal_read(done.front())->value, 1);
}

}  // namespace
}  // namespace trunnion::plc::signals_test
