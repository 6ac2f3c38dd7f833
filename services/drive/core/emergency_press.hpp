// SPDX-License-Identifier: Apache-2.0
// A press of the emergency stop that the drive holds until the PLC has taken it: a PLC that hangs, or is
// replaced before it has read the press, does not lose it.
#pragma once

#include <algorithm>

#include "contracts/types.hpp"

namespace trunnion::drive {

class EmergencyPress {
 public:
  /// What `outputs`, the newest of the PLC, name as taken is not held.
  void press(const idl::plc::Press& press, const idl::plc::Outputs& outputs) {
    held_ = press;
    release(outputs);
  }
  void release(const idl::plc::Outputs& outputs) {
    if (std::find(outputs.presses.begin(), outputs.presses.end(), held_) != outputs.presses.end()) held_ = {};
  }
  bool held() const { return held_.number != 0; }
  /// With the number 0 when none is held.
  const idl::plc::Press& which() const { return held_; }

  /// For libs/cluster/snapshot.
  /// No field, both of its members are fields: held_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("client", self.held_.client), visit("number", self.held_.number);
  }

 private:
  idl::plc::Press held_{};
};

}  // namespace trunnion::drive
