// SPDX-License-Identifier: Apache-2.0
// The silence of other hosts' services as causes of alarms: a host that is silent as a whole is one cause,
// and one launcher reports it. No process, bus or clock.
#pragma once

#include <map>
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
  /// s that a silence must last until it is reported: the services of a host, and hosts behind one cable,
  /// fall silent one after the other.
  static constexpr double settles_in = 0.5;

  /// `hosts` in the order of machine.yaml, `here` is this one.
  SilentHosts(std::vector<std::string> hosts, std::string here)
      : hosts_(std::move(hosts)), here_(std::move(here)) {}

  /// Adds what is wrong with `services`, all there are on other hosts, at `now` s. Nothing on a host that
  /// hears one before it in the list: that one's launcher reports.
  void add_causes(const std::vector<RemoteService>& services, double now, std::vector<AlarmCause>& causes);

 private:
  struct Host {
    std::size_t services = 0, lost = 0;
    std::string names;  ///< of those that are lost and whose loss holds the channels
  };
  struct Silence {
    double since = 0;
    std::string names;
  };
  using Hosts = std::map<std::string, Host>;
  Hosts look(const std::vector<RemoteService>& services, double now);
  void follow(const Hosts& hosts, double now);
  bool reports(const Hosts& hosts) const;
  void add_hosts(double now, std::vector<AlarmCause>& causes) const;
  std::uint32_t instance_of(const std::string& host) const;

  std::vector<std::string> hosts_;
  std::string here_;
  std::map<std::string, Silence> silent_;  // as a whole, until all of their services are back
  bool alone_ = false;                     // there was no other, until there are all
  std::map<std::uint32_t, double> since_;  // when a service that is lost was found so
};

}  // namespace trunnion::launcher
