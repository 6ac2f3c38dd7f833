// SPDX-License-Identifier: Apache-2.0
#include "core/router.hpp"

#include <algorithm>

#include "commands/command_table.hpp"

namespace trunnion::gateway {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool fits(std::string_view pattern, std::string_view path, std::vector<std::string>& parts) {
  parts.clear();
  const auto wanted = split(pattern, '/'), given = split(path, '/');
  if (wanted.size() != given.size()) return false;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i].starts_with('{')) {
      if (wanted[i] != given[i]) return false;
      continue;
    }
    std::string decoded;
    if (given[i].empty() || !percent_decode(given[i], decoded)) return false;
    parts.push_back(std::move(decoded));
  }
  return true;
}

}  // namespace

namespace {

std::vector<Route> all_routes() {
  std::vector<Route> table = {
      {"GET", "/api/status", Operation::status},
      {"GET", "/api/alarms", Operation::alarms},
      {"GET", "/api/alarms/history", Operation::past_alarms},
      {"POST", "/api/alarms/reset", Operation::alarms_reset},
      {"GET", "/api/channels", Operation::channels},
      {"GET", "/api/channels/{channel}", Operation::channel},
      {"GET", "/api/bodies/{channel}", Operation::bodies},
      {"GET", "/api/variables/{channel}", Operation::variables},
      {"GET", "/api/parameters", Operation::parameters},
      {"PUT", "/api/parameters", Operation::set_parameters},
      {"GET", "/api/parameters/{number}", Operation::parameter},
      {"PUT", "/api/parameters/{number}", Operation::set_parameter},
      {"GET", "/api/tools", Operation::tools},
      {"PUT", "/api/tools/{number}", Operation::set_tool},
      {"DELETE", "/api/tools/{number}", Operation::remove_tool},
      {"GET", "/api/work-offsets", Operation::work_offsets},
      {"PUT", "/api/work-offsets", Operation::set_work_offset},
      {"POST", "/api/check/{channel}", Operation::check},
      {"GET", "/api/programs", Operation::programs},
      {"GET", "/api/programs/{name}", Operation::read_program},
      {"GET", "/api/programs/{name}/plan", Operation::plan_program},
      {"PUT", "/api/programs/{name}", Operation::write_program},
      {"DELETE", "/api/programs/{name}", Operation::remove_program},
      {"POST", "/api/programs/{name}/rename", Operation::rename_program},
      {"GET", "/api/session", Operation::session},
      {"POST", "/api/session", Operation::login},
      {"DELETE", "/api/session", Operation::logout},
      {"GET", "/api/recordings", Operation::recordings},
      {"POST", "/api/recordings", Operation::start_recording},
      {"GET", "/api/recordings/{name}", Operation::read_recording},
      {"GET", "/api/recordings/{name}/table", Operation::recording_table},
      {"POST", "/api/recordings/{name}/stop", Operation::stop_recording},
      {"DELETE", "/api/recordings/{name}", Operation::remove_recording},
      {"GET", "/api/operating-right", Operation::operating_right},
      {"POST", "/api/operating-right", Operation::change_operating_right},
      {"GET", "/api/plc/image", Operation::plc_image},
      {"GET", "/api/plc/programs", Operation::plc_programs},
      {"GET", "/api/plc/programs/{file}", Operation::plc_source},
      {"GET", "/api/plc/variables", Operation::plc_variables},
      {"GET", "/api/plc/watch", Operation::plc_watch},
      {"GET", "/api/plc/forces", Operation::plc_forces},
      {"GET", "/api/plc/tasks", Operation::plc_tasks},
      {"GET", "/api/plc/uses", Operation::plc_uses},
      {"POST", "/api/plc/force", Operation::plc_force},
      {"POST", "/api/plc/release", Operation::plc_release},
      {"GET", "/api/plc/trace", Operation::plc_trace},
      {"POST", "/api/plc/trace", Operation::plc_start_trace},
      {"DELETE", "/api/plc/trace", Operation::plc_end_trace},
      {"GET", "/api/plc/load", Operation::plc_load},
      {"POST", "/api/plc/load", Operation::plc_begin_load},
      {"DELETE", "/api/plc/load", Operation::plc_end_load},
      {"POST", "/api/plc/load/compare", Operation::plc_compare},
      {"POST", "/api/plc/load/take-over", Operation::plc_take_over},
      {"GET", "/api/measurement", Operation::measurement},
      {"POST", "/api/measurement/start", Operation::measurement_start},
      {"POST", "/api/measurement/continue", Operation::measurement_continue},
      {"POST", "/api/measurement/abort", Operation::measurement_abort},
      {"POST", "/api/measurement/confirm", Operation::measurement_confirm},
      {"POST", "/api/measurement/discard", Operation::measurement_discard},
      {"GET", "/api/measurement/inputs", Operation::measurement_inputs},
      {"GET", "/api/measurement/undo", Operation::measurement_last},
      {"POST", "/api/measurement/undo", Operation::measurement_undo},
      {"GET", "/api/measurement/manual", Operation::manual_calibration},
      {"POST", "/api/measurement/manual", Operation::manual_evaluation},
      {"POST", "/api/measurement/manual/write", Operation::manual_write},
      {"GET", "/api/openapi.json", Operation::openapi},
      {"GET", "/api/stream", Operation::stream},
  };
  const auto add = [&](const std::string& base, std::string_view route, Operation operation) {
    const auto pattern = base + std::string(route);
    if (std::none_of(table.begin(), table.end(),
                     [&](const Route& known) { return known.pattern == pattern; }))
      table.push_back({"POST", pattern, operation, route});
  };
  for (const auto& row : commands::channel_commands())
    add("/api/channels/{channel}/", row.route, Operation::channel_command);
  for (const auto& row : commands::panel_commands()) add("/api/panel/", row.route, Operation::panel_command);
  return table;
}

}  // namespace

const std::vector<Route>& routes() {
  static const std::vector<Route> table = all_routes();
  return table;
}

bool is_short(Operation operation) {
  switch (operation) {
    case Operation::session:
    case Operation::login:
    case Operation::logout:
    case Operation::operating_right:
    case Operation::change_operating_right:
    case Operation::alarms_reset:
    case Operation::channel_command:
    case Operation::panel_command:
    case Operation::measurement_abort:
    case Operation::remove_program:
    case Operation::rename_program:
      return true;
    default:
      return false;
  }
}

std::uint64_t largest_body(Operation operation) { return is_short(operation) ? 4u << 10 : 1u << 20; }

Match match(std::string_view method, std::string_view path) {
  Match found;
  for (const auto& route : routes()) {
    std::vector<std::string> parts;
    if (!fits(route.pattern, path, parts)) continue;
    if (route.method == method) return {RouteResult::found, route.operation, route.command, std::move(parts)};
    found.result = RouteResult::no_method;
  }
  return found;
}

bool percent_decode(std::string_view text, std::string& decoded, bool plus_is_space) {
  decoded.clear();
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded.push_back(plus_is_space && text[i] == '+' ? ' ' : text[i]);
      continue;
    }
    if (i + 2 >= text.size()) return false;
    const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0) return false;
    decoded.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  return true;
}

std::string query_value(std::string_view query, std::string_view name) {
  for (const auto pair : split(query, '&')) {
    const auto equals = pair.find('=');
    std::string decoded;
    if (pair.substr(0, equals) == name && equals != std::string_view::npos &&
        percent_decode(pair.substr(equals + 1), decoded, true))
      return decoded;
  }
  return {};
}

}  // namespace trunnion::gateway
