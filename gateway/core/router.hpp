// SPDX-License-Identifier: Apache-2.0
// Which operation a method and a path mean. gateway/openapi.json documents exactly these.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::gateway {

enum class Operation {
  status,
  alarms,
  channels,
  channel,
  parameters,
  parameter,
  set_parameter,
  set_parameters,
  tools,
  set_tool,
  remove_tool,
  work_offsets,
  set_work_offset,
  check,
  programs,
  read_program,
  write_program,
  remove_program,
  rename_program,
  plc_image,
  variables,
  openapi,
  stream,
  session,
  login,
  logout,
  recordings,
  read_recording,
  recording_table,
  start_recording,
  stop_recording,
  remove_recording,
  operating_right,
  change_operating_right,
  plc_programs,
  plc_source,
  plc_variables,
  plc_forces,
  plc_tasks,
  plc_uses,
  plc_force,
  plc_release,
  plc_watch,
  plc_start_trace,
  plc_trace,
  plc_end_trace,
  plc_begin_load,
  plc_load,
  plc_compare,
  plc_take_over,
  plc_end_load,
  bodies,
  past_alarms,
  plan_program,
  measurement,
  measurement_start,
  measurement_continue,
  measurement_abort,
  measurement_confirm,
  measurement_discard,
  measurement_inputs,
  measurement_last,
  measurement_undo,
  manual_calibration,
  manual_evaluation,
  manual_write,
  channel_command,  ///< one of commands::channel_commands()
  panel_command,    ///< one of commands::panel_commands()
  alarms_reset
};

/// One line of the table: `{x}` in the pattern is one part of a path.
struct Route {
  std::string_view method;
  std::string pattern;
  Operation operation;
  std::string_view command{};  ///< the route of a command in its table
};

const std::vector<Route>& routes();

enum class RouteResult { found, no_path, no_method };

struct Match {
  RouteResult result = RouteResult::no_path;
  Operation operation = Operation::status;
  std::string_view command;        ///< as in Route
  std::vector<std::string> parts;  ///< what stood for each `{x}`, percent-decoded
};

/// Orders to the cluster and what everybody may send: a short body that is read at once, on the thread of the
/// connections. All else waits for its turn on another.
bool is_short(Operation operation);

/// Bytes of the body of a request.
std::uint64_t largest_body(Operation operation);

/// `path` without the query. HEAD is not routed. A part that does not decode is no path.
Match match(std::string_view method, std::string_view path);

/// Percent-decoding of one part of a path or query; false when a % is not followed by two hexadecimal digits.
bool percent_decode(std::string_view text, std::string& decoded, bool plus_is_space = false);

/// Value of `name` in a query string (a=1&b=2), decoded; empty when it is not there.
std::string query_value(std::string_view query, std::string_view name);

}  // namespace trunnion::gateway
