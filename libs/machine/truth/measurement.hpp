// SPDX-License-Identifier: Apache-2.0
// Measurements of a machine at rest or at low speed: the control commands poses by its model, the instrument
// sees where the tool truly is.
#pragma once

#include <array>
#include <vector>

#include "geometry/radial_reading.hpp"
#include "truth/ballbar.hpp"
#include "truth/instrument.hpp"
#include "truth/pose_report.hpp"
#include "truth/position_accuracy.hpp"

namespace trunnion::truth {

struct BallbarMeasurement {
  std::vector<geometry::RadialReading> ccw, cw;
};

/// Both circles with the rotary axes at zero, each after a quarter turn of overrun.
BallbarMeasurement measure_ballbar(const PoseReport& report, const BallbarPath& path,
                                   const InstrumentTruth& instrument);

/// Which error of which axis a laser measures, and where.
struct LaserPlan {
  std::size_t axis = 0;       ///< 0 .. 2: X Y Z
  std::size_t component = 0;  ///< 0 .. 2 translation along X Y Z, 3 .. 5 rotation about X Y Z
  double from = 0, to = 100;  ///< mm, machine coordinates
  std::size_t targets = 11, runs = 5;
  Vec3 others = Vec3::Zero();  ///< machine coordinates of X Y Z; that of `axis` does not count
};

struct LaserMeasurement {
  std::vector<TargetDeviations> targets;  ///< mm or rad, less the reading at the first target
  PositionAccuracy accuracy;
};

/// Every run goes up through the targets and down again, with an overrun at both ends, the rotary axes at
/// zero.
LaserMeasurement measure_laser(const PoseReport& report, const LaserPlan& plan,
                               const InstrumentTruth& instrument);

struct NestReading {
  double angle = 0;                 ///< deg, of the axis
  std::array<double, 3> sensors{};  ///< mm
  Vec3 deviation = Vec3::Zero();    ///< mm: of the ball from the centre of the nest, from the sensors
};

/// The control keeps the ball at `centre` of the workpiece (RTCP) while a rotary axis (3 .. 8: A .. W) turns
/// from `from` to `to` deg, with `back` also back again; the nest was set to zero at the first pose.
std::vector<NestReading> measure_nest(const PoseReport& report, std::size_t axis, double from, double to,
                                      std::size_t points, const Vec3& centre,
                                      const InstrumentTruth& instrument, bool back = false);

}  // namespace trunnion::truth
