// SPDX-License-Identifier: Apache-2.0
// Which state directory a command works on.
#pragma once

#include <string>

#include "commands.hpp"

namespace trunnion::cli {

struct StatePlace {
  std::string machine;  ///< as given: a name or a directory; of state_place() its name
  std::string state;    ///< the directory
  bool given() const { return !machine.empty() || !state.empty(); }
};

/// --machine and --state.
void add_place_options(CLI::App& command, StatePlace& place);

/// The directory that is given, the default one of the machine, or that of the cluster that runs.
StatePlace state_place(const Common& common, StatePlace place);

}  // namespace trunnion::cli
