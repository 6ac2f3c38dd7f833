// SPDX-License-Identifier: Apache-2.0
// The other side of Modbus TCP, from the specification alone (MODBUS Messaging on TCP/IP V1.0b, MODBUS
// Application Protocol V1.1b3): bytes on sockets.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace trunnion::plc {

using Bytes = std::vector<std::uint8_t>;

inline std::uint16_t word(const Bytes& bytes, std::size_t i) {
  return static_cast<std::uint16_t>(bytes.at(i) << 8 | bytes.at(i + 1));
}
inline void put(Bytes& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8)), bytes.push_back(static_cast<std::uint8_t>(value));
}
/// The header before a function and its data.
inline Bytes framed(unsigned transaction, unsigned unit, const Bytes& data) {
  Bytes frame;
  put(frame, transaction), put(frame, 0), put(frame, static_cast<unsigned>(data.size() + 1));
  frame.push_back(static_cast<std::uint8_t>(unit));
  frame.insert(frame.end(), data.begin(), data.end());
  return frame;
}

/// Exactly `count` bytes; nothing when the other side ends or is silent for two seconds.
inline std::optional<Bytes> receive(int socket, std::size_t count) {
  Bytes bytes;
  while (bytes.size() < count) {
    pollfd one{socket, POLLIN, 0};
    if (poll(&one, 1, 2000) <= 0) return std::nullopt;
    Bytes part(count - bytes.size());
    const auto got = read(socket, part.data(), part.size());
    if (got <= 0) return std::nullopt;
    bytes.insert(bytes.end(), part.begin(), part.begin() + got);
  }
  return bytes;
}
inline void send_all(int socket, const Bytes& bytes) {
  if (send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return;
}

inline int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET, address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  socklen_t size = sizeof address;
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  close(socket);
  return ntohs(address.sin_port);
}

/// Asks a server.
class Asking {
 public:
  /// `unread`: bytes of answers that are taken before somebody reads them; 0 = as the system has it.
  explicit Asking(int port, int unread = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (unread > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &unread, sizeof unread);
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    for (int i = 0; i < 100 && !connected_; ++i) {
      connected_ = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
      if (!connected_) usleep(20000);
    }
  }
  ~Asking() { close(socket_); }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

  bool connected() const { return connected_; }
  void send_bytes(const Bytes& bytes) { send_all(socket_, bytes); }
  /// False when the connection is broken, or nobody takes the bytes for as long as an answer may take.
  bool sends(const Bytes& bytes) const {
    pollfd one{socket_, POLLOUT, 0};
    return poll(&one, 1, 2000) > 0 &&
           send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) > 0;
  }
  /// A frame with its header; empty when there is none.
  Bytes next() const {
    auto frame = receive(socket_, 7).value_or(Bytes{});
    const auto rest = frame.empty() ? std::nullopt : receive(socket_, word(frame, 4) - 1u);
    if (!rest) return {};
    frame.insert(frame.end(), rest->begin(), rest->end());
    return frame;
  }
  /// Function and data of the answer; empty when there is none.
  Bytes ask(const Bytes& data) {
    ++transaction_;
    send_all(socket_, framed(transaction_, 1, data));
    const auto frame = next();
    if (frame.empty() || word(frame, 0) != transaction_ || word(frame, 2) != 0) return {};
    return {frame.begin() + 7, frame.end()};
  }

 private:
  int socket_;
  bool connected_ = false;
  unsigned transaction_ = 0;
};

/// A device that is asked: one connection after the other, until stop().
class Device {
 public:
  explicit Device(int port) : port_(port) { start(); }
  ~Device() { stop(); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  void start() {
    listening_ = ::socket(AF_INET, SOCK_STREAM, 0);
    const int on = 1;
    setsockopt(listening_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    ASSERT_EQ(bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(listen(listening_, 4), 0);
    ends_ = false;
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
    if (listening_ >= 0) close(listening_);
    listening_ = -1;
  }

  std::mutex mutex;
  std::array<bool, 64> inputs{}, coils{};
  std::array<std::uint16_t, 64> input_registers{}, holding_registers{};
  /// Changes the bytes of an answer before they are sent.
  std::function<Bytes(Bytes)> spoil;

 private:
  void serve() {
    int client = -1;
    while (!ends_) {
      std::array<pollfd, 2> both = {{{listening_, POLLIN, 0}, {client, POLLIN, 0}}};
      if (poll(both.data(), client >= 0 ? 2 : 1, 20) <= 0) continue;
      if (both[0].revents != 0) {
        if (client >= 0) close(client);
        client = accept(listening_, nullptr, nullptr);
        continue;
      }
      const auto header = receive(client, 7);
      const auto data = header ? receive(client, word(*header, 4) - 1u) : std::nullopt;
      if (!data) {
        close(client), client = -1;
        continue;
      }
      const std::lock_guard lock(mutex);
      auto bytes = framed(word(*header, 0), (*header)[6], answer(*data));
      if (spoil) bytes = spoil(bytes);
      send_all(client, bytes);
    }
    if (client >= 0) close(client);
  }

  Bytes answer(const Bytes& data) {
    const auto function = data[0];
    const auto address = word(data, 1), count = word(data, 3);
    Bytes result = {function};
    if (address + count > 64) return {static_cast<std::uint8_t>(function | 0x80), 2};
    if (function == 1 || function == 2) {
      result.push_back(static_cast<std::uint8_t>((count + 7) / 8));
      result.resize(2u + result[1], 0);
      for (std::size_t i = 0; i < count; ++i)
        if ((function == 1 ? coils : inputs).at(address + i))
          result[2 + i / 8] |= static_cast<std::uint8_t>(1u << i % 8);
    } else if (function == 3 || function == 4) {
      result.push_back(static_cast<std::uint8_t>(2 * count));
      for (std::size_t i = 0; i < count; ++i)
        put(result, (function == 3 ? holding_registers : input_registers).at(address + i));
    } else if (function == 15) {
      for (std::size_t i = 0; i < count; ++i) coils.at(address + i) = (data.at(6 + i / 8) >> i % 8 & 1) != 0;
      put(result, address), put(result, count);
    } else if (function == 16) {
      for (std::size_t i = 0; i < count; ++i) holding_registers.at(address + i) = word(data, 6 + 2 * i);
      put(result, address), put(result, count);
    } else {
      return {static_cast<std::uint8_t>(function | 0x80), 1};
    }
    return result;
  }

  int port_, listening_ = -1;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace trunnion::plc
