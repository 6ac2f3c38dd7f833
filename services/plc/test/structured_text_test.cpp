// SPDX-License-Identifier: Apache-2.0
// Tasks in Structured Text: the same as the instruction list of the same machine, their state, their faults.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "machine/parameters.hpp"
#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"
#include "plc_core.hpp"
#include "program_files.hpp"
#include "retained_memory.hpp"
#include "round.hpp"
#include "running_core.hpp"

namespace trunnion::plc::structured_text_test {
namespace {

machine::Parameters parameters() {
  machine::Parameters p;
  p.values[100000] = {0, "X"};
  for (const std::uint32_t spindle : {0u, 1u}) {
    p.values[110000 + 1000 * spindle] = {0, "S"};
    p.values[110001 + 1000 * spindle] = {10, ""};
  }
  return p;
}

machine::Parameters without_spindle() {
  machine::Parameters p;
  p.values[100000] = {0, "X"};
  return p;
}

/// A PLC whose main task is the source; the fast one does nothing.
PlcCore core_of(const std::string& source) {
  const auto compiled = st::compile({{"main.st", source}}, st::interface_registers());
  EXPECT_TRUE(compiled.good()) << testing::PrintToString(compiled.lines());
  PlcCore core;
  core.configure(without_spindle(), true);
  StructuredPrograms programs{compiled.code, compiled.layout(), {std::nullopt, std::size_t{0}}};
  core.load(StructuredText(std::move(programs)));
  return core;
}

PlcCore core_of_directory(const std::string& directory, const machine::Parameters& p = parameters()) {
  PlcCore core;
  core.configure(p, true);
  EXPECT_TRUE(load_programs(directory, core).empty()) << directory;
  return core;
}

// The variables of a program: their addresses are its own.
bool is_free_for_programs(const std::string& name) {
  return name.starts_with("R") || name.starts_with("W") || name.starts_with("G30") || name.starts_with("G31");
}

// The lamps and switches of the operator panels, which the instruction list does not have, and what they
// order while no key is pressed: speed and increment of the jog, overrides that are not in force, the
// handwheel.
bool is_of_panel(const std::string& name) {
  return name.starts_with("X1") || name.starts_with("Y1") || (name >= "G2564" && name <= "G2571") ||
         (name >= "G2644" && name <= "G2651");
}

// Whatever happens to both, in the same order at the same ticks, every register of the interface, every
// output and every finished function is the same.
void expect_same_logic(const std::string& list_directory, const std::string& machine, unsigned channels) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    auto list = core_of_directory(std::string(TRUNNION_INSTRUCTION_LISTS) + "/" + list_directory),
         text = core_of_directory(std::string(TRUNNION_MACHINES) + "/" + machine + "/plc");
    std::uint64_t tick = 1000;
    std::uint32_t number = 0;
    std::vector<double> speed(channels, 0);
    std::size_t finished = 0;
    const auto both = [&](auto&& act) { act(list), act(text); };
    for (int step = 0; step < 400; ++step) {
      const auto choice = random() % 100;
      const auto channel = static_cast<std::uint16_t>(random() % channels);
      if (choice < 25) {
        using enum AuxiliaryKind;
        constexpr std::uint32_t codes[] = {0, 2, 3, 4, 5, 6, 7, 8, 9, 30, 99, 65535};
        const auto kind = random() % 4;
        idl::channel::AuxiliaryRequest request{channel,
                                               ++number,
                                               kind == 0   ? S
                                               : kind == 1 ? T
                                                           : M,
                                               codes[random() % std::size(codes)],
                                               static_cast<double>(random() % 70000),
                                               false,
                                               10};
        both([&](PlcCore& core) { core.set_request(request); });
      } else if (choice < 35) {
        idl::plc::PanelRequest panel;
        panel.kind = static_cast<idl::plc::PanelRequestKind>(random() % 3);
        both([&](PlcCore& core) { EXPECT_EQ(core.panel(panel), ""); });
      } else if (choice < 40) {
        idl::plc::PanelRequest panel;
        panel.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
        panel.value = static_cast<std::uint32_t>(random() % 8);
        both([&](PlcCore& core) { EXPECT_EQ(core.panel(panel), ""); });
      } else if (choice < 50) {
        idl::channel::ChannelState state;
        state.channel = channel;
        state.spindle_override = static_cast<double>(random() % 151) / 100;
        state.reset_count = static_cast<std::uint32_t>(step / 50);
        both([&](PlcCore& core) { core.set_channel(state); });
      } else if (choice < 55) {
        const bool any = random() % 2 == 0;
        both([&](PlcCore& core) { core.set_alarms(any, false); });
      } else {
        tick += random() % 40;
        for (unsigned i = 0; i < channels; ++i) {
          const auto target = list.outputs().spindle_speed.at(i);
          speed[i] = random() % 3 == 0 ? target : speed[i] + (target - speed[i]) / 2;
        }
        idl::stream::Feedback feedback;
        feedback.first = 10, feedback.tick = tick, feedback.spindle_speed = speed, feedback.enabled = {1};
        feedback.channels.resize(channels);
        for (unsigned i = 0; i < channels; ++i) feedback.channels[i].channel = static_cast<std::uint16_t>(i);
        both([&](PlcCore& core) { core.set_feedback(feedback); });
      }
      both([&](PlcCore& core) { core.advance(tick); });
      ASSERT_EQ(text.outputs(), list.outputs()) << "seed " << seed << " step " << step;
      for (const auto& index : changes(list.memory().registers, text.memory().registers))
        ASSERT_TRUE(is_free_for_programs(register_name(index)) || is_of_panel(register_name(index)))
            << register_name(index) << ", seed " << seed << " step " << step;
      const auto done = list.take_done();
      ASSERT_EQ(text.take_done(), done) << "seed " << seed << " step " << step;
      finished += done.size();
    }
    EXPECT_GT(finished, 20u) << "seed " << seed;
  }
}

