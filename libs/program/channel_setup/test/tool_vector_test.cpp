// SPDX-License-Identifier: Apache-2.0
// Lines with tool vectors (G43.5) on real machines: interpreter, channel setup and geometry together.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/angle.hpp"
#include "motion/path_segment.hpp"
#include "reading.hpp"

namespace trunnion::channel_setup {
namespace {

using geometry::Vec3;
using language::AxisValues;
using language::Command;
using language::CommandKind;
using test::read;
using test::setup_of;

Vec3 tool(const ChannelSetup& setup, const AxisValues& at) {
  return setup.chain().tool_direction_in_workpiece(geometry::angles_of(at.data()));
}

const double lean = 25 * geometry::radians_per_degree, far = 40 * geometry::radians_per_degree;

class ToolVector : public testing::TestWithParam<const char*> {};

std::string vector_words(const Vec3& v) {
  return " I" + std::to_string(v[0]) + " J" + std::to_string(v[1]) + " K" + std::to_string(v[2]);
}

// Moves of one line as the motion takes them, each looked at in four places.
void expect_way(const ChannelSetup& setup, const AxisValues& start, const std::vector<Command>& moves,
                const Vec3& end, const std::function<Vec3(double)>& tip) {
  ASSERT_GE(moves.size(), 4u);
  const auto arc = *geometry::DirectionArc::make(tool(setup, start), end);
  AxisValues before = start;
  for (std::size_t n = 0; n < moves.size(); ++n) {
    const auto piece = moves[n].kind == CommandKind::arc
                           ? motion::PathSegment::arc(before, moves[n].target, moves[n].arc)
                           : motion::PathSegment::line(before, moves[n].target);
    for (int k = 1; k <= 4; ++k) {
      const auto at = piece.position(piece.length() * k / 4);
      const double share = (static_cast<double>(n) + k * 0.25) / static_cast<double>(moves.size());
      ASSERT_LT((Vec3(at[0] - start[0], at[1] - start[1], at[2] - start[2]) - tip(share)).norm(), 1e-10);
      ASSERT_LT(geometry::angle_between(tool(setup, at), arc.at(share)),
                0.0051 * geometry::radians_per_degree);
    }
    before = moves[n].target;
  }
}

std::pair<AxisValues, std::vector<Command>> last_line(const test::Reading& reading) {
  std::pair<AxisValues, std::vector<Command>> result;
  const auto line = reading.commands[reading.commands.size() - 2].line;  // before the end
  for (const auto& c : reading.commands) {
    if (c.line < line) result.first = c.target;
    if (c.line == line && c.kind != CommandKind::end) result.second.push_back(c);
  }
  return result;
}

// The first vector brings the tool to 25 degrees; the second takes it over the great circle to 40 degrees
// towards +Y while the tip goes 60 mm along X and 10 up. Between two pieces the axes go in proportion, so
// places between them are looked at too: a tenth of the orientation tolerance (0.05 degrees) is what pieces
// may cost.
TEST_P(ToolVector, LinesAndRapidsKeepTheTipOnThemAndTheToolOnTheGreatCircle) {
  auto setup = setup_of(GetParam());
  const Vec3 from(std::sin(lean), 0, std::cos(lean)), to(0, std::sin(far), std::cos(far));
  for (const auto& [word, kind] : {std::pair("\nG1", CommandKind::line), {"\nG0", CommandKind::rapid}}) {
    const auto reading =
        read(setup, "G21 G17 G90 G54 G94\nG43.5 H1\nG1 X0 Y0 Z60 F2000" + vector_words(from) + word +
                        " X60 Z70" + vector_words(to) + "\nM30\n");
    ASSERT_EQ(reading.alarm, 0u) << reading.text;
    const auto [start, moves] = last_line(reading);
    for (const auto& c : moves) {
      ASSERT_EQ(c.kind, kind);
      ASSERT_EQ(c.chord, &c != &moves.back()) << "all but the last go on";
    }
    expect_way(setup, start, moves, to, [](double share) { return Vec3(share * Vec3(60, 0, 10)); });
  }
}

// A three-quarter turn of R40 about (0, 0) that climbs 15 mm: from (40, 0, 0) the tip is at 40 (cos f - 1,
// sin f) and f / 270 of the climb. The longer arc is the one with R below zero.
TEST_P(ToolVector, AHelixKeepsTheTipOnItAndTheToolOnTheGreatCircle) {
  auto setup = setup_of(GetParam());
  const Vec3 from(std::sin(lean), 0, std::cos(lean)), to(0, std::sin(far), std::cos(far));
  const auto reading = read(setup, "G21 G17 G90 G54 G94\nG43.5 H1\nG1 X40 Y0 Z60 F2000" + vector_words(from) +
                                       "\nG3 X0 Y-40 Z75 R-40" + vector_words(to) + "\nM30\n");
  ASSERT_EQ(reading.alarm, 0u) << reading.text;
  const auto [start, moves] = last_line(reading);
  for (const auto& c : moves) ASSERT_EQ(c.kind, CommandKind::arc);
  expect_way(setup, start, moves, to, [](double share) {
    const double f = share * 1.5 * std::numbers::pi;
    return Vec3(40 * (std::cos(f) - 1), 40 * std::sin(f), 15 * share);
  });
}

// The plane of I0 J20 K0 leans about X by 20 degrees: its Y is (0, cos 20, sin 20), its Z (0, -sin 20, cos
// 20). A quarter turn about (0, 0) of the plane, tool vectors in the plane's words.
TEST_P(ToolVector, AnArcInATiltedPlaneKeepsBoth) {
  auto setup = setup_of(GetParam());
  const double t = 20 * geometry::radians_per_degree;
  const Vec3 x(1, 0, 0), y(0, std::cos(t), std::sin(t)), z(0, -std::sin(t), std::cos(t));
  const Vec3 words(0.3, 0.2, 1);
  const auto reading =
      read(setup,
           "G21 G17 G90 G54 G94 F2000\nG43.5 H1\nG1 Z60\nG68.2 X0 Y0 Z60 I0 J20 K0\nG53.2\nG1 X40 Y0 Z0\n"
           "G3 X0 Y40 R40" +
               vector_words(words) + "\nM30\n");
  ASSERT_EQ(reading.alarm, 0u) << reading.text;
  const auto [start, moves] = last_line(reading);
  EXPECT_LT(geometry::angle_between(tool(setup, start), z), 1e-9);
  expect_way(setup, start, moves, words[0] * x + words[1] * y + words[2] * z, [&](double share) {
    const double f = share * 0.5 * std::numbers::pi;
    return Vec3(40 * (std::cos(f) - 1) * x + 40 * std::sin(f) * y);
  });
}

INSTANTIATE_TEST_SUITE_P(Machines, ToolVector,
                         testing::Values("ac-table", "bc-table", "cb-head", "ac-head", "b-head-c-table",
                                         "nutating-b-head-c-table"),
                         [](const auto& machine) {
                           std::string name = machine.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// I J K of an arc without R are its centre, as ever: the tool keeps its direction.
TEST(ToolVectors, AnArcByItsCentreKeepsTheDirection) {
  auto setup = setup_of("ac-table");
  const auto reading =
      read(setup, "G21 G17 G90 G54 G94\nG43.5 H1\nG1 X40 Y0 Z60 F2000 I0.5 K1\nG3 X0 Y40 I-40\nM30\n");
  ASSERT_EQ(reading.alarm, 0u) << reading.text;
  const auto [start, moves] = last_line(reading);
  ASSERT_EQ(moves.size(), 1u);
  for (const auto axis : {language::A, language::C}) EXPECT_EQ(moves[0].target[axis], start[axis]);
}

// Beside a contour the tool may not lean over: the offset is in the plane, and only for a tool square to it.
TEST(ToolVectors, WithCutterCompensationTheDirectionMayOnlyStay) {
  auto setup = setup_of("ac-table");
  const std::string head = "G21 G17 G90 G54 G94 F2000\nG43.5 H1\nG0 X0 Y0 Z60\nG41 D1 G1 X20 Y0 I0 J0 K1\n";
  EXPECT_EQ(read(setup, head + "X60 K1\nY40\nG40 X0\nM30\n").alarm, 0u);
  const auto turned = read(setup, head + "X60 I0.1 K1\n");
  EXPECT_EQ(turned.alarm, static_cast<unsigned>(language::AlarmNumber::compensation_rotary)) << turned.text;
  EXPECT_EQ(turned.line, 5u);
}

TEST(ToolVectors, ADirectionOutOfReachNamesTheNearestInTheWordsOfTheProgram) {
  auto setup = setup_of("nutating-b-head-c-table");
  const auto reading = read(setup, "G21 G90 G54 G94 F2000\nG43.5 H1\nG0 X0 Y0 Z60\nG1 I1 K1\nI1 K-0.5\n");
  EXPECT_EQ(reading.alarm, static_cast<unsigned>(language::AlarmNumber::orientation_impossible));
  EXPECT_NE(reading.text.find("nearest I1.000000 J0.000000 K0.000000"), std::string::npos) << reading.text;
}

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
    return static_cast<AlarmNumber>(static_cast<std::uint16_t>(result.alarm));
  };
  auto ac_table = setup_of("ac-table");
  EXPECT_EQ(alarm(ac_table, "I1\nI-1\n"), AlarmNumber::tool_vector_opposite);
  EXPECT_EQ(alarm(ac_table, "I1\nJ1 K-2\n"), AlarmNumber::tool_vector_travel) << "A beyond 110 degrees";
  EXPECT_EQ(alarm(ac_table, "I1\nI0 J0 K0\n"), AlarmNumber::tool_vector_zero);
  auto nutating = setup_of("nutating-b-head-c-table");
  EXPECT_EQ(alarm(nutating, "I1 K1\nI1 K-0.5\n"), AlarmNumber::orientation_impossible);
  auto tables = tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/ac-table");
  tables.parameters.values[40100] = {1, ""};
  ChannelSetup careful(tables);
  EXPECT_EQ(alarm(careful, "G0 J-0.3 K1\nG1 X1 J0.3 K1\n"), AlarmNumber::tool_vector_pole)
      << "pole handling 1";
}

}  // namespace
}  // namespace trunnion::channel_setup
