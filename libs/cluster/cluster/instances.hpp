// SPDX-License-Identifier: Apache-2.0
// Instances: the numbers by which the processes of a cluster are known.
#pragma once

#include <cstdint>

namespace trunnion::cluster {

/// Services count from 1 in the order of machine.yaml, launchers from here on in the order of its hosts.
inline constexpr std::uint32_t launcher_instance = 1000;
/// What is swapped in has the number of the first process in its place and this much more for every swap its
/// launcher has begun. So every host's launcher sees whose place it takes.
inline constexpr std::uint32_t generation_step = 10000;
inline constexpr std::uint32_t place_of(std::uint32_t instance) { return instance % generation_step; }

}  // namespace trunnion::cluster
