// SPDX-License-Identifier: Apache-2.0
// Whether the drives are to be switched on.
#pragma once

#include <cstdint>
#include <type_traits>

#include "timeouts.hpp"

namespace trunnion::drive {

class DriveEnable {
 public:
  void demand(bool on) { demanded_ = on; }
  bool demanded() const { return demanded_; }
  /// The hardware has the drives off; until the alarms are reset.
  void lose() { lost_ = true; }
  bool lost() const { return lost_; }
  bool granted() const { return demanded_ && !lost_; }
  void acknowledge() {
    lost_ = false;
    off_periods_ = 0;
  }
  /// One period of `period` s in which the drives are off or not: true when they should have come on by now.
  bool is_late(bool off, double period) {
    off_periods_ = off && granted() ? off_periods_ + 1 : 0;
    return off_periods_ * period > drives_on_timeout;
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("enabled", self.demanded_), visit("control_lost", self.lost_);
    if (!std::is_const_v<Self> || self.off_periods_ != 0) visit("off_periods", self.off_periods_);
  }

 private:
  bool demanded_ = false, lost_ = false;
  std::uint32_t off_periods_ = 0;  // in which the drives did not come on although they are enabled
};

}  // namespace trunnion::drive