TEST(StructuredText, TheLogicOfTwoChannelsIsThatOfTheInstructionList) {
  expect_same_logic("two_channels", "two-channel", 2);
}

TEST(StructuredText, TimersOfVariablesRequestExactlyTheirTime) {
  auto core = core_of(
      "PROGRAM main\nVAR t : ARRAY[1..2] OF TON; END_VAR\nt[2](IN := %X16.0, PT := T#70ms);\n%Y16.0 := "
      "t[2].Q;\nEND_PROGRAM\n");
  core.advance(100);
  idl::plc::PanelRequest panel;
  panel.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
  panel.address = 16, panel.value = 1;
  core.panel(panel);
  core.advance(100);
  EXPECT_EQ(core.outputs().run_until_tick, 170u);
  core.advance(169);
  EXPECT_EQ(core.image().y[16], 0);
  core.advance(170);
  EXPECT_EQ(core.image().y[16], 1);
  EXPECT_EQ(core.outputs().run_until_tick, 170u);
}

// A run has 243 statements: IF, FOR and 120 of its body with 120 steps back, fin. So it takes two scans of at
// most 200, and the scan of tick 110, the tenth behind 100, leaves it in the middle.
TEST(StructuredText, AFunctionThatComesWithinARunOfTheMainTaskIsCarriedOutByTheNextOne) {
  auto core = core_of(R"(PROGRAM main
VAR i : INT; n : DINT; END_VAR
IF m_strobe_0 THEN
  %Y16.0 := TRUE;
END_IF;
FOR i := 1 TO 120 DO
  n := n + 1;
END_FOR;
fin_0 := m_strobe_0;
END_PROGRAM
)");
  idl::stream::Feedback feedback;
  feedback.first = 10;
  feedback.channels.resize(1);
  core.set_feedback(feedback);
  core.advance(100);
  core.advance(110);
  ASSERT_NE(core.memory().program.main.interrupted, 0u);
  core.set_request({0, 1, AuxiliaryKind::M, 7, 0, false, 10});
  core.advance(110);
  EXPECT_EQ(core.take_done().size(), 1u);
  EXPECT_EQ(core.image().y[16] & 1, 1);
}

// 10,003 statements are 51 scans, more than those at one time.
TEST(StructuredText, AFunctionIsCarriedOutHoweverLongTheRunIsThatItWaitsFor) {
  auto core = core_of(R"(PROGRAM main
VAR i : INT; n : DINT; END_VAR
IF m_strobe_0 THEN
  %Y16.0 := TRUE;
END_IF;
FOR i := 1 TO 5000 DO
  n := n + 1;
END_FOR;
fin_0 := m_strobe_0;
END_PROGRAM
)");
  idl::stream::Feedback feedback;
  feedback.first = 10;
  feedback.channels.resize(1);
  core.set_feedback(feedback);
  core.advance(100);
  ASSERT_NE(core.memory().program.main.interrupted, 0u);
  core.set_request({0, 1, AuxiliaryKind::M, 7, 0, false, 10});
  std::uint64_t tick = 100;
  std::size_t done = 0;
  for (; done == 0 && tick < 300; ++tick) {
    core.advance(tick);
    done = core.take_done().size();
  }
  EXPECT_EQ(done, 1u);
  EXPECT_EQ(core.image().y[16] & 1, 1);
}

