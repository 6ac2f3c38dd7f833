// SPDX-License-Identifier: Apache-2.0
#include "geometry/chain.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "geometry/angle.hpp"

namespace trunnion::geometry {
namespace {

std::optional<ChainError> normalize(Vec3& direction) {
  if (!direction.allFinite()) return ChainError::not_finite;
  const double length = direction.stableNorm();
  if (!(length > 0)) return ChainError::zero_direction;
  direction /= length;
  // A subnormal length leaves a direction that is not exactly a unit vector.
  direction /= direction.norm();
  return std::nullopt;
}

// Rodrigues' formula.
Vec3 turned(const Vec3& k, const SineCosine& t, const Vec3& v) {
  return t.cosine * v + t.sine * k.cross(v) + ((1 - t.cosine) * k.dot(v)) * k;
}
Vec3 turned_back(const Vec3& k, const SineCosine& t, const Vec3& v) {
  return turned(k, {-t.sine, t.cosine}, v);
}

}  // namespace

Vec3 Chain::Side::offsets() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += joints[i].offset;
  return sum;
}

std::optional<ChainError> Chain::adopt(const std::optional<RotaryAxis>& axis, Side& side) {
  if (!axis) return std::nullopt;
  if (axis->angle >= angle_count) return ChainError::bad_angle;
  if (!axis->offset.allFinite() || !axis->correction.allFinite()) return ChainError::not_finite;
  Joint& joint = side.joints[side.count++];
  joint = {axis->direction, axis->offset + axis->correction, axis->angle};
  return normalize(joint.direction);
}

std::optional<ChainError> Chain::check_rotary() const {
  bool parallel = rotary_count() > 1;
  for (std::size_t i = 0; i < rotary_count(); ++i)
    for (std::size_t j = i + 1; j < rotary_count(); ++j) {
      const auto a = orienting_axis(i), b = orienting_axis(j);
      if (a.angle == b.angle) return ChainError::shared_angle;
      if (a.direction.cross(b.direction).norm() >= parallel_sine) parallel = false;
    }
  return parallel ? std::optional(ChainError::parallel_axes) : std::nullopt;
}

std::variant<Chain, ChainError> Chain::make(const ChainParameters& p) {
  Chain chain;
  chain.tool_direction_ = p.tool_direction;
  if (const auto error = normalize(chain.tool_direction_)) return *error;
  for (const auto* axis : {&p.table_2, &p.table_1, &p.table_0})
    if (const auto error = adopt(*axis, chain.table_)) return *error;
  for (const auto* axis : {&p.head_2, &p.head_1, &p.head_0})
    if (const auto error = adopt(*axis, chain.head_)) return *error;
  if (const auto error = chain.check_rotary()) return *error;
  Vec3 origin = p.origin;
  if (p.open) {
    origin += p.base_correction;
    for (const auto* axis : {&p.table_2, &p.table_1, &p.table_0})
      if (*axis) origin += (*axis)->correction;
    for (const auto* axis : {&p.head_2, &p.head_1, &p.head_0})
      if (*axis) origin -= (*axis)->correction;
  }
  if (!origin.allFinite()) return ChainError::not_finite;
  chain.base_ = chain.table_.offsets() - chain.head_.offsets() - origin;
  for (int i = 0; i < 3; ++i) {
    Vec3 direction = p.linear_direction.col(i);
    if (const auto error = normalize(direction)) return *error;
    chain.to_space_.col(i) = direction;
  }
  if (std::abs(chain.to_space_.determinant()) < parallel_sine) return ChainError::dependent_linear;
  chain.carriers_ = p.linear_carriers;
  for (const int count : p.linear_carriers) {
    const Side& side = count > 0 ? chain.head_ : chain.table_;
    if (std::abs(count) > static_cast<int>(side.count)) return ChainError::bad_carrier;
    chain.carried_ = chain.carried_ || count != 0;
  }
  chain.perpendicular_ = chain.to_space_ == Mat3::Identity();
  chain.from_space_ = chain.to_space_.inverse();
  return chain;
}

Vec3 Chain::machine_from_tip(const Vec3& w, const Angles& degrees, double tool_length) const {
  Vec3 point = w;
  for (std::size_t i = 0; i < table_.count; ++i) {
    const Joint& joint = table_.joints[i];
    point = turned(joint.direction, sine_cosine(degrees[joint.angle]), point - joint.offset);
  }
  Vec3 tool = tool_length * tool_direction_;
  for (std::size_t i = 0; i < head_.count; ++i) {
    const Joint& joint = head_.joints[i];
    tool = turned(joint.direction, sine_cosine(degrees[joint.angle]), tool + joint.offset);
  }
  return axes_from_space(point + base_ + tool, degrees);
}

