// SPDX-License-Identifier: Apache-2.0
// Names of a program as numbers: of O words and of named parameters (LinuxCNC).
#pragma once

#include <cstdint>
#include <string_view>

namespace trunnion::language {

/// Spreads every bit over all of them; never two numbers to one.
constexpr std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
  return value ^ (value >> 31);
}

/// What stands for a name or number in comparisons: above 2^32, so that it is no number of DO, and below
/// 2^61. Of names it is a hash of 60 bits: two of a million names have the same by a chance of one in two
/// million.
using NameKey = std::uint64_t;

constexpr NameKey number_key(std::uint32_t number) { return (1ull << 32) | number; }

/// Takes the characters of a name, capitals as small letters and without blanks, as LinuxCNC compares them.
class NameHash {
 public:
  constexpr void add(char c) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  constexpr NameKey key() const { return (1ull << 60) | (mixed(hash_) >> 4); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

constexpr NameKey name_key(std::string_view name) {
  NameHash hash;
  for (const char c : name) hash.add(c);
  return hash.key();
}

}  // namespace trunnion::language
