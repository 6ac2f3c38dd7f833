// SPDX-License-Identifier: Apache-2.0
// Asks the services for the states from which a recording can be verified, and says who is silent.
#pragma once

#include <set>

#include "bus/bus.hpp"
#include "contracts/topics.hpp"
#include "snapshot_requests.hpp"

namespace trunnion::recorder {

class SnapshotClient {
 public:
  explicit SnapshotClient(bus::Bus& bus);

  /// The services of the launcher's list, by instance; none without a launcher.
  std::set<std::uint32_t> listed();
  /// Everything from now on is in the recording: asks every service.
  void ask();
  /// Asks at `when`, seconds of service::monotonic_seconds(), unless it is going to earlier.
  void ask_at(double when) { requests_.ask_at(when); }
  /// Call several times a second: takes answers, asks when it is time, and a while after another process has
  /// come, whose state the recording does not have.
  void run();
  const SnapshotRequests& requests() const { return requests_; }

 private:
  void take_list(double now);

  SnapshotRequests requests_;
  bus::Writer<idl::service::SnapshotRequest> writer_;
  bus::Reader<idl::service::ServiceSnapshot> snapshots_;
  bus::Reader<idl::service::Announcement> announcements_;
  bus::Reader<idl::service::Cluster> clusters_;
  idl::service::SnapshotRequest request_;
  idl::service::ServiceSnapshot snapshot_;
  idl::service::Announcement announcement_;
  idl::service::Cluster cluster_;
};

}  // namespace trunnion::recorder
