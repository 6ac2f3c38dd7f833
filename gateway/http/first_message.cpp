// SPDX-License-Identifier: Apache-2.0
#include "http/first_message.hpp"

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>

namespace trunnion::gateway {

namespace asio = boost::asio;
namespace beast = boost::beast;

std::optional<std::string> first_message(std::uint16_t port, const std::string& target, double timeout) {
  asio::io_context context;
  beast::websocket::stream<beast::tcp_stream> socket(context);
  beast::flat_buffer buffer;
  bool complete = false;
  const auto on_read = [&](beast::error_code error, std::size_t) { complete = !error; };
  const auto on_handshake = [&](beast::error_code error) {
    if (!error) socket.async_read(buffer, on_read);
  };
  const auto on_connect = [&](beast::error_code error) {
    if (!error) socket.async_handshake("127.0.0.1:" + std::to_string(port), target, on_handshake);
  };
  socket.next_layer().async_connect({asio::ip::address_v4::loopback(), port}, on_connect);
  context.run_for(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(timeout)));
  if (!complete) return std::nullopt;
  return beast::buffers_to_string(buffer.data());
}

}  // namespace trunnion::gateway
