// SPDX-License-Identifier: Apache-2.0
// The section `chains` of machine.yaml: kinematic chains as lists of named elements.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "geometry/chain_elements.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

/// Chains by channel. Every entry is a map with
///   channel: 0 .. 9 (default 0), tool_direction: [x, y, z] (default [0, 0, 1]), closed: true (default) or
///   false elements: in the order from the workpiece to the tool
///     {name: TABLE_OFFSET, offset: [x, y, z]}      mm, towards the tool with every axis at zero
///     {name: CORR_C, correction: [x, y, z]}        the same, written by a measurement
///     {name: C_AXIS, rotary: C, direction: [x, y, z]}   sense in which +C turns what the axis carries
///     {name: X_AXIS, linear: X}                    with `direction` where +X moves the tool, if not along +X
/// Names are there once. Throws std::runtime_error with file:line:column.
std::map<std::uint16_t, geometry::ChainDescription> read_chains(const YAML::Node& section,
                                                                const std::string& file);

/// The parameters of all of them. Throws std::runtime_error with file:line:column.
std::map<std::uint32_t, ParameterValue> read_chain_parameters(const YAML::Node& section,
                                                              const std::string& file);

}  // namespace trunnion::machine
