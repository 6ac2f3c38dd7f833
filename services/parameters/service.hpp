#pragma once

#include "file_storage.hpp"
#include "node/node.hpp"
#include "node/request.hpp"
#include "parameter_store.hpp"
#include "rehearsal_service.hpp"

namespace trunnion::parameters {

/// Parameters, tools and offsets as the machine's directory has them. Throws std::runtime_error with
/// file:line:column.
MachineDefaults defaults_of(const machine::MachineConfig& machine);

class ParameterService : public node::Service {
 public:
  /// What it does while it is a shadow.
  using Rehearsal = RehearsalService;

  explicit ParameterService(node::Node& node);
  void pump() override;
  node::Health health() const override;

 private:
  void publish();

  node::Node& node_;
  FileStorage storage_;
  ParameterStore store_;
  bus::Writer<idl::parameters::ParameterSet> set_;
  bus::Writer<idl::parameters::ToolTable> tools_;
  bus::Writer<idl::parameters::WorkOffsets> offsets_;
  bus::Reader<idl::channel::ChannelState> channels_;
  node::RequestServer<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> requests_;
};

}  // namespace trunnion::parameters
