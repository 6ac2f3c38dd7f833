// SPDX-License-Identifier: Apache-2.0
// Whether a batch is whole: its counts agree with the lengths of its sequences, and its numbers are such as a
// machine has. What computes with a batch relies on it.
#pragma once

#include <string>

#include "contracts/types.hpp"

namespace trunnion::stream {

/// Cycles and ticks are below it: 285,000 years of 1 ms.
inline constexpr std::uint64_t last_cycle = 1ull << 53;
/// mm and deg: no setpoint and no position is farther from zero.
inline constexpr double farthest = 1e12;
/// Rows that one batch of feedback has at most.
inline constexpr std::uint32_t most_feedback_rows = 2048;

/// The first field that is not as it must be, with its value; empty when the batch is whole.
std::string fault_of(const idl::stream::PathBatch& batch);
std::string fault_of(const idl::stream::AxisBatch& batch);
std::string fault_of(const idl::stream::Feedback& batch);

}  // namespace trunnion::stream
