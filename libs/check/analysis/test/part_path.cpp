// SPDX-License-Identifier: Apache-2.0
#include "part_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "analysis/program_run.hpp"

namespace trunnion::analysis {
namespace {

double distance_from_chord(const Vec3& a, const Vec3& b, const Vec3& point) {
  const double share = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + share * (b - a) - point).norm();
}

// From the cubic through four tips, between the middle two: on a smooth path it leaves the curve by the
// fourth power of the way of a cycle, where a chord leaves it by the second.
double distance_from_cubic(const Vec3* p, const Vec3& point) {
  const std::array<double, 4> t{-(p[1] - p[0]).norm(), 0, (p[2] - p[1]).norm(),
                                (p[2] - p[1]).norm() + (p[3] - p[2]).norm()};
  const auto away = [&](double at) {
    Vec3 place = -point;
    for (std::size_t i = 0; i < 4; ++i) {
      double weight = 1;
      for (std::size_t k = 0; k < 4; ++k)
        if (k != i) weight *= (at - t[k]) / (t[i] - t[k]);
      place += weight * p[i];
    }
    return place.squaredNorm();
  };
  double low = 0, high = t[2];
  for (int k = 0; k < 40; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (away(a) < away(b) ? high : low) = away(a) < away(b) ? b : a;
  }
  return std::sqrt(away(low));
}

}  // namespace

std::vector<Vec3> part_path(const std::string& text, channel_setup::ChannelSetup& machine, std::uint32_t from,
                            std::uint32_t to) {
  language::StringSource source(text);
  const auto zero = machine.work_offset(0);
  std::vector<Vec3> path;
  const auto run =
      run_program(source, machine, {},
                  [&](const PlannedCycle& cycle) {
                    const auto line = cycle.setpoint->line;
                    if (line < from || line > to) return;
                    const Vec3 tip(cycle.tip[0] - zero[0], cycle.tip[1] - zero[1], cycle.tip[2] - zero[2]);
                    if (line == from) path.clear();
                    if (path.empty() || (tip - path.back()).norm() > 1e-9) path.push_back(tip);
                  },
                  {});
  if (!run.good) throw std::runtime_error(run.alarm);
  return path;
}

double farthest_from(const std::vector<Vec3>& path, const std::vector<Vec3>& of) {
  double worst = 0;
  std::size_t near = 0;
  for (const Vec3& point : of) {
    const auto squared = [&](std::size_t k) { return (path[k] - point).squaredNorm(); };
    while (near + 1 < path.size() && squared(near + 1) <= squared(near)) ++near;
    double best = std::sqrt(squared(near));
    for (std::size_t k = near > 0 ? near - 1 : 0; k < std::min(near + 1, path.size() - 1); ++k) {
      best = std::min(best, distance_from_chord(path[k], path[k + 1], point));
      if (k > 0 && k + 2 < path.size() && best > 1e-9)
        best = std::min(best, distance_from_cubic(&path[k - 1], point));
    }
    worst = std::max(worst, best);
  }
  return worst;
}

}  // namespace trunnion::analysis
