// SPDX-License-Identifier: Apache-2.0
// Logins, sessions and tokens of the gateway.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "access/login_throttle.hpp"
#include "access/sessions.hpp"
#include "access/user_file.hpp"
#include "answer.hpp"
#include "core/router.hpp"
#include "core/worker.hpp"

namespace trunnion::gateway {

struct AccessSettings {
  bool on = false;
  std::string state_directory;
  double session_idle = access::Sessions::longest_idle;  ///< s
  bool secure = false;                                   ///< cookies only travel by TLS
  bool believing =
      false;  ///< without users: a bearer token is role (as in ParameterRequest) and name of who sends
};

class AccessControl {
 public:
  static constexpr const char* cookie = "trunnion_session";

  /// Makes the first administrator when there are no users yet. Throws std::runtime_error when users.json
  /// cannot be used.
  AccessControl(AccessSettings settings, Worker& worker);

  bool on() const { return settings_.on; }
  /// Whether the gateway is reached by TLS.
  bool secure() const { return settings_.secure; }
  /// Who sends a request with these values of the headers Cookie and Authorization. Only what a person does
  /// `prolongs` a session, not what a page asks by itself.
  std::optional<access::Identity> identify(std::string_view cookies, std::string_view authorization,
                                           bool prolongs = true);
  /// 401 or 403 when `who` must not do it.
  std::optional<Answer> refusal(const std::optional<access::Identity>& who, const Match& match) const;

  /// {"name", "password"} of a client at `peer`; answers later.
  void login(const std::string& body, const std::string& peer, const Respond& respond);
  Answer logout(const RequestText& request);
  Answer session(const RequestText& request) const;
  /// A line of access.jsonl, soon.
  void note(const std::string& who, const std::string& what);

 private:
  /// Reads users.json again when it has changed; sessions of users that are gone or have another role end.
  void refresh(double now);

  const AccessSettings settings_;
  Worker& worker_;
  std::mutex mutex_;
  access::Users users_;
  access::Sessions sessions_;
  access::LoginThrottle throttle_;
  std::filesystem::file_time_type read_{};
  double looked_ = -1;
  std::atomic<int> waiting_ = 0;  ///< logins
};

}  // namespace trunnion::gateway
