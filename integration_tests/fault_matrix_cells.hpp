// SPDX-License-Identifier: Apache-2.0
// What must happen when a service is lost: the expectations of the fault matrix as data.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace trunnion::integration {

enum class Fault {
  killed,      ///< SIGKILL
  terminated,  ///< SIGTERM: an orderly end nobody asked the launcher for
  suspended,   ///< SIGSTOP, two seconds later SIGCONT
  restarts     ///< SIGKILL, and again each time it has come up, until the launcher gives it up
};
inline constexpr Fault every_fault[] = {Fault::killed, Fault::terminated, Fault::suspended, Fault::restarts};
const char* name_of(Fault fault);

enum class Machine {
  goes_on,        ///< not a cycle, not a bit changes
  stops_on_path,  ///< and goes on from there with cycle start
  stops_axes_off  ///< on the path, but the drives are switched off: the program is begun again
};

enum class Way {
  nothing,      ///< there is nothing for the operator to do but to reset what is shown
  cycle_start,  ///< reset the alarms, cycle start
  begin_again   ///< reset the alarms and the channel, start the program from its beginning
};

struct Expectation {
  Machine machine;
  std::set<unsigned> must;  ///< alarms the operator sees
  std::set<unsigned> may;   ///< alarms that depend on how fast the service is back
  Way way;
  bool may_begin_again =
      false;      ///< as for stops_axes_off when the PLC is away for longer than the drive waits
  bool replaced;  ///< by a new process
};

/// One cell of the matrix.
struct Cell {
  std::string service;
  Fault fault;
  std::string layout;  ///< fastdds, cyclonedds or mixed
  bool in_motion;
  std::string name() const;
};

/// Services of the machine, and the recorder beside it.
const std::vector<std::string>& matrix_services();
const std::vector<std::string>& matrix_layouts();
std::vector<Cell> all_cells();
Expectation expectation(const std::string& service, Fault fault, bool in_motion);

/// The tables of docs/fault-matrix.md.
std::string matrix_document();

}  // namespace trunnion::integration
