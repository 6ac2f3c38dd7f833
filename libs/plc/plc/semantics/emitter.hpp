// SPDX-License-Identifier: Apache-2.0
// Collects the instructions of one routine.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "plc/machine/byte_code.hpp"

namespace trunnion::st {

/// A loop of the source, by its Op::loop.
struct Loop {
  Position at;
  std::optional<std::int64_t> runs;  ///< of its body at most; nothing: not known
};

class Emitter {
 public:
  explicit Emitter(std::uint32_t first_temporary)
      : first_(first_temporary), next_(first_temporary), frame_(first_temporary) {}

  std::size_t add(Op op, std::int32_t a = 0, std::int32_t b = 0, std::int32_t c = 0, std::uint16_t n = 0) {
    code_.push_back({op, n, a, b, c});
    return code_.size() - 1;
  }
  /// The place of the instructions that follow.
  void place(Position at) {
    if (lines_.empty() || lines_.back().at.line != at.line || lines_.back().at.column != at.column)
      lines_.push_back({static_cast<std::uint32_t>(code_.size()), at});
  }
  /// Cells for an intermediate result.
  std::int32_t temporary(std::uint32_t cells = 1) {
    const auto result = next_;
    next_ += cells;
    frame_ = std::max(frame_, next_);
    return static_cast<std::int32_t>(result);
  }
  std::uint32_t mark() const { return next_; }
  /// Temporaries behind the mark are free.
  void release(std::uint32_t mark) { next_ = mark; }
  bool is_temporary(std::int32_t cell) const { return static_cast<std::uint32_t>(cell) >= first_; }

  void constant(std::int32_t cell, std::uint64_t value) {
    add(Op::constant, cell, static_cast<std::int32_t>(static_cast<std::uint32_t>(value)),
        static_cast<std::int32_t>(static_cast<std::uint32_t>(value >> 32)));
  }
  std::size_t here() const { return code_.size(); }
  void jump_to_here(std::size_t instruction) {
    code_[instruction].a = static_cast<std::int32_t>(here());
    last_target_ = here();
  }
  /// Jumps lead here.
  void target() { last_target_ = here(); }
  void set_jump(std::size_t instruction, std::size_t target) {
    code_[instruction].a = static_cast<std::int32_t>(target);
  }
  void jump_to_here(const std::vector<std::size_t>& instructions) {
    for (const auto i : instructions) jump_to_here(i);
  }
  /// The last instruction writes to the cell `to` instead, when it has written the temporary `from`.
  bool redirect(std::int32_t from, std::int32_t to);

  /// Op::loop at the end of the statement at `at`; at most `runs` runs of the body lead to it.
  void loop(std::size_t target, Position at, std::optional<std::int64_t> runs = std::nullopt) {
    loops_[add(Op::loop, static_cast<std::int32_t>(target))] = {at, runs};
  }

  std::vector<Instruction>& code() { return code_; }
  const std::map<std::size_t, Loop>& loops() const { return loops_; }
  const std::vector<LineEntry>& lines() const { return lines_; }
  std::uint32_t frame() const { return frame_; }

 private:
  std::vector<Instruction> code_;
  std::vector<LineEntry> lines_;
  std::map<std::size_t, Loop> loops_;
  std::uint32_t first_, next_, frame_;
  std::size_t last_target_ = 0;  ///< of a jump
};

/// Whether operand a of the instruction is a cell that it writes and does not read.
bool only_writes_first(Op op);

}  // namespace trunnion::st
