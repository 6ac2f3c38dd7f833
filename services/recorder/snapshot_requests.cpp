// SPDX-License-Identifier: Apache-2.0
#include "snapshot_requests.hpp"

#include <algorithm>

#include "service/request.hpp"

namespace trunnion::recorder {
namespace {
constexpr double start_seconds = 1;  // until a new process reads requests
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
  asked_ = static_cast<std::uint64_t>(bus::source_time());
  requests_.write(request_);
  next_ = 0;
}

void SnapshotRequests::ask_at(double when) { next_ = next_ == 0 ? when : std::min(next_, when); }

void SnapshotRequests::run(double now) {
  while (announcements_.take(announcement_)) {
    const auto [known, news] = processes_.try_emplace(announcement_.instance, announcement_.pid);
    if (known->second != announcement_.pid || (news && request_.number > 0)) ask_at(now + start_seconds);
    known->second = announcement_.pid;
  }
  if (next_ != 0 && now >= next_) ask();
}

bool SnapshotRequests::answered_by(const std::set<std::uint32_t>& instances) {
  while (snapshots_.take(snapshot_))
    if (snapshot_.time >= asked_ && snapshot_.part + 1 == snapshot_.parts)
      answered_.insert(snapshot_.instance);
  return std::includes(answered_.begin(), answered_.end(), instances.begin(), instances.end());
}

}  // namespace trunnion::recorder
