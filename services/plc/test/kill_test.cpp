// SPDX-License-Identifier: Apache-2.0
// A PLC that is killed in any scan, before or after it has kept its memory, repeats no output: the machine
// sees the outputs of one that was not killed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "retained_memory.hpp"
#include "running_core.hpp"

namespace trunnion::plc {
namespace {

// Pulses, a counter, a timer, stored bits, and a main task that needs several scans: each would be repeated,
// or lost, by a PLC that forgets a part of its state.
constexpr const char* pulsing_fast =
    "PROGRAM fast\n"
    "VAR scans : UDINT; clock : R_TRIG; wait : TON; pulses : CTU; END_VAR\n"
    "scans := scans + 1;\n"
    "clock(CLK := scans MOD 7 < 3);\n"
    "%Y16.0 := clock.Q;\n"
    "wait(IN := NOT wait.Q, PT := T#5ms);\n"
    "%Y16.1 := wait.Q;\n"
    "pulses(CU := clock.Q, R := FALSE, PV := 4);\n"
    "%Y17 := INT_TO_USINT(pulses.CV);\n"
    "END_PROGRAM\n";
constexpr const char* spread_main =
    "PROGRAM main\nVAR i : INT; sum : UINT; END_VAR\n"
    "FOR i := 1 TO 300 DO sum := sum + 1; END_FOR;\n"
    "IF %F2561.0 THEN %Y18.0 := TRUE; END_IF;\n"
    "%W50 := sum;\nEND_PROGRAM\n";

void load(PlcCore& core) {
  auto parameters = axis_parameters();
  parameters.values[2] = {200, ""};
  core.configure(parameters, true);
  core.load(translate({{"fast.st", pulsing_fast}, {"main.st", spread_main}}, true));
}

/// What the machine sees after a round.
struct Seen {
  idl::plc::Outputs outputs;
  std::array<std::uint8_t, 4> y{};
  std::uint16_t sum = 0;
  bool operator==(const Seen&) const = default;
};
Seen seen(const PlcCore& core) {
  const auto& r = core.memory().registers;
  return {core.outputs(), {r.y[16], r.y[17], r.y[18], r.y[19]}, r.w[50]};
}

TEST(Kill, InAnyScanRepeatsNoOutput) {
  constexpr std::uint64_t rounds = 120;
  std::vector<Seen> expected;
  PlcCore whole;
  load(whole);
  for (std::uint64_t tick = 1; tick <= rounds; ++tick) whole.advance(tick), expected.push_back(seen(whole));

  const auto path = testing::TempDir() + "plc_kill_" + std::to_string(getpid());
  const auto remove = [&] {
    for (const auto* suffix : {"", ".previous"}) std::filesystem::remove(path + suffix);
  };
  for (std::uint64_t killed = 2; killed < rounds; ++killed)
    for (const bool kept : {false, true}) {
      remove();
      std::uint64_t tick = 1;
      {
        PlcCore core;
        load(core);
        RetainedMemory file(path, core.memory().program.cells);
        for (; tick < killed; ++tick) {
          core.advance(tick);
          file.save("one start", core.memory());
          ASSERT_EQ(seen(core), expected[tick - 1]);
        }
        // The round of the kill: nothing of it is seen, for outputs leave after the memory is kept.
        core.advance(tick);
        if (kept) file.save("one start", core.memory());
      }
      PlcCore core;
      load(core);
      const auto found = RetainedMemory(path, core.memory().program.cells).load();
      ASSERT_TRUE(found.kept) << found.problem;
      core.restore(found.kept->memory);
      if (kept) {
        EXPECT_EQ(seen(core), expected[killed - 1]) << "killed at " << killed;
      }
      for (tick = killed; tick <= rounds; ++tick) {
        core.advance(tick);
        ASSERT_EQ(seen(core), expected[tick - 1]) << "at " << tick << ", killed at " << killed
                                                  << (kept ? " after" : " before") << " the memory was kept";
      }
    }
  remove();
}

TEST(Kill, AFunctionIsCarriedOutOnceHoweverOftenThePlcIsKilled) {
  // M3 turns the spindle on and is finished 10 scans later; the program counts how often it begins.
  const auto files = SourceFiles{{"fast.st", empty_fast},
                                 {"main.st",
                                  "PROGRAM main\nVAR begins : R_TRIG; wait : TON; END_VAR\n"
                                  "begins(CLK := m_strobe_0);\nIF begins.Q THEN %W50 := %W50 + 1; END_IF;\n"
                                  "wait(IN := m_strobe_0, PT := T#10ms);\nfin_0 := wait.Q;\nEND_PROGRAM\n"}};
  const auto make = [&](PlcCore& core) {
    core.configure(axis_parameters(), false);
    core.load(translate(files, true));
  };
  const idl::channel::AuxiliaryRequest request{0, 1, idl::channel::AuxiliaryKind::M, 3, 0, false, 0};
  for (std::uint64_t killed = 6; killed < 40; ++killed) {
    Memory memory;
    std::vector<idl::plc::AuxiliaryDone> done;
    const auto round = [&](PlcCore& core, std::uint64_t tick) {
      core.advance(tick);
      memory = core.memory();
      for (const auto& one : core.take_done()) done.push_back(one);
    };
    PlcCore first;
    make(first);
    for (std::uint64_t tick = 1; tick <= killed; ++tick) {
      if (tick == 5) first.set_request(request);
      round(first, tick);
    }
    PlcCore second;
    make(second);
    second.restore(memory);
    second.set_request(request);  // the channel asks until it is answered: the topic is a state
    for (std::uint64_t tick = killed + 1; tick <= 60; ++tick) round(second, tick);
    EXPECT_EQ(second.memory().registers.w[50], 1) << "killed at " << killed;
    // An answer may be given again, because the one before may be lost; it is always that to the same
    // request.
    ASSERT_FALSE(done.empty()) << "killed at " << killed;
    for (const auto& one : done) EXPECT_EQ(one.number, 1u);
  }
}

}  // namespace
}  // namespace trunnion::plc
