// SPDX-License-Identifier: Apache-2.0
// A WebSocket that carries the values of variables of the PLC. The client sends {"paths": [...]}, also again
// with others; it gets {"variables": [...]} or {"problem": {...}}, then {"scan", "tick", "values", "forced"}
// whenever something has changed.
#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>
#include <memory>

#include "api.hpp"
#include "http/transport.hpp"
#include "http/viewer.hpp"
#include "plc/online/shown_variables.hpp"

namespace trunnion::gateway {

class StreamHub;

class WatchSession : public Viewer, public std::enable_shared_from_this<WatchSession> {
 public:
  WatchSession(Transport&& stream, StreamHub& hub, Api& api, Visitor visitor);
  void accept(const boost::beast::http::request<boost::beast::http::string_body>& request);
  void offer(const std::shared_ptr<const ClusterState>& newest) override;
  void each_second() override;
  void close() override;

 private:
  using Request = idl::plc::OnlineRequest;
  using Reply = idl::plc::OnlineReply;
  void read();
  void take(const std::string& text);
  void ask(Request request);
  void answered(const Request& asked, const std::optional<Reply>& reply);
  void send(const bus::Json& message);
  void write_next();

  boost::beast::websocket::stream<Transport> socket_;
  StreamHub& hub_;
  Api& api_;
  const std::uint64_t client_;
  std::uint64_t number_ = 0;        ///< of the last request
  std::uint64_t named_ = 0;         ///< the first request of the list: what older ones gave is not of it
  std::optional<Request> watched_;  ///< repeated while the client is there
  std::optional<std::uint8_t> slot_;
  plc_online::ShownVariables shown_;
  std::shared_ptr<const idl::plc::Watched> sent_;
  boost::beast::flat_buffer incoming_;
  std::deque<std::string> outgoing_;
  bool described_ = false;  ///< the client knows the variables of shown_
  bool writing_ = false, open_ = false;
};

}  // namespace trunnion::gateway
