// SPDX-License-Identifier: Apache-2.0
// Text tables as parameters 30axxx and 70xxxx, and back.
#pragma once

#include <map>

#include "compensation/text_tables.hpp"
#include "machine/parameters.hpp"

namespace trunnion::error_tables {

/// The parameters that make these tables the only ones of a channel: pitch for X_X, the first or second
/// straightness, squareness or angle compensation otherwise; what they do not use is switched off. The values
/// begin at parameter `first`. Throws std::runtime_error when the channel has no such axis, an axis has more
/// than two of a kind, or there are too many values.
std::map<std::uint32_t, machine::ParameterValue> parameters_of(const TextTables& tables,
                                                               const machine::Parameters& machine,
                                                               std::uint16_t channel, std::uint32_t first);

/// The tables of a channel that are on; magnifications are in the values. Throws std::runtime_error when a
/// table refers to an axis of another channel.
TextTables tables_of(const machine::Parameters& parameters, std::uint16_t channel);

}  // namespace trunnion::error_tables
