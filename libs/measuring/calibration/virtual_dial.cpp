// SPDX-License-Identifier: Apache-2.0
#include "calibration/virtual_dial.hpp"

#include <Eigen/Geometry>
#include <stdexcept>
#include <utility>

#include "calibration/sphere_check.hpp"
#include "metrology/axis_of_rotation.hpp"

namespace trunnion::calibration {
namespace {

constexpr int most_steps = 50;

Vec3 true_tip(const truth::PoseReport& machine, const Vec3& linear, const Angles& angles, double length) {
  truth::MachinePose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.positions[i] = linear[static_cast<Eigen::Index>(i)];
  for (std::size_t i = 0; i < angles.size(); ++i) pose.positions[3 + i] = angles[i];
  pose.approach.fill(1);
  pose.tool_length = length;
  pose.temperatures = machine.temperatures;
  return machine.true_pose(pose).tip;
}

class Operator {
 public:
  Operator(const truth::PoseReport& machine, const ChainParameters& model, const ManualGauges& gauges)
      : machine_(machine), model_(model), gauges_(gauges), instrument_(gauges.instrument) {}

  // Reading of a display at a contact, and the difference of two.
  double absolute(int axis, const Vec3& place, const Angles& angles, double length) {
    return instrument_.read(at(place, angles, length)[axis]);
  }
  double relative(int axis, const Vec3& first, const Angles& first_angles, double first_length,
                  const Vec3& second, const Angles& second_angles, double second_length) {
    return instrument_.read(at(second, second_angles, second_length)[axis] -
                            at(first, first_angles, first_length)[axis]);
  }
  Vec3 at(const Vec3& place, const Angles& angles, double length) const {
    return position_for(machine_, model_, place, angles, length);
  }

  // A point of the table's axis C in the workpiece frame: the circle of the places under a spindle at rest.
  Vec3 centre_of_c() const {
    const Vec3 rest = axis_point(model_, metrology::Slot::table_2) + Vec3(60, 20, gauges_.tool_length);
    std::vector<metrology::TurnedCentre> turned;
    for (const double c : {0.0, 120.0, 240.0})
      turned.push_back({c, true_tip(machine_, rest, {0, 0, c}, gauges_.tool_length)});
    const auto fit = metrology::fit_axis(turned);
    if (!std::holds_alternative<metrology::AxisFit>(fit))
      throw std::runtime_error("C does not turn the table");
    return std::get<metrology::AxisFit>(fit).centre;
  }

  void bore(Readings& r) {
    const Vec3 centre = centre_of_c();
    const double reach = gauges_.bore_radius - gauges_.finder_radius;
    r["x1"] = absolute(0, centre - reach * Vec3::UnitX(), {}, gauges_.tool_length);
    r["x2"] = absolute(0, centre + reach * Vec3::UnitX(), {}, gauges_.tool_length);
    r["y1"] = absolute(1, centre - reach * Vec3::UnitY(), {}, gauges_.tool_length);
    r["y2"] = absolute(1, centre + reach * Vec3::UnitY(), {}, gauges_.tool_length);
  }

  void ac_table(Readings& r) {
    bore(r);
    const Vec3 c = centre_of_c();
    const double length = gauges_.tool_length, alpha = gauges_.alpha, radius = gauges_.tool_radius;
    const Vec3 rim = gauges_.rim_radius * Vec3::UnitY();
    r["offy_z1"] = relative(2, c + rim, {-alpha, 0, 0}, length, c - rim, {alpha, 0, 0}, length);
    r["alpha"] = alpha;
    const double top = axis_point(model_, metrology::Slot::table_2).z() + gauges_.surface;
    r["zc_z1"] = absolute(2, {c.x(), c.y(), top}, {}, length);
    r["zc_y1"] = relative(1, c, {}, length, {c.x(), c.y(), top + radius}, {-90, 0, 0}, length);
    const Vec3 dial(c.x(), c.y(), top);
    r["zc_z2"] = relative(2, dial, {}, length, dial, {}, 0);
    r["tool_radius"] = radius;
  }

