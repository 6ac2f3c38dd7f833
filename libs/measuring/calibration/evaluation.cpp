// SPDX-License-Identifier: Apache-2.0
#include "calibration/evaluation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibration/measured_centre.hpp"

namespace trunnion::calibration {
namespace {

using geometry::Chain;
using metrology::FitOptions;

constexpr double least_known_direction = 1e-3;
constexpr double advised_direction = 5e-5;  // A650, page 27

// The same place of every axis: 270 deg is -90 deg.
bool same_pose(const Angles& a, const Angles& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    most = std::max(most, std::abs(std::remainder(a[k] - b[k], 360.0)));
  return most < 1e-6;
}

class Evaluation {
 public:
  Evaluation(const MeasurementInputs& in, const MeasuredMachine& machine,
             const std::array<bool, metrology::slot_count>& in_correction)
      : in_(in), machine_(machine), in_correction_(in_correction), chain_(chain_of(machine.model)) {}

  KinematicsResult run(const std::vector<TouchedPose>& touched) {
    result_.before = machine_.model;
    centres(touched);
    circles();
    vectors();
    corrections();
    if (in_.reference == Reference::adapt) adapt();
    judge();
    return std::move(result_);
  }

 private:
  static Chain chain_of(const ChainParameters& parameters) {
    auto made = Chain::make(parameters);
    if (!std::holds_alternative<Chain>(made)) throw std::runtime_error("the kinematic chain is refused");
    return std::get<Chain>(std::move(made));
  }

  void centres(const std::vector<TouchedPose>& touched) {
    if (touched.empty()) throw std::runtime_error("no pose was touched");
    const auto initial = pose_name({}, machine_.model);
    if (!same_pose(touched.front().angles, {}))
      throw std::runtime_error("the first pose is " + pose_name(touched.front().angles, machine_.model) +
                               "; the measurement begins at the initial pose " + initial);
    result_.ball_diameter = in_.ball_diameter;
    for (const auto& pose : touched) {
      const auto found =
          measured_centre(in_, machine_, chain_, pose, result_.poses.empty(), result_.ball_diameter);
      const auto& fit = found.fit;
      if (in_.calibrate_probe && result_.poses.empty()) ball_cofactor_ = found.radius_cofactor;
      PoseResult out;
      out.angles = pose.angles;
      out.touches = pose.positions.size();
      out.diameter = found.diameter;
      out.centre = chain_.machine_from_tip(fit.centre, pose.angles, in_.probe_length);
      const geometry::Mat3 turn = chain_.jacobian(fit.centre, pose.angles, in_.probe_length).tip;
      measured_.push_back({pose.angles, out.centre, turn * fit.cofactor * turn.transpose()});
      result_.poses.push_back(out);
    }
  }

  std::size_t row_of(const Angles& angles) const {
    // Both ends of a whole turn may be touched: each is its own row.
    const auto apart = [&](std::size_t i) {
      double sum = 0;
      for (std::size_t k = 0; k < angles.size(); ++k) sum += std::abs(measured_[i].angles[k] - angles[k]);
      return sum;
    };
    std::size_t row = measured_.size();
    for (std::size_t i = 0; i < measured_.size(); ++i)
      if (same_pose(measured_[i].angles, angles) && (row == measured_.size() || apart(i) < apart(row)))
        row = i;
    if (row < measured_.size()) return row;
    throw std::runtime_error("pose " + pose_name(angles, machine_.model) + " is missing among the touches");
  }

  // Point `i` of an axis.
  Angles angles_at(const AxisRange& range, std::size_t i) const {
    Angles angles{};
    for (const auto& other : in_.axes) angles[other.angle] = range.other;
    angles[range.angle] = range.start + (range.end - range.start) * static_cast<double>(i) /
                                            static_cast<double>(range.points - 1);
    return angles;
  }

