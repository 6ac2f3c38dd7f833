// SPDX-License-Identifier: Apache-2.0
#include "identification/geometry_fit.hpp"

#include <cmath>

#include "canonical/axes.hpp"
#include "compensation/structure.hpp"
#include "geometry/angle.hpp"
#include "geometry/decompositions.hpp"

namespace trunnion::identification {
namespace {

using truth::Vec3;

using canonical::axis_letters;
constexpr std::size_t spindle = 9;

// The error functions' own direction of an axis: its position error.
std::size_t along(std::size_t axis) { return axis < 3 ? axis : 3 + axis % 3; }

}  // namespace

GeometryFit::GeometryFit(const machine::MachineOutline& machine, const geometry::Chain& model,
                         const MeasurementPlan& plan, const Magnitudes& magnitudes)
    : machine_(machine), model_(model), plan_(plan) {
  find_unknowns(magnitudes);
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::VectorXd> at_zero;
  rows_ = {0};
  for (std::size_t m = 0; m < plan_.measurements.size(); ++m) {
    at_zero.push_back(predict(m, zero));
    rows_.push_back(rows_.back() + static_cast<std::size_t>(at_zero.back().size()));
  }
  const auto rows = static_cast<Eigen::Index>(rows_.back());
  jacobian_ = Eigen::MatrixXd::Zero(rows, n);
  weights_.resize(rows);
  for (std::size_t m = 0; m < plan_.measurements.size(); ++m)
    weights_.segment(static_cast<Eigen::Index>(rows_[m]), at_zero[m].size())
        .setConstant(1 / plan_.measurements[m].uncertainty);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& unknown = unknowns_[static_cast<std::size_t>(k)];
    Eigen::VectorXd x = zero;
    x[k] = 0.1 * unknown.expected;
    for (std::size_t m = 0; m < plan_.measurements.size(); ++m) {
      if (!concerns(unknown, m)) continue;
      const auto first = static_cast<Eigen::Index>(rows_[m]);
      jacobian_.col(k).segment(first, at_zero[m].size()) = (predict(m, x) - at_zero[m]) / x[k];
    }
  }
  jacobian_ = weights_.asDiagonal() * jacobian_;
  prior_.resize(n);
  for (Eigen::Index k = 0; k < n; ++k)
    prior_[k] = std::pow(unknowns_[static_cast<std::size_t>(k)].expected, -2);
  Eigen::MatrixXd normal = jacobian_.transpose() * jacobian_;
  normal.diagonal() += prior_;
  covariance_ = geometry::symmetric_inverse(normal);
  find_uncertainty();
}

void GeometryFit::find_unknowns(const Magnitudes& expected) {
  for (const auto& m : plan_.measurements) {
    if (m.kind == InstrumentKind::ballbar) continue;
    const bool rotary = m.kind == InstrumentKind::nest;
    const std::size_t axis = rotary ? m.axis : m.laser.axis;
    auto& grid = grid_[axis];
    const std::size_t points = rotary ? m.points : m.laser.targets;
    if (grid.points >= points) continue;
    grid.start = rotary ? m.from : m.laser.from;
    grid.interval = ((rotary ? m.to : m.laser.to) - grid.start) / static_cast<double>(points - 1);
    grid.modulo = rotary && std::abs(m.to - m.from - 360) < 1e-9;
    grid.points = grid.modulo ? points - 1 : points;
    grid.bidirectional = true;
  }
  for (const auto& [axis, grid] : grid_) {
    for (std::size_t c = 0; c < volumetric::component_count; ++c)
      for (std::size_t i = 0; i < grid.points; ++i)
        unknowns_.push_back({Kind::node, axis, c, i, c < 3 ? expected.translation : expected.rotation});
    unknowns_.push_back(
        {Kind::reversal, axis, along(axis), 0, along(axis) < 3 ? expected.translation : expected.rotation});
    for (std::size_t k = 0; k < 3 && axis > 2; ++k) {
      if (k != axis % 3) unknowns_.push_back({Kind::displacement, axis, k, 0, expected.displacement});
      unknowns_.push_back({Kind::inclination, axis, k, 0, expected.inclination});
    }
  }
  unknowns_.push_back({Kind::inclination, 1, 2, 0, expected.inclination});
  unknowns_.push_back({Kind::inclination, 2, 0, 0, expected.inclination});
  unknowns_.push_back({Kind::inclination, 2, 1, 0, expected.inclination});
  for (std::size_t k = 0; k < 2; ++k)
    unknowns_.push_back({Kind::spindle, spindle, k, 0, expected.inclination});
  for (std::size_t m = 0; m < plan_.measurements.size(); ++m) {
    const std::size_t settings = plan_.measurements[m].kind == InstrumentKind::ballbar ? 3
                                 : (plan_.measurements[m].straightness() && !plan_.measurements[m].aligned)
                                     ? 1
                                     : 0;
    for (std::size_t k = 0; k < settings; ++k)
      unknowns_.push_back({Kind::alignment, m, k, 0, expected.alignment});
  }
}

