// SPDX-License-Identifier: Apache-2.0
#include "snapshot_requests.hpp"

#include <algorithm>
#include <utility>

namespace trunnion::recorder {
namespace {

// Channels and replicas have one name.
std::string name_in(const idl::service::Cluster& cluster, const idl::service::ClusterService& service) {
  const auto same =
      std::ranges::count(cluster.services, service.service, &idl::service::ClusterService::service);
  return same == 1 ? service.service
                   : service.service + " (instance " + std::to_string(service.instance) + ")";
}

}  // namespace

void SnapshotRequests::expect(const idl::service::Cluster& cluster, double now) {
  auto before = std::exchange(services_, {});
  for (const auto& listed : cluster.services) {
    if (listed.pid == 0) continue;
    auto& service = services_[listed.instance];
    if (const auto known = before.find(listed.instance); known != before.end())
      service = std::move(known->second);
    else if (number_ > 0)
      service.owes_since = now;
    service.name = name_in(cluster, listed);
  }
}

void SnapshotRequests::ask_at(double when) { next_ = next_ ? std::min(*next_, when) : when; }

void SnapshotRequests::see_process(std::uint64_t time, double now) {
  if (time > asked_) ask_at(now + start_seconds);
}

SnapshotRequests::Due SnapshotRequests::due(double now, std::uint64_t time) {
  if (next_ && now >= *next_) {
    next_.reset();
    ++number_;
    asked_ = time;
    taken_.clear();
    for (auto& [instance, service] : services_)
      if (!service.owes_since) service.owes_since = now;
    pause_ = first_pause;
    repetition_ = now + pause_;
    return Due::request;
  }
  if (now < repetition_ || answered()) return Due::nothing;
  pause_ = std::min(2 * pause_, longest_pause);
  repetition_ = now + pause_;
  return Due::repetition;
}

void SnapshotRequests::take(const idl::service::ServiceSnapshot& part) {
  if (part.time < asked_) return;
  for (const auto& input : part.taken) {
    const auto [at, news] = taken_.try_emplace(input.topic, input.time);
    if (!news) at->second = std::min(at->second, input.time);
  }
  const auto found = services_.find(part.instance);
  if (part.part + 1 != part.parts || found == services_.end()) return;
  auto& service = found->second;
  service.owes_since.reset();
  if (std::exchange(service.is_named, false)) news_.push_back({service.name, true});
}

bool SnapshotRequests::answered() const {
  return std::ranges::none_of(services_,
                              [](const auto& entry) { return entry.second.owes_since.has_value(); });
}

std::vector<std::string> SnapshotRequests::owing() const {
  std::vector<std::string> names;
  for (const auto& [instance, service] : services_)
    if (service.owes_since) names.push_back(service.name);
  return names;
}

std::vector<SnapshotRequests::News> SnapshotRequests::take_news(double now) {
  for (auto& [instance, service] : services_) {
    if (!service.owes_since || now < *service.owes_since + late_seconds) continue;
    if (!std::exchange(service.is_named, true)) news_.push_back({service.name, false});
  }
  return std::exchange(news_, {});
}

bool SnapshotRequests::has_taken(const std::string& topic, std::int64_t newest) const {
  const auto found = taken_.find(topic);
  return found == taken_.end() || static_cast<std::int64_t>(found->second) >= newest;
}

}  // namespace trunnion::recorder
