#include "rehearsal_service.hpp"

#include "http/first_message.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

constexpr double look_period = 0.1;  // s

// What does not depend on when somebody looked, nor on what was before this process began.
Json comparable(Json document) {
  document.erase("trace");
  if (document.contains("axes"))
    for (auto& axis : document["axes"]) axis.erase("following_peak");
  if (document.contains("alarms"))
    for (auto& alarm : document["alarms"]) alarm.erase("since");
  auto& services = document["services"];
  for (auto service = services.begin(); service != services.end();)
    service = service->value("expected", false) ? std::next(service) : services.erase(service);
  return document;
}

Json own(const Snapshot& snapshot) {
  return Json::parse(bus::text_of(comparable(snapshot.document)));  // numbers as they come over the line
}

// Null when nobody answers there.
Json running(std::uint16_t port) {
  const auto first = first_message(port, "/api/stream", 1);
  auto message = first ? Json::parse(*first, nullptr, false) : Json();
  if (!message.is_object() || !message.contains("state")) return nullptr;
  return comparable(std::move(message["state"]));
}

}  // namespace

RehearsalService::RehearsalService(service::Node& node, std::uint16_t port)
    : view_(node.bus()), port_(port) {}

void RehearsalService::look(double now) {
  const auto before = own(*view_.snapshot(now));
  const auto theirs = running(port_);
  nobody_answers_ = theirs.is_null();
  if (nobody_answers_) return;
  const double then = service::monotonic_seconds();
  view_.drain(then);
  comparison_.look(theirs, before, own(*view_.snapshot(then)), then);
}

void RehearsalService::pump() {
  const double now = service::monotonic_seconds();
  view_.drain(now);
  if (now - looked_ < look_period || !comparison_.difference().empty()) return;
  looked_ = now;
  look(now);
}

service::Health RehearsalService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::INACTIVE;
  health.frames_in = view_.frames();
  health.revision = view_.revision();
  health.difference = comparison_.difference();
  // Of a gateway that does not answer there is nothing that could be compared.
  health.in_step = nobody_answers_ || comparison_.settled(service::monotonic_seconds());
  return health;
}

}  // namespace trunnion::gateway