Vec3 Chain::tip_from_machine(const Vec3& machine, const Angles& degrees, double tool_length) const {
  Vec3 tool = tool_length * tool_direction_;
  for (std::size_t i = 0; i < head_.count; ++i) {
    const Joint& joint = head_.joints[i];
    tool = turned(joint.direction, sine_cosine(degrees[joint.angle]), tool + joint.offset);
  }
  Vec3 point = space_from_axes(machine, degrees) - base_ - tool;
  for (std::size_t i = table_.count; i-- > 0;) {
    const Joint& joint = table_.joints[i];
    point = turned_back(joint.direction, sine_cosine(degrees[joint.angle]), point) + joint.offset;
  }
  return point;
}

Vec3 Chain::tool_direction_in_workpiece(const Angles& degrees) const {
  Vec3 tool = tool_direction_;
  for (std::size_t i = 0; i < head_.count; ++i)
    tool = turned(head_.joints[i].direction, sine_cosine(degrees[head_.joints[i].angle]), tool);
  for (std::size_t i = table_.count; i-- > 0;)
    tool = turned_back(table_.joints[i].direction, sine_cosine(degrees[table_.joints[i].angle]), tool);
  return tool;
}

// The derivative of R(angle) r by the angle is k x (R r); an axis further out carries it along.
Jacobian Chain::jacobian(const Vec3& w, const Angles& degrees, double tool_length) const {
  if (carried_) return carried_jacobian(w, degrees, tool_length);
  Jacobian j;
  j.angle.setZero();
  j.further_angle.setZero();
  j.tip.setIdentity();
  const auto column = [&](const Joint& joint) {
    return joint.angle < 3 ? j.angle.col(static_cast<Eigen::Index>(joint.angle))
                           : j.further_angle.col(static_cast<Eigen::Index>(joint.angle - 3));
  };
  const auto side = [&](const Side& s, double sign, Vec3 arm) {
    for (std::size_t i = 0; i < s.count; ++i) {
      const Joint& joint = s.joints[i];
      const auto t = sine_cosine(degrees[joint.angle]);
      arm = turned(joint.direction, t, arm + sign * joint.offset);
      for (std::size_t k = 0; k < i; ++k)
        column(s.joints[k]) = turned(joint.direction, t, column(s.joints[k]));
      column(joint) = radians_per_degree * joint.direction.cross(arm);
      if (sign < 0)
        for (int k = 0; k < 3; ++k) j.tip.col(k) = turned(joint.direction, t, j.tip.col(k));
    }
  };
  side(table_, -1, w);
  side(head_, 1, tool_length * tool_direction_);
  if (!perpendicular_) {
    j.tip = from_space_ * j.tip;
    j.angle = from_space_ * j.angle;
    j.further_angle = from_space_ * j.further_angle;
  }
  return j;
}

// With K the matrix of k x and a_i = R y_i, where y_i are the derivatives of what is turned and w, w', w''
// those of the angle in radians: K^3 = -K, and by Leibniz
//   z1 = a1 + w K a0,  z2 = a2 + 2 w K a1 + (w' K + w^2 K^2) a0,
//   z3 = a3 + 3 w K a2 + 3 (w' K + w^2 K^2) a1 + (w'' K + 3 w w' K^2 - w^3 K) a0.
void Chain::turn(const Joint& joint, const TipMotion& motion, std::array<Vec3, 4>& y) const {
  const Vec3& k = joint.direction;
  const auto t = sine_cosine(motion.angles[0][joint.angle]);
  for (auto& v : y) v = turned(k, t, v);
  const double w = radians_per_degree * motion.angles[1][joint.angle];
  const double w1 = radians_per_degree * motion.angles[2][joint.angle];
  const double w2 = radians_per_degree * motion.angles[3][joint.angle];
  const Vec3 k0 = k.cross(y[0]), kk0 = k.cross(k0), k1 = k.cross(y[1]), kk1 = k.cross(k1), k2 = k.cross(y[2]);
  y[3] += 3 * w * k2 + 3 * (w1 * k1 + w * w * kk1) + (w2 - w * w * w) * k0 + 3 * w * w1 * kk0;
  y[2] += 2 * w * k1 + w1 * k0 + w * w * kk0;
  y[1] += w * k0;
}

