// SPDX-License-Identifier: Apache-2.0
#include "truth/true_geometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "geometry/test/machines.hpp"

namespace trunnion::truth {
namespace {

using geometry::ChainParameters;
constexpr double um = 1e-3, urad = 1e-6;

TrueGeometry make(const ChainParameters& design, const GeometryTruth& truth) {
  auto made = TrueGeometry::make(design, truth);
  if (const auto* refused = std::get_if<std::string>(&made)) throw std::runtime_error(*refused);
  return std::get<TrueGeometry>(std::move(made));
}

ErrorFunction constant(double value) {
  ErrorFunction f;
  f.terms.polynomials.push_back({0, 1, {value}});
  return f;
}

// y, x, z = 400, 0, 0 ...: one axis away from zero.
MachinePose at(std::size_t axis, double position, double tool_length = 0) {
  MachinePose pose;
  pose.positions[axis] = position;
  pose.tool_length = tool_length;
  return pose;
}

Vec3 deviation(const TrueGeometry& g, const MachinePose& pose) {
  return g.pose(pose).tip - g.ideal_pose(pose).tip;
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  MachinePose pose() {
    MachinePose pose;
    for (std::size_t i = 0; i < 3; ++i) pose.positions[i] = (*this)(-500, 500);
    for (std::size_t i = 3; i < 9; ++i) pose.positions[i] = (*this)(-180, 180);
    for (auto& approach : pose.approach) approach = static_cast<int>((*this)(0, 3)) - 1;
    pose.tool_length = (*this)(0, 300);
    pose.slave_lead = (*this)(-0.1, 0.1);
    for (auto& rise : pose.temperatures) rise = (*this)(0, 10);
    return pose;
  }
};

// Errors a hundred times those of a bad machine, so that terms of second order are seen.
GeometryTruth large_errors(Random& random) {
  GeometryTruth truth;
  const auto terms = [&](double size, ErrorTerms& out) {
    out.polynomials.push_back({random(-100, 100), 400, {random(-size, size), random(-size, size)}});
    out.harmonics.push_back({random(5, 500), random(-size, size), random(0, 360)});
  };
  for (std::size_t i = 0; i < axis_count; ++i) {
    AxisTruth& axis = truth.axes[i];
    for (std::size_t c = 0; c < component_count; ++c) {
      const double size = c < 3 ? 1 : 1e-2;
      ComponentError error{c, i, {}};
      terms(size, error.function.terms);
      terms(size, error.function.negative);
      error.function.reversal = random(-size, size);
      axis.errors.push_back(error);
    }
    axis.errors.push_back({1, (i + 1) % 3, constant(random(-1, 1))});
    axis.inclination = random.vector(1e-2);
    if (i > 2) axis.displacement = random.vector(1);
    if (i < 3) axis.reference_point = random.vector(300);
    truth.heat[i].shift = random.vector(0.01);
    truth.heat[i].tilt = random.vector(1e-4);
    if (i < 3) truth.heat[i].expansion = 12e-6, truth.heat[i].fixed_point = random(-500, 500);
  }
  truth.spindle.displacement = random.vector(1);
  truth.spindle.inclination = random.vector(1e-2);
  truth.heat[spindle_source].shift = random.vector(0.01);
  return truth;
}

// --- The second implementation: 4 by 4 matrices of every carriage in the frame of what carries it, from the
// definitions: the machine's base to the tool, the machine's base to the workpiece.

using Matrix = Eigen::Matrix4d;

Matrix shift(const Vec3& v) {
  Matrix m = Matrix::Identity();
  m.topRightCorner<3, 1>() = v;
  return m;
}

Matrix turn(const Vec3& angles) {
  Matrix m = Matrix::Identity();
  m.topLeftCorner<3, 3>() =
      (Eigen::AngleAxisd(angles[2], Vec3::UnitZ()) * Eigen::AngleAxisd(angles[1], Vec3::UnitY()) *
       Eigen::AngleAxisd(angles[0], Vec3::UnitX()))
          .toRotationMatrix();
  return m;
}

Matrix turn_about(const Vec3& direction, double degrees) {
  Matrix m = Matrix::Identity();
  m.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, direction.normalized()).toRotationMatrix();
  return m;
}

double naive_value(const ErrorFunction& f, double x, int approach) {
  const auto sum = [&](const ErrorTerms& terms) {
    double value = 0;
    for (const auto& p : terms.polynomials)
      for (std::size_t k = 0; k < p.coefficients.size(); ++k)
        value += p.coefficients[k] * std::pow((x - p.origin) / p.unit, static_cast<double>(k));
    for (const auto& h : terms.harmonics)
      value += h.amplitude * std::sin(2 * std::numbers::pi * (x / h.period + h.phase / 360));
    return value;
  };
  double value = sum(f.terms) + f.reversal * approach / 2;
  if (approach > 0) value += sum(f.positive);
  if (approach < 0) value += sum(f.negative);
  if (approach == 0) value += (sum(f.positive) + sum(f.negative)) / 2;
  return value;
}

// The error of an axis as the motion of the tool that the workpiece sees, about `reference`.
Matrix naive_error(const GeometryTruth& truth, std::size_t axis, const MachinePose& pose,
                   const Vec3& reference, const Vec3& direction) {
  Vec3 e = Vec3::Zero(), r = Vec3::Zero();
  for (const auto& error : truth.axes[axis].errors)
    (error.component < 3 ? e : r)[static_cast<int>(error.component % 3)] +=
        naive_value(error.function, pose.positions[error.source], pose.approach[error.source]);
  const auto& heat = truth.heat[axis];
  e += pose.temperatures[axis] * heat.shift;
  r += pose.temperatures[axis] * heat.tilt;
  if (axis < 3) {
    const double growth =
        heat.expansion * pose.temperatures[axis] * (pose.positions[axis] - heat.fixed_point);
    e += growth * direction;
  }
  return shift(e) * shift(reference) * turn(r) * shift(-reference);
}

ToolPose naive_pose(const ChainParameters& p, const GeometryTruth& truth, const MachinePose& pose) {
  struct Rotary {
    Vec3 point, direction;
  };
  std::map<std::size_t, Rotary> rotary;
  Vec3 table_point = Vec3::Zero(), head_point = p.origin;
  for (const auto* axis : {&p.table_2, &p.table_1, &p.table_0})
    if (*axis) rotary[3 + (*axis)->angle] = {table_point += (*axis)->offset, (*axis)->direction.normalized()};
  for (const auto* axis : {&p.head_2, &p.head_1, &p.head_0})
    if (*axis) rotary[3 + (*axis)->angle] = {head_point += (*axis)->offset, (*axis)->direction.normalized()};
  // The carriage of an axis in the frame of what carries it.
  const auto carriage = [&](const StructureAxis& s) -> Matrix {
    const auto& axis = truth.axes[s.axis];
    const double q = pose.positions[s.axis];
    if (s.axis < 3) {
      const Vec3 nominal = p.linear_direction.col(static_cast<int>(s.axis)).normalized();
      const Vec3 direction = (turn(axis.inclination) * nominal.homogeneous()).head<3>();
      const Matrix error =
          naive_error(truth, s.axis, pose, axis.reference_point.value_or(Vec3::Zero()), direction);
      return s.workpiece ? Matrix(shift(-q * direction) * error.inverse())
                         : Matrix(shift(q * direction) * error);
    }
    const Rotary& nominal = rotary.at(s.axis);
    // How the part turns; the tool as the workpiece sees it turns the other way when it is a table.
    const double sign = s.workpiece ? -1 : 1;
    const Vec3 seen = sign * nominal.direction;
    const double along = axis.inclination.dot(seen);
    const Vec3 direction = turn(axis.inclination - along * seen).topLeftCorner<3, 3>() * nominal.direction;
    const Vec3 point = nominal.point + axis.displacement;
    const Matrix motion =
        shift(point) * turn_about(direction, q + along * 180 / std::numbers::pi) * shift(-point);
    const Matrix error = naive_error(truth, s.axis, pose, point, Vec3::Zero());
    return s.workpiece ? Matrix(error.inverse() * motion) : Matrix(error * motion);
  };
  Matrix tool = Matrix::Identity(), workpiece = Matrix::Identity();
  for (const auto& s : truth.structure)
    if (!s.workpiece) tool = tool * carriage(s);
  for (auto s = truth.structure.rbegin(); s != truth.structure.rend(); ++s)
    if (s->workpiece) workpiece = workpiece * carriage(*s);
  const Vec3 t0 = p.tool_direction.normalized();
  const auto& spindle = truth.spindle;
  const auto& heat = truth.heat[spindle_source];
  tool = tool * shift(spindle.displacement + pose.temperatures[spindle_source] * heat.shift) *
         shift(p.origin) * turn(spindle.inclination) * shift(-p.origin);
  const Matrix relative = workpiece.inverse() * tool;
  const Vec3 tip = p.origin - pose.tool_length * t0;
  return {(relative * tip.homogeneous()).head<3>(), relative.topLeftCorner<3, 3>() * t0};
}

class EveryMachine : public ::testing::TestWithParam<geometry::Machine> {};
INSTANTIATE_TEST_SUITE_P(, EveryMachine, ::testing::ValuesIn(geometry::machines()),
                         [](const auto& test) { return "machine_" + std::to_string(test.index); });

TEST_P(EveryMachine, AnIdealTruthGivesTheBitsOfTheChain) {
  const auto g = make(GetParam().parameters, {});
  const auto chain = geometry::make(GetParam().parameters);
  Random random{std::mt19937_64(1)};
  for (int i = 0; i < 200; ++i) {
    const auto pose = random.pose();
    const auto angles = geometry::angles_of(pose.positions.data());
    const auto found = g.pose(pose);
    EXPECT_EQ(found.tip, chain.tip_from_machine(Vec3(pose.positions[0], pose.positions[1], pose.positions[2]),
                                                angles, pose.tool_length));
    EXPECT_EQ(found.axis, chain.tool_direction_in_workpiece(angles));
  }
}

TEST_P(EveryMachine, TheCompositionWithErrorsOfZeroIsTheChain) {
  GeometryTruth truth;
  truth.axes[0].errors.push_back({0, 0, constant(0)});
  const auto g = make(GetParam().parameters, truth);
  Random random{std::mt19937_64(2)};
  for (int i = 0; i < 500; ++i) {
    const auto pose = random.pose();
    // Thirty roundings of values up to 3000 mm, each within 2.3e-13 mm.
    EXPECT_LE(deviation(g, pose).norm(), 1e-11);
    EXPECT_LE((g.pose(pose).axis - g.ideal_pose(pose).axis).norm(), 1e-14);
  }
}

TEST_P(EveryMachine, TheCompositionIsThatOfHomogeneousMatrices) {
  Random random{std::mt19937_64(3)};
  for (int machine = 0; machine < 16; ++machine) {
    auto truth = large_errors(random);
    truth.structure = make(GetParam().parameters, {}).errors().structure;
    if (machine % 2 == 1) {
      // Linear axes that no rotary axis carries, dealt out to both sides of the bed in any order.
      std::vector<StructureAxis> table, head, free;
      for (const auto& axis : truth.structure) {
        const bool between = axis.axis < 3 && GetParam().parameters.linear_carriers[axis.axis] == 0;
        (between ? free : axis.workpiece ? table : head).push_back(axis);
      }
      std::shuffle(free.begin(), free.end(), random.engine);
      for (const auto& axis : free)
        if (random(0, 1) < 0.5)
          table.push_back({axis.axis, true});
        else
          head.insert(head.begin(), {axis.axis, false});
      table.insert(table.end(), head.begin(), head.end());
      truth.structure = table;
    }
    const auto g = make(GetParam().parameters, truth);
    for (int i = 0; i < 25; ++i) {
      auto pose = random.pose();
      pose.slave_lead = 0;
      const auto found = g.pose(pose), naive = naive_pose(GetParam().parameters, truth, pose);
      ASSERT_LE((found.tip - naive.tip).norm(), 1e-9) << g.notation();
      ASSERT_LE((found.axis - naive.axis).norm(), 1e-12) << g.notation();
    }
  }
}

// --- Every error alone, in closed form.

TEST(ComponentErrors, OfALinearAxisMoveAndTurnTheTool) {
  constexpr double length = 200;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < component_count; ++c)
      for (const bool workpiece : {false, true}) {
        GeometryTruth truth;
        truth.axes[axis].errors.push_back({c, axis, constant(c < 3 ? 5 * um : 50 * urad)});
        truth.structure = {{0, workpiece}, {1, workpiece}, {2, workpiece}};
        const auto g = make(ChainParameters{}, truth);
        const auto pose = at(axis, 120, length);
        const auto change = deviation(g, pose);
        const Vec3 u = Vec3::Unit(static_cast<int>(c % 3));
        // Tool side: the tip is 200 mm below the reference point on the carriage. Workpiece side: the
        // reference point is on the table, and the tip is at the position of the axis and 200 mm below.
        Vec3 arm(0, 0, -length);
        if (workpiece) arm += 120 * Vec3::Unit(static_cast<int>(axis));
        const Vec3 expected = c < 3 ? Vec3(5 * um * u) : Vec3(50 * urad * u.cross(arm));
        // Second order: (50 urad)^2 / 2 * 250 mm = 3e-7 mm.
        EXPECT_LE((change - expected).norm(), 4e-7) << axis << c << workpiece;
        const Vec3 tilt = g.pose(pose).axis - Vec3::UnitZ();
        EXPECT_LE((tilt - (c < 3 ? Vec3(Vec3::Zero()) : Vec3(50 * urad * u.cross(Vec3::UnitZ())))).norm(),
                  2e-9);
      }
}

