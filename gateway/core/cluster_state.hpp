// SPDX-License-Identifier: Apache-2.0
// What the HTTP side knows of the cluster: made by the thread of the bus, never changed afterwards.
#pragma once

#include <memory>
#include <set>

#include "bus/json.hpp"
#include "contracts/types.hpp"
#include "core/alarm_history.hpp"
#include "machine/parameters.hpp"

namespace trunnion::gateway {

struct ClusterState {
  std::uint64_t sequence = 0;
  std::uint64_t replies = 0;  ///< sequence from which on what follows from the replies is shown
  bus::Json document = bus::Json::object();  ///< of StateDocument
  std::map<std::uint16_t, idl::channel::ChannelState> channels;
  std::shared_ptr<const idl::parameters::ParameterSet> parameters;
  std::shared_ptr<const machine::Parameters> values;  ///< of `parameters`: set together
  std::string parameters_tag;                         ///< their ETag
  std::shared_ptr<const idl::parameters::ToolTable> tools;
  std::shared_ptr<const idl::parameters::WorkOffsets> offsets;
  std::shared_ptr<const idl::program::ProgramList> programs;
  std::shared_ptr<const PastAlarms> past_alarms;
  std::shared_ptr<const idl::plc::Image> image;
  std::map<std::uint16_t, std::shared_ptr<const idl::channel::Variables>> variables;  ///< by channel
  std::shared_ptr<const idl::plc::Forces> plc_forces;
  std::shared_ptr<const idl::plc::Programs> plc_programs;
  std::shared_ptr<const idl::measurement::MeasurementState> measurement;
  std::shared_ptr<const idl::measurement::MeasurementResult> measurement_result;
  std::map<std::uint8_t, std::shared_ptr<const idl::plc::Watched>> plc_watched;  ///< by slot

  void set_parameters(std::shared_ptr<const idl::parameters::ParameterSet> set);
};

/// Answers of the GET operations, as the OpenAPI document describes them. Null when the service has not
/// published yet.
bus::Json status_answer(const ClusterState& cluster, const std::string& contract);
bus::Json alarms_answer(const ClusterState& cluster);
/// Newest first; those that have `search` in them.
bus::Json past_alarms_answer(const ClusterState& cluster, const std::string& search);
bus::Json channels_answer(const ClusterState& cluster);
bus::Json channel_answer(const ClusterState& cluster, std::uint16_t channel);

/// Which parameters are wanted.
struct ParameterQuery {
  std::string group;   ///< nc, user, channel, axis, compensation, table; empty = all
  std::string search;  ///< part of the number, name or help, whatever the case; empty = all
  std::size_t offset = 0, limit = 500;
};

/// Parameters of the channels and axes the machine has, ascending by number.
bus::Json parameters_answer(const ClusterState& cluster, const ParameterQuery& query);
/// Null when the catalogue has no such number.
bus::Json parameter_answer(const ClusterState& cluster, std::uint32_t number);

}  // namespace trunnion::gateway
