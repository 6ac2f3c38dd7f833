// SPDX-License-Identifier: Apache-2.0
// Whether the touch probe makes contact, period by period.
#pragma once

#include <utility>

namespace trunnion::drive {

class ProbeWatch {
 public:
  /// One period: the contact was made in it, by a probe that is `on` and was in the period before. One that
  /// is switched on in contact has not made it now.
  bool made(bool contact, bool on) {
    const bool edge = !std::exchange(contact_, contact) && contact;
    const bool watched = std::exchange(watched_, on);
    return edge && watched && on;
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("probe_contact", self.contact_), visit("probe_watched", self.watched_);
  }

 private:
  bool contact_ = false, watched_ = false;  // in the period before
};

}  // namespace trunnion::drive
