// SPDX-License-Identifier: Apache-2.0
// A standby PLC beside the running one: two cores, the rounds of the one played on the other.
#include "standby_comparison.hpp"

#include <gtest/gtest.h>

#include <random>

#include "programs.hpp"
#include "round_recorder.hpp"

namespace trunnion::plc {
namespace {

// A lamp that follows an input, a timer of 7 ms, a counter of the M strobes, and a sum over the scans: what
// comes out depends on every tick and on the order of the inputs.
constexpr const char* main_program = R"(
LD X16.0
TON 1, 7
ST Y16.0
LD m_strobe_0
ST fin_0
LD m_strobe_0
CTU 1, 3
ST Y16.1
LD B0
ADD 1
ST B0
LD B0
ADD F2565
ST B1
)";

std::shared_ptr<const machine::Parameters> revised_parameters(std::uint64_t revision) {
  auto p = std::make_shared<machine::Parameters>();
  p->revision = revision;
  p->values[100000] = {0, "X"}, p->values[110000] = {0, "S"}, p->values[110001] = {10, ""};
  return p;
}

PlcCore core_with(const std::string& program) {
  PlcCore core;
  core.load(translate({{"fast.il", "LD X16.1\nST Y17.0\n"}, {"main.il", program}}, true));
  return core;
}

// The running PLC in virtual time, told at random by a seeded machine.
class Running {
 public:
  explicit Running(std::uint64_t seed) : core_(core_with(main_program)), random_(seed) {
    core_.configure(*revised_parameters(1), true);
  }

  Round begin(std::uint32_t generation) {
    EXPECT_TRUE(recorder_.begin_round(generation, core_, 1));
    return recorder_.first_round();
  }

  // As the service does: feedback tick by tick, then what else has come, then the round's last advance.
  Round round() {
    for (auto n = random_() % 3; n > 0; --n) {
      tick_ += random_() % 12;
      idl::stream::Feedback feedback;
      feedback.first = tick_, feedback.count = 1, feedback.tick = tick_;
      feedback.commanded = {1, 2, 3};
      feedback.spindle_speed = {static_cast<double>(random_() % 100)};
      feedback.enabled = {1};
      feedback.channels.resize(1);
      feedback.channels[0].active = random_() % 4 == 0;
      core_.set_feedback(feedback);
      recorder_.record(feedback);
      advance();
    }
    if (random_() % 8 == 0) {
      idl::channel::ChannelState state;
      state.feed_override = static_cast<double>(random_() % 150) / 100;
      state.reset_count = resets_ += random_() % 3 == 0;
      core_.set_channel(state);
      recorder_.record(StepKind::CHANNEL_STATE, state);
    }
    if (random_() % 8 == 0) {
      const idl::channel::AuxiliaryRequest request{0, ++number_, AuxiliaryKind::M, 8, 0, false, 0};
      core_.set_request(request);
      recorder_.record(StepKind::AUXILIARY_REQUEST, request);
    }
    if (random_() % 8 == 0) {
      const idl::plc::PanelRequest panel{.kind = idl::plc::PanelRequestKind::FORCE_INPUT,
                                         .address = 16,
                                         .value = static_cast<std::uint32_t>(random_() % 4)};
      core_.panel(panel);
      recorder_.record(StepKind::PANEL_REQUEST, panel);
    }
    if (random_() % 30 == 0) {
      core_.press_reset();
      recorder_.record(StepKind::RESET_BUTTON);
    }
    if (random_() % 30 == 0) {
      core_.give_up_waiting();
      recorder_.record(StepKind::GIVE_UP_WAITING);
    }
    const bool alarm = random_() % 5 == 0;
    core_.set_alarms(alarm, false);
    recorder_.record(StepKind::ALARMS, alarm ? 1 : 0);
    advance();
    return recorder_.end_round(core_, core_.take_done());
  }

  std::uint64_t tick() const { return tick_; }
  Memory memory() const { return core_.memory(); }

