// SPDX-License-Identifier: Apache-2.0
#include "service/notify.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace trunnion::service {
namespace {

std::string take_from_environment(const char* name) {
  const char* value = std::getenv(name);
  std::string text = value != nullptr ? value : "";
  unsetenv(name);
  return text;
}

}  // namespace

Notifier::Notifier() : path_(take_from_environment("NOTIFY_SOCKET")) {
  const auto watchdog = take_from_environment("WATCHDOG_USEC");
  const auto process = take_from_environment("WATCHDOG_PID");
  if (path_.empty() || path_.size() >= sizeof(sockaddr_un::sun_path)) return;
  if (path_.front() == '@') path_.front() = '\0';
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (process.empty() || std::atol(process.c_str()) == getpid())
    period_ = std::atof(watchdog.c_str()) * 1e-6 / 2;
}

Notifier::~Notifier() {
  if (socket_ >= 0) close(socket_);
}

void Notifier::send(const std::string& message) {
  if (socket_ < 0) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path_.data(), path_.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path_.size());
  // A manager that is gone or does not read is no reason to stop.
  (void)sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(&address), size);
}

void Notifier::ready() {
  if (ready_) return;
  ready_ = true;
  send("READY=1");
}

void Notifier::stopping() { send("STOPPING=1"); }

void Notifier::status(const std::string& text) {
  if (text == status_) return;
  status_ = text;
  send("STATUS=" + text);
}

void Notifier::alive(double now) {
  if (period_ <= 0 || now - pinged_ < period_) return;
  pinged_ = now;
  send("WATCHDOG=1");
}

}  // namespace trunnion::service
