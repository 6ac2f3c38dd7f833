// SPDX-License-Identifier: Apache-2.0
#include "analysis/contour_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::analysis {
namespace {

constexpr std::size_t fewest_forgotten = 20000;

double distance(const AxisValues& a, const AxisValues& b, std::size_t first) {
  return std::hypot(a[first] - b[first], a[first + 1] - b[first + 1], a[first + 2] - b[first + 2]);
}

}  // namespace

ContourCheck::ContourCheck(const AxisValues& start, double contour_tolerance, double orientation_tolerance)
    : end_(start),
      contour_tolerance_(std::max(contour_tolerance, 1e-6)),
      orientation_tolerance_(std::max(orientation_tolerance, 1e-6)) {}

void ContourCheck::add(const language::Command& command) {
  using language::CommandKind;
  if (command.kind != CommandKind::rapid && command.kind != CommandKind::line &&
      command.kind != CommandKind::arc)
    return;
  Piece piece;
  piece.start = end_;
  piece.target = command.target;
  piece.arc = command.arc;
  piece.is_arc = command.kind == CommandKind::arc;
  piece.sequence = command.sequence;
  piece.size =
      std::max(distance(end_, command.target, language::X), distance(end_, command.target, language::A));
  if (piece.is_arc) {
    const double radius = std::hypot(end_[0] - command.arc.centre[0], end_[1] - command.arc.centre[1],
                                     end_[2] - command.arc.centre[2]);
    piece.size = std::max(piece.size, radius * command.arc.sweep * (std::numbers::pi / 180));
  }
  pieces_.push_back(piece);
  end_ = command.target;
}

void ContourCheck::forget(std::uint32_t sequence, double reach) {
  if (pieces_.size() < 2 * kept_ || pieces_.size() < fewest_forgotten) return;
  const auto found = std::lower_bound(pieces_.begin(), pieces_.end(), sequence,
                                      [](const Piece& p, std::uint32_t s) { return p.sequence < s; });
  auto first = found;
  for (double passed = 0; first != pieces_.begin() && passed < reach;) {
    --first;
    passed += first->size;
  }
  pieces_.erase(pieces_.begin(), first);
  kept_ = pieces_.size();
}

// The point of the piece at f in 0..1 of its angle or length; radii that differ are joined linearly.
AxisValues ContourCheck::at(const Piece& piece, double f) const {
  AxisValues p{};
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = piece.start[i] + f * (piece.target[i] - piece.start[i]);
  if (!piece.is_arc) return p;
  static constexpr std::array<std::array<std::size_t, 2>, 3> planes{{{0, 1}, {2, 0}, {1, 2}}};
  const auto [u, v] = planes[static_cast<std::size_t>(piece.arc.plane)];
  const double cu = piece.arc.centre[u], cv = piece.arc.centre[v];
  const double r0 = std::hypot(piece.start[u] - cu, piece.start[v] - cv);
  const double r1 = std::hypot(piece.target[u] - cu, piece.target[v] - cv);
  const double sweep = piece.arc.sweep * (std::numbers::pi / 180) * (piece.arc.clockwise ? -1 : 1);
  const double angle = std::atan2(piece.start[v] - cv, piece.start[u] - cu) + f * sweep;
  const double r = r0 + f * (r1 - r0);
  p[u] = cu + r * std::cos(angle);
  p[v] = cv + r * std::sin(angle);
  return p;
}

double ContourCheck::weigh(const Piece& piece, double f, const AxisValues& position,
                           Deviation& deviation) const {
  const AxisValues p = at(piece, f);
  deviation = {distance(p, position, language::X), distance(p, position, language::A)};
  return std::max(deviation.contour / contour_tolerance_, deviation.orientation / orientation_tolerance_);
}

// Both distances are convex along a line, so thirds find the least of the larger one.
double ContourCheck::search(const Piece& piece, double low, double high, const AxisValues& position,
                            Deviation& deviation) const {
  Deviation ignored;
  for (int k = 0; k < 60 && (high - low) * piece.size > 1e-10; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (weigh(piece, a, position, ignored) < weigh(piece, b, position, ignored))
      high = b;
    else
      low = a;
  }
  return weigh(piece, (low + high) / 2, position, deviation);
}

// An arc is cut into parts of a few degrees first. A full circle begins where it ends, so both ends are
// looked at.
double ContourCheck::search(const Piece& piece, const AxisValues& position, Deviation& deviation) const {
  if (!piece.is_arc) return search(piece, 0, 1, position, deviation);
  const int parts = static_cast<int>(std::clamp(piece.arc.sweep / 3, 4.0, 4000.0));
  double best = 1e300;
  int best_part = 0;
  for (int k = 0; k <= parts; ++k) {
    Deviation ignored;
    const double w = weigh(piece, static_cast<double>(k) / parts, position, ignored);
    if (w < best) best = w, best_part = k;
  }
  const auto around = [&](int part, Deviation& found) {
    return search(piece, std::max(0.0, (part - 1.0) / parts), std::min(1.0, (part + 1.0) / parts), position,
                  found);
  };
  const double least = around(best_part, deviation);
  if (best_part != 0 && best_part != parts) return least;
  Deviation other;
  const double at_other_end = around(parts - best_part, other);
  if (at_other_end < least) deviation = other;
  return std::min(least, at_other_end);
}

Deviation ContourCheck::of(const AxisValues& position, std::uint32_t sequence, double reach) const {
  Deviation best;
  if (pieces_.empty()) return best;
  const auto found = std::lower_bound(pieces_.begin(), pieces_.end(), sequence,
                                      [](const Piece& p, std::uint32_t s) { return p.sequence < s; });
  const auto centre =
      std::min<std::ptrdiff_t>(found - pieces_.begin(), static_cast<std::ptrdiff_t>(pieces_.size()) - 1);
  double least = 1e300;
  const auto look = [&](std::ptrdiff_t k) {
    Deviation deviation;
    const Piece& piece = pieces_[static_cast<std::size_t>(k)];
    // A piece that is farther away than the best found cannot be nearer.
    if (!piece.is_arc &&
        (distance(piece.start, position, language::X) - piece.size) / contour_tolerance_ > least)
      return;
    const double w = search(piece, position, deviation);
    if (w < least) least = w, best = deviation;
  };
  look(centre);
  double passed = 0;
  for (auto k = centre - 1; k >= 0 && passed < reach; --k) {
    look(k);
    passed += pieces_[static_cast<std::size_t>(k)].size;
  }
  passed = 0;
  for (auto k = centre + 1; k < static_cast<std::ptrdiff_t>(pieces_.size()) && passed < reach; ++k) {
    look(k);
    passed += pieces_[static_cast<std::size_t>(k)].size;
  }
  return best;
}

}  // namespace trunnion::analysis