TEST(LocationErrors, SquarenessOfTenMicroradiansOver400mmIsFourMicrometres) {
  const auto with = [](std::size_t axis, int about) {
    GeometryTruth truth;
    truth.axes[axis].inclination[about] = 10 * urad;
    return deviation(make(ChainParameters{}, truth), at(axis, 400));
  };
  // C0Y, A0Z: the angles X-Y and Y-Z exceed 90 degrees; B0Z: the angle Z-X is less than 90 degrees.
  EXPECT_LE((with(1, 2) - Vec3(-4 * um, 0, 0)).norm(), 1e-7);
  EXPECT_LE((with(2, 0) - Vec3(0, -4 * um, 0)).norm(), 1e-7);
  EXPECT_LE((with(2, 1) - Vec3(4 * um, 0, 0)).norm(), 1e-7);
}

TEST(LocationErrors, OfATableAreThoseOfAChainWithThatAxis) {
  Random random{std::mt19937_64(4)};
  for (const auto* name : {"table_2", "table_1", "head_2", "head_1"}) {
    ChainParameters p = geometry::six_rotary_axes();
    auto& axis = name == std::string("table_2")   ? *p.table_2
                 : name == std::string("table_1") ? *p.table_1
                 : name == std::string("head_2")  ? *p.head_2
                                                  : *p.head_1;
    GeometryTruth truth;
    AxisTruth& error = truth.axes[3 + axis.angle];
    const Vec3 direction = axis.direction.normalized();
    error.displacement = random.vector(0.5);
    error.inclination = random.vector(1e-3);
    error.inclination -= error.inclination.dot(direction) * direction;
    const auto g = make(p, truth);
    axis.offset += error.displacement;
    axis.direction = turn(error.inclination).topLeftCorner<3, 3>() * direction;
    // The next axis towards the base stays where it is.
    auto& next = name == std::string("table_2")   ? *p.table_1
                 : name == std::string("table_1") ? *p.table_0
                 : name == std::string("head_2")  ? *p.head_1
                                                  : *p.head_0;
    next.offset -= error.displacement;
    const auto chain = geometry::make(p);
    for (int i = 0; i < 100; ++i) {
      const auto pose = random.pose();
      const Vec3 machine(pose.positions[0], pose.positions[1], pose.positions[2]);
      EXPECT_LE(
          (g.pose(pose).tip -
           chain.tip_from_machine(machine, geometry::angles_of(pose.positions.data()), pose.tool_length))
              .norm(),
          1e-10)
          << name;
    }
  }
}

