// SPDX-License-Identifier: Apache-2.0
// The parameters of a channel's kinematic chain as geometry::Chain takes them.
#pragma once

#include "geometry/chain.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

/// Parameters 04c400..04c437, 04c905..04c907, 04c920..04c943 and 04c960..04c988, not checked by
/// geometry::Chain. Throws KinematicsError when the rotary axes are not A B C U V W or are more than three of
/// a side.
geometry::ChainParameters chain_parameters(const Parameters& parameters, std::uint16_t channel);

}  // namespace trunnion::machine
