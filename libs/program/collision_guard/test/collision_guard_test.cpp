// SPDX-License-Identifier: Apache-2.0
#include "collision_guard/collision_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "analysis/file_source.hpp"
#include "analysis/program_folders.hpp"
#include "analysis/program_run.hpp"
#include "geometry/random_source.hpp"
#include "language/text_source.hpp"
#include "machine/chain_parameters.hpp"
#include "parameter_store/machine_tables.hpp"
#include "testing_support/rounds.hpp"

namespace trunnion::collision_guard {
namespace {

using collision::Vec3;
using Verdict = program_execution::MoveGuard::Verdict;

const std::string machines = MACHINES_DIRECTORY;

struct Machine {
  tool_tables::MachineTables tables;
  channel_setup::ChannelSetup setup;
  explicit Machine(const std::string& name)
      : tables(tool_tables::load_machine_tables(machines + "/" + name)), setup(tables) {}
  // Programs in machine coordinates.
  static Machine without_offsets() {
    Machine machine("ac-table");
    machine.setup.set_offsets({});
    return machine;
  }
};

// A ball in the spindle, boxes on the cradle and a ball on the table of the AC trunnion machine.
constexpr const char* workshop = R"(
structure: "[w C' A' b X Y Z (S) t]"
clearance_mm: 2
bodies:
  - {name: ball on the table, on: C, sphere: {diameter_mm: 60}, position_mm: [90, 20, -360]}
  - {name: arm, on: A, box: {size_mm: [40, 200, 160]}, position_mm: [220, 0, -395]}
  - {name: bed, on: base, box: {size_mm: [900, 900, 100]}, position_mm: [0, 0, -750]}
  - {name: nose, on: spindle, sphere: {diameter_mm: 90}, position_mm: [0, 0, 45]}
  - {name: tip, on: spindle, sphere: {diameter_mm: 12}, position_mm: [0, 0, -94]}
)";

// The distances of the test itself.
class Distances {
 public:
  explicit Distances(const Machine& machine)
      : links_(std::get<collision::MachineLinks>(
            collision::MachineLinks::make(machine::chain_parameters(machine.tables.parameters, 0)))) {}

  // A point of what `depth` joints of a side carry, joint after joint by Rodrigues' formula.
  Vec3 placed(bool workpiece, std::size_t depth, Vec3 p, const AxisValues& q) const {
    const auto& joints = links_.joints(workpiece);
    for (std::size_t k = depth; k-- > 0;) p = moved(joints[k], p, q[joints[k].axis]);
    return p;
  }
  // The point of the base as the part sees it.
  Vec3 seen(bool workpiece, std::size_t depth, Vec3 p, const AxisValues& q) const {
    const auto& joints = links_.joints(workpiece);
    for (std::size_t k = 0; k < depth; ++k) p = moved(joints[k], p, -q[joints[k].axis]);
    return p;
  }
  double least(const AxisValues& q) const {
    const std::size_t head = links_.joints(false).size();
    double d = std::numeric_limits<double>::max();
    for (const double height : {45.0, -94.0}) {
      const double radius = height > 0 ? 45 : 6;
      const Vec3 centre = placed(false, head, links_.face() + Vec3(0, 0, height), q);
      const Vec3 table = placed(true, 2, Vec3(90, 20, -360), q);
      d = std::min(d, (centre - table).norm() - radius - 30);
      for (const auto& [depth, middle, half] :
           {std::tuple(std::size_t{1}, Vec3(220, 0, -395), Vec3(20, 100, 80)),
            std::tuple(std::size_t{0}, Vec3(0, 0, -750), Vec3(450, 450, 50))}) {
        const Vec3 off = (seen(true, depth, centre, q) - middle).cwiseAbs() - half;
        d = std::min(d, off.cwiseMax(0).norm() + std::min(off.maxCoeff(), 0.0) - radius);
      }
    }
    return d;
  }

