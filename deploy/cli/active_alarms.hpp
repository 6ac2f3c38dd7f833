// SPDX-License-Identifier: Apache-2.0
// The alarms that the services of a cluster show.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "cluster/client.hpp"

namespace trunnion::cli {

struct ActiveAlarm {
  idl::service::Alarm alarm;
  std::string raised;  // ISO 8601 in UTC
};

class ActiveAlarms {
 public:
  /// By source, number and part.
  using List = std::map<std::array<std::uint32_t, 3>, ActiveAlarm>;

  explicit ActiveAlarms(cluster::Client& client);
  /// Returns when every service that runs has had the time to send its alarms.
  void wait_for_all();
  /// Those of now.
  const List& take();

 private:
  cluster::Client& client_;
  bus::Reader<idl::service::Alarm> reader_;
  List list_;
};

}  // namespace trunnion::cli
