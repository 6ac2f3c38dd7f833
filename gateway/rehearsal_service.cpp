#include "rehearsal_service.hpp"

#include "http/client.hpp"

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

template <class T>
Json shown(const std::shared_ptr<const T>& value) {
  return value ? bus::to_json(*value) : Json(nullptr);
}

// The state that the page is told, and what is read besides it.
Json own(const Snapshot& snapshot) {
  auto json = comparable(snapshot.document);
  json["/api/parameters"] = parameters_answer(snapshot, {});
  json["/api/tools"] = shown(snapshot.tools);
  json["/api/work-offsets"] = shown(snapshot.offsets);
  json["/api/programs"] = shown(snapshot.programs);
  json["/api/plc/image"] = shown(snapshot.image);
  return Json::parse(bus::text_of(json));  // numbers as they come over the line
}

// Null when nobody answers there.
Json running(std::uint16_t port) {
  auto first = http::WebSocketClient(port, "/api/stream").next(1);
  auto message = first ? Json::parse(*first, nullptr, false) : Json();
  if (!message.is_object() || !message.contains("state")) return nullptr;
  auto json = comparable(std::move(message["state"]));
  for (const char* path :
       {"/api/parameters", "/api/tools", "/api/work-offsets", "/api/programs", "/api/plc/image"}) {
    const auto answer = http::request(port, "GET", path);
    json[path] = answer.status == 200 ? Json::parse(answer.body, nullptr, false) : Json(nullptr);
  }
  return json;
}

}  // namespace

RehearsalService::RehearsalService(node::Node& node, std::uint16_t port) : view_(node.bus()), port_(port) {}

void RehearsalService::look(double now) {
  const auto theirs = running(port_);
  nobody_answers_ = theirs.is_null();
  if (nobody_answers_) return;
  const double then = node::monotonic_seconds();
  view_.drain(then);
  comparison_.look(theirs, own(*view_.snapshot(then)), now);
}

void RehearsalService::pump() {
  const double now = node::monotonic_seconds();
  view_.drain(now);
  if (now - looked_ < look_period || !comparison_.difference().empty()) return;
  looked_ = now;
  look(now);
}

node::Health RehearsalService::health() const {
  node::Health health;
  health.lifecycle = idl::service::Lifecycle::INACTIVE;
  health.frames_in = view_.frames();
  health.revision = view_.revision();
  const auto& difference = comparison_.difference();
  health.detail = difference.empty() ? node::shadow_detail : node::differs_detail + difference;
  // Of a gateway that does not answer there is nothing that could be compared.
  health.in_step = nobody_answers_ || comparison_.settled(node::monotonic_seconds());
  return health;
}

}  // namespace trunnion::gateway
