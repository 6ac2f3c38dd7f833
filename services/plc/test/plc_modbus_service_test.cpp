// SPDX-License-Identifier: Apache-2.0
// The executable over DDS with Modbus, and its reset of alarms.
#include "modbus_peer.hpp"
#include "plc_over_dds.hpp"

namespace trunnion::plc {
namespace {

constexpr int domain = 63;

TEST(PlcModbusOverDds, WhatComesFromTheNetworkIsAnInputOfTheLog) {
  const int port = free_port();
  RunningService service(TRUNNION_PLC, "plc_modbus", domain);
  install(service);
  service.write("machine/plc/modbus.yaml",
                "server:\n  port: " + std::to_string(port) +
                    "\n  inputs:\n    - {table: coils, address: 0, count: 1, at: X0.0}\n"
                    "  outputs:\n    - {table: discrete_inputs, address: 0, count: 8, at: Y0}\n");
  service.start({"--virtual-time"});
  Machine machine(domain);
  auto log = machine.bus().reader(topics::plc_input_log);
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.axis_enable.at(0) == 1; }));
  Asking other(port);
  ASSERT_TRUE(other.connected());
  // Y0.0 is the lamp "ready", Y0.1 that of the emergency stop.
  ASSERT_TRUE(machine.wait_for([&] { return other.ask({2, 0, 0, 0, 2}) == Bytes{2, 1, 1}; }));
  EXPECT_EQ(other.ask({5, 0, 0, 0xff, 0}), (Bytes{5, 0, 0, 0xff, 0}));
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.emergency_stop; }));
  ASSERT_TRUE(machine.wait_for([&] { return other.ask({2, 0, 0, 0, 2}) == Bytes{2, 1, 2}; }));
  int inputs = 0;
  ASSERT_TRUE(machine.wait_for([&] {
    idl::stream::InputLog entry;
    while (log.take(entry))
      for (const auto& applied : entry.applied)
        inputs += applied.input == idl::stream::Input::PANEL_REQUEST ? 1 : 0;
    return inputs > 0;
  }));
  EXPECT_EQ(other.ask({5, 0, 0, 0, 0}), (Bytes{5, 0, 0, 0, 0}));
  // The reset counts when the button is released, a round after the answer.
  EXPECT_TRUE(machine.wait_for([&] {
    return machine.press(idl::plc::PanelRequestKind::RESET_EMERGENCY_STOP) && !machine.outputs.emergency_stop;
  }));
}

TEST(PlcModbusOverDds, ADeviceThatIsNotThereIsAnAlarmAndThePlcRuns) {
  RunningService service(TRUNNION_PLC, "plc_modbus_lost", domain);
  install(service);
  const int port = free_port();
  service.write("machine/plc/modbus.yaml",
                "devices:\n  tank:\n    host: 127.0.0.1\n    port: " + std::to_string(port) +
                    "\n    inputs:\n      - {table: coils, address: 0, count: 1, at: X0.0, at_loss: 1}\n");
  service.start({"--virtual-time"});
  Machine machine(domain);
  auto alarms = machine.bus().reader(topics::alarm);
  std::string text;
  const auto take = [&] {
    idl::service::Alarm alarm;
    while (alarms.take(alarm))
      if (alarm.number == alarm::plc_modbus.number) text = alarm.active ? alarm.text : "";
  };
  ASSERT_TRUE(machine.wait_for([&] { return take(), !text.empty(); }));
  EXPECT_NE(text.find("The Modbus device 'tank' (127.0.0.1, port"), std::string::npos) << text;
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.emergency_stop; }))
      << "X0.0 is 1 without a connection";
  Device device(port);
  ASSERT_TRUE(machine.wait_for([&] {
    return machine.press(idl::plc::PanelRequestKind::RESET_EMERGENCY_STOP) && !machine.outputs.emergency_stop;
  }));
}

TEST(PlcServiceOverDds, TheExternalResetOfTheManualsResetsTheAlarmsOnceForEachEdge) {
  RunningService service(TRUNNION_PLC, "plc_reset", domain);
  install(service);
  service.write(
      "machine/plc/main.st",
      "PROGRAM main\nVAR count : UINT; END_VAR\n%G2960.3 := %X16.0;\n"
      "IF reset_button THEN count := count + 1; END_IF;\n%Y20 := UINT_TO_USINT(count);\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine(domain);
  auto resets = machine.bus().reader(topics::alarm_reset);
  auto images = machine.bus().reader(topics::plc_image);
  ASSERT_TRUE(machine.wait_for([&] { return machine.outputs.axis_enable.at(0) == 1; }));
  int seen = 0;
  const auto take = [&] {
    idl::service::AlarmReset reset;
    while (resets.take(reset)) seen += reset.channel == 65535 ? 1 : 0;
    return seen;
  };
  for (int edge = 1; edge <= 2; ++edge) {
    ASSERT_TRUE(machine.force(16, 1));
    ASSERT_TRUE(machine.wait_for([&] { return take() == edge; }));
    ASSERT_TRUE(machine.force(16, 0));
    usleep(300000);
  }
  EXPECT_EQ(take(), 2);
  // Its own reset does not press the button, which would be a circle in programs as "G2960.3 :=
  // reset_button".
  idl::plc::Image image, newest;
  while (images.take(image)) newest = image;
  ASSERT_GT(newest.y.size(), 20u);
  EXPECT_EQ(newest.y[20], 0);
}

}  // namespace
}  // namespace trunnion::plc
