// SPDX-License-Identifier: Apache-2.0
// Measuring instruments that see the true position of the tool relative to the workpiece, each with its own
// noise and resolution. Pure but for the state of the noise.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/random_source.hpp"
#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// Of one instrument, mm or rad.
struct InstrumentTruth {
  double noise = 0;       ///< standard deviation of one reading
  double resolution = 0;  ///< 0: continuous
  std::uint64_t seed = 1;
};

class Instrument {
 public:
  explicit Instrument(const InstrumentTruth& truth) : truth_(truth), random_(truth.seed) {}

  /// The reading of a true value, mm or rad.
  double read(double value) {
    if (truth_.noise > 0) value += truth_.noise * random_.normal();
    return truth_.resolution > 0 ? std::round(value / truth_.resolution) * truth_.resolution : value;
  }

  /// No field, the constructor sets it: truth_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("random", self.random_);
  }

 private:
  InstrumentTruth truth_;
  geometry::RandomSource random_;
};

/// A laser interferometer whose beam is a straight line in the frame of the workpiece: it was set to zero at
/// `zero`. `along` is the unit vector of the beam, `across` one perpendicular to it.
struct LaserSetup {
  ToolPose zero;
  Vec3 along = Vec3::UnitX(), across = Vec3::UnitY();
};

/// mm along the beam: of the retroreflector at the tip.
double laser_distance(const LaserSetup& setup, const ToolPose& tool);
/// mm across the beam: straightness optics.
double laser_straightness(const LaserSetup& setup, const ToolPose& tool);
/// rad, of the tool axis about along x across, by the right-hand rule: angular optics. For small angles.
double laser_angle(const LaserSetup& setup, const ToolPose& tool);

/// A dial whose plunger touches a plane of the workpiece at `zero`: mm in the direction of its plunger.
double dial(const Vec3& zero, const Vec3& plunger, const Vec3& tip);

/// ISO 230-1 R-test: a nest of three displacement sensors on the workpiece about a ball at the tip.
/// `directions` are the unit vectors of the sensors, `centre` the place of the ball where all are zero. mm.
struct Nest {
  Vec3 centre = Vec3::Zero();
  std::array<Vec3, 3> directions;

  /// Sensors perpendicular to each other that look up at 35.3 degrees, 120 degrees apart.
  static Nest at(const Vec3& centre);
  std::array<double, 3> readings(const Vec3& tip) const;
  /// The ball's place from three readings.
  Vec3 place(const std::array<double, 3>& readings) const;
};

}  // namespace trunnion::truth
