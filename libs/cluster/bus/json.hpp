// SPDX-License-Identifier: Apache-2.0
// JSON of the generated types, for tools and the gateway: field names as in the IDL, enums by name.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bus/fields.hpp"
#include "bus/json_type.hpp"

namespace trunnion::bus {

/// Instantiated for every type of idl/ by the build (contracts/codec_*.cpp), defined in bus/json_fields.hpp.
template <Struct T>
Json struct_to_json(const T& value);

template <class T>
Json to_json(const T& value) {
  if constexpr (Struct<T>) {
    return struct_to_json(value);
  } else if constexpr (std::is_enum_v<T>) {
    return to_string(value);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else {
    Json array = Json::array();
    for (const auto& element : value) array.push_back(to_json(element));
    return array;
  }
}

/// On one line, or indented by so many blanks. Bytes that are not UTF-8 become U+FFFD: a peer's strings are
/// whatever it sent.
std::string text_of(const Json& json, int indent = -1);

}  // namespace trunnion::bus
