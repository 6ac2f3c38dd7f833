// SPDX-License-Identifier: Apache-2.0
// Where two frames that should be the same are not, in words.
#pragma once

#include <optional>
#include <string>

#include "contracts/types.hpp"

namespace trunnion::stream {

struct FrameDifference {
  std::uint64_t cycle = 0;
  std::string values;  ///< what differs, in the first frame and in the second
  std::string text;    ///< all of it: names the stage, both replicas, the cycle and both values
};

/// Two frames of the same epoch and first cycle are the same in what a stage computes: shape, revision,
/// setpoints and states, value for value. Does not allocate.
bool same_values(const idl::stream::AxisFrame& a, const idl::stream::AxisFrame& b);
bool same_values(const idl::stream::PathFrame& a, const idl::stream::PathFrame& b);

/// The first difference of two frames that are not the same_values.
std::optional<FrameDifference> difference(const idl::stream::AxisFrame& a, const idl::stream::AxisFrame& b);
std::optional<FrameDifference> difference(const idl::stream::PathFrame& a, const idl::stream::PathFrame& b);

}  // namespace trunnion::stream
