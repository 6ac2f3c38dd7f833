// SPDX-License-Identifier: Apache-2.0
// What is known of the programs as a whole: who uses which variable, which tasks write the same one.
#pragma once

#include <string>
#include <vector>

#include "plc/semantics/unit.hpp"

namespace trunnion::st {

/// One place at which a variable or register is used.
struct Use {
  Position at;
  bool reads = false, writes = false;
  bool calls = false;   ///< of a function block
  std::string member;   ///< of a structure or function block, in capitals, without indices: A.B
  std::string element;  ///< of a diagram: POU, network and element
};

/// A variable or a register with the places that use it, in the order of the sources.
struct CrossReference {
  std::string name;  ///< Unit.variable, variable of VAR_GLOBAL, %X0.3
  std::string type;
  std::string location;            ///< of a variable with AT: %X0.3
  std::vector<std::string> names;  ///< of a register: those that the sources use for it
  std::vector<Use> uses;
};

/// Variables by their declaration, then registers by their address; a variable with AT is among both.
/// Variables and uses of the library are left out.
std::vector<CrossReference> cross_reference(const Unit& unit);

/// Warns of each variable and register that two tasks write. `files`: names of the sources.
void warn_of_two_tasks(const Unit& unit, const std::vector<std::string>& files, Diagnostics& diagnostics);

}  // namespace trunnion::st
