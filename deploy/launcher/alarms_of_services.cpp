// SPDX-License-Identifier: Apache-2.0
#include "alarms_of_services.hpp"

#include "contracts/topics.hpp"

namespace trunnion::launcher {

AlarmsOfServices::AlarmsOfServices(bus::Bus& bus)
    : reader_(bus.reader(topics::alarm)), writer_(bus.writer(topics::alarm)) {}

void AlarmsOfServices::read() {
  idl::service::Alarm alarm;
  while (reader_.take(alarm)) {
    const std::array key{alarm.instance, alarm.number, alarm.part};
    if (alarm.active)
      active_[key] = alarm;
    else
      active_.erase(key);
  }
}

void AlarmsOfServices::end(std::uint32_t instance) {
  read();
  for (auto entry = active_.begin(); entry != active_.end();) {
    auto& alarm = entry->second;
    if (alarm.instance != instance) {
      ++entry;
      continue;
    }
    alarm.active = false;
    writer_.write(alarm);
    entry = active_.erase(entry);
  }
}

}  // namespace trunnion::launcher
