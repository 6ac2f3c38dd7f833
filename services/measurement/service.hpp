// SPDX-License-Identifier: Apache-2.0
// The process of the measurement: takes requests and the calls of programs, sends what Measurement asks for.
#pragma once

#include <future>

#include "measurement.hpp"
#include "service/node.hpp"
#include "service/request.hpp"

namespace trunnion::measurement {

class MeasurementService : public service::Service {
 public:
  explicit MeasurementService(service::Node& node);
  ~MeasurementService() override;
  void pump() override;
  double period() const override;
  service::Health health() const override;
  service::SnapshotAnswer snapshot() override;

 private:
  void restore();
  void listen(double now);
  void take_calls(double now);
  void take_answers(double now);
  void advance(double now);
  void keep();
  void publish();
  void send(Request request);
  void tell();

  service::Node& node_;
  std::string file_;
  Measurement core_;
  bus::Reader<idl::channel::ChannelState> states_;
  bus::Reader<idl::channel::Variables> variables_;
  bus::Reader<idl::service::Alarm> alarms_;
  bus::Reader<idl::channel::CycleRequest> calls_;
  bus::Reader<idl::parameters::ParameterSet> parameters_;
  bus::Writer<MeasurementState> state_;
  bus::Writer<MeasurementResult> result_;
  bus::Writer<idl::channel::CycleReply> call_reply_;
  service::RequestClient<idl::channel::ChannelRequest, idl::channel::ChannelReply> channel_;
  service::RequestClient<idl::program::ProgramRequest, idl::program::ProgramReply> program_;
  service::RequestClient<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> parameter_;
  service::RequestServer<MeasurementRequest, MeasurementReply> requests_;
  double begun_;  ///< s, monotonic
  std::future<WayAnswer> work_;
  idl::measurement::MeasurementResult published_;
  Phase told_ = Phase::NOTHING;
  std::string told_error_;
};

}  // namespace trunnion::measurement
