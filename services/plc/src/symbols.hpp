// SPDX-License-Identifier: Apache-2.0
// Names of registers: the interface of registers.yaml and what a program declares.
#pragma once

#include <map>
#include <string>

#include "address.hpp"

namespace trunnion::plc {

using Symbols = std::map<std::string, Address, std::less<>>;

/// The interface that is compiled in from registers.yaml.
const Symbols& interface_symbols();
/// Address of an interface register; throws std::out_of_range for a name that registers.yaml does not have.
Address interface_address(const std::string& name);
Address interface_address(const std::string& name, std::size_t index);

}  // namespace trunnion::plc
