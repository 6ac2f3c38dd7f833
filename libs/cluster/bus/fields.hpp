// SPDX-License-Identifier: Apache-2.0
// What the generated types offer to everything that walks over them: CDR, JSON, hashing.
#pragma once

#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

namespace trunnion::bus {

/// Specialised for every IDL struct: name, keyed, visit(value, visitor) and visit_key(value, visitor).
/// The visitor is called as visitor(field name, field, bound[, bound of the elements]); a bound of 0 means
/// none.
template <class T>
struct Fields;

/// Specialised for every IDL enum: names[] in the order of the values.
template <class E>
struct EnumNames;

template <class T>
concept Struct = requires {
  Fields<T>::name;
};

template <class E>
concept Enumeration = requires {
  EnumNames<E>::names;
};

template <Enumeration E>
constexpr std::size_t enum_size() {
  return std::size(EnumNames<E>::names);
}

template <Enumeration E>
constexpr const char* to_string(E value) {
  const auto index = static_cast<std::size_t>(value);
  return index < enum_size<E>() ? EnumNames<E>::names[index] : "?";
}

/// The enumerator of this name as in the IDL; nothing when there is none.
template <Enumeration E>
constexpr std::optional<E> from_string(std::string_view name) {
  for (std::size_t i = 0; i < enum_size<E>(); ++i)
    if (name == EnumNames<E>::names[i]) return static_cast<E>(i);
  return std::nullopt;
}

}  // namespace trunnion::bus
