// SPDX-License-Identifier: Apache-2.0
// How long the drive waits. Documents name these figures; a test compares them.
#pragma once

namespace trunnion::drive {

inline constexpr double missing_setpoint_timeout =
    1.0;                                    ///< s of wall time, in virtual time, until the drive brakes
inline constexpr double plc_timeout = 1.5;  ///< s without a sign of the PLC until the drive stops
inline constexpr double drives_on_timeout =
    2;  ///< s from their enable until drives that are off are an alarm
inline constexpr double spindle_rest_timeout =
    2;  ///< s from the end of the ramp until synchronized spindles that are not at rest are left alone
inline constexpr double orientation_timeout =
    25;  ///< s, besides two turns at 10a947, until a spindle that does not come to its angle is an alarm
inline constexpr double servo_test_timeout = 5;  ///< s without its client until the drive ends a servo test

}  // namespace trunnion::drive
