// SPDX-License-Identifier: Apache-2.0
// The errors of a machine from measurements: least squares of the error model over all readings.
#pragma once

#include <Eigen/Core>
#include <map>

#include "compensation/model_parameters.hpp"
#include "identification/measurement_plan.hpp"

namespace trunnion::identification {

/// Expected magnitudes of the errors: a reading says more about an error than they do, and what no reading
/// says stays zero.
struct Magnitudes {
  double translation = 0.02, rotation = 1e-4;     ///< mm, rad: values of the tables
  double displacement = 0.2, inclination = 1e-3;  ///< mm, rad: location errors
  double alignment = 1;                           ///< mm/mm and mm: setting of an instrument
};

struct LocationResult {
  std::string name;        ///< C0Y, XOC, AOS ...
  double value = 0;        ///< mm or rad
  double uncertainty = 0;  ///< standard uncertainty
  bool angle = false;
};

struct FitResult {
  volumetric::GeometryErrors location;                   ///< location errors and reference points
  std::map<std::size_t, volumetric::AxisTables> tables;  ///< of the axes that were measured
  volumetric::GeometryErrors errors;                     ///< both
  std::vector<LocationResult> locations;
  double residual = 0;  ///< root mean square of the readings' residuals over their uncertainties
  /// Standard uncertainty of tip (mm) and tool direction (rad): root mean square over the poses of
  /// GeometryFit::uncertainty_poses, after the mean tip deviation is taken off.
  double tip_uncertainty = 0, direction_uncertainty = 0;
};

/// Unknowns: the values of the six error functions of each measured axis at equal positions, a reversal value
/// of its own motion, squareness, location errors of the rotary axes and of the spindle, and the setting of
/// each instrument (direction of a straightness reference, centre and length of a ballbar). Weights are
/// 1 / uncertainty of the readings, with `Magnitudes` as the prior deviations; Gauss-Newton with the
/// derivatives at zero errors.
class GeometryFit {
 public:
  static constexpr int steps = 4;
  static constexpr std::size_t uncertainty_poses = 100;

  /// Throws std::runtime_error when the plan's structure is not the machine's.
  GeometryFit(const machine::MachineOutline& machine, const geometry::Chain& model,
              const MeasurementPlan& plan, const Magnitudes& magnitudes = {});

  /// `measured`: the readings of each measurement of the plan, as readings() has them.
  FitResult solve(const std::vector<std::vector<double>>& measured) const;
  std::size_t unknowns() const { return unknowns_.size(); }

 private:
  enum class Kind { node, reversal, displacement, inclination, spindle, alignment };
  struct Unknown {
    Kind kind = Kind::node;
    std::size_t axis = 0, component = 0;  // alignment: measurement, which
    std::size_t node = 0;
    double expected = 1;
  };

  void find_unknowns(const Magnitudes& magnitudes);
  volumetric::GeometryErrors location(const Eigen::VectorXd& x) const;
  std::map<std::size_t, volumetric::AxisTables> tables(const Eigen::VectorXd& x) const;
  volumetric::GeometryErrors errors(const Eigen::VectorXd& x) const;
  truth::PoseReport report(const Eigen::VectorXd& x) const;
  bool concerns(const Unknown& unknown, std::size_t measurement) const;
  Eigen::VectorXd predict(std::size_t measurement, const Eigen::VectorXd& x) const;
  double alignment(const Measurement& m, std::size_t reading, std::size_t which) const;
  void find_uncertainty();

  machine::MachineOutline machine_;
  geometry::Chain model_;
  MeasurementPlan plan_;
  std::map<std::size_t, volumetric::AxisTables> grid_;  // positions of the tables, without values
  std::vector<Unknown> unknowns_;
  std::vector<std::size_t> rows_;  // first row of each measurement, and the end
  Eigen::MatrixXd jacobian_;       // weighted
  Eigen::VectorXd weights_, prior_;
  Eigen::MatrixXd covariance_;
  double tip_uncertainty_ = 0, direction_uncertainty_ = 0;
};

}  // namespace trunnion::identification
