// SPDX-License-Identifier: Apache-2.0
#include "silent_hosts.hpp"

#include <algorithm>

#include "cluster/instances.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::launcher {

SilentHosts::Hosts SilentHosts::look(const std::vector<RemoteService>& services, double now) {
  Hosts hosts;
  for (const auto& service : services) {
    auto& host = hosts[service.host];
    ++host.services;
    if (!service.fault->lost()) {
      since_.erase(service.instance);
      continue;
    }
    ++host.lost;
    since_.try_emplace(service.instance, now);
    if (service.fault->holds()) host.names += (host.names.empty() ? "" : ", ") + service.name;
  }
  return hosts;
}

// What is said of a silence stays as it began while the services come back one after the other.
void SilentHosts::follow(const Hosts& hosts, double now) {
  for (const auto& [name, host] : hosts) {
    if (host.lost == host.services) silent_.try_emplace(name, Silence{now, host.names});
    if (host.lost == 0) silent_.erase(name);
  }
  // It is this one's cable that is cut, rather than those of all others.
  if (hosts.size() > 1 && silent_.size() == hosts.size()) alone_ = true;
  if (silent_.empty()) alone_ = false;
}

// Of a host without services nothing can be heard.
bool SilentHosts::reports(const Hosts& hosts) const {
  return alone_ || *std::find_if(hosts_.begin(), hosts_.end(), [&](const std::string& host) {
           return host == here_ || (hosts.contains(host) && !silent_.contains(host));
         }) == here_;
}

std::uint32_t SilentHosts::instance_of(const std::string& host) const {
  return cluster::launcher_instance +
         static_cast<std::uint32_t>(std::find(hosts_.begin(), hosts_.end(), host) - hosts_.begin());
}

void SilentHosts::add_hosts(double now, std::vector<AlarmCause>& causes) const {
  if (alone_) {
    causes.push_back({&alarm::service_lost, instance_of(here_),
                      "Host " + here_ + " hears no other host: check its network"});
    return;
  }
  for (const auto& [name, silence] : silent_)
    if (!silence.names.empty() && now - silence.since >= settles_in)
      causes.push_back({&alarm::service_lost, instance_of(name),
                        "Host " + name + " is silent, and with it " + silence.names +
                            ": check its network and whether it runs"});
}

void SilentHosts::add_causes(const std::vector<RemoteService>& services, double now,
                             std::vector<AlarmCause>& causes) {
  if (services.empty()) return;
  const auto hosts = look(services, now);
  follow(hosts, now);
  if (!reports(hosts)) return;
  add_hosts(now, causes);
  for (const auto& service : services) {
    if (service.fault->holds() && (silent_.contains(service.host) ||
                                   (service.fault->lost() && now - since_.at(service.instance) < settles_in)))
      continue;
    service.fault->add_causes(service.instance, causes);
  }
}

}  // namespace trunnion::launcher
