// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "core/connections.hpp"
#include "http/listen.hpp"
#include "http/transport.hpp"
#include "text/instant.hpp"

namespace trunnion::gateway::mtconnect {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = net::ip::tcp;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

namespace {

constexpr milliseconds observed_every{50}, between_streams{10};
constexpr std::chrono::seconds timeout{30};
constexpr std::size_t most_sessions = 64;
constexpr rlim_t descriptors_for_http = 16;  // the last ones: a stop order comes by HTTP
constexpr const char* boundary = "trunnion-mtconnect-part";

std::string now() {
  const std::chrono::nanoseconds time = std::chrono::system_clock::now().time_since_epoch();
  return text::instant(static_cast<std::uint64_t>(time.count()));
}

class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket&& socket, const Agent& agent)
      : stream_(std::move(socket)), peer_(stream_.peer()), timer_(stream_.get_executor()), agent_(agent) {}

  const std::string& peer() const { return peer_; }
  /// Another connection takes its place.
  void close() {
    stream_.close();
    timer_.cancel();
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(8 << 10);
    parser_->body_limit(0);
    stream_.expires_after(timeout);
    http::async_read_header(stream_, buffer_, *parser_,
                            Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) return self->answer();
                              if (error == http::error::header_limit)
                                self->refuse(431, "the header is too large");
                            }));
  }

 private:
  void refuse(unsigned status, const char* why) {
    keep_alive_ = false;
    send(status, agent_.error({status, "INVALID_REQUEST", why}, now()));
  }

  void answer() {
    const auto& message = parser_->get();
    keep_alive_ = message.keep_alive() && (!parser_->content_length() || *parser_->content_length() == 0) &&
                  !message.chunked();
    try {
      const std::string method(message.method_string()), target(message.target());
      request_ = agent_.parse(method, target);
      if (request_.interval) return begin_stream();
      send(200, agent_.answer(request_, now()));
    } catch (const RequestError& error) {
      send(error.status, agent_.error(error, now()));
    }
  }

  void send(unsigned status, std::string document) {
    response_ = {static_cast<http::status>(status), 11};
    response_.set(http::field::content_type, "text/xml; charset=utf-8");
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.keep_alive(keep_alive_);
    response_.body() = std::move(document);
    response_.prepare_payload();
    stream_.expires_after(timeout);
    http::async_write(stream_, response_,
                      Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return;
                        if (self->keep_alive_) return self->read();
                        self->stream_.finish();
                      }));
  }

  // --- Streams: a document each interval with what is new, an empty one after the heartbeat.

  void begin_stream() {
    const auto& buffer =
        agent_.device() != nullptr
            ? agent_.buffer()
            : throw RequestError(503, "INTERNAL_ERROR",
                                 "the machine has not published its parameters and channels yet");
    next_ = request_.from.value_or(buffer.first());
    // Refused before the stream begins.
    auto part = agent_.part(request_, next_, now());
    const std::string head =
        std::string("HTTP/1.1 200 OK\r\nConnection: close\r\nCache-Control: no-store\r\n") +
        "Content-Type: multipart/x-mixed-replace;boundary=" + boundary + "\r\n\r\n";
    send_part(head, std::move(part));
  }

  void send_part(const std::string& before, Agent::Part part) {
    next_ = part.next;
    sent_ = Clock::now();
    text_ = before + "--" + boundary +
            "\r\nContent-Type: text/xml\r\nContent-Length: " + std::to_string(part.document.size()) +
            "\r\n\r\n" + part.document + "\r\n";
    stream_.expires_after(timeout);
    net::async_write(stream_, net::buffer(text_),
                     Transferred([self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->wait();
                     }));
  }

  void wait() {
    stream_.expires_never();
    const auto interval = std::max(milliseconds(*request_.interval), between_streams);
    timer_.expires_at(sent_ + interval);
    timer_.async_wait([self = shared_from_this()](beast::error_code error) {
      if (!error) self->continue_stream();
    });
  }

  void continue_stream() {
    try {
      const auto instance_changed = next_ > agent_.buffer().next();
      if (instance_changed) next_ = agent_.buffer().first();
      const auto before = next_;
      auto part = agent_.part(request_, next_, now());
      if (part.any || request_.kind == Kind::current ||
          Clock::now() - sent_ >= milliseconds(request_.heartbeat))
        return send_part("", std::move(part));
      next_ = std::max(before, part.next);
      // Nothing new: look again at the next state, not only after the interval.
      timer_.expires_after(between_streams);
      timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error) self->continue_stream();
      });
    } catch (const RequestError& error) {
      // The client is so slow that the buffer has lost what it is to have next.
      text_ = std::string("--") + boundary + "\r\nContent-Type: text/xml\r\n\r\n" +
              agent_.error(error, now()) + "\r\n--" + boundary + "--\r\n";
      net::async_write(stream_, net::buffer(text_),
                       Transferred([self = shared_from_this()](beast::error_code, std::size_t) {
                         self->stream_.finish();
                       }));
    }
  }

  Transport stream_;
  const std::string peer_;
  net::steady_timer timer_;
  const Agent& agent_;
  beast::flat_buffer buffer_;
  boost::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
  bool keep_alive_ = false;
  Request request_;
  std::uint64_t next_ = 0;
  Clock::time_point sent_;
  std::string text_;
};

}  // namespace

