// SPDX-License-Identifier: Apache-2.0
#include "cluster/operating_station.hpp"

#include <pwd.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cluster/cluster_files.hpp"

namespace trunnion::cluster {
namespace {

constexpr int longest_wait = 2;  // s: a gateway that does not answer must not be in the way

std::string login_name() {
  const auto* user = getpwuid(getuid());
  return user != nullptr ? user->pw_name : std::to_string(getuid());
}

std::string exchange(int socket, const std::string& line) {
  std::string answer;
  if (::send(socket, line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size()))
    return answer;
  char part[256];
  while (answer.find('\n') == std::string::npos) {
    const auto count = ::recv(socket, part, sizeof part, 0);
    if (count <= 0) break;
    answer.append(part, static_cast<std::size_t>(count));
  }
  return answer;
}

}  // namespace

std::string operating_socket(std::uint32_t domain) {
  return RunDirectory{domain}.path() + "/operating.socket";
}

OperatingStation::OperatingStation(std::uint32_t domain, bool take_over) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const auto path = operating_socket(domain);
  if (path.size() >= sizeof address.sun_path) return;
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0) return;
  const timeval wait{longest_wait, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return;
  const nlohmann::json question = {{"name", "command line of " + login_name()}, {"take_over", take_over}};
  const auto text = question.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  const auto answer = nlohmann::json::parse(exchange(socket_, text), nullptr, false);
  if (!answer.is_object() || !answer.contains("holder") || !answer["holder"].is_string()) return;
  const std::string holder = answer["holder"];
  if (holder.empty()) return;
  ::close(socket_);
  socket_ = -1;
  throw std::runtime_error(holder + " operates this machine; --take-right takes the right to operate over");
}

OperatingStation::~OperatingStation() {
  if (socket_ >= 0) ::close(socket_);
}

}  // namespace trunnion::cluster
