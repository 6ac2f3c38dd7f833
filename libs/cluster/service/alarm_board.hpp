// SPDX-License-Identifier: Apache-2.0
// The alarms one service has raised: latched, published when they change, cleared on request once their cause
// is gone.
#pragma once

#include <functional>
#include <map>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "machine/alarm_definition.hpp"

namespace trunnion::service {

class AlarmBoard {
 public:
  AlarmBoard(bus::Bus& bus, std::uint32_t instance, std::string service);

  /// Raises (or repeats) an alarm of machine/alarm_constants.hpp about `part` (axis, channel, instance).
  void raise(const machine::AlarmDefinition& alarm, std::uint32_t part, const std::string& text,
             std::uint64_t cycle = 0);
  /// Raises an alarm whose cause is over at once: news also when the same one is still shown.
  void report(const machine::AlarmDefinition& alarm, std::uint32_t part, const std::string& text,
              std::uint64_t cycle = 0);
  /// The cause is gone; the alarm stays until it is reset.
  void release(const machine::AlarmDefinition& alarm, std::uint32_t part);
  /// Inactive at once, for causes that the operator need not acknowledge.
  void clear(const machine::AlarmDefinition& alarm, std::uint32_t part);
  /// Clears every alarm whose cause is gone.
  void reset();
  /// The same, but only those for which `concerned(subject, part)` holds.
  void reset(const std::function<bool(machine::Subject, std::uint32_t)>& concerned);
  /// Alarms are not published until unmute(): what a process on standby finds wrong is not the machine's.
  void mute() { muted_ = true; }
  void unmute();
  bool active(const machine::AlarmDefinition& alarm, std::uint32_t part) const;
  bool any() const;

 private:
  struct Entry {
    idl::service::Alarm alarm;
    machine::Subject subject = machine::Subject::channel;
    bool cause = true;
  };
  void publish(Entry& entry);
  bool muted_ = false;
  std::uint32_t instance_;
  std::string service_;
  bus::Writer<idl::service::Alarm> writer_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Entry> entries_;
};

}  // namespace trunnion::service
