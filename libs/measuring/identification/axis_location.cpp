// SPDX-License-Identifier: Apache-2.0
#include "identification/axis_location.hpp"

#include <cmath>
#include <stdexcept>

#include "canonical/axes.hpp"
#include "geometry/angle.hpp"
#include "geometry/decompositions.hpp"

namespace trunnion::identification {
namespace {

using truth::Vec3;

using canonical::axis_letters;
constexpr double step_mm = 1e-3, step_rad = 1e-6;
constexpr double least_singular_value = 1e-3;  // of the largest, of columns of length one
constexpr double least_column = 1e-6;          // mm per mm, mm per 0.1 mrad

struct Unknown {
  std::string name;
  bool angle = false;
  Eigen::VectorXd column;
};

// What one unit of the error makes of every reading, mm per mm or rad.
Eigen::VectorXd column_of(const truth::TrueGeometry& wrong, const geometry::Chain& model, const Vec3& ball,
                          double tool_length, std::span<const BallDeviation> readings, double step) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(3 * readings.size()));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Vec3 place = model.machine_from_tip(ball, readings[i].angles, tool_length);
    truth::MachinePose pose;
    for (std::size_t k = 0; k < 3; ++k) pose.positions[k] = place[static_cast<Eigen::Index>(k)];
    std::copy(readings[i].angles.begin(), readings[i].angles.end(), pose.positions.begin() + 3);
    pose.tool_length = tool_length;
    const Vec3 moved = model.machine_from_tip(wrong.pose(pose).tip, readings[i].angles, tool_length) - place;
    column.segment<3>(static_cast<Eigen::Index>(3 * i)) = moved / step;
  }
  return column;
}

// Of one reading in one direction, as what moves as slowly as an axis that is displaced sees it. Neighbouring
// readings share their error, because those of a turn are smoothed: their power in the orders 2 .. 6 of the
// readings counts, 30 values in three directions; orders 0 and 1 are the setting and the errors themselves.
// Few readings are taken as independent.
double variance_of(const Eigen::VectorXd& residual, Eigen::Index unknowns) {
  constexpr Eigen::Index lowest = 2, highest = 6;
  const Eigen::Index rows = residual.size(), readings = rows / 3;
  if (readings <= 2 * highest)
    return residual.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(rows - 3 - unknowns, 1));
  double power = 0;
  for (Eigen::Index order = lowest; order <= highest; ++order)
    for (Eigen::Index direction = 0; direction < 3; ++direction) {
      double cosine = 0, sine = 0;
      for (Eigen::Index i = 0; i < readings; ++i) {
        const auto turn =
            geometry::sine_cosine(360.0 * static_cast<double>(order * i) / static_cast<double>(readings));
        cosine += residual[3 * i + direction] * turn.cosine;
        sine += residual[3 * i + direction] * turn.sine;
      }
      power += 2 * (cosine * cosine + sine * sine) / static_cast<double>(readings);
    }
  constexpr double values = 3 * 2 * (highest - lowest + 1);
  return power / values;
}

}  // namespace

AxisLocation locate_axis(const machine::MachineOutline& machine, const geometry::Chain& model,
                         std::size_t axis, const Vec3& ball, double tool_length,
                         std::span<const BallDeviation> readings) {
  if (readings.size() < 4) throw std::runtime_error("the place of an axis needs at least four readings");
  const auto rows = static_cast<Eigen::Index>(3 * readings.size());
  std::vector<Unknown> unknowns;
  AxisLocation result;
  for (const bool angle : {false, true})
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == axis % 3) continue;
      truth::GeometryTruth truth;
      auto& errors = truth.axes[axis];
      const double step = angle ? step_rad : step_mm;
      (angle ? errors.inclination : errors.displacement)[static_cast<Eigen::Index>(k)] = step;
      Unknown unknown{{axis_letters[k + (angle ? 3 : 0)], 'O', axis_letters[axis]}, angle, {}};
      unknown.column = column_of(truth::make_geometry(truth, machine, "location error"), model, ball,
                                 tool_length, readings, step);
      unknowns.push_back(std::move(unknown));
    }
  Eigen::VectorXd values(rows);
  for (std::size_t i = 0; i < readings.size(); ++i)
    values.segment<3>(static_cast<Eigen::Index>(3 * i)) = readings[i].deviation;
  // The setting of the sensors is a constant in each direction; of a column only what varies counts.
  const auto varying = [&](const Eigen::VectorXd& column) {
    Eigen::VectorXd rest = column;
    for (Eigen::Index k = 0; k < 3; ++k) {
      double mean = 0;
      for (Eigen::Index i = k; i < rows; i += 3) mean += column[i];
      mean /= static_cast<double>(readings.size());
      for (Eigen::Index i = k; i < rows; i += 3) rest[i] -= mean;
    }
    return rest;
  };
  Eigen::MatrixXd matrix;
  Eigen::VectorXd lengths;
  for (;;) {
    matrix.resize(rows, static_cast<Eigen::Index>(unknowns.size()));
    lengths.resize(matrix.cols());
    Eigen::Index weakest = -1;
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      matrix.col(k) = varying(unknowns[static_cast<std::size_t>(k)].column);
      lengths[k] = matrix.col(k).norm();
      const double scale = unknowns[static_cast<std::size_t>(k)].angle ? 1e-4 : 1;
      if (lengths[k] * scale < least_column * std::sqrt(static_cast<double>(rows))) weakest = k;
      if (lengths[k] > 0) matrix.col(k) /= lengths[k];
    }
    if (weakest < 0 && matrix.cols() > 0) {
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix.transpose() * matrix, Eigen::ComputeFullV);
      const auto& s = svd.singularValues();
      if (std::sqrt(s[s.size() - 1]) >= least_singular_value * std::sqrt(s[0])) break;
      svd.matrixV().col(s.size() - 1).cwiseAbs().maxCoeff(&weakest);
    }
    if (weakest < 0) break;
    result.hidden.push_back(unknowns[static_cast<std::size_t>(weakest)].name);
    unknowns.erase(unknowns.begin() + weakest);
  }
  const Eigen::MatrixXd normal = matrix.transpose() * matrix;
  const Eigen::MatrixXd inverse = geometry::symmetric_inverse(normal);
  const Eigen::VectorXd x = inverse * (matrix.transpose() * varying(values));
  Eigen::VectorXd rest = values;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    rest -= unknowns[static_cast<std::size_t>(k)].column * (x[k] / lengths[k]);
  for (std::size_t i = 0; i < readings.size(); ++i)
    result.setting +=
        rest.segment<3>(static_cast<Eigen::Index>(3 * i)) / static_cast<double>(readings.size());
  const Eigen::VectorXd residual = varying(rest);
  result.residual = residual.norm() / std::sqrt(static_cast<double>(rows));
  const double variance = variance_of(residual, x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const auto& unknown = unknowns[static_cast<std::size_t>(k)];
    result.errors.push_back(
        {unknown.name, x[k] / lengths[k], std::sqrt(variance * inverse(k, k)) / lengths[k], unknown.angle});
  }
  return result;
}

}  // namespace trunnion::identification
