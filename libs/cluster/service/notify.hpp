// SPDX-License-Identifier: Apache-2.0
// What a process started by systemd (Type=notify, WatchdogSec) reports to it: datagrams to a socket named by
// the environment, as sd_notify(3) describes them. Without that environment nothing is sent.
#pragma once

#include <string>

namespace trunnion::service {

class Notifier {
 public:
  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID, and takes them out of the environment: they are
  /// about this process, not of those it starts.
  Notifier();
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  /// Once, when the process does what it is for.
  void ready();
  /// The process has begun to end.
  void stopping();
  /// One line for `systemctl status`; sent when it is another than the last.
  void status(const std::string& text);
  /// Call in every turn of the loop whose standstill is a failure: pings at half of the time systemd waits.
  /// `now` is monotonic, in seconds.
  void alive(double now);

 private:
  void send(const std::string& message);
  int socket_ = -1;
  std::string path_;   // an initial 0 means the abstract name space
  double period_ = 0;  // s between pings; 0: no watchdog
  double pinged_ = -1e9;
  bool ready_ = false;
  std::string status_;
};

}  // namespace trunnion::service