class DeviceDirectory {
 public:
  DeviceDirectory() {
    std::filesystem::create_directory(path_);
    write("fast.st", "PROGRAM fast\nEND_PROGRAM\n");
    write("main.st", "PROGRAM main\n%Y17.0 := %X16.0;\n%Y17.1 := NOT %X16.0;\nEND_PROGRAM\n");
    write("devices.yaml",
          "door:\n  actuator: {extend: Y17.0, retract: Y17.1, travel_s: 1.5, extended: X17.0, retracted: "
          "X17.1}\n"
          "park:\n  position_switch: {axis: X, from: -10, to: -5, on: X17.2}\n");
  }
  ~DeviceDirectory() { std::filesystem::remove_all(path_); }
  const std::string& path() const { return path_; }

 private:
  void write(const std::string& name, const std::string& text) { std::ofstream(path_ + "/" + name) << text; }
  std::string path_ =
      (std::filesystem::temp_directory_path() / ("plc-devices-" + std::to_string(getpid()))).string();
};

// The command changes at tick 100. Virtual time is asked to pass up to 1500 ms later, when the door is open.
TEST(SimulatedDevices, AnActuatorRequestsTheTimeOfItsTravelAndIsPartOfTheState) {
  const DeviceDirectory directory;
  auto core = core_of_directory(directory.path(), without_spindle());
  core.advance(100);
  EXPECT_EQ(core.image().x[17] & 3, 2) << "closed";
  idl::plc::PanelRequest panel;
  panel.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
  panel.address = 16, panel.value = 1;
  core.panel(panel);
  core.advance(100);
  EXPECT_EQ(core.outputs().run_until_tick, 1600u);
  core.advance(700);
  auto other = core_of_directory(directory.path(), without_spindle());
  other.adopt(core.state());
  for (auto* one : {&core, &other}) {
    one->advance(1599);
    EXPECT_EQ(one->image().x[17] & 3, 0) << "on its way";
    one->advance(1600);
    EXPECT_EQ(one->image().x[17] & 3, 1) << "open";
  }
}

TEST(SimulatedDevices, APositionSwitchFollowsTheFeedbackOfItsAxis) {
  const DeviceDirectory directory;
  auto core = core_of_directory(directory.path());
  for (const auto& [x, on] :
       std::vector<std::pair<double, bool>>{{-10.001, false}, {-10, true}, {-5, true}, {-4.9, false}}) {
    idl::stream::Feedback feedback;
    feedback.position = {x};
    core.set_feedback(feedback);
    EXPECT_EQ((core.image().x[17] & 4) != 0, on) << x;
  }
}

TEST(SimulatedDevices, WithOtherHardwareTheyDoNotRun) {
  const DeviceDirectory directory;
  PlcCore core;
  core.configure(parameters(), true);
  EXPECT_TRUE(load_programs(directory.path(), core, false).empty());
  core.advance(100);
  EXPECT_EQ(core.image().x[17], 0);
}

constexpr const char* counting =
    "PROGRAM main\nVAR n : DINT; END_VAR\nVAR RETAIN kept : DINT := 5; END_VAR\nn := n + 1;\nkept := kept + "
    "1;\nEND_PROGRAM\n";

TEST(StructuredText, ARestartedProcessContinuesAndAPowerUpKeepsRetainVariables) {
  auto core = core_of(counting);
  core.advance(0);
  core.advance(100);
  const auto& values = core.memory().program.values;
  const auto n = values[1], kept = values[2];  // cell 0 is the time that a test has advanced
  EXPECT_EQ(kept, n + 5);
  EXPECT_GT(n, 9u);
  auto restarted = core_of(counting);
  restarted.restore(core.memory());
  EXPECT_EQ(restarted.memory().program, core.memory().program);
  auto adopted = core_of(counting);
  adopted.adopt(core.state());
  adopted.advance(110), core.advance(110);
  EXPECT_EQ(adopted.memory().program, core.memory().program);
  auto powered = core_of(counting);
  powered.power_up(core.memory());
  EXPECT_EQ(powered.memory().program.values[1], 0u);
  EXPECT_EQ(powered.memory().program.values[2], core.memory().program.values[2]);
}

