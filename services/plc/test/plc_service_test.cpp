// SPDX-License-Identifier: Apache-2.0
// The executable over DDS, with the test as drive, channel and keeper of parameters in virtual time.
#include "plc_over_dds.hpp"

namespace trunnion::plc {
namespace {

using idl::channel::AuxiliaryKind;
using idl::plc::PanelRequestKind;
constexpr int plc_domain = 63;

TEST(PlcServiceOverDds, HandshakesTakeTheSameTicksAndAKillChangesNoOutput) {
  RunningService service(TRUNNION_PLC, "plc", plc_domain);
  install(service);
  service.start({"--virtual-time"});
  Machine machine(plc_domain);
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.axis_enable.at(0) == 1; }));
  machine.ask(1, AuxiliaryKind::S, 0, 1000);
  ASSERT_TRUE(machine.run_until_done(1));
  EXPECT_EQ(machine.tick, 100u);
  machine.ask(2, AuxiliaryKind::M, 3, 0);
  ASSERT_TRUE(machine.run_until_done(2));
  // 2 1/min per tick reach 950 of 1000 after 475 ticks, checked every 10.
  EXPECT_EQ(machine.tick, 100u + 480u);
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.run_until_tick <= machine.tick; }));
  const auto before = machine.outputs;
  EXPECT_EQ(before.spindle_speed.at(0), 1000);

  service.kill_hard();
  machine.have_outputs = false;
  machine.done_count = 0;
  service.start({"--virtual-time"});
  ASSERT_TRUE(machine.wait_for([&] { return machine.done_count > 0; }));
  EXPECT_EQ(machine.outputs.spindle_speed, before.spindle_speed);
  EXPECT_EQ(machine.outputs.axis_enable, before.axis_enable);
  EXPECT_FALSE(machine.outputs.emergency_stop);
  EXPECT_EQ(machine.done.number, 2u);  // what was done is said again, not done again

  ASSERT_TRUE(machine.press(PanelRequestKind::PRESS_EMERGENCY_STOP));
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.emergency_stop; }));
  EXPECT_EQ(machine.outputs.spindle_speed.at(0), 0);
  ASSERT_TRUE(machine.press(PanelRequestKind::RELEASE_EMERGENCY_STOP));
  ASSERT_TRUE(machine.press(PanelRequestKind::RESET_EMERGENCY_STOP));
  ASSERT_TRUE(machine.wait_for([&] { return !machine.outputs.emergency_stop; }));
  EXPECT_EQ(machine.outputs.axis_enable.at(0), 1);
}

// A timer of an hour, as one that measures how long the channel runs. With the hour asked for at once, the
// drive was 10 s ahead before the programs saw a millisecond of it, and the limit of 8 s for a step of a tool
// change was over.
TEST(PlcServiceOverDds, VirtualTimeDoesNotRunAwayFromThePrograms) {
  RunningService service(TRUNNION_PLC, "plc_ahead", plc_domain);
  install(service);
  service.write("machine/plc/main.st",
                "PROGRAM main\nVAR hour : TON; END_VAR\nhour(IN := TRUE, PT := T#1h);\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine(plc_domain);
  for (const std::uint64_t wanted : {100u, 1000u, 5000u})
    ASSERT_TRUE(eventually([&] {
      machine.poll();
      if (machine.have_outputs) {
        EXPECT_LE(machine.outputs.run_until_tick, machine.outputs.tick + 100);
        if (machine.outputs.run_until_tick > machine.tick) {
          machine.tick = machine.outputs.run_until_tick;
          machine.send();
        }
      }
      return machine.tick >= wanted;
    })) << wanted;
}

TEST(PlcServiceOverDds, AFaultyProgramIsAFaultWithItsPlaceAndSafeOutputs) {
  RunningService service(TRUNNION_PLC, "plc_faulty", plc_domain);
  install(service);
  service.write("machine/plc/main.st", "PROGRAM main\nlamp := TRUE;\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine(plc_domain);
  ASSERT_TRUE(machine.wait_for([&] { return machine.state.lifecycle == idl::service::Lifecycle::FAULT; }));
  EXPECT_NE(machine.state.detail.find("main.st:2:1: error: there is no variable 'lamp'"), std::string::npos)
      << machine.state.detail;
  EXPECT_TRUE(machine.outputs.emergency_stop);
  EXPECT_EQ(machine.outputs.axis_enable.at(0), 0);
}

TEST(PlcServiceOverDds, ADivisionByZeroIsAnAlarmWithItsPlaceAndAResetStartsTheProgramAgain) {
  RunningService service(TRUNNION_PLC, "plc_division", plc_domain);
  install(service);
  service.write("machine/plc/extra.st",
                "FUNCTION quotient : INT\nVAR_INPUT d : INT; END_VAR\nquotient := 1 / d;\nEND_FUNCTION\n");
  service.write(
      "machine/plc/main.st",
      "PROGRAM main\nVAR a : INT; END_VAR\nIF NOT %X16.0 THEN\n  a := quotient(0);\nEND_IF;\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine(plc_domain);
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.emergency_stop; }));
  ASSERT_TRUE(machine.wait_for([&] {
    return machine.alarm_text.find("extra.st:3:15: error: division by zero in the main task") !=
           std::string::npos;
  })) << machine.alarm_text;
  // The cause is gone: after the reset the axes are enabled.
  ASSERT_TRUE(machine.force(16, 1));
  ASSERT_TRUE(machine.press(PanelRequestKind::RESET_EMERGENCY_STOP));
  ASSERT_TRUE(machine.wait_for(
      [&] { return !machine.outputs.emergency_stop && machine.outputs.axis_enable.at(0) == 1; }));
  // Once more, with the drive's feedback, which is at cycle 10 and tick 100: the alarm names the cycle.
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.tick == 100; }));
  ASSERT_TRUE(machine.force(16, 0));
  ASSERT_TRUE(machine.wait_for([&] { return machine.alarm_cycle == 10; })) << machine.alarm_cycle;
}

}  // namespace
}  // namespace trunnion::plc