  void circles() {
    geometry::Mat3 directions = machine_.model.linear_direction;
    for (int i = 0; i < 3; ++i) directions.col(i).normalize();
    for (const auto& range : in_.axes) {
      AxisResult axis;
      axis.angle = range.angle;
      std::vector<metrology::TurnedCentre> turned;
      for (std::size_t i = 0; i < range.points; ++i) {
        const auto angles = angles_at(range, i);
        axis.rows.push_back(row_of(angles));
        turned.push_back({angles[range.angle], directions * measured_[axis.rows.back()].centre});
      }
      const auto fit = metrology::fit_axis(turned, {in_.least_triangle_angle, in_.least_swept_angle});
      if (const auto* error = std::get_if<metrology::AxisError>(&fit)) {
        double angle = 0;
        for (std::size_t i = 2; i < turned.size(); ++i)
          angle = std::max(angle, metrology::least_triangle_angle(turned[0].centre, turned[i / 2].centre,
                                                                  turned[i].centre));
        throw std::runtime_error(
            std::string("axis ") + "ABCUVW"[range.angle] + ": " + metrology::to_string(*error) +
            fmt::format(" (triangle {:.2f} deg, least {:.6g} deg; swept {:.6g} deg, least {:.6g} deg)", angle,
                        in_.least_triangle_angle, range.end - range.start, in_.least_swept_angle));
      }
      axis.circle = std::get<metrology::AxisFit>(fit);
      result_.axes.push_back(axis);
    }
  }

  std::vector<metrology::OffsetCondition> conditions(const ChainParameters& start) const {
    std::vector<metrology::OffsetCondition> given;
    for (const auto& vector : metrology::root_vectors(start))
      for (const auto& range : in_.axes) {
        if (range.angle != vector.angle || !range.normalization) continue;
        const int mode = *range.normalization % 10;
        const Vec3 along = mode == 0 ? Vec3(axis_at(start, vector.slot)->direction.normalized())
                                     : Vec3(Vec3::Unit((mode - 1) % 3));
        metrology::OffsetCondition condition;
        for (std::size_t s = 0; s < metrology::slot_count; ++s)
          condition.coefficient[s] = vector.share[s] * along;
        condition.value =
            mode >= 1 && mode <= 3 ? range.normalized_value : along.dot(value_of(vector, start));
        given.push_back(condition);
      }
    return metrology::free_components(start, given);
  }

  metrology::KinematicFit fit(const ChainParameters& start, FitOptions options, bool directions) const {
    options.directions = directions;
    auto found = metrology::fit_kinematics(start, measured_, in_.probe_length, options);
    if (const auto* error = std::get_if<metrology::FitError>(&found))
      throw std::runtime_error(metrology::to_string(*error));
    return std::get<metrology::KinematicFit>(std::move(found));
  }

  void vectors() {
    auto start = machine_.model;
    FitOptions options;
    options.into_correction = in_correction_;
    options.tool_length_uncertainty = in_.probe_length_uncertainty;
    // An error of the calibrated ball shifts the centre of every pose along the tool: a longer tool.
    options.tool_length_cofactor = ball_cofactor_;
    std::size_t open = 0;
    for (const auto& range : in_.axes) open += range.normalization.value_or(0) >= 10 ? 1 : 0;
    if (open > 0 && open < in_.axes.size())
      throw std::runtime_error("normalization: the chain is open for all axes or for none");
    if (open > 0) start.open = true, options.into_correction.fill(true);
    options.conditions = conditions(start);
    const auto real = fit(start, options, true);
    if (in_.write_directions)
      for (const auto& axis : real.axes)
        if (const double known = axis.direction.expanded.maxCoeff(); !(known <= least_known_direction))
          throw std::runtime_error(
              fmt::format("the direction of {} is known to {:.6f} only (95 %), at least {:.4f} is needed to "
                          "write it: a larger circle, more points, or directions: report",
                          "ABCUVW"[axis.angle], known, least_known_direction));
    // Without the directions the inclination of an axis is in the residuals; it is no error of the touches.
    if (real.freedom > 0)
      options.touch_deviation = real.touch_deviation, options.touch_freedom = real.freedom;
    const auto written = in_.write_directions ? real : fit(start, options, false);
    result_.after = written.parameters;
    result_.sphere = written.sphere;
    result_.touch_deviation = real.freedom > 0 ? real.touch_deviation : written.touch_deviation;
    result_.freedom = real.freedom > 0 ? real.freedom : written.freedom;
    result_.condition = real.condition;
    result_.not_observed = real.not_observed;
    for (std::size_t i = 0; i < result_.poses.size(); ++i) {
      result_.poses[i].difference = written.differences[i];
      result_.poses[i].residual = written.residuals[i];
    }
    for (const auto& vector : metrology::root_vectors(start))
      for (std::size_t i = 0; i < written.axes.size(); ++i) {
        if (written.axes[i].slot != vector.slot) continue;
        const auto& before = *axis_at(result_.before, vector.slot);
        VectorChange change;
        change.name = "ABCUVW"[vector.angle];
        change.slot = vector.slot;
        change.before = before.offset + before.correction;
        change.after = written.axes[i].offset.value;
        change.with_directions = real.axes[i].offset.value;
        change.expanded = written.axes[i].offset.expanded;
        change.observed = written.axes[i].offset.observed;
        change.direction_before = before.direction.normalized();
        change.direction_after = real.axes[i].direction.value;
        change.direction_expanded = real.axes[i].direction.expanded;
        result_.vectors.push_back(change);
      }
  }