volumetric::GeometryErrors GeometryFit::location(const Eigen::VectorXd& x) const {
  volumetric::GeometryErrors errors;
  if (!plan_.structure.empty())
    errors.structure =
        std::get<std::vector<volumetric::StructureAxis>>(volumetric::parse_structure(plan_.structure));
  for (std::size_t axis = 0; axis < 3; ++axis) errors.axes[axis].reference_point = Vec3::Zero();
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const auto& u = unknowns_[k];
    const double value = x[static_cast<Eigen::Index>(k)];
    const auto row = static_cast<Eigen::Index>(u.component);
    if (u.kind == Kind::displacement) errors.axes[u.axis].displacement[row] = value;
    if (u.kind == Kind::inclination) errors.axes[u.axis].inclination[row] = value;
    if (u.kind == Kind::spindle) errors.spindle.inclination[row] = value;
  }
  return errors;
}

std::map<std::size_t, volumetric::AxisTables> GeometryFit::tables(const Eigen::VectorXd& x) const {
  auto tables = grid_;
  for (auto& [axis, table] : tables)
    for (auto* side : {&table.positive, &table.negative})
      for (auto& values : *side) values.assign(table.points, 0);
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const auto& u = unknowns_[k];
    const double value = x[static_cast<Eigen::Index>(k)];
    if (u.kind == Kind::node) {
      tables[u.axis].positive[u.component][u.node] += value;
      tables[u.axis].negative[u.component][u.node] += value;
    } else if (u.kind == Kind::reversal) {
      // ISO 230-2: value after a positive less value after a negative approach.
      for (double& entry : tables[u.axis].positive[u.component]) entry += value / 2;
      for (double& entry : tables[u.axis].negative[u.component]) entry -= value / 2;
    }
  }
  return tables;
}

volumetric::GeometryErrors GeometryFit::errors(const Eigen::VectorXd& x) const {
  auto errors = location(x);
  for (const auto& [axis, table] : tables(x)) errors.axes[axis].errors = volumetric::errors_of(table, axis);
  return errors;
}

truth::PoseReport GeometryFit::report(const Eigen::VectorXd& x) const {
  return {truth::make_geometry(errors(x), machine_, "plan"), model_, machine_};
}

// What an error cannot change need not be computed: a line of a laser moves one axis and a ballbar has no
// direction. The rotary axes turn the table, to which a reference may be parallel.
bool GeometryFit::concerns(const Unknown& u, std::size_t measurement) const {
  const auto& m = plan_.measurements[measurement];
  if (u.kind == Kind::alignment) return u.axis == measurement;
  switch (m.kind) {
    case InstrumentKind::laser:
      return u.axis == m.laser.axis || (m.aligned && u.axis > 2);
    case InstrumentKind::ballbar:
      return u.axis < 3;
    case InstrumentKind::nest:
      return true;
  }
  return true;
}

// How far setting `which` of the instrument changes a reading: slope of a straightness reference; centre and
// length of a ballbar.
double GeometryFit::alignment(const Measurement& m, std::size_t reading, std::size_t which) const {
  if (m.kind == InstrumentKind::laser)
    return static_cast<double>(reading % m.laser.targets) / static_cast<double>(m.laser.targets - 1);
  // As truth::measure_ballbar goes round: points of each circle from its reading at half a step.
  const double step = 360.0 / static_cast<double>(m.ballbar.points);
  const double sense = reading < m.ballbar.points ? 1 : -1;
  const double angle = sense * (static_cast<double>(reading % m.ballbar.points) + 0.5) * step;
  const auto t = geometry::sine_cosine(angle);
  return which == 0 ? t.cosine : which == 1 ? t.sine : 1;
}

