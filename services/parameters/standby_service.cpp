// SPDX-License-Identifier: Apache-2.0
#include "standby_service.hpp"

#include <algorithm>
#include <cstdio>

#include "parameter_store/private_storage.hpp"
#include "service.hpp"

namespace trunnion::parameters {
namespace {

std::string text_of(std::uint32_t number, const char* what) {
  char text[64];
  std::snprintf(text, sizeof text, "parameter %06u%s", number, what);
  return text;
}

// The first parameter that is not the same. What one set does not have is the catalogue's default.
std::string difference_of(const idl::parameters::ParameterSet& running,
                          const idl::parameters::ParameterSet& own) {
  const auto differs = [](const auto& a, const auto& b, auto number) -> std::optional<std::uint32_t> {
    const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (x == a.end() && y == b.end()) return std::nullopt;
    if (x == a.end()) return number(*y);
    return y == b.end() ? number(*x) : std::min(number(*x), number(*y));
  };
  if (const auto found = differs(running.values, own.values, [](const auto& value) { return value.number; }))
    return text_of(*found, "");
  if (const auto found =
          differs(running.pending, own.pending, [](const auto& value) { return value.number; }))
    return text_of(*found, ", which waits");
  if (running.revision == own.revision) return "";
  return "the revision: " + std::to_string(running.revision) + " and " + std::to_string(own.revision);
}

template <class T>
bool take_newest(bus::Reader<T>& reader, std::optional<T>& value) {
  T sample;
  if (!reader.take_newest(sample)) return false;
  value = std::move(sample);
  return true;
}

}  // namespace

StandbyService::StandbyService(service::Node& node)
    : node_(node),
      storage_(node.options().state_directory),
      set_reader_(node.bus().reader(topics::parameter_set)),
      tools_reader_(node.bus().reader(topics::tool_table)),
      offsets_reader_(node.bus().reader(topics::work_offsets)) {}

void StandbyService::pump() {
  const bool set = take_newest(set_reader_, set_), tools = take_newest(tools_reader_, tools_),
             offsets = take_newest(offsets_reader_, offsets_);
  if (!set_ || !tools_ || !offsets_) return;
  clock_.poll(set || tools || offsets, service::monotonic_seconds(), [this] { return difference(); });
}

std::string StandbyService::difference() {
  PrivateStorage files(storage_);
  const ParameterStore own(files, defaults_of(node_.options().machine),
                           storage_.read("cluster.boot").value_or(""));
  if (const auto what = difference_of(*set_, own.set()); !what.empty()) return what;
  if (*tools_ != own.tool_table()) return "the tool table";
  return *offsets_ == own.work_offsets() ? "" : "the work offsets";
}

}  // namespace trunnion::parameters
