// SPDX-License-Identifier: Apache-2.0
#include "alarms_of_services.hpp"

#include "contracts/topics.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::launcher {

AlarmsOfServices::AlarmsOfServices(bus::Bus& bus)
    : reader_(bus.reader(topics::alarm)), writer_(bus.writer(topics::alarm)) {}

void AlarmsOfServices::read() {
  idl::service::Alarm alarm;
  while (reader_.take(alarm)) {
    const Key key{alarm.instance, alarm.number, alarm.part};
    if (alarm.active) {
      active_[key] = alarm;
      if (alarm.number == alarm::recording_ended.number && adopted_.insert(key).second) writer_.write(alarm);
    } else {
      active_.erase(key);
      if (adopted_.erase(key) != 0) writer_.write(alarm);
    }
  }
}

void AlarmsOfServices::end(std::uint32_t instance) {
  end_of([&](const auto& alarm) { return alarm.instance == instance; });
}

void AlarmsOfServices::end_of_recorders() {
  end_of([](const auto& alarm) { return alarm.source == "recorder"; });
}

void AlarmsOfServices::end_of(const std::function<bool(const idl::service::Alarm&)>& chosen) {
  read();
  for (auto entry = active_.begin(); entry != active_.end();) {
    auto& [key, alarm] = *entry;
    if (!chosen(alarm)) {
      ++entry;
      continue;
    }
    alarm.active = false;
    writer_.write(alarm);
    adopted_.erase(key);
    entry = active_.erase(entry);
  }
}

}  // namespace trunnion::launcher