 private:
  void advance() {
    core_.advance(tick_);
    recorder_.record(StepKind::ADVANCE, tick_);
  }
  PlcCore core_;
  RoundRecorder recorder_;
  std::mt19937_64 random_;
  std::uint64_t tick_ = 1000;
  std::uint32_t number_ = 0, resets_ = 0;
};

StandbyComparison comparison_of(const std::string& program) {
  return {core_with(program), true, revised_parameters};
}

Round over_the_wire(const Round& round) {
  bus::Bytes bytes;
  bus::encode(round, bytes);
  Round result;
  EXPECT_TRUE(bus::decode(bytes, result));
  return result;
}

TEST(StandbyComparison, TheSameProgramDoesTheSameTickByTickWhateverTheInputs) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Running running(seed);
    for (int k = 0; k < 50; ++k) running.round();
    auto comparison = comparison_of(main_program);
    ASSERT_EQ(comparison.play(over_the_wire(running.begin(1)), 1), StandbyComparison::Outcome::equal);
    const auto from = running.tick();
    for (int k = 0; k < 300; ++k)
      ASSERT_EQ(comparison.play(over_the_wire(running.round()), 1), StandbyComparison::Outcome::equal)
          << "seed " << seed << ", round " << k << ": " << comparison.difference();
    EXPECT_TRUE(comparison.in_step());
    EXPECT_EQ(comparison.equal_ticks(), running.tick() - from);
    EXPECT_GT(running.memory().registers.b[0], 100) << "the program has run";
  }
}

TEST(StandbyComparison, AnotherProgramIsFoundInTheRegisterItChangesWithTheTickAndBothValues) {
  Running running(3);
  for (int k = 0; k < 50; ++k) running.round();
  std::string other = main_program;
  other.replace(other.find("TON 1, 7"), 8, "TON 1, 6");
  auto comparison = comparison_of(other);
  ASSERT_EQ(comparison.play(running.begin(1), 1), StandbyComparison::Outcome::equal);
  auto outcome = StandbyComparison::Outcome::equal;
  Memory before;
  Round round;
  for (int k = 0; k < 3000 && outcome == StandbyComparison::Outcome::equal; ++k) {
    before = running.memory();
    round = running.round();
    outcome = comparison.play(round, 1);
  }
  ASSERT_EQ(outcome, StandbyComparison::Outcome::differs);
  EXPECT_FALSE(comparison.in_step());
  // The timer of 6 ms ends in another scan, or shows first in the state of the timer itself.
  EXPECT_EQ(comparison.difference().find("tick " + std::to_string(round.tick) + ", "), 0u);
  const auto ticks = comparison.equal_ticks();
  EXPECT_EQ(comparison.play(running.round(), 1), StandbyComparison::Outcome::differs) << "it stays found";
  EXPECT_EQ(comparison.equal_ticks(), ticks);
}

// Y16.0 is on where the running one has it off: known at once, by what one more scan would change.
TEST(StandbyComparison, AtRestTheDifferenceIsFoundWithoutATickPassing) {
  Running running(3);
  for (int k = 0; k < 50; ++k) running.round();
  auto comparison = comparison_of(std::string(main_program) + "LDN X500.0\nST Y18.2\n");
  const Round start = running.begin(1);
  EXPECT_EQ(comparison.play(start, 1), StandbyComparison::Outcome::differs);
  EXPECT_EQ(comparison.difference(), "tick " + std::to_string(start.tick) + ", register Y18: 0 and 4");
}

TEST(StandbyComparison, ARegisterChangedInOneBitIsNamed) {
  Running running(3);
  auto comparison = comparison_of(main_program);
  Round round;
  ASSERT_EQ(comparison.play(running.begin(1), 1), StandbyComparison::Outcome::equal);
  do {
    round = running.round();
    if (!round.changed.empty()) break;
    ASSERT_EQ(comparison.play(round, 1), StandbyComparison::Outcome::equal);
  } while (true);
  const RegisterValue right = round.changed[0];
  round.changed[0].value ^= 1;
  ASSERT_EQ(comparison.play(round, 1), StandbyComparison::Outcome::differs);
  EXPECT_EQ(comparison.difference(), "tick " + std::to_string(round.tick) + ", register " +
                                         register_name(right) + ": " + std::to_string(right.value ^ 1) +
                                         " and " + std::to_string(right.value));
}

