// SPDX-License-Identifier: Apache-2.0
#include "operators/operating_control.hpp"

#include <utility>

#include "access/secrets.hpp"
#include "core/requests.hpp"
#include "core/rights.hpp"
#include "service/node.hpp"

namespace trunnion::gateway {
namespace {

using access::OperatingRight;
using access::Station;
using bus::Json;

Json json_of(const std::optional<access::ShownStation>& one) {
  if (!one) return nullptr;
  return {{"number", one->number}, {"name", one->name}};
}

std::string refused(const std::string& holder) {
  return holder + " operates this machine: take over the right to operate, or ask for it";
}

}  // namespace

bool OrderUnderWay::end(bool accepted) {
  const auto right = std::exchange(right_, nullptr);
  if (!right) return false;
  const std::lock_guard lock(right->mutex);
  return right->right.answered(reservation_, accepted, service::monotonic_seconds());
}

Station OperatingControl::station_of(std::string_view cookies, const std::string& peer,
                                     const std::optional<access::Identity>& user) const {
  if (user) {
    const auto session = cookie_value(cookies, AccessControl::cookie);
    return {session.empty() ? "token " + user->name : session, user->name + " (" + peer + ")",
            user->role >= access::Role::setter};
  }
  // Without users everybody who reaches the machine may do everything.
  const auto browser = cookie_value(cookies, cookie);
  if (browser.empty()) return {"address " + peer, "a program (" + peer + ")", true};
  Station station{browser, "", true};
  station.name = "station " + std::to_string(access::shown(station).number % 1000) + " (" + peer + ")";
  return station;
}

std::optional<Answer> OperatingControl::refusal(const Station& station, const Match& match,
                                                std::shared_ptr<OrderUnderWay>& order) {
  if (!on_ || !needs_operating_right(match)) return {};
  std::uint64_t reservation = 0;
  {
    const std::lock_guard lock(mutex_);
    const auto holder = right_.order(station, service::monotonic_seconds());
    if (!holder.empty()) return refused_answer(0, refused(holder));
    reservation = right_.reservation();
  }
  order = std::make_shared<OrderUnderWay>(shared_, station, reservation);
  return {};
}

void OperatingControl::answered(const std::shared_ptr<OrderUnderWay>& order, unsigned status) {
  if (order && order->end(status >= 200 && status < 300)) note(order->station(), "operates the machine");
}

void OperatingControl::present(const Station& station) {
  if (!on_) return;
  const std::lock_guard lock(mutex_);
  right_.present(station.key, service::monotonic_seconds());
}

Answer OperatingControl::state(const Station& station) {
  const double now = service::monotonic_seconds();
  return json_answer(200, {{"one", on_},
                           {"number", access::shown(station).number},
                           {"may_take_over", station.may_take_over},
                           {"mine", right_.is_held_by(station.key, now)},
                           {"holder", json_of(right_.holder(now))},
                           {"asking", json_of(right_.asking(now))}});
}

Answer OperatingControl::handle(const Match& match, const RequestText& request) {
  auto station = station_of(request.cookies, request.peer, request.user);
  std::string made;  // a browser gets its cookie before it operates
  if (on_ && !request.user && cookie_value(request.cookies, cookie).empty() && !access_.on() &&
      match.operation == Operation::operating_right) {
    made = access::random_secret();
    station = station_of(std::string(cookie) + "=" + made, request.peer, request.user);
  }
  const std::lock_guard lock(mutex_);
  const double now = service::monotonic_seconds();
  if (match.operation == Operation::operating_right) {
    auto answer = state(station);
    if (!made.empty())
      answer.headers.emplace_back("Set-Cookie", std::string(cookie) + "=" + made +
                                                    "; Path=/; HttpOnly; SameSite=Strict; Max-Age=31536000" +
                                                    (access_.secure() ? "; Secure" : ""));
    return answer;
  }
  const auto body = parse_body(request.body);
  commands::only(body, {"action"});
  const auto action = commands::text(commands::required(body, "action"), "action", 16);
  if (!on_) return problem_answer(409, "every station operates: operating_right is any in machine.yaml");
  if (action == "take") {
    if (right_.take(station, now) == OperatingRight::Taken::yes) note(station, "operates the machine");
  } else if (action == "hand_over" || action == "refuse") {
    const auto asking = right_.asking(now);
    if (action == "refuse" ? !right_.refuse(station.key, now) : !right_.hand_over(station.key, now))
      return problem_answer(409,
                            "only who holds the right to operate can do this, and when another one asks");
    note(station,
         (action == "refuse" ? "keeps the right to operate from " : "hands the right to operate to ") +
             (asking ? asking->name : ""));
  } else if (action == "release") {
    right_.release(station.key);
    note(station, "gives the right to operate back");
  } else {
    throw BadRequest("action", "action must be take, hand_over, refuse or release");
  }
  return state(station);
}

std::string OperatingControl::take_for_command(const Station& station, bool take_over) {
  if (!on_) return {};
  const std::lock_guard lock(mutex_);
  const double now = service::monotonic_seconds();
  if (take_over) right_.take(station, now);
  const auto holder = right_.order(station, now);
  if (!holder.empty()) return holder;
  right_.answered(right_.reservation(), true, now);
  note(station, "operates the machine");
  return {};
}

void OperatingControl::release(const Station& station) {
  const std::lock_guard lock(mutex_);
  right_.release(station.key);
}

Json OperatingControl::document() {
  if (!on_) return nullptr;
  const std::lock_guard lock(mutex_);
  const double now = service::monotonic_seconds();
  // Absent rather than null, which a merge patch takes for absent.
  auto document = Json::object();
  if (const auto holder = right_.holder(now)) document["holder"] = json_of(holder);
  if (const auto asking = right_.asking(now)) document["asking"] = json_of(asking);
  return document;
}

}  // namespace trunnion::gateway
