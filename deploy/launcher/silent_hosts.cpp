// SPDX-License-Identifier: Apache-2.0
#include "silent_hosts.hpp"

#include <algorithm>

#include "cluster/instances.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::launcher {

SilentHosts::Silences SilentHosts::look(const std::vector<RemoteService>& services, double now) {
  Silences silences;
  for (const auto& service : services) {
    auto& host = silences[service.host];
    ++host.services;
    if (!service.fault->lost()) {
      since_.erase(service.instance);
      continue;
    }
    ++host.lost;
    since_.try_emplace(service.instance, now);
    if (service.fault->holds()) host.names += (host.names.empty() ? "" : ", ") + service.name;
  }
  for (const auto& [name, host] : silences) {
    if (host.lost == host.services) silent_.insert(name);
    if (host.lost == 0) silent_.erase(name);
  }
  return silences;
}

// Of a host without services nothing can be heard.
bool SilentHosts::reports(const Silences& silences) const {
  return *std::find_if(hosts_.begin(), hosts_.end(), [&](const std::string& host) {
    return host == here_ || (silences.contains(host) && !silent_.contains(host));
  }) == here_;
}

std::uint32_t SilentHosts::instance_of(const std::string& host) const {
  return cluster::launcher_instance +
         static_cast<std::uint32_t>(std::find(hosts_.begin(), hosts_.end(), host) - hosts_.begin());
}

void SilentHosts::add_causes(const std::vector<RemoteService>& services, double now,
                             std::vector<AlarmCause>& causes) {
  if (services.empty()) return;
  const auto silences = look(services, now);
  if (!reports(silences)) return;
  // It is this one's cable that is cut, rather than those of all others.
  const bool alone = silences.size() > 1 && silent_.size() == silences.size();
  std::string others;
  for (const auto& [name, host] : silences) {
    if (!silent_.contains(name) || host.names.empty()) continue;
    others += (others.empty() ? "" : "; ") + name + " with " + host.names;
    if (!alone)
      causes.push_back({&alarm::service_lost, instance_of(name),
                        "Host " + name + " is silent, and with it " + host.names +
                            ": check its network and whether it runs"});
  }
  if (alone && !others.empty())
    causes.push_back({&alarm::service_lost, instance_of(here_),
                      "Host " + here_ + " hears no other host: check its network (" + others + ")"});
  for (const auto& service : services) {
    if (service.fault->holds() &&
        (silent_.contains(service.host) ||
         (service.fault->lost() && now - since_.at(service.instance) < alone_after)))
      continue;
    service.fault->add_causes(service.instance, causes);
  }
}

}  // namespace trunnion::launcher
