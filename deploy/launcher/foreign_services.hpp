// SPDX-License-Identifier: Apache-2.0
// Services in the domain that cannot take part: of another contract, or of another machine.yaml.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bus/endpoint.hpp"
#include "contracts/types.hpp"
#include "service_fault.hpp"

namespace trunnion::launcher {

class ForeignServices {
 public:
  static constexpr double silence = 3;  ///< s without a heartbeat after which a service is gone

  /// `writer` is the announcement's. One of the right contract ends what was said of its instance before.
  void announced(const idl::service::Announcement& announcement, const bus::WriterId& writer);
  /// A heartbeat with an instance that is another service's here; `text` says so.
  void heard(std::uint32_t instance, std::string text, double now);
  /// What announced itself with another contract stays until its writer has left.
  void discovered(const std::vector<bus::DiscoveredWriter>& writers);
  void add_causes(double now, std::vector<AlarmCause>& causes);

 private:
  struct Mismatch {
    std::string text;
    bus::WriterId writer{};
    bool seen = false;  ///< by the discovery
  };
  struct Other {
    std::string text;
    double at = 0;
  };
  std::map<std::uint32_t, Mismatch> mismatches_;
  std::map<std::uint32_t, Other> others_;
};

}  // namespace trunnion::launcher
