// SPDX-License-Identifier: Apache-2.0
// Names of registers: the interface of registers.yaml and what a program declares.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "plc/machine/register_area.hpp"

namespace trunnion::il {

using Symbols = std::map<std::string, st::RegisterAddress, std::less<>>;

/// X0.3, %G5, B7.31; nothing when it is no address or outside the image.
std::optional<st::RegisterAddress> parse_address(std::string_view text);

/// The interface that is compiled in from registers.yaml.
const Symbols& interface_symbols();
/// Address of an interface register; throws std::out_of_range for a name that registers.yaml does not have.
st::RegisterAddress interface_address(const std::string& name);
st::RegisterAddress interface_address(const std::string& name, std::size_t index);

}  // namespace trunnion::il
