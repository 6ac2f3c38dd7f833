// SPDX-License-Identifier: Apache-2.0
// The process of the PLC: brings PlcCore its inputs, publishes its outputs, keeps its memory.
#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "modbus_service.hpp"
#include "online_service.hpp"
#include "order_service.hpp"
#include "plc_core.hpp"
#include "retained_memory.hpp"
#include "round_recorder.hpp"
#include "service/node.hpp"
#include "service/parameter_client.hpp"
#include "service/request.hpp"
#include "standby_service.hpp"
#include "stream/batch_reader.hpp"

namespace trunnion::plc {

class PlcService : public service::Service {
 public:
  /// The service while it is on standby.
  using Standby = StandbyService;

  explicit PlcService(service::Node& node);
  void pump() override;
  double period() const override {
    return node_.options().virtual_time && inputs_.tick == core_.memory().tick ? 0.05 : 0.01;
  }
  service::Health health() const override;
  service::SnapshotAnswer snapshot() override;
  void alarms_reset(std::uint16_t channel) override {
    if (channel != service::all_channels) return;  // the reset button is the machine's
    // The programs have asked for it: the button is not pressed once more.
    if (std::exchange(reset_sent_, -10) > service::monotonic_seconds() - 1) return;
    online_.each([](PlcCore& core) { core.press_reset(); });
    rounds_.record(StepKind::RESET_BUTTON);
  }

 private:
  void load_state();
  void configure();
  void continue_from_snapshot();
  void programs_changed();
  void begin_round();
  void end_round(const std::vector<idl::plc::AuxiliaryDone>& done);
  void advance(std::uint64_t tick);
  void take_inputs();
  std::uint64_t tick_now(double now) const;
  void publish(double now);
  void answer(const idl::plc::AuxiliaryDone& done);
  void applied(idl::stream::Input input, std::int64_t source_time);
  void publish_inputs(double now);
  void reset_alarms();

  service::Node& node_;
  std::optional<RetainedMemory> retained_;
  std::string boot_, fault_;
  bool usable_ = false;  ///< by every channel: there were such parameters
  service::ParameterClient parameters_;
  PlcCore core_;
  RoundRecorder rounds_;
  RoundWriter round_writer_;
  bus::Bytes round_bytes_;
  OnlineService online_;
  stream::BatchReader<idl::stream::Feedback> feedback_;
  bus::Reader<idl::channel::ChannelState> channels_;
  bus::Reader<idl::channel::AuxiliaryRequest> requests_;
  bus::Reader<idl::service::Alarm> alarms_;
  bus::Writer<idl::plc::Outputs> outputs_;
  bus::Writer<idl::plc::AuxiliaryDone> done_;
  bus::Writer<idl::plc::MacroSignal> signals_;
  bus::Writer<idl::plc::Image> image_;
  bus::Writer<idl::stream::InputLog> log_;
  bus::Writer<idl::service::AlarmReset> resets_;
  service::RequestServer<idl::plc::PanelRequest, idl::plc::PanelReply> panel_;
  ModbusService modbus_;
  OrderService orders_;

  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, idl::service::Alarm> active_alarms_;
  idl::stream::Feedback batch_;
  idl::stream::InputLog inputs_;
  idl::plc::Outputs last_outputs_;
  idl::plc::Image last_image_;
  std::uint64_t tick_ = 0, messages_in_ = 0, messages_out_ = 0;
  double tick_seen_ = 0, period_ = 0.001, outputs_written_ = 0, image_written_ = 0, log_written_ = 0,
         waiting_since_ = 0;
  std::uint64_t client_ = service::make_client_id(), resets_sent_ = 0;
  double reset_sent_ = -10;      ///< s
  bool external_reset_ = false;  ///< of the last round
  bool first_ = true, continued_ = false, stopped_ = false;
};

}  // namespace trunnion::plc
