// SPDX-License-Identifier: Apache-2.0
#include "geometry/direction_path.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/angle.hpp"

namespace trunnion::geometry {
namespace {

constexpr double least_sine = 1e-9;
constexpr double travel_slack = 1e-6;  // degrees

double full_turns(double degrees) { return 360 * std::round(degrees / 360); }

// Brings an angle that may have any full turns within the travel, as near to `present` as that allows.
bool near_within(double present, const AngleTravel& travel, double& angle) {
  angle += full_turns(present - angle);
  if (angle > travel.positive + travel_slack)
    angle -= 360 * std::ceil((angle - travel.positive - travel_slack) / 360);
  else if (angle < travel.negative - travel_slack)
    angle += 360 * std::ceil((travel.negative - travel_slack - angle) / 360);
  return angle >= travel.negative - travel_slack && angle <= travel.positive + travel_slack;
}

DirectionPathFault fault_of(const OrientationAnswer& answer, double s) {
  const bool travel = answer.status == OrientationStatus::outside_travel;
  return {travel ? DirectionPathFault::outside_travel : DirectionPathFault::unreachable, s, answer.nearest};
}

// The angle in degrees about k between two vectors across it.
double angle_across(const Vec3& k, const Vec3& from, const Vec3& to) {
  return arc_tangent(k.dot(from.cross(to)), from.dot(to)) / radians_per_degree;
}

// Value and derivatives of order 1 and 2 at both ends of 0 .. 1.
std::array<double, 6> quintic(double p0, double v0, double a0, double p1, double v1, double a1) {
  const double d = p1 - p0;
  return {p0,
          v0,
          a0 / 2,
          10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1,
          -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1,
          6 * d - 3 * v0 - 3 * v1 - 0.5 * a0 + 0.5 * a1};
}

}  // namespace

std::variant<DirectionPath, DirectionPathFault> DirectionPath::make(const OrientationSolver& solver,
                                                                    const DirectionPathRequest& request) {
  const auto arc = DirectionArc::make(request.from, request.to);
  if (!arc) {
    const bool both = request.from.allFinite() && request.to.allFinite() && !request.from.isZero(0) &&
                      !request.to.isZero(0);
    return DirectionPathFault{both ? DirectionPathFault::opposite : DirectionPathFault::not_a_direction, 0,
                              Vec3::UnitZ()};
  }
  std::optional<DirectionPathFault> fault;
  const auto attempt = [&](auto&& method) -> std::optional<DirectionPath> {
    DirectionPath path(*arc, request.present);
    const auto found = method(path);
    if (!found) return path;
    if (!fault) fault = found;
    return std::nullopt;
  };
  if (arc->length() < 1e-12) {
    if (auto path = attempt([&](DirectionPath& p) { return p.keep_direction(solver, request); }))
      return *path;
    return *fault;
  }
  for (std::size_t j = solver.axis_count(); j-- > 1;)
    for (std::size_t i = j; i-- > 0;)
      if (const auto pair = solver.pair(i, j, request.present))
        if (auto path = attempt([&](DirectionPath& p) { return p.turn_two(*pair, request); })) return *path;
  if (!fault)
    if (auto path = attempt([&](DirectionPath& p) { return p.turn_one(solver, request); })) return *path;
  return *fault;
}

std::optional<DirectionPathFault> DirectionPath::keep_direction(const OrientationSolver& solver,
                                                                const DirectionPathRequest& request) {
  const auto answer = solver.best(
      {request.from, request.present, request.travel, SolutionChoice::continuous, request.tolerance});
  if (answer.status != OrientationStatus::found) return fault_of(answer, 0);
  present_ = answer.best.angles;
  return std::nullopt;
}

// One axis follows a great circle only across itself.
std::optional<DirectionPathFault> DirectionPath::turn_one(const OrientationSolver& solver,
                                                          const DirectionPathRequest& request) {
  OrientationRequest at{request.from, request.present, request.travel, SolutionChoice::continuous,
                        request.tolerance};
  std::array<Angles, 3> angles{};
  for (std::size_t n = 0; n < angles.size(); ++n) {
    const double s = 0.5 * static_cast<double>(n);
    at.direction = arc_.at(s);
    const auto answer = solver.best(at);
    if (answer.status != OrientationStatus::found) return fault_of(answer, s);
    angles[n] = at.present = answer.best.angles;
  }
  present_ = angles[0];
  for (std::size_t axis = 0; axis < angle_count; ++axis) {
    if (angles[0][axis] == angles[2][axis]) continue;
    Piece& piece = pieces_[count_++];
    piece.window = true;
    pair_.second = axis;
    piece.polynomial[1] = {angles[0][axis], angles[2][axis] - angles[0][axis]};
    break;
  }
  return std::nullopt;
}

// Where the great circle is nearest to (sign 1) or farthest from (sign -1) the direction of axis 1.
double DirectionPath::foot(double sign) const {
  const Vec3& k = pair_.axes.k1;
  return arc_tangent(sign * k.dot(arc_.across()), sign * k.dot(arc_.from())) / arc_.length();
}

bool DirectionPath::has_pole(double sign, double tolerance) const {
  const AxisPair& p = pair_.axes;
  return std::abs(sign > 0 ? p.alpha - p.beta : std::numbers::pi - p.alpha - p.beta) <= tolerance;
}

std::optional<DirectionPathFault> DirectionPath::check_directions(const DirectionPathRequest& request) const {
  const double tolerance = request.tolerance * radians_per_degree;
  for (const double place : {0.0, 1.0, foot(1), foot(-1)}) {
    if (place < 0 || place > 1) continue;
    const Vec3 u = arc_.at(place);
    const auto triangle = pair_.axes.triangle(u, pair_.axes.k1.cross(u));
    if (triangle.missed <= tolerance) continue;
    Piece piece;
    piece.begin = place;
    const auto at = on_arc(piece, place);
    return DirectionPathFault{DirectionPathFault::unreachable, place, pair_.axes.direction(at[0], at[1])};
  }
  if (!request.avoid_poles) return std::nullopt;
  for (const double sign : {1.0, -1.0}) {
    if (!has_pole(sign, tolerance)) continue;
    const double place = std::clamp(foot(sign), 0.0, 1.0);
    if (angle_between(arc_.at(place), Vec3(sign * pair_.axes.k1)) < request.pole_range * radians_per_degree)
      return DirectionPathFault{DirectionPathFault::pole, place, Vec3::UnitZ()};
  }
  return std::nullopt;
}

// k1 x u; where u is k1, that of the path to or from there.
Vec3 DirectionPath::across(double s) const {
  const auto u = arc_.derivatives(s);
  const Vec3 c = pair_.axes.k1.cross(u[0]);
  if (c.norm() > least_sine) return c;
  return (s < 0.5 ? 1 : -1) * pair_.axes.k1.cross(u[1]);
}

// k1 x the tool turned by axis 2 alone; where that is k1, of the path there.
Vec3 DirectionPath::around(const AxisPair::Triangle& triangle, double side) const {
  const Vec3 a = pair_.axes.k1.cross(pair_.axes.tool_at(triangle, side));
  return a.norm() > least_sine ? a : Vec3(side * pair_.axes.k1.cross(pair_.axes.g));
}

// Axis 1 turns the tool's azimuth about k1 onto that of u. Along a great circle the azimuth of u changes by
// less than half a turn, that of the tool stays within a quarter of the azimuth of side * g: so the change
// since the beginning of the piece is known without counting turns.
DirectionPath::Two DirectionPath::on_arc(const Piece& piece, double s) const {
  const AxisPair& p = pair_.axes;
  const auto triangle_at = [&](double at) {
    const Vec3 u = arc_.at(at);
    return p.triangle(u, p.k1.cross(u));
  };
  const auto triangle = triangle_at(s);
  const Vec3 u_now = across(s), u_begin = across(piece.begin);
  const Vec3 v_now = around(triangle, piece.side), v_begin = around(triangle_at(piece.begin), piece.side);
  const Vec3 middle = piece.side * p.k1.cross(p.g);
  const double change = angle_across(p.k1, u_begin, u_now) - angle_across(p.k1, middle, v_now) +
                        angle_across(p.k1, middle, v_begin);
  const double first = angle_across(p.k1, v_now, u_now);
  return {first + full_turns(piece.first + change - first), p.second(triangle, piece.side) + piece.turn};
}

bool DirectionPath::start_at(double side, const DirectionPathRequest& request, Piece& piece) const {
  piece = {};
  piece.side = side;
  const auto plain = on_arc(piece, 0);
  double first = plain[0], second = plain[1];
  const bool fits = near_within(request.present[pair_.first], request.travel[pair_.first], first) &&
                    near_within(request.present[pair_.second], request.travel[pair_.second], second);
  piece.first = first;
  piece.turn = full_turns(second - plain[1]);
  return fits;
}

std::optional<DirectionPathFault> DirectionPath::turn_two(const MovingPair& pair,
                                                          const DirectionPathRequest& request) {
  pair_ = pair;
  if (const auto fault = check_directions(request)) return fault;
  std::array<Piece, 2> starts;
  std::array<double, 2> rotation{};
  for (std::size_t n = 0; n < 2; ++n) {
    const bool fits = start_at(n == 0 ? 1 : -1, request, starts[n]);
    const auto at = on_arc(starts[n], 0);
    rotation[n] =
        std::abs(at[0] - request.present[pair_.first]) + std::abs(at[1] - request.present[pair_.second]);
    // A solution that starts outside the travel is tried last, to report the fault.
    if (!fits) rotation[n] += 1e6;
  }
  const std::size_t nearer = rotation[1] < rotation[0] - 1e-7 ? 1 : 0;
  std::optional<DirectionPathFault> fault;
  for (const std::size_t n : {nearer, 1 - nearer}) {
    build(starts[n], request);
    const auto place = outside(request);
    if (!place) return std::nullopt;
    if (!fault) fault = DirectionPathFault{DirectionPathFault::outside_travel, *place, Vec3::UnitZ()};
  }
  return fault;
}

void DirectionPath::build(const Piece& start, const DirectionPathRequest& request) {
  const double tolerance = request.tolerance * radians_per_degree;
  count_ = 1;
  pieces_[0] = start;
  // A pole comes at most once on less than half a great circle, the nearer one first.
  const double nearer = foot(1) <= foot(-1) ? 1 : -1;
  for (const double sign : {nearer, -nearer}) {
    if (!has_pole(sign, tolerance)) continue;
    const double s = foot(sign), place = std::clamp(s, 0.0, 1.0);
    const double closest = angle_between(arc_.at(place), Vec3(sign * pair_.axes.k1));
    if (closest >= tolerance || (closest < least_sine && (place == 0 || place == 1))) continue;
    const double passing = angle_between(arc_.at(s), Vec3(sign * pair_.axes.k1));
    // As far to either side as makes the axis turn about as fast as the direction, if the tolerance allows.
    double range = std::max({std::sqrt(passing), 2 * closest, 0.5 * radians_per_degree});
    for (int attempt = 0; attempt < 12 && range > 1.01 * closest; ++attempt, range /= 2) {
      // Pythagoras on the sphere.
      const double share = std::min(1.0, sine_cosine(range / radians_per_degree).cosine /
                                             sine_cosine(passing / radians_per_degree).cosine);
      const double half = arc_tangent(std::sqrt((1 - share) * (1 + share)), share) / arc_.length();
      const double begin = std::max(pieces_[count_ - 1].begin, s - half), end = std::min(1.0, s + half);
      if (end > begin && add_window(begin, end, request.tolerance)) break;
    }
  }
}

// Replaces the end of the last piece, which is on the great circle, by a window and what follows it.
bool DirectionPath::add_window(double begin, double end, double tolerance) {
  Piece before = pieces_[count_ - 1];
  if (before.window) return false;
  before.end = begin;
  const auto leaving = rates(before, begin);
  Piece after;
  std::array<Two, 4> arriving{};
  double least = std::numeric_limits<double>::infinity();
  for (const double side : {before.side, -before.side}) {
    Piece next;
    next.begin = end;
    next.side = side;
    auto at = on_arc(next, end);
    next.first = at[0] + full_turns(leaving[0][0] - at[0]);
    next.turn = full_turns(leaving[0][1] - at[1]);
    const auto values = rates(next, end);
    const double rotation = std::abs(values[0][0] - leaving[0][0]) + std::abs(values[0][1] - leaving[0][1]);
    if (rotation >= least) continue;
    least = rotation;
    after = next;
    arriving = values;
  }
  Piece window;
  window.window = true;
  window.begin = begin;
  window.end = end;
  const double h = end - begin;
  for (std::size_t n = 0; n < 2; ++n) {
    // At an end of the path there is no neighbour to agree with.
    const double even = (arriving[0][n] - leaving[0][n]) / h;
    const bool first = begin <= 0, last = end >= 1;
    window.polynomial[n] =
        quintic(leaving[0][n], h * (first ? even : leaving[1][n]), first ? 0 : h * h * leaving[2][n],
                arriving[0][n], h * (last ? even : arriving[1][n]), last ? 0 : h * h * arriving[2][n]);
  }
  constexpr int places = 64;
  for (int n = 0; n <= places; ++n) {
    const double s = begin + h * n / places;
    const auto at = positions(window, s);
    if (!(angle_between(pair_.axes.direction(at[0], at[1]), arc_.at(s)) <= tolerance * radians_per_degree))
      return false;
  }
  if (begin > before.begin)
    pieces_[count_ - 1] = before;
  else
    --count_;
  pieces_[count_++] = window;
  if (end < 1) pieces_[count_++] = after;
  return true;
}

std::optional<double> DirectionPath::outside(const DirectionPathRequest& request) const {
  const auto beyond = [&](double s) {
    const auto at = angles(s);
    for (const auto axis : {pair_.first, pair_.second})
      if (!(at[axis] >= request.travel[axis].negative - travel_slack &&
            at[axis] <= request.travel[axis].positive + travel_slack))
        return true;
    return false;
  };
  // Every degree of direction, at least: short lines are many.
  const int places = static_cast<int>(std::clamp(std::ceil(arc_.length() / radians_per_degree), 4.0, 64.0));
  for (int n = 0; n <= places; ++n)
    if (const double s = static_cast<double>(n) / places; beyond(s)) return s;
  for (const double s : {foot(1), foot(-1)})
    if (s > 0 && s < 1 && beyond(s)) return s;
  for (std::size_t n = 0; n < count_; ++n)
    if (beyond(pieces_[n].end)) return pieces_[n].end;
  return std::nullopt;
}

const DirectionPath::Piece& DirectionPath::piece_at(double s) const {
  std::size_t n = 0;
  while (n + 1 < count_ && s > pieces_[n].end) ++n;
  return pieces_[n];
}

DirectionPath::Two DirectionPath::positions(const Piece& piece, double s) const {
  if (!piece.window) return on_arc(piece, s);
  const double t = (s - piece.begin) / (piece.end - piece.begin);
  Two result;
  for (std::size_t n = 0; n < 2; ++n) {
    const auto& c = piece.polynomial[n];
    result[n] = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))));
  }
  return result;
}

