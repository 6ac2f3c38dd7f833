// SPDX-License-Identifier: Apache-2.0
// The silence of other hosts' services as causes of alarms: a host that is silent as a whole is one cause,
// and one launcher reports it. No process, bus or clock.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "service_fault.hpp"

namespace trunnion::launcher {

/// A service on another host.
struct RemoteService {
  std::string host, name;
  std::uint32_t instance = 0;
  const ServiceFault* fault = nullptr;
};

class SilentHosts {
 public:
  /// s that a service must be silent alone: those of a host fall silent one after the other.
  static constexpr double alone_after = 0.5;

  /// `hosts` in the order of machine.yaml, `here` is this one.
  SilentHosts(std::vector<std::string> hosts, std::string here)
      : hosts_(std::move(hosts)), here_(std::move(here)) {}

  /// Adds what is wrong with `services`, all there are on other hosts, at `now` s. Nothing on a host that
  /// hears one before it in the list: that one's launcher reports.
  void add_causes(const std::vector<RemoteService>& services, double now, std::vector<AlarmCause>& causes);

 private:
  struct Silence {
    std::size_t services = 0, lost = 0;
    std::string names;  ///< of those without another replica
  };
  using Silences = std::map<std::string, Silence>;  // by host
  Silences look(const std::vector<RemoteService>& services, double now);
  bool reports(const Silences& silences) const;
  std::uint32_t instance_of(const std::string& host) const;

  std::vector<std::string> hosts_;
  std::string here_;
  std::set<std::string> silent_;           // as a whole, until all of their services are back
  std::map<std::uint32_t, double> since_;  // when a service that is lost was found so
};

}  // namespace trunnion::launcher
