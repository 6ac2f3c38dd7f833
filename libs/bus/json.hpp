// JSON of the generated types, for tools and the gateway: field names as in the IDL, enums by name.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bus/fields.hpp"

namespace trunnion::bus {

using Json = nlohmann::ordered_json;

template <class T>
Json to_json(const T& value) {
  if constexpr (Struct<T>) {
    Json object = Json::object();
    Fields<T>::visit(value,
                     [&](const char* name, const auto& field, auto...) { object[name] = to_json(field); });
    return object;
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
inline std::string text_of(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trunnion::bus
