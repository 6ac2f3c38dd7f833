// SPDX-License-Identifier: Apache-2.0
// What the constants of services (machine/service_constants.hpp) are made of.
#pragma once

#include <cstdint>

namespace trunnion::machine {

/// One row of services.yaml.
struct ServiceDefinition {
  const char* name;
  bool required;       ///< every machine.yaml has it
  bool per_channel;    ///< one process for each channel
  bool cyclic;         ///< shares the interpolation cycle
  bool not_verified;   ///< depends on its own clock: a recording is not repeated with it
  std::uint8_t stage;  ///< number in the stream, from 1; 0 when it is no stage
  const char* input;   ///< handle of the topic a stage reads; null for the first, and for what is no stage
  const char* output;  ///< handle of the topic a stage writes, else null

  /// A stage that computes from another's output: it may have two replicas, and works beside the one it is to
  /// replace.
  constexpr bool transforms() const { return input != nullptr; }
};

}  // namespace trunnion::machine