std::array<DirectionPath::Two, 4> DirectionPath::rates(const Piece& piece, double s) const {
  std::array<Two, 4> result;
  result[0] = positions(piece, s);
  if (!piece.window) {
    const auto d = pair_.axes.derivatives(arc_.derivatives(s), result[0][0]);
    std::copy(d.begin(), d.end(), result.begin() + 1);
    return result;
  }
  const double h = piece.end - piece.begin, t = (s - piece.begin) / h;
  for (std::size_t n = 0; n < 2; ++n) {
    const auto& c = piece.polynomial[n];
    result[1][n] = (c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))) / h;
    result[2][n] = (2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))) / (h * h);
    result[3][n] = (6 * c[3] + t * (24 * c[4] + t * 60 * c[5])) / (h * h * h);
  }
  return result;
}

Angles DirectionPath::with(const Two& positions) const {
  Angles result = present_;
  if (pair_.first < angle_count) result[pair_.first] = positions[0];
  if (pair_.second < angle_count) result[pair_.second] = positions[1];
  return result;
}

Angles DirectionPath::angles(double s) const {
  if (count_ == 0) return present_;
  s = std::clamp(s, 0.0, 1.0);
  return with(positions(piece_at(s), s));
}

std::array<Angles, 4> DirectionPath::derivatives(double s) const {
  std::array<Angles, 4> result{};
  result[0] = present_;
  if (count_ == 0) return result;
  s = std::clamp(s, 0.0, 1.0);
  const auto values = rates(piece_at(s), s);
  result[0] = with(values[0]);
  for (std::size_t n = 1; n < 4; ++n) {
    if (pair_.first < angle_count) result[n][pair_.first] = values[n][0];
    if (pair_.second < angle_count) result[n][pair_.second] = values[n][1];
  }
  return result;
}

