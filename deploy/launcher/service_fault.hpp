// SPDX-License-Identifier: Apache-2.0
// What is wrong with the processes of a cluster, as causes of alarms: an alarm ends with its cause. No
// process, bus or clock.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "machine/alarm_definition.hpp"

namespace trunnion::launcher {

/// Something that is wrong now. `part` is the instance of a service, or 0.
struct AlarmCause {
  const machine::AlarmDefinition* alarm = nullptr;
  std::uint32_t part = 0;
  std::string text;
};

/// What the loss of a process does.
enum class Loss : std::uint8_t {
  holds,      ///< the channels
  redundant,  ///< nothing: another replica of its stage runs
  shown,      ///< a warning: the machine runs on without it
};

/// Of the process that has a place in the cluster. A process that takes the place over begins with none.
class ServiceFault {
 public:
  /// It has ended or is silent.
  void lose(std::string text, Loss loss);
  /// It is not started again soon.
  void give_up(std::string text) { gave_up_ = std::move(text); }
  /// It is active again.
  void active();
  /// It takes part as a replica again.
  void in_step();
  bool lost() const { return !lost_.empty(); }
  /// Its loss, if it is lost, holds the channels.
  bool holds() const { return loss_ == Loss::holds; }

  /// Adds what is wrong with it.
  void add_causes(std::uint32_t instance, std::vector<AlarmCause>& causes) const;

 private:
  std::string lost_, gave_up_;
  std::string redundancy_;  ///< stays until it is in step
  Loss loss_ = Loss::holds;
};

/// Which alarms a change of the causes raises and which it ends.
class AlarmCauses {
 public:
  struct Ended {
    const machine::AlarmDefinition* alarm = nullptr;
    std::uint32_t part = 0;
  };
  /// Takes all causes there are now; returns the alarms whose cause is gone since the last call.
  std::vector<Ended> update(const std::vector<AlarmCause>& causes);

 private:
  std::set<std::pair<const machine::AlarmDefinition*, std::uint32_t>> present_;
};

}  // namespace trunnion::launcher
