// SPDX-License-Identifier: Apache-2.0
// Ports of TCP that are listened on, and the file descriptors that are kept for others.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>

#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace trunnion::gateway {

/// Opens, binds and listens. Throws std::runtime_error with the reason in one line: no address, or in use.
inline void listen_on(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                      std::uint16_t port) {
  namespace net = boost::asio;
  boost::system::error_code error;
  const auto parsed = net::ip::make_address(address, error);
  if (error) throw std::runtime_error("'" + address + "' is not an address");
  const net::ip::tcp::endpoint endpoint(parsed, port);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
  if (error)
    throw std::runtime_error("cannot listen on " + address + ":" + std::to_string(port) + ": " +
                             error.message());
}

/// How many file descriptors are missing from `reserve` free ones after that of a new connection. The system
/// gives the lowest that is free, so those that are free lie above it.
inline rlim_t missing_from_reserve(boost::asio::ip::tcp::socket& socket, rlim_t reserve) {
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return 0;
  for (auto file = static_cast<rlim_t>(socket.native_handle()) + 1; reserve > 0 && file < files.rlim_cur;
       ++file)
    if (fcntl(static_cast<int>(file), F_GETFD) == -1) --reserve;
  return reserve;
}

}  // namespace trunnion::gateway
