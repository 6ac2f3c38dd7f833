// SPDX-License-Identifier: Apache-2.0
// The process that keeps parameters, tools and work offsets on disk, publishes and changes them.
#pragma once

#include "parameter_store/file_storage.hpp"
#include "parameter_store/machine_defaults.hpp"
#include "parameter_store/parameter_store.hpp"
#include "service/node.hpp"
#include "service/request.hpp"
#include "standby_service.hpp"

namespace trunnion::parameters {

class ParameterService : public service::Service {
 public:
  /// What it does while it is on standby.
  using Standby = StandbyService;

  explicit ParameterService(service::Node& node);
  void pump() override;
  service::Health health() const override;
  service::SnapshotAnswer snapshot() override;

 private:
  void publish();
  void report_damage();
  void report_misfit();

  service::Node& node_;
  FileStorage storage_;
  ParameterStore store_;
  bus::Writer<idl::parameters::ParameterSet> set_;
  bus::Writer<idl::parameters::ToolTable> tools_;
  bus::Writer<idl::parameters::WorkOffsets> offsets_;
  bus::Reader<idl::channel::ChannelState> channels_;
  service::RequestServer<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> requests_;
};

}  // namespace trunnion::parameters
