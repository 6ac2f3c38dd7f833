// SPDX-License-Identifier: Apache-2.0
// Which state directory a command works on.
#pragma once

#include <string>

#include "commands.hpp"

namespace trunnion::cli {

struct StatePlace {
  std::string machine;    ///< as given: a name or a directory; of state_place() its name
  std::string state;      ///< the directory
  std::string directory;  ///< of state_place(): that of the machine; empty when the machine is not known
  bool given() const { return !machine.empty() || !state.empty(); }
};

/// --machine and --state.
void add_place_options(CLI::App& command, StatePlace& place);

/// The directory that is given, the default one of the machine, or that of the cluster that runs. A directory
/// does not say whose state it is: without --machine it is that of the machine with its name, if there is
/// one. Throws std::runtime_error, too when --domain names a cluster besides.
StatePlace state_place(const Common& common, const StatePlace& given);

/// The machine's directory. Throws std::runtime_error when the machine is not known.
const std::string& known_machine(const StatePlace& place);

}  // namespace trunnion::cli
