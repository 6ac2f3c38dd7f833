// SPDX-License-Identifier: Apache-2.0
#include "geometry/orientation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/angle.hpp"

namespace trunnion::geometry {
namespace {

constexpr double degrees_per_radian = 1 / radians_per_degree;
// Closer than this (sine) to an axis a direction has no azimuth about it.
constexpr double no_azimuth = 1e-13;
// Degrees: limits are kept, and travels are equal, within this.
constexpr double slack = 1e-9;

Vec3 turned(const Vec3& k, double sine, double cosine, const Vec3& v) {
  return cosine * v + sine * k.cross(v) + ((1 - cosine) * k.dot(v)) * k;
}

// The angle in degrees about k from one vector to another, given as k x v each: so that nothing cancels when
// both are near k.
double azimuth(const Vec3& k, const Vec3& from, const Vec3& to) {
  return degrees_per_radian * arc_tangent(k.dot(from.cross(to)), from.dot(to));
}

// The position nearest to `present` that is `angle` plus full turns and within the travel; of two equally
// near ones the greater.
bool nearest_turn(double angle, double present, const AngleTravel& travel, double& position) {
  position = angle + 360 * std::floor((present + 180 - angle) / 360 + 1e-12);
  if (position > travel.positive + slack)
    position -= 360 * std::ceil((position - travel.positive - slack) / 360);
  else if (position < travel.negative - slack)
    position += 360 * std::ceil((travel.negative - slack - position) / 360);
  return position >= travel.negative - slack && position <= travel.positive + slack;
}

// The same, but never against the sense (+1 or -1).
bool next_turn(double angle, double present, int sense, const AngleTravel& travel, double& position) {
  const double rotation = std::ceil((sense * (present - angle) - slack) / 360) * 360;
  position = angle + sense * rotation;
  if (sense > 0 && position < travel.negative - slack)
    position += 360 * std::ceil((travel.negative - slack - position) / 360);
  if (sense < 0 && position > travel.positive + slack)
    position -= 360 * std::ceil((position - travel.positive - slack) / 360);
  return position >= travel.negative - slack && position <= travel.positive + slack;
}

// Of a leading axis with `sense` +1 or -1, or 0 for any.
bool leading_turn(double angle, double present, int sense, AngleTravel travel, double& position) {
  if (sense != 0 && travel.endless()) return next_turn(angle, present, sense, travel, position);
  if (sense > 0) travel.negative = std::max(travel.negative, 0.0);
  if (sense < 0) travel.positive = std::min(travel.positive, 0.0);
  return nearest_turn(angle, present, travel, position);
}

int sense_of(SolutionChoice choice) {
  return choice == SolutionChoice::positive ? 1 : choice == SolutionChoice::negative ? -1 : 0;
}

// Smaller is better. Travels are counted in whole steps, so that rounding never decides between equal ones.
using Rank = std::tuple<long long, long long, long long, long long>;

Rank rank_of(const Orientation& o, const OrientationRequest& request, std::size_t first, std::size_t second) {
  const auto steps = [](double degrees) {
    return static_cast<long long>(degrees * 1e7 + (degrees < 0 ? -0.5 : 0.5));
  };
  const bool two = first < angle_count;
  const double leading = o.angles[second], other = two ? o.angles[first] : 0;
  const double rotation = std::abs(leading - request.present[second]);
  const double other_rotation = two ? std::abs(other - request.present[first]) : 0;
  if (request.choice == SolutionChoice::continuous)
    return {steps(rotation + other_rotation), steps(rotation), -steps(leading), -steps(other)};
  // In degrees of the leading axis.
  const double other_time = two ? other_rotation * (request.rate[second] / request.rate[first]) : 0;
  return {steps(std::max(rotation, other_time)), steps(rotation + other_time), -steps(leading),
          -steps(other)};
}

}  // namespace

OrientationSolver::OrientationSolver(const Chain& chain)
    : count_(chain.rotary_count()), tool_(chain.tool_direction()) {
  for (std::size_t i = 0; i < count_; ++i) axes_[i] = chain.orienting_axis(i);
  if (count_ >= 2) last_pair_ = pair(count_ - 2, count_ - 1, {});
}

// The vector as the axes 0 .. end - 1 carry it, of which i and j are left out.
Vec3 OrientationSolver::carried(std::size_t end, const Vec3& v, const Angles& at, std::size_t i,
                                std::size_t j) const {
  Vec3 result = v;
  while (end-- > 0) {
    if (end == i || end == j) continue;
    const auto t = sine_cosine(at[axes_[end].angle]);
    result = turned(axes_[end].direction, t.sine, t.cosine, result);
  }
  return result;
}

std::optional<MovingPair> OrientationSolver::pair(std::size_t i, std::size_t j, const Angles& present) const {
  const auto axes =
      AxisPair::make(carried(i, axes_[i].direction, present, i, j),
                     carried(j, axes_[j].direction, present, i, j), carried(count_, tool_, present, i, j));
  if (!axes) return std::nullopt;
  return MovingPair{*axes, axes_[i].angle, axes_[j].angle};
}

// Turning about k1 keeps psi, so u gives the triangle; then axis 1 turns the tool onto u.
OrientationSolver::Solutions OrientationSolver::solve(const MovingPair& pair, const Vec3& u,
                                                      const OrientationRequest& request) {
  const AxisPair& p = pair.axes;
  Solutions out;
  out.first = pair.first;
  out.second = pair.second;
  const Vec3 across = p.k1.cross(u);
  const bool has_azimuth = across.norm() > no_azimuth;
  const auto triangle = p.triangle(u, across);
  const bool reached = triangle.missed <= request.tolerance * radians_per_degree;
  const std::size_t different = triangle.two ? 2 : 1;
  for (std::size_t n = 0; n < different; ++n) {
    const double side = n == 0 ? 1 : -1;
    const Vec3 v = p.tool_at(triangle, side);
    double first = request.present[pair.first];
    const Vec3 around = p.k1.cross(v);
    if (has_azimuth && around.norm() > no_azimuth) first = azimuth(p.k1, around, across);
    if (n == 0 && !reached) {
      const auto t = sine_cosine(first);
      out.nearest = turned(p.k1, t.sine, t.cosine, v);
      return out;
    }
    Orientation& o = out.of[out.count++];
    o.angles = request.present;
    o.angles[pair.first] = first;
    o.angles[pair.second] = p.second(triangle, side);
    o.regularity = triangle.regularity;
  }
  return out;
}

OrientationSolver::Solutions OrientationSolver::solve_last(const Vec3& u,
                                                           const OrientationRequest& request) const {
  Vec3 seen = u;
  for (std::size_t i = 0; i + 2 < count_; ++i) {
    const auto t = sine_cosine(request.present[axes_[i].angle]);
    seen = turned(axes_[i].direction, -t.sine, t.cosine, seen);
  }
  Solutions out = solve(*last_pair_, seen, request);
  if (out.count == 0) out.nearest = carried(count_ - 2, out.nearest, request.present, count_, count_);
  return out;
}

OrientationSolver::Solutions OrientationSolver::solve_single(std::size_t i, const Vec3& u,
                                                             const OrientationRequest& request) const {
  const Vec3 k = carried(i, axes_[i].direction, request.present, i, i);
  const Vec3 tool = carried(count_, tool_, request.present, i, i);
  Solutions out;
  out.second = axes_[i].angle;
  const Vec3 around = k.cross(tool), across = k.cross(u);
  double angle = request.present[out.second];
  if (around.norm() > no_azimuth && across.norm() > no_azimuth) angle = azimuth(k, around, across);
  const auto t = sine_cosine(angle);
  out.nearest = turned(k, t.sine, t.cosine, tool);
  if (angle_between(out.nearest, u) <= std::max(request.tolerance * radians_per_degree, 1e-15)) {
    out.of[0] = {request.present, around.norm()};
    out.of[0].angles[out.second] = angle;
    out.count = 1;
  }
  return out;
}

template <class Visit>
OrientationAnswer OrientationSolver::search(const OrientationRequest& request, Visit&& visit) const {
  OrientationAnswer answer;
  Vec3 u = request.direction;
  const double length = u.stableNorm();
  if (!u.allFinite() || !(length > 0)) {
    answer.status = OrientationStatus::not_a_direction;
    return answer;
  }
  u /= length;
  bool tried = false, reachable = false;
  const auto take = [&](const Solutions& solutions) {
    if (!tried) answer.nearest = solutions.nearest;
    tried = true;
    reachable = reachable || solutions.count > 0;
    bool found = false;
    for (std::size_t n = 0; n < solutions.count; ++n) found = visit(solutions, n) || found;
    if (found) answer.status = OrientationStatus::found;
    return found;
  };
  if (last_pair_ && take(solve_last(u, request))) return answer;
  if (!last_pair_ || count_ > 2) {
    for (std::size_t j = count_; j-- > 1;)
      for (std::size_t i = j; i-- > 0;) {
        if (last_pair_ && i + 2 == count_) continue;
        const auto moving = pair(i, j, request.present);
        if (moving && take(solve(*moving, u, request))) return answer;
      }
    if (!tried)
      for (std::size_t i = count_; i-- > 0;)
        if (take(solve_single(i, u, request))) return answer;
    if (!tried) {
      Solutions rigid;
      rigid.nearest = tool_;
      if (angle_between(tool_, u) <= request.tolerance * radians_per_degree) {
        rigid.of[0].angles = request.present;
        rigid.count = 1;
      }
      take(rigid);
    }
  }
  if (answer.status == OrientationStatus::unreachable && reachable)
    answer.status = OrientationStatus::outside_travel;
  return answer;
}

OrientationAnswer OrientationSolver::best(const OrientationRequest& request) const {
  Orientation chosen;
  Rank chosen_rank;
  bool any = false;
  auto answer = search(request, [&](const Solutions& solutions, std::size_t n) {
    Orientation o = solutions.of[n];
    if (solutions.second < angle_count) {
      const int sense = sense_of(request.choice);
      const auto a = solutions.first, b = solutions.second;
      if (!leading_turn(o.angles[b], request.present[b], sense, request.travel[b], o.angles[b])) return false;
      if (a < angle_count && !nearest_turn(o.angles[a], request.present[a], request.travel[a], o.angles[a]))
        return false;
      const Rank rank = rank_of(o, request, a, b);
      if (any && !(rank < chosen_rank)) return true;
      chosen_rank = rank;
    }
    any = true;
    chosen = o;
    return true;
  });
  answer.best = chosen;
  return answer;
}

std::size_t OrientationSolver::all(const OrientationRequest& request, std::span<Orientation> out,
                                   OrientationAnswer& answer) const {
  std::array<Rank, most_solutions> ranks;
  const std::size_t space = std::min(out.size(), most_solutions);
  std::size_t count = 0;
  const auto insert = [&](const Orientation& o, const Rank& rank) {
    std::size_t at = count;
    while (at > 0 && rank < ranks[at - 1]) --at;
    if (at == space) return;
    if (count < space) ++count;
    for (std::size_t n = count - 1; n > at; --n) out[n] = out[n - 1], ranks[n] = ranks[n - 1];
    out[at] = o;
    ranks[at] = rank;
  };
  // Positions of one axis, at most nine.
  const auto turns = [&](std::size_t axis, double angle, int sense, std::array<double, 9>& positions) {
    const AngleTravel& travel = request.travel[axis];
    const double present = request.present[axis];
    if (travel.endless()) {
      return std::size_t{leading_turn(angle, present, sense, travel, positions[0]) ? 1u : 0u};
    }
    std::size_t n = 0;
    const double first = angle + 360 * std::ceil((travel.negative - slack - angle) / 360);
    for (double at = first; at <= travel.positive + slack && n < positions.size(); at += 360)
      if (sense * at >= -slack) positions[n++] = at;
    return n;
  };
  answer = search(request, [&](const Solutions& solutions, std::size_t n) {
    const Orientation& base = solutions.of[n];
    const auto a = solutions.first, b = solutions.second;
    if (b == angle_count) {
      insert(base, {});
      return true;
    }
    std::array<double, 9> leading, other{};
    const std::size_t leading_count = turns(b, base.angles[b], sense_of(request.choice), leading);
    const std::size_t other_count = a < angle_count ? turns(a, base.angles[a], 0, other) : 1;
    for (std::size_t l = 0; l < leading_count; ++l)
      for (std::size_t m = 0; m < other_count; ++m) {
        Orientation o = base;
        o.angles[b] = leading[l];
        if (a < angle_count) o.angles[a] = other[m];
        insert(o, rank_of(o, request, a, b));
      }
    return leading_count * other_count > 0;
  });
  if (count > 0) answer.best = out[0];
  return count;
}

}  // namespace trunnion::geometry
