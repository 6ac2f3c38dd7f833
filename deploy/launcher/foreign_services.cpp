// SPDX-License-Identifier: Apache-2.0
#include "foreign_services.hpp"

#include <algorithm>
#include <utility>

#include "bus/contract.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::launcher {

void ForeignServices::announced(const idl::service::Announcement& announcement, const bus::WriterId& writer) {
  const auto ours = bus::contract_of(announcement.service);
  if (announcement.contract == ours) {
    mismatches_.erase(announcement.instance);
    return;
  }
  mismatches_[announcement.instance] = {
      "Service " + announcement.service + " (" + announcement.version + ", process " +
          std::to_string(announcement.pid) + " on host " + announcement.host + ") was built with contract " +
          announcement.contract + " of its topics, this cluster with " + ours,
      writer};
}

void ForeignServices::heard(std::uint32_t instance, std::string text, double now) {
  others_[instance] = {std::move(text), now};
}

void ForeignServices::discovered(const std::vector<bus::DiscoveredWriter>& writers) {
  for (auto it = mismatches_.begin(); it != mismatches_.end();) {
    auto& mismatch = it->second;
    const bool there = std::any_of(writers.begin(), writers.end(),
                                   [&](const auto& writer) { return writer.id == mismatch.writer; });
    const bool left = mismatch.seen && !there;
    mismatch.seen = mismatch.seen || there;
    it = left ? mismatches_.erase(it) : std::next(it);
  }
}

void ForeignServices::add_causes(double now, std::vector<AlarmCause>& causes) {
  std::erase_if(others_, [&](const auto& entry) { return now - entry.second.at > silence; });
  for (const auto& [instance, mismatch] : mismatches_)
    causes.push_back({&alarm::contract_mismatch, instance, mismatch.text});
  for (const auto& [instance, other] : others_)
    causes.push_back({&alarm::machine_differs, instance, other.text});
}

}  // namespace trunnion::launcher
