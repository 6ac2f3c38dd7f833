// SPDX-License-Identifier: Apache-2.0
// Requests over a pair of topics: correlation by (client, number), resent until answered, applied once.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "bus/bus.hpp"
#include "service/node.hpp"
#include "text/quantity.hpp"

namespace trunnion::service {

/// A client id that no other process has.
inline std::uint64_t make_client_id() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) ^ device() ^
         (static_cast<std::uint64_t>(getpid()) << 16);
}

/// Why `who` has not answered, of RequestClient::connected(): one line.
inline std::string silence(const std::string& who, double seconds, int connected) {
  return who + " does not answer within " + text::quantity(seconds, "s") +
         (connected == 0   ? ": it is not connected, see `trunnion status`"
          : connected == 1 ? ": it is connected"
                           : ": " + std::to_string(connected) + " of its kind are connected");
}

template <class Request, class Reply>
class RequestClient {
 public:
  RequestClient(bus::Bus& bus, const bus::Topic<Request>& request, const bus::Topic<Reply>& reply)
      : writer_(bus.writer(request)), reader_(bus.reader(reply)), client_(make_client_id()) {}

  /// Starts a request; poll() until it is answered. Only one at a time.
  void send(Request request) {
    request.client = client_;
    request.number = ++number_;
    pending_ = std::move(request);
    writer_.write(*pending_);
    sent_ = monotonic_seconds();
  }
  bool busy() const { return pending_.has_value(); }
  /// The reply to the request under way, once. Sends the request again every 200 ms.
  std::optional<Reply> poll() {
    Reply reply;
    while (reader_.take(reply))
      if (pending_ && reply.client == client_ && reply.number == number_) {
        pending_.reset();
        return reply;
      }
    if (pending_ && monotonic_seconds() - sent_ > 0.2) {
      writer_.write(*pending_);
      sent_ = monotonic_seconds();
    }
    return std::nullopt;
  }
  void abandon() { pending_.reset(); }
  /// How many processes answer requests of this kind and are connected with this one.
  int connected() { return std::min(writer_.matched(), reader_.matched()); }

  /// How many read the requests: those that answer, and recorders.
  int readers() { return writer_.matched(); }

  /// Blocks up to `timeout` seconds: for command-line tools. `elsewhere` may know the reply of the request
  /// too.
  std::optional<Reply> call(Request request, double timeout,
                            const std::function<std::optional<Reply>(const Request&)>& elsewhere = {}) {
    const double until = monotonic_seconds() + timeout;
    send(std::move(request));
    while (monotonic_seconds() < until) {
      auto reply = poll();
      if (!reply && elsewhere && (reply = elsewhere(*pending_))) abandon();
      if (reply) return reply;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    abandon();
    return std::nullopt;
  }

 private:
  bus::Writer<Request> writer_;
  bus::Reader<Reply> reader_;
  std::uint64_t client_, number_ = 0;
  std::optional<Request> pending_;
  double sent_ = 0;
};

template <class Request, class Reply>
class RequestServer {
 public:
  RequestServer(bus::Bus& bus, const bus::Topic<Request>& request, const bus::Topic<Reply>& reply)
      : reader_(bus.reader(request)), writer_(bus.writer(reply)) {}

  /// The next request that was not seen before; a repeated one is answered with the reply it got.
  bool take(Request& request) {
    while (reader_.take(request)) {
      auto& last = clients_[request.client];
      if (request.number > last.number) {
        last.number = request.number;
        last.reply.reset();
        if (clients_.size() > 256) forget_all_but(request.client);
        return true;
      }
      if (request.number == last.number && last.reply) writer_.write(*last.reply);
    }
    return false;
  }
  /// Of the request taken last.
  const bus::SampleInfo& info() const { return reader_.info(); }
  void reply(const Request& request, Reply reply) {
    reply.client = request.client;
    reply.number = request.number;
    writer_.write(reply);
    clients_[request.client].reply = std::move(reply);
  }

 private:
  struct Last {
    std::uint64_t number = 0;
    std::optional<Reply> reply;
  };
  void forget_all_but(std::uint64_t client) {
    for (auto it = clients_.begin(); it != clients_.end() && clients_.size() > 128;)
      it = it->first != client ? clients_.erase(it) : std::next(it);
  }
  bus::Reader<Request> reader_;
  bus::Writer<Reply> writer_;
  std::map<std::uint64_t, Last> clients_;
};

}  // namespace trunnion::service
