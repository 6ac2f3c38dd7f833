// SPDX-License-Identifier: Apache-2.0
// user add, remove, list, password, token: who may do what over HTTP
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "access/secrets.hpp"
#include "access/user_file.hpp"
#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "cluster/cluster_files.hpp"
#include "commands.hpp"
#include "machine/machine.hpp"
#include "service/node.hpp"

namespace trunnion::cli {
namespace {

using access::Users;
using bus::Json;

struct Arguments {
  std::string machine, state, name, role = "operator";
  bool remove = false;
};

std::string state_directory(const Common& common, const Arguments& arguments) {
  if (!arguments.state.empty()) return std::filesystem::absolute(arguments.state).lexically_normal().string();
  if (!arguments.machine.empty())
    return cluster::default_state_directory(
        machine::load_machine(cluster::find_machine(arguments.machine)).name);
  return cluster::find_cluster(common.domain).state_directory;
}

/// A line of the standard input; of a terminal without showing what is typed.
std::string read_line(const char* prompt) {
  termios before{};
  const bool terminal = isatty(STDIN_FILENO) != 0 && tcgetattr(STDIN_FILENO, &before) == 0;
  if (terminal) {
    std::cerr << prompt << std::flush;
    auto silent = before;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  }
  std::string line;
  std::getline(std::cin, line);
  if (terminal) {
    tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
    std::cerr << "\n";
  }
  return line;
}

std::string new_password() {
  const auto password = read_line("New password: ");
  if (const auto problem = access::password_problem(password); !problem.empty())
    throw std::runtime_error(problem);
  if (isatty(STDIN_FILENO) != 0 && read_line("Again: ") != password)
    throw std::runtime_error("the two passwords differ: nothing was changed");
  return password;
}

access::Role role_of(const std::string& name) {
  const auto role = access::role_from(name);
  if (!role)
    throw std::runtime_error("no role is called '" + name + "': operator, setter, builder, administrator");
  return *role;
}

void check_name(const std::string& name) {
  if (!access::is_user_name(name))
    throw std::runtime_error("'" + name + "' is no name: 1 to 32 letters, digits, '.', '-' and '_'");
}

void say(const Common& common, const std::string& what, const Json& json) {
  if (common.json)
    std::cout << bus::text_of(json) << "\n";
  else
    std::cout << what << "\n";
}

void save_users(const std::string& state, const Users& users, const std::string& what) {
  access::save_users(state, users);
  access::journal(state, service::time_of_day(), "trunnion user", what);
}

int add_user(const Common& common, const Arguments& arguments) {
  const auto state = state_directory(common, arguments);
  auto users = access::load_users(state).value_or(Users{});
  check_name(arguments.name);
  if (users.find(arguments.name) != nullptr)
    throw std::runtime_error("there is a user '" + arguments.name + "' already");
  const auto role = role_of(arguments.role);
  users.users.push_back({arguments.name, role, access::hash_password(new_password())});
  save_users(state, users, "added the user " + arguments.name + ", " + access::name_of(role));
  say(common, arguments.name + " is " + access::name_of(role),
      {{"name", arguments.name}, {"role", access::name_of(role)}});
  return 0;
}

int remove_user(const Common& common, const Arguments& arguments) {
  const auto state = state_directory(common, arguments);
  auto users = access::load_users(state).value_or(Users{});
  const auto* user = users.find(arguments.name);
  if (user == nullptr) throw std::runtime_error("there is no user '" + arguments.name + "'");
  const auto administrators =
      std::ranges::count(users.users, access::Role::administrator, &access::User::role);
  if (user->role == access::Role::administrator && administrators == 1)
    throw std::runtime_error(arguments.name + " is the only administrator: add another one first");
  std::erase_if(users.users, [&](const auto& one) { return one.name == arguments.name; });
  save_users(state, users, "removed the user " + arguments.name);
  say(common, arguments.name + " is removed", {{"removed", arguments.name}});
  return 0;
}

int list_users(const Common& common, const Arguments& arguments) {
  const auto users = access::load_users(state_directory(common, arguments)).value_or(Users{});
  Json json = {{"users", Json::array()}, {"tokens", Json::array()}};
  for (const auto& one : users.users)
    json["users"].push_back({{"name", one.name}, {"role", access::name_of(one.role)}});
  for (const auto& one : users.tokens)
    json["tokens"].push_back({{"name", one.name}, {"role", access::name_of(one.role)}});
  if (common.json) {
    std::cout << bus::text_of(json) << "\n";
    return 0;
  }
  for (const char* kind : {"users", "tokens"})
    for (const auto& one : json[kind])
      std::printf("%-6s %-32s %s\n", kind == std::string("users") ? "user" : "token",
                  one["name"].get<std::string>().c_str(), one["role"].get<std::string>().c_str());
  return 0;
}

int password(const Common& common, const Arguments& arguments) {
  const auto state = state_directory(common, arguments);
  auto users = access::load_users(state).value_or(Users{});
  const auto user = std::ranges::find(users.users, arguments.name, &access::User::name);
  if (user == users.users.end()) throw std::runtime_error("there is no user '" + arguments.name + "'");
  user->hash = access::hash_password(new_password());
  save_users(state, users, "changed the password of " + arguments.name);
  std::error_code ignored;
  if (user->role == access::Role::administrator)
    std::filesystem::remove(state + "/" + access::initial_password_file, ignored);
  say(common, "the password of " + arguments.name + " is changed; its sessions end",
      {{"changed", arguments.name}});
  return 0;
}

int token(const Common& common, const Arguments& arguments) {
  const auto state = state_directory(common, arguments);
  auto users = access::load_users(state).value_or(Users{});
  check_name(arguments.name);
  const auto known = std::ranges::find(users.tokens, arguments.name, &access::Token::name);
  if (arguments.remove) {
    if (known == users.tokens.end()) throw std::runtime_error("there is no token '" + arguments.name + "'");
    users.tokens.erase(known);
    save_users(state, users, "removed the token " + arguments.name);
    say(common, "the token " + arguments.name + " is removed", {{"removed", arguments.name}});
    return 0;
  }
  if (known != users.tokens.end())
    throw std::runtime_error("there is a token '" + arguments.name + "' already");
  const auto role = role_of(arguments.role);
  const auto secret = access::random_secret();
  users.tokens.push_back({arguments.name, role, access::digest(secret)});
  save_users(state, users, "made the token " + arguments.name + ", " + access::name_of(role));
  say(common, secret, {{"token", secret}, {"name", arguments.name}, {"role", access::name_of(role)}});
  return 0;
}

}  // namespace

void add_user_command(CLI::App& app, Common& common) {
  auto* user = app.add_subcommand("user", "Who may do what over HTTP, on a machine with 'auth: on'");
  user->require_subcommand(1);
  auto arguments = std::make_shared<Arguments>();
  const auto place = [&](CLI::App* command) {
    command->add_option("--machine", arguments->machine, "Machine whose default state directory it is");
    command->add_option("--state", arguments->state,
                        "State directory (default: that of the running cluster)");
    return command;
  };
  const auto named = [&](CLI::App* command, const char* about) {
    place(command)->add_option("name", arguments->name, about)->required();
    return command;
  };
  const char* const roles = "operator, setter, builder or administrator (default: operator)";
  named(add_command(*user, common, "add",
                    "Add a user; the password is read from the terminal or one line of input",
                    [&common, arguments] { return add_user(common, *arguments); }),
        "Name of the user")
      ->add_option("--role", arguments->role, roles);
  named(add_command(*user, common, "remove", "Remove a user; its sessions end",
                    [&common, arguments] { return remove_user(common, *arguments); }),
        "Name of the user");
  place(add_command(*user, common, "list", "Users and tokens with their roles",
                    [&common, arguments] { return list_users(common, *arguments); }));
  named(add_command(*user, common, "password", "Change a password; the sessions of the user end",
                    [&common, arguments] { return password(common, *arguments); }),
        "Name of the user");
  auto* command =
      named(add_command(*user, common, "token", "Make a token for a program and print it: it is not kept",
                        [&common, arguments] { return token(common, *arguments); }),
            "Name of the token");
  command->add_option("--role", arguments->role, roles);
  command->add_flag("--remove", arguments->remove, "Remove the token instead");
}

}  // namespace trunnion::cli
