// SPDX-License-Identifier: Apache-2.0
#include "bus/json.hpp"

namespace trunnion::bus {

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trunnion::bus
