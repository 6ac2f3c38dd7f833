// SPDX-License-Identifier: Apache-2.0
#include "active_alarms.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "text/instant.hpp"

namespace trunnion::cli {

ActiveAlarms::ActiveAlarms(cluster::Client& client)
    : client_(client), reader_(client.bus().reader(topics::alarm)) {}

void ActiveAlarms::wait_for_all() {
  const double began = service::monotonic_seconds();
  client_.wait_for_all_services([&] { return reader_.matched(); });
  // What was written before follows its writer; on a computer that takes long for those, it takes longer too.
  const double found = service::monotonic_seconds();
  const double until = found + std::max(0.25, 2 * (found - began));
  while (service::monotonic_seconds() < until) {
    take();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

const ActiveAlarms::List& ActiveAlarms::take() {
  for (idl::service::Alarm alarm; reader_.take(alarm);) {
    const std::array<std::uint32_t, 3> key{alarm.instance, alarm.number, alarm.part};
    if (alarm.active)
      list_[key] = {alarm, text::instant(static_cast<std::uint64_t>(reader_.info().source_timestamp))};
    else
      list_.erase(key);
  }
  return list_;
}

}  // namespace trunnion::cli
