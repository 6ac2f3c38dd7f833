// SPDX-License-Identifier: Apache-2.0
// devices.yaml: simulated devices between the outputs and the inputs of the PLC.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plc/semantics/unit.hpp"

namespace trunnion::st {

/// A switch that an axis actuates: `input`, a bit of area X, is 1 from `low` to `high` (mm or deg, both
/// ends).
struct PositionSwitch {
  std::string axis;  ///< name, as in the parameters
  double low = 0, high = 0;
  RegisterAddress input;
};

struct SimulatedDevices {
  std::string program;  ///< PROGRAM simulation in Structured Text, with the blocks of simulated_devices.st
  std::vector<PositionSwitch> switches;
};

/// Devices by name, each with one type and its keys (docs/plc.md, simulated devices). `registers` are the
/// names that may stand in place of addresses. Throws std::runtime_error, beginning with file:line:column,
/// for unknown types and keys, missing ones, numbers beyond their limits, what is no address, and inputs that
/// two devices write.
SimulatedDevices read_devices(const std::string& yaml, const std::string& file,
                              const RegisterNames& registers);

extern const char* const simulated_devices_text;  ///< devices/simulated_devices.st

}  // namespace trunnion::st
