// SPDX-License-Identifier: Apache-2.0
// How the generated registry makes its entries.
#pragma once

#include "bus/bus.hpp"
#include "bus/json.hpp"
#include "bus/registry.hpp"

namespace trunnion::bus {

template <class T>
Json sample_to_json(std::span<const std::uint8_t> cdr) {
  T value;
  if (!decode(cdr, value)) throw CdrError(std::string("bytes that are not a ") + Fields<T>::name);
  return to_json(value);
}

template <class T>
TopicEntry typed_entry(const Topic<T>& topic, const char* handle, const char* schema, const char* about,
                       std::vector<std::string> writers, std::vector<std::string> readers) {
  return {describe(topic),    topic.qos,         handle, Fields<T>::name, schema, about, std::move(writers),
          std::move(readers), &sample_to_json<T>};
}

}  // namespace trunnion::bus
