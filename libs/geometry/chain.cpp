#include "geometry/chain.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace trunnion::geometry {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180.0;

// Sine and cosine of an angle in degrees, exact at the multiples of 90 where tables and heads usually stand.
void sine_cosine(double degrees, double& sine, double& cosine) {
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter) * radians_per_degree;
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (quarter & 3) {
    case 0:
      sine = s, cosine = c;
      break;
    case 1:
      sine = c, cosine = -s;
      break;
    case 2:
      sine = -s, cosine = -c;
      break;
    default:
      sine = -c, cosine = s;
      break;
  }
}

std::optional<ChainError> normalize(Vec3& direction) {
  if (!direction.allFinite()) return ChainError::not_finite;
  const double length = direction.stableNorm();
  if (!(length > 0)) return ChainError::zero_direction;
  direction /= length;
  return std::nullopt;
}

}  // namespace

std::optional<ChainError> Chain::adopt(const std::optional<RotaryAxis>& axis, Joint& joint) {
  if (!axis) return std::nullopt;
  if (axis->angle > 2) return ChainError::bad_angle;
  if (!axis->offset.allFinite()) return ChainError::not_finite;
  joint.direction = axis->direction;
  joint.offset = axis->offset;
  joint.angle = static_cast<int>(axis->angle);
  return normalize(joint.direction);
}

std::variant<Chain, ChainError> Chain::make(const ChainParameters& parameters) {
  Chain chain;
  chain.tool_direction_ = parameters.tool_direction;
  if (const auto error = normalize(chain.tool_direction_)) return *error;
  if (const auto error = adopt(parameters.head_1, chain.head_1_)) return *error;
  if (const auto error = adopt(parameters.head_2, chain.head_2_)) return *error;
  if (const auto error = adopt(parameters.table_1, chain.table_1_)) return *error;
  if (const auto error = adopt(parameters.table_2, chain.table_2_)) return *error;
  std::array<int, 3> users{};
  for (const Joint* joint : {&chain.head_1_, &chain.head_2_, &chain.table_1_, &chain.table_2_}) {
    if (joint->angle >= 0 && ++users[static_cast<std::size_t>(joint->angle)] > 1)
      return ChainError::shared_angle;
  }
  return chain;
}

// Rodrigues' formula written out.
Mat3 Chain::rotation(const Joint& joint, const Angles& degrees) {
  if (joint.angle < 0) return Mat3::Identity();
  double s = 0;
  double c = 1;
  sine_cosine(degrees[static_cast<std::size_t>(joint.angle)], s, c);
  const Vec3& k = joint.direction;
  const double d = 1.0 - c;
  Mat3 r;
  r << c + d * k.x() * k.x(), d * k.x() * k.y() - s * k.z(), d * k.x() * k.z() + s * k.y(),
      d * k.x() * k.y() + s * k.z(), c + d * k.y() * k.y(), d * k.y() * k.z() - s * k.x(),
      d * k.x() * k.z() - s * k.y(), d * k.y() * k.z() + s * k.x(), c + d * k.z() * k.z();
  return r;
}

Vec3 Chain::machine_from_tip(const Vec3& w, const Angles& degrees, double tool_length) const {
  const Vec3 on_table = rotation(table_2_, degrees) * (w - table_2_.offset) - table_1_.offset;
  const Vec3 point = table_2_.offset + table_1_.offset + rotation(table_1_, degrees) * on_table;
  const Vec3 in_head =
      head_1_.offset + rotation(head_2_, degrees) * (head_2_.offset + tool_length * tool_direction_);
  return point - (head_1_.offset + head_2_.offset) + rotation(head_1_, degrees) * in_head;
}

Vec3 Chain::tip_from_machine(const Vec3& machine, const Angles& degrees, double tool_length) const {
  const Vec3 in_head =
      head_1_.offset + rotation(head_2_, degrees) * (head_2_.offset + tool_length * tool_direction_);
  const Vec3 point = machine + (head_1_.offset + head_2_.offset) - rotation(head_1_, degrees) * in_head;
  const Vec3 on_table =
      rotation(table_1_, degrees).transpose() * (point - table_2_.offset - table_1_.offset) + table_1_.offset;
  return rotation(table_2_, degrees).transpose() * on_table + table_2_.offset;
}

Vec3 Chain::tool_direction_in_workpiece(const Angles& degrees) const {
  const Vec3 in_machine = rotation(head_1_, degrees) * (rotation(head_2_, degrees) * tool_direction_);
  return rotation(table_2_, degrees).transpose() * (rotation(table_1_, degrees).transpose() * in_machine);
}

// The derivative of R(angle) r by the angle is k x (R r); turning axis 1 also carries what axis 2 turned.
Jacobian Chain::jacobian(const Vec3& w, const Angles& degrees, double tool_length) const {
  Jacobian j;
  j.angle.setZero();
  const Mat3 table_1 = rotation(table_1_, degrees);
  const Mat3 table_2 = rotation(table_2_, degrees);
  j.tip = table_1 * table_2;
  const Vec3 table_arm = table_2 * (w - table_2_.offset);
  if (table_1_.angle >= 0) {
    j.angle.col(table_1_.angle) =
        radians_per_degree * table_1_.direction.cross(table_1 * (table_arm - table_1_.offset));
  }
  if (table_2_.angle >= 0) {
    j.angle.col(table_2_.angle) = radians_per_degree * (table_1 * table_2_.direction.cross(table_arm));
  }
  const Mat3 head_1 = rotation(head_1_, degrees);
  const Vec3 head_arm = rotation(head_2_, degrees) * (head_2_.offset + tool_length * tool_direction_);
  if (head_1_.angle >= 0) {
    j.angle.col(head_1_.angle) =
        radians_per_degree * head_1_.direction.cross(head_1 * (head_1_.offset + head_arm));
  }
  if (head_2_.angle >= 0) {
    j.angle.col(head_2_.angle) = radians_per_degree * (head_1 * head_2_.direction.cross(head_arm));
  }
  return j;
}

bool Chain::turns(std::size_t angle) const {
  for (const Joint* joint : {&head_1_, &head_2_, &table_1_, &table_2_}) {
    if (joint->angle >= 0 && static_cast<std::size_t>(joint->angle) == angle) return true;
  }
  return false;
}

}  // namespace trunnion::geometry
