// SPDX-License-Identifier: Apache-2.0
// Tool tip control on every machine at full feed: where the commanded axes put the tip, against the lines and
// arcs of the program by formulae of this file.
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <map>
#include <numbers>

#include "analysis/program_run.hpp"
#include "motion/blended_path.hpp"

namespace trunnion::analysis::tip_path_test {
namespace {

using geometry::Vec3;
using language::CommandKind;

struct Piece {
  AxisValues start{};
  language::Command command;
  Vec3 from() const { return {start[0], start[1], start[2]}; }
  Vec3 to() const { return {command.target[0], command.target[1], command.target[2]}; }
};

double from_line(const Piece& piece, const Vec3& tip) {
  const Vec3 way = piece.to() - piece.from();
  const double length = way.squaredNorm();
  const double share = length > 0 ? std::clamp((tip - piece.from()).dot(way) / length, 0.0, 1.0) : 0;
  return (piece.from() + share * way - tip).norm();
}

// Arcs of these programs lie in XY about a centre, with the same radius at both ends. The angle that the tip
// has gone tells how far a helix has risen.
double from_helix(const Piece& piece, const Vec3& tip) {
  const auto& arc = piece.command.arc;
  const auto angle = [&](const Vec3& p) { return std::atan2(p.y() - arc.centre[1], p.x() - arc.centre[0]); };
  const double radius = std::hypot(piece.start[0] - arc.centre[0], piece.start[1] - arc.centre[1]);
  const double sense = arc.clockwise ? -1 : 1, sweep = arc.sweep * std::numbers::pi / 180;
  const double gone = sense * (angle(tip) - angle(piece.from()));
  const double across = std::hypot(tip.x() - arc.centre[0], tip.y() - arc.centre[1]) - radius;
  double least = 1e9;
  for (int turn = -1; turn <= 1 + static_cast<int>(arc.sweep / 360); ++turn) {
    const double share = (gone + 2 * std::numbers::pi * turn) / sweep;
    if (share < -1e-6 || share > 1 + 1e-6) continue;
    const double height = piece.start[2] + share * (piece.command.target[2] - piece.start[2]);
    least = std::min(least, std::hypot(across, tip.z() - height));
  }
  return least;
}

struct Measured {
  double worst = 0;  // mm
  int cycles = 0;
  int turned = 0;  // of them, with rotary axes on the move
};

// Cycles whose tip is farther than `clear` (mm) from both ends of the move that is executed.
Measured measure(const std::string& machine, const std::string& text, double clear) {
  channel_setup::ChannelSetup setup(
      tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/" + machine));
  language::StringSource source(text);
  std::map<std::uint32_t, Piece> pieces;
  AxisValues end{}, last{};
  double tool_length = 0;
  Measured result;
  const auto run = run_program(
      source, setup, {},
      [&](const PlannedCycle& cycle) {
        const auto found = pieces.find(cycle.setpoint->sequence);
        if (found == pieces.end() || cycle.machine == last) return;
        const Piece& piece = found->second;
        const AxisValues at = setup.tip_from_machine(cycle.machine, tool_length);
        const Vec3 tip(at[0], at[1], at[2]);
        if (clear == 0 || ((tip - piece.from()).norm() > clear && (tip - piece.to()).norm() > clear)) {
          const double away =
              piece.command.kind == CommandKind::arc ? from_helix(piece, tip) : from_line(piece, tip);
          result.worst = std::max(result.worst, away);
          ++result.cycles;
          result.turned += std::equal(last.begin() + 3, last.end(), cycle.machine.begin() + 3) ? 0 : 1;
        }
        last = cycle.machine;
      },
      [&](const language::Command& command, const FrameMoves& frame) {
        const bool move = command.kind == CommandKind::line || command.kind == CommandKind::arc ||
                          command.kind == CommandKind::rapid;
        if (!move) end = frame.start;
        tool_length = frame.tool_length;
        if (move && frame.transformation == language::Transformation::rtcp)
          pieces[command.sequence] = {end, command};
        if (move) end = command.target;
      });
  EXPECT_TRUE(run.good) << machine << ": " << run.alarm;
  return result;
}

std::string program_of(const std::string& machine) {
  std::ifstream in(std::string(MACHINES_DIRECTORY) + "/" + machine + "/programs/rtcp.nc");
  return {std::istreambuf_iterator<char>(in), {}};
}

// As fast as the axes go, whatever the program says.
std::string at_full_feed(const std::string& text, const std::string& path_control) {
  std::string fast;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 3, "G61") == 0) {
      fast += path_control;
      i += 2;
    } else if (text[i] == 'F' && i + 1 < text.size() && std::isdigit(text[i + 1]) != 0) {
      fast += "F99999";
      while (i + 1 < text.size() && std::isdigit(text[i + 1]) != 0) ++i;
    } else {
      fast += text[i];
    }
  }
  return fast;
}

const std::string vectors =
    "G21 G17 G90 G54 G94 G61\nG53 G0 Z0\nG43.5 H1\nG0 X0 Y0 Z80\nG1 X0 Y0 Z60 F3000\nX30 I0.4 K1\n"
    "X30 Y30 J0.4 K1\nG3 X-30 Y30 Z70 R30 I-0.4 K1\nG1 X0 Y0 J-0.4 K1\nG2 X40 Y0 R-25 I0.2 J0.3 K1\n"
    "G1 X0 Y0 Z65 I0.0004 J-0.4 K1\nX20 I0 J0 K1\nG49\nG53 G0 Z0\nM30\n";

class TipPath : public testing::TestWithParam<const char*> {};

TEST_P(TipPath, IsOnTheProgramWithin1e6AtEveryCycleWithExactStops) {
  const auto measured = measure(GetParam(), at_full_feed(program_of(GetParam()), "G61"), 0);
  EXPECT_LT(measured.worst, 1e-6);
  EXPECT_GT(measured.cycles, 5000);
  EXPECT_GT(measured.turned, 4000);
}

// A rounded join reaches BlendedPath::longest_reach at most; what is not within that of a join is the
// program's line or arc itself.
TEST_P(TipPath, IsOnTheProgramWithin1e6BetweenTheJoinsWithRoundedJoins) {
  const auto measured =
      measure(GetParam(), at_full_feed(program_of(GetParam()), "G64"), motion::BlendedPath::longest_reach);
  EXPECT_LT(measured.worst, 1e-6);
  EXPECT_GT(measured.cycles, 2000);
  EXPECT_GT(measured.turned, 2000);
}

// Between the pieces of one block only the rotary axes change their rates, so no join of them moves the tip,
// and joins of blocks are exact here.
TEST_P(TipPath, OfToolVectorsIsOnTheProgramWithin1e6AtEveryCycle) {
  if (std::string(GetParam()) == "four-axis")
    GTEST_SKIP() << "one rotary axis reaches a circle of directions";
  const auto measured = measure(GetParam(), at_full_feed(vectors, "G61"), 0);
  EXPECT_LT(measured.worst, 1e-6);
  EXPECT_GT(measured.cycles, 2000);
  EXPECT_GT(measured.turned, 2000);
}

INSTANTIATE_TEST_SUITE_P(Machines, TipPath,
                         testing::Values("ac-table", "bc-table", "cb-head", "ac-head", "b-head-c-table",
                                         "nutating-b-head-c-table", "four-axis"),
                         [](const auto& machine) {
                           std::string name = machine.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace trunnion::analysis::tip_path_test
