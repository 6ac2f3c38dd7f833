// SPDX-License-Identifier: Apache-2.0
// One block of the NUM dialect, word by word.
#pragma once

#include <cstdint>
#include <string_view>

#include "language/block.hpp"
#include "language/letters.hpp"
#include "language/num_codes.hpp"
#include "language/num_expression.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {

/// A function of NUM that is not there.
inline constexpr const char* thread_cycle = "thread cutting cycle";

/// num_dialect.hpp says what may be in a block. Every fault has the place in the line.
class NumReader {
 public:
  NumReader(std::string_view line, SkipLevels skip, Variables& variables, Block& block)
      : line_(line),
        skip_(skip),
        scanner_(line),
        variables_(variables),
        expressions_(scanner_, variables),
        block_(block) {}

  Fault read();

 private:
  Fault item();
  Fault structure(Statement statement, std::uint16_t at);
  Fault end_of_block();
  Fault e_item(std::uint16_t at);

  /// The thread of the block may begin in phase with one that is there: EC is its angle.
  bool takes_up() const { return thread_ == NumUse::one_pass || thread_ == NumUse::resumed; }

  /// EC, EX and EZ of G33; G38+ has its EC already.
  Fault taught_word(char name, std::uint16_t at);

  /// EC elsewhere: the angle of the synchronizations that are ordered from now on.
  Fault spindle_angle(std::uint16_t at);
  Fault order(std::uint32_t number, double value, std::uint16_t at);
  Fault assigned(double& value);
  Fault assign_variable(std::uint16_t at);
  Fault assign_parameter(std::uint16_t at);

  /// The number behind a letter: literal, or the value of a variable or parameter.
  Fault number(std::uint16_t at, double& value);
  Fault word(char name, std::uint16_t at);

  /// `name` may be one of the axes of G159.
  bool homes(char name) const { return homes_ && (Block::bit(name) & axis_bits) != 0; }
  /// It is, and has no number.
  bool names_axis(char name);
  Fault sequence_number(std::uint16_t at);
  Fault add_m(double value, std::uint16_t at);
  void store(char name, double value, std::uint16_t at);
  Fault g_word(std::uint16_t at);
  Fault thread(NumUse use, std::uint16_t at);
  Fault jump(std::uint16_t at);

  // What must hold of the whole block, and what becomes of its words (num_completion.cpp).
  Fault complete();
  /// An order is carried out at rest, so it would end the thread that its block continues. In a block with a
  /// code of a thread, or with G39+, EC is no order.
  Fault check_order() const;
  Fault complete_thread();

  /// The words of G33.
  Fault check_one_pass() const;

  /// Of the first of `letters` in the alphabet.
  std::uint16_t first_offset(std::uint32_t letters) const;
  Fault check_no_call() const;

  /// G77 H is M98 with its program: it comes behind the words of its block.
  Fault complete_call();
  Fault check_no_tap() const;
  Fault check_tap() const;
  static Fault wrong_removal(std::uint16_t at) { return {AlarmNumber::num_removal_words, at, "NUM error 2"}; }

  /// The sense in which the spindle turns while the tap moves out is that of the hand of its thread: a
  /// right-hand one comes out counter-clockwise. The PLC gets neither M3 and M4 nor the range. M2 ends it,
  /// and the programs that have called this one: what they would move next does not know of the tap.
  Fault complete_removal();

  /// The time of G4 is a word X of the codes here, in seconds.
  Fault complete_dwell();

  std::string_view line_;
  SkipLevels skip_;
  Scanner scanner_;
  Variables& variables_;
  NumExpressionReader expressions_;
  Block& block_;
  bool done_ = false;  // nothing more of the line is read
  bool any_ = false;   // more than N was read: no structure or jump may come
  bool assigned_ = false;
  bool orders_ = false, orders_angle_ = false;
  bool calls_ = false, dwells_ = false, homes_ = false, taps_ = false, removes_ = false;
  NumUse thread_ = NumUse::code;  // that of G33, G38 or G38+; code: the block has none of them
  std::uint16_t call_at_ = 0, dwell_at_ = 0, thread_at_ = 0, tap_at_ = 0, removal_at_ = 0;
  std::uint16_t order_at_ = 0, angle_at_ = 0;
};

}  // namespace trunnion::language
