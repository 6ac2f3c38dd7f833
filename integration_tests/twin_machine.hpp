// SPDX-License-Identifier: Apache-2.0
// Machines whose stages have two replicas.
#pragma once

#include <vector>

#include "machine_copy.hpp"

namespace trunnion::integration {

/// A copy of the machine ac-table in which each stage of `stages` has two replicas, the second one on
/// `second`.
class TwinMachine : public MachineCopy {
 public:
  explicit TwinMachine(const std::vector<std::string>& stages, const std::string& second = "fastdds")
      : MachineCopy("ac-table") {
    for (const auto& stage : stages)
      replace("machine.yaml", "{service: " + stage + "}",
              "{service: " + stage + ", replicas: 2, vendor: [cyclonedds, " + second + "]}");
  }
};

}  // namespace trunnion::integration
