// SPDX-License-Identifier: Apache-2.0
#include "http/command_socket.hpp"

#include <unistd.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <filesystem>
#include <stdexcept>

namespace trunnion::gateway {

namespace net = boost::asio;
using local = net::local::stream_protocol;

namespace {

constexpr std::size_t most_commands = 32, longest_line = 512;
constexpr std::chrono::seconds renewal{1};
constexpr std::chrono::milliseconds pause{100};  // when there is no file descriptor for another command

}  // namespace

struct CommandSocket::Command {
  explicit Command(local::socket&& accepted) : socket(std::move(accepted)) {}
  local::socket socket;
  std::string incoming, outgoing;
  access::Station station;
  bool holds = false;
};

CommandSocket::CommandSocket(net::io_context& context, const std::string& path, OperatingControl& operating)
    : acceptor_(context), timer_(context), pause_(context), operating_(operating) {
  // Without a run directory there is no cluster that the command line would find.
  if (!operating.on() || path.empty() || !std::filesystem::exists(std::filesystem::path(path).parent_path()))
    return;
  ::unlink(path.c_str());  // of a gateway that was killed
  boost::system::error_code error;
  acceptor_.open(local(), error);
  if (!error) acceptor_.bind(local::endpoint(path), error);
  if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
  if (error) throw std::runtime_error("cannot listen on " + path + ": " + error.message());
  accept();
  renew();
}

void CommandSocket::accept() {
  acceptor_.async_accept([this](const boost::system::error_code& error, local::socket socket) {
    if (error == net::error::operation_aborted) return;
    if (error) {
      pause_.expires_after(pause);
      pause_.async_wait([this](const boost::system::error_code& ended) {
        if (!ended) accept();
      });
      return;
    }
    if (commands_.size() < most_commands) {
      const auto command = std::make_shared<Command>(std::move(socket));
      commands_.insert(command);
      const auto end = [this, command] {
        if (command->holds) operating_.release(command->station);
        commands_.erase(command);
      };
      net::async_read_until(command->socket, net::dynamic_buffer(command->incoming, longest_line), '\n',
                            [this, command, end](const boost::system::error_code& failed, std::size_t) {
                              const auto line = bus::Json::parse(command->incoming, nullptr, false);
                              if (failed || !line.is_object()) return end();
                              const auto name = line.contains("name") && line["name"].is_string()
                                                    ? line["name"].get<std::string>().substr(0, 64)
                                                    : std::string("command line");
                              command->station = {"command " + std::to_string(++count_), name, true};
                              const auto holder = operating_.take_for_command(
                                  command->station, line.value("take_over", bus::Json(false)) == true);
                              command->holds = holder.empty();
                              command->outgoing = bus::text_of({{"holder", holder}}) + "\n";
                              net::async_write(
                                  command->socket, net::buffer(command->outgoing),
                                  [command, end](const boost::system::error_code& broken, std::size_t) {
                                    if (broken) return end();
                                    command->incoming.assign(1, '\0');
                                    command->socket.async_read_some(
                                        net::buffer(command->incoming),
                                        [end](const boost::system::error_code&, std::size_t) { end(); });
                                  });
                            });
    }
    accept();
  });
}

void CommandSocket::renew() {
  timer_.expires_after(renewal);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) return;
    for (const auto& command : commands_)
      if (command->holds) operating_.present(command->station);
    renew();
  });
}

}  // namespace trunnion::gateway
