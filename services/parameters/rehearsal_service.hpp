#pragma once

#include <optional>

#include "file_storage.hpp"
#include "node/comparison_clock.hpp"
#include "node/node.hpp"
#include "parameter_store.hpp"

namespace trunnion::parameters {

/// The keeper of parameters as long as another one is the cluster's: it reads the same files and compares
/// what it would publish with what the other has published. It writes nothing.
class RehearsalService : public node::Service {
 public:
  explicit RehearsalService(node::Node& node);
  void pump() override;
  node::Health health() const override { return clock_.health(); }

 private:
  std::string difference();

  node::Node& node_;
  FileStorage storage_;
  bus::Reader<idl::parameters::ParameterSet> set_reader_;
  bus::Reader<idl::parameters::ToolTable> tools_reader_;
  bus::Reader<idl::parameters::WorkOffsets> offsets_reader_;
  std::optional<idl::parameters::ParameterSet> set_;
  std::optional<idl::parameters::ToolTable> tools_;
  std::optional<idl::parameters::WorkOffsets> offsets_;
  node::ComparisonClock clock_;
};

}  // namespace trunnion::parameters
