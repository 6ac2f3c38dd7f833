// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/emitter.hpp"

#include <array>

namespace trunnion::st {

bool only_writes_first(Op op) {
  static constexpr std::array first = std::to_array<char>({
#define TRUNNION_ST_FIRST(name, a, b, c) *#a,
      TRUNNION_ST_INSTRUCTIONS(TRUNNION_ST_FIRST)
#undef TRUNNION_ST_FIRST
  });
  return first[static_cast<std::size_t>(op)] == 'w' && op != Op::bit_put && op != Op::field_put;
}

bool Emitter::redirect(std::int32_t from, std::int32_t to) {
  if (code_.empty() || !is_temporary(from)) return false;
  auto& last = code_.back();
  if (last.a != from || !only_writes_first(last.op)) return false;
  // A jump to behind it would miss the value.
  if (last_target_ == code_.size()) return false;
  last.a = to;
  return true;
}

}  // namespace trunnion::st
