// SPDX-License-Identifier: Apache-2.0
// The test as drive, channel and keeper of parameters of a PLC over DDS, in virtual time.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "contracts/topics.hpp"
#include "machine/alarm_constants.hpp"
#include "service/request.hpp"
#include "testing_support/running_service.hpp"

namespace trunnion::plc {

using testing_support::eventually;
using testing_support::RunningService;

class Machine {
 public:
  explicit Machine(std::uint32_t domain)
      : bus_(bus::Vendor::cyclonedds, {domain}),
        parameters_(bus_.writer(topics::parameter_set)),
        feedback_(bus_.writer(topics::feedback)),
        request_(bus_.writer(topics::auxiliary_request)),
        outputs_(bus_.reader(topics::plc_outputs)),
        done_(bus_.reader(topics::auxiliary_done)),
        states_(bus_.reader(topics::service_state)),
        alarms_(bus_.reader(topics::alarm)),
        panel_(bus_, topics::panel_request, topics::panel_reply),
        online_(bus_, topics::online_request, topics::online_reply) {
    idl::parameters::ParameterSet set;
    set.revision = 1;
    set.values = {{100000, 0, "X"}, {110000, 0, "S"}, {110001, 10, ""}};
    parameters_.write(set);
    send();
  }
  void send() {
    idl::stream::Feedback batch;
    batch.first = 10, batch.tick = tick, batch.axis_count = 1, batch.spindle_speed = {speed};
    batch.channels.resize(1);
    batch.enabled = {1};
    feedback_.write(batch);
  }
  void ask(std::uint32_t number, idl::channel::AuxiliaryKind kind, std::uint32_t code, double value) {
    request_.write({0, number, kind, code, value, false, 10});
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
    while (alarms_.take(alarm)) {
      if (alarm.number == alarm::plc_program.number) alarm_text = alarm.text, alarm_cycle = alarm.cycle;
      if (alarm.number == alarm::plc_forced.number) forced_text = alarm.active ? alarm.text : "";
    }
  }
  bool press(idl::plc::PanelRequestKind kind) {
    idl::plc::PanelRequest request;
    request.kind = kind;
    const auto reply = panel_.call(request, 10);
    return reply && reply->accepted;
  }
  bool force(std::uint32_t address, std::uint32_t value) {
    idl::plc::PanelRequest request;
    request.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
    request.address = address, request.value = value;
    const auto reply = panel_.call(request, 10);
    return reply && reply->accepted;
  }
  idl::plc::OnlineReply call(idl::plc::OnlineRequest request) {
    const auto reply = online_.call(std::move(request), 10);
    EXPECT_TRUE(reply) << "no answer";
    return reply ? *reply : idl::plc::OnlineReply{};
  }
  idl::plc::OnlineReply call(idl::plc::OnlineAction action) {
    idl::plc::OnlineRequest request;
    request.action = action;
    return call(request);
  }
  /// Does not wait for the answer.
  void send(idl::plc::OnlineRequest request) { online_.send(std::move(request)), online_.abandon(); }
  bus::Bus& bus() { return bus_; }
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
  std::uint64_t alarm_cycle = 0;
  std::string forced_text;  // of the alarm while anything is forced
  int done_count = 0;

 private:
  bus::Bus bus_;
  bus::Writer<idl::parameters::ParameterSet> parameters_;
  bus::Writer<idl::stream::Feedback> feedback_;
  bus::Writer<idl::channel::AuxiliaryRequest> request_;
  bus::Reader<idl::plc::Outputs> outputs_;
  bus::Reader<idl::plc::AuxiliaryDone> done_;
  bus::Reader<idl::service::ServiceState> states_;
  bus::Reader<idl::service::Alarm> alarms_;
  service::RequestClient<idl::plc::PanelRequest, idl::plc::PanelReply> panel_;
  service::RequestClient<idl::plc::OnlineRequest, idl::plc::OnlineReply> online_;
};

inline void install(const RunningService& service) {
  service.write("state/cluster.boot", "boot\n");
  std::filesystem::copy(TRUNNION_MACHINES "/ac-table/plc", service.machine() + "/plc");
}

}  // namespace trunnion::plc
