// SPDX-License-Identifier: Apache-2.0
#include "http/server.hpp"

#include <pthread.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "http/command_socket.hpp"
#include "http/listen.hpp"
#include "http/session.hpp"

namespace trunnion::gateway {

namespace net = boost::asio;
using tcp = net::ip::tcp;

namespace {

constexpr rlim_t descriptors_for_others = 8;  // files of the page and the users, the bus

}  // namespace

struct HttpServer::Inside {
  Inside(const std::string& address, std::uint16_t port, Api& served, Site own,
         const std::string& command_socket, TlsCertificate* own_certificate)
      : acceptor(context),
        pause(context),
        api(served),
        site(std::move(own)),
        certificate(own_certificate),
        hub(context, served.mailbox()),
        commands(context, command_socket, served.operating()) {
    listen_on(acceptor, address, port);
    hub.start();
    accept();
    thread = std::thread([this] {
      pthread_setname_np(pthread_self(), "gateway-http");
      context.run();
    });
  }

  void accept() {
    acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
      if (error == net::error::operation_aborted) return;
      if (error) {
        // Out of file descriptors, most likely: trying again at once would only burn the processor.
        make_room(true);
        pause.expires_after(std::chrono::milliseconds(5));
        pause.async_wait([this](const boost::system::error_code& stopped) {
          if (!stopped) accept();
        });
        return;
      }
      admit(std::move(socket));
    });
  }

  void admit(tcp::socket socket) {
    // Others may have taken some of the reserve since the last connection, so as many close as are missing.
    auto missing = missing_from_reserve(socket, descriptors_for_others + transferring());
    const bool has_room = make_room(missing > 0);
    while (has_room && missing > 1 && make_room(true)) --missing;
    if (!has_room) {
      // What has arrived is read meanwhile.
      pause.expires_after(std::chrono::milliseconds(1));
      pause.async_wait([this, socket = std::move(socket)](const boost::system::error_code& stopped) mutable {
        if (!stopped) admit(std::move(socket));
      });
      return;
    }
    boost::system::error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    Transport transport(std::move(socket), certificate != nullptr ? certificate->context() : nullptr);
    const auto session = std::make_shared<HttpSession>(std::move(transport), api, hub, site);
    sessions.push_back(session);
    session->start();
    accept();
  }

  /// Sessions for which another thread may just be about to open a file.
  rlim_t transferring() const {
    return static_cast<rlim_t>(std::ranges::count_if(sessions, [](const auto& session) {
      const auto one = session.lock();
      return one && one->connection().activity == Activity::transferring;
    }));
  }

  /// Whether there is some now. When file descriptors are short, a stream may give way, too.
  bool make_room(bool is_short) {
    // The last to hold a session may be another thread, which answers it, so it is looked up only once.
    std::vector<std::shared_ptr<HttpSession>> held;
    std::erase_if(sessions, [&](const auto& session) {
      auto one = session.lock();
      if (!one) return true;
      held.push_back(std::move(one));
      return false;
    });
    if (sessions.size() < most_connections && !is_short) return true;
    std::vector<Connection> connections;
    if (is_short) connections = hub.connections();
    const auto streams = connections.size();
    for (const auto& session : held) connections.push_back(session->connection());
    if (connections.empty()) return true;  // others have the descriptors, and one is left
    const auto chosen = one_to_close(connections);
    if (!chosen) return false;
    if (*chosen < streams) {
      hub.close(*chosen);
      return true;
    }
    held[*chosen - streams]->close();
    sessions.erase(sessions.begin() + static_cast<std::ptrdiff_t>(*chosen - streams));
    return true;
  }

  void stop() {
    context.stop();
    if (thread.joinable()) thread.join();
  }

  std::vector<std::weak_ptr<HttpSession>> sessions;  // from the oldest on; streams are the hub's
  net::io_context context{1};
  tcp::acceptor acceptor;
  net::steady_timer pause;
  Api& api;
  const Site site;
  TlsCertificate* const certificate;
  StreamHub hub;
  CommandSocket commands;
  std::thread thread;
};

HttpServer::HttpServer(const std::string& address, std::uint16_t port, Api& api, Site site,
                       const std::string& command_socket, TlsCertificate* certificate)
    : inside_(std::make_unique<Inside>(address, port, api, std::move(site), command_socket, certificate)) {}

HttpServer::~HttpServer() { stop(); }

void HttpServer::stop() { inside_->stop(); }

void HttpServer::show() {
  net::post(inside_->context, [inside = inside_.get()] { inside->hub.show(); });
}

std::size_t HttpServer::clients() const { return inside_->hub.size(); }

}  // namespace trunnion::gateway
