// SPDX-License-Identifier: Apache-2.0
#include "standby_service.hpp"

#include "http_client/client.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

constexpr double poll_period = 0.1;  // s

// What depends neither on the time of the sample nor on what was before this process started: of axes at
// rest for longer than the history of the feedback it knows the position alone, not the last cycle.
Json comparable(Json document, bool executed) {
  document.erase("trace");
  document.erase("operating");
  document.erase("run_times");
  if (document.contains("cluster")) document["cluster"].erase("title");
  if (document.contains("axes"))
    for (auto& axis : document["axes"]) {
      axis.erase("following_peak");
      if (executed) continue;
      for (const char* of_last_cycle : {"commanded", "actual", "following_error"}) axis.erase(of_last_cycle);
    }
  if (document.contains("alarms"))
    for (auto& alarm : document["alarms"]) alarm.erase("since");
  auto& services = document["services"];
  for (auto service = services.begin(); service != services.end();)
    service = service->value("expected", false) ? std::next(service) : services.erase(service);
  return document;
}

Json own(const ClusterState& cluster, bool executed) {
  // Numbers as they come over the line.
  return Json::parse(bus::text_of(comparable(cluster.document, executed)));
}

// Null when no gateway answers there.
Json running(const http_client::Server& gateway, bool executed) {
  http_client::WebSocketClient client(gateway, "/api/stream");
  const auto first = client.open() ? client.next(gateway.timeout) : std::nullopt;
  auto message = first ? Json::parse(*first, nullptr, false) : Json();
  if (!message.is_object() || !message.contains("state")) return nullptr;
  return comparable(std::move(message["state"]), executed);
}

}  // namespace

StandbyService::StandbyService(service::Node& node, const http_client::Server& gateway, FeedbackChange change)
    : view_(node.bus(), {}, std::move(change)), gateway_(gateway) {
  gateway_.timeout = 1;  // s
}

void StandbyService::compare(double now) {
  const bool executed = view_.executed();
  const auto before = own(*view_.state(now), executed);
  const auto theirs = running(gateway_, executed);
  no_answer_ = theirs.is_null();
  if (no_answer_) return;
  const double then = service::monotonic_seconds();
  view_.drain(then);
  comparison_.sample(theirs, before, own(*view_.state(then), executed), then);
}

void StandbyService::pump() {
  const double now = service::monotonic_seconds();
  view_.drain(now);
  if (now - compared_ < poll_period || !comparison_.difference().empty()) return;
  compared_ = now;
  compare(now);
}

service::Health StandbyService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::INACTIVE;
  health.messages_in = view_.batches();
  health.revision = view_.revision();
  health.difference = comparison_.difference();
  // Of a gateway that does not answer there is nothing that could be compared.
  health.in_step = no_answer_ || comparison_.settled(service::monotonic_seconds());
  return health;
}

}  // namespace trunnion::gateway