TEST(LocationErrors, TheZeroPositionErrorOfTableAndHeadTurnsTheToolTooFar) {
  for (const auto& p : {geometry::b_head_c_table()}) {
    for (const std::size_t axis : {4u, 5u}) {
      GeometryTruth truth;
      truth.axes[axis].inclination[static_cast<int>(axis - 3)] = 100 * urad;
      const auto g = make(p, truth);
      Random random{std::mt19937_64(5)};
      auto pose = random.pose();
      const auto found = g.pose(pose);
      pose.positions[axis] += 100 * urad * 180 / std::numbers::pi;
      EXPECT_LE((found.tip - g.ideal_pose(pose).tip).norm(), 1e-10);
    }
  }
}

TEST(ComponentErrors, TheRadialErrorOfATableKeepsItsDirectionInTheMachineWhileTheTableTurns) {
  auto p = geometry::b_head_c_table();
  GeometryTruth truth;
  truth.axes[5].errors.push_back({0, 5, constant(7 * um)});  // EXC
  const auto g = make(p, truth);
  // With C at 90 degrees the tool has turned by +90 degrees as the workpiece sees it: what is +X in the
  // machine is +Y of the workpiece.
  EXPECT_LE((deviation(g, at(5, 90)) - Vec3(0, 7 * um, 0)).norm(), 1e-12);
  EXPECT_LE((deviation(g, at(5, 0)) - Vec3(7 * um, 0, 0)).norm(), 1e-12);
}

