// SPDX-License-Identifier: Apache-2.0
#include "operators/access_control.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "access/secrets.hpp"
#include "core/requests.hpp"
#include "core/rights.hpp"
#include "service/node.hpp"

namespace trunnion::gateway {
namespace {

using access::Role;
using bus::Json;

constexpr int most_waiting = 4;        // logins: each takes some tenths of a second
constexpr double looked_at_every = 1;  // s: users.json
constexpr const char* first_name = "admin";

Answer unauthorized(const std::string& why) {
  auto made = error_answer(401, why);
  made.headers = {{"WWW-Authenticate", "Bearer"}};
  return made;
}

std::string cookie_text(const std::string& secret, bool secure, const char* more) {
  std::string text = AccessControl::cookie;
  text.append("=").append(secret).append("; Path=/; HttpOnly; SameSite=Strict");
  return text.append(secure ? "; Secure" : "").append(more);
}

/// What is verified for a name that does not exist, so that the answer takes as long.
const std::string& hash_of_nobody() {
  static const std::string hash = access::hash_password(access::random_secret());
  return hash;
}

}  // namespace

AccessControl::AccessControl(AccessSettings settings, Worker& worker)
    : settings_(std::move(settings)), worker_(worker), sessions_(settings_.session_idle) {
  if (!on()) return;
  hash_of_nobody();  // made now, so that the first unknown name takes no longer than others
  const auto& directory = settings_.state_directory;
  if (auto known = access::load_users(directory)) {
    users_ = std::move(*known);
  } else {
    const auto password = access::random_secret(8);
    const auto file = directory + "/" + access::initial_password_file;
    users_.users.push_back({first_name, Role::administrator, access::hash_password(password)});
    access::write_private(file, password + "\n");
    access::save_users(directory, users_);
    access::journal(directory, service::time_of_day(), "gateway",
                    std::string("created the user ") + first_name);
    std::cerr << "trunnion-gateway: there were no users: the administrator '" << first_name
              << "' was created; the password is in " << file << "; change it with 'trunnion user password "
              << first_name << "'\n";
  }
  std::error_code error;
  read_ = std::filesystem::last_write_time(directory + "/" + access::users_file, error);
}

void AccessControl::refresh(double now) {
  if (now - looked_ < looked_at_every) return;
  looked_ = now;
  std::error_code error;
  const auto changed =
      std::filesystem::last_write_time(settings_.state_directory + "/" + access::users_file, error);
  if (error || changed == read_) return;
  read_ = changed;
  try {
    auto next = access::load_users(settings_.state_directory);
    if (!next) return;
    for (const auto& before : users_.users) {
      const auto* after = next->find(before.name);
      if (after == nullptr || after->role != before.role || after->hash != before.hash)
        sessions_.end_of(before.name);
    }
    users_ = std::move(*next);
  } catch (const std::exception& problem) {
    std::cerr << "trunnion-gateway: " << problem.what() << ": the users from before are used\n";
  }
}

std::optional<access::Identity> AccessControl::identify(std::string_view cookies,
                                                        std::string_view authorization, bool prolongs) {
  const auto token = bearer_token(authorization);
  if (settings_.believing && token.size() > 2)
    return access::Identity{token.substr(2), token[0] == '0'   ? Role::machine_operator
                                             : token[0] == '1' ? Role::setter
                                                               : Role::builder};
  if (!on()) return {};
  const auto secret = cookie_value(cookies, cookie);
  if (secret.empty() && token.empty()) return {};
  const std::lock_guard lock(mutex_);
  const double now = service::monotonic_seconds();
  refresh(now);
  if (!token.empty()) {
    const auto* found = users_.find_token(access::digest(token));
    if (found == nullptr) return {};
    return access::Identity{found->name, found->role};
  }
  return prolongs ? sessions_.find(secret, now) : sessions_.look(secret, now);
}

std::optional<Answer> AccessControl::refusal(const std::optional<access::Identity>& who,
                                             const Match& match) const {
  if (!on()) return {};
  const auto needed = needed_role(match);
  if (!needed) return {};
  if (!who) return unauthorized("log in first: the session is over, or there was none");
  if (who->role >= *needed) return {};
  return error_answer(403, std::string("this needs the role ") + access::name_of(*needed) + ", and " +
                               who->name + " is " + access::name_of(who->role));
}

void AccessControl::login(const std::string& body, const std::string& peer, const Respond& respond) {
  if (!on()) return respond(error_answer(409, "auth is off: no login is needed"));
  const auto json = parse_body(body);
  for (const auto& [key, value] : json.items())
    if ((key != "name" && key != "password") || !value.is_string())
      throw BadRequest(key, "a login has the texts name and password");
  if (!json.contains("name") || !json.contains("password"))
    throw BadRequest("name", "a login has the texts name and password");
  const std::string name = json["name"], password = json["password"];
  if (!access::is_user_name(name) || password.size() > 256)
    return respond(unauthorized("wrong name or password"));
  const double now = service::monotonic_seconds();
  std::string hash;
  {
    const std::lock_guard lock(mutex_);
    refresh(now);
    const double wait = throttle_.wait(name, peer, now);
    if (wait > 0) {
      auto made = error_answer(429, "too many wrong passwords: try again in " +
                                        std::to_string(static_cast<int>(std::ceil(wait))) + " s");
      made.headers = {{"Retry-After", std::to_string(static_cast<int>(std::ceil(wait)))}};
      return respond(std::move(made));
    }
    if (const auto* user = users_.find(name)) hash = user->hash;
  }
  if (waiting_.fetch_add(1) >= most_waiting) {
    --waiting_;
    return respond(error_answer(503, "too many logins at a time; try again"));
  }
  worker_.post([this, name, password, hash, peer, respond] {
    const bool known = !hash.empty();
    const bool good = access::is_password(password, known ? hash : hash_of_nobody()) && known;
    --waiting_;
    const double then = service::monotonic_seconds();
    Answer made = unauthorized("wrong name or password");
    {
      const std::lock_guard lock(mutex_);
      const auto* user = users_.find(name);
      if (good && user != nullptr && user->hash == hash) {
        const auto secret = access::random_secret();
        sessions_.begin(secret, {name, user->role}, then);
        throttle_.succeeded(name, peer, then);
        made = json_answer(200, {{"name", name}, {"role", access::name_of(user->role)}});
        made.headers.clear();
        made.headers.emplace_back("Set-Cookie", cookie_text(secret, settings_.secure, ""));
      } else {
        throttle_.failed(name, peer, then);
      }
    }
    access::journal(settings_.state_directory, service::time_of_day(), name,
                    (made.status == 200 ? "login from " : "wrong password from ") + peer);
    respond(std::move(made));
  });
}

Answer AccessControl::logout(const RequestText& request) {
  {
    const std::lock_guard lock(mutex_);
    sessions_.end(cookie_value(request.cookies, cookie));
  }
  if (request.user) note(request.user->name, "logout");
  auto made = json_answer(200, {{"accepted", true}});
  made.headers.emplace_back("Set-Cookie", cookie_text("", settings_.secure, "; Max-Age=0"));
  return made;
}

Answer AccessControl::session(const RequestText& request) const {
  return json_answer(200, {{"auth", on()},
                           {"name", request.user ? request.user->name : ""},
                           {"role", request.user ? access::name_of(request.user->role) : ""}});
}

void AccessControl::note(const std::string& who, const std::string& what) {
  worker_.post([directory = settings_.state_directory, who, what] {
    access::journal(directory, service::time_of_day(), who, what);
  });
}

}  // namespace trunnion::gateway
