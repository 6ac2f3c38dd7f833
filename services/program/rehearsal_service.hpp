#pragma once

#include <optional>

#include "directory_files.hpp"
#include "node/comparison_clock.hpp"
#include "node/node.hpp"

namespace trunnion::program {

/// The keeper of programs as long as another one is the cluster's: it scans the same files and compares the
/// list it would publish with the one the other has published. It writes nothing.
class RehearsalService : public node::Service {
 public:
  explicit RehearsalService(node::Node& node);
  void pump() override;
  node::Health health() const override { return clock_.health(); }

 private:
  std::string difference();

  node::Node& node_;
  DirectoryFiles programs_, state_;
  bus::Reader<idl::program::ProgramList> list_reader_;
  std::optional<idl::program::ProgramList> list_;
  node::ComparisonClock clock_;
};

}  // namespace trunnion::program
