// SPDX-License-Identifier: Apache-2.0
// Which alarms there were, and how long: kept over restarts as lines of a file.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "contracts/types.hpp"

namespace trunnion::gateway {

struct PastAlarm {
  std::uint64_t id = 0;  ///< counts the alarms of the file
  idl::service::Alarm alarm;
  std::string raised, cleared;  ///< ISO 8601; cleared is empty while the alarm is active
};

/// Newest first.
using PastAlarms = std::vector<PastAlarm>;

class AlarmHistory {
 public:
  /// Alarms that are kept, in memory and when the file is rewritten.
  static constexpr std::size_t most = 2000;

  /// The lines of the file as lines() and take_lines() have written them. Others are left out; how many.
  std::size_t restore(const std::string& lines);
  void apply(const idl::service::Alarm& alarm, const std::string& time);
  /// Clears what is active here and not in the cluster, as the alarms of a process that has ended.
  void keep(const std::function<bool(const idl::service::Alarm&)>& is_active, const std::string& time);
  /// Clears what was active when the history was restored and has not been heard of since.
  void settle(const std::string& time);

  /// What is new for the end of the file.
  std::string take_lines();
  /// The whole file.
  std::string lines() const;
  /// The same object until something changes.
  std::shared_ptr<const PastAlarms> newest() const;

 private:
  void clear(PastAlarm& past, const std::string& time);
  void changed(const PastAlarm& past);
  PastAlarm* active(const idl::service::Alarm& alarm);

  std::deque<PastAlarm> alarms_;  ///< from the oldest on
  std::vector<std::uint64_t> restored_;
  std::uint64_t next_ = 1;
  std::string lines_;
  mutable std::shared_ptr<const PastAlarms> newest_;
};

/// A row of AlarmHistory in openapi.json.
bus::Json past_alarm_document(const PastAlarm& past);
/// Whether number, text or source of the alarm have `search` in them, whatever the case; empty: always.
bool matches(const PastAlarm& past, const std::string& search);

}  // namespace trunnion::gateway
