// SPDX-License-Identifier: Apache-2.0
// The alarms of the services, and their end with the process that has raised them: it cannot end them itself,
// and no reset could.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>

#include "bus/bus.hpp"
#include "contracts/types.hpp"

namespace trunnion::launcher {

class AlarmsOfServices {
 public:
  explicit AlarmsOfServices(bus::Bus& bus);

  /// Takes what has come. The end of a recording is written again: its recorder is gone before anybody looks.
  void read();
  /// The process of this instance has ended.
  void end(std::uint32_t instance);
  /// A reset: ends the alarms of recorders. One that still runs repeats what holds.
  void end_of_recorders();

 private:
  void end_of(const std::function<bool(const idl::service::Alarm&)>& chosen);
  bus::Reader<idl::service::Alarm> reader_;
  bus::Writer<idl::service::Alarm> writer_;
  using Key = std::array<std::uint32_t, 3>;
  std::map<Key, idl::service::Alarm> active_;
  std::set<Key> adopted_;  // of those, written again
};

}  // namespace trunnion::launcher