TEST(StandbyComparison, OutputsFinishedFunctionsAndHiddenStateCountAsWell) {
  for (int what = 0; what < 3; ++what) {
    Running running(3);
    auto comparison = comparison_of(main_program);
    ASSERT_EQ(comparison.play(running.begin(1), 1), StandbyComparison::Outcome::equal);
    Round round = running.round();
    if (what == 0) round.outputs.run_until_tick += 1;
    if (what == 1) round.done.push_back({0, 77, false});
    if (what == 2) round.state ^= 1;
    EXPECT_EQ(comparison.play(round, 1), StandbyComparison::Outcome::differs) << what;
    EXPECT_NE(comparison.difference(), "");
  }
}

TEST(StandbyComparison, AfterAMissingRoundItBeginsAnewAndKeepsWhatItHasCounted) {
  Running running(5);
  auto comparison = comparison_of(main_program);
  ASSERT_EQ(comparison.play(running.begin(1), 1), StandbyComparison::Outcome::equal);
  for (int k = 0; k < 20; ++k)
    ASSERT_EQ(comparison.play(running.round(), 1), StandbyComparison::Outcome::equal);
  const auto ticks = comparison.equal_ticks();
  running.round();
  EXPECT_EQ(comparison.play(running.round(), 1), StandbyComparison::Outcome::gap);
  EXPECT_EQ(comparison.play(running.round(), 2), StandbyComparison::Outcome::equal)
      << "of an older generation";
  const auto from = running.tick();
  ASSERT_EQ(comparison.play(running.begin(2), 2), StandbyComparison::Outcome::equal);
  for (int k = 0; k < 20; ++k)
    ASSERT_EQ(comparison.play(running.round(), 2), StandbyComparison::Outcome::equal);
  EXPECT_EQ(comparison.equal_ticks(), ticks + running.tick() - from);
}

TEST(StandbyComparison, ItWaitsForParametersThatHaveNotArrived) {
  Running running(5);
  bool arrived = false;
  StandbyComparison comparison(core_with(main_program), true, [&](std::uint64_t revision) {
    return arrived ? revised_parameters(revision) : nullptr;
  });
  const Round start = running.begin(1);
  EXPECT_EQ(comparison.play(start, 1), StandbyComparison::Outcome::waiting);
  EXPECT_FALSE(comparison.in_step());
  arrived = true;
  EXPECT_EQ(comparison.play(start, 1), StandbyComparison::Outcome::equal);
  EXPECT_TRUE(comparison.in_step());
}

TEST(StandbyComparison, BytesThatAreNoRoundAndAMemoryOfAnotherBuildAreRefused) {
  Running running(5);
  auto comparison = comparison_of(main_program);
  Round start = running.begin(1);
  start.start.pop_back();
  EXPECT_EQ(comparison.play(start, 1), StandbyComparison::Outcome::differs);
  EXPECT_NE(comparison.difference().find("different memory layout"), std::string::npos);

  auto second = comparison_of(main_program);
  ASSERT_EQ(second.play(running.begin(2), 2), StandbyComparison::Outcome::equal);
  Round round = running.round();
  round.steps.push_back({static_cast<StepKind>(200), 0, {}});
  EXPECT_EQ(second.play(round, 2), StandbyComparison::Outcome::differs);

  auto third = comparison_of(main_program);
  ASSERT_EQ(third.play(running.begin(3), 3), StandbyComparison::Outcome::equal);
  round = running.round();
  round.steps.push_back({StepKind::CHANNEL_STATE, 0, {0, 1, 0, 0, 9}});
  EXPECT_EQ(third.play(round, 3), StandbyComparison::Outcome::differs);
}

}  // namespace
}  // namespace trunnion::plc
