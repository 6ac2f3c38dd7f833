// SPDX-License-Identifier: Apache-2.0
#include "http_client/client.hpp"

#include <arpa/inet.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
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

timeval time_of(double seconds) {
  const auto whole = static_cast<time_t>(seconds);
  return {whole, static_cast<suseconds_t>((seconds - static_cast<double>(whole)) * 1e6)};
}

int connect_to(const Server& server, int receive_buffer) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  if (receive_buffer > 0) setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  const auto timeout = time_of(server.timeout);
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
  if (!server.source.empty()) {
    auto from = loopback(0);
    inet_pton(AF_INET, server.source.c_str(), &from.sin_addr);
    ::bind(fd, reinterpret_cast<const sockaddr*>(&from), sizeof from);
  }
  const auto address = loopback(server.port);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd);
    return -1;
  }
  return fd;
}

}  // namespace

class Link {
 public:
  explicit Link(const Server& server, int receive_buffer = 0) : socket_(connect_to(server, receive_buffer)) {
    if (socket_ >= 0 && server.tls && !begin_tls(server)) end();
  }
  ~Link() { end(); }
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  bool open() const { return socket_ >= 0; }

  void send(const std::string& text) {
    for (std::size_t sent = 0; sent < text.size();) {
      const auto left = text.size() - sent;
      const auto n = ssl_ ? ssize_t{SSL_write(ssl_.get(), text.data() + sent, static_cast<int>(left))}
                          : ::send(socket_, text.data() + sent, left, MSG_NOSIGNAL);
      if (n <= 0) return;  // the answer tells why the other side stopped reading
      sent += static_cast<std::size_t>(n);
    }
  }

  /// Appends what has come to `text`; false when nothing did in time, or the other side has closed.
  bool receive(std::string& text) {
    char part[65536];
    const auto n =
        ssl_ ? ssize_t{SSL_read(ssl_.get(), part, sizeof part)} : ::recv(socket_, part, sizeof part, 0);
    if (n > 0) text.append(part, static_cast<std::size_t>(n));
    return n > 0;
  }

  void wait_at_most(double seconds) {
    const auto time = time_of(seconds);
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
  }

 private:
  struct Free {
    void operator()(SSL* ssl) const { SSL_free(ssl); }
    void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
  };

  bool begin_tls(const Server& server) {
    ::signal(SIGPIPE, SIG_IGN);  // OpenSSL writes to a socket without MSG_NOSIGNAL
    context_.reset(SSL_CTX_new(TLS_client_method()));
    if (!server.authority.empty()) {
      SSL_CTX_set_verify(context_.get(), SSL_VERIFY_PEER, nullptr);
      if (SSL_CTX_load_verify_locations(context_.get(), server.authority.c_str(), nullptr) != 1) return false;
      X509_VERIFY_PARAM_set1_ip_asc(SSL_CTX_get0_param(context_.get()), "127.0.0.1");
    }
    ssl_.reset(SSL_new(context_.get()));
    return SSL_set_fd(ssl_.get(), socket_) == 1 && SSL_connect(ssl_.get()) == 1;
  }

  void end() {
    ssl_.reset();
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }

  int socket_;
  std::unique_ptr<SSL_CTX, Free> context_;
  std::unique_ptr<SSL, Free> ssl_;
};

std::string raw_exchange(const Server& server, const std::string& text) {
  Link link(server);
  if (!link.open()) return {};
  link.send(text);
  std::string answer;
  while (link.receive(answer)) continue;
  return answer;
}

void send_and_go(const Server& server, const std::string& text) {
  Link link(server);
  if (link.open()) link.send(text);
}

Response request(const Server& server, const std::string& method, const std::string& target,
                 const std::string& body, const std::string& headers) {
  const bool has_length = headers.find("Content-Length") != std::string::npos;
  const auto answer = raw_exchange(
      server, method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port) +
                  "\r\nConnection: close\r\n" +
                  (has_length ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + headers +
                  "\r\n" + body);
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

WebSocketClient::WebSocketClient(const Server& server, const std::string& path, int receive_buffer,
                                 const std::string& headers)
    : link_(std::make_unique<Link>(server, receive_buffer)) {
  if (!link_->open()) return;
  link_->send("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port) +
              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
              headers + "\r\n");
  while (buffer_.find("\r\n\r\n") == std::string::npos)
    if (!fill(buffer_.size() + 1)) return;
  // RFC 6455, section 1.3 gives the answer to this key.
  open_ = buffer_.starts_with("HTTP/1.1 101") &&
          buffer_.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") != std::string::npos;
  buffer_.erase(0, buffer_.find("\r\n\r\n") + 4);
}

WebSocketClient::~WebSocketClient() = default;

bool WebSocketClient::fill(std::size_t bytes) {
  while (buffer_.size() < bytes)
    if (!link_->receive(buffer_)) return false;
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
  link_->send(frame + std::string(4, '\0') + text);
}

void WebSocketClient::pong(const std::string& payload) {
  // A client masks what it sends (RFC 6455, 5.3); a mask of zeros leaves it as it is.
  link_->send(std::string{'\x8A', static_cast<char>(0x80 | payload.size()), 0, 0, 0, 0} + payload);
}

std::optional<std::string> WebSocketClient::next(double timeout) {
  if (!link_->open()) return {};
  link_->wait_at_most(timeout);
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
