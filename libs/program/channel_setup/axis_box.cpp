// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/axis_box.hpp"

#include <algorithm>
#include <cmath>

#include "motion/axis_motion.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::channel_setup {
namespace {

constexpr double arc_step = 10, rotary_step = 2;  // degrees between two samples
constexpr double smallest_turn = 0.05;            // degrees: less of a swing is 0.1 um at 1 m from the axis
constexpr double most_samples = 720;
constexpr int refinements = 20;
constexpr double golden = 0.6180339887498949;

/// Machine coordinates along one command.
class Way {
 public:
  Way(const AxisValues& from, const language::Command& move, const geometry::Chain& chain)
      : path_(move.kind == language::CommandKind::arc ? motion::PathSegment::arc(from, move.target, move.arc)
                                                      : motion::PathSegment::line(from, move.target)),
        chain_(move.modal.transformation == language::Transformation::rtcp ? &chain : nullptr),
        tool_length_(move.modal.tool_length) {}

  AxisValues at(double share) const {
    return motion::machine_axes(path_.position(path_.length() * share), chain_, tool_length_);
  }

 private:
  motion::PathSegment path_;
  const geometry::Chain* chain_;
  double tool_length_;
};

/// Shares of the way to look at. Next to both ends there is one more, so that an extreme in the first or the
/// last step shows between its neighbours.
class Places {
 public:
  Places(const AxisValues& from, const language::Command& move) {
    double turn = 0, parts = 1;
    if (move.kind == language::CommandKind::arc) {
      turn = move.arc.sweep;
      parts = turn / arc_step;
    }
    if (move.modal.transformation == language::Transformation::rtcp)
      for (const auto axis : {language::A, language::B, language::C}) {
        turn = std::max(turn, std::abs(move.target[axis] - from[axis]));
        parts = std::max(parts, std::abs(move.target[axis] - from[axis]) / rotary_step);
      }
    if (turn > smallest_turn)
      samples_ = static_cast<std::size_t>(std::ceil(std::clamp<double>(parts, 1, most_samples)));
  }
  std::size_t size() const { return samples_ == 0 ? 2 : samples_ + 3; }
  double operator[](std::size_t k) const {
    if (k == 0) return 0;
    if (k + 1 == size()) return 1;
    const auto samples = static_cast<double>(samples_), edge = 1e-3 / samples;
    return k == 1 ? edge : k == samples_ + 1 ? 1 - edge : static_cast<double>(k - 1) / samples;
  }

 private:
  std::size_t samples_ = 0;
};

/// The largest value of an axis, times `sign`, between two places with one hill between them: golden section.
double hilltop(const Way& way, std::size_t axis, double sign, double low, double high) {
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = sign * way.at(a)[axis], at_b = sign * way.at(b)[axis];
  for (int n = 0; n < refinements; ++n) {
    if (at_a < at_b) {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low);
      at_b = sign * way.at(b)[axis];
    } else {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low);
      at_a = sign * way.at(a)[axis];
    }
  }
  return std::max(at_a, at_b);
}

}  // namespace

void AxisBox::include(const AxisBox& other) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

AxisBox extent_of(const AxisValues& from, const language::Command& move, const geometry::Chain& chain) {
  const Way way(from, move, chain);
  const Places places(from, move);
  AxisValues before = way.at(0), here = before;
  AxisBox box = AxisBox::of(here);
  for (std::size_t k = 1; k < places.size(); ++k) {
    const AxisValues next = way.at(places[k]);
    box.include(AxisBox::of(next));
    for (std::size_t i = 0; k > 1 && i < here.size(); ++i) {
      if (here[i] > before[i] && here[i] >= next[i])
        box.high[i] = std::max(box.high[i], hilltop(way, i, 1, places[k - 2], places[k]));
      if (here[i] < before[i] && here[i] <= next[i])
        box.low[i] = std::min(box.low[i], -hilltop(way, i, -1, places[k - 2], places[k]));
    }
    before = here;
    here = next;
  }
  return box;
}

}  // namespace trunnion::channel_setup
