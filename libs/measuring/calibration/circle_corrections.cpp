// SPDX-License-Identifier: Apache-2.0
#include "calibration/circle_corrections.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/angle.hpp"
#include "geometry/decompositions.hpp"
#include "metrology/axis_of_rotation.hpp"

namespace trunnion::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using metrology::RootVector;

constexpr double least_singular = 1e-3;  // relative: below it the circles do not tell the vectors apart

// The direction of an axis in the machine frame: the axes of its side that are nearer to the base turn it.
Vec3 turned_direction(const ChainParameters& model, metrology::Slot slot, const Angles& angles) {
  Vec3 direction = axis_at(model, slot)->direction.normalized();
  const std::size_t end = metrology::in_table(slot) ? 3 : metrology::slot_count;
  for (std::size_t i = metrology::index_of(slot) + 1; i < end; ++i)
    if (const auto& axis = axis_at(model, metrology::all_slots[i])) {
      const double angle = angles[axis->angle] * geometry::radians_per_degree;
      direction = Eigen::AngleAxisd(angle, axis->direction.normalized()).toRotationMatrix() * direction;
    }
  return direction;
}

// A chain with the sphere where the initial pose has found it.
class SphereOnChain {
 public:
  SphereOnChain(const ChainParameters& model, const Vec3& first, double probe_length)
      : chain_(std::get<geometry::Chain>(geometry::Chain::make(model))),
        directions_(model.linear_direction),
        probe_length_(probe_length),
        sphere_(chain_.tip_from_machine(first, {}, probe_length)) {
    for (int i = 0; i < 3; ++i) directions_.col(i).normalize();
  }

  Vec3 in_machine(const Vec3& axes) const { return directions_ * axes; }
  Vec3 position(const Angles& angles) const {
    return in_machine(chain_.machine_from_tip(sphere_, angles, probe_length_));
  }
  // Of the circle of an axis, across it: halfway between two positions half a turn apart.
  Vec3 centre(Angles angles, std::size_t axis) const {
    angles[axis] = 0;
    const Vec3 one = position(angles);
    angles[axis] = 180;
    return (one + position(angles)) / 2;
  }

 private:
  geometry::Chain chain_;
  geometry::Mat3 directions_;
  double probe_length_;
  Vec3 sphere_;
};

// Three equations of each axis for the changes of all offsets: two across it, one along it.
class Equations {
 public:
  Equations(const ChainParameters& model, const MeasurementInputs& in, const Vec3& first)
      : model_(model),
        in_(in),
        first_(first),
        vectors_(counted_vectors(model)),
        believed_(model, first, in.probe_length),
        rows_(MatrixXd::Zero(count(), count())),
        wanted_(VectorXd::Zero(count())) {}

  // False when the centres make no circle.
  bool across(std::size_t k, const std::vector<CircleCentre>& centres) {
    const auto& vector = vectors_[k];
    // Of a head the ball is on the other side: X, Y and Z follow the opposite of the tool.
    const double side = metrology::in_table(vector.slot) ? 1 : -1;
    std::vector<metrology::TurnedCentre> turned;
    for (const auto& centre : centres)
      turned.push_back({centre.angles[vector.angle],
                        side * believed_.position(centre.angles) + believed_.in_machine(centre.difference)});
    const auto fit = metrology::fit_axis(turned, {0, 0});
    const auto* circle = std::get_if<metrology::AxisFit>(&fit);
    if (circle == nullptr) return false;
    const auto& others = centres.front().angles;
    const Vec3 direction = turned_direction(model_, vector.slot, others);
    Eigen::Matrix<double, 2, 3> tangents;
    tangents.row(0) = direction.unitOrthogonal().transpose();
    tangents.row(1) = direction.cross(direction.unitOrthogonal()).transpose();
    const Vec3 centre = believed_.centre(others, vector.angle);
    const Index row = 3 * static_cast<Index>(k);
    wanted_.segment<2>(row) = tangents * (side * centre - circle->centre);
    for (std::size_t j = 0; j < vectors_.size(); ++j)
      for (int c = 0; c < 3; ++c) {
        // The centre is linear in the offsets.
        ChainParameters changed = model_;
        axis_at(changed, vectors_[j].slot)->offset[c] += 1;
        const SphereOnChain other(changed, first_, in_.probe_length);
        rows_.block<2, 1>(row, 3 * static_cast<Index>(j) + c) =
            tangents * (other.centre(others, vector.angle) - centre);
      }
    return true;
  }

