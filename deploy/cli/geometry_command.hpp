// SPDX-License-Identifier: Apache-2.0
// measure geometry: the errors of a machine from a plan of measurements.
#pragma once

#include "commands.hpp"

namespace trunnion::cli {

void add_geometry_command(CLI::App& measure, Common& common);

}  // namespace trunnion::cli
