// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/contour_check.hpp"

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
  piece.sequence = command.sequence;
  piece.size =
      std::max(distance(end_, command.target, language::X), distance(end_, command.target, language::A));
  for (const auto axis : {language::A, language::B, language::C})
    piece.turns = piece.turns || piece.start[axis] != piece.target[axis];
  if (command.kind == CommandKind::arc) {
    piece.circle = circle_of(piece, command.arc);
    const double radius = std::max(piece.circle->radius, piece.circle->radius + piece.circle->growth);
    piece.size = std::max(piece.size, radius * std::abs(piece.circle->sweep));
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

ContourCheck::Circle ContourCheck::circle_of(const Piece& piece, const language::Arc& arc) {
  static constexpr std::array<std::array<std::size_t, 2>, 3> planes{{{0, 1}, {2, 0}, {1, 2}}};
  Circle c;
  c.u = planes[static_cast<std::size_t>(arc.plane)][0];
  c.v = planes[static_cast<std::size_t>(arc.plane)][1];
  c.normal = 3 - c.u - c.v;
  c.centre_u = arc.centre[c.u], c.centre_v = arc.centre[c.v];
  const double du = piece.start[c.u] - c.centre_u, dv = piece.start[c.v] - c.centre_v;
  c.radius = std::hypot(du, dv);
  c.growth = std::hypot(piece.target[c.u] - c.centre_u, piece.target[c.v] - c.centre_v) - c.radius;
  c.angle = std::atan2(dv, du);
  c.sweep = arc.sweep * (std::numbers::pi / 180) * (arc.clockwise ? -1 : 1);
  return c;
}

// The point of the piece at f in 0..1 of its angle or length; radii that differ are joined linearly.
AxisValues ContourCheck::at(const Piece& piece, double f) const {
  AxisValues p{};
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = piece.start[i] + f * (piece.target[i] - piece.start[i]);
  if (!piece.circle) return p;
  const Circle& c = *piece.circle;
  const double angle = c.angle + f * c.sweep, r = c.radius + f * c.growth;
  p[c.u] = c.centre_u + r * std::cos(angle);
  p[c.v] = c.centre_v + r * std::sin(angle);
  return p;
}

double ContourCheck::weigh(const Piece& piece, double f, const AxisValues& position,
                           Deviation& deviation) const {
  const AxisValues p = at(piece, f);
  deviation = {distance(p, position, language::X), distance(p, position, language::A)};
  return std::max(deviation.contour / contour_tolerance_, deviation.orientation / orientation_tolerance_);
}

// Both distances are convex along a line, and near the nearest point of an arc, so the golden section finds
// the least of the larger one.
double ContourCheck::search(const Piece& piece, double low, double high, const AxisValues& position,
                            Deviation& deviation) const {
  constexpr double golden = 0.6180339887498949;
  Deviation ignored;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = weigh(piece, a, position, ignored), at_b = weigh(piece, b, position, ignored);
  for (int k = 0; k < 100 && (high - low) * piece.size > 1e-10; ++k) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low);
      at_a = weigh(piece, a, position, ignored);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low);
      at_b = weigh(piece, b, position, ignored);
    }
  }
  return weigh(piece, (low + high) / 2, position, deviation);
}

// Without a change of orientation only the distance counts: the foot of the perpendicular.
double ContourCheck::foot_on_line(const Piece& piece, const AxisValues& position) {
  double along = 0, square = 0;
  for (std::size_t i = language::X; i <= language::Z; ++i) {
    const double d = piece.target[i] - piece.start[i];
    along += d * (position[i] - piece.start[i]);
    square += d * d;
  }
  return square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
}

