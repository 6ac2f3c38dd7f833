// SPDX-License-Identifier: Apache-2.0
#include "core/merge_patch.hpp"

namespace trunnion::gateway {

bus::Json merge_patch(const bus::Json& from, const bus::Json& to) {
  auto patch = bus::Json::object();
  for (const auto& [name, value] : to.items()) {
    const auto old = from.find(name);
    if (old == from.end()) {
      patch[name] = value;
    } else if (*old != value) {
      if (old->is_object() && value.is_object())
        patch[name] = merge_patch(*old, value);
      else
        patch[name] = value;
    }
  }
  for (const auto& [name, value] : from.items())
    if (!to.contains(name)) patch[name] = nullptr;
  return patch;
}

}  // namespace trunnion::gateway
