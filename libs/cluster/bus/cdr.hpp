// SPDX-License-Identifier: Apache-2.0
// XCDR1 (PLAIN_CDR, little endian) of the generated types: what goes over the wire and into recordings.
// Source: OMG DDS-XTypes 1.3, 7.4.1 to 7.4.3; primitives are aligned to their size, at most 8, from the end
// of the header.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bus/codec.hpp"
#include "bus/fields.hpp"

namespace trunnion::bus {

static_assert(std::endian::native == std::endian::little, "the bus writes memory as it is");

/// Appends values to a byte vector that is reused from message to message, so that the steady state does not
/// allocate.
class CdrWriter {
 public:
  explicit CdrWriter(Bytes& out, bool big_endian = false) : out_(out), big_endian_(big_endian) {
    out_.assign(cdr_header, 0);
    out_[1] = big_endian ? 0 : 1;
  }

  template <class T>
  void operator()(const char* name, const T& value, std::size_t bound, std::size_t element_bound = 0) {
    name_ = name;
    write(value, bound, element_bound);
  }

 private:
  template <class T>
  void write(const T& value, std::size_t bound, std::size_t element_bound = 0) {
    if constexpr (Struct<T>) {
      Fields<T>::visit(value, *this);
    } else if constexpr (std::is_enum_v<T>) {
      primitive(static_cast<std::uint32_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      primitive(value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      check(value.size(), bound);
      primitive(static_cast<std::uint32_t>(value.size() + 1));
      append(value.c_str(), value.size() + 1);
    } else {
      check(value.size(), bound);
      primitive(static_cast<std::uint32_t>(value.size()));
      using Element = typename T::value_type;
      if constexpr (std::is_arithmetic_v<Element>) {
        if (!value.empty()) {
          align(sizeof(Element));
          append(value.data(), value.size() * sizeof(Element));
        }
      } else {
        for (const auto& element : value) write(element, element_bound);
      }
    }
  }

  void check(std::size_t size, std::size_t bound) const {
    if (bound != 0 && size > bound)
      throw CdrError(std::string(name_) + ": " + std::to_string(size) + " elements, at most " +
                     std::to_string(bound));
  }
  void align(std::size_t size) {
    const std::size_t at = out_.size() - cdr_header;
    out_.resize(out_.size() + ((size - at % size) % size), 0);
  }
  void append(const void* data, std::size_t size) {
    const std::size_t at = out_.size();
    out_.resize(at + size);
    std::memcpy(out_.data() + at, data, size);
  }
  template <class T>
  void primitive(T value) {
    align(sizeof(T));
    if constexpr (sizeof(T) > 1) {
      if (big_endian_) {
        std::uint8_t bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
        append(bytes, sizeof(T));
        return;
      }
    }
    append(&value, sizeof(T));
  }

  Bytes& out_;
  bool big_endian_;
  const char* name_ = "";
};

/// Reads what CdrWriter wrote. Never trusts a length: every one is checked against the bytes left and the
/// bound.
class CdrReader {
 public:
  /// `checks_values`: refuses values beyond the limits of their field and numbers that are not finite.
  explicit CdrReader(std::span<const std::uint8_t> data, bool checks_values = true)
      : data_(data), checks_values_(checks_values) {
    if (data.size() < cdr_header || data[0] != 0 || data[1] != 1)
      throw CdrError("not little-endian plain CDR");
    data_ = data.subspan(cdr_header);
  }

  template <Struct T>
  void read(T& value) {
    Fields<T>::visit(value, *this);
    if constexpr (requires { Fields<T>::visit_limits(value, Limits{}); })
      if (checks_values_) Fields<T>::visit_limits(value, Limits{});
  }
  template <class T>
  void operator()(const char* name, T& value, std::size_t bound, std::size_t element_bound = 0) {
    name_ = name;
    read(value, bound, element_bound);
  }

 private:
  struct Limits {
    template <class T>
    void operator()(const char* name, const T& value, std::int64_t low, std::int64_t high) const {
      if (std::cmp_less(value, low) || std::cmp_greater(value, high))
        throw CdrError(std::string(name) + ": " + std::to_string(value) + ", must be " + std::to_string(low) +
                       " to " + std::to_string(high));
    }
  };

  template <class T>
  void read(T& value, std::size_t bound, std::size_t element_bound = 0) {
    if constexpr (Struct<T>) {
      read(value);
    } else if constexpr (std::is_enum_v<T>) {
      const auto raw = primitive<std::uint32_t>();
      if (raw >= enum_size<T>()) throw CdrError(std::string(name_) + ": no such enumerator");
      value = static_cast<T>(raw);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = primitive<std::uint8_t>() != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = primitive<T>();
      check_finite(&value, 1);
    } else if constexpr (std::is_same_v<T, std::string>) {
      const std::size_t size = primitive<std::uint32_t>();
      if (size == 0 || size > data_.size() - at_) throw CdrError(std::string(name_) + ": string cut off");
      check(size - 1, bound);
      value.assign(reinterpret_cast<const char*>(data_.data() + at_), size - 1);
      at_ += size;
    } else {
      const std::size_t size = primitive<std::uint32_t>();
      check(size, bound);
      using Element = typename T::value_type;
      if constexpr (std::is_arithmetic_v<Element>) {
        if (size == 0) {
          value.clear();
          return;
        }
        align(sizeof(Element));
        if (size > (data_.size() - at_) / sizeof(Element)) throw CdrError(std::string(name_) + ": cut off");
        value.resize(size);
        std::memcpy(value.data(), data_.data() + at_, size * sizeof(Element));
        at_ += size * sizeof(Element);
        check_finite(value.data(), size);
      } else {
        if (size > data_.size() - at_) throw CdrError(std::string(name_) + ": cut off");
        value.resize(size);
        for (auto& element : value) read(element, element_bound);
      }
    }
  }

  void check(std::size_t size, std::size_t bound) const {
    if (bound != 0 && size > bound) throw CdrError(std::string(name_) + ": longer than its bound");
  }
  // No contract has a meaning for NaN or infinity, and every service that computes with one spreads it.
  template <class T>
  void check_finite([[maybe_unused]] const T* values, [[maybe_unused]] std::size_t size) const {
    if constexpr (std::is_floating_point_v<T>) {
      if (!checks_values_) return;
      bool all = true;
      for (std::size_t i = 0; i < size; ++i) all = all && std::isfinite(values[i]);
      if (!all) throw CdrError(std::string(name_) + ": not a finite number");
    }
  }
  void align(std::size_t size) {
    at_ += (size - at_ % size) % size;
    if (at_ > data_.size()) throw CdrError(std::string(name_) + ": cut off");
  }
  template <class T>
  T primitive() {
    align(sizeof(T));
    if (sizeof(T) > data_.size() - at_) throw CdrError(std::string(name_) + ": cut off");
    T value;
    std::memcpy(&value, data_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  std::span<const std::uint8_t> data_;
  bool checks_values_;
  std::size_t at_ = 0;
  const char* name_ = "";
};

template <Struct T>
void encode(const T& value, Bytes& out) {
  CdrWriter writer(out);
  Fields<T>::visit(value, writer);
}

template <Struct T>
bool decode(std::span<const std::uint8_t> cdr, T& value, std::string* why) {
  try {
    CdrReader(cdr).read(value);
    return true;
  } catch (const std::exception& problem) {
    if (why != nullptr) *why = problem.what();
    return false;
  }
}

template <Struct T>
bool key_of(std::span<const std::uint8_t> cdr, KeyHash& key) {
  thread_local T value;
  thread_local Bytes bytes;
  // Whatever its values are: the reader is to see them and refuse the sample.
  try {
    CdrReader(cdr, false).read(value);
  } catch (const std::exception&) {
    return false;
  }
  CdrWriter writer(bytes, true);
  Fields<T>::visit_key(value, writer);
  key.fill(0);
  std::memcpy(key.data(), bytes.data() + cdr_header, std::min<std::size_t>(16, bytes.size() - cdr_header));
  return true;
}

}  // namespace trunnion::bus