// Newton's method on the derivative of the squared distance from a place nearby; it is smooth in f.
double ContourCheck::foot_on_arc(const Piece& piece, double f, const AxisValues& position) const {
  const Circle& c = *piece.circle;
  const double rise = piece.target[c.normal] - piece.start[c.normal];
  for (int k = 0; k < 20; ++k) {
    const double angle = c.angle + f * c.sweep, r = c.radius + f * c.growth;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double u = c.centre_u + r * cosine - position[c.u], v = c.centre_v + r * sine - position[c.v];
    const double w = piece.start[c.normal] + f * rise - position[c.normal];
    // First and second derivatives by f of a point at radius r(f) and angle(f).
    const double radial = c.growth, around = r * c.sweep;
    const double du = radial * cosine - around * sine, dv = radial * sine + around * cosine;
    const double radial2 = -r * c.sweep * c.sweep, around2 = 2 * c.growth * c.sweep;
    const double ddu = radial2 * cosine - around2 * sine, ddv = radial2 * sine + around2 * cosine;
    const double slope = u * du + v * dv + w * rise;
    const double bend = du * du + dv * dv + rise * rise + u * ddu + v * ddv;
    if (!(bend > 0)) break;  // farther than the centre: the candidate itself is as good
    const double next = std::clamp(f - slope / bend, 0.0, 1.0);
    const double step = std::abs(next - f) * piece.size;
    f = next;
    if (step < 1e-12) break;
  }
  return f;
}

// The nearest place of an arc is at an end, or near one where it has the angle of the position.
double ContourCheck::search_arc(const Piece& piece, const AxisValues& position, Deviation& deviation) const {
  const Circle& c = *piece.circle;
  double least = 1e300;
  const auto consider = [&](double f) {
    Deviation found;
    double w = weigh(piece, f, position, found);
    if (w < least) least = w, deviation = found;
    if (piece.turns) {
      const double half = 3 * (std::numbers::pi / 180) / std::max(std::abs(c.sweep), 1e-9);
      w = search(piece, std::max(0.0, f - half), std::min(1.0, f + half), position, found);
    } else {
      w = weigh(piece, foot_on_arc(piece, f, position), position, found);
    }
    if (w < least) least = w, deviation = found;
  };
  consider(0);
  consider(1);
  const double turn = 2 * std::numbers::pi;
  const double total = std::abs(c.sweep);
  double angle = std::atan2(position[c.v] - c.centre_v, position[c.u] - c.centre_u) - c.angle;
  if (c.sweep < 0) angle = -angle;
  angle -= turn * std::floor(angle / turn);
  // Of many turns those next to the height count, of a flat spiral those next to the radius.
  const double rise = piece.target[c.normal] - piece.start[c.normal];
  const double rho = std::hypot(position[c.u] - c.centre_u, position[c.v] - c.centre_v);
  const double share = std::abs(rise) > std::abs(c.growth)
                           ? (position[c.normal] - piece.start[c.normal]) / rise
                       : c.growth != 0 ? (rho - c.radius) / c.growth
                                       : 0;
  const double near = std::round((std::clamp(share, 0.0, 1.0) * total - angle) / turn);
  for (double k = std::max(0.0, near - 1); k <= near + 1; ++k)
    if (angle + k * turn <= total) consider((angle + k * turn) / total);
  return least;
}

double ContourCheck::search(const Piece& piece, const AxisValues& position, Deviation& deviation) const {
  if (piece.circle) return search_arc(piece, position, deviation);
  if (piece.turns) return search(piece, 0, 1, position, deviation);
  return weigh(piece, foot_on_line(piece, position), position, deviation);
}

// The contour deviation is at least this: no point of the piece is nearer.
double ContourCheck::nearest_possible(const Piece& piece, const AxisValues& position) {
  if (!piece.circle) return distance(piece.start, position, language::X) - piece.size;
  const Circle& c = *piece.circle;
  const double rho = std::hypot(position[c.u] - c.centre_u, position[c.v] - c.centre_v);
  const auto [inner, outer] = std::minmax({c.radius, c.radius + c.growth});
  const auto [bottom, top] = std::minmax({piece.start[c.normal], piece.target[c.normal]});
  const double height = position[c.normal];
  return std::max({inner - rho, rho - outer, bottom - height, height - top});
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
    if (nearest_possible(piece, position) / contour_tolerance_ > least) return;
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
