// SPDX-License-Identifier: Apache-2.0
#include "calibration/touch_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibration/measured_centre.hpp"

namespace trunnion::calibration {
namespace {

constexpr std::size_t rounds = 2;
constexpr double same_angle = 1e-6;  // deg

void check_done(const std::vector<TouchedPose>& done, const MeasurementPlan& plan,
                const ChainParameters& chain) {
  for (std::size_t i = 0; i < done.size(); ++i) {
    const auto name = pose_name(done[i].angles, chain);
    if (i >= plan.poses.size())
      throw std::runtime_error("pose " + name + " was touched and is not planned; start again");
    const auto& planned = plan.poses[i];
    double most = 0;
    for (std::size_t k = 0; k < planned.angles.size(); ++k)
      most = std::max(most, std::abs(planned.angles[k] - done[i].angles[k]));
    if (most > same_angle)
      throw std::runtime_error("pose " + name + " was touched where " + pose_name(planned.angles, chain) +
                               " is planned; start again");
    if (done[i].positions.size() != rounds * planned.directions.size())
      throw std::runtime_error("pose " + name + " has " + std::to_string(done[i].positions.size()) +
                               " touches, " + std::to_string(rounds * planned.directions.size()) +
                               " are planned; start again");
  }
}

}  // namespace

TouchSequence::TouchSequence(const MeasurementInputs& inputs, const MeasuredMachine& measured,
                             const MeasurementPlan& plan, std::vector<TouchedPose> done)
    : inputs_(inputs),
      measured_(measured),
      plan_(plan),
      chain_(std::get<geometry::Chain>(geometry::Chain::make(measured.model))),
      done_(std::move(done)),
      ball_(inputs.ball_diameter) {
  check_done(done_, plan_, measured_.model);
  for (std::size_t i = 0; i < done_.size(); ++i)
    measured_centre(inputs_, measured_, chain_, done_[i], i == 0, ball_);
  begin_pose();
}

void TouchSequence::begin_pose() {
  if (finished()) return;
  current_ = {pose().angles, {}};
  expected_ = inputs_.sphere;
}

std::string TouchSequence::name() const { return pose_name(pose().angles, measured_.model); }

Vec3 TouchSequence::centre() const {
  return chain_.machine_from_tip(expected_, pose().angles, inputs_.probe_length);
}

bool TouchSequence::take(const std::vector<Vec3>& positions) {
  std::vector<Vec3> tips;
  for (const auto& position : positions)
    tips.push_back(chain_.tip_from_machine(position, current_.angles, inputs_.probe_length));
  current_.positions.insert(current_.positions.end(), positions.begin(), positions.end());
  const auto fit = metrology::fit_sphere(tips);
  if (const auto* error = std::get_if<metrology::SphereError>(&fit))
    throw std::runtime_error("pose " + name() + ": " + metrology::to_string(*error));
  expected_ = std::get<metrology::SphereFit>(fit).centre;
  if (current_.positions.size() < rounds * pose().directions.size()) return false;
  measured_centre(inputs_, measured_, chain_, current_, done_.empty(), ball_);
  done_.push_back(std::move(current_));
  begin_pose();
  return true;
}

}  // namespace trunnion::calibration
