// SPDX-License-Identifier: Apache-2.0
// Any request line and body: they are refused with the field, or become a request that is within its limits.
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/plc_requests.hpp"
#include "core/requests.hpp"
#include "core/router.hpp"

namespace trunnion::gateway {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check(const idl::channel::ChannelRequest& request) {
  require(request.channel == 2 && request.program.size() <= 64 && request.block.size() <= 256);
  require(std::isfinite(request.fraction) && std::isfinite(request.speed) &&
          std::isfinite(request.increment) && request.axis < 5);
}

void body(const std::string& text) {
  idl::channel::ChannelState state{};
  state.channel = 2;
  state.axes = {0, 1, 2, 4, 6};
  state.letters = "XYZAC";
  bus::Json json;
  try {
    json = parse_body(text);
  } catch (const BadRequest&) {
    return;
  }
  const auto refused_or = [](auto make) {
    try {
      make();
    } catch (const BadRequest& bad) {
      require(bad.what()[0] != 0);
    }
  };
  for (const auto& row : commands::channel_commands())
    refused_or([&] { check(channel_request(row.route, json, state)); });
  for (const auto& row : commands::panel_commands()) refused_or([&] { panel_request(row.route, json); });
  refused_or([&] { alarm_reset(json); });
  for (const bool is_text : {false, true})
    refused_or([&] { require(std::isfinite(parameter_request(100034, is_text, json).values.at(0).value)); });
  refused_or([&] {
    const auto request = work_offset_request(json);
    for (const double value : request.offsets.at(0).values) require(std::isfinite(value));
  });
  refused_or([&] {
    const auto request = parameter_import(json);
    require(!request.values.empty() && request.values.size() <= 4096);
    for (const auto& one : request.values) require(std::isfinite(one.value) && one.text.size() <= 64);
  });
  refused_or([&] {
    const auto tool = tool_request(1, json).tools.at(0);
    require(std::isfinite(tool.length) && std::isfinite(tool.radius) && tool.name.size() <= 64);
    require(tool.life_used >= 0 && tool.life_limit >= 0 && tool.type.size() <= 32);
  });
  refused_or([&] {
    const auto request = force_request(json);
    require(!request.paths.empty() && request.paths.size() == request.values.size());
  });
  refused_or([&] { release_request(json); });
  refused_or([&] { require(!watch_request(json).paths.empty()); });
  refused_or([&] { require(trace_request(json).scans >= 1); });
  refused_or([&] { require(load_requests(load_files(json)).size() >= 3); });
  refused_or([&] { require(rename_request("a.nc", json).new_name.size() <= 64); });
}

}  // namespace
}  // namespace trunnion::gateway

/// The first line is method, path and query, the rest the body.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::gateway;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto end = text.find('\n');
  const auto line = text.substr(0, end);
  const auto space = line.find(' ');
  const auto target = space == std::string::npos ? std::string() : line.substr(space + 1);
  const auto question = target.find('?');
  const auto found = match(line.substr(0, space), target.substr(0, question));
  require((found.result == RouteResult::found) || found.parts.empty());
  for (const auto& part : found.parts) {
    path_number(part, 999999);
    try {
      trunnion::commands::check_program_name(part);
      require(!part.empty() && part.size() <= 64 && part.find('/') == std::string::npos);
    } catch (const BadRequest&) {
    }
  }
  if (question != std::string::npos) query_value(target.substr(question + 1), "search");
  if (end != std::string::npos) body(text.substr(end + 1));
  return 0;
}
