// SPDX-License-Identifier: Apache-2.0
// One block of the LinuxCNC dialect, word by word.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "language/block.hpp"
#include "language/letters.hpp"
#include "language/linuxcnc_expression.hpp"
#include "language/linuxcnc_line.hpp"
#include "language/linuxcnc_scanner.hpp"

namespace trunnion::language {

/// linuxcnc_dialect.hpp says what may be in a block. Every fault has the place in the line.
class LinuxcncReader {
 public:
  LinuxcncReader(std::string_view line, SkipLevels skip, Variables& variables, Block& block)
      : line_(line),
        skip_(skip),
        scanner_(line),
        variables_(variables),
        expressions_(scanner_, variables),
        block_(block) {}

  Fault read();

 private:
  Fault item();
  Fault setting(std::uint16_t at);
  Fault word(char name, std::uint16_t at);
  Fault g_word(double value, std::uint16_t at);
  Fault m_word(double value, std::uint16_t at);
  Fault spindle_number(std::uint16_t at);
  void store(char name, double value, std::uint16_t at);

  // O words (linuxcnc_o_words.cpp).
  Fault o_word(std::uint16_t at);
  Fault o_name(std::uint16_t at, OName& name, bool& computed);
  Fault o_operands(std::uint16_t at);
  Fault arguments();
  Fault repetitions(std::uint16_t at);

  // What must hold of the whole block, and what becomes of its words (linuxcnc_completion.cpp).
  Fault complete();
  Fault complete_m();
  Fault complete_state();
  Fault complete_calls();
  Fault complete_override(std::size_t index, bool& dropped);
  Fault complete_orientation(std::uint16_t at);
  void sort_m();
  void drop_m(std::size_t index);
  void drop(char letter) { block_.letters &= ~Block::bit(letter); }
  Fault assign();

  // The last comment of a block may be an order (linuxcnc_comments.cpp).
  Fault complete_comment();
  Fault show(std::string_view text, bool expands);
  void append(char c) {
    if (block_.text_size < block_.text.size()) block_.text[block_.text_size++] = c;
  }
  void append(double value, int decimals);
  /// Appends the value of the parameter that `text` begins with, whose # is passed.
  void expand(std::string_view& text, int decimals);

  /// #3=.. or #<name>=..; carried out when the whole block has been read.
  struct Setting {
    ParameterName parameter;
    double value = 0;
  };
  static constexpr std::size_t most_settings = 32;

  std::string_view line_;
  SkipLevels skip_;
  LinuxcncScanner scanner_;
  Variables& variables_;
  LinuxcncExpression expressions_;
  Block& block_;
  std::array<Setting, most_settings> settings_;
  std::size_t setting_count_ = 0;
  bool done_ = false;         // nothing more of the line is read
  std::string_view comment_;  // the last one
  std::uint16_t comment_at_ = 0;
};

}  // namespace trunnion::language
