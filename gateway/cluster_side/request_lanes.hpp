// SPDX-License-Identifier: Apache-2.0
// Many requests at a time over one pair of topics. A server answers a client's requests in the order of their
// numbers, so each request that is under way has a client id of its own: none waits for another's silence.
#pragma once

#include <functional>
#include <limits>
#include <list>
#include <optional>
#include <utility>
#include <vector>

#include "bus/bus.hpp"
#include "service/request.hpp"

namespace trunnion::gateway {

/// Seconds without an answer after which a request is sent again, and after which it is given up.
inline constexpr double resend_after = 0.2, give_up_after = 2.0;
/// The latter for a part of a program that is stored: the service may be writing 100 MB of another one to a
/// slow disk.
inline constexpr double give_up_part_after = 20.0;
/// Seconds after which who orders a stop is told that nobody has answered, and for which it is repeated.
inline constexpr double stop_told_after = 0.3, stop_repeated_for = 10.0;
/// So many requests in so many seconds: a reader that is read less often loses the oldest beyond 64
/// (idl/topics.yaml, event), and would lose the same ones whenever they are sent again.
inline constexpr std::size_t most_in_burst = 32;
inline constexpr double burst_seconds = 0.004;
/// Between two looks whether a request is to be sent again.
inline constexpr double answer_seconds = 0.02;

template <class Request, class Reply>
class RequestLanes {
 public:
  /// What was asked, with its client and number, and the reply when there was one.
  using Done = std::function<void(const Request&, const std::optional<Reply>&)>;

  RequestLanes(bus::Bus& bus, const bus::Topic<Request>& request, const bus::Topic<Reply>& reply)
      : writer_(bus.writer(request)), reader_(bus.reader(reply)) {}

  /// `done` is called once, by pump(): with the reply or, when nobody answers, with nothing. A request that
  /// comes with a client of its own keeps it and its number.
  void submit(Request request, Done done, double now, double give_up = give_up_after) {
    std::optional<Lane> lane;
    if (request.client == 0) {
      if (idle_.empty()) idle_.push_back({service::make_client_id(), 0});
      lane = idle_.back();
      idle_.pop_back();
      request.client = lane->client;
      request.number = ++lane->number;
    }
    under_way_.push_back({std::move(request), std::move(done), lane, now, now + give_up});
    send_due(now);
  }

  /// As submit, for an order that stops motion: when nobody answers, `done` is called with nothing early and
  /// the request is repeated all the same.
  void submit_stop(Request request, Done done, double now) {
    submit(std::move(request), std::move(done), now, stop_repeated_for);
    under_way_.back().told_at = now + stop_told_after;
  }
  /// Ends the repetition of the stops that `which` chooses. To those of which nobody has been told yet
  /// `otherwise` is the answer when none comes; without it they go on.
  template <class Which>
  void withdraw(Which which, const std::optional<Reply>& otherwise = {}) {
    for (auto& one : under_way_) {
      if (!one.told_at || !which(one.request) || (one.done && !otherwise)) continue;
      one.until = *one.told_at;
      one.otherwise = otherwise;
      if (one.repeated) one.due = never;
    }
  }
  /// Requests that `which` chooses and that no one has answered are not sent any more; `otherwise` is their
  /// answer when none comes.
  template <class Which>
  void cease(Which which, const Reply& otherwise) {
    for (auto& one : under_way_) {
      if (one.told_at || one.reply || !which(one.request)) continue;
      one.due = never;
      one.otherwise = otherwise;
    }
  }

  /// Takes replies in, for pump() to give them to those who asked; true when there are any.
  bool receive() {
    bool any = false;
    Reply reply;
    while (reader_.take(reply)) any = answer(std::move(reply)) || any;
    return any;
  }
  /// A reply from elsewhere; true when somebody waits for it.
  bool answer(Reply reply) {
    for (auto& one : under_way_)
      if (one.request.client == reply.client && one.request.number == reply.number) {
        one.reply = std::move(reply);
        return true;
      }
    return false;
  }

  void pump(double now) {
    for (auto one = under_way_.begin(); one != under_way_.end();) {
      const auto next = std::next(one);
      if (one->reply || now >= one->until)
        finish(one);
      else if (one->told_at && now >= *one->told_at && one->done)
        std::exchange(one->done, nullptr)(one->request, std::nullopt);
      one = next;
    }
    send_due(now);
  }

  /// Seconds after which pump() is to be called at the latest, when requests are under way.
  std::optional<double> period() const {
    if (under_way_.empty()) return std::nullopt;
    return burst_ == most_in_burst ? burst_seconds : answer_seconds;
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  struct Lane {
    std::uint64_t client = 0, number = 0;
  };
  struct UnderWay {
    Request request;
    Done done;
    std::optional<Lane> lane;
    double due = 0, until = 0;  ///< to be sent (again), to be given up
    bool repeated = false;
    std::optional<Reply> reply = {}, otherwise = {};
    std::optional<double> told_at = {};  ///< of a stop: when `done` is called at the latest, once
  };
  // What was never sent comes first: an order does not wait for the repetitions of others.
  void send_due(double now) {
    if (now - burst_begun_ >= burst_seconds) burst_begun_ = now, burst_ = 0;
    for (const bool repeated : {false, true})
      for (auto& one : under_way_) {
        if (burst_ == most_in_burst) return;
        if (one.repeated != repeated || now < one.due) continue;
        writer_.write(one.request);
        // One that was withdrawn is sent once all the same.
        one.due = one.otherwise ? never : now + resend_after;
        one.repeated = true;
        ++burst_;
      }
  }
  void finish(typename std::list<UnderWay>::iterator one) {
    if (one->lane) idle_.push_back(*one->lane);
    const auto over = std::move(*one);
    under_way_.erase(one);
    if (over.done) over.done(over.request, over.reply ? over.reply : over.otherwise);
  }

  bus::Writer<Request> writer_;
  bus::Reader<Reply> reader_;
  std::list<UnderWay> under_way_;
  std::vector<Lane> idle_;
  double burst_begun_ = 0;
  std::size_t burst_ = 0;
};

}  // namespace trunnion::gateway
