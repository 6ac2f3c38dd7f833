// SPDX-License-Identifier: Apache-2.0
#include "calibration/measured_centre.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace trunnion::calibration {
namespace {

// mm: an effective diameter of the ball that differs by more is not one of pre-travel.
constexpr double ball_tolerance = 0.5;

template <class... Values>
[[noreturn]] void fail(const std::string& pose, fmt::format_string<Values...> format, Values&&... values) {
  throw std::runtime_error("pose " + pose + fmt::format(format, std::forward<Values>(values)...));
}

metrology::SphereFit sphere_of(const std::vector<Vec3>& tips, std::optional<double> radius,
                               const std::string& pose) {
  auto fit = metrology::fit_sphere(tips, radius);
  if (const auto* error = std::get_if<metrology::SphereError>(&fit))
    throw std::runtime_error("pose " + pose + ": " + metrology::to_string(*error));
  return std::get<metrology::SphereFit>(fit);
}

}  // namespace

MeasuredCentre measured_centre(const MeasurementInputs& in, const MeasuredMachine& machine,
                               const geometry::Chain& chain, const TouchedPose& pose, bool initial,
                               double& ball_diameter) {
  const auto name = pose_name(pose.angles, machine.model);
  std::vector<Vec3> tips;
  for (const auto& position : pose.positions)
    tips.push_back(chain.tip_from_machine(position, pose.angles, in.probe_length));
  const auto free = sphere_of(tips, std::nullopt, name);
  if (in.calibrate_probe && initial) {
    ball_diameter = 2 * free.radius - in.sphere_diameter;
    if (!(std::abs(ball_diameter - in.ball_diameter) <= ball_tolerance))
      fail(name,
           ": the ball's effective diameter is {:.4f} mm, given is {:.4f} mm: they may differ by {:.1f} mm; "
           "check probe and sphere",
           ball_diameter, in.ball_diameter, ball_tolerance);
  }
  MeasuredCentre out;
  out.diameter = 2 * free.radius - ball_diameter;
  out.radius_cofactor = free.radius_cofactor;
  if (!(std::abs(out.diameter - in.sphere_diameter) <= in.diameter_tolerance))
    fail(name, ": measured diameter of the sphere {:.4f} mm, given {:.4f} mm: the tolerance is {:.4f} mm",
         out.diameter, in.sphere_diameter, in.diameter_tolerance);
  out.fit = sphere_of(tips, (in.sphere_diameter + ball_diameter) / 2, name);
  const double away = (out.fit.centre - in.sphere).norm();
  if (!(away <= in.confidence_range))
    fail(name,
         ": the centre of the sphere is {:.4f} mm from the expected one: the confidence range is {:.4f} mm; "
         "reset",
         away, in.confidence_range);
  return out;
}

}  // namespace trunnion::calibration