TEST(StructuredText, VariablesOfAnotherProgramAreNotUsed) {
  auto core = core_of(counting);
  core.advance(0), core.advance(100);
  auto other = core_of("PROGRAM main\nVAR RETAIN other : INT := 3; END_VAR\nother := other;\nEND_PROGRAM\n");
  EXPECT_FALSE(other.accepts(core.memory().program));
  other.power_up(core.memory());
  EXPECT_EQ(other.memory().program.values[1], 3u);
  other.restore(core.memory());
  EXPECT_EQ(other.memory().program.values[1], 3u);
}

TEST(StructuredText, AFaultStopsBothTasksSafelyUntilAReset) {
  auto core = core_of(
      "PROGRAM main\nVAR i : INT; a : ARRAY[0..3] OF INT; END_VAR\naxes_enable := TRUE;\n"
      "IF %X16.0 THEN i := 4; ELSE i := 0; END_IF;\na[i] := 1;\nEND_PROGRAM\n");
  core.advance(10);
  EXPECT_FALSE(core.emergency_stop());
  idl::plc::PanelRequest panel;
  panel.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
  panel.address = 16, panel.value = 1;
  core.panel(panel);
  core.advance(10);
  EXPECT_TRUE(core.emergency_stop());
  EXPECT_TRUE(core.outputs().emergency_stop);
  EXPECT_EQ(core.program_fault().substr(0, 72),
            "main.st:5:3: error: index 4 is outside 0 .. 3 of the array in the main t");
  core.advance(1000);
  EXPECT_TRUE(core.emergency_stop());
  core.press_reset();  // the cause is still there
  core.advance(1010);
  EXPECT_TRUE(core.emergency_stop());
  panel.value = 0;
  core.panel(panel);
  core.press_reset();
  core.advance(1020);
  EXPECT_FALSE(core.emergency_stop());
  EXPECT_EQ(core.program_fault(), "");
}

TEST(StructuredText, AProgramWithoutEndIsStoppedWithItsPlace) {
  auto core =
      core_of("PROGRAM main\nVAR n : DINT; END_VAR\nWHILE TRUE DO\n  n := n + 1;\nEND_WHILE;\nEND_PROGRAM\n");
  // 100,000 statements, 200 in a scan of 1 ms.
  for (std::uint64_t tick = 10; tick <= 520; tick += 10) core.advance(tick);
  EXPECT_TRUE(core.emergency_stop());
  EXPECT_NE(core.program_fault().find("more than 100000 statements in one run in the main task"),
            std::string::npos)
      << core.program_fault();
  EXPECT_EQ(core.program_fault().substr(0, 8), "main.st:");
}

TEST(StructuredText, AFastTaskWithoutEndIsStoppedInItsFirstScanWithItsPlace) {
  PlcCore core;
  core.configure(without_spindle(), true);
  core.load(translate(
      {{"fast.st",
        "PROGRAM fast\nVAR n : DINT; END_VAR\nWHILE TRUE DO\n  n := n + 1;\nEND_WHILE;\nEND_PROGRAM\n"},
       {"main.st", "PROGRAM main\naxes_enable := TRUE; %W7 := %W7 + 1;\nEND_PROGRAM\n"}},
      true));
  core.advance(1000);
  EXPECT_TRUE(core.emergency_stop());
  EXPECT_NE(core.program_fault().find("error: more than 100000 statements in one run in the fast task; "),
            std::string::npos)
      << core.program_fault();
  EXPECT_TRUE(core.program_fault().starts_with("fast.st:3:") ||
              core.program_fault().starts_with("fast.st:4:"))
      << core.program_fault();
  core.advance(1100);
  EXPECT_EQ(core.memory().registers.w[7], 0) << "the main task does not run behind the fault";
}