  void along(std::size_t k) {
    const auto& vector = vectors_[k];
    Vec3 component = axis_at(model_, vector.slot)->direction.normalized();
    const Index row = 3 * static_cast<Index>(k) + 2;
    for (const auto& range : in_.axes) {
      const int mode = range.angle == vector.angle ? range.normalization.value_or(0) % 10 : 0;
      if (mode == 0) continue;
      component = Vec3::Unit((mode - 1) % 3);
      if (mode <= 3) wanted_[row] = range.normalized_value - component.dot(value_of(vector, model_));
    }
    for (std::size_t j = 0; j < vectors_.size(); ++j)
      rows_.block<1, 3>(row, 3 * static_cast<Index>(j)) = share(vector, j) * component.transpose();
  }

  std::vector<ChainCorrection> solve() const {
    const Eigen::JacobiSVD<MatrixXd> svd(rows_, Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (!(svd.singularValues().minCoeff() > least_singular * svd.singularValues().maxCoeff())) return {};
    const VectorXd changes = svd.solve(wanted_);
    std::vector<ChainCorrection> all;
    for (std::size_t k = 0; k < vectors_.size(); ++k) {
      ChainCorrection one;
      one.name = name(k);
      one.angle = vectors_[k].angle;
      for (std::size_t j = 0; j < vectors_.size(); ++j)
        one.before += share(vectors_[k], j) * axis_at(model_, vectors_[j].slot)->correction;
      one.circles = one.before;
      for (std::size_t j = 0; j < vectors_.size(); ++j)
        one.circles += share(vectors_[k], j) * changes.segment<3>(3 * static_cast<Index>(j));
      all.push_back(one);
    }
    return all;
  }

  const std::vector<RootVector>& vectors() const { return vectors_; }

 private:
  Index count() const { return 3 * static_cast<Index>(vectors_.size()); }
  double share(const RootVector& vector, std::size_t j) const {
    return vector.share[metrology::index_of(vectors_[j].slot)];
  }
  // Of the table after the axis to which it leads, of the head after what follows the axis.
  std::string name(std::size_t k) const {
    const bool table = metrology::in_table(vectors_[k].slot);
    const bool last = !table && (k + 1 == vectors_.size() || metrology::in_table(vectors_[k + 1].slot));
    std::string text = "CORR_";
    if (last)
      text += "SP1";
    else
      text += "ABCUVW"[vectors_[table ? k : k + 1].angle];
    return text + "_OFFSET";
  }

  const ChainParameters& model_;
  const MeasurementInputs& in_;
  Vec3 first_;
  std::vector<RootVector> vectors_;
  SphereOnChain believed_;
  MatrixXd rows_;
  VectorXd wanted_;
};

}  // namespace

std::vector<RootVector> counted_vectors(const ChainParameters& chain) {
  auto vectors = metrology::root_vectors(chain);
  std::stable_sort(vectors.begin(), vectors.end(), [](const auto& a, const auto& b) {
    return !metrology::in_table(a.slot) && metrology::in_table(b.slot);
  });
  return vectors;
}

std::vector<ChainCorrection> circle_corrections(
    const ChainParameters& model, const MeasurementInputs& inputs, const Vec3& first,
    const std::map<std::size_t, std::vector<CircleCentre>>& centres) {
  if (model.linear_carriers != std::array<int, 3>{}) return {};
  Equations equations(model, inputs, first);
  for (std::size_t k = 0; k < equations.vectors().size(); ++k) {
    const auto of_axis = centres.find(equations.vectors()[k].angle);
    if (of_axis == centres.end() || !equations.across(k, of_axis->second)) return {};
    equations.along(k);
  }
  return equations.solve();
}

}  // namespace trunnion::calibration
