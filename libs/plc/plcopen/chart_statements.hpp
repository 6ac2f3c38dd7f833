// SPDX-License-Identifier: Apache-2.0
// Sequential function chart (IEC 61131-3:2013, 6.7) into words of Structured Text.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "plc/plcopen/chart.hpp"

namespace trunnion::st::plcopen {

struct ChartBody {
  Tokens declarations;  ///< VAR ... END_VAR
  Tokens statements;
};

/// What a chart refers to by name, in capitals.
struct ChartParts {
  std::map<std::string, Tokens> actions;      ///< statements
  std::map<std::string, Tokens> transitions;  ///< conditions
};

/// One execution of the result is one evolution of the chart: the actions of the active steps are executed,
/// then the transitions are decided with what they have left, and all that are taken are taken at once. Each
/// step is a variable of type SFC_STEP, with X and T; each action has a variable <action>_active. `names` are
/// the variables of the POU, in capitals; those of the chart are added. `statements` makes statements of a
/// body.
ChartBody chart_body(Document& document, const Chart& chart, const ChartParts& parts,
                     std::set<std::string>& names, const std::function<Tokens(Node)>& statements);

/// The condition of a transition as an expression: of a body in Structured Text, also with := before and ;
/// behind. Nothing when it is none, which is reported.
std::optional<Tokens> chart_condition(Document& document, Node body);

}  // namespace trunnion::st::plcopen
