// SPDX-License-Identifier: Apache-2.0
// Many requests at a time over one pair of topics. A server answers a client's requests in the order of their
// numbers, so each request that is under way has a client id of its own: none waits for another's silence.
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <vector>

#include "bus/bus.hpp"
#include "service/request.hpp"

namespace trunnion::gateway {

/// Seconds without an answer after which a request is sent again, and after which it is given up.
inline constexpr double resend_after = 0.2, give_up_after = 2.0;

template <class Request, class Reply>
class RequestLanes {
 public:
  /// What was asked, with its client and number, and the reply when there was one.
  using Done = std::function<void(const Request&, const std::optional<Reply>&)>;

  RequestLanes(bus::Bus& bus, const bus::Topic<Request>& request, const bus::Topic<Reply>& reply)
      : writer_(bus.writer(request)), reader_(bus.reader(reply)) {}

  /// `done` is called once, by pump(): with the reply or, when nobody answers, with nothing. A request that
  /// comes with a client of its own keeps it and its number.
  void submit(Request request, Done done, double now) {
    std::optional<Lane> lane;
    if (request.client == 0) {
      if (idle_.empty()) idle_.push_back({service::make_client_id(), 0});
      lane = idle_.back();
      idle_.pop_back();
      request.client = lane->client;
      request.number = ++lane->number;
    }
    under_way_.push_back({std::move(request), std::move(done), lane, now, now + give_up_after});
    writer_.write(under_way_.back().request);
  }

  void pump(double now) {
    Reply reply;
    while (reader_.take(reply))
      for (auto one = under_way_.begin(); one != under_way_.end(); ++one)
        if (one->request.client == reply.client && one->request.number == reply.number) {
          finish(one, reply);
          break;
        }
    for (auto one = under_way_.begin(); one != under_way_.end();) {
      const auto next = std::next(one);
      if (now >= one->until) {
        finish(one, std::nullopt);
      } else if (now - one->sent >= resend_after) {
        writer_.write(one->request);
        one->sent = now;
      }
      one = next;
    }
  }

  bool busy() const { return !under_way_.empty(); }

 private:
  struct Lane {
    std::uint64_t client = 0, number = 0;
  };
  struct UnderWay {
    Request request;
    Done done;
    std::optional<Lane> lane;
    double sent = 0, until = 0;
  };
  void finish(typename std::list<UnderWay>::iterator one, const std::optional<Reply>& reply) {
    if (one->lane) idle_.push_back(*one->lane);
    const auto over = std::move(*one);
    under_way_.erase(one);
    over.done(over.request, reply);
  }

  bus::Writer<Request> writer_;
  bus::Reader<Reply> reader_;
  std::list<UnderWay> under_way_;
  std::vector<Lane> idle_;
};

}  // namespace trunnion::gateway