 private:
  static Vec3 moved(const collision::Joint& joint, const Vec3& p, double by) {
    if (!joint.rotary) return p + by * joint.direction;
    const double a = by * M_PI / 180;
    const Vec3 r = p - joint.point, n = joint.direction;
    return joint.point + std::cos(a) * r + std::sin(a) * n.cross(r) + (1 - std::cos(a)) * n.dot(r) * n;
  }
  collision::MachineLinks links_;
};

std::string random_program(std::uint64_t seed) {
  geometry::RandomSource random(seed);
  const auto number = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  std::string text = "G90 G54 G17\nG0 Z-50\n";
  char line[160];
  if (seed % 2 == 0) text += "T1 M6\nG43.4 H1\n";
  for (int i = 0; i < 9; ++i) {
    switch (static_cast<int>(number(0, 4))) {
      case 0:
        std::snprintf(line, sizeof line, "G0 X%.3f Y%.3f Z%.3f\n", number(-150, 150), number(-150, 150),
                      number(-330, -60));
        break;
      case 1:
        std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f Z%.3f A%.3f C%.3f F8000\n", number(-150, 150),
                      number(-150, 150), number(-330, -60), number(-25, 60), number(-180, 180));
        break;
      case 2:
        std::snprintf(line, sizeof line, "G91 G2 X%.3f Y0 R%.3f Z%.3f F6000\nG90\n", number(10, 60),
                      number(60, 90), number(-40, 20));
        break;
      default:
        std::snprintf(line, sizeof line, "G1 A%.3f C%.3f F5000\n", number(-25, 60), number(-180, 180));
        break;
    }
    text += line;
  }
  return text + "M30\n";
}

TEST(CollisionGuard, NoSampleOfARandomProgramIsNearerThanTheClearance) {
  constexpr std::uint64_t every = 4;  // cycle is a sample: 0.5 mm at 8000 mm/min
  auto machine = Machine::without_offsets();
  const Distances distances(machine);
  CollisionGuard guard(machine.setup, CollisionMode::stop, {"bodies.yaml", workshop});
  guard.configure(machine.tables.parameters, 0);
  int stopped = 0, ended = 0, would_touch = 0;
  for (std::uint64_t seed = 1; seed <= testing_support::rounds(60); ++seed) {
    const auto text = random_program(seed);
    double least = 1e9;
    language::StringSource source(text);
    const auto run = analysis::run_program(
        source, machine.setup, machine.setup.reference_position(),
        [&](const analysis::PlannedCycle& cycle) {
          if (cycle.cycle % every == 0) least = std::min(least, distances.least(cycle.machine));
        },
        {}, 10000000, &guard);
    ASSERT_GE(least, 2) << "seed " << seed << "\n" << text << run.alarm;
    if (run.good) {
      ++ended;
    } else if (run.alarm.find("(alarm 176)") != std::string::npos) {
      ++stopped;
      // Without the guard the path goes on, and mostly comes nearer than the clearance.
      language::StringSource again(text);
      double free = 1e9;
      analysis::run_program(again, machine.setup, machine.setup.reference_position(),
                            [&](const analysis::PlannedCycle& cycle) {
                              if (cycle.cycle % every == 0)
                                free = std::min(free, distances.least(cycle.machine));
                            },
                            {});
      would_touch += free < 2 ? 1 : 0;
    }
  }
  EXPECT_GE(static_cast<std::uint64_t>(stopped), testing_support::rounds(8));
  EXPECT_GE(static_cast<std::uint64_t>(ended), testing_support::rounds(4));
  EXPECT_GE(would_touch, stopped - 2) << "of " << stopped;
}

