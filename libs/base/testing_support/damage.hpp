// SPDX-License-Identifier: Apache-2.0
// Eight ways in which a kept file is damaged.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace trunnion::testing_support {

enum class Damage {
  empty,
  half,
  one_byte_short,
  random_bytes,
  one_bit,
  missing,
  old_generation,
  other_content
};

inline constexpr Damage all_damages[] = {Damage::empty,          Damage::half,         Damage::one_byte_short,
                                         Damage::random_bytes,   Damage::one_bit,      Damage::missing,
                                         Damage::old_generation, Damage::other_content};

inline const char* name_of(Damage damage) {
  constexpr const char* names[] = {"empty",   "half",    "one_byte_short", "random_bytes",
                                   "one_bit", "missing", "old_generation", "other_content"};
  return names[static_cast<int>(damage)];
}

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Replaces the file, so that a hard link to it keeps its content.
inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

/// `old` is the file's content of an earlier time, `other` that of another kept file. `seed` decides the
/// random bytes and the bit.
inline void damage(const std::filesystem::path& path, Damage how, const std::string& old,
                   const std::string& other, unsigned seed) {
  auto bytes = read_bytes(path);
  std::mt19937 random(seed);
  switch (how) {
    case Damage::empty:
      bytes.clear();
      break;
    case Damage::half:
      bytes.resize(bytes.size() / 2);
      break;
    case Damage::one_byte_short:
      if (!bytes.empty()) bytes.pop_back();
      break;
    case Damage::random_bytes:
      for (auto& byte : bytes) byte = static_cast<char>(random());
      break;
    case Damage::one_bit:
      if (!bytes.empty()) bytes[random() % bytes.size()] ^= static_cast<char>(1u << random() % 8);
      break;
    case Damage::missing:
      std::filesystem::remove(path);
      return;
    case Damage::old_generation:
      bytes = old;
      break;
    case Damage::other_content:
      bytes = other;
      break;
  }
  write_bytes(path, bytes);
}

}  // namespace trunnion::testing_support
