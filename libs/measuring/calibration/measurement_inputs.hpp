// SPDX-License-Identifier: Apache-2.0
// What a measurement of the kinematics needs to know: inputs and settings of CYCLE9960 (A650, 2022) with
// their limits.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/machine_outline.hpp"
#include "metrology/chain_vectors.hpp"
#include "touch_probe/touch_probe.hpp"

namespace trunnion::calibration {

using geometry::Angles;
using geometry::ChainParameters;
using geometry::Vec3;

enum class Plane { g17, g18, g19, active };
enum class Mode { correct, only_correct, measure_only };
enum class Positioning { paraxial, circular };
enum class Reference { without, measure, adapt };

/// The name of the only transformation that a channel has.
inline constexpr std::string_view transformation_name = "TOOL_CARR_KIN";

/// By the index of a rotary axis, AxisRange::angle.
inline constexpr std::string_view rotary_letters = "ABCUVW";

/// How one rotary axis is measured.
struct AxisRange {
  std::size_t angle = 0;             ///< 0 = A .. 5 = W
  double start = 0, end = 0;         ///< deg, start below end, inside the travel
  std::size_t points = 3;            ///< 3 .. 12, evenly spaced
  double other = 0;                  ///< deg, of the other rotary axis
  double touch_start = 0;            ///< deg, of the first touch on the equator; without a shaft vector
  std::optional<int> normalization;  ///< 0 .. 6, 10 .. 16; absent: as geometry needs, see free_components()
  double normalized_value = 0;       ///< mm, of modes 1 .. 3
};

/// The place of the sphere that a reference head has measured.
struct ReferenceMeasurement {
  Vec3 sphere = Vec3::Zero();       ///< mm
  Vec3 zero_offset = Vec3::Zero();  ///< mm, the work offset that was in force
};

struct MeasurementInputs {
  Plane plane = Plane::active;
  std::string transformation;  ///< transformation_name, or empty: that of the channel
  Mode mode = Mode::measure_only;
  bool calibrate_probe = false;
  Positioning positioning = Positioning::circular;
  Reference reference = Reference::without;
  std::optional<ReferenceMeasurement> reference_measurement;  ///< of Reference::adapt
  Vec3 sphere = Vec3::Zero();                                 ///< mm, expected centre in the workpiece frame
  double sphere_diameter = 25;                                ///< mm
  std::optional<Vec3> shaft;            ///< from the centre to the shaft at zero; any length above zero
  double shaft_diameter = 8;            ///< mm
  double probe_length = 0;              ///< mm, spindle face to the centre of the ball
  double probe_length_uncertainty = 0;  ///< mm, standard uncertainty
  double ball_diameter = 6;             ///< mm
  double measuring_path = 2;            ///< mm before and after the expected touch
  double confidence_range = 1;          ///< mm, of a measured centre from the expected one
  /// Poses of both axes together in addition, evenly spread over their ranges; beyond CYCLE9960. 0 .. 100.
  std::size_t further_poses = 0;
  std::vector<AxisRange> axes;             ///< one or two
  std::optional<double> vector_tolerance;  ///< mm, largest change of an offset vector
  bool tolerance_needs_reset = false;      ///< its alarm cannot be acknowledged
  bool write_directions = false;           ///< measured directions are not only reported
  Vec3 zero_offset = Vec3::Zero();         ///< mm: work offset in force; the reference needs the same

  // Settings.
  std::size_t touches = 10;          ///< of a sphere: 2 x (4 + 1), or 8 = 2 x (3 + 1)
  double diameter_tolerance = 0.05;  ///< mm, of the measured diameter of each pose
  double least_triangle_angle = 2;   ///< deg, 2 .. 60
  double least_swept_angle = 10;     ///< deg, 10 .. 180
  double rotary_feed = 360;          ///< deg/min
  double circle_feed = 1000;         ///< mm/min
  /// mm/min: between touches and poses (F1), of the first touch (F2), of the second one, which counts (F3).
  double positioning_feed = 2000, first_touch_feed = 200, measuring_feed = 50;
  double repeatability = 0.005;  ///< mm: permitted range of five touches of one point on the machine
  std::uint32_t probe_on = 40, probe_off = 41;  ///< M functions that switch the probe on and off
  bool transformation_active = false;  ///< it may be active; otherwise it is switched off and restored
};

/// mm between ball and expected sphere where a touch begins and on the way there: the measuring path, or 1 mm
/// more than the sphere may be beside its place.
double standoff(const MeasurementInputs& inputs);

/// Probe and sphere as they were set up.
struct ProbeAndSphere {
  double probe_length = 0, ball_diameter = 6;  ///< mm, as in MeasurementInputs
  Vec3 sphere = Vec3::Zero();                  ///< mm, workpiece frame
  double sphere_diameter = 25;                 ///< mm
  std::optional<Vec3> shaft;                   ///< from the centre to the shaft
  double shaft_diameter = 0;                   ///< mm
};
/// Of truth.yaml: the probe, and the first sphere of the solids. Nothing when either is missing.
std::optional<ProbeAndSphere> probe_and_sphere(const std::optional<touch_probe::TouchProbeTruth>& probe,
                                               const std::vector<touch_probe::Solid>& solids);

/// The machine that is measured.
struct MeasuredMachine {
  std::string name;
  ChainParameters model;  ///< by which the control moves
  machine::MachineOutline outline;
  std::optional<ProbeAndSphere> gauges = {};
};

/// The machine with the axes of its `delivered` parameters and the vectors of its `active` ones, without
/// gauges. Throws std::runtime_error when the vectors are no chain.
MeasuredMachine measured_machine(const std::string& name, const machine::Parameters& delivered,
                                 const machine::Parameters& active, std::uint16_t channel);

/// Faults of inputs that depend on the machine: one line with number and limits, "" when there is none.
/// `axes` in the file's order; they must be all rotary axes of the machine, one or two.
std::string fault_of(const MeasurementInputs& inputs, const MeasuredMachine& machine);

/// Inputs for a machine without a file: 8 points of every rotary axis, every 45 degrees where it turns fully,
/// otherwise to the same angle on both sides of 0, at most 90 degrees. The other axis is at 0; of a head the
/// axis next to the tool at its end while the other is measured. Probe and sphere are those of the machine.
MeasurementInputs default_inputs(const MeasuredMachine& machine);

}  // namespace trunnion::calibration
