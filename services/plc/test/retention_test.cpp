// SPDX-License-Identifier: Apache-2.0
// What a PLC keeps when its power fails: retained areas, RETAIN variables, and registers of VAR RETAIN.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <string>

#include "retained_memory.hpp"
#include "running_core.hpp"

namespace trunnion::plc {
namespace {

// Each scan of `fast` adds one to every register and variable; `kept` begins with what is retained.
constexpr const char* counting_fast =
    "PROGRAM fast\n"
    "VAR RETAIN low AT %R100 : USINT; word AT %W10 : UINT; double AT %D5 : DINT; list AT %T3 : ARRAY[0..1] "
    "OF DINT;\n"
    "  flag AT %R200.3 : BOOL; number : UDINT; END_VAR\n"
    "VAR byte_b : DINT; lost AT %W11 : UINT; lost_d AT %D6 : DINT; lost_flag AT %R200.4 : BOOL; count : "
    "UDINT; END_VAR\n"
    "low := low + 1; word := word + 1; double := double + 1; list[1] := list[1] + 1; flag := TRUE; number := "
    "number + 1;\n"
    "%B9 := %B9 + 1; %K7 := %R100; lost := lost + 1; lost_d := lost_d + 1; lost_flag := TRUE; count := count "
    "+ 1;\n"
    "byte_b := %B9;\nEND_PROGRAM\n";

Programs counting_programs() {
  return translate({{"fast.st", counting_fast}, {"main.st", "PROGRAM main\nEND_PROGRAM\n"}}, true);
}

PlcCore started(const std::optional<RetainedMemory::Kept>& kept) {
  PlcCore core;
  core.configure(axis_parameters(), true);
  core.load(counting_programs());
  if (kept) core.power_up(kept->memory);
  return core;
}

// The child says after each save how far it has come; the newest save that it has said is there, or one more.
TEST(Retention, AKillInAnyScanLosesNoRetainedValue) {
  const auto path = testing::TempDir() + "plc_retention_" + std::to_string(getpid());
  for (const auto* suffix : {"", ".previous"}) std::filesystem::remove(path + suffix);
  std::mt19937 random(3);
  std::int32_t before = 0;
  for (int round = 0; round < 60; ++round) {
    int channel[2];
    ASSERT_EQ(pipe(channel), 0);
    const pid_t plc = fork();
    if (plc == 0) {
      close(channel[0]);
      auto found = RetainedMemory(path, 0).load();
      auto core = started(found.kept);
      RetainedMemory retained(path, core.memory().program.cells);
      core.advance(1);
      for (std::uint64_t tick = 2;; ++tick) {
        core.advance(tick);
        retained.save("start " + std::to_string(round), core.memory());
        const auto value = core.memory().registers.d[5];
        if (write(channel[1], &value, sizeof value) != sizeof value) _exit(1);
      }
    }
    close(channel[1]);
    std::int32_t said = before, value = 0;
    const auto scans = random() % 200;
    for (std::uint32_t i = 0; i <= scans && read(channel[0], &value, sizeof value) == sizeof value; ++i)
      said = value;
    usleep(random() % 500);
    kill(plc, SIGKILL);
    waitpid(plc, nullptr, 0);
    while (read(channel[0], &value, sizeof value) == sizeof value) said = value;
    close(channel[0]);
    const auto found = RetainedMemory(path, 0).load();
    ASSERT_TRUE(found.kept) << "round " << round << " " << found.problem;
    const auto core = started(found.kept);
    const auto& r = core.memory().registers;
    EXPECT_GE(r.d[5], said) << "round " << round;
    EXPECT_LE(r.d[5], said + 1) << "round " << round;
    EXPECT_EQ(r.w[10], static_cast<std::uint16_t>(r.d[5]));
    EXPECT_EQ(r.r[100], static_cast<std::uint8_t>(r.d[5]));
    EXPECT_EQ(r.b[9], r.d[5]);
    EXPECT_EQ(r.k[7], r.r[100]);
    EXPECT_EQ(r.t[4], r.d[5]);
    EXPECT_EQ(r.r[200], 8) << "bit 3 is retained, bit 4 is not";
    EXPECT_EQ(r.w[11], 0);
    EXPECT_EQ(r.d[6], 0);
    const auto variables = counting_programs().variables;
    std::vector<std::uint64_t> cells(1);
    copy_value(core.memory(), place_of(variables.find("fast.number")), cells);
    EXPECT_EQ(cells[0], static_cast<std::uint64_t>(r.d[5]));
    copy_value(core.memory(), place_of(variables.find("fast.count")), cells);
    EXPECT_EQ(cells[0], 0u);
    before = r.d[5];
  }
  EXPECT_GT(before, 1000);
  for (const auto* suffix : {"", ".previous"}) std::filesystem::remove(path + suffix);
}

TEST(Retention, InstructionListsKeepRegistersToo) {
  const auto programs = [] {
    return translate(
        {{"fast.il",
          "VAR RETAIN\nhours AT %W7 : INT\nopen AT R3.5 : BOOL\nEND_VAR\nLD hours\nADD 1\nST hours\n"
          "LD 1\nST %W8\nLD hours\nGT 0\nST open\n"},
         {"main.il", "LD X16.0\nST Y16.0\n"}},
        true);
  };
  PlcCore core;
  core.configure(axis_parameters(), true);
  core.load(programs());
  core.advance(1), core.advance(2);
  ASSERT_GT(core.memory().registers.w[7], 0);
  PlcCore next;
  next.configure(axis_parameters(), true);
  next.load(programs());
  next.power_up(core.memory());
  EXPECT_EQ(next.memory().registers.w[7], core.memory().registers.w[7]);
  EXPECT_EQ(next.memory().registers.r[3], 32);
  EXPECT_EQ(next.memory().registers.w[8], 0);
}

TEST(Retention, InputsAndOutputsAreNotKept) {
  const auto refusal = [](const std::string& name, const std::string& text) -> std::string {
    try {
      translate({{"fast.st", empty_fast}, {name, text}}, true);
      return "";
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  };
  for (const auto* address : {"X16.0", "Y16.0", "G100.0", "F100.0"}) {
    EXPECT_THAT(refusal("main.st", std::string("PROGRAM main VAR RETAIN a AT %") + address +
                                       " : BOOL; END_VAR a := TRUE; END_PROGRAM"),
                testing::HasSubstr("main.st:1:30: error: RETAIN is not for this area"));
    EXPECT_THAT(
        refusal("main.il", std::string("VAR RETAIN\na AT ") + address + " : BOOL\nEND_VAR\nLD a\nST R0.0\n"),
        testing::HasSubstr("main.il:2:6: error: RETAIN is not for this area"));
  }
}

// The second start of a cluster, whose drive counts its ticks from 700 on.
struct Started {
  Started(const std::string& main, const Memory& kept) {
    auto programs = programs_of(main);
    variables = programs.variables;
    core.configure(axis_parameters(), true);
    core.load(std::move(programs));
    core.power_up(kept);
    core.advance(700);
  }
  std::string value(const std::string& path) const {
    const auto at = variables.find(path);
    std::vector<std::uint64_t> cells(at.type->cells);
    copy_value(core.memory(), place_of(at), cells);
    return st::value_text(*at.type, cells);
  }
  PlcCore core;
  st::Variables variables;
};

TEST(Retention, TheTimeOfThePlcContinuesBehindANewStart) {
  const std::string source =
      "PROGRAM main VAR now : LTIME; END_VAR VAR RETAIN on : TON; off : TOF; END_VAR\n"
      "now := PLC_TIME(); on(IN := TRUE, PT := T#3s); off(IN := on.ET < T#1s, PT := T#2s);\nEND_PROGRAM\n";
  Running before(source);
  before.pass(2000);
  ASSERT_EQ(before.value("main.now"), "LT#2s");
  ASSERT_EQ(before.value("main.on.ET"), "T#2s");
  Started after(source, before.core.memory());
  EXPECT_EQ(after.value("main.now"), "LT#2s") << "no time has passed between the last scan and the first";
  EXPECT_EQ(after.value("main.on.ET"), "T#2s");
  EXPECT_EQ(after.value("main.off.ET"), "T#1s");
  EXPECT_EQ(after.core.outputs().run_until_tick, 700u + 1000u) << "both timers end at 3 s";
  for (std::uint64_t tick = 700; tick < 1699; ++tick) after.core.advance(tick);
  EXPECT_EQ(after.value("main.on.Q"), "FALSE");
  EXPECT_EQ(after.value("main.off.Q"), "TRUE");
  after.core.advance(1700);
  EXPECT_EQ(after.value("main.on.Q"), "TRUE");
  EXPECT_EQ(after.value("main.off.Q"), "FALSE");
  // A process that is killed before its first scan of the new start.
  PlcCore killed;
  killed.configure(axis_parameters(), true);
  killed.load(programs_of(source));
  killed.power_up(before.core.memory());
  PlcCore restarted;
  restarted.configure(axis_parameters(), true);
  restarted.load(programs_of(source));
  restarted.restore(killed.memory());
  restarted.advance(5000);
  EXPECT_EQ(restarted.memory().now_us, 2000000u);
}

// Error 10, KP 1, TI 10 s: I grows by 0.01 in 10 ms, from 0.
TEST(Retention, ARetainedControllerContinuesBehindANewStart) {
  const std::string source =
      "PROGRAM main VAR RETAIN pid : PID_CONTROL; END_VAR pid(AUTO := TRUE, SP := 10.0, TI := LT#10s);\n"
      "END_PROGRAM\n";
  Running before(source);
  before.pass(2000);
  ASSERT_NEAR(std::stod(before.value("main.pid.OUT")), 2.0, 1e-9);
  Started after(source, before.core.memory());
  EXPECT_NEAR(std::stod(after.value("main.pid.OUT")), 2.0, 1e-9);
  after.core.advance(710);
  EXPECT_NEAR(std::stod(after.value("main.pid.OUT")), 2.01, 1e-9);
}

// The manual's PID keeps the time of its last computation in a register of area B.
TEST(Retention, ThePidOfTheManualsContinuesBehindANewStart) {
  const std::string source =
      "PROGRAM main VAR r AT %B420 : ARRAY[0..15] OF DINT; out : DINT; count : INT; END_VAR\n"
      "r[5] := 100; r[10] := 30; IF PID(1000, 0, r, out) THEN count := count + 1; END_IF;\nEND_PROGRAM\n";
  Running before(source);
  before.pass(6000);
  Started after(source, before.core.memory());
  const auto first = std::stoi(after.value("main.count"));
  for (std::uint64_t tick = 701; tick <= 1000; ++tick) after.core.advance(tick);
  EXPECT_EQ(std::stoi(after.value("main.count")) - first, 10);
}

TEST(Retention, IsShownWithTheVariables) {
  const auto variables = counting_programs().variables;
  EXPECT_TRUE(variables.find("%W10").retained);
  EXPECT_TRUE(variables.find("%R200.3").retained);
  EXPECT_FALSE(variables.find("%R200.4").retained);
  EXPECT_FALSE(variables.find("%W11").retained);
  EXPECT_TRUE(variables.find("fast.list[1]").retained);
}

// F105 was the feed override of channel 0, G0.2 the enable of the axes; X0.0 is what it was.
TEST(MovedRegisters, AreWarnedOfOnceWithTheirNewAddress) {
  const auto text = translate({{"fast.st",
                                "PROGRAM fast VAR o AT %F105 : UINT; END_VAR\n%W1 := o; %W2 := %F105;\n"
                                "%G0.2 := %X0.0 AND %F2565.0 AND %G300.0; %G0.2 := TRUE;\nEND_PROGRAM\n"},
                               {"main.il", "LD F101.0\nST G100.0\nLD F101.0\nST R0.0\n"}},
                              true)
                        .warnings;
  EXPECT_THAT(
      text,
      testing::ElementsAre(
          "fast.st:1:23: warning: %F105 was feed_override_0 in versions up to 0.3; nothing reads or writes "
          "it now: "
          "use the name, or %F2565",
          "fast.st:3:1: warning: %G0.2 was axes_enable in versions up to 0.3; nothing reads or writes it "
          "now: "
          "use the name, or %G2960.2",
          "main.il:1:4: warning: %F101.0 was m_strobe_0 in versions up to 0.3; nothing reads or writes it "
          "now: "
          "use the name, or %F2561.0",
          "main.il:2:4: warning: %G100.0 was fin_0 in versions up to 0.3; nothing reads or writes it now: "
          "use the name, or %G2560.0"));
}

}  // namespace
}  // namespace trunnion::plc
