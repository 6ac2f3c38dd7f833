// SPDX-License-Identifier: Apache-2.0
#include "core/rights.hpp"

#include <algorithm>

#include "commands/command_table.hpp"
#include "machine/roles.hpp"

namespace trunnion::gateway {

using access::Role;

std::optional<Role> needed_role(const Match& match) {
  switch (match.operation) {
    case Operation::openapi:
    case Operation::session:
    case Operation::login:
    case Operation::logout:
    case Operation::measurement_abort:
      return {};
    case Operation::panel_command:
      if (match.command == "emergency-stop") return {};
      return Role::machine_operator;
    case Operation::channel_command:
      if (commands::stops_motion(match.command)) return {};
      return Role::machine_operator;
    case Operation::plc_force:
    case Operation::plc_release:
    case Operation::plc_begin_load:
    case Operation::plc_compare:
    case Operation::plc_take_over:
    case Operation::plc_end_load:
    case Operation::measurement_confirm:  // the parameters of the kinematics are the builder's
    case Operation::measurement_undo:
    case Operation::manual_write:
      return Role::builder;
    case Operation::measurement_start:
    case Operation::measurement_continue:
    case Operation::measurement_discard:
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
    case Operation::status:
    case Operation::alarms:
    case Operation::channels:
    case Operation::channel:
    case Operation::parameters:
    case Operation::parameter:
    case Operation::tools:
    case Operation::work_offsets:
    case Operation::check:
    case Operation::programs:
    case Operation::read_program:
    case Operation::plc_image:
    case Operation::variables:
    case Operation::stream:
    case Operation::recordings:
    case Operation::read_recording:
    case Operation::recording_table:
    case Operation::start_recording:
    case Operation::stop_recording:
    case Operation::operating_right:
    case Operation::change_operating_right:
    case Operation::plc_programs:
    case Operation::plc_source:
    case Operation::plc_variables:
    case Operation::plc_forces:
    case Operation::plc_tasks:
    case Operation::plc_uses:
    case Operation::plc_watch:
    case Operation::plc_start_trace:
    case Operation::plc_trace:
    case Operation::plc_end_trace:
    case Operation::plc_load:
    case Operation::bodies:
    case Operation::past_alarms:
    case Operation::plan_program:
    case Operation::measurement:
    case Operation::measurement_inputs:
    case Operation::measurement_last:
    case Operation::manual_calibration:
    case Operation::manual_evaluation:
    case Operation::alarms_reset:
      return Role::machine_operator;
  }
  return Role::administrator;  // all are above: the compiler warns of one that states no right
}

static_assert(static_cast<int>(Role::setter) == machine::role::setter &&
              static_cast<int>(Role::builder) == machine::role::builder);

std::uint8_t role_of(const std::optional<access::Identity>& user) {
  return static_cast<std::uint8_t>(user ? std::min(user->role, Role::builder) : Role::builder);
}

bool needs_operating_right(const Match& match) {
  switch (match.operation) {
    case Operation::panel_command:
    case Operation::channel_command:
      return needed_role(match).has_value();  // who may stop needs no login either
    case Operation::alarms_reset:
    case Operation::set_parameter:
    case Operation::set_parameters:
    case Operation::set_tool:
    case Operation::remove_tool:
    case Operation::set_work_offset:
    case Operation::plc_force:
    case Operation::plc_release:
    case Operation::plc_take_over:
    case Operation::measurement_start:
    case Operation::measurement_continue:
    case Operation::measurement_confirm:
    case Operation::measurement_discard:
    case Operation::measurement_undo:
    case Operation::manual_write:
      return true;
    default:
      return false;
  }
}

bool prolongs_session(Operation operation) {
  switch (operation) {
    case Operation::session:
    case Operation::stream:
    case Operation::operating_right:
    case Operation::plc_watch:
    case Operation::plc_forces:
    case Operation::plc_tasks:
    case Operation::plc_load:
    case Operation::plc_trace:
    case Operation::plc_image:
    case Operation::variables:
    case Operation::measurement:
    case Operation::measurement_last:
    case Operation::manual_calibration:
    case Operation::plan_program:
      return false;
    default:
      return true;
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
