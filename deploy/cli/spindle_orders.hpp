// SPDX-License-Identifier: Apache-2.0
// The orders of `channel couple` and `channel uncouple`, as programs write them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "machine/axes.hpp"

namespace trunnion::cli {

inline constexpr const char* couple_word = "couple";
inline constexpr const char* uncouple_word = "uncouple";

/// Spindles by their numbers from 0, as in the feedback.
struct CouplingOrder {
  std::size_t slave = 0;
  std::optional<std::size_t> master;  ///< none: the slave no longer follows
  std::optional<double> angle;        ///< deg, added to that of the master; none: the one ordered before
};

/// Of what is behind one of the two words. A spindle is written as its name or its number from 1. Throws
/// std::runtime_error with what is wrong.
CouplingOrder coupling_order(const std::string& word, const std::vector<std::string>& arguments,
                             const std::vector<machine::AxisInfo>& machine_spindles);

/// The lines of manual data input of the order, with `num` those of the NUM dialect. Throws
/// std::runtime_error when the dialect does not know a spindle.
std::vector<std::string> order_lines(const CouplingOrder& order, bool num);

/// The drive says so: the slave is synchronized with its master, or follows none.
bool is_carried_out(const CouplingOrder& order, const idl::stream::Feedback& feedback);

}  // namespace trunnion::cli
