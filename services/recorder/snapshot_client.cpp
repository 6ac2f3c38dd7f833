// SPDX-License-Identifier: Apache-2.0
#include "snapshot_client.hpp"

#include <iostream>

#include "service/request.hpp"

namespace trunnion::recorder {

SnapshotClient::SnapshotClient(bus::Bus& bus)
    : writer_(bus.writer(topics::snapshot_request)),
      snapshots_(bus.reader(topics::service_snapshot)),
      announcements_(bus.reader(topics::announcement)),
      clusters_(bus.reader(topics::cluster)) {
  request_.client = service::make_client_id();
}

void SnapshotClient::take_list(double now) {
  while (clusters_.take(cluster_)) requests_.expect(cluster_, now);
}

std::set<std::uint32_t> SnapshotClient::listed() {
  take_list(service::monotonic_seconds());
  std::set<std::uint32_t> instances;
  for (const auto& service : cluster_.services) instances.insert(service.instance);
  return instances;
}

void SnapshotClient::ask() {
  ask_at(service::monotonic_seconds());
  run();
}

void SnapshotClient::run() {
  const double now = service::monotonic_seconds();
  take_list(now);
  while (announcements_.take(announcement_))
    requests_.see_process(static_cast<std::uint64_t>(announcements_.info().source_timestamp), now);
  while (snapshots_.take(snapshot_)) requests_.take(snapshot_);
  if (requests_.due(now, static_cast<std::uint64_t>(bus::source_time())) != SnapshotRequests::Due::nothing) {
    request_.number = requests_.number();
    writer_.write(request_);
  }
  for (const auto& news : requests_.take_news(now)) {
    if (news.given)
      std::cerr << "trunnion-recorder: " << news.service << " has given its state\n";
    else
      std::cerr << "trunnion-recorder: warning: " << news.service << " has not given its state within "
                << SnapshotRequests::late_seconds
                << " s: it is asked again, and cannot be verified before it answers\n";
  }
}

}  // namespace trunnion::recorder
