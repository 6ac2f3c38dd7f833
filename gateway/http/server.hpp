// SPDX-License-Identifier: Apache-2.0
// HTTP and WebSocket on one thread of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "api.hpp"
#include "core/site.hpp"
#include "http/tls_certificate.hpp"

namespace trunnion::gateway {

class HttpServer {
 public:
  /// Listens at once. Throws std::runtime_error saying address, port and reason.
  /// `command_socket` as of CommandSocket, empty = none. With a `certificate` by TLS only.
  HttpServer(const std::string& address, std::uint16_t port, Api& api, Site site = Site(),
             const std::string& command_socket = {}, TlsCertificate* certificate = nullptr);
  ~HttpServer();
  /// Ends the thread; nothing is answered afterwards. Answers may still be handed to sessions until it is
  /// destroyed.
  void stop();
  /// From any thread: the mailbox has a new state for the streams.
  void show();
  /// WebSocket clients now.
  std::size_t clients() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace trunnion::gateway
