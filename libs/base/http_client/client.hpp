// SPDX-License-Identifier: Apache-2.0
// A small HTTP and WebSocket client over sockets and OpenSSL, so that the gateway is tested and verified with
// other code than its own. For a server on this computer.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace trunnion::http_client {

/// A server of this computer. A port alone is one without TLS.
struct Server {
  Server(std::uint16_t own_port) : port(own_port) {}  // NOLINT(google-explicit-constructor): most are a port
  Server(std::uint16_t own_port, bool by_tls) : port(own_port), tls(by_tls) {}
  std::uint16_t port;
  bool tls = false;
  std::string
      authority;  ///< PEM file: TLS only with a certificate for 127.0.0.1 that is in it; empty = with any
  std::string source;  ///< IPv4 address of this computer from which it is asked; empty = any
  double timeout = 5;  ///< s without progress after which it is given up
};

struct Response {
  int status = 0;                              ///< 0 = no answer
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

/// One connection per request, given up when nothing comes in its time. `headers` are whole lines, each
/// ending in CR LF.
Response request(const Server& server, const std::string& method, const std::string& target,
                 const std::string& body = {}, const std::string& headers = {});

/// Sends exactly `text` and returns what comes until the other side closes.
std::string raw_exchange(const Server& server, const std::string& text);

/// Sends exactly `text` and closes the connection.
void send_and_go(const Server& server, const std::string& text);

/// A connection in clear text or by TLS.
class Link;

class WebSocketClient {
 public:
  /// `receive_buffer` bytes for the kernel, 0 = its default; `headers` as of request().
  WebSocketClient(const Server& server, const std::string& path, int receive_buffer = 0,
                  const std::string& headers = {});
  ~WebSocketClient();
  WebSocketClient(const WebSocketClient&) = delete;
  WebSocketClient& operator=(const WebSocketClient&) = delete;
  bool open() const { return open_; }
  /// A text message of less than 64 KiB.
  void send(const std::string& text);
  /// The next text message, or nothing after `timeout` (s) or when the connection ended; what has come of a
  /// message is kept for the next call.
  std::optional<std::string> next(double timeout = 5);

 private:
  bool fill(std::size_t bytes);
  void pong(const std::string& payload);
  std::unique_ptr<Link> link_;
  bool open_ = false;
  std::string buffer_, message_;  ///< bytes that have come, fragments of a message
};

/// A port nothing listens on.
std::uint16_t free_port();

}  // namespace trunnion::http_client
