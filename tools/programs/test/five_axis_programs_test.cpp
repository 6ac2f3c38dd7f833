// SPDX-License-Identifier: Apache-2.0
// The committed five-axis programs, read by the real interpreter for the machines they are meant for, whose
// parameters and offsets are those of configs/machines.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "language/interpreter.hpp"
#include "machine/axes.hpp"
#include "machine/machine.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/yaml.hpp"

namespace trunnion::language {
namespace {

using geometry::Vec3;

class FileMachine : public Environment {
 public:
  explicit FileMachine(const std::string& name)
      : directory_(std::string(TRUNNION_MACHINES) + "/" + name), chain_([&] {
          parameters_.values = machine::machine_parameters(machine::load_machine(directory_));
          return machine::make_chain(parameters_, 0);
        }()) {
    const auto axes = machine::channel_axes(parameters_, 0);
    for (std::size_t i = 0; i < axes.index.size(); ++i) {
      mask_ = static_cast<std::uint16_t>(mask_ | (1u << axes.index[i]));
      travel_[axes.index[i]] = {parameters_.get(parameter::negative_limit, axes.number[i]),
                                parameters_.get(parameter::positive_limit, axes.number[i])};
    }
    const auto offsets_file = directory_ + "/work_offsets.yaml";
    for (const auto& offset : machine::parse_yaml(machine::read_text(offsets_file), offsets_file))
      for (std::size_t i = 0; i < axis_count; ++i)
        if (const auto value = offset[std::string(1, axis_letters[i])])
          offset_[i] = value.template as<double>();
    const auto tools_file = directory_ + "/tools.yaml";
    for (const auto& tool : machine::parse_yaml(machine::read_text(tools_file), tools_file))
      tools_[tool["number"].template as<std::uint16_t>()] = tool["length"].template as<double>();
  }
  AxisValues work_offset(std::uint8_t) const override { return offset_; }
  std::optional<double> tool_length(std::uint16_t h) const override {
    const auto found = tools_.find(h);
    return found == tools_.end() ? std::nullopt : std::optional(found->second);
  }
  AxisValues reference_position() const override { return {}; }
  AxisValues tip_from_machine(const AxisValues& m, double length) const override {
    AxisValues result = m;
    const Vec3 tip = chain_.tip_from_machine({m[X], m[Y], m[Z]}, geometry::angles_of(m.data()), length);
    std::copy_n(tip.data(), 3, result.begin());
    return result;
  }
  AxisValues machine_from_tip(const AxisValues& t, double length) const override {
    AxisValues result = t;
    const Vec3 at = chain_.machine_from_tip({t[X], t[Y], t[Z]}, geometry::angles_of(t.data()), length);
    std::copy_n(at.data(), 3, result.begin());
    return result;
  }
  std::uint16_t axes() const override { return mask_; }
  double radius_deviation() const override { return 0.1; }
  TextSource* subprogram(std::string_view) override { return nullptr; }

  Vec3 tip_on_part(const Command& c) const {
    return {c.target[X] - offset_[X], c.target[Y] - offset_[Y], c.target[Z] - offset_[Z]};
  }
  Vec3 tool(const Command& c) const {
    return chain_.tool_direction_in_workpiece(geometry::angles_of(c.target.data()));
  }
  bool inside_travel(const AxisValues& m) const {
    for (std::size_t i = 0; i < axis_count; ++i)
      if ((mask_ & (1u << i)) != 0 && !(m[i] >= travel_[i][0] && m[i] <= travel_[i][1])) return false;
    return true;
  }
  std::vector<Command> run(const std::string& program) {
    const std::string text = machine::read_text(directory_ + "/programs/" + program);
    StringSource source(text);
    Interpreter interpreter(*this);
    interpreter.start(source, {}, {});
    std::vector<Command> commands;
    Command command;
    for (;;) switch (interpreter.next(command)) {
        case Step::command:
          commands.push_back(command);
          if (command.kind == CommandKind::end) return commands;
          break;
        case Step::alarm:
          ADD_FAILURE() << program << " line " << interpreter.alarm().line << ": "
                        << interpreter.alarm().text.data();
          return commands;
        case Step::end:
          return commands;
        default:
          break;
      }
  }

