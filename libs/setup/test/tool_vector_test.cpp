// Lines with tool vectors (G43.5) on real machines: interpreter, channel setup and geometry together.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angle.hpp"
#include "language/interpreter.hpp"
#include "setup/channel_setup.hpp"

namespace trunnion::setup {
namespace {

using geometry::Vec3;
using language::AxisValues;
using language::Command;
using language::CommandKind;

struct Read {
  std::vector<Command> commands;
  std::uint32_t alarm = 0;
};

Read read(ChannelSetup& setup, const std::string& text) {
  language::StringSource source(text);
  language::Interpreter interpreter(setup);
  interpreter.start(source, {}, {});
  Read result;
  Command command;
  for (;;) switch (interpreter.next(command)) {
      case language::Step::command:
        result.commands.push_back(command);
        if (command.kind == CommandKind::end) return result;
        break;
      case language::Step::alarm:
        result.alarm = static_cast<std::uint32_t>(interpreter.alarm().number);
        return result;
      case language::Step::end:
        return result;
      default:
        break;
    }
}

ChannelSetup setup_of(const std::string& machine) {
  return ChannelSetup(load_machine_tables(std::string(MACHINES_DIRECTORY) + "/" + machine));
}

Vec3 tool(const ChannelSetup& setup, const AxisValues& at) {
  return setup.chain().tool_direction_in_workpiece(geometry::angles_of(at.data()));
}

class ToolVector : public testing::TestWithParam<const char*> {};

// The first vector brings the tool to 25 degrees; the second takes it over the great circle to 40 degrees
// towards +Y while the tip goes 60 mm along X and 10 up. Between two pieces the axes go in proportion, so
// places between them are looked at too: a tenth of the orientation tolerance (0.05 degrees) is what pieces
// may cost.
TEST_P(ToolVector, ALineKeepsTheTipOnItAndTheToolOnTheGreatCircle) {
  auto setup = setup_of(GetParam());
  const double lean = 25 * geometry::radians_per_degree, far = 40 * geometry::radians_per_degree;
  const auto text = [](double v) { return std::to_string(v); };
  const auto program = "G21 G90 G54 G94\nG43.5 H1\nG1 X0 Y0 Z60 F2000 I" + text(std::sin(lean)) + " K" +
                       text(std::cos(lean)) + "\nX60 Z70 J" + text(std::sin(far)) + " K" +
                       text(std::cos(far)) + "\nM30\n";
  const auto result = read(setup, program);
  ASSERT_EQ(result.alarm, 0u);
  std::vector<Command> line;
  AxisValues start{};
  for (const auto& c : result.commands) {
    if (c.kind == CommandKind::line && c.line == 3) start = c.target;
    if (c.kind == CommandKind::line && c.line == 4) line.push_back(c);
  }
  ASSERT_GE(line.size(), 4u);
  const auto arc = *geometry::DirectionArc::make(tool(setup, start), Vec3(0, std::sin(far), std::cos(far)));
  const Vec3 from(start[0], start[1], start[2]), way(60, 0, 10);
  AxisValues before = start;
  for (std::size_t n = 0; n < line.size(); ++n) {
    EXPECT_TRUE(line[n].chord);
    for (int k = 1; k <= 4; ++k) {
      AxisValues at = before;
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += k * 0.25 * (line[n].target[i] - before[i]);
      const double share = (static_cast<double>(n) + k * 0.25) / static_cast<double>(line.size());
      ASSERT_LT((Vec3(at[0], at[1], at[2]) - (from + share * way)).norm(), 1e-11);
      ASSERT_LT(geometry::angle_between(tool(setup, at), arc.at(share)),
                0.0051 * geometry::radians_per_degree);
    }
    for (std::size_t i = 3; i < 6; ++i) ASSERT_LT(std::abs(line[n].target[i] - before[i]), 45);
    before = line[n].target;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, ToolVector,
                         testing::Values("ac-table", "bc-table", "cb-head", "ac-head", "b-head-c-table",
                                         "nutating-b-head-c-table"),
                         [](const auto& machine) {
                           std::string name = machine.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Upright the table has to turn to C90 before the tool can lean to +X; the tip waits.
TEST(ToolVectors, FromThePoleTheTableTurnsFirstAndTheTipWaits) {
  auto setup = setup_of("ac-table");
  const auto result =
      read(setup, "G21 G90 G54 G94\nG43.5 H1\nG1 X0 Y0 Z60 F2000\nX10 I0.5 K0.8660254037844386\n");
  ASSERT_EQ(result.alarm, 0u);
  const Command* first = nullptr;
  for (const auto& c : result.commands)
    if (c.line == 4 && first == nullptr) first = &c;
  ASSERT_NE(first, nullptr);
  EXPECT_NEAR(first->target[language::X], 0, 1e-9);
  EXPECT_NEAR(first->target[language::A], 0, 1e-9);
  EXPECT_NEAR(first->target[language::C], 90, 1e-9);
  const auto& last = result.commands.back();
  EXPECT_NEAR(last.target[language::X], 10, 1e-9);
  EXPECT_NEAR(last.target[language::A], 30, 1e-9);
  EXPECT_NEAR(last.target[language::C], 90, 1e-9);
}

// Past the pole at 0.0005 rad, within the tolerance: the trunnion swings through and the table hardly turns.
// At sqrt(0.0005) rad from the pole, where the passage begins and ends, the great circle has it 1.3 degrees
// to either side; on the circle it would go on to 90.
TEST(ToolVectors, PastAPoleWithinTheToleranceNothingSpins) {
  auto setup = setup_of("ac-table");
  const auto result = read(setup,
                           "G21 G90 G54 G94\nG43.5 H1\nG1 X0 Y0 Z60 F2000 I0.0005 J-0.3 K1\n"
                           "X10 I0.0005 J0.3 K1\n");
  ASSERT_EQ(result.alarm, 0u);
  double least = 1e9, most = -1e9;
  for (const auto& c : result.commands)
    if (c.kind == CommandKind::line && c.line >= 3 && std::abs(c.target[language::A]) > 1) {
      least = std::min(least, c.target[language::C]);
      most = std::max(most, c.target[language::C]);
    }
  EXPECT_LT(most - least, 4);
}

TEST(ToolVectors, FaultsOfTheWayAreAlarmsBeforeItsFirstMove) {
  using language::AlarmNumber;
  const auto alarm = [](ChannelSetup& setup, const std::string& lines) {
    const auto result = read(setup, "G21 G90 G54 G94\nG43.5 H1\nG1 X0 Y0 Z60 F2000\n" + lines);
    for (const auto& c : result.commands) {
      EXPECT_LT(c.line, 5u) << "no move of the faulty line";
    }
    return static_cast<AlarmNumber>(result.alarm);
  };
  auto ac_table = setup_of("ac-table");
  EXPECT_EQ(alarm(ac_table, "I1\nI-1\n"), AlarmNumber::tool_vector_opposite);
  EXPECT_EQ(alarm(ac_table, "I1\nJ1 K-2\n"), AlarmNumber::tool_vector_way) << "A beyond 110 degrees";
  EXPECT_EQ(alarm(ac_table, "I1\nI0 J0 K0\n"), AlarmNumber::tool_vector_zero);
  auto nutating = setup_of("nutating-b-head-c-table");
  EXPECT_EQ(alarm(nutating, "I1 K1\nI1 K-0.5\n"), AlarmNumber::orientation_impossible);
  auto tables = load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[40100] = {1, ""};
  ChannelSetup careful(tables);
  EXPECT_EQ(alarm(careful, "G0 J-0.3 K1\nG1 X1 J0.3 K1\n"), AlarmNumber::tool_vector_way)
      << "pole handling 1";
}

}  // namespace
}  // namespace trunnion::setup
