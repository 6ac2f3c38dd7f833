// SPDX-License-Identifier: Apache-2.0
// The program service on standby, compared with the running one in a swap.
#pragma once

#include <optional>

#include "directory_files.hpp"
#include "service/comparison_clock.hpp"
#include "service/node.hpp"

namespace trunnion::program {

/// The program service while another one runs: it reads the same files and compares the list it would publish
/// with the published one. It writes nothing.
class StandbyService : public service::Service {
 public:
  explicit StandbyService(service::Node& node);
  void pump() override;
  service::Health health() const override { return clock_.health(); }

 private:
  std::string difference();

  service::Node& node_;
  DirectoryFiles programs_, state_;
  bus::Reader<idl::program::ProgramList> list_reader_;
  std::optional<idl::program::ProgramList> list_;
  service::ComparisonClock clock_;
};

}  // namespace trunnion::program
