// SPDX-License-Identifier: Apache-2.0
#include "calibration/measurement_moves.hpp"

#include <algorithm>
#include <stdexcept>

#include "text/quantity.hpp"

namespace trunnion::calibration {
namespace {

constexpr double step = 5;          // deg, of a proposed range
constexpr double least_range = 10;  // deg
constexpr double margin = 0.02;     // mm: a body is in contact before its clearance is used up
// mm from the confidence range on a way. The approach position, which is 1 mm from it at least, must be free.
constexpr double beside_confidence = 0.5;

// Where a touch ends, a quarter of the measuring path behind the expected surface, the stylus is nearer to
// the sphere than the surface of the ball was by what the ball is thicker.
void check_measuring_path(const collision::BodySet& set, const MeasurementInputs& in) {
  double ball = 0, stylus = 0;
  for (const auto& body : set.bodies) {
    if (!body.tool) continue;
    if (const auto* sphere = std::get_if<collision::Sphere>(&body.shape)) ball = sphere->radius;
    const auto* cylinder = std::get_if<collision::Cylinder>(&body.shape);
    if (cylinder != nullptr && body.name == collision::stylus_name) stylus = cylinder->radius;
  }
  if (ball == 0 || stylus == 0) return;
  // path / 4 + min(path / 4, clearance) <= spare
  const double spare = ball - stylus - margin;
  const double longest = std::max({0.0, 2 * spare, 4 * (spare - set.clearance)});
  if (in.measuring_path <= longest) return;
  throw std::runtime_error("measuring_path_mm " + text::quantity(in.measuring_path, "mm") + " is above " +
                           text::quantity(longest, "mm") + ": with a ball of " +
                           text::quantity(2 * ball, "mm") + " the stylus of " +
                           text::quantity(2 * stylus, "mm") +
                           " would come too near to the sphere at the end of a touch; shorten the measuring "
                           "path or use a larger ball");
}

void add_probe_and_sphere(collision::MachineBodies& bodies, const std::vector<touch_probe::Solid>& solids,
                          const std::optional<touch_probe::TouchProbeTruth>& given,
                          const MeasurementInputs& in) {
  touch_probe::TouchProbeTruth probe;
  probe.length = in.probe_length, probe.ball_radius = in.ball_diameter / 2;
  const auto& all = bodies.set.bodies;
  if (std::none_of(all.begin(), all.end(), [](const auto& body) { return body.tool; }))
    collision::add_probe(bodies.links, given.value_or(probe), bodies.set);
  if (std::none_of(solids.begin(), solids.end(),
                   [](const auto& s) { return std::holds_alternative<touch_probe::SphereGauge>(s); }))
    collision::add_solids(bodies.links, {touch_probe::SphereGauge{in.sphere, in.sphere_diameter / 2}},
                          bodies.set);
  check_measuring_path(bodies.set, in);
  // Over the sphere the ball is one measuring path from it, less what the sphere is beside its place.
  bodies.set.clearance = std::min(bodies.set.clearance, in.measuring_path / 4);
}

}  // namespace

MeasurementMoves::MeasurementMoves(collision::MachineBodies bodies,
                                   const std::vector<touch_probe::Solid>& solids,
                                   const std::optional<touch_probe::TouchProbeTruth>& probe,
                                   const MeasurementInputs& in, const MeasuredMachine& measured)
    : inputs_(in),
      measured_(measured),
      travel_(measured.outline.axes),
      chain_(std::get<geometry::Chain>(geometry::Chain::make(measured.model))) {
  add_probe_and_sphere(bodies, solids, probe, in);
  auto touching = bodies.set;
  for (const auto& body : bodies.set.bodies)
    if (body.link == bodies.links.workpiece() && std::holds_alternative<collision::Sphere>(body.shape))
      for (const auto& tool : bodies.set.bodies)
        if (tool.tool && std::holds_alternative<collision::Sphere>(tool.shape))
          touching.allowed.emplace_back(tool.name, body.name);
  moving_.emplace(bodies.links, bodies.set);
  // On the way to a pose the sphere may be anywhere in the confidence range.
  for (auto& body : bodies.set.bodies)
    if (auto* sphere = std::get_if<collision::Sphere>(&body.shape);
        sphere != nullptr && body.link == bodies.links.workpiece())
      sphere->radius += in.confidence_range + std::min(0.0, beside_confidence - bodies.set.clearance);
  uncertain_.emplace(bodies.links, std::move(bodies.set));
  touching_.emplace(bodies.links, std::move(touching));
}

Vec3 MeasurementMoves::centre(const PlannedPose& pose) const {
  return chain_.machine_from_tip(inputs_.sphere, pose.angles, inputs_.probe_length);
}
collision::AxisPosition MeasurementMoves::approach(const PlannedPose& pose) const {
  return approach_position(inputs_, pose, centre(pose));
}

std::string MeasurementMoves::fault_at(const PlannedPose& pose) const {
  auto at = approach(pose);
  if (const auto contact = moving_->first_contact(at, at))
    return moving_->text_of(contact->pair) + " over the sphere";
  // As far as the expected touch and a quarter of the measuring path beyond.
  const double reach = standoff(inputs_) + inputs_.measuring_path / 4;
  std::size_t touches = 0;
  const auto meets = [&](const Vec3& to) {
    auto next = at;
    for (int i = 0; i < 3; ++i) next[static_cast<std::size_t>(i)] = to[i];
    const auto contact = touching_->first_contact(at, next);
    at = next;
    return contact ? touching_->text_of(contact->pair) + " at touch " + std::to_string(touches + 1) : "";
  };
  for (const auto& to : measuring_steps(inputs_, measured_, pose, centre(pose))) {
    if (auto fault = meets(to.to); !fault.empty()) return fault;
    if (!to.touch) continue;
    if (auto fault = meets(to.to - reach * to.direction); !fault.empty()) return fault;
    if (auto fault = meets(to.to); !fault.empty()) return fault;
    ++touches;
  }
  return "";
}

Way MeasurementMoves::way(const AxisPosition& from, const AxisPosition& to) const {
  // The probe may stand nearer already, as CYCLE9960 wants it over the pole, and the centre that was measured
  // last may lead it nearer to the expected one.
  const auto target = nearest_turns(measured_.outline, from, to);
  const bool near = uncertain_->first_contact(from, from) || uncertain_->first_contact(target, target);
  auto found = collision::find_way(near ? *moving_ : *uncertain_, travel_, from, target);
  if (const auto* fault = std::get_if<std::string>(&found)) throw std::runtime_error(*fault);
  return std::get<std::vector<collision::AxisPosition>>(std::move(found));
}

AxisPosition MeasurementMoves::check(const PlannedPose& pose, const AxisPosition& from) const {
  const auto name = "pose " + pose_name(pose.angles, measured_.model) + ": ";
  if (const auto fault = fault_at(pose); !fault.empty()) throw std::runtime_error(name + fault);
  try {
    way(from, approach(pose));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(name + e.what());
  }
  return approach(pose);
}

bool MeasurementMoves::reachable(const Angles& angles) const {
  // One pose: both ends of a range that is no wider than it must be.
  const auto plan = plan_pose(inputs_, measured_, angles);
  const auto* pose = std::get_if<PlannedPose>(&plan);
  return pose != nullptr && fault_at(*pose).empty();
}

MeasurementInputs MeasurementMoves::proposal() const {
  auto out = inputs_;
  for (auto& range : out.axes) {
    const auto at = [&](double angle) {
      Angles angles{};
      for (const auto& other : inputs_.axes) angles[other.angle] = range.other;
      angles[range.angle] = angle;
      return reachable(angles);
    };
    const double middle = std::clamp(0.0, range.start, range.end);
    const std::string name = std::string("axis ") + "ABCUVW"[range.angle];
    if (!at(middle))
      throw std::runtime_error(name + ": the sphere cannot be measured at " + text::quantity(middle, "deg"));
    double low = middle, high = middle;
    while (low - step >= range.start && at(low - step)) low -= step;
    while (high + step <= range.end && at(high + step)) high += step;
    if (high - low < least_range)
      throw std::runtime_error(name + ": the sphere can be measured from " + text::quantity(low) + " to " +
                               text::quantity(high, "deg") + " only; put it elsewhere");
    range.start = low, range.end = high;
  }
  return out;
}

}  // namespace trunnion::calibration
