// SPDX-License-Identifier: Apache-2.0
// The programs that the codes of a block call: by the table of codes, or by a parameter of the channel.
#pragma once

#include "analysis/block_codes.hpp"
#include "language/block_watch.hpp"
#include "language/environment.hpp"
#include "language/macro_call.hpp"

namespace trunnion::analysis {

/// M98, M198 and CYCLE1234() are not among them.
class BlockCalls {
 public:
  explicit BlockCalls(const language::Environment& environment) : codes_(environment.code_calls()) {
    for (std::size_t i = 0; i < cycle_m_codes_.size(); ++i) cycle_m_codes_[i] = environment.cycle_m_code(i);
  }
  BlockCalls(const BlockCalls&) = delete;
  BlockCalls& operator=(const BlockCalls&) = delete;

  /// Whether the block has one: call().
  bool find(const language::SeenBlock& seen) {
    constexpr language::CycleMCodes none{};
    const bool num = seen.dialect == language::ProgramDialect::num;
    rest_ = &seen.block;
    if (is_linuxcnc(seen.block)) return false;
    if (!num && by_code(seen.block)) return true;
    return language::find_call(seen.block, num ? none : cycle_m_codes_, call_);
  }
  const language::Call& call() const { return call_; }
  /// The letters of the block are its arguments; else it comes behind what rest() does.
  bool takes_letters() const { return call_.kind != language::CallKind::subprogram; }
  /// The block that find() has got, without the code that calls a subprogram. As long as that block lives.
  const language::Block& rest() const { return *rest_; }

 private:
  bool by_code(const language::Block& block) {
    if (codes_ == language::CodeCalls{}) return false;
    std::uint32_t variable = 0;
    double value = 0;
    without_code_ = block;
    if (!language::take_code_call(without_code_, codes_, call_, variable, value)) return false;
    rest_ = &without_code_;
    return true;
  }

  language::CodeCalls codes_;
  language::CycleMCodes cycle_m_codes_{};
  language::Call call_;
  language::Block without_code_;
  const language::Block* rest_ = &without_code_;  // or that of find()
};

}  // namespace trunnion::analysis
