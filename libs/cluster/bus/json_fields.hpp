// SPDX-License-Identifier: Apache-2.0
// JSON of a struct by its fields, for the generated instantiations.
#pragma once

#include "bus/json.hpp"

namespace trunnion::bus {

template <Struct T>
Json struct_to_json(const T& value) {
  Json object = Json::object();
  Fields<T>::visit(value,
                   [&](const char* name, const auto& field, auto...) { object[name] = to_json(field); });
  return object;
}

}  // namespace trunnion::bus
