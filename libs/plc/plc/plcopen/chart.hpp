// SPDX-License-Identifier: Apache-2.0
// The elements of a body in sequential function chart: steps, transitions, action blocks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plc/plcopen/document.hpp"

namespace trunnion::st::plcopen {

struct ChartStep {
  Node node;
  std::string name;
  bool initial = false;
};

struct ChartTransition {
  Node node;
  std::size_t number = 0;           ///< from 1, in the order in which they are decided
  std::vector<std::size_t> before;  ///< steps that must be active
  std::vector<std::size_t> after;   ///< steps that become active
};

/// One line of an action block: a step, how it controls the action, and which action.
struct ChartAssociation {
  Node node;
  std::size_t step = 0;
  std::string qualifier;           ///< N, R, S, L, D, P, SD, DS, SL, P0, P1
  std::optional<Tokens> duration;  ///< of L, D, SD, DS, SL
  std::string action;              ///< name; empty: `body`
  Node body;                       ///< written in the action block itself
};

struct Chart {
  std::vector<ChartStep> steps;              ///< as in the document
  std::vector<ChartTransition> transitions;  ///< in the order of their number
  std::vector<ChartAssociation> associations;
};

/// Reads the body (SFC). Of transitions that share a step before them the first one that is true is taken:
/// that of the lowest priority number, then the leftmost, then the first of the document. What contradicts
/// IEC 61131-3:2013, 6.7 is reported: no initial step or two in one network, two steps or two transitions in
/// sequence, an association without its step.
Chart read_chart(Document& document, Node body);

}  // namespace trunnion::st::plcopen
