// SPDX-License-Identifier: Apache-2.0
// The alarms of a recorder. That of its end outlasts its process; the launcher ends it with a reset.
#pragma once

#include <string>

#include "service/alarm_board.hpp"
#include "space_watch.hpp"

namespace trunnion::recorder {

class RecordingAlarms {
 public:
  explicit RecordingAlarms(bus::Bus& bus);

  void tell(const SpaceWatch::Finding& finding);
  /// The recorder ends: with `problem` when the recording could not be continued, else empty. Returns when
  /// readers had time to take what it wrote.
  void finish(const std::string& problem);

 private:
  service::AlarmBoard alarms_;
};

}  // namespace trunnion::recorder
