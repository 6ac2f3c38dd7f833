// SPDX-License-Identifier: Apache-2.0
// The executable over DDS, with the test as drive, channel and keeper of parameters in virtual time.
#include <gtest/gtest.h>

#include <algorithm>

#include "contracts/topics.hpp"
#include "machine/alarm_constants.hpp"
#include "service/request.hpp"
#include "testing_support/running_service.hpp"

namespace trunnion::plc {
namespace {

using idl::channel::AuxiliaryKind;
using idl::plc::PanelRequestKind;
using testing_support::eventually;
using testing_support::RunningService;
constexpr int domain = 63;

class Machine {
 public:
  Machine()
      : bus_(bus::Vendor::cyclonedds, {domain}),
        parameters_(bus_.writer(topics::parameter_set)),
        feedback_(bus_.writer(topics::feedback_frame)),
        request_(bus_.writer(topics::auxiliary_request)),
        outputs_(bus_.reader(topics::plc_outputs)),
        done_(bus_.reader(topics::auxiliary_done)),
        states_(bus_.reader(topics::service_state)),
        alarms_(bus_.reader(topics::alarm)),
        panel_(bus_, topics::panel_request, topics::panel_reply) {
    idl::parameters::ParameterSet set;
    set.revision = 1;
    set.values = {{100000, 0, "X"}, {110000, 0, "S"}, {110001, 10, ""}};
    parameters_.write(set);
    send();
  }
  void send() {
    idl::stream::FeedbackFrame frame;
    frame.first = 10, frame.tick = tick, frame.spindle_speed = {speed};
    frame.channels.resize(1);
    frame.enabled = {1};
    feedback_.write(frame);
  }
  void ask(std::uint32_t number, idl::channel::AuxiliaryKind kind, std::uint32_t code, double value) {
    request_.write({0, number, kind, code, value, 10});
  }
  /// The drive's side of virtual time, until request `number` is done; 1/min per tick: 2.
  bool run_until_done(std::uint32_t number) {
    return eventually([&] {
      poll();
      if (have_outputs && outputs.run_until_tick > tick) {
        for (; tick < outputs.run_until_tick; ++tick)
          speed += std::clamp(outputs.spindle_speed.at(0) - speed, -2.0, 2.0);
        send();
      }
      return done.number == number;
    });
  }
  void poll() {
    while (outputs_.take(outputs)) have_outputs = true;
    while (done_.take(done)) ++done_count;
    while (states_.take(state)) {
    }
    idl::service::Alarm alarm;
    while (alarms_.take(alarm))
      if (alarm.number == alarm::plc_program.number) alarm_text = alarm.text;
  }
  bool press(idl::plc::PanelRequestKind kind) {
    idl::plc::PanelRequest request;
    request.kind = kind;
    const auto reply = panel_.call(request, 10);
    return reply && reply->accepted;
  }
  bool force(std::uint32_t address, std::uint32_t value) {
    idl::plc::PanelRequest request;
    request.kind = PanelRequestKind::FORCE_INPUT;
    request.address = address, request.value = value;
    const auto reply = panel_.call(request, 10);
    return reply && reply->accepted;
  }
  template <class Condition>
  bool wait_for(Condition condition) {
    return eventually([&] { return poll(), have_outputs && condition(); });
  }

  std::uint64_t tick = 100;
  double speed = 0;
  idl::plc::Outputs outputs;
  idl::plc::AuxiliaryDone done;
  idl::service::ServiceState state;
  bool have_outputs = false;
  std::string alarm_text;  // of the newest alarm of the program
  int done_count = 0;

 private:
  bus::Bus bus_;
  bus::Writer<idl::parameters::ParameterSet> parameters_;
  bus::Writer<idl::stream::FeedbackFrame> feedback_;
  bus::Writer<idl::channel::AuxiliaryRequest> request_;
  bus::Reader<idl::plc::Outputs> outputs_;
  bus::Reader<idl::plc::AuxiliaryDone> done_;
  bus::Reader<idl::service::ServiceState> states_;
  bus::Reader<idl::service::Alarm> alarms_;
  service::RequestClient<idl::plc::PanelRequest, idl::plc::PanelReply> panel_;
};

void install(const RunningService& service) {
  service.write("state/cluster.boot", "boot\n");
  std::filesystem::copy(TRUNNION_MACHINES "/ac-table/plc", service.machine() + "/plc");
}

TEST(PlcServiceOverDds, HandshakesTakeTheSameTicksAndAKillChangesNoOutput) {
  RunningService service(TRUNNION_PLC, "plc", domain);
  install(service);
  service.start({"--virtual-time"});
  Machine machine;
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

TEST(PlcServiceOverDds, AFaultyProgramIsAFaultWithItsPlaceAndSafeOutputs) {
  RunningService service(TRUNNION_PLC, "plc_faulty", domain);
  install(service);
  service.write("machine/plc/main.st", "PROGRAM main\nlamp := TRUE;\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine;
  ASSERT_TRUE(machine.wait_for([&] { return machine.state.lifecycle == idl::service::Lifecycle::FAULT; }));
  EXPECT_NE(machine.state.detail.find("main.st:2:1: error: there is no variable 'lamp'"), std::string::npos)
      << machine.state.detail;
  EXPECT_TRUE(machine.outputs.emergency_stop);
  EXPECT_EQ(machine.outputs.axis_enable.at(0), 0);
}

TEST(PlcServiceOverDds, ADivisionByZeroIsAnAlarmWithItsPlaceAndAResetStartsTheProgramAgain) {
  RunningService service(TRUNNION_PLC, "plc_division", domain);
  install(service);
  service.write("machine/plc/extra.st",
                "FUNCTION quotient : INT\nVAR_INPUT d : INT; END_VAR\nquotient := 1 / d;\nEND_FUNCTION\n");
  service.write(
      "machine/plc/main.st",
      "PROGRAM main\nVAR a : INT; END_VAR\nIF NOT %X16.0 THEN\n  a := quotient(0);\nEND_IF;\nEND_PROGRAM\n");
  service.start({"--virtual-time"});
  Machine machine;
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
}

}  // namespace
}  // namespace trunnion::plc
