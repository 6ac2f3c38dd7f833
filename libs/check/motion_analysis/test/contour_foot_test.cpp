// SPDX-License-Identifier: Apache-2.0
// The nearest place of a piece against a dense table of its points.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "motion_analysis/contour_check.hpp"

namespace trunnion::analysis {
namespace {

constexpr double contour = 0.01, orientation = 0.05;

double weight(const Deviation& d) { return std::max(d.contour / contour, d.orientation / orientation); }

/// One line, arc, helix or spiral about the origin of its plane, with or without a turn of A.
struct Piece {
  language::Command command;
  AxisValues start{};

  explicit Piece(std::mt19937& random) {
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto plane = static_cast<language::Plane>(random() % 3);
    const std::size_t axes[3][3] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
    const auto& [u, v, n] = axes[static_cast<std::size_t>(plane)];
    command.sequence = 1;
    const double radius = between(0.5, 40), angle = between(0, 7);
    start[u] = radius * std::cos(angle), start[v] = radius * std::sin(angle), start[n] = between(-5, 5);
    command.target = start;
    command.kind = random() % 3 == 0 ? language::CommandKind::line : language::CommandKind::arc;
    if (command.kind == language::CommandKind::line) {
      for (const auto axis : {u, v, n}) command.target[axis] += between(-20, 20);
    } else {
      command.arc.plane = plane;
      command.arc.clockwise = random() % 2 == 0;
      const bool full = random() % 4 == 0;
      command.arc.sweep = full ? 360 : between(1, 1000);
      const double sweep = command.arc.sweep * std::numbers::pi / 180 * (command.arc.clockwise ? -1 : 1);
      const double end = full ? radius : radius + (random() % 2 == 0 ? 0 : between(-0.2, 0.2) * radius);
      command.target[u] = end * std::cos(angle + sweep), command.target[v] = end * std::sin(angle + sweep);
      if (!full && random() % 2 == 0) command.target[n] += between(-30, 30);
    }
    if (random() % 3 == 0) command.target[language::A] = between(-40, 40);
  }

  AxisValues at(double f) const {
    AxisValues p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = start[i] + f * (command.target[i] - start[i]);
    if (command.kind == language::CommandKind::line) return p;
    const std::size_t axes[3][2] = {{0, 1}, {2, 0}, {1, 2}};
    const auto& [u, v] = axes[static_cast<std::size_t>(command.arc.plane)];
    const double sweep = command.arc.sweep * std::numbers::pi / 180 * (command.arc.clockwise ? -1 : 1);
    const double r0 = std::hypot(start[u], start[v]);
    const double r = r0 + f * (std::hypot(command.target[u], command.target[v]) - r0);
    const double angle = std::atan2(start[v], start[u]) + f * sweep;
    p[u] = r * std::cos(angle), p[v] = r * std::sin(angle);
    return p;
  }
};

// Places beside the path by up to 0.02 mm and 0.1 degrees, as a rounded path is: the table of 200,001 points
// has a spacing below 0.004 mm (40 mm, 1000 degrees), so it is too far by at most 0.002^2 / (2 * 0.001) mm
// where the deviation is above 0.001 mm.
TEST(ContourCheck, finds_the_nearest_place_of_every_kind_of_piece) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    std::mt19937 random(seed);
    const Piece piece(random);
    ContourCheck check(piece.start, contour, orientation);
    check.add(piece.command);
    for (int k = 0; k < 3; ++k) {
      auto position = piece.at(std::uniform_real_distribution<double>(0, 1)(random));
      std::uniform_real_distribution<double> off(-0.02, 0.02);
      for (std::size_t i = 0; i < 3; ++i) position[i] += off(random);
      if (k == 2) position[language::A] += 5 * off(random);
      double least = 1e300;
      for (int i = 0; i <= 100000; ++i) {
        const auto p = piece.at(i / 100000.0);
        double d = 0, a = 0;
        for (std::size_t j = 0; j < 3; ++j) {
          d += (p[j] - position[j]) * (p[j] - position[j]);
          const auto rotary = language::A + j;
          a += (p[rotary] - position[rotary]) * (p[rotary] - position[rotary]);
        }
        least = std::min(least, std::max(std::sqrt(d) / contour, std::sqrt(a) / orientation));
      }
      const double found = weight(check.of(position, 1));
      EXPECT_LE(found, least + 1e-9) << "seed " << seed;
      EXPECT_GE(found, least - 0.43) << "seed " << seed;
      const double exact = weight(check.of(piece.at(0.37), 1));
      EXPECT_LT(exact, 1e-6) << "seed " << seed << ", a point of the path";
    }
  }
}

}  // namespace
}  // namespace trunnion::analysis
