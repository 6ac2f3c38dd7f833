// SPDX-License-Identifier: Apache-2.0
// Tool table and work offsets: limits and their YAML.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "contracts/types.hpp"

namespace trunnion::tool_tables {

using Tools = std::map<std::uint32_t, idl::parameters::Tool>;
/// By channel and index (0 = G54 .. 5 = G59, 6 = G54.1 P1 .. 53 = G54.1 P48, 54 the external one).
using Offsets = std::map<std::pair<std::uint16_t, std::uint8_t>, idl::parameters::WorkOffset>;

/// Empty, or one line that names the tool, the field and its limits.
std::string check_tool(const idl::parameters::Tool& tool);
/// Rows of a channel: G54 .. G59 are 0 .. 5, G54.1 P1 .. P48 are 6 .. 53, what is added to all of them 54,
/// and the setting errors 55 .. 61.
inline constexpr std::uint8_t work_offset_count = 62;
/// "G54" .. "G59", "G54.1P1" .. "G54.1P48", "EXT", "G54.4P1" .. "G54.4P7".
std::string work_offset_code(std::uint8_t index);

/// Empty, or one line that names channel, offset, axis and limits.
std::string check_offset(const idl::parameters::WorkOffset& offset);

/// `tools:` with a list of {number, length, radius, name, length_wear, radius_wear, type, life_used,
/// life_limit, life_unit: minutes or pieces}, or that list alone. Fields may be missing. Throws
/// std::runtime_error with file:line:column.
Tools read_tools(const std::string& text, const std::string& file, std::uint64_t& revision);
std::string write_tools(const Tools& tools, std::uint64_t revision);

/// `offsets:` with a list of {channel, offset: G54, X: .., Y: ..} (or G54.1P7), or that list alone.
/// Throws std::runtime_error with file:line:column.
Offsets read_offsets(const std::string& text, const std::string& file, std::uint64_t& revision);
std::string write_offsets(const Offsets& offsets, std::uint64_t revision);

}  // namespace trunnion::tool_tables