std::size_t DirectionPath::windows() const {
  std::size_t count = 0;
  for (std::size_t n = 0; n < count_; ++n)
    if (pieces_[n].window && pair_.first < angle_count) ++count;
  return count;
}

// A piece is farthest from the path about its middle, or where its halves' middles are when it bends twice.
std::uint32_t DirectionPath::pieces(const Chain& chain, double deviation, std::uint32_t most) const {
  const auto fits = [&](std::uint32_t count) {
    Angles low = angles(0);
    for (std::uint32_t n = 0; n < count; ++n) {
      const double begin = static_cast<double>(n) / count, h = 1.0 / count;
      const Angles high = angles(begin + h);
      for (const double share : {0.25, 0.5, 0.75}) {
        Angles straight = low;
        for (std::size_t i = 0; i < angle_count; ++i) straight[i] += share * (high[i] - low[i]);
        const Vec3 meant = chain.tool_direction_in_workpiece(angles(begin + share * h));
        if (angle_between(chain.tool_direction_in_workpiece(straight), meant) >
            deviation * radians_per_degree)
          return false;
      }
      low = high;
    }
    return true;
  };
  std::uint32_t count = 1;
  while (count < most && !fits(count)) count *= 2;
  return count;
}

}  // namespace trunnion::geometry
