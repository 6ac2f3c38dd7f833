// SPDX-License-Identifier: Apache-2.0
#include "identification/measured_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "machine/parameter_constants.hpp"

namespace trunnion::identification {
namespace {

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

std::optional<truth::PositionAccuracy> accuracy_of(truth::PoseReport report, const Measurement& m,
                                                   const truth::InstrumentTruth& instrument) {
  if (m.kind != InstrumentKind::laser || m.laser.component != m.laser.axis) return std::nullopt;
  report.tool_length = m.tool_length;
  return truth::measure_laser(report, m.laser, instrument).accuracy;
}

std::map<std::uint32_t, machine::ParameterValue> compensation_values(const FitResult& fit,
                                                                     const geometry::Chain& chain,
                                                                     const machine::Parameters& model,
                                                                     const MeasurementPlan& plan,
                                                                     const GeometrySettings& settings) {
  auto values = volumetric::parameters_of(model, settings.channel, fit.location, fit.tables, settings.first);
  bool turns = false;
  for (std::size_t i = 0; i < geometry::angle_count; ++i) turns = turns || chain.turns(i);
  values[parameter::volumetric_type.number(settings.channel)] = {turns ? 2.0 : 1.0, ""};
  if (!plan.structure.empty())
    values[parameter::volumetric_structure.number(settings.channel)] = {0, plan.structure};
  return values;
}

}  // namespace

MeasuredGeometry measure_geometry(truth::PoseReport report, const truth::Truth& truth,
                                  const machine::MachineOutline& machine, const machine::Parameters& model,
                                  const MeasurementPlan& plan, const GeometrySettings& settings) {
  report.compensation = nullptr;
  MeasuredGeometry result;
  std::vector<std::vector<double>> measured;
  for (const auto& m : plan.measurements) {
    const auto instrument = instrument_of(truth, m);
    measured.push_back(readings(report, m, instrument));
    result.rows.push_back({m.name, m.angular(), root_mean_square(measured.back()), 0,
                           accuracy_of(report, m, instrument), std::nullopt});
  }
  result.fit = GeometryFit(machine, report.model(), plan).solve(measured);
  result.values = compensation_values(result.fit, report.model(), model, plan, settings);
  auto compensated = model;
  for (const auto& [number, value] : result.values) compensated.values[number] = value;
  if (!plan.measurements.empty()) report.tool_length = plan.measurements.front().tool_length;
  result.before = volumetric_errors(report, settings.poses, settings.seed, true);
  report.compensation = std::make_shared<volumetric::VolumetricCompensation>(
      *volumetric::compensation_of(compensated, settings.channel));
  result.after = volumetric_errors(report, settings.poses, settings.seed, true);
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const auto& m = plan.measurements[i];
    auto instrument = instrument_of(truth, m);
    ++instrument.seed;  // measured again
    result.rows[i].after = root_mean_square(readings(report, m, instrument));
    result.rows[i].accuracy_after = accuracy_of(report, m, instrument);
  }
  return result;
}

}  // namespace trunnion::identification
