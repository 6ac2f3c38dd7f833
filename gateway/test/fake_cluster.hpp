// SPDX-License-Identifier: Apache-2.0
// The rest of a cluster as the gateway sees it: one five-axis channel that runs on a circle, and services
// that answer.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "service/request.hpp"

namespace trunnion::gateway {

class FakeCluster {
 public:
  explicit FakeCluster(const bus::NetworkSettings& network);

  /// Answers what has arrived and publishes what is due. Call every few milliseconds.
  void step();
  /// `programs` is another list.
  void publish_programs();

  /// What the services were asked, in the order it arrived.
  std::vector<idl::channel::ChannelRequest> channel_requests;
  std::vector<idl::plc::PanelRequest> panel_requests;
  std::vector<idl::service::AlarmReset> alarm_resets;
  std::vector<idl::parameters::ParameterRequest> parameter_requests;
  /// The channel service hears, but does not answer.
  bool channel_is_silent = false;
  /// It does not hear either, until it goes on.
  bool channel_hangs = false;
  /// The drive executes no cycle, and says so by batches without rows; how many there were.
  bool at_rest = false;
  std::size_t batches_at_rest = 0;
  std::map<std::string, std::vector<std::uint8_t>> programs;
  std::uint64_t largest_program = 1u << 30;  ///< bytes for which there is room
  std::map<std::string, int> stored_by;      ///< the role of each program that was stored
  idl::channel::ChannelState channel;
  std::uint64_t largest_write = 0;  ///< bytes in the largest part of an upload

 private:
  void answer_channel();
  void answer_program();
  void answer_others();
  void publish_once();
  void publish_motion(double now);
  /// Of the axes, on the circle.
  std::vector<double> positions() const;
  idl::channel::ChannelReply apply(const idl::channel::ChannelRequest& request);

  bus::Bus bus_;
  service::RequestServer<idl::channel::ChannelRequest, idl::channel::ChannelReply> channel_server_;
  service::RequestServer<idl::plc::PanelRequest, idl::plc::PanelReply> panel_server_;
  service::RequestServer<idl::parameters::ParameterRequest, idl::parameters::ParameterReply>
      parameter_server_;
  service::RequestServer<idl::program::ProgramRequest, idl::program::ProgramReply> program_server_;
  bus::Reader<idl::service::AlarmReset> alarm_reset_;
  bus::Writer<idl::service::Announcement> announcement_;
  bus::Writer<idl::service::ServiceState> service_state_;
  bus::Writer<idl::service::Alarm> alarm_;
  bus::Writer<idl::service::Cluster> cluster_;
  bus::Writer<idl::channel::ChannelState> channel_state_;
  bus::Writer<idl::stream::Feedback> feedback_;
  bus::Writer<idl::plc::Outputs> outputs_;
  bus::Writer<idl::plc::Image> image_;
  bus::Writer<idl::parameters::ParameterSet> parameter_set_;
  bus::Writer<idl::parameters::ToolTable> tool_table_;
  bus::Writer<idl::parameters::WorkOffsets> work_offsets_;
  bus::Writer<idl::program::ProgramList> program_list_;
  bus::Writer<idl::measurement::MeasurementState> measurement_state_;
  bus::Writer<idl::measurement::MeasurementResult> measurement_result_;

  idl::parameters::ParameterSet parameters_;
  idl::parameters::WorkOffsets offsets_;
  idl::plc::Outputs plc_;
  idl::service::Alarm warning_;
  idl::service::ServiceState beat_;
  std::map<std::uint64_t, std::vector<std::uint8_t>> uploads_;  ///< by client
  std::uint64_t programs_revision_ = 0;
  double started_ = 0, last_motion_ = 0, last_beat_ = -1, path_ = 0;
  std::uint64_t cycle_ = 0;
};

}  // namespace trunnion::gateway
