// SPDX-License-Identifier: Apache-2.0
// The motion of stored programs, planned on a thread of its own, so that it delays neither an order nor a
// check.
#pragma once

#include <atomic>
#include <map>

#include "answer.hpp"
#include "cluster_side/mailbox.hpp"
#include "core/worker.hpp"

namespace trunnion::gateway {

class StoredTexts;

class ProgramPlanner {
 public:
  /// Seconds after which planning ends without the rest.
  static constexpr double longest = 20;
  /// Programs that may wait.
  static constexpr std::size_t most_waiting = 4;

  struct Job {
    std::string program;
    std::uint16_t channel = 0;
    std::shared_ptr<const ClusterState> cluster;
    Respond respond;
  };

  explicit ProgramPlanner(Mailbox& mailbox) : mailbox_(mailbox) {}
  ~ProgramPlanner() { stop(); }
  /// Answers later; at once with 503 when too many wait.
  void submit(const Job& job);
  /// Drops what waits and ends what is under way.
  void stop();

 private:
  Answer run(const Job& job);
  Answer plan(const Job& job, StoredTexts& texts);

  /// The newest plan of each channel, with what it depends on. Of the thread.
  struct Kept {
    std::string of, document;
  };
  Mailbox& mailbox_;
  std::atomic<bool> stopping_ = false;
  std::map<std::uint16_t, Kept> kept_;
  Worker worker_{"gateway-plans", most_waiting};
};

}  // namespace trunnion::gateway
