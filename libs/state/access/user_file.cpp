// SPDX-License-Identifier: Apache-2.0
#include "access/user_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "storage/file.hpp"

namespace trunnion::access {
namespace {

using Json = nlohmann::json;

constexpr std::size_t least_password = 8, most_password = 256, longest_name = 32;

std::string text_member(const Json& row, const char* name, const std::string& file) {
  const auto found = row.find(name);
  if (found == row.end() || !found->is_string())
    throw std::runtime_error(file + ": error: an entry has no text '" + name + "'");
  return *found;
}

template <class Entry>
std::vector<Entry> entries(const Json& document, const char* list, const char* secret,
                           std::string Entry::*into, const std::string& file) {
  std::vector<Entry> result;
  const auto found = document.find(list);
  if (found == document.end() || !found->is_array())
    throw std::runtime_error(file + ": error: there is no list '" + list + "'");
  for (const auto& row : *found) {
    if (!row.is_object())
      throw std::runtime_error(file + ": error: '" + list + "' has an entry that is no object");
    Entry entry;
    entry.name = text_member(row, "name", file);
    const auto role = role_from(text_member(row, "role", file));
    if (!role || !is_user_name(entry.name))
      throw std::runtime_error(file + ": error: '" + entry.name + "' has no known role, or is no name");
    entry.role = *role;
    entry.*into = text_member(row, secret, file);
    for (const auto& other : result)
      if (other.name == entry.name)
        throw std::runtime_error(file + ": error: '" + entry.name + "' is there twice");
    result.push_back(std::move(entry));
  }
  return result;
}

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw std::runtime_error(path + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

const User* Users::find(std::string_view name) const {
  const auto found = std::ranges::find(users, name, &User::name);
  return found == users.end() ? nullptr : &*found;
}

const Token* Users::find_token(std::string_view wanted) const {
  const auto found = std::ranges::find(tokens, wanted, &Token::digest);
  return found == tokens.end() ? nullptr : &*found;
}

bool is_user_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_name &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-") ==
             std::string_view::npos;
}

std::string password_problem(std::string_view password) {
  if (password.size() >= least_password && password.size() <= most_password) return {};
  return "a password has 8 to 256 bytes";
}

Users parse_users(const std::string& text, const std::string& file) {
  const auto document = Json::parse(text, nullptr, false);
  if (!document.is_object()) throw std::runtime_error(file + ": error: this is no JSON object");
  return {entries<User>(document, "users", "argon2id", &User::hash, file),
          entries<Token>(document, "tokens", "sha256", &Token::digest, file)};
}

std::string text_of(const Users& users) {
  Json document = {{"users", Json::array()}, {"tokens", Json::array()}};
  for (const auto& one : users.users)
    document["users"].push_back({{"name", one.name}, {"role", name_of(one.role)}, {"argon2id", one.hash}});
  for (const auto& one : users.tokens)
    document["tokens"].push_back({{"name", one.name}, {"role", name_of(one.role)}, {"sha256", one.digest}});
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Users> load_users(const std::string& state_directory) {
  const auto path = state_directory + "/" + users_file;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno == ENOENT) return {};
    fail(path, "cannot be read");
  }
  if ((status.st_mode & 077) != 0)
    throw std::runtime_error(path + ": other users may read or write it: chmod 600 " + path);
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(path + ": cannot be read");
  return parse_users(text, path);
}

void write_private(const std::string& path, const std::string& text) {
  const auto next = path + ".next";
  ::unlink(next.c_str());
  const int file = ::open(next.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) fail(next, "cannot be written");
  const auto written = ::write(file, text.data(), text.size());
  const bool good = written == static_cast<ssize_t>(text.size()) && ::fsync(file) == 0;
  ::close(file);
  if (!good) fail(next, "cannot be written");
  storage::rename_over(next, path);
  storage::sync_directory(std::filesystem::path(path).parent_path().string());
}

void save_users(const std::string& state_directory, const Users& users) {
  write_private(state_directory + "/" + users_file, text_of(users));
}

void journal(const std::string& state_directory, const std::string& time, const std::string& who,
             const std::string& what) {
  const auto line = Json{{"time", time}, {"who", who}, {"what", what}}.dump(-1, ' ', false,
                                                                            Json::error_handler_t::replace) +
                    "\n";
  const int file = ::open((state_directory + "/" + access_journal_file).c_str(),
                          O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) return;
  [[maybe_unused]] const auto written = ::write(file, line.data(), line.size());
  ::close(file);
}

}  // namespace trunnion::access