std::array<Vec3, 4> Chain::machine_derivatives(const TipMotion& motion, double tool_length) const {
  std::array<Vec3, 4> point = motion.tip;
  for (std::size_t i = 0; i < table_.count; ++i) {
    point[0] -= table_.joints[i].offset;
    turn(table_.joints[i], motion, point);
  }
  std::array<Vec3, 4> tool{tool_length * tool_direction_, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < head_.count; ++i) {
    tool[0] += head_.joints[i].offset;
    turn(head_.joints[i], motion, tool);
  }
  point[0] += base_;
  for (std::size_t i = 0; i < 4; ++i) point[i] += tool[i];
  if (carried_) return carried_derivatives(point, motion);
  for (auto& v : point) v = axes_from_space(v, motion.angles[0]);
  return point;
}

// Calls turn(joint) for the axes that carry a linear axis, the one next to it first.
template <class Turn>
void Chain::carry(std::size_t axis, Turn&& turn) const {
  const Side& side = carriers_[axis] > 0 ? head_ : table_;
  const auto count = static_cast<std::size_t>(std::abs(carriers_[axis]));
  for (std::size_t i = side.count - count; i < side.count; ++i) turn(side.joints[i]);
}

Mat3 Chain::carried_directions(const Angles& degrees) const {
  Mat3 directions = to_space_;
  for (std::size_t axis = 0; axis < 3; ++axis)
    carry(axis, [&, column = static_cast<Eigen::Index>(axis)](const Joint& joint) {
      directions.col(column) =
          turned(joint.direction, sine_cosine(degrees[joint.angle]), directions.col(column));
    });
  return directions;
}

Vec3 Chain::carried_axes_from_space(const Vec3& x, const Angles& degrees) const {
  const Mat3 directions = carried_directions(degrees);
  if (!(std::abs(directions.determinant()) >= parallel_sine)) return Vec3::Constant(no_position);
  return directions.inverse() * x;
}

// From S = D X, differentiated three times.
std::array<Vec3, 4> Chain::carried_derivatives(const std::array<Vec3, 4>& space,
                                               const TipMotion& motion) const {
  std::array<Mat3, 4> d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<Eigen::Index>(axis);
    std::array<Vec3, 4> direction{to_space_.col(column), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    carry(axis, [&](const Joint& joint) { turn(joint, motion, direction); });
    for (std::size_t order = 0; order < 4; ++order) d[order].col(column) = direction[order];
  }
  if (!(std::abs(d[0].determinant()) >= parallel_sine))
    return {Vec3::Constant(no_position), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const Mat3 inverse = d[0].inverse();
  std::array<Vec3, 4> x;
  x[0] = inverse * space[0];
  x[1] = inverse * (space[1] - d[1] * x[0]);
  x[2] = inverse * (space[2] - 2 * (d[1] * x[1]) - d[2] * x[0]);
  x[3] = inverse * (space[3] - 3 * (d[1] * x[2]) - 3 * (d[2] * x[1]) - d[3] * x[0]);
  return x;
}

Jacobian Chain::carried_jacobian(const Vec3& w, const Angles& degrees, double tool_length) const {
  Jacobian j;
  TipMotion motion;
  motion.tip[0] = w;
  motion.angles[0] = degrees;
  for (int k = 0; k < 3; ++k) {
    motion.tip[1] = Vec3::Unit(k);
    j.tip.col(k) = machine_derivatives(motion, tool_length)[1];
  }
  motion.tip[1] = Vec3::Zero();
  for (std::size_t k = 0; k < angle_count; ++k) {
    motion.angles[1] = {};
    motion.angles[1][k] = 1;
    (k < 3 ? j.angle : j.further_angle).col(static_cast<Eigen::Index>(k % 3)) =
        machine_derivatives(motion, tool_length)[1];
  }
  return j;
}

bool Chain::turns(std::size_t angle) const {
  for (std::size_t i = 0; i < rotary_count(); ++i)
    if (orienting_axis(i).angle == angle) return true;
  return false;
}

OrientingAxis Chain::orienting_axis(std::size_t index) const {
  if (index < table_.count) return {-table_.joints[index].direction, table_.joints[index].angle};
  const Joint& joint = head_.joints[head_.count - 1 - (index - table_.count)];
  return {joint.direction, joint.angle};
}

}  // namespace trunnion::geometry
