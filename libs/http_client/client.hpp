// SPDX-License-Identifier: Apache-2.0
// A small HTTP and WebSocket client over plain sockets, so that the gateway is tested and verified with other
// code than its own. For a server on this computer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace trunnion::http_client {

struct Response {
  int status = 0;                              ///< 0 = no answer
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

/// One connection per request, given up when nothing comes for 5 s. `headers` are whole lines, each ending in
/// CR LF.
Response request(std::uint16_t port, const std::string& method, const std::string& target,
                 const std::string& body = {}, const std::string& headers = {});

/// Sends exactly `text` and returns what comes until the other side closes, within 5 s.
std::string raw_exchange(std::uint16_t port, const std::string& text);

/// Sends exactly `text` and closes the connection.
void send_and_go(std::uint16_t port, const std::string& text);

class WebSocketClient {
 public:
  /// `receive_buffer` bytes for the kernel, 0 = its default.
  WebSocketClient(std::uint16_t port, const std::string& path, int receive_buffer = 0);
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
  int socket_ = -1;
  bool open_ = false;
  std::string buffer_, message_;  ///< bytes that have come, fragments of a message
};

/// A port nothing listens on.
std::uint16_t free_port();

}  // namespace trunnion::http_client
