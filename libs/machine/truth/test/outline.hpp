// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/test/machines.hpp"
#include "machine/machine_outline.hpp"

namespace trunnion::truth {

/// A machine of `design` with a travel of 800 x 600 x 500 mm.
inline machine::MachineOutline outline(const geometry::ChainParameters& design) {
  machine::MachineOutline machine;
  machine.design = design;
  machine.axes[0] = {true, -400, 400};
  machine.axes[1] = {true, -300, 300};
  machine.axes[2] = {true, -450, 50};
  for (const auto* side :
       {&design.table_2, &design.table_1, &design.table_0, &design.head_2, &design.head_1, &design.head_0})
    if (*side) machine.axes[3 + (*side)->angle] = {true, -110, 110};
  machine.drives = {"X", "Y", "Z"};
  return machine;
}

inline const machine::MachineOutline ac = outline(geometry::ac_table());

}  // namespace trunnion::truth
