// SPDX-License-Identifier: Apache-2.0
#include "calibration/program_variables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "metrology/sphere.hpp"

namespace trunnion::calibration {
namespace {

constexpr std::uint32_t points = 8, touches_of_point = 4;  // of an axis; of a point
constexpr double same_angle = 1e-6;                        // deg

class VariableReader {
 public:
  explicit VariableReader(const std::map<std::uint32_t, double>& variables) : variables_(variables) {}

  double operator()(std::uint32_t number) const {
    const auto found = variables_.find(number);
    if (found == variables_.end())
      throw std::runtime_error("variable #" + std::to_string(number) +
                               " has no value: run %001 to its end first");
    return found->second;
  }
  [[noreturn]] void fail(std::uint32_t number, const std::string& expected) const {
    char value[40];
    std::snprintf(value, sizeof value, "%.6g", (*this)(number));
    throw std::runtime_error("variable #" + std::to_string(number) + " is " + value + ": " + expected);
  }

 private:
  const std::map<std::uint32_t, double>& variables_;
};

// The calibration type of the program for a machine: 0 dual head, 1 dual table, 2 hybrid.
int type_of(const ChainParameters& chain) {
  switch (metrology::kinematic_type(chain)) {
    case metrology::KinematicType::head:
      return 0;
    case metrology::KinematicType::table:
      return 1;
    case metrology::KinematicType::mixed:
      return 2;
    default:
      throw std::runtime_error("%001 measures two rotary axes; the machine does not have two");
  }
}

// Points of one axis: `base` is the variable of the first one's X, `own` and `other` the rotary axes.
AxisRange range_of(const VariableReader& read, std::uint32_t base, std::size_t axis, std::size_t own,
                   const AxisRange& settings) {
  const std::uint32_t first = base + (axis == 0 ? 30 : 40), second = base + (axis == 0 ? 40 : 30);
  AxisRange range = settings;
  range.angle = own;
  range.points = points;
  std::vector<double> angles;
  for (std::uint32_t i = 0; i < points; ++i) {
    angles.push_back(read(first + i));
    if (std::abs(read(second + i) - read(second)) > same_angle)
      read.fail(second + i, "the other rotary axis must stay while one is measured");
  }
  range.start = *std::min_element(angles.begin(), angles.end());
  range.end = *std::max_element(angles.begin(), angles.end());
  range.other = read(second);
  const double step = (range.end - range.start) / (points - 1);
  std::vector<double> sorted = angles;
  std::sort(sorted.begin(), sorted.end());
  for (std::uint32_t i = 0; i < points; ++i)
    if (std::abs(sorted[i] - range.start - i * step) > 1e-3)
      throw std::runtime_error("the 8 teaching points of the axis in #" + std::to_string(first) + " .. #" +
                               std::to_string(first + points - 1) + " must be evenly spaced");
  return range;
}

}  // namespace

ProgramMeasurement measurement_of(const std::map<std::uint32_t, double>& variables, MeasurementInputs in,
                                  const MeasuredMachine& machine) {
  const VariableReader read(variables);
  if (read(52999) != 2 * points)
    read.fail(52999, "%001 has measured so many of its 16 points; run it to its end");
  if (read(52000) != type_of(machine.model))
    read.fail(52000, "the calibration type of this machine is " + std::to_string(type_of(machine.model)) +
                         " (0 dual head, 1 dual table, 2 hybrid)");
  in.sphere_diameter = 2 * read(52008), in.probe_length = read(52009), in.ball_diameter = 2 * read(52010);
  in.calibrate_probe = true;
  std::array<std::size_t, 2> axes{};
  for (std::uint32_t i = 0; i < 2; ++i) {
    const double number = read(52002 + i);
    if (number != 4 && number != 5 && number != 6) read.fail(52002 + i, "4, 5 or 6 is expected: A, B or C");
    axes[i] = static_cast<std::size_t>(number) - 4;
  }
  const auto settings = in.axes;
  in.axes.clear();
  ProgramMeasurement out;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::uint32_t base = axis == 0 ? 52100 : 52800;
    const auto known = std::find_if(settings.begin(), settings.end(),
                                    [&](const auto& range) { return range.angle == axes[axis]; });
    in.axes.push_back(range_of(read, base, axis, axes[axis], known == settings.end() ? AxisRange{} : *known));
    for (std::uint32_t i = 0; i < points; ++i) {
      TouchedPose pose;
      for (std::size_t k = 0; k < 2; ++k) pose.angles[axes[k]] = read(base + (k == 0 ? 30 : 40) + i);
      const auto number = static_cast<std::uint32_t>(axis) * points + i;
      for (std::uint32_t k = 0; k < touches_of_point; ++k) {
        const std::uint32_t at = 52150 + 40 * number + 10 * k;
        pose.positions.emplace_back(read(at), read(at + 1), read(at + 2));
      }
      out.touched.push_back(pose);
    }
  }
  if (const auto order = variables.find(52001); order != variables.end() && order->second == 1)
    std::swap(in.axes[0], in.axes[1]);
  const auto initial = std::find_if(out.touched.begin(), out.touched.end(), [](const auto& pose) {
    return std::all_of(pose.angles.begin(), pose.angles.end(),
                       [](double angle) { return std::abs(angle) <= same_angle; });
  });
  if (initial == out.touched.end())
    throw std::runtime_error(
        "none of the 16 teaching points has both rotary axes at 0: the vectors count from there");
  std::rotate(out.touched.begin(), initial, initial + 1);
  // The sphere is where the initial pose has found it.
  const auto made = geometry::Chain::make(machine.model);
  if (!std::holds_alternative<geometry::Chain>(made))
    throw std::runtime_error("the kinematic chain is refused");
  std::vector<Vec3> tips;
  for (const auto& position : out.touched.front().positions)
    tips.push_back(std::get<geometry::Chain>(made).tip_from_machine(position, {}, in.probe_length));
  const auto fit = metrology::fit_sphere(tips);
  if (const auto* error = std::get_if<metrology::SphereError>(&fit))
    throw std::runtime_error(std::string("the touches of the initial pose: ") + metrology::to_string(*error));
  in.sphere = std::get<metrology::SphereFit>(fit).centre;
  out.inputs = std::move(in);
  return out;
}

}  // namespace trunnion::calibration
