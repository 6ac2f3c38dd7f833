// SPDX-License-Identifier: Apache-2.0
// The words of the block being executed: its codes, its letters, and which of them had a meaning.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "language/block.hpp"
#include "language/codes.hpp"
#include "language/environment.hpp"
#include "language/letters.hpp"

namespace trunnion::language {

inline constexpr double longest_dwell = 99999.999;  // seconds

constexpr std::uint32_t group_bit(Group group) { return 1u << static_cast<unsigned>(group); }

/// The G codes of a block, at most one of each group.
class GCodes {
 public:
  void clear() { present_ = 0; }
  void add(const GCode& code, std::uint16_t at) {
    present_ |= group_bit(code.group);
    codes_[static_cast<std::size_t>(code.group)] = &code;
    offsets_[static_cast<std::size_t>(code.group)] = at;
  }
  /// A bit for each group.
  std::uint32_t present() const { return present_; }
  bool has(Group group) const { return (present_ & group_bit(group)) != 0; }
  bool is(Group group, std::uint16_t tenths) const { return has(group) && code(group).tenths == tenths; }
  /// Of a group that is present.
  const GCode& code(Group group) const { return *codes_[static_cast<std::size_t>(group)]; }
  std::uint16_t offset(Group group) const { return offsets_[static_cast<std::size_t>(group)]; }

 private:
  std::uint32_t present_ = 0;
  std::array<const GCode*, group_count> codes_{};
  std::array<std::uint16_t, group_count> offsets_{};
};

struct MCodes {
  std::array<MCode, max_m_codes> codes{};
  std::array<std::uint16_t, max_m_codes> offsets{};
  std::uint8_t count = 0;
};

/// Gives the words of a block to those who carry its codes out. Lengths and positions come in mm; every word
/// that is asked for counts as used, but for has(), value(), offset() and axis().
class BlockWords {
 public:
  /// `modal` has the units.
  explicit BlockWords(const ModalState& modal) : modal_(modal) {}

  /// For the channel of `machine`, which must live as long as its words are read.
  void configure(const Environment& machine);

  /// The next block, which must live as long as its words are read. Checks its numbers and its codes.
  Fault begin(const Block& block);

  const GCodes& g() const { return g_; }
  const MCodes& m() const { return m_; }
  std::uint32_t letters() const { return block_->letters; }
  bool has(char letter) const { return block_->has(letter); }
  double value(char letter) const { return block_->value(letter); }
  std::uint16_t offset(char letter) const { return block_->offset(letter); }
  /// Where the first of `letters`, at least one of which the block has, is in the alphabet.
  std::uint16_t offset_of_any(std::uint32_t letters) const {
    return block_->offsets[static_cast<std::size_t>(std::countr_zero(letters & block_->letters))];
  }
  /// Where the block's first code is, or its first letter when it has none.
  std::uint16_t first_offset() const;
  bool has_codes() const { return block_->g_count != 0 || block_->m_count != 0; }
  /// As Block::two_tools.
  bool two_tools() const { return block_->two_tools; }
  /// As Block::message.
  bool shows_message() const { return block_->message; }
  /// As Block::haas, Block::every_axis and Block::work_offset.
  bool haas() const { return block_->haas; }
  bool every_axis() const { return block_->every_axis; }
  std::uint8_t work_offset() const { return block_->work_offset; }
  /// As Block::local_call.
  bool calls_locally() const { return block_->local_call; }
  /// Radii of tools per number in the block (G10).
  double radius_scale() const { return block_->haas && !radius_offsets_ ? 0.5 : 1.0; }
  /// As Block::spindle_codes.
  bool spindle_codes() const { return block_->spindle_codes; }
  /// The block has the codes of LinuxCNC.
  bool linuxcnc() const { return block_->table == CodeTable::linuxcnc; }
  /// As Block::called.
  std::uint32_t called() const { return block_->called; }
  /// As Block::lead_word and Block::thread.
  char lead_word() const { return block_->lead_word; }
  ThreadBlock thread() const { return block_->thread; }
  /// One G code and nothing else but the sequence number.
  bool single_code() const;

  void use(char letter) { used_ |= Block::bit(letter); }
  void use_axes() { used_ |= block_->letters & axis_bits; }
  bool axes_used() const { return (used_ & block_->letters & axis_bits) != 0; }
  bool used(char letter) const { return (used_ & Block::bit(letter)) != 0; }
  /// An alarm at the first word that had no meaning.
  Fault report_unused() const;

  /// The control or the machine's logic carries M`code` out.
  bool has_function(const MCode& code) const { return is_granted(code.number) || reaches_logic(code); }
  /// It makes a command: where no machine is known every M code does.
  bool reaches_logic(const MCode& code) const;
  /// P, Q, R and H that nothing has taken are for the logic where an M code that is in no table may have
  /// them.
  void leave_to_logic();
  /// A whole number in [low, high].
  Fault whole_number(char letter, std::uint32_t low, std::uint32_t high, std::uint32_t& value);
  /// Seconds: P in milliseconds, or as the machine takes a decimal point in it (P1.5).
  Fault dwell(double longest, double& seconds);
  /// mm, 0 when absent.
  double length(char letter);
  /// mm or degrees, as programmed for the axis (diameters halved).
  double axis(std::size_t axis) const;
  /// A word that counts as those of `axis`.
  double along(char letter, std::size_t axis) {
    use(letter);
    return in_axis_unit(block_->value(letter), axis);
  }
  /// The axes named, a bit for each; the channel must have them.
  Fault find_axes(std::uint32_t& axes) const;
  /// The axes named, at least one, all of them used.
  Fault take_axes(std::uint16_t at, std::uint32_t& axes);
  /// mm of a length word's unit.
  double length_scale() const { return modal_.metric ? 1.0 : 25.4; }

 private:
  double in_axis_unit(double word, std::size_t axis) const;
  Fault check_numbers() const;
  Fault collect_g();
  Fault collect_m();

  const ModalState& modal_;
  const Block* block_ = nullptr;
  GCodes g_;
  MCodes m_;
  std::uint32_t used_ = 0;
  std::uint16_t channel_axes_ = 0;
  bool diameter_ = false;
  const MFunctions* functions_ = nullptr;
  DwellPoint dwell_point_ = DwellPoint::refused;
  bool radius_offsets_ = false, words_for_logic_ = false;
};

}  // namespace trunnion::language
