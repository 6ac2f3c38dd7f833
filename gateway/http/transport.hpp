// SPDX-License-Identifier: Apache-2.0
// A connection of a client, in clear text or by TLS: what HTTP and WebSocket are read from and written to.
#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/role.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "http/once.hpp"

namespace boost::asio::ssl {
class context;
}

namespace trunnion::gateway {

/// An AsyncStream of Beast. Operations keep the connection until they end, also when the object is gone.
class Transport {
 public:
  using executor_type = boost::asio::ip::tcp::socket::executor_type;
  /// With a `context` it expects TLS.
  explicit Transport(boost::asio::ip::tcp::socket&& socket,
                     std::shared_ptr<boost::asio::ssl::context> context = nullptr);
  Transport(Transport&&) noexcept = default;
  ~Transport() = default;

  executor_type get_executor() const;
  /// Address of the other side, empty when it is gone.
  std::string peer() const;
  /// Whether bytes have arrived that were not read yet.
  bool has_unread() const;

  /// `done` once the connection can carry requests: at once in clear text, after the handshake by TLS. A
  /// client that does not begin with a handshake where TLS is expected is served in clear text (secure() is
  /// false), so that it can be told; the byte that it has sent is `first`.
  void begin(Once<boost::system::error_code, std::optional<char>> done);
  /// Whether it is encrypted.
  bool secure() const;
  /// Whether TLS was expected.
  bool wants_tls() const;

  /// The operations from now on fail when they are under way `time` from now.
  void expires_after(std::chrono::steady_clock::duration time);
  void expires_never();
  /// The kernel holds no more than this of what has not been taken.
  void limit_send_buffer(int bytes);

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    read_some(some<boost::asio::mutable_buffer>(buffers), Transferred(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    write_some(some<boost::asio::const_buffer>(buffers), Transferred(std::forward<Handler>(handler)));
  }

  /// Nothing more is sent; what was is delivered.
  void finish();
  /// The same for the end of a WebSocket.
  void finish(Done done);
  /// At once.
  void close();

 private:
  /// The first buffers of a sequence: a transfer of some bytes need not take all.
  template <class Buffer>
  struct Some {
    using value_type = Buffer;
    using const_iterator = const Buffer*;
    const_iterator begin() const { return list.data(); }
    const_iterator end() const { return list.data() + count; }
    std::array<Buffer, 16> list;
    std::size_t count = 0;
  };
  template <class Buffer, class Buffers>
  static Some<Buffer> some(const Buffers& buffers) {
    Some<Buffer> taken;
    const auto end = boost::asio::buffer_sequence_end(buffers);
    for (auto at = boost::asio::buffer_sequence_begin(buffers); at != end && taken.count < taken.list.size();
         ++at) {
      const Buffer buffer(*at);
      if (buffer.size() > 0) taken.list[taken.count++] = buffer;
    }
    return taken;
  }
  void read_some(const Some<boost::asio::mutable_buffer>& buffers, Transferred done);
  void write_some(const Some<boost::asio::const_buffer>& buffers, Transferred done);

  struct Inside;
  std::shared_ptr<Inside> inside_;
};

// What Beast asks of a stream of its own kind.

/// When a WebSocket has been silent for too long.
inline void beast_close_socket(Transport& transport) { transport.close(); }

inline void teardown(boost::beast::role_type, Transport& transport, boost::system::error_code& error) {
  transport.close();
  error = {};
}

template <class Handler>
void async_teardown(boost::beast::role_type, Transport& transport, Handler&& handler) {
  transport.finish(Done(std::forward<Handler>(handler)));
}

}  // namespace trunnion::gateway
