// SPDX-License-Identifier: Apache-2.0
// Checks of program texts on a thread of its own, so that none delays an order.
#pragma once

#include <atomic>
#include <string>
#include <utility>

#include "answer.hpp"
#include "cluster_side/mailbox.hpp"
#include "core/worker.hpp"

namespace trunnion::gateway {

class ProgramChecker {
 public:
  /// Seconds after which a check ends without a result of the rest.
  static constexpr double longest = 2;
  /// Checks that may wait.
  static constexpr std::size_t most_waiting = 4;

  struct Job {
    std::string text;
    std::string name;  ///< under which it is or will be stored; empty: under none
    std::uint16_t channel = 0;
    std::shared_ptr<const ClusterState> cluster;
    Respond respond;
  };

  /// Bodies of the machine count as machine.yaml in `machine_directory` demands.
  ProgramChecker(Mailbox& mailbox, std::string machine_directory)
      : mailbox_(mailbox), machine_directory_(std::move(machine_directory)) {}
  ~ProgramChecker() { stop(); }
  /// Answers later; at once with 503 when too many wait.
  void submit(const Job& job);
  /// Drops what waits and ends what is under way.
  void stop();

 private:
  Answer run(const Job& job);

  Mailbox& mailbox_;
  const std::string machine_directory_;
  std::atomic<bool> stopping_ = false;
  Worker worker_{"gateway-checks", most_waiting};
};

}  // namespace trunnion::gateway
