// SPDX-License-Identifier: Apache-2.0
// Which column of HAL's streamer and samplers means what. docs/hal.md has the same as a table.
#pragma once

#include <cstddef>
#include <string>

namespace trunnion::drive {

/// The most columns that one FIFO of HAL can have.
inline constexpr std::size_t most_hal_columns = 21;
inline constexpr std::size_t most_skip_inputs = 4;

/// The setpoints: number, enable, fault reset, heartbeat; of each axis position and, as the .hal file likes,
/// velocity and acceleration; of each spindle speed, coupled, angle.
struct SetpointColumns {
  /// `types`: the configuration of streamer 0, a letter (f b s u) for each column. Throws std::runtime_error
  /// that names what is expected.
  static SetpointColumns from(const std::string& types, std::size_t axes, std::size_t spindles);

  static constexpr std::size_t number = 0, enable = 1, fault_reset = 2, heartbeat = 3, first_axis = 4;
  std::size_t per_axis = 3;  ///< 1 position, 2 and velocity, 3 and acceleration
  std::size_t first_spindle = 0;
  std::size_t columns = 0;
};

/// The encoders, sampler 0: number of the row in force; of each axis position and, as the .hal file likes,
/// velocity and torque; of each spindle angle and speed. The switches, sampler 1: of each axis enabled,
/// fault, home switch; then up to four skip inputs.
struct SampleColumns {
  static SampleColumns from(const std::string& encoder_types, const std::string& switch_types,
                            std::size_t axes, std::size_t spindles);

  static constexpr std::size_t number = 0, first_axis = 1;
  std::size_t per_axis = 2;  ///< 1 position, 2 and velocity, 3 and torque
  std::size_t first_spindle = 0;
  std::size_t first_skip_input = 0, skip_inputs = 0;  ///< of sampler 1
};

}  // namespace trunnion::drive
