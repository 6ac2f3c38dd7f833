// SPDX-License-Identifier: Apache-2.0
#include "snapshot_requests.hpp"

#include <algorithm>

#include "service/request.hpp"

namespace trunnion::recorder {
namespace {
constexpr double start_seconds = 1;  // until a process that was just started reads requests
}

SnapshotRequests::SnapshotRequests(bus::Bus& bus)
    : requests_(bus.writer(topics::snapshot_request)),
      snapshots_(bus.reader(topics::service_snapshot)),
      announcements_(bus.reader(topics::announcement)) {
  request_.client = service::make_client_id();
}

void SnapshotRequests::ask() {
  ++request_.number;
  answered_.clear();
  taken_.clear();
  asked_ = static_cast<std::uint64_t>(bus::source_time());
  requests_.write(request_);
  next_ = 0;
}

void SnapshotRequests::repeat() { requests_.write(request_); }

void SnapshotRequests::ask_at(double when) { next_ = next_ == 0 ? when : std::min(next_, when); }

void SnapshotRequests::run(double now) {
  while (announcements_.take(announcement_)) {
    // Whoever was there before has been asked.
    if (static_cast<std::uint64_t>(announcements_.info().source_timestamp) > asked_)
      ask_at(now + start_seconds);
  }
  if (next_ != 0 && now >= next_) ask();
}

bool SnapshotRequests::answered_by(const std::set<std::uint32_t>& instances) {
  while (snapshots_.take(snapshot_)) {
    if (snapshot_.time < asked_) continue;
    for (const auto& input : snapshot_.taken) {
      const auto [at, news] = taken_.try_emplace(input.topic, input.time);
      if (!news) at->second = std::min(at->second, input.time);
    }
    if (snapshot_.part + 1 == snapshot_.parts) answered_.insert(snapshot_.instance);
  }
  return std::includes(answered_.begin(), answered_.end(), instances.begin(), instances.end());
}

bool SnapshotRequests::has_taken(const std::string& topic, std::int64_t newest) const {
  const auto found = taken_.find(topic);
  return found == taken_.end() || static_cast<std::int64_t>(found->second) >= newest;
}

}  // namespace trunnion::recorder
