// A block as a reader hands it to the interpreter: letters and numbers, nothing resolved.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "language/alarms.hpp"

namespace trunnion::language {

inline constexpr std::size_t max_g_codes = 12;
inline constexpr std::size_t max_m_codes = 4;

/// One G or M of a block.
struct CodeWord {
  double value = 0;
  std::uint16_t offset = 0;  ///< byte of the line, from 0
};

enum class Head : std::uint8_t {
  none,
  tape_mark,  ///< a lone %: before the program its start, behind it its end
  program,    ///< %1234 or O1234
};

/// A letter but G and M stands at most once in a block, so words are looked up by letter.
struct Block {
  Head head = Head::none;
  bool skip = false;  ///< begins with /
  std::uint8_t g_count = 0;
  std::uint8_t m_count = 0;
  std::uint32_t program_number = 0;
  std::uint32_t letters = 0;  ///< bit 0 = A .. bit 25 = Z; G and M are not in it
  std::array<double, 26> values{};
  std::array<std::uint16_t, 26> offsets{};
  std::array<CodeWord, max_g_codes> g{};
  std::array<CodeWord, max_m_codes> m{};

  static constexpr std::uint32_t bit(char letter) { return 1u << (letter - 'A'); }
  bool has(char letter) const { return (letters & bit(letter)) != 0; }
  double value(char letter) const { return values[static_cast<std::size_t>(letter - 'A')]; }
  std::uint16_t offset(char letter) const { return offsets[static_cast<std::size_t>(letter - 'A')]; }
  bool empty() const { return letters == 0 && g_count == 0 && m_count == 0; }
  /// Makes the block empty; values of absent letters keep what they had and mean nothing.
  void clear() {
    head = Head::none;
    skip = false;
    g_count = m_count = 0;
    letters = 0;
  }
};

/// How one dialect writes blocks. Implementations keep no state.
class Dialect {
 public:
  virtual ~Dialect() = default;
  /// Reads one line (without its line end) into `block`.
  virtual Fault read_block(std::string_view line, Block& block) const = 0;
  /// The program number if the line begins a program: a quick look, for finding subprograms.
  virtual std::optional<std::uint32_t> program_head(std::string_view line) const = 0;
};

}  // namespace trunnion::language
