// SPDX-License-Identifier: Apache-2.0
// A channel with the axes X Y Z (logical 0 1 2) and A C (3 5), and its setpoints.
#pragma once

#include "compensation_core.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

struct Set {
  machine::Parameters& parameters;
  void operator()(std::uint32_t number, double value) { parameters.values[number] = {value, ""}; }
  void table(std::uint32_t first, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) (*this)(first + static_cast<std::uint32_t>(i), values[i]);
  }
};

inline machine::Parameters axes(const std::vector<int>& letters) {
  machine::Parameters p;
  for (const int letter : letters) p.values[40001 + static_cast<std::uint32_t>(letter)] = {1.0 * letter, ""};
  return p;
}

/// Rows of the channel's axes in, rows out.
struct Channel {
  explicit Channel(const machine::Parameters& p) { core.configure(p, 0); }

  const std::vector<double>& run(const std::vector<double>& setpoints, std::size_t width) {
    in.axes.assign(width, 0);
    in.count = static_cast<std::uint32_t>(setpoints.size() / width);
    in.setpoints = setpoints;
    core.process(in, {}, out);
    return out.setpoints;
  }

  CompensationCore core;
  idl::stream::AxisBatch in, out;
};

}  // namespace trunnion::compensation
