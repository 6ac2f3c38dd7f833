// SPDX-License-Identifier: Apache-2.0
// users.json of the state directory: who may do what. Only its owner can read it (0600).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "access/role.hpp"

namespace trunnion::access {

struct User {
  std::string name;
  Role role = Role::machine_operator;
  std::string hash;  ///< of hash_password()
};

/// For a program; the secret itself is not kept.
struct Token {
  std::string name;
  Role role = Role::machine_operator;
  std::string digest;  ///< of the secret
};

struct Users {
  std::vector<User> users;
  std::vector<Token> tokens;
  const User* find(std::string_view name) const;
  const Token* find_token(std::string_view digest) const;
};

inline constexpr const char* users_file = "users.json";
inline constexpr const char* access_journal_file = "access.jsonl";
/// Password of the administrator of the first start, until it is changed.
inline constexpr const char* initial_password_file = "initial-password";

/// 1 to 32 letters, digits, '.', '-' and '_'.
bool is_user_name(std::string_view name);
/// Empty, or why it is no password: 8 to 256 bytes are needed.
std::string password_problem(std::string_view password);

/// Throws std::runtime_error with `file` and the reason.
Users parse_users(const std::string& text, const std::string& file);
std::string text_of(const Users& users);

/// Nothing when there is no file yet. Throws std::runtime_error, also when others may read or write it.
std::optional<Users> load_users(const std::string& state_directory);
/// After a crash the file is old or new. Throws std::runtime_error.
void save_users(const std::string& state_directory, const Users& users);
/// Writes a file that only its owner can read, in the same way.
void write_private(const std::string& path, const std::string& text);

/// Adds a line to access.jsonl: {"time", "who", "what"}. Never throws: it must not be in the way of an order.
void journal(const std::string& state_directory, const std::string& time, const std::string& who,
             const std::string& what);

}  // namespace trunnion::access
