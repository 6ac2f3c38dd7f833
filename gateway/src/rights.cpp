// SPDX-License-Identifier: Apache-2.0
#include "src/rights.hpp"

namespace trunnion::gateway {

using access::Role;

std::optional<Role> needed_role(const Match& match) {
  switch (match.operation) {
    case Operation::openapi:
    case Operation::session:
    case Operation::login:
    case Operation::logout:
      return {};
    case Operation::panel_command:
      if (match.command == "emergency-stop") return {};
      return Role::machine_operator;
    case Operation::channel_command:
      if (match.command == "feed-hold" || match.command == "jog-stop") return {};
      return Role::machine_operator;
    case Operation::set_parameter:  // those of access builder need more
    case Operation::set_parameters:
    case Operation::set_tool:
    case Operation::remove_tool:
    case Operation::set_work_offset:
    case Operation::write_program:
    case Operation::remove_program:
    case Operation::rename_program:
    case Operation::remove_recording:
      return Role::setter;
    default:
      return Role::machine_operator;
  }
}

std::string cookie_value(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const auto end = header.find(';');
    auto pair = header.substr(0, end);
    while (pair.starts_with(' ')) pair.remove_prefix(1);
    const auto equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name)
      return std::string(pair.substr(equals + 1));
    if (end == std::string_view::npos) break;
    header.remove_prefix(end + 1);
  }
  return {};
}

std::string bearer_token(std::string_view header) {
  constexpr std::string_view scheme = "Bearer ";
  return header.starts_with(scheme) ? std::string(header.substr(scheme.size())) : std::string();
}

bool is_loopback(const std::string& address) { return address == "::1" || address.starts_with("127."); }

}  // namespace trunnion::gateway
