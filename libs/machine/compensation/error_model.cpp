// SPDX-License-Identifier: Apache-2.0
#include "compensation/error_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "canonical/axes.hpp"
#include "geometry/angle.hpp"

namespace trunnion::volumetric {
namespace {

using geometry::radians_per_degree;
using geometry::RotaryAxis;

using canonical::axis_letters;

geometry::SineCosine of_radians(double angle) { return geometry::sine_cosine(angle / radians_per_degree); }

// Rodrigues' formula.
Vec3 turned(const Vec3& k, const geometry::SineCosine& t, const Vec3& v) {
  return t.cosine * v + t.sine * k.cross(v) + ((1 - t.cosine) * k.dot(v)) * k;
}

using Sides = std::array<const std::optional<RotaryAxis>*, 3>;
// [0] next to the workpiece, to the tool.
Sides table_of(const geometry::ChainParameters& p) { return {&p.table_2, &p.table_1, &p.table_0}; }
Sides head_of(const geometry::ChainParameters& p) { return {&p.head_2, &p.head_1, &p.head_0}; }

std::vector<std::size_t> axes_of(const Sides& side) {
  std::vector<std::size_t> axes;
  for (const auto* axis : side)
    if (*axis) axes.push_back(3 + (*axis)->angle);
  return axes;
}

std::vector<StructureAxis> default_structure(const geometry::ChainParameters& p) {
  std::vector<StructureAxis> structure;
  const auto table = axes_of(table_of(p)), head = axes_of(head_of(p));
  // The linear axes with `count` rotary axes between them and the base; below zero those of the table.
  const auto linear = [&](int count) {
    for (std::size_t i = 0; i < 3; ++i)
      if (p.linear_carriers[i] == count) structure.push_back({i, count < 0});
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    linear(-static_cast<int>(table.size() - i));
    structure.push_back({table[i], true});
  }
  linear(0);
  for (std::size_t i = head.size(); i-- > 0;) {
    structure.push_back({head[i], false});
    linear(static_cast<int>(head.size() - i));
  }
  return structure;
}

bool has_effect(const AxisErrors& axis) {
  return !axis.errors.empty() || !axis.displacement.isZero(0) || !axis.inclination.isZero(0);
}

bool has_effect(const HeatSource& source) {
  return source.expansion != 0 || !source.shift.isZero(0) || !source.tilt.isZero(0);
}

void apply(const Vec3& translation, const Vec3& angles, const Vec3& at, Vec3& tip, Vec3& axis) {
  if (!angles.isZero(0)) {
    const Mat3 r = rotation(angles);
    tip = at + r * (tip - at);
    axis = r * axis;
  }
  tip += translation;
}

}  // namespace

Mat3 rotation(const Vec3& angles) {
  const auto a = of_radians(angles[0]), b = of_radians(angles[1]), c = of_radians(angles[2]);
  Mat3 r;
  r << c.cosine * b.cosine, c.cosine * b.sine * a.sine - c.sine * a.cosine,
      c.cosine * b.sine * a.cosine + c.sine * a.sine,  //
      c.sine * b.cosine, c.sine * b.sine * a.sine + c.cosine * a.cosine,
      c.sine * b.sine * a.cosine - c.cosine * a.sine,  //
      -b.sine, b.cosine * a.sine, b.cosine * a.cosine;
  return r;
}

bool GeometryErrors::ideal() const {
  return !beam && !has_effect(spindle) &&
         std::none_of(axes.begin(), axes.end(), [](const auto& axis) { return has_effect(axis); }) &&
         std::none_of(heat.begin(), heat.end(), [](const auto& source) { return has_effect(source); });
}

std::variant<ErrorModel, std::string> ErrorModel::make(const geometry::ChainParameters& design,
                                                       const GeometryErrors& errors) {
  auto chain = geometry::Chain::make(design);
  if (std::holds_alternative<geometry::ChainError>(chain))
    return "the kinematic parameters of the machine make no chain";
  ErrorModel made(std::get<geometry::Chain>(std::move(chain)));
  made.errors_ = errors;
  made.ideal_ = errors.ideal();
  for (auto& axis : made.errors_.axes)
    for (auto& error : axis.errors)
      for (auto* terms : {&error.function.terms, &error.function.positive, &error.function.negative})
        for (auto& table : terms->tables) table.finish();
  if (auto refused = made.order(design); !refused.empty()) return refused;
  for (Joint& joint : made.joints_)
    if (auto refused = made.place(design, joint); !refused.empty()) return refused;
  if (errors.beam) {
    const auto joint = std::find_if(made.joints_.begin(), made.joints_.end(),
                                    [&](const Joint& j) { return j.axis == errors.beam->axis; });
    if (joint == made.joints_.end() || joint->rotary) return "the beam's axis must be X, Y or Z";
    const Vec3 beam = errors.beam->slave_foot - errors.beam->master_foot;
    made.beam_axis_ = beam.cross(joint->direction);
    made.beam_span_ = made.beam_axis_.norm();
    if (!(made.beam_span_ >= 1)) return "the feet of the beam must be 1 mm or more apart, across its axis";
    made.beam_axis_ /= made.beam_span_;
  }
  return made;
}

// Adopts the structure when it is one of this chain.
std::string ErrorModel::order(const geometry::ChainParameters& design) {
  auto& structure = errors_.structure;
  const auto expected = default_structure(design);
  if (structure.empty()) structure = expected;
  for (const auto& axis : expected) {
    const auto count = std::count_if(structure.begin(), structure.end(),
                                     [&](const auto& other) { return other.axis == axis.axis; });
    if (count != 1)
      return std::string("axis ") + axis_letters[axis.axis] + " must be there once, it is there " +
             std::to_string(count) + " times";
  }
  if (structure.size() != expected.size()) return "there is an axis that the machine does not have";
  if (!std::is_partitioned(structure.begin(), structure.end(), [](const auto& a) { return a.workpiece; }))
    return "an axis that carries the workpiece is on the tool's side of the bed";
  const auto rotary = [](const std::vector<StructureAxis>& all) {
    std::string text;
    for (const auto& axis : all)
      if (axis.axis > 2) text.append(1, axis_letters[axis.axis]).append(axis.workpiece ? "' " : " ");
    if (!text.empty()) text.pop_back();
    return text;
  };
  if (rotary(structure) != rotary(expected))
    return "the rotary axes from the workpiece to the tool are " + rotary(expected) + ", not " +
           rotary(structure);
  for (std::size_t i = 0; i < structure.size(); ++i) {
    if (structure[i].axis > 2) continue;
    int carriers = 0;
    for (std::size_t k = 0; k < structure.size(); ++k)
      if (structure[k].axis > 2 && structure[k].workpiece == structure[i].workpiece)
        carriers += structure[i].workpiece ? -(k > i) : k < i;
    if (const int wanted = design.linear_carriers[structure[i].axis]; carriers != wanted)
      return std::string("rotary axes that carry ")
          .append(1, axis_letters[structure[i].axis])
          .append(": ")
          .append(std::to_string(std::abs(carriers)))
          .append(" here, ")
          .append(std::to_string(std::abs(wanted)))
          .append(" in parameters 04c905 .. 04c907");
  }
  for (const auto& axis : structure)
    joints_.push_back({.axis = axis.axis, .workpiece = axis.workpiece, .rotary = axis.axis > 2});
  // As Chain::make.
  face_ = design.origin;
  if (design.open) {
    face_ += design.base_correction;
    for (const auto* axis : table_of(design))
      if (*axis) face_ += (*axis)->correction;
    for (const auto* axis : head_of(design))
      if (*axis) face_ -= (*axis)->correction;
  }
  return "";
}

// Where the axis is, with its location errors. docs/truth.md derives the points from the parameters.
std::string ErrorModel::place(const geometry::ChainParameters& design, Joint& joint) const {
  const AxisErrors& axis = errors_.axes[joint.axis];
  if (!joint.rotary) {
    joint.direction = design.linear_direction.col(static_cast<Eigen::Index>(joint.axis)).stableNormalized();
    joint.direction = rotation(axis.inclination) * joint.direction;
    joint.reference = axis.reference_point.value_or(Vec3::Zero());
    return "";
  }
  joint.pivot = joint.workpiece ? Vec3(Vec3::Zero()) : face_;
  for (const auto* side : joint.workpiece ? table_of(design) : head_of(design)) {
    joint.pivot += (*side)->offset + (*side)->correction;
    if (3 + (*side)->angle != joint.axis) continue;
    // The tool as the workpiece sees it turns against a table.
    joint.direction = (joint.workpiece ? -1.0 : 1.0) * (*side)->direction.stableNormalized();
    break;
  }
  if (axis.reference_point)
    joint.pivot += joint.direction.dot(*axis.reference_point - joint.pivot) * joint.direction;
  const double along = axis.inclination.dot(joint.direction);
  joint.zero = along / radians_per_degree;
  joint.pivot += axis.displacement;
  joint.reference = joint.pivot;
  joint.direction = rotation(axis.inclination - along * joint.direction) * joint.direction;
  return "";
}

void ErrorModel::apply_errors(const Joint& joint, const MachinePose& machine, Points& p) const {
  const AxisErrors& axis = errors_.axes[joint.axis];
  const HeatSource& heat = errors_.heat[joint.axis];
  const double warm = machine.temperatures[joint.axis];
  Vec3 translation = warm * heat.shift, angles = warm * heat.tilt;
  if (!joint.rotary && heat.expansion != 0)
    translation +=
        warm * heat.expansion * (machine.positions[joint.axis] - heat.fixed_point) * joint.direction;
  for (const ComponentError& error : axis.errors) {
    const double value =
        error.function.value(machine.positions[error.source], machine.approach[error.source]);
    (error.component < 3 ? translation : angles)[static_cast<Eigen::Index>(error.component % 3)] += value;
  }
  apply(translation, angles, joint.reference, p.tip, p.axis);
}

void ErrorModel::apply_beam(const MachinePose& machine, Points& p) const {
  const BeamErrors& beam = *errors_.beam;
  const double lead = machine.slave_lead + beam.misalignment +
                      beam.slave_error.value(machine.positions[beam.axis], machine.approach[beam.axis]);
  const double hypotenuse = std::sqrt(lead * lead + beam_span_ * beam_span_);
  const geometry::SineCosine t{lead / hypotenuse, beam_span_ / hypotenuse};
  p.tip = beam.master_foot + turned(beam_axis_, t, p.tip - beam.master_foot);
  p.axis = turned(beam_axis_, t, p.axis);
}

void ErrorModel::apply_motion(const Joint& joint, double position, Points& p) const {
  if (!joint.rotary) {
    p.tip += position * joint.direction;
    return;
  }
  const auto t = geometry::sine_cosine(position + joint.zero);
  p.tip = joint.pivot + turned(joint.direction, t, p.tip - joint.pivot);
  p.axis = turned(joint.direction, t, p.axis);
}

// Of the tool in the frame of its spindle carriage, with every axis at zero.
ErrorModel::Points ErrorModel::tool(const MachinePose& machine) const {
  const AxisErrors& spindle = errors_.spindle;
  const HeatSource& heat = errors_.heat[spindle_source];
  const double warm = machine.temperatures[spindle_source];
  Points p{face_ - machine.tool_length * chain_.tool_direction(), chain_.tool_direction()};
  apply(spindle.displacement + warm * heat.shift, spindle.inclination + warm * heat.tilt, face_, p.tip,
        p.axis);
  return p;
}

void ErrorModel::apply_joint(const Joint& joint, const MachinePose& machine, Points& p) const {
  // The errors of a carriage are those of its own frame, the errors of a rotary axis those of the frame on
  // the side of the bed.
  const bool errors_first = joint.rotary == joint.workpiece;
  const bool beam = errors_.beam && errors_.beam->axis == joint.axis;
  if (errors_first) apply_errors(joint, machine, p);
  if (beam && !joint.workpiece) apply_beam(machine, p);
  apply_motion(joint, machine.positions[joint.axis], p);
  if (beam && joint.workpiece) apply_beam(machine, p);
  if (!errors_first) apply_errors(joint, machine, p);
}

ToolPose ErrorModel::pose(const MachinePose& machine) const {
  if (ideal_) return ideal_pose(machine);
  Points p = tool(machine);
  for (std::size_t i = joints_.size(); i-- > 0;) apply_joint(joints_[i], machine, p);
  return {p.tip, p.axis};
}

PoseDerivatives ErrorModel::derivatives(const MachinePose& machine) const {
  PoseDerivatives d;
  d.tip.fill(Vec3::Zero());
  d.axis.fill(Vec3::Zero());
  Points p = tool(machine);
  for (std::size_t i = joints_.size(); i-- > 0;) {
    const Joint& joint = joints_[i];
    apply_joint(joint, machine, p);
    if (!joint.rotary) {
      d.tip[joint.axis] = joint.direction;
      continue;
    }
    const auto t = geometry::sine_cosine(machine.positions[joint.axis] + joint.zero);
    for (std::size_t k = i + 1; k < joints_.size(); ++k) {
      Vec3 &tip = d.tip[joints_[k].axis], &axis = d.axis[joints_[k].axis];
      tip = turned(joint.direction, t, tip);
      axis = turned(joint.direction, t, axis);
    }
    d.tip[joint.axis] = joint.direction.cross(p.tip - joint.pivot);
    d.axis[joint.axis] = joint.direction.cross(p.axis);
  }
  d.pose = {p.tip, p.axis};
  return d;
}

ToolPose ErrorModel::ideal_pose(const MachinePose& machine) const {
  const auto angles = geometry::angles_of(machine.positions.data());
  return {chain_.tip_from_machine({machine.positions[0], machine.positions[1], machine.positions[2]}, angles,
                                  machine.tool_length),
          chain_.tool_direction_in_workpiece(angles)};
}

std::string ErrorModel::notation() const {
  std::string text = "[w";
  bool bed = false;
  for (const auto& axis : errors_.structure) {
    if (!axis.workpiece && !bed) text += " b", bed = true;
    text.append(" ").append(1, axis_letters[axis.axis]).append(axis.workpiece ? "'" : "");
  }
  return text + (bed ? "" : " b") + " (S) t]";
}

}  // namespace trunnion::volumetric