TEST(CollisionGuard, TheContactNamesLineBodiesDistanceAndPositions) {
  auto machine = Machine::without_offsets();
  CollisionGuard guard(machine.setup, CollisionMode::stop, {"bodies.yaml", workshop});
  guard.configure(machine.tables.parameters, 0);
  language::StringSource source("G90\nG0 X90 Y20\nG1 Z-400 F1000\nM30\n");
  const auto run = analysis::run_program(source, machine.setup, {}, {}, {}, 1000000, &guard);
  // The ball at the tip, radius 6 at 94 below the face, touches the ball of radius 30 whose centre is at
  // -360.
  EXPECT_EQ(run.alarm.rfind("3: 'ball on the table' and 'tip' would be ", 0), 0u) << run.alarm;
  EXPECT_NE(run.alarm.find("(clearance 2 mm) at X90.000 Y20.000 Z-"), std::string::npos) << run.alarm;
  EXPECT_NE(run.alarm.find(" mm, A0.000 C0.000 deg"), std::string::npos) << run.alarm;
}

TEST(CollisionGuard, WarnsOnceForAStretchAndLetsTheProgramGoOn) {
  auto machine = Machine::without_offsets();
  CollisionGuard guard(machine.setup, CollisionMode::warn, {"bodies.yaml", workshop});
  guard.configure(machine.tables.parameters, 0);
  language::StringSource source("G90\nG0 X90 Y20\nG1 Z-250 F1000\nZ-260\nZ-270\nG0 Z0\nM30\n");
  const auto run = analysis::run_program(source, machine.setup, {}, {}, {}, 1000000, &guard);
  EXPECT_TRUE(run.good) << run.alarm;
  const auto warnings = guard.take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].rfind("3: ", 0), 0u) << warnings[0];
}

TEST(CollisionGuard, ALongerToolMeetsWhatAShorterOneDoesNot) {
  Machine machine("ac-table");
  // A tool of the table replaces the bodies on the tool of the file; its length decides.
  idl::parameters::ToolTable tools;
  tools.tools.resize(2);
  tools.tools[0].number = 1, tools.tools[0].length = 60, tools.tools[0].radius = 5;
  tools.tools[1].number = 2, tools.tools[1].length = 160, tools.tools[1].radius = 5;
  machine.setup.set_tools(tools);
  const char* bodies = R"(
structure: "[w C' A' b X Y Z (S) t]"
bodies:
  - {name: block, on: C, box: {size_mm: [50, 50, 50]}, position_mm: [0, 0, -325]}
)";
  CollisionGuard guard(machine.setup, CollisionMode::stop, {"bodies.yaml", bodies});
  guard.configure(machine.tables.parameters, 0);
  language::ModalState modal;
  const auto to_z = [](double z) { return AxisValues{0, 0, z}; };
  // The block's top is at -300: the face may go to -300 + length + 1 of clearance.
  modal.tool = 1;
  EXPECT_FALSE(guard.obstacle(to_z(0), to_z(-238.9), modal));
  EXPECT_TRUE(guard.obstacle(to_z(0), to_z(-239.1), modal));
  modal.tool = 2;
  EXPECT_FALSE(guard.obstacle(to_z(0), to_z(-138.9), modal));
  EXPECT_TRUE(guard.obstacle(to_z(0), to_z(-139.1), modal));
}

TEST(CollisionGuard, AMoveIsTheSameWhateverOneCallMayDo) {
  Machine machine("ac-table");
  CollisionGuard guard(machine.setup, CollisionMode::stop, {"bodies.yaml", workshop});
  guard.configure(machine.tables.parameters, 0);
  language::Command move;
  move.kind = language::CommandKind::line;
  move.line = 7;
  move.target = {-140, 0, -250, 50, 0, 170};
  const auto ask = [&] {
    guard.begin_run();
    auto verdict = Verdict::unfinished;
    while (verdict == Verdict::unfinished) guard.begin_call(), verdict = guard.check({}, move);
    return std::pair(verdict, guard.contact_text());
  };
  const auto first = ask();
  EXPECT_EQ(ask(), first);
}

TEST(CollisionGuard, WithoutUsableBodiesEveryMoveIsRefused) {
  Machine machine("ac-table");
  CollisionGuard guard(machine.setup, CollisionMode::stop, {"bodies.yaml", "bodies: [{name: a}]"});
  EXPECT_THROW(guard.configure(machine.tables.parameters, 0), std::runtime_error);
  guard.begin_call();
  EXPECT_EQ(guard.check({}, {}), Verdict::contact);
  EXPECT_TRUE(guard.obstacle({}, {}, {}));
}

