// A small HTTP and WebSocket client over plain sockets, so that the gateway is tested with other code than
// its own.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace trunnion::gateway {

struct Response {
  int status = 0;                              ///< 0 = no answer
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

/// One connection per request. `headers` are whole lines, each ending in CR LF.
Response http(std::uint16_t port, const std::string& method, const std::string& target,
              const std::string& body = {}, const std::string& headers = {});

/// Sends exactly `text` and returns what comes until the other side closes, within 5 s.
std::string raw_exchange(std::uint16_t port, const std::string& text);

class WebSocketClient {
 public:
  /// `receive_buffer` bytes for the kernel, 0 = its default.
  WebSocketClient(std::uint16_t port, const std::string& path, int receive_buffer = 0);
  ~WebSocketClient();
  WebSocketClient(const WebSocketClient&) = delete;
  WebSocketClient& operator=(const WebSocketClient&) = delete;
  bool open() const { return open_; }
  /// The next text message, or nothing after 5 s or when the connection ended.
  std::optional<std::string> next();

 private:
  bool fill(std::size_t bytes);
  int socket_ = -1;
  bool open_ = false;
  std::string buffer_;
};

/// A port nothing listens on.
std::uint16_t free_port();

}  // namespace trunnion::gateway