struct Server::Inside {
  Inside(const std::string& address, std::uint16_t port, Mailbox& from, AgentSettings settings)
      : acceptor(context), timer(context), mailbox(from), agent(std::move(settings)) {
    listen_on(acceptor, address, port);
    observe();
    accept();
    thread = std::thread([this] { context.run(); });
  }
  ~Inside() {
    context.stop();
    thread.join();
  }

  void observe() {
    if (const auto cluster = mailbox.newest(); cluster && cluster != observed) {
      observed = cluster;
      agent.observe(*cluster, now());
    }
    timer.expires_after(observed_every);
    timer.async_wait([this](const boost::system::error_code& error) {
      if (!error) observe();
    });
  }

  void accept() {
    acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
      if (error == net::error::operation_aborted) return;
      make_room(error || missing_from_reserve(socket, descriptors_for_http) > 0 ? 1 : most_sessions);
      if (!error) {
        boost::system::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        const auto session = std::make_shared<Session>(std::move(socket), agent);
        sessions.push_back(session);
        session->read();
      }
      if (!error) return accept();
      pause.expires_after(milliseconds(100));
      pause.async_wait([this](const boost::system::error_code& stopped) {
        if (!stopped) accept();
      });
    });
  }

  /// When there are `most`, the oldest of the peer with most gives way.
  void make_room(std::size_t most) {
    std::erase_if(sessions, [](const auto& session) { return session.expired(); });
    if (sessions.size() < most) return;
    std::vector<Connection> connections;
    for (const auto& session : sessions) connections.push_back({session.lock()->peer(), Activity::streaming});
    const auto chosen = one_to_close(connections);
    if (!chosen) return;
    sessions[*chosen].lock()->close();
    sessions.erase(sessions.begin() + static_cast<std::ptrdiff_t>(*chosen));
  }

  net::io_context context{1};
  tcp::acceptor acceptor;
  net::steady_timer timer, pause{context};
  Mailbox& mailbox;
  Agent agent;
  std::shared_ptr<const ClusterState> observed;
  std::vector<std::weak_ptr<Session>> sessions;
  std::thread thread;
};

Server::Server(const std::string& address, std::uint16_t port, Mailbox& mailbox, AgentSettings settings)
    : inside_(std::make_unique<Inside>(address, port, mailbox, std::move(settings))) {}
Server::~Server() = default;

}  // namespace trunnion::gateway::mtconnect
