// SPDX-License-Identifier: Apache-2.0
// The records of the MCAP container format, version 0 (mcap.dev/spec), and their primitives: little endian,
// strings and maps behind a 32-bit length in bytes.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "bus/former_names.hpp"
#include "recording/byte_stream.hpp"

namespace trunnion::recording {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");

inline constexpr std::array<std::uint8_t, 8> mcap_magic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Opcode : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  metadata = 12,
  metadata_index = 13,
  summary_offset = 14,
  data_end = 15,
};

/// Opcode and length before the content of every record.
inline constexpr std::size_t record_head = 9;

using StringMap = std::map<std::string, std::string>;

struct Schema {
  std::uint16_t id = 0;  ///< from 1
  std::string name, encoding, data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  ///< 0 = none
  std::string topic, encoding;
  StringMap metadata;
};

struct Metadata {
  std::string name;
  StringMap values;
};

/// Appends records to a byte vector.
class RecordWriter {
 public:
  explicit RecordWriter(Bytes& out) : out_(out) {}

  /// Between begin and end everything put belongs to the record.
  void begin(Opcode opcode) {
    put(static_cast<std::uint8_t>(opcode));
    length_at_ = out_.size();
    put(std::uint64_t{0});
  }
  void end() {
    const std::uint64_t length = out_.size() - length_at_ - 8;
    std::memcpy(out_.data() + length_at_, &length, 8);
  }

  template <std::unsigned_integral T>
  void put(T value) {
    std::uint8_t bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    put(std::span<const std::uint8_t>(bytes));
  }
  void put(std::span<const std::uint8_t> bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    put(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  void put(const StringMap& map) {
    std::uint32_t length = 0;
    for (const auto& [key, value] : map) length += static_cast<std::uint32_t>(8 + key.size() + value.size());
    put(length);
    for (const auto& [key, value] : map) {
      put(std::string_view(key));
      put(std::string_view(value));
    }
  }

 private:
  Bytes& out_;
  std::size_t length_at_ = 0;
};

/// Takes a record's content apart. Every length is checked against what is left; after the first that does
/// not fit, ok() is false and everything read is zero or empty.
class RecordReader {
 public:
  explicit RecordReader(std::span<const std::uint8_t> data) : data_(data) {}

  template <std::unsigned_integral T>
  T number() {
    T value = 0;
    const auto bytes = take(sizeof(T));
    if (bytes.size() == sizeof(T)) std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  std::span<const std::uint8_t> take(std::uint64_t count) {
    if (count > data_.size()) {
      ok_ = false;
      data_ = {};
    }
    if (!ok_) return {};
    const auto result = data_.first(static_cast<std::size_t>(count));
    data_ = data_.subspan(static_cast<std::size_t>(count));
    return result;
  }
  std::string text() {
    const auto bytes = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  StringMap map() {
    StringMap result;
    RecordReader inner(take(number<std::uint32_t>()));
    while (inner.left() > 0) {
      auto key = inner.text();
      auto value = inner.text();
      if (!inner.ok()) ok_ = false;
      if (inner.ok()) result[std::move(key)] = std::move(value);
    }
    return result;
  }
  std::span<const std::uint8_t> rest() { return take(data_.size()); }
  std::size_t left() const { return data_.size(); }
  bool ok() const { return ok_; }

 private:
  std::span<const std::uint8_t> data_;
  bool ok_ = true;
};

inline Schema read_schema(RecordReader& in) {
  Schema schema;
  schema.id = in.number<std::uint16_t>();
  schema.name = bus::with_names_of_today(in.text());
  schema.encoding = in.text();
  schema.data = bus::with_names_of_today(in.text());
  return schema;
}

inline Channel read_channel(RecordReader& in) {
  Channel channel;
  channel.id = in.number<std::uint16_t>();
  channel.schema = in.number<std::uint16_t>();
  channel.topic = bus::with_names_of_today(in.text());
  channel.encoding = in.text();
  channel.metadata = in.map();
  if (const auto handle = channel.metadata.find("handle"); handle != channel.metadata.end())
    handle->second = bus::with_names_of_today(handle->second);
  return channel;
}

}  // namespace trunnion::recording
