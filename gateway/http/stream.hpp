// SPDX-License-Identifier: Apache-2.0
// WebSocket clients: each gets the newest state whenever it has taken the message before, so nothing ever
// queues.
#pragma once

#include <atomic>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "api.hpp"
#include "core/connections.hpp"
#include "http/transport.hpp"
#include "http/viewer.hpp"

namespace trunnion::gateway {

/// Hands what is new in the mailbox to every client that is ready for it.
class StreamHub {
 public:
  StreamHub(boost::asio::io_context& context, Mailbox& mailbox) : timer_(context), mailbox_(mailbox) {}
  void start();
  /// There is something new; each state has its own peaks and its own part of the trace.
  void show();
  /// When too many are open, the oldest of the peer with most gives way.
  void join(const std::shared_ptr<Viewer>& viewer);
  void leave(const std::shared_ptr<Viewer>& viewer);
  /// From the oldest to the newest.
  std::vector<Connection> connections() const;
  /// One of connections().
  void close(std::size_t index);
  std::size_t size() const { return count_; }
  const std::shared_ptr<const ClusterState>& newest() const { return newest_; }
  /// Text of the message that brings a client from `from` (null: from nothing) to the newest state. Empty
  /// when there is nothing to say and `heartbeat` is false.
  std::shared_ptr<const std::string> message(const std::shared_ptr<const ClusterState>& from, bool heartbeat);

 private:
  boost::asio::steady_timer timer_;
  Mailbox& mailbox_;
  std::shared_ptr<const ClusterState> newest_;
  std::map<std::uint64_t, std::shared_ptr<const std::string>> cache_;  ///< by the sequence it starts from
  std::vector<std::shared_ptr<Viewer>> viewers_;                       ///< from the oldest to the newest
  std::atomic<std::size_t> count_{0};
};

class StreamSession : public Viewer, public std::enable_shared_from_this<StreamSession> {
 public:
  StreamSession(Transport&& stream, StreamHub& hub, Api& api, Visitor visitor)
      : Viewer(std::move(visitor)), socket_(std::move(stream)), hub_(hub), api_(api) {}
  void accept(const boost::beast::http::request<boost::beast::http::string_body>& request);
  /// Sends what is new, unless the message before is still under way.
  void offer(const std::shared_ptr<const ClusterState>&) override { offer(); }
  /// Closes the stream when the session of its visitor is over.
  void each_second() override;
  void close() override;

 private:
  void read();
  void offer();
  /// An order to stop, which needs no new connection: {"order": number, "path": a stop's, "body": {...}}.
  void take_order(const std::string& text);
  void answer_order(const bus::Json& order, const Answer& made);
  void send(std::shared_ptr<const std::string> message);
  boost::beast::websocket::stream<Transport> socket_;
  StreamHub& hub_;
  Api& api_;
  boost::beast::flat_buffer incoming_;
  std::deque<std::shared_ptr<const std::string>> answers_;  ///< to orders, before the next state
  std::shared_ptr<const ClusterState> sent_;
  std::shared_ptr<const std::string> writing_;
  std::chrono::steady_clock::time_point last_message_{};
};

}  // namespace trunnion::gateway
