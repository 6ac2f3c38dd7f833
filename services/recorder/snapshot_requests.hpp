// SPDX-License-Identifier: Apache-2.0
// Asks the services for the states from which a recording can be verified.
#pragma once

#include <map>
#include <set>
#include <string>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"

namespace trunnion::recorder {

class SnapshotRequests {
 public:
  explicit SnapshotRequests(bus::Bus& bus);

  /// Everything from now on is in the recording: asks every service.
  void ask();
  /// The same request once more: a reader that was not known yet has not had it.
  void repeat();
  /// Asks at `when`, seconds of the caller's clock, unless it is going to earlier.
  void ask_at(double when);
  /// Call several times a second: asks when it is time, and a while after another process has come, whose
  /// state the recording does not have.
  void run(double now);
  /// All of `instances` have answered the newest request.
  bool answered_by(const std::set<std::uint32_t>& instances);
  /// Who answered the newest request and reads `topic` has taken the message of source time `newest`. Until
  /// then its state lacks a message that is not in the recording either.
  bool has_taken(const std::string& topic, std::int64_t newest) const;

 private:
  bus::Writer<idl::service::SnapshotRequest> requests_;
  bus::Reader<idl::service::ServiceSnapshot> snapshots_;
  bus::Reader<idl::service::Announcement> announcements_;
  idl::service::SnapshotRequest request_;
  idl::service::ServiceSnapshot snapshot_;
  idl::service::Announcement announcement_;
  std::uint64_t asked_ = 0;  // source time of the newest request
  double next_ = 0;          // 0: none is planned
  std::set<std::uint32_t> answered_;
  std::map<std::string, std::uint64_t> taken_;  // by topic, the least of the newest answers
};

}  // namespace trunnion::recorder