// The array takes a cell for each element; the rest is what the same program needs besides.
TEST(StructuredText, VariablesTakeAsManyCellsAsThereAreAndAnErrorSaysWhatToDo) {
  const auto source = [](std::size_t elements) {
    return "PROGRAM main\nVAR a : ARRAY[1.." + std::to_string(elements) + "] OF INT; END_VAR\na[" +
           std::to_string(elements) + "] := a[1] + 7;\nEND_PROGRAM\n";
  };
  const auto most = program_cells - (Running(source(1000)).core.memory().program.cells - 1000);
  ASSERT_GT(most, 8000u);
  Running plc(source(most));
  EXPECT_EQ(plc.core.memory().program.cells, program_cells);
  EXPECT_EQ(plc.value("main.a[" + std::to_string(most) + "]"), "7");
  try {
    Running(source(most + 1));
    FAIL() << "too many cells are accepted";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(),
                 "the variables of the PLC programs need 8193 cells of 64 bits, and there are 8192: shorten "
                 "arrays and strings, and use as few instances of function blocks as needed");
  }
}

// 3 ms are 12 ticks of 250 us, 3 of 1 ms, and end in the second of 2 ms. The fast task runs once each ms.
TEST(StructuredText, TheTasksFollowTheInterpolationCycle) {
  struct Cycle {
    std::int64_t us;
    std::uint64_t ticks_of_timer, ticks_of_100_ms;
  };
  for (const auto& [us, ticks_of_timer, ticks_of_100_ms] :
       {Cycle{250, 12, 400}, {1000, 3, 100}, {2000, 2, 50}}) {
    SCOPED_TRACE(us);
    auto parameters = without_spindle();
    parameters.values[1] = {static_cast<double>(us), ""};  // 000001
    PlcCore core;
    core.configure(parameters, true);
    core.load(translate({{"fast.st", "PROGRAM fast\n%W7 := %W7 + 1;\nEND_PROGRAM\n"},
                         {"main.st",
                          "PROGRAM main\nVAR t : TON; END_VAR\nt(IN := TRUE, PT := T#3ms); %Y16.0 := t.Q;\n"
                          "END_PROGRAM\n"}},
                        true));
    core.advance(1000);
    EXPECT_EQ(core.outputs().run_until_tick, 1000 + ticks_of_timer);
    for (std::uint64_t tick = 1001; tick < 1000 + ticks_of_timer; ++tick) core.advance(tick);
    EXPECT_EQ(core.memory().registers.y[16], 0);
    core.advance(1000 + ticks_of_timer);
    EXPECT_EQ(core.memory().registers.y[16], 1);
    const auto scans = core.memory().scans;
    const auto runs = core.memory().registers.w[7];
    for (std::uint64_t i = 1; i <= ticks_of_100_ms; ++i) core.advance(1000 + ticks_of_timer + i);
    EXPECT_EQ(core.memory().scans - scans, 100u);
    EXPECT_EQ(core.memory().registers.w[7] - runs, 100);
  }
}

TEST(StructuredText, TheStateDigestSeesEveryVariable) {
  auto core = core_of(counting);
  core.advance(0);
  auto state = core.state();
  const auto before = state_digest(state);
  state.memory.program.values[1] ^= 1;
  EXPECT_NE(state_digest(state), before);
}

// The files have the size that the programs need; another program finds them, and the registers B survive.
TEST(StructuredText, RetainedFilesChangeTheirSizeWithTheProgramAndLeaveNothingBehind) {
  const auto directory =
      std::filesystem::path(testing::TempDir()) / ("plc_sizes_" + std::to_string(getpid()));
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  const auto path = (directory / "plc.image").string();
  Memory memory;
  std::vector<std::size_t> sizes = {0, 7, 3, 0, 4096, 5000, program_cells};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto cells = sizes[i];
    const auto found = RetainedMemory(path, cells).load();
    if (i > 0) {
      ASSERT_EQ(found.state, storage::KeptState::good) << i << " " << found.problem;
      EXPECT_EQ(found.kept->memory.registers.b[7], static_cast<std::int32_t>(i) - 1);
      EXPECT_EQ(found.kept->memory.program.cells, sizes[i - 1]);
      if (sizes[i - 1] > 0) {
        EXPECT_EQ(found.kept->memory.program.values[sizes[i - 1] - 1], 40 + i - 1);
      }
    }
    memory = {};
    memory.registers.b[7] = static_cast<std::int32_t>(i);
    memory.program.cells = static_cast<std::uint32_t>(cells);
    if (cells > 0) memory.program.values[cells - 1] = 40 + i;
    RetainedMemory retained(path, cells);
    retained.save("boot", memory);
    retained.save("boot", memory);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(directory)) ++files, (void)entry;
    EXPECT_EQ(files, 2u);
  }
  std::filesystem::remove_all(directory);
}

}  // namespace
}  // namespace trunnion::plc::structured_text_test
