// SPDX-License-Identifier: Apache-2.0
// The alarms of the services, and their end with the process that has raised them: it cannot end them itself,
// and no reset could.
#pragma once

#include <array>
#include <map>

#include "bus/bus.hpp"
#include "contracts/types.hpp"

namespace trunnion::launcher {

class AlarmsOfServices {
 public:
  explicit AlarmsOfServices(bus::Bus& bus);

  /// Takes what has come.
  void read();
  /// The process of this instance has ended.
  void end(std::uint32_t instance);

 private:
  bus::Reader<idl::service::Alarm> reader_;
  bus::Writer<idl::service::Alarm> writer_;
  std::map<std::array<std::uint32_t, 3>, idl::service::Alarm> active_;
};

}  // namespace trunnion::launcher
