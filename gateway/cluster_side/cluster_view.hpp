// SPDX-License-Identifier: Apache-2.0
// What a gateway knows of the cluster: the newest of every topic it shows.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "bus/bus.hpp"
#include "core/alarm_history.hpp"
#include "core/cluster_state.hpp"
#include "core/state_document.hpp"
#include "stream/batch_reader.hpp"

namespace trunnion::gateway {

/// Changes what the drive has said before anything of it is shown.
using FeedbackChange = std::function<void(idl::stream::Feedback&)>;

class ClusterView {
 public:
  /// `title` of the machine, for display. `change` is empty but in the tests of what compares gateways.
  explicit ClusterView(bus::Bus& bus, std::string title = {}, FeedbackChange change = {});
  /// Takes what has come. `now` in monotonic seconds.
  void drain(double now);
  /// Everything as it is now; peaks and the trace start afresh with it. `operating` is that of
  /// OperatingControl.
  std::shared_ptr<const ClusterState> state(double now, const bus::Json& operating = nullptr,
                                            bool with_replies = false);
  AlarmHistory& alarm_history() { return history_; }
  std::uint64_t batches() const { return batches_; }
  /// As of StateDocument.
  bool executed() const { return document_.executed(); }
  /// Of the emergency stop, that the drive holds; number 0 = none.
  const idl::plc::Press& press() const { return press_; }
  /// Of the parameters, 0 = none yet.
  std::uint64_t revision() const { return next_.parameters ? next_.parameters->revision : 0; }

 private:
  bus::Reader<idl::service::Announcement> announcements_;
  bus::Reader<idl::service::ServiceState> service_states_;
  bus::Reader<idl::service::Alarm> alarms_;
  bus::Reader<idl::service::Cluster> cluster_;
  bus::Reader<idl::channel::ChannelState> channel_states_;
  stream::BatchReader<idl::stream::Feedback> feedback_;
  bus::Reader<idl::plc::Outputs> outputs_;
  bus::Reader<idl::plc::Image> image_;
  bus::Reader<idl::channel::Variables> variables_;
  bus::Reader<idl::plc::Forces> forces_;
  bus::Reader<idl::plc::Programs> plc_programs_;
  bus::Reader<idl::plc::Watched> watched_;
  bus::Reader<idl::measurement::MeasurementState> measurement_;
  bus::Reader<idl::measurement::MeasurementResult> measurement_result_;
  bus::Reader<idl::parameters::ParameterSet> parameters_;
  bus::Reader<idl::parameters::ToolTable> tools_;
  bus::Reader<idl::parameters::WorkOffsets> offsets_;
  bus::Reader<idl::program::ProgramList> programs_;

  FeedbackChange change_;
  StateDocument document_;
  AlarmHistory history_;
  ClusterState next_;
  std::uint64_t batches_ = 0;
  idl::plc::Press press_{};
};

}  // namespace trunnion::gateway