 private:
  std::string directory_;
  machine::Parameters parameters_;
  geometry::Chain chain_;
  std::uint16_t mask_ = 0;
  AxisValues offset_{};
  std::array<std::array<double, 2>, axis_count> travel_{};
  std::map<std::uint16_t, double> tools_;
};

bool moves(const Command& c) {
  return c.kind == CommandKind::rapid || c.kind == CommandKind::line || c.kind == CommandKind::arc;
}

struct Case {
  const char *machine, *program;
};

class FiveAxisProgram : public testing::TestWithParam<Case> {};

TEST_P(FiveAxisProgram, runs_to_m30_inside_the_travels_of_its_machine) {
  FileMachine machine(GetParam().machine);
  const auto commands = machine.run(GetParam().program);
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.back().kind, CommandKind::end);
  EXPECT_EQ(commands.back().number, 30u);
  int cuts = 0;
  for (const auto& c : commands) {
    if (!moves(c)) continue;
    const bool rtcp = c.modal.transformation == Transformation::rtcp;
    EXPECT_TRUE(
        machine.inside_travel(rtcp ? machine.machine_from_tip(c.target, c.modal.tool_length) : c.target))
        << "line " << c.line;
    if (rtcp) ++cuts;
  }
  EXPECT_GE(cuts, 11);
}

INSTANTIATE_TEST_SUITE_P(
    All, FiveAxisProgram,
    testing::Values(Case{"ac-table", "nas979_cone.nc"}, Case{"cb-head", "nas979_cone.nc"},
                    Case{"b-head-c-table", "nas979_cone.nc"}, Case{"ac-table", "s_piece.nc"},
                    Case{"cb-head", "s_piece.nc"}, Case{"b-head-c-table", "s_piece.nc"},
                    Case{"bc-table", "rtcp.nc"}, Case{"cb-head", "rtcp.nc"}, Case{"ac-head", "rtcp.nc"},
                    Case{"b-head-c-table", "rtcp.nc"}, Case{"nutating-b-head-c-table", "rtcp.nc"},
                    Case{"four-axis", "rtcp.nc"}),
    [](const auto& c) {
      std::string name = std::string(c.param.machine) + "_" + c.param.program;
      for (char& letter : name)
        if (letter == '-' || letter == '.') letter = '_';
      return name;
    });

// The tips are the same words, the directions differ by the five decimals of the angles: 5e-6 degrees in each
// of two are below 1.3e-7 rad.
TEST(FiveAxisPrograms, cut_the_same_part_on_every_machine) {
  for (const char* program : {"nas979_cone.nc", "s_piece.nc"}) {
    FileMachine reference("ac-table");
    const auto expected = reference.run(program);
    for (const char* name : {"cb-head", "b-head-c-table"}) {
      FileMachine machine(name);
      const auto commands = machine.run(program);
      ASSERT_EQ(commands.size(), expected.size()) << name;
      for (std::size_t i = 0; i < commands.size(); ++i) {
        if (!moves(commands[i]) || commands[i].modal.transformation != Transformation::rtcp) continue;
        ASSERT_LT((machine.tip_on_part(commands[i]) - reference.tip_on_part(expected[i])).norm(), 1e-9)
            << name << " line " << commands[i].line;
        ASSERT_LT((machine.tool(commands[i]) - reference.tool(expected[i])).norm(), 1.3e-7)
            << name << " line " << commands[i].line;
      }
    }
  }
}

// The side between the sine curves of the generator: half length 115, amplitude 60 at the base (Z30) and 72
// at the top (Z70), the top 6 mm further in X. The tool axis passes every height of the side at one radius:
// the nearest point of the curve at that height, found by ternary search about the point beside the tip.
TEST(SPiece, the_flank_touches_the_ruled_side_at_every_height) {
  FileMachine machine("cb-head");
  const auto side = [](double t, double h) {
    return Vec3(115 * (2 * t - 1) + 6 * h, -(60 + 12 * h) * std::sin(2 * std::numbers::pi * t), 30 + 40 * h);
  };
  int touching = 0;
  for (const auto& c : machine.run("s_piece.nc")) {
    if (c.kind != CommandKind::line || c.modal.transformation != Transformation::rtcp) continue;
    const Vec3 tip = machine.tip_on_part(c), tool = machine.tool(c);
    if (std::abs(tip.z() - 34.5) > 1e-9) continue;
    for (const double h : {0.1, 0.5, 1.0}) {
      const auto distance = [&](double t) {
        const Vec3 q = side(t, h) - tip;
        return (q - q.dot(tool) * tool).norm();
      };
      double nearest = 0;
      for (int k = 0; k <= 1000; ++k)
        if (distance(k * 0.001) < distance(nearest)) nearest = k * 0.001;
      double low = nearest - 0.001, high = nearest + 0.001;
      for (int k = 0; k < 60; ++k) {
        const double third = (high - low) / 3;
        if (distance(low + third) < distance(high - third))
          high -= third;
        else
          low += third;
      }
      if (low < 0.002 || low > 0.998) continue;  // before or behind the strip
      // Half way up exactly, to the five decimals of the words; above and below the twist of the side shows.
      EXPECT_NEAR(distance(low), 10, h == 0.5 ? 5e-5 : 0.013) << c.line << " height " << h;
      ++touching;
    }
  }
  EXPECT_GT(touching, 3 * 180);
}

}  // namespace
}  // namespace trunnion::language
