// SPDX-License-Identifier: Apache-2.0
// From a diagram to words of Structured Text, each at the place of its element.
#pragma once

#include <set>

#include "plc/plcopen/network.hpp"

namespace trunnion::st::plcopen {

struct DiagramBody {
  Tokens declarations;  ///< VAR ... END_VAR of the edges it detects
  Tokens statements;
};

/// Networks one after the other. Within one, an element is executed behind what it takes its inputs from;
/// those that do not depend on each other in the order of executionOrderId, then from top to bottom, then
/// from left to right. The power behind an element that several others take is computed once. `names` are
/// those of the unit's variables, in capitals.
DiagramBody diagram_body(Document& document, const Diagram& diagram, const std::set<std::string>& names);

}  // namespace trunnion::st::plcopen