TEST(ComponentErrors, AWeightThatMovesBendsAnotherAxis) {
  GeometryTruth truth;
  ErrorFunction droop;
  droop.terms.polynomials.push_back({0, 500, {0, 0, -12 * um}});  // of Z, by the square of Y
  truth.axes[2].errors.push_back({2, 1, droop});
  EXPECT_NEAR(deviation(make(ChainParameters{}, truth), at(1, 250)).z(), -3 * um, 1e-12);
}

TEST(Thermal, ExpansionIsInProportionToTheDistanceFromTheFixedPoint) {
  GeometryTruth truth;
  truth.heat[0].expansion = 11.5e-6;
  truth.heat[0].fixed_point = -400;
  auto pose = at(0, 200);
  pose.temperatures[0] = 4;
  // 11.5 um/(m K) * 0.6 m * 4 K = 27.6 um
  EXPECT_LE((deviation(make(ChainParameters{}, truth), pose) - Vec3(27.6 * um, 0, 0)).norm(), 1e-12);
}

TEST(Thermal, TheSpindleGrowsAlongItsAxisAndASwivelledHeadTurnsTheGrowth) {
  auto p = geometry::b_head_c_table();
  GeometryTruth truth;
  truth.heat[spindle_source].shift = {0, 0, -2 * um};  // towards the tip
  auto pose = at(4, 90, 100);
  pose.temperatures[spindle_source] = 10;
  const auto g = make(p, truth);
  // B90 turns the tool axis from +Z to +X: the tip moves against it.
  EXPECT_LE((deviation(g, pose) - Vec3(-20 * um, 0, 0)).norm(), 1e-12);
}

