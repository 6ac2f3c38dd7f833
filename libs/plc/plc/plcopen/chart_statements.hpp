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

/// The condition of a transition.
struct ChartCondition {
  Tokens statements;  ///< of a diagram: to be executed before
  Tokens value;       ///< expression
};

/// What a chart refers to by name, in capitals.
struct ChartParts {
  std::map<std::string, Tokens> actions;  ///< statements
  std::map<std::string, ChartCondition> transitions;
};

/// One execution of the result is one evolution of the chart: the actions of the active steps are executed,
/// then the transitions are decided with what they have left, and all that are taken are taken at once. Each
/// step is a variable of type SFC_STEP, with X and T; each action has a variable <action>_active. `names` are
/// the variables of the POU, in capitals; those of the chart are added. `statements` makes statements of a
/// body.
ChartBody chart_body(Document& document, const Chart& chart, const ChartParts& parts,
                     std::set<std::string>& names, const std::function<Tokens(Node)>& statements);

/// The condition in a body: in Structured Text an expression, also with := before and ; behind; in other
/// languages what is written to a variable with the name of the transition. `declarations` gets that
/// variable. Nothing when it is none, which is reported.
std::optional<ChartCondition> chart_condition(Document& document, Node body, const std::string& name,
                                              std::set<std::string>& names,
                                              const std::function<Tokens(Node)>& statements,
                                              Tokens& declarations);

}  // namespace trunnion::st::plcopen
