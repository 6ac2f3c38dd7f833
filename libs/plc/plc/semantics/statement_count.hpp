// SPDX-License-Identifier: Apache-2.0
// How many statements a routine executes at most.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "plc/semantics/emitter.hpp"

namespace trunnion::st {

struct StatementCount {
  std::optional<std::int64_t>
      most;                ///< as the budget of Machine::run counts them; nothing: no limit is known
  std::uint32_t loop = 0;  ///< its Op::loop, without a limit
};

/// Of every routine of translated sources, with their loops. A backward jump that is none of them has no
/// known limit. The figure is reached when the longest branches can all be taken.
std::vector<StatementCount> statement_counts(const ByteCode& code,
                                             const std::map<std::uint32_t, Loop>& loops);

}  // namespace trunnion::st