TEST(Beam, TurnsAboutTheFootOfTheMasterByTheLeadOfTheSlave) {
  GeometryTruth truth;
  truth.beam = BeamTruth{1, {-1000, 0, 0}, {1000, 0, 0}, 0.3, {}};
  truth.structure = {{1, false}, {0, false}, {2, false}};  // the beam carries X
  const auto g = make(ChainParameters{}, truth);
  auto pose = at(0, 500);
  pose.slave_lead = 0.1;
  // The slave is 0.4 mm ahead over 2000 mm: the tool, 1500 mm from the master's foot, is 0.3 mm too far in Y;
  // second order: 1500 mm * (0.0002)^2 / 2 = 3e-5 mm in X.
  EXPECT_LE((deviation(g, pose) - Vec3(-3e-5, 0.3, 0)).norm(), 1e-6);
}

TEST(Structure, IsWrittenInTheNotationOfIso10791) {
  GeometryTruth truth;
  EXPECT_EQ(make(geometry::ac_table(), truth).notation(), "[w C' A' b X Y Z (S) t]");
  EXPECT_EQ(make(geometry::cb_head(), truth).notation(), "[w b X Y Z C B (S) t]");
  EXPECT_EQ(make(geometry::linear_axes_on_a_turning_column(), truth).notation(), "[w b Z C X Y B (S) t]");
  truth.structure = {{5, true}, {3, true}, {1, true}, {0, false}, {2, false}};
  EXPECT_EQ(make(geometry::ac_table(), truth).notation(), "[w C' A' Y' b X Z (S) t]");
}

TEST(Structure, ThatIsNotTheMachinesIsRefusedWithTheReason) {
  const auto refused = [](std::vector<StructureAxis> structure, const ChainParameters& p) {
    GeometryTruth truth;
    truth.structure = std::move(structure);
    return std::get<std::string>(TrueGeometry::make(p, truth));
  };
  const auto p = geometry::ac_table();
  EXPECT_EQ(refused({{5, true}, {3, true}, {0, false}, {1, false}}, p),
            "axis Z must be there once, it is there 0 times");
  EXPECT_EQ(refused({{3, true}, {5, true}, {0, false}, {1, false}, {2, false}}, p),
            "the rotary axes from the workpiece to the tool are C' A', not A' C'");
  EXPECT_EQ(refused({{5, true}, {0, true}, {3, true}, {1, false}, {2, false}}, p),
            "rotary axes that carry X: 1 here, 0 in parameters 04c905 .. 04c907");
}

}  // namespace
}  // namespace trunnion::truth
