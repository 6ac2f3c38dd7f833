// SPDX-License-Identifier: Apache-2.0
#include "table_change.hpp"

#include <algorithm>
#include <utility>

#include "table_request.hpp"

namespace trunnion::channel {

void TableChange::begin(const language::Command& command, std::uint8_t role, std::string who) {
  auto request = table_request(command, channel_, tools_);
  request.role = role;
  request.who = std::move(who);
  request.who.resize(std::min<std::size_t>(request.who.size(), 64));
  outgoing_ = std::move(request);
  open_ = true;
}

bool TableChange::finish() { return std::exchange(open_, false); }

std::optional<idl::parameters::ParameterRequest> TableChange::take_request() {
  return std::exchange(outgoing_, std::nullopt);
}

}  // namespace trunnion::channel
