// SPDX-License-Identifier: Apache-2.0
// The socket by which the command line holds the right to operate: a file of the run directory, which only
// the user of the cluster can reach. A command sends one line {"name": "...", "take_over": false}, reads one
// line
// {"holder": "..."} (empty: it operates), and holds the right until it closes the connection.
#pragma once

#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <set>
#include <string>

#include "operators/operating_control.hpp"

namespace trunnion::gateway {

class CommandSocket {
 public:
  /// Does nothing when every station operates. Throws std::runtime_error when `path` cannot be made.
  CommandSocket(boost::asio::io_context& context, const std::string& path, OperatingControl& operating);

 private:
  struct Command;
  void accept();
  void renew();
  boost::asio::local::stream_protocol::acceptor acceptor_;
  boost::asio::steady_timer timer_, pause_;
  OperatingControl& operating_;
  std::set<std::shared_ptr<Command>> commands_;
  std::uint64_t count_ = 0;
};

}  // namespace trunnion::gateway