Eigen::VectorXd GeometryFit::predict(std::size_t measurement, const Eigen::VectorXd& x) const {
  auto m = plan_.measurements[measurement];
  m.laser.runs = 2;  // without noise the runs are equal; the figures of ISO 230-2 need two
  const auto values = readings(report(x), m, {});
  Eigen::VectorXd predicted =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const auto& u = unknowns_[k];
    if (u.kind != Kind::alignment || u.axis != measurement) continue;
    for (Eigen::Index i = 0; i < predicted.size(); ++i)
      predicted[i] +=
          x[static_cast<Eigen::Index>(k)] * alignment(m, static_cast<std::size_t>(i), u.component);
  }
  return predicted;
}

FitResult GeometryFit::solve(const std::vector<std::vector<double>>& measured) const {
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), residual(jacobian_.rows());
  for (int step = 0; step <= steps; ++step) {
    for (std::size_t m = 0; m < measured.size(); ++m) {
      const auto predicted = predict(m, x);
      const Eigen::Map<const Eigen::VectorXd> seen(measured[m].data(),
                                                   static_cast<Eigen::Index>(measured[m].size()));
      residual.segment(static_cast<Eigen::Index>(rows_[m]), predicted.size()) = seen - predicted;
    }
    residual = weights_.cwiseProduct(residual);
    if (step < steps) x += covariance_ * (jacobian_.transpose() * residual - prior_.cwiseProduct(x));
  }
  FitResult result;
  result.location = location(x);
  result.tables = tables(x);
  result.errors = errors(x);
  result.residual = residual.norm() / std::sqrt(static_cast<double>(residual.size()));
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    const auto& u = unknowns_[k];
    const auto row = static_cast<Eigen::Index>(k);
    const bool angle = u.kind == Kind::inclination || u.kind == Kind::spindle;
    if (!angle && u.kind != Kind::displacement) continue;
    std::string name(1, axis_letters[u.component + (angle ? 3 : 0)]);
    name += u.axis < 3 ? '0' : 'O';
    name += u.axis == spindle ? 'S' : axis_letters[u.axis];
    result.locations.push_back({name, x[row], std::sqrt(covariance_(row, row)), angle});
  }
  result.tip_uncertainty = tip_uncertainty_;
  result.direction_uncertainty = direction_uncertainty_;
  return result;
}

void GeometryFit::find_uncertainty() {
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  auto ideal = report(zero);
  if (!plan_.measurements.empty()) ideal.tool_length = plan_.measurements.front().tool_length;
  const auto poses = ideal.random_poses(uncertainty_poses, 1);
  const auto rows = static_cast<Eigen::Index>(3 * poses.size());
  Eigen::MatrixXd tip = Eigen::MatrixXd::Zero(rows, n), direction = tip;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto& unknown = unknowns_[static_cast<std::size_t>(k)];
    if (unknown.kind == Kind::alignment) continue;
    Eigen::VectorXd x = zero;
    x[k] = 0.1 * unknown.expected;
    const auto changed = report(x);
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      const auto now = changed.geometry().pose(poses[i]), before = ideal.geometry().pose(poses[i]);
      const Vec3 moved = (now.tip - before.tip) / x[k];
      tip.col(k).segment<3>(at) = moved;
      direction.col(k).segment<3>(at) = (now.axis - before.axis) / x[k];
      mean += moved / static_cast<double>(poses.size());
    }
    for (std::size_t i = 0; i < poses.size(); ++i)
      tip.col(k).segment<3>(static_cast<Eigen::Index>(3 * i)) -= mean;
  }
  const auto spread = [&](const Eigen::MatrixXd& by) {
    return std::sqrt((by * covariance_).cwiseProduct(by).sum() / static_cast<double>(poses.size()));
  };
  tip_uncertainty_ = spread(tip);
  direction_uncertainty_ = spread(direction);
}

}  // namespace trunnion::identification
