// SPDX-License-Identifier: Apache-2.0
// Where two batches that should be the same are not, in words.
#pragma once

#include <optional>
#include <string>

#include "contracts/types.hpp"

namespace trunnion::stream {

struct BatchDifference {
  std::uint64_t cycle = 0;
  std::string values;  ///< what differs, in the first batch and in the second
  std::string text;    ///< all of it: names the stage, both replicas, the cycle and both values
};

/// Two batches of the same epoch and first cycle are the same in what a stage computes: shape, revision,
/// setpoints and states, value for value. Does not allocate.
bool same_values(const idl::stream::AxisBatch& a, const idl::stream::AxisBatch& b);
bool same_values(const idl::stream::PathBatch& a, const idl::stream::PathBatch& b);

/// The first difference of two batches that are not the same_values.
std::optional<BatchDifference> difference(const idl::stream::AxisBatch& a, const idl::stream::AxisBatch& b);
std::optional<BatchDifference> difference(const idl::stream::PathBatch& a, const idl::stream::PathBatch& b);

}  // namespace trunnion::stream