TEST(CollisionGuard, AMissingFileIsAnError) {
  Machine machine("ac-table");
  CollisionGuard guard(machine.setup, CollisionMode::stop, load_bodies_text("/nowhere"));
  EXPECT_THROW(guard.configure(machine.tables.parameters, 0), std::runtime_error);
}

std::string table_below(const collision::MachineLinks& links, double top) {
  const auto& joints = links.joints(true);
  char text[400];
  const auto point = joints.empty() ? Vec3(Vec3::Zero()) : joints.back().point;
  std::snprintf(
      text, sizeof text,
      "bodies:\n"
      "  - {name: table, on: workpiece, cylinder: {diameter_mm: 320, height_mm: 40}, position_mm: [%.3f, "
      "%.3f, %.3f]}\n"
      "  - {name: nose, on: spindle, cylinder: {diameter_mm: 60, height_mm: 100}, position_mm: [0, 0, 50]}\n",
      point.x(), point.y(), top - 20);
  return text;
}

// Every part program that a machine is delivered with, over a table below its lowest tip, by samples of the
// path that it has without the check.
TEST(CollisionGuard, DeliveredProgramsRunToTheSamePositionsOrStopForAContactThatSamplesConfirm) {
  constexpr double below = 15;  // mm
  int same = 0, stopped = 0;
  for (const auto& entry : std::filesystem::directory_iterator(machines)) {
    const auto folder = entry.path() / "programs";
    if (!std::filesystem::exists(folder)) continue;
    Machine machine(entry.path().filename().string());
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      if (file.path().extension() != ".nc") continue;
      std::vector<AxisValues> path;
      double lowest = 0;
      const auto run = [&](program_execution::MoveGuard* guard) {
        analysis::FileSource text(file.path().string());
        std::uint64_t sum = 0;
        const auto result = analysis::run_program(
            text, machine.setup, machine.setup.reference_position(),
            [&](const analysis::PlannedCycle& cycle) {
              for (const double value : cycle.machine) {
                std::uint64_t bits = 0;
                std::memcpy(&bits, &value, sizeof bits);
                sum = (sum ^ bits) * 1099511628211u;
              }
              lowest = std::min(lowest, cycle.tip[2]);
              if (guard == nullptr && cycle.cycle % 20 == 0) path.push_back(cycle.machine);
            },
            {}, 100000000, guard);
        return std::tuple(result.good, result.alarm, result.cycles, sum);
      };
      const auto without = run(nullptr);
      const auto design = machine::chain_parameters(machine.tables.parameters, 0);
      const auto text = table_below(std::get<collision::MachineLinks>(collision::MachineLinks::make(design)),
                                    lowest - below);
      auto bodies = collision::parse_bodies(text, "bodies.yaml", design);
      const collision::CollisionModel model(bodies.links, bodies.set);
      double nearest = 1e9;
      for (const auto& position : path)
        if (const auto pair = model.nearest(position, 100)) nearest = std::min(nearest, pair->distance);
      CollisionGuard guard(machine.setup, CollisionMode::stop, {"bodies.yaml", text});
      guard.configure(machine.tables.parameters, 0);
      const auto with = run(&guard);
      if (with == without) {
        EXPECT_GE(nearest, 1) << file.path();
        ++same;
      } else {
        // A tool of the table is a body as well; the samples are those of the nose, or it is the tool's
        // contact.
        EXPECT_NE(std::get<1>(with).find("(alarm 176)"), std::string::npos) << std::get<1>(with);
        EXPECT_TRUE(nearest < 2 || std::get<1>(with).find("'tool'") != std::string::npos)
            << file.path() << " " << std::get<1>(with) << " nearest " << nearest;
        ++stopped;
      }
    }
  }
  EXPECT_GE(same, 12) << stopped << " stopped";
}

}  // namespace
}  // namespace trunnion::collision_guard
