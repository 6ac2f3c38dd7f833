// SPDX-License-Identifier: Apache-2.0
#include "calibration/measurement_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/chain.hpp"
#include "machine/chain_parameters.hpp"

namespace trunnion::calibration {
namespace {

std::string number(double value) { return fmt::format("{:.10g}", value); }

std::vector<std::size_t> rotary_axes(const ChainParameters& chain) {
  std::vector<std::size_t> axes;
  for (const auto& vector : metrology::root_vectors(chain)) axes.push_back(vector.angle);
  return axes;
}

std::string outside(const std::string& what, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return "";
  return what + " " + number(value) + " " + unit + " is not within " + number(low) + " .. " + number(high) +
         " " + unit;
}

// The work plane is the one across the tool with every rotary axis at zero.
std::string plane_fault(Plane plane, const Vec3& tool) {
  if (plane == Plane::active) return "";
  constexpr const char* names[]{"G17", "G18", "G19"};
  const int normal = plane == Plane::g17 ? 2 : plane == Plane::g18 ? 1 : 0;
  if (std::abs(tool.normalized()[normal]) > 0.9999) return "";
  return std::string("plane ") + names[static_cast<int>(plane)] + ": the spindle is not perpendicular to it";
}

// Tolerance of a machine that is built at right angles: 1 mrad.
std::string frame_fault(const geometry::Mat3& directions) {
  geometry::Mat3 unit = directions;
  for (int i = 0; i < 3; ++i) unit.col(i).normalize();
  if ((unit.transpose() * unit - geometry::Mat3::Identity()).cwiseAbs().maxCoeff() > 1e-3)
    return "X, Y and Z are not perpendicular to each other (DIN 66217)";
  if (unit.determinant() < 0) return "X, Y and Z are not right-handed (DIN 66217)";
  return "";
}

}  // namespace

double standoff(const MeasurementInputs& in) {
  constexpr double beyond_confidence = 1;  // mm
  return std::max(in.measuring_path, in.confidence_range + beyond_confidence);
}

MeasuredMachine measured_machine(const std::string& name, const machine::Parameters& delivered,
                                 const machine::Parameters& active, std::uint16_t channel) {
  MeasuredMachine measured;
  measured.name = name;
  measured.model = machine::chain_parameters(active, channel);
  if (!std::holds_alternative<geometry::Chain>(geometry::Chain::make(measured.model)))
    throw std::runtime_error("the kinematic parameters are invalid");
  measured.outline = machine::outline_of(delivered, channel);
  return measured;
}

std::string fault_of(const MeasurementInputs& in, const MeasuredMachine& machine) {
  const auto present = rotary_axes(machine.model);
  if (present.empty() || present.size() > 2)
    return machine.name + " has " + std::to_string(present.size()) +
           " rotary axes in its transformation: 1 or 2 can be measured";
  if (!in.transformation.empty() && in.transformation != transformation_name)
    return "transformation " + in.transformation + " is not known: the channel has " +
           std::string(transformation_name);
  if (auto fault = frame_fault(machine.model.linear_direction); !fault.empty()) return fault;
  if (auto fault = plane_fault(in.plane, machine.model.tool_direction); !fault.empty()) return fault;
  if (!(in.positioning_feed > in.first_touch_feed && in.first_touch_feed > in.measuring_feed))
    return "feeds " + number(in.positioning_feed) + ", " + number(in.first_touch_feed) + ", " +
           number(in.measuring_feed) + " mm/min: positioning must be faster than the first touch, and that " +
           "faster than the measuring touch";
  if (in.axes.size() != present.size())
    return std::to_string(in.axes.size()) + " rotary axes are given, the machine has " +
           std::to_string(present.size());
  for (const auto& range : in.axes) {
    const std::string name = std::string("axis ") + rotary_letters[range.angle];
    if (std::find(present.begin(), present.end(), range.angle) == present.end())
      return name + ": the transformation has no such rotary axis";
    if (std::count_if(in.axes.begin(), in.axes.end(), [&](const auto& r) { return r.angle == range.angle; }) >
        1)
      return name + " is there twice";
    const auto& travel = machine.outline.axes[3 + range.angle];
    const double low = travel.present ? travel.low : -1e9, high = travel.present ? travel.high : 1e9;
    for (auto fault :
         {outside(name + ": start angle", range.start, low, high, "deg"),
          outside(name + ": end angle", range.end, low, high, "deg"),
          outside(name + ": number of points", static_cast<double>(range.points), 3, 12, "points")})
      if (!fault.empty()) return fault;
    if (!(range.start < range.end))
      return name + ": start angle " + number(range.start) + " deg is not below end angle " +
             number(range.end) + " deg";
    if (range.end - range.start < in.least_swept_angle)
      return name + ": swept angle " + number(range.end - range.start) + " deg is below the least of " +
             number(in.least_swept_angle) + " deg";
    for (const auto other : present) {
      if (other == range.angle) continue;
      const auto& limits = machine.outline.axes[3 + other];
      if (!limits.present) continue;
      if (auto fault = outside(name + ": position of " + rotary_letters[other], range.other, limits.low,
                               limits.high, "deg");
          !fault.empty())
        return fault;
    }
  }
  if (in.reference == Reference::adapt &&
      metrology::kinematic_type(machine.model) != metrology::KinematicType::head)
    return "reference adapt: only a machine whose rotary axes are all in the head has exchangeable heads";
  return "";
}

std::optional<ProbeAndSphere> probe_and_sphere(const std::optional<touch_probe::TouchProbeTruth>& probe,
                                               const std::vector<touch_probe::Solid>& solids) {
  if (!probe) return std::nullopt;
  for (const auto& solid : solids) {
    const auto* sphere = std::get_if<touch_probe::SphereGauge>(&solid);
    if (sphere == nullptr) continue;
    ProbeAndSphere out{probe->length, 2 * probe->ball_radius, sphere->centre, 2 * sphere->radius, {}, 0};
    if (sphere->shaft_radius > 0) out.shaft = sphere->shaft, out.shaft_diameter = 2 * sphere->shaft_radius;
    return out;
  }
  return std::nullopt;
}

MeasurementInputs default_inputs(const MeasuredMachine& machine) {
  MeasurementInputs in;
  if (const auto& gauges = machine.gauges) {
    in.probe_length = gauges->probe_length, in.ball_diameter = gauges->ball_diameter;
    in.sphere = gauges->sphere, in.sphere_diameter = gauges->sphere_diameter;
    in.shaft = gauges->shaft;
    if (in.shaft) in.shaft_diameter = gauges->shaft_diameter;
  }
  for (const auto angle : rotary_axes(machine.model)) {
    const auto& travel = machine.outline.axes[3 + angle];
    AxisRange range;
    range.angle = angle;
    range.points = 8;
    const double low = travel.present ? travel.low : -180, high = travel.present ? travel.high : 180;
    if (high - low >= 360) {
      range.start = std::clamp(0.0, low, high - 315), range.end = range.start + 315;  // every 45 deg
    } else {
      const double middle = std::clamp(0.0, low, high), half = std::min({high - middle, middle - low, 90.0});
      range.start = half > 5 ? middle - half : low;
      range.end = half > 5 ? middle + half : high;
    }
    in.axes.push_back(range);
  }
  // The axis next to the base turns a head's arm only when the other one holds it out.
  if (metrology::kinematic_type(machine.model) == metrology::KinematicType::head && in.axes.size() == 2)
    in.axes[0].other = in.axes[1].end;
  return in;
}

}  // namespace trunnion::calibration
