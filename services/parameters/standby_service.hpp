// SPDX-License-Identifier: Apache-2.0
// The parameter service on standby, compared with the running one in a swap.
#pragma once

#include <optional>

#include "parameter_store/file_storage.hpp"
#include "parameter_store/parameter_store.hpp"
#include "service/comparison_clock.hpp"
#include "service/node.hpp"

namespace trunnion::parameters {

/// The keeper of parameters as long as another one is the cluster's: it reads the same files and compares
/// what it would publish with what the other has published. It writes nothing.
class StandbyService : public service::Service {
 public:
  explicit StandbyService(service::Node& node);
  void pump() override;
  service::Health health() const override { return clock_.health(); }

 private:
  std::string difference();

  service::Node& node_;
  FileStorage storage_;
  bus::Reader<idl::parameters::ParameterSet> set_reader_;
  bus::Reader<idl::parameters::ToolTable> tools_reader_;
  bus::Reader<idl::parameters::WorkOffsets> offsets_reader_;
  std::optional<idl::parameters::ParameterSet> set_;
  std::optional<idl::parameters::ToolTable> tools_;
  std::optional<idl::parameters::WorkOffsets> offsets_;
  service::ComparisonClock clock_;
};

}  // namespace trunnion::parameters
