// SPDX-License-Identifier: Apache-2.0
// What servo tests ask of the drive.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "contracts/types.hpp"
#include "machine/parameters.hpp"
#include "servo_analysis/test_programs.hpp"

namespace trunnion::machine_tests {

/// Samples in motion alone.
idl::servo::TestRequest samples_of(const std::vector<std::uint16_t>& axes, std::uint16_t decimation);

/// `request` without feed-forward of its axes and of their gantry slaves, which become axes of the request
/// behind them. With feed-forward the following error is small at any position gain.
idl::servo::TestRequest without_feedforward(const machine::Parameters& parameters,
                                            idl::servo::TestRequest request);

/// Highest feed, `feed` at most, at which without feed-forward none of the axes lags by more than half of its
/// limit (10a037). `speeds`: of the axes at `feed`, mm/s or deg/s.
double feed_without_feedforward(const machine::Parameters& parameters, const std::vector<std::uint16_t>& axes,
                                const std::vector<double>& speeds, double feed);

/// `wanted`, else `standard`. Throws std::runtime_error when the axis does not reach it.
double feed_of(const servo_analysis::TestedAxis& axis, std::optional<double> wanted, double standard);

}  // namespace trunnion::machine_tests
