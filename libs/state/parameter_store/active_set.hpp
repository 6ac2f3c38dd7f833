// SPDX-License-Identifier: Apache-2.0
// The active parameters as kept on disk, with the start of the cluster they belong to.
#pragma once

#include <map>

#include "machine/parameters.hpp"

namespace trunnion::parameters {

using Values = std::map<std::uint32_t, machine::ParameterValue>;

struct ActiveSet {
  std::string boot;            ///< content of cluster.boot when it became active; empty = started by hand
  std::uint64_t revision = 0;  ///< counts activations over the machine's life
  std::uint64_t previous = 0;
  std::map<std::uint16_t, std::uint32_t> resets;  ///< newest reset count seen of each channel
  Values values;                                  ///< those that differ from the catalogue's defaults
};

/// Throws std::runtime_error with file:line:column. Values that the catalogue no longer takes are left out.
ActiveSet read_active(const std::string& text, const std::string& file);
std::string write_active(const ActiveSet& active);

}  // namespace trunnion::parameters
