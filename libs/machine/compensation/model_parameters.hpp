// SPDX-License-Identifier: Apache-2.0
// The parameters of the volumetric compensation: 04c951 .. 04c957 and 30a900 .. 30a914.
#pragma once

#include <map>
#include <optional>

#include "compensation/volumetric_compensation.hpp"
#include "machine/parameters.hpp"

namespace trunnion::volumetric {

/// The errors that the parameters of a channel describe.
/// Throws machine::KinematicsError with the number of the parameter and its limit.
GeometryErrors errors_of(const machine::Parameters& parameters, std::uint16_t channel);

/// Nothing when parameter 04c951 is 0. Throws machine::KinematicsError.
std::optional<VolumetricCompensation> compensation_of(const machine::Parameters& parameters,
                                                      std::uint16_t channel);

/// The tables of one axis in parameters: the same positions for its six errors.
struct AxisTables {
  double start = 0, interval = 1;  ///< mm or deg
  std::size_t points = 0;
  bool modulo = false, bidirectional = false;
  /// EX EY EZ, mm, EA EB EC, rad: values after a positive approach, or of both; then after a negative one.
  std::array<std::vector<double>, component_count> positive, negative;
};

/// The error functions of these tables: cubic, so that the correction has no steps of velocity.
std::vector<ComponentError> errors_of(const AxisTables& tables, std::size_t axis);

/// A model as parameters: tables and location errors (GeometryErrors without its component errors), the
/// tables from number `first` on. The keys are parameter numbers. Throws machine::KinematicsError when
/// there are more values than parameters.
std::map<std::uint32_t, machine::ParameterValue> parameters_of(
    const machine::Parameters& machine, std::uint16_t channel, const GeometryErrors& location,
    const std::map<std::size_t, AxisTables>& tables, std::uint32_t first);

}  // namespace trunnion::volumetric
