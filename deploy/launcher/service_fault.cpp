// SPDX-License-Identifier: Apache-2.0
#include "service_fault.hpp"

#include "machine/alarm_constants.hpp"

namespace trunnion::launcher {

void ServiceFault::lose(std::string text, Loss loss) {
  loss_ = loss;
  if (loss == Loss::redundant) redundancy_ = text;
  lost_ = std::move(text);
}

void ServiceFault::active() {
  lost_.clear();
  gave_up_.clear();
}

void ServiceFault::in_step() {
  if (!lost()) redundancy_.clear();
}

void ServiceFault::add_causes(std::uint32_t instance, std::vector<AlarmCause>& causes) const {
  if (lost() && loss_ == Loss::shown) {
    causes.push_back({&alarm::page_lost, instance, gave_up_.empty() ? lost_ : gave_up_});
    return;
  }
  if (lost() && loss_ == Loss::holds) causes.push_back({&alarm::service_lost, instance, lost_});
  if (!redundancy_.empty()) causes.push_back({&alarm::redundancy_lost, instance, redundancy_});
  if (!gave_up_.empty()) causes.push_back({&alarm::service_not_staying, instance, gave_up_});
}

std::vector<AlarmCauses::Ended> AlarmCauses::update(const std::vector<AlarmCause>& causes) {
  std::set<std::pair<const machine::AlarmDefinition*, std::uint32_t>> now;
  for (const auto& cause : causes) now.insert({cause.alarm, cause.part});
  std::vector<Ended> ended;
  for (const auto& [alarm, part] : present_)
    if (!now.contains({alarm, part})) ended.push_back({alarm, part});
  present_ = std::move(now);
  return ended;
}

}  // namespace trunnion::launcher
