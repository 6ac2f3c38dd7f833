// SPDX-License-Identifier: Apache-2.0
#include "stream/replica_watch.hpp"

#include <algorithm>

namespace trunnion::stream {
namespace {

auto place(const ReplicaWatch::Replica& replica) { return std::pair(replica.epoch, replica.next); }

}  // namespace

ReplicaWatch::ReplicaWatch(const std::vector<machine::ServiceEntry>& services, double now) {
  for (const auto& entry : services) {
    const auto stage = stage_of(entry.service);
    const auto replicas = std::count_if(services.begin(), services.end(),
                                        [&](const auto& other) { return other.service == entry.service; });
    if (!stage || replicas < 2) continue;
    Replica replica;
    replica.stage = *stage;
    replica.number = static_cast<std::uint8_t>(entry.replica);
    replica.lagging_since = now;
    replicas_.push_back(replica);
  }
}

void ReplicaWatch::update(const idl::stream::StageProgress& progress, double now) {
  for (auto& replica : replicas_) {
    if (replica.stage != progress.stage || replica.number != progress.replica) continue;
    const bool further = std::pair(progress.epoch, progress.next) > place(replica);
    replica.last_report = now;
    replica.reports_in_step = progress.in_step;
    replica.epoch = progress.epoch;
    replica.next = progress.next;
    if (further && progress.in_step && replica.lags()) replica.lagging_since = now;
  }
}

bool ReplicaWatch::behind(const Replica& replica) const {
  return std::any_of(replicas_.begin(), replicas_.end(), [&](const Replica& other) {
    return other.stage == replica.stage && other.status == Status::in_step && place(other) > place(replica);
  });
}

bool ReplicaWatch::far_behind(const Replica& replica, std::uint64_t distance) const {
  return std::any_of(replicas_.begin(), replicas_.end(), [&](const Replica& other) {
    return other.stage == replica.stage && other.status == Status::in_step &&
           (other.epoch > replica.epoch ||
            (other.epoch == replica.epoch && other.next > replica.next + distance));
  });
}

std::vector<ReplicaWatch::Change> ReplicaWatch::evaluate(std::uint64_t ahead, double now) {
  std::vector<Change> changes;
  for (auto& replica : replicas_) {
    const bool silent = replica.last_report == 0 || now - replica.last_report > report_timeout;
    const bool late = silent || !replica.reports_in_step;
    if (!late && !behind(replica))
      replica.lagging_since = 0;
    else if (!replica.lags())
      replica.lagging_since = now;
    const bool overdue = replica.lags() && now - replica.lagging_since > progress_timeout;
    const auto before = replica.status;
    if (!late && !overdue && (before == Status::in_step || !far_behind(replica, 2 * ahead)))
      replica.status = Status::in_step;
    else if (overdue && replica.last_report != 0)
      replica.status = Status::dropped;
    else if (late && before == Status::in_step)
      replica.status = Status::joining;
    if (before == Status::dropped && replica.status == Status::in_step)
      changes.push_back({replica.stage, replica.number, false});
    if (before != Status::dropped && replica.status == Status::dropped)
      changes.push_back({replica.stage, replica.number, true});
  }
  return changes;
}

bool ReplicaWatch::may_start(double now) const {
  return std::all_of(replicas_.begin(), replicas_.end(), [&](const Replica& replica) {
    return replica.status == Status::in_step ||
           (replica.lags() && now - replica.lagging_since > start_timeout);
  });
}

std::uint64_t ReplicaWatch::floor() const {
  std::uint64_t result = everywhere;
  for (const auto& replica : replicas_)
    if (replica.status == Status::in_step) result = std::min(result, replica.next);
  return result;
}

}  // namespace trunnion::stream
