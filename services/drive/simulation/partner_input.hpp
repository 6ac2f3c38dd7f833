// SPDX-License-Identifier: Apache-2.0
// What the other side of a gantry does to a servo axis in one period of its speed loop.
#pragma once

namespace trunnion::drive {

struct PartnerInput {
  double force = 0;             ///< of the beam on the load, in the unit of the torque
  double speed_correction = 0;  ///< added to the setpoint of the speed loop
  bool torque_follow = false;   ///< the loops are off, the torque is `torque`
  double torque = 0;
};

/// How an axis moves whose drive has a fault.
enum class RunOut { none, coasts, brakes };

}  // namespace trunnion::drive
