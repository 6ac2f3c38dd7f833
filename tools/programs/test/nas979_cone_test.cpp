// SPDX-License-Identifier: Apache-2.0
// The committed cone program, read by the real interpreter for the machine it is meant for.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include "geometry/chain.hpp"
#include "language/interpreter.hpp"

namespace trunnion::language {
namespace {

using geometry::Chain;
using geometry::Vec3;

constexpr double tool_radius = 10, overhang = 2, base_radius = 40, slope = 15, tilt = 10, base_height = 40;
constexpr double radians = std::numbers::pi / 180;

// The trunnion table of configs/machines/ac-table: both rotary axes through machine (0, 0, -400), the table
// 20 mm above that.
class ConeMachine : public Environment {
 public:
  ConeMachine() {
    geometry::ChainParameters p;
    p.table_1 = geometry::RotaryAxis{-Vec3::UnitX(), Vec3::Zero(), 0};
    p.table_2 = geometry::RotaryAxis{-Vec3::UnitZ(), {0, 0, -400}, 2};
    chain_ = std::get<Chain>(Chain::make(p));
  }
  AxisValues work_offset(std::uint8_t) const override { return {0, 0, -380}; }
  std::optional<double> tool_length(std::uint16_t h) const override {
    return h == 1 ? std::optional(100.0) : std::nullopt;
  }
  AxisValues reference_position() const override { return {}; }
  AxisValues tip_from_machine(const AxisValues& m, double length) const override {
    const Vec3 tip = chain_->tip_from_machine({m[X], m[Y], m[Z]}, {m[A], m[B], m[C]}, length);
    return {tip.x(), tip.y(), tip.z(), m[A], m[B], m[C]};
  }
  AxisValues machine_from_tip(const AxisValues& t, double length) const override {
    const Vec3 at = chain_->machine_from_tip({t[X], t[Y], t[Z]}, {t[A], t[B], t[C]}, length);
    return {at.x(), at.y(), at.z(), t[A], t[B], t[C]};
  }
  std::uint16_t axes() const override { return 0b101111; }
  double radius_deviation() const override { return 0.1; }
  TextSource* subprogram(std::string_view) override { return nullptr; }
  const Chain& chain() const { return *chain_; }

 private:
  std::optional<Chain> chain_;
};

std::vector<Command> interpret(ConeMachine& machine) {
  std::ifstream file(PROGRAMS_DIRECTORY "/nas979_cone.nc", std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  const std::string program = text.str();
  StringSource source(program);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  std::vector<Command> commands;
  Command command;
  for (;;) switch (interpreter.next(command)) {
      case Step::command:
        commands.push_back(command);
        if (command.kind == CommandKind::end) return commands;
        break;
      case Step::alarm:
        ADD_FAILURE() << "line " << interpreter.alarm().line << ": " << interpreter.alarm().text.data();
        return commands;
      case Step::end:
        return commands;
      default:
        break;
    }
}

TEST(Nas979Cone, RunsToM30WithoutAnAlarm) {
  ConeMachine machine;
  const auto commands = interpret(machine);
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.back().kind, CommandKind::end);
  EXPECT_EQ(commands.back().number, 30u);
  // One revolution, 2 degrees of overlap and twice 30 degrees in steps of half a degree.
  EXPECT_GE(std::count_if(commands.begin(), commands.end(),
                          [](const Command& c) { return c.kind == CommandKind::line; }),
            844);
}

TEST(Nas979Cone, StaysInsideTheTravels) {
  ConeMachine machine;
  for (const auto& command : interpret(machine)) {
    if (command.kind != CommandKind::rapid && command.kind != CommandKind::line) continue;
    const auto m = command.modal.transformation == Transformation::rtcp
                       ? machine.machine_from_tip(command.target, command.modal.tool_length)
                       : command.target;
    EXPECT_LE(std::abs(m[X]), 400) << command.line;
    EXPECT_LE(std::abs(m[Y]), 300) << command.line;
    EXPECT_LE(m[Z], 100) << command.line;
    EXPECT_GE(m[Z], -500) << command.line;
    // slope - tilt .. slope + tilt once the table has swung in.
    EXPECT_GE(m[A], 0) << command.line;
    EXPECT_LE(m[A], slope + tilt + 1e-5) << command.line;
  }
}

// In the tilted frame of the frustum with its origin in the middle of the base, a line parallel to a
// generatrix and one tool radius outside of it satisfies (rho - (r - h tan slope)) cos slope = tool radius at
// every height h.
TEST(Nas979Cone, TheFlankTouchesTheSideOverAFullTurn) {
  ConeMachine machine;
  const Vec3 axis(0, -std::sin(tilt * radians), std::cos(tilt * radians));
  const Vec3 origin(0, 0, base_height - 380);
  double turned = 0, last = 0, largest_c = 0, previous_c = 0;
  int touching = 0;
  for (const auto& command : interpret(machine)) {
    if (command.kind != CommandKind::line || command.modal.transformation != Transformation::rtcp) continue;
    const auto& t = command.target;
    const Vec3 tip(t[X], t[Y], t[Z]);
    const Vec3 tool = machine.chain().tool_direction_in_workpiece({t[A], t[B], t[C]});
    // The tool is as steep as the side everywhere.
    EXPECT_NEAR(tool.dot(axis), std::cos(slope * radians), 1e-6) << command.line;
    double gap[2];
    for (int end = 0; end < 2; ++end) {
      const Vec3 q = tip + (overhang + end * 20.0) * tool - origin;
      const double h = q.dot(axis), rho = std::sqrt(q.squaredNorm() - h * h);
      gap[end] =
          (rho - (base_radius - h * std::tan(slope * radians))) * std::cos(slope * radians) - tool_radius;
    }
    // Five decimals of mm and deg: 20 mm * 5e-6 deg is far below a hundredth of a micrometre, the words
    // dominate.
    EXPECT_GT(std::min(gap[0], gap[1]), -2e-5) << command.line;
    if (std::max(gap[0], gap[1]) > 2e-5) continue;
    const Vec3 q = tip - origin;
    const double phi = std::atan2(q.dot(axis.cross(Vec3::UnitX())), q.x()) / radians;
    if (touching++ > 0) {
      turned += std::remainder(phi - last, 360.0);
      largest_c = std::max(largest_c, std::abs(t[C] - previous_c));
    }
    last = phi;
    previous_c = t[C];
  }
  // Clockwise, so that the flank mills with the feed.
  EXPECT_NEAR(turned, -362, 1.1);
  // C is fastest where the tool leans least: by sin(slope) / sin(slope - tilt) = 3 times the turn, in 0.5 deg
  // steps.
  EXPECT_LT(largest_c, 0.5 * 3.1);
}

}  // namespace
}  // namespace trunnion::language