  void corrections() {
    std::map<std::size_t, std::vector<CircleCentre>> circles_of;
    for (std::size_t k = 0; k < in_.axes.size(); ++k)
      for (std::size_t i = 0; i < in_.axes[k].points; ++i)
        circles_of[in_.axes[k].angle].push_back(
            {angles_at(in_.axes[k], i), result_.poses[result_.axes[k].rows[i]].difference});
    result_.corrections = circle_corrections(machine_.model, in_, measured_.front().centre, circles_of);
    for (auto& one : result_.corrections)
      for (const auto& vector : metrology::root_vectors(machine_.model))
        if (vector.angle == one.angle)
          one.all_poses = one.before + value_of(vector, result_.after) - value_of(vector, result_.before);
  }

  // The head's end is where the reference had the sphere: what is left over is the chain's open end.
  void adapt() {
    const auto& reference = in_.reference_measurement;
    if (!reference) throw std::runtime_error("reference adapt: no reference was measured");
    const Vec3 offset = reference->zero_offset - in_.zero_offset;
    if (!(offset.cwiseAbs().maxCoeff() <= 1e-6))
      throw std::runtime_error(
          fmt::format("reference adapt: the work offset {:.4f} {:.4f} {:.4f} mm is not the one of the "
                      "reference, {:.4f} {:.4f} {:.4f} mm",
                      in_.zero_offset.x(), in_.zero_offset.y(), in_.zero_offset.z(),
                      reference->zero_offset.x(), reference->zero_offset.y(), reference->zero_offset.z()));
    result_.after.origin += reference->sphere - result_.sphere;
    result_.sphere = reference->sphere;
  }

  void judge() {
    for (const auto& change : result_.vectors) {
      const double moved = (change.after - change.before).norm();
      result_.largest_change = std::max(result_.largest_change, moved);
      if (in_.vector_tolerance && moved > *in_.vector_tolerance && result_.tolerance_alarm.empty())
        result_.tolerance_alarm =
            fmt::format("the offset vector of {} changes by {:.4f} mm: the tolerance is {:.4f} mm",
                        change.name, moved, *in_.vector_tolerance);
      const Vec3 beside = change.direction_after - change.direction_before;
      if (beside.cwiseAbs().maxCoeff() > advised_direction)
        result_.warnings.push_back(fmt::format(
            "axis {} points {:.6f} {:.6f} {:.6f}: more than 0.00005 beside its ideal direction; correct the "
            "machine mechanically",
            change.name, change.direction_after.x(), change.direction_after.y(), change.direction_after.z()));
    }
    for (const auto& name : result_.not_observed)
      result_.warnings.push_back("these poses do not show " + name + "; it stays as it is");
  }

  const MeasurementInputs& in_;
  const MeasuredMachine& machine_;
  const std::array<bool, metrology::slot_count>& in_correction_;
  Chain chain_;
  std::vector<metrology::MeasuredPose> measured_;
  double ball_cofactor_ = 0;  // variance of the calibrated radius of the ball for touches of variance 1
  KinematicsResult result_;
};

}  // namespace

KinematicsResult evaluate(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                          const std::vector<TouchedPose>& touched,
                          const std::array<bool, metrology::slot_count>& in_correction) {
  return Evaluation(inputs, machine, in_correction).run(touched);
}

}  // namespace trunnion::calibration
