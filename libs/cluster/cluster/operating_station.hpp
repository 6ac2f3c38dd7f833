// SPDX-License-Identifier: Apache-2.0
// The right to operate, held by a command for as long as it runs.
#pragma once

#include <cstdint>
#include <string>

namespace trunnion::cluster {

/// Where the gateway of a cluster whose machine one station operates listens for commands.
std::string operating_socket(std::uint32_t domain);

inline constexpr const char* take_right_help =
    "Take the right to operate from another station (operating_right in machine.yaml)";

class OperatingStation {
 public:
  /// Takes the right when it is free, with `take_over` also from another station. Does nothing when every
  /// station of the cluster in `domain` operates, or it has no gateway here. Throws std::runtime_error with
  /// the name of who operates.
  OperatingStation(std::uint32_t domain, bool take_over);
  ~OperatingStation();
  OperatingStation(const OperatingStation&) = delete;
  OperatingStation& operator=(const OperatingStation&) = delete;

 private:
  int socket_ = -1;  ///< the right is held while it is open
};

}  // namespace trunnion::cluster
