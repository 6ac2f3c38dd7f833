// SPDX-License-Identifier: Apache-2.0
#include "http_client/client.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace trunnion::http_client {
namespace {

constexpr int opcode_binary = 2, opcode_close = 8, opcode_ping = 9;  // RFC 6455, 5.2
constexpr std::size_t longest_frame = 64u << 20;                     // bytes

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

int connect_to(std::uint16_t port, int receive_buffer) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  if (receive_buffer > 0) setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  const timeval timeout{5, 0};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
  const auto address = loopback(port);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd);
    return -1;
  }
  return fd;
}

void send_all(int fd, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const auto n = ::send(fd, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return;  // the answer tells why the other side stopped reading
    sent += static_cast<std::size_t>(n);
  }
}

}  // namespace

std::string raw_exchange(std::uint16_t port, const std::string& text) {
  const int fd = connect_to(port, 0);
  if (fd < 0) return {};
  send_all(fd, text);
  std::string answer;
  char part[65536];
  for (ssize_t n; (n = ::recv(fd, part, sizeof part, 0)) > 0;)
    answer.append(part, static_cast<std::size_t>(n));
  ::close(fd);
  return answer;
}

void send_and_go(std::uint16_t port, const std::string& text) {
  const int fd = connect_to(port, 0);
  if (fd < 0) return;
  send_all(fd, text);
  ::close(fd);
}

Response request(std::uint16_t port, const std::string& method, const std::string& target,
                 const std::string& body, const std::string& headers) {
  const bool has_length = headers.find("Content-Length") != std::string::npos;
  const auto answer =
      raw_exchange(port, method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                             "\r\nConnection: close\r\n" +
                             (has_length ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") +
                             headers + "\r\n" + body);
  Response response;
  const auto end = answer.find("\r\n\r\n");
  if (end == std::string::npos || answer.size() < 12) return response;
  if (!answer.starts_with("HTTP/1.") ||
      std::from_chars(&answer[9], &answer[12], response.status).ec != std::errc{})
    return response;
  for (std::size_t at = answer.find("\r\n") + 2; at < end;) {
    const auto stop = answer.find("\r\n", at);
    const auto colon = answer.find(':', at);
    if (colon >= stop) break;
    auto name = answer.substr(at, colon - at);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto value = answer.find_first_not_of(' ', colon + 1);
    response.headers[name] = answer.substr(value, stop - std::min(value, stop));
    at = stop + 2;
  }
  response.body = answer.substr(end + 4);
  return response;
}

WebSocketClient::WebSocketClient(std::uint16_t port, const std::string& path, int receive_buffer)
    : socket_(connect_to(port, receive_buffer)) {
  if (socket_ < 0) return;
  send_all(socket_, "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                        "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  while (buffer_.find("\r\n\r\n") == std::string::npos)
    if (!fill(buffer_.size() + 1)) return;
  // RFC 6455, section 1.3 gives the answer to this key.
  open_ = buffer_.starts_with("HTTP/1.1 101") &&
          buffer_.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") != std::string::npos;
  buffer_.erase(0, buffer_.find("\r\n\r\n") + 4);
}

WebSocketClient::~WebSocketClient() {
  if (socket_ >= 0) ::close(socket_);
}

bool WebSocketClient::fill(std::size_t bytes) {
  char part[65536];
  while (buffer_.size() < bytes) {
    const auto n = ::recv(socket_, part, sizeof part, 0);
    if (n <= 0) return false;
    buffer_.append(part, static_cast<std::size_t>(n));
  }
  return true;
}

void WebSocketClient::send(const std::string& text) {
  std::string frame{'\x81'};
  if (text.size() < 126) {
    frame += static_cast<char>(0x80 | text.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(text.size() >> 8);
    frame += static_cast<char>(text.size() & 0xff);
  }
  send_all(socket_, frame + std::string(4, '\0') + text);
}

void WebSocketClient::pong(const std::string& payload) {
  // A client masks what it sends (RFC 6455, 5.3); a mask of zeros leaves it as it is.
  send_all(socket_, std::string{'\x8A', static_cast<char>(0x80 | payload.size()), 0, 0, 0, 0} + payload);
}

std::optional<std::string> WebSocketClient::next(double timeout) {
  const auto whole = static_cast<time_t>(timeout);
  const timeval time{whole, static_cast<suseconds_t>((timeout - static_cast<double>(whole)) * 1e6)};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
  while (true) {
    if (!fill(2)) return {};
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(buffer_[i]); };
    const bool last = (byte(0) & 0x80) != 0;
    const int opcode = byte(0) & 0x0F;
    std::size_t length = byte(1) & 0x7F, head = 2;
    if (length >= 126) {
      const std::size_t width = length == 126 ? 2 : 8;
      if (!fill(head + width)) return {};
      length = 0;
      for (std::size_t i = 0; i < width; ++i) length = length << 8 | byte(head + i);
      head += width;
    }
    if (length > longest_frame || !fill(head + length)) return {};
    const auto payload = buffer_.substr(head, length);
    buffer_.erase(0, head + length);
    if (opcode == opcode_close) return {};
    if (opcode == opcode_ping && payload.size() <= 125) pong(payload);
    if (opcode > opcode_binary) continue;
    message_ += payload;
    if (last) return std::exchange(message_, {});
  }
}

std::uint16_t free_port() {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  auto address = loopback(0);
  socklen_t size = sizeof address;
  ::bind(fd, reinterpret_cast<const sockaddr*>(&address), size);
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(fd);
  return ntohs(address.sin_port);
}

}  // namespace trunnion::http_client
