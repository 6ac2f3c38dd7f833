// SPDX-License-Identifier: Apache-2.0
// The explicit state of a service as JSON, with one list of fields for writing and reading. A class lists its
// fields in `template <class Self, class Visit> static void fields(Self& self, Visit&& visit)`, which calls
// visit("name", self.member_) for each; types of idl/ have their list already.
#pragma once

#include <array>
#include <concepts>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "bus/json.hpp"

namespace trunnion::snapshot {

using bus::Json;

/// A class with a list of fields.
template <class T>
concept Listed = requires(T& value) {
  T::fields(value, [](const char*, auto&) {});
};

/// Numbers exact to the bit, enumerators as numbers.
template <class T>
Json written(const T& value);
/// Throws nlohmann::json::exception for JSON of another shape. Fields that `json` does not have keep their
/// value, also in elements that `value` has already; those that `value` does not have are passed over:
/// another build may read it.
template <class T>
void read(const Json& json, T& value);

namespace detail {

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t size>
struct IsArray<std::array<T, size>> : std::true_type {};
template <class T>
struct IsMap : std::false_type {};
template <class Key, class T>
struct IsMap<std::map<Key, T>> : std::true_type {};
template <class T>
struct IsSequence : std::false_type {};
template <class T, class Allocator>
struct IsSequence<std::vector<T, Allocator>> : std::true_type {};

template <class T, class Visit>
void visit_fields(T& value, Visit&& visit) {
  using Plain = std::remove_const_t<T>;
  if constexpr (bus::Struct<Plain>)
    bus::Fields<Plain>::visit(value, [&](const char* name, auto& field, auto...) { visit(name, field); });
  else
    Plain::fields(value, visit);
}

template <class T>
constexpr bool plain = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

}  // namespace detail

template <class T>
Json written(const T& value) {
  if constexpr (std::is_same_v<T, Json>) {
    return value;
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<std::underlying_type_t<T>>(value);
  } else if constexpr (detail::plain<T>) {
    return value;
  } else if constexpr (detail::IsOptional<T>::value) {
    return value ? Json::array({written(*value)}) : Json::array();
  } else if constexpr (detail::IsMap<T>::value) {
    Json pairs = Json::array();
    for (const auto& [key, element] : value) pairs.push_back(Json::array({written(key), written(element)}));
    return pairs;
  } else if constexpr (detail::IsArray<T>::value || detail::IsSequence<T>::value) {
    Json elements = Json::array();
    for (const auto& element : value)
      elements.push_back(written(static_cast<const typename T::value_type&>(element)));
    return elements;
  } else {
    Json object = Json::object();
    detail::visit_fields(value, [&](const char* name, const auto& field) { object[name] = written(field); });
    return object;
  }
}

template <class T>
void read(const Json& json, T& value) {
  if constexpr (std::is_same_v<T, Json>) {
    value = json;
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(json.get<std::underlying_type_t<T>>());
  } else if constexpr (detail::plain<T>) {
    value = json.get<T>();
  } else if constexpr (detail::IsOptional<T>::value) {
    if (json.empty())
      value.reset();
    else
      read(json.at(0), value ? *value : value.emplace());
  } else if constexpr (detail::IsMap<T>::value) {
    std::map<typename T::key_type, bool> found;
    for (const auto& pair : json) {
      typename T::key_type key{};
      read(pair.at(0), key);
      found[key] = true;
      read(pair.at(1), value[key]);
    }
    std::erase_if(value, [&](const auto& entry) { return !found.contains(entry.first); });
  } else if constexpr (detail::IsArray<T>::value) {
    for (std::size_t i = 0; i < value.size(); ++i) read(json.at(i), value[i]);
  } else if constexpr (detail::IsSequence<T>::value) {
    value.resize(json.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      if constexpr (std::is_same_v<typename T::value_type, bool>)
        value[i] = json.at(i).template get<bool>();
      else
        read(json.at(i), value[i]);
    }
  } else {
    detail::visit_fields(value, [&](const char* name, auto& field) {
      if (const auto found = json.find(name); found != json.end()) read(*found, field);
    });
  }
}

}  // namespace trunnion::snapshot
