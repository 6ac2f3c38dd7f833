// SPDX-License-Identifier: Apache-2.0
// To CDR bytes and back. The build instantiates these for every type of idl/ once (contracts/codec_*.cpp), so
// that no other source compiles a visitor of fields; for types with Fields of their own, include bus/cdr.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bus/fields.hpp"

namespace trunnion::bus {

using Bytes = std::vector<std::uint8_t>;
using KeyHash = std::array<std::uint8_t, 16>;

inline constexpr std::size_t cdr_header = 4;

/// Thrown by both directions: a value beyond its bound, or bytes that are not this type.
struct CdrError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// CDR with its 4-byte header. Throws CdrError when a string or sequence is beyond its bound.
template <Struct T>
void encode(const T& value, Bytes& out);

/// False when the bytes are not a T, or a field has a value beyond the limits of its IDL or a number that is
/// not finite; `value` is then unspecified, and `why`, if given, names the field.
template <Struct T>
bool decode(std::span<const std::uint8_t> cdr, T& value, std::string* why = nullptr);

/// The RTPS key hash (RTPS 2.3, 9.6.3.8) of a sample: its key in big-endian CDR. False when the bytes are not
/// a T.
template <Struct T>
bool key_of(std::span<const std::uint8_t> cdr, KeyHash& key);

}  // namespace trunnion::bus
