// SPDX-License-Identifier: Apache-2.0
#include "http/server.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <stdexcept>
#include <thread>

#include "http/session.hpp"

namespace trunnion::gateway {

namespace net = boost::asio;
using tcp = net::ip::tcp;

struct HttpServer::Inside {
  static constexpr long most_connections = 128;

  Inside(const std::string& address, std::uint16_t port, Api& served)
      : acceptor(context), pause(context), api(served), hub(context, served.mailbox()) {
    const std::string where = address + ":" + std::to_string(port);
    boost::system::error_code error;
    const auto parsed = net::ip::make_address(address, error);
    if (error) throw std::runtime_error("'" + address + "' is not an address");
    const tcp::endpoint endpoint(parsed, port);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
    if (error) throw std::runtime_error("cannot listen on " + where + ": " + error.message());
    hub.start();
    accept();
    thread = std::thread([this] { context.run(); });
  }

  void accept() {
    acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket socket) {
      if (error == net::error::operation_aborted) return;
      if (error) {
        // Out of file descriptors, most likely: trying again at once would only burn the processor.
        pause.expires_after(std::chrono::milliseconds(100));
        pause.async_wait([this](const boost::system::error_code& stopped) {
          if (!stopped) accept();
        });
        return;
      }
      if (connections.use_count() <= most_connections) {
        boost::system::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<HttpSession>(std::move(socket), api, hub, connections)->start();
      }
      accept();
    });
  }

  void stop() {
    context.stop();
    if (thread.joinable()) thread.join();
  }

  // Sessions die with the context and look at what is declared before it.
  std::shared_ptr<int> connections = std::make_shared<int>(0);
  net::io_context context{1};
  tcp::acceptor acceptor;
  net::steady_timer pause;
  Api& api;
  StreamHub hub;
  std::thread thread;
};

HttpServer::HttpServer(const std::string& address, std::uint16_t port, Api& api)
    : inside_(std::make_unique<Inside>(address, port, api)) {}

HttpServer::~HttpServer() { stop(); }

void HttpServer::stop() { inside_->stop(); }

std::size_t HttpServer::clients() const { return inside_->hub.size(); }

}  // namespace trunnion::gateway