  // The arbor touched from below, first at +90, then at -90 of the swivelling axis.
  double swivel(std::size_t axis, const Vec3& dial) {
    const Vec3 above = dial + gauges_.arbor_diameter / 2 * Vec3::UnitZ();
    Angles plus{}, minus{};
    plus[axis] = 90, minus[axis] = -90;
    return relative(2, above, plus, gauges_.tool_length, above, minus, gauges_.tool_length);
  }
  double head_length(std::size_t axis, const Vec3& dial) {
    Angles plus{};
    plus[axis] = 90;
    return relative(2, dial, {}, 0, dial + gauges_.arbor_diameter / 2 * Vec3::UnitZ(), plus,
                    gauges_.tool_length);
  }
  void turn_c(Readings& r, const Vec3& dial) {
    const double length = gauges_.tool_length;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3 beside = dial + gauges_.arbor_diameter / 2 * Vec3::Unit(axis);
      r[axis == 0 ? "c_x1" : "c_y1"] = relative(axis, beside, {}, length, beside, {0, 0, 180}, length);
    }
  }

 private:
  truth::PoseReport machine_;
  const ChainParameters& model_;
  const ManualGauges& gauges_;
  truth::Instrument instrument_;
};

}  // namespace

Vec3 position_for(const truth::PoseReport& machine, const ChainParameters& model, const Vec3& place,
                  const Angles& angles, double length) {
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(model));
  Vec3 linear = chain.machine_from_tip(place, angles, length);
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 tip = true_tip(machine, linear, angles, length);
    const Vec3 change =
        chain.machine_from_tip(place, angles, length) - chain.machine_from_tip(tip, angles, length);
    linear += change;
    if (change.norm() < 1e-10) return linear;
  }
  throw std::runtime_error("the machine does not reach a position of the instrument");
}

Readings read_virtually(ManualKind kind, const truth::PoseReport& machine, const ChainParameters& model,
                        const ManualGauges& gauges) {
  Operator by_hand(machine, model, gauges);
  Readings r;
  const Vec3 dial(0, 0, -300);
  switch (kind) {
    case ManualKind::ac_table:
      by_hand.ac_table(r);
      return r;
    case ManualKind::bc_head:
      r["b_z1"] = by_hand.swivel(1, dial);
      by_hand.turn_c(r, dial);
      r["length_z1"] = by_hand.head_length(1, dial);
      break;
    case ManualKind::ac_head:
      r["a_z1"] = by_hand.swivel(0, dial);
      by_hand.turn_c(r, dial);
      r["length_z1"] = by_hand.head_length(0, dial);
      break;
    case ManualKind::hybrid:
      r["b_z1"] = by_hand.swivel(1, dial);
      r["length_z1"] = by_hand.head_length(1, dial);
      by_hand.bore(r);
      break;
  }
  r["arbor_diameter"] = gauges.arbor_diameter;
  return r;
}

std::vector<ManualCheck> check_and_correct(ManualKind kind, const truth::PoseReport& machine,
                                           ChainParameters model, const VirtualCheck& check) {
  const auto poses = check_poses(kind, check.alpha);
  truth::Instrument dial(check.dial);
  std::vector<ManualCheck> checks;
  for (int round = 0;; ++round) {
    auto displacements = sphere_displacements(machine, model, check.place, check.ball_length, poses);
    for (auto& d : displacements)
      for (double& value : d) value = dial.read(value);
    auto acceptance = acceptance_of(kind, displacements);
    const auto& made =
        checks.emplace_back(ManualCheck{model, std::move(displacements), std::move(acceptance)});
    if (made.acceptance.accepted() || round == most_corrections) return checks;
    model = corrected(kind, made.displacements, check.alpha, model);
  }
}

}  // namespace trunnion::calibration
