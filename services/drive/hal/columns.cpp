// SPDX-License-Identifier: Apache-2.0
#include "columns.hpp"

#include <algorithm>
#include <stdexcept>

namespace trunnion::drive {
namespace {

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

[[noreturn]] void refuse(const std::string& component, const std::string& found,
                         const std::string& expected) {
  throw std::runtime_error("The .hal file loads " + component + " with cfg=" + found +
                           "; this machine needs " + expected + " (docs/hal.md has the columns)");
}

}  // namespace

SetpointColumns SetpointColumns::from(const std::string& types, std::size_t axes, std::size_t spindles) {
  SetpointColumns columns;
  columns.columns = types.size();
  for (columns.per_axis = 3; columns.per_axis > 0; --columns.per_axis) {
    columns.first_spindle = first_axis + axes * columns.per_axis;
    if (types == "ubbb" + repeated(std::string(columns.per_axis, 'f'), axes) + repeated("fbf", spindles))
      return columns;
  }
  refuse("streamer 0", types,
         "ubbb, then f, ff or fff for each of " + std::to_string(axes) + " axes, then fbf for each of " +
             std::to_string(spindles) + " spindles");
}

SampleColumns SampleColumns::from(const std::string& encoder_types, const std::string& switch_types,
                                  std::size_t axes, std::size_t spindles) {
  SampleColumns columns;
  columns.first_skip_input = 3 * axes;
  columns.skip_inputs = switch_types.size() - std::min(switch_types.size(), columns.first_skip_input);
  if (columns.skip_inputs > most_skip_inputs ||
      switch_types != std::string(columns.first_skip_input + columns.skip_inputs, 'b'))
    refuse("sampler 1", switch_types,
           "bbb for each of " + std::to_string(axes) + " axes, then b for each skip input, at most " +
               std::to_string(most_skip_inputs));
  for (columns.per_axis = 3; columns.per_axis > 0; --columns.per_axis) {
    columns.first_spindle = first_axis + axes * columns.per_axis;
    if (encoder_types == "u" + repeated(std::string(columns.per_axis, 'f'), axes) + repeated("ff", spindles))
      return columns;
  }
  refuse("sampler 0", encoder_types,
         "u, then f, ff or fff for each of " + std::to_string(axes) + " axes, then ff for each of " +
             std::to_string(spindles) + " spindles");
}

}  // namespace trunnion::drive
