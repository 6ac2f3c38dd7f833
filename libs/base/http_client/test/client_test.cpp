// SPDX-License-Identifier: Apache-2.0
#include "http_client/client.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

namespace trunnion::http_client {
namespace {

// Answers one connection with fixed bytes, after the request's head has come, and keeps what it was sent.
class OneAnswer {
 public:
  explicit OneAnswer(std::string answer) : answer_(std::move(answer)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(listener_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(listener_, 1), 0);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~OneAnswer() { join(); }
  OneAnswer(const OneAnswer&) = delete;
  OneAnswer& operator=(const OneAnswer&) = delete;
  std::uint16_t port() const { return port_; }
  const std::string& received() {
    join();
    return received_;
  }

 private:
  void join() {
    if (thread_.joinable()) thread_.join();
    if (listener_ >= 0) ::close(std::exchange(listener_, -1));
  }
  void serve() {
    const int connection = ::accept(listener_, nullptr, nullptr);
    char part[4096];
    while (received_.find("\r\n\r\n") == std::string::npos) {
      const auto n = ::recv(connection, part, sizeof part, 0);
      if (n <= 0) break;
      received_.append(part, static_cast<std::size_t>(n));
    }
    EXPECT_EQ(::send(connection, answer_.data(), answer_.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(answer_.size()));
    ::shutdown(connection, SHUT_WR);
    while (true) {  // what the client sends until it closes
      const auto n = ::recv(connection, part, sizeof part, 0);
      if (n <= 0) break;
      received_.append(part, static_cast<std::size_t>(n));
    }
    ::close(connection);
  }
  std::string answer_, received_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

// RFC 6455, section 1.3: the answer to the key that the client always sends.
const std::string upgraded =
    "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n\r\n";

TEST(HttpClient, ReadsStatusHeadersAndBody) {
  OneAnswer server(
      "HTTP/1.1 404 Not Found\r\nContent-Type:  text/plain\r\nX-EMPTY:\r\n\r\nno such\r\n\r\nthing");
  const auto response = request(server.port(), "GET", "/nowhere");
  EXPECT_EQ(response.status, 404);
  EXPECT_EQ(response.headers.at("content-type"), "text/plain");
  EXPECT_EQ(response.body, "no such\r\n\r\nthing");
  EXPECT_TRUE(server.received().starts_with("GET /nowhere HTTP/1.1\r\n")) << server.received();
}

TEST(HttpClient, SendsTheLengthOfItsBody) {
  OneAnswer server("HTTP/1.1 204 No Content\r\n\r\n");
  EXPECT_EQ(request(server.port(), "PUT", "/x", "12345", "X-Own: yes\r\n").status, 204);
  EXPECT_NE(server.received().find("Content-Length: 5\r\n"), std::string::npos);
  EXPECT_NE(server.received().find("X-Own: yes\r\n"), std::string::npos);
  EXPECT_TRUE(server.received().ends_with("\r\n\r\n12345"));
}

TEST(HttpClient, NoServerOrNoHttpIsStatusZero) {
  EXPECT_EQ(request(free_port(), "GET", "/").status, 0);
  OneAnswer server("SSH-2.0-OpenSSH_9.2\r\n\r\n");
  EXPECT_EQ(request(server.port(), "GET", "/").status, 0);
}

TEST(WebSocketClient, JoinsFragmentsSkipsPongsAndAnswersPings) {
  OneAnswer server(upgraded + std::string{"\x01\x03one", 5} + std::string{"\x8A\x00", 2} +
                   std::string{"\x89\x02hi", 4} + std::string{"\x80\x03two", 5} +
                   std::string{"\x81\x05three", 7} + std::string{"\x88\x00", 2});
  {
    WebSocketClient client(server.port(), "/api/stream");
    ASSERT_TRUE(client.open());
    EXPECT_EQ(client.next(), "onetwo");
    EXPECT_EQ(client.next(), "three");
    EXPECT_EQ(client.next(), std::nullopt) << "closed by the server";
  }
  // RFC 6455, 5.5.3: the pong carries the ping's bytes; masked with zeros they are the same.
  EXPECT_NE(server.received().find(std::string("\x8A\x82\0\0\0\0hi", 8)), std::string::npos);
}

TEST(WebSocketClient, ReadsLengthsOfTwoAndEightBytes) {
  const std::string medium(300, 'm'), large(70000, 'l');
  OneAnswer server(upgraded + std::string{"\x81\x7E\x01\x2C", 4} + medium +
                   std::string{"\x81\x7F\0\0\0\0\0\x01\x11\x70", 10} + large);
  WebSocketClient client(server.port(), "/");
  EXPECT_EQ(client.next(), medium);
  EXPECT_EQ(client.next(), large);
}

TEST(WebSocketClient, IsNotOpenWhenTheUpgradeIsRefused) {
  OneAnswer server("HTTP/1.1 403 Forbidden\r\n\r\n");
  EXPECT_FALSE(WebSocketClient(server.port(), "/api/stream").open());
}

}  // namespace
}  // namespace trunnion::http_client
