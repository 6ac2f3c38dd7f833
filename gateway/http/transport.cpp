// SPDX-License-Identifier: Apache-2.0
#include "http/transport.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/steady_timer.hpp>

namespace trunnion::gateway {

namespace net = boost::asio;
using tcp = net::ip::tcp;
using Clock = std::chrono::steady_clock;
using Error = boost::system::error_code;

namespace {

constexpr char handshake_record = 0x16;  // RFC 8446, 5.1: the first byte of TLS
constexpr std::chrono::seconds farewell{5};

}  // namespace

// Not the tcp_stream of Beast 1.74: TLS completes a write by a read of no bytes, which that takes for a
// second read beside the one under way.
struct Transport::Inside : std::enable_shared_from_this<Inside> {
  Inside(tcp::socket&& accepted, std::shared_ptr<net::ssl::context> with)
      : socket(std::move(accepted)), timer(socket.get_executor()), context(std::move(with)) {}

  void close() {
    Error ignored;
    socket.close(ignored);
  }

  /// An operation begins. What it returns ends it and has to be called first in its handler.
  void began() {
    if (++pending > 1 || deadline == Clock::time_point::max()) return;
    timer.expires_at(deadline);
    timer.async_wait([self = weak_from_this()](const Error& error) {
      const auto inside = self.lock();
      if (!error && inside && inside->pending > 0 && Clock::now() >= inside->deadline) inside->close();
    });
  }
  void ended() {
    if (--pending == 0) timer.cancel();
  }
  Transferred counted(Transferred done) {
    began();
    return [self = shared_from_this(), done = std::move(done)](Error error, std::size_t bytes) mutable {
      self->ended();
      done(error, bytes);
    };
  }

  tcp::socket socket;
  net::steady_timer timer;
  Clock::time_point deadline = Clock::time_point::max();
  int pending = 0;
  const std::shared_ptr<net::ssl::context> context;
  std::optional<net::ssl::stream<tcp::socket&>> tls;
  char first = 0;
};

Transport::Transport(tcp::socket&& socket, std::shared_ptr<net::ssl::context> context)
    : inside_(std::make_shared<Inside>(std::move(socket), std::move(context))) {}

Transport::executor_type Transport::get_executor() const { return inside_->socket.get_executor(); }

std::string Transport::peer() const {
  Error error;
  const auto peer = inside_->socket.remote_endpoint(error);
  return error ? std::string() : peer.address().to_string();
}

bool Transport::has_unread() const {
  Error error;
  return inside_->socket.available(error) > 0;
}

bool Transport::secure() const { return inside_->tls.has_value(); }

bool Transport::wants_tls() const { return inside_->context != nullptr; }

void Transport::begin(Once<Error, std::optional<char>> done) {
  if (!inside_->context) return done({}, std::nullopt);
  auto& inside = *inside_;
  read_some({{net::buffer(&inside.first, 1)}, 1},
            [self = inside_, done = std::move(done)](Error failed, std::size_t) mutable {
              if (failed) return done(failed, std::nullopt);
              if (self->first != handshake_record) return done({}, self->first);
              self->tls.emplace(self->socket, *self->context);
              auto then = self->counted(
                  [done = std::move(done)](Error error, std::size_t) mutable { done(error, std::nullopt); });
              self->tls->async_handshake(net::ssl::stream_base::server, net::const_buffer(&self->first, 1),
                                         std::move(then));
            });
}

void Transport::expires_after(Clock::duration time) { inside_->deadline = Clock::now() + time; }

void Transport::expires_never() { inside_->deadline = Clock::time_point::max(); }

void Transport::limit_send_buffer(int bytes) {
  Error ignored;
  inside_->socket.set_option(net::socket_base::send_buffer_size(bytes), ignored);
}

void Transport::read_some(const Some<net::mutable_buffer>& buffers, Transferred done) {
  auto then = inside_->counted(std::move(done));
  if (inside_->tls)
    inside_->tls->async_read_some(buffers, std::move(then));
  else
    inside_->socket.async_read_some(buffers, std::move(then));
}

void Transport::write_some(const Some<net::const_buffer>& buffers, Transferred done) {
  auto then = inside_->counted(std::move(done));
  if (inside_->tls)
    inside_->tls->async_write_some(buffers, std::move(then));
  else
    inside_->socket.async_write_some(buffers, std::move(then));
}

void Transport::finish() {
  finish([](Error) {});
}

void Transport::finish(Done done) {
  if (!inside_->tls) {
    Error error;
    inside_->socket.shutdown(tcp::socket::shutdown_send, error);
    return net::post(get_executor(), [error, done = std::move(done)]() mutable { done(error); });
  }
  expires_after(farewell);
  auto then = inside_->counted([self = inside_, done = std::move(done)](Error error, std::size_t) mutable {
    Error ignored;
    self->socket.shutdown(tcp::socket::shutdown_send, ignored);
    done(error);
  });
  inside_->tls->async_shutdown([then = std::move(then)](Error error) mutable { then(error, 0); });
}

void Transport::close() { inside_->close(); }

}  // namespace trunnion::gateway
