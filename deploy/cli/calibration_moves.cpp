// SPDX-License-Identifier: Apache-2.0
#include "calibration_moves.hpp"

#include <algorithm>
#include <stdexcept>

namespace trunnion::cli {
namespace {

using calibration::PlannedPose;

constexpr double step = 5;          // deg, of a proposed range
constexpr double least_range = 10;  // deg

collision::MachineBodies bodies_of(const TrueMachine& machine, const std::string& name, std::uint16_t channel,
                                   const calibration::MeasurementInputs& in) {
  auto bodies = load_bodies(machine, name, channel);
  truth::TouchProbeTruth probe;
  probe.length = in.probe_length, probe.ball_radius = in.ball_diameter / 2;
  put_probe(bodies, machine.truth.probe.value_or(probe));
  const bool sphere =
      std::any_of(machine.truth.solids.begin(), machine.truth.solids.end(),
                  [](const auto& s) { return std::holds_alternative<truth::SphereGauge>(s); });
  if (!sphere)
    collision::add_solids(bodies.links, {truth::SphereGauge{in.sphere, in.sphere_diameter / 2}}, bodies.set);
  // Over the sphere the ball is one measuring path from it, less what the sphere is beside its place.
  bodies.set.clearance = std::min(bodies.set.clearance, in.measuring_path / 4);
  return bodies;
}

}  // namespace

CalibrationMoves::CalibrationMoves(const TrueMachine& machine, const std::string& name, std::uint16_t channel,
                                   const calibration::MeasurementInputs& in,
                                   const calibration::MeasuredMachine& measured)
    : inputs_(in),
      measured_(measured),
      travel_(machine.outline.axes),
      chain_(std::get<geometry::Chain>(geometry::Chain::make(measured.model))) {
  auto bodies = bodies_of(machine, name, channel, in);
  auto touching = bodies.set;
  for (const auto& body : bodies.set.bodies)
    if (body.link == bodies.links.workpiece() && std::holds_alternative<collision::Sphere>(body.shape))
      for (const auto& tool : bodies.set.bodies)
        if (tool.tool && std::holds_alternative<collision::Sphere>(tool.shape))
          touching.allowed.emplace_back(tool.name, body.name);
  moving_.emplace(bodies.links, std::move(bodies.set));
  touching_.emplace(bodies.links, std::move(touching));
}

calibration::Vec3 CalibrationMoves::centre(const PlannedPose& pose) const {
  return chain_.machine_from_tip(inputs_.sphere, pose.angles, inputs_.probe_length);
}
collision::AxisPosition CalibrationMoves::approach(const PlannedPose& pose) const {
  return calibration::approach_position(inputs_, pose, centre(pose));
}

std::string CalibrationMoves::fault_at(const PlannedPose& pose) const {
  auto at = approach(pose);
  if (const auto contact = moving_->first_contact(at, at))
    return moving_->text_of(contact->pair) + " over the sphere";
  const double reach = inputs_.measuring_path;
  std::size_t touches = 0;
  const auto meets = [&](const calibration::Vec3& to) {
    auto next = at;
    for (int i = 0; i < 3; ++i) next[static_cast<std::size_t>(i)] = to[i];
    const auto contact = touching_->first_contact(at, next);
    at = next;
    return contact ? touching_->text_of(contact->pair) + " at touch " + std::to_string(touches + 1) : "";
  };
  for (const auto& to : calibration::measuring_steps(inputs_, measured_, pose, centre(pose))) {
    if (auto fault = meets(to.to); !fault.empty()) return fault;
    if (!to.touch) continue;
    // As far as the expected touch and a quarter of the measuring path beyond.
    if (auto fault = meets(to.to - 1.25 * reach * to.direction); !fault.empty()) return fault;
    if (auto fault = meets(to.to); !fault.empty()) return fault;
    ++touches;
  }
  return "";
}

calibration::Way CalibrationMoves::way(const calibration::AxisPosition& from,
                                       const calibration::AxisPosition& to) const {
  auto found = collision::find_way(*moving_, travel_, from, to);
  if (const auto* fault = std::get_if<std::string>(&found)) throw std::runtime_error(*fault);
  auto way = std::get<std::vector<collision::AxisPosition>>(std::move(found));
  way.erase(way.begin());
  return way;
}

std::size_t CalibrationMoves::check(const calibration::MeasurementPlan& plan,
                                    const calibration::AxisPosition& from) const {
  auto at = from;
  for (const auto& pose : plan.poses) {
    const auto name = "pose " + calibration::pose_name(pose.angles, measured_.model) + ": ";
    if (const auto fault = fault_at(pose); !fault.empty()) throw std::runtime_error(name + fault);
    try {
      way(at, approach(pose));
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(name + e.what());
    }
    at = approach(pose);
  }
  return plan.poses.size();
}

bool CalibrationMoves::reachable(const calibration::Angles& angles) const {
  // One pose: both ends of a range that is no wider than it must be.
  const auto plan = calibration::plan_pose(inputs_, measured_, angles);
  const auto* pose = std::get_if<PlannedPose>(&plan);
  return pose != nullptr && fault_at(*pose).empty();
}

calibration::MeasurementInputs CalibrationMoves::proposal() const {
  auto out = inputs_;
  for (auto& range : out.axes) {
    const auto at = [&](double angle) {
      calibration::Angles angles{};
      for (const auto& other : inputs_.axes) angles[other.angle] = range.other;
      angles[range.angle] = angle;
      return reachable(angles);
    };
    const double middle = std::clamp(0.0, range.start, range.end);
    const std::string name = std::string("axis ") + "ABCUVW"[range.angle];
    if (!at(middle))
      throw std::runtime_error(name + ": the sphere cannot be measured at " + std::to_string(middle) +
                               " deg");
    double low = middle, high = middle;
    while (low - step >= range.start && at(low - step)) low -= step;
    while (high + step <= range.end && at(high + step)) high += step;
    if (high - low < least_range)
      throw std::runtime_error(name + ": the sphere can be measured from " + std::to_string(low) + " to " +
                               std::to_string(high) + " deg only; put it elsewhere");
    range.start = low, range.end = high;
  }
  return out;
}

}  // namespace trunnion::cli
