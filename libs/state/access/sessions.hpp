// SPDX-License-Identifier: Apache-2.0
// Who is logged in. Without clock and random numbers: both are given.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "access/role.hpp"

namespace trunnion::access {

struct Identity {
  std::string name;
  Role role = Role::machine_operator;
};

class Sessions {
 public:
  /// Seconds without a request, by default, and in all, after which a session ends.
  static constexpr double longest_idle = 1800, longest = 12 * 3600;
  /// A further one ends the one that has been idle longest.
  static constexpr std::size_t most = 256;

  /// `idle` in seconds without a request.
  explicit Sessions(double idle = longest_idle) : idle_(idle) {}

  /// `secret` is what the client shows from now on. `now` in seconds of a monotonic clock.
  void begin(const std::string& secret, Identity identity, double now);
  /// Nothing when there is no such session or its time is over; else its time begins again.
  std::optional<Identity> find(std::string_view secret, double now);
  /// The same without a new beginning: for what a page asks by itself.
  std::optional<Identity> look(std::string_view secret, double now) const;
  void end(std::string_view secret);
  /// All sessions of a user.
  void end_of(std::string_view name);
  std::size_t size() const { return sessions_.size(); }

 private:
  struct Session {
    Identity identity;
    double began = 0, used = 0;
  };
  bool is_over(const Session& session, double now) const {
    return now - session.used > idle_ || now - session.began > longest;
  }
  double idle_;
  std::map<std::string, Session, std::less<>> sessions_;  ///< by the digest of the secret
};

}  // namespace trunnion::access
