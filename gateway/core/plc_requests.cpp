// SPDX-License-Identifier: Apache-2.0
#include "core/plc_requests.hpp"

#include <algorithm>

namespace trunnion::gateway {

using bus::Json;
using commands::boolean;
using commands::only;
using commands::required;
using commands::text;
using commands::whole;
using idl::plc::OnlineAction;
using idl::plc::OnlineRequest;

namespace {

// Bounds of plc.idl.
constexpr std::size_t path_bytes = 240, most_paths = 256, file_bytes = 120, load_part_bytes = 30000;

const Json& list_of(const Json& body, const char* name) {
  const auto& list = required(body, name);
  if (!list.is_array() || list.empty() || list.size() > most_paths)
    throw BadRequest(name, std::string(name) + " must be a list of 1 to " + std::to_string(most_paths));
  return list;
}

void add_paths(const Json& body, OnlineRequest& request) {
  for (const auto& path : list_of(body, "paths")) request.paths.push_back(text(path, "paths", path_bytes));
}

OnlineRequest request_for(OnlineAction action) {
  OnlineRequest request{};
  request.action = action;
  return request;
}

}  // namespace

OnlineRequest force_request(const Json& body) {
  only(body, {"values", "permanent"});
  auto request = request_for(OnlineAction::FORCE);
  for (const auto& row : list_of(body, "values")) {
    if (!row.is_object()) throw BadRequest("values", "each of values must have path and value");
    only(row, {"path", "value"});
    request.paths.push_back(text(required(row, "path"), "path", path_bytes));
    request.values.push_back(text(required(row, "value"), "value", path_bytes));
  }
  request.permanent = body.contains("permanent") && boolean(body["permanent"], "permanent");
  return request;
}

OnlineRequest release_request(const Json& body) {
  only(body, {"paths"});
  auto request = request_for(OnlineAction::RELEASE);
  if (body.contains("paths")) add_paths(body, request);
  return request;
}

OnlineRequest watch_request(const Json& body) {
  only(body, {"paths"});
  auto request = request_for(OnlineAction::WATCH);
  add_paths(body, request);
  return request;
}

OnlineRequest trace_request(const Json& body) {
  using idl::plc::TraceCondition;
  only(body, {"paths", "scans", "when"});
  auto request = request_for(OnlineAction::START_TRACE);
  add_paths(body, request);
  request.scans =
      body.contains("scans") ? static_cast<std::uint32_t>(whole(body["scans"], "scans", 1, 1000000)) : 1000;
  if (!body.contains("when")) return request;
  const auto& when = body["when"];
  if (!when.is_object()) throw BadRequest("when", "when must have path, is and value");
  only(when, {"path", "is", "value"});
  static constexpr std::pair<std::string_view, TraceCondition> conditions[] = {
      {"=", TraceCondition::EQUAL},
      {"<>", TraceCondition::NOT_EQUAL},
      {"<", TraceCondition::LESS},
      {">", TraceCondition::GREATER},
      {"changed", TraceCondition::CHANGED}};
  const auto is = text(required(when, "is"), "is", 8);
  const auto* found = std::ranges::find(conditions, std::string_view(is),
                                        &std::pair<std::string_view, TraceCondition>::first);
  if (found == std::end(conditions)) throw BadRequest("is", "is must be =, <>, <, > or changed");
  request.condition = found->second;
  request.condition_path = text(required(when, "path"), "path", path_bytes);
  if (request.condition != TraceCondition::CHANGED)
    request.condition_value = text(required(when, "value"), "value", path_bytes);
  return request;
}

std::vector<PlcSource> load_files(const Json& body) {
  only(body, {"files"});
  std::vector<PlcSource> files;
  for (const auto& row : list_of(body, "files")) {
    if (!row.is_object()) throw BadRequest("files", "each of files must have name and text");
    only(row, {"name", "text"});
    const auto& content = required(row, "text");
    if (!content.is_string()) throw BadRequest("text", "text must be a text");
    files.push_back({text(required(row, "name"), "name", file_bytes), content.get<std::string>()});
  }
  return files;
}

std::vector<OnlineRequest> load_requests(const std::vector<PlcSource>& files) {
  std::vector<OnlineRequest> requests{request_for(OnlineAction::BEGIN_LOAD)};
  for (const auto& file : files) {
    std::size_t at = 0;
    do {
      const auto part = std::string_view(file.text).substr(at, load_part_bytes);
      auto write = request_for(OnlineAction::WRITE_SOURCE);
      write.file = file.name;
      write.data.assign(part.begin(), part.end());
      requests.push_back(std::move(write));
      at += part.size();
    } while (at < file.text.size());
  }
  requests.push_back(request_for(OnlineAction::COMPILE));
  return requests;
}

}  // namespace trunnion::gateway
