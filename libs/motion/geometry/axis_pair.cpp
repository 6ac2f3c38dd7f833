// SPDX-License-Identifier: Apache-2.0
#include "geometry/axis_pair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"
#include "geometry/chain.hpp"

namespace trunnion::geometry {

std::optional<AxisPair> AxisPair::make(const Vec3& k1, const Vec3& k2, const Vec3& tool) {
  const Vec3 normal = k2.cross(k1);
  if (normal.norm() < parallel_sine || k2.cross(tool).norm() < parallel_sine) return std::nullopt;
  AxisPair pair;
  pair.k1 = k1;
  pair.k2 = k2;
  pair.g = normal.normalized();
  pair.f = pair.g.cross(k2);
  pair.alpha = angle_between(k1, k2);
  pair.beta = angle_between(tool, k2);
  pair.sine_beta = k2.cross(tool).norm();
  pair.cosine_beta = k2.dot(tool);
  const auto sum = sine_cosine(0.5 * (pair.alpha + pair.beta) / radians_per_degree);
  const auto difference = sine_cosine(0.5 * (pair.alpha - pair.beta) / radians_per_degree);
  pair.sine_half_sum = sum.sine;
  pair.cosine_half_sum = sum.cosine;
  pair.sine_half_difference = difference.sine;
  pair.cosine_half_difference = difference.cosine;
  pair.zero = arc_tangent(pair.g.dot(tool), pair.f.dot(tool));
  return pair;
}

// Half-angle formulae of the spherical triangle, with psi between k1 and u:
//   sin^2(x/2) = S / (sin alpha sin beta), S = sin((psi + (alpha - beta))/2) sin((psi - (alpha - beta))/2)
//   cos^2(x/2) = C / (sin alpha sin beta), C = sin((alpha + beta + psi)/2) sin((alpha + beta - psi)/2)
// and S + C = sin alpha sin beta. The sines are those of sums with psi/2, whose own come without an arc.
AxisPair::Triangle AxisPair::triangle(const Vec3& u, const Vec3& across) const {
  const double sine = across.norm(), cosine = k1.dot(u);
  const double larger = std::sqrt(0.5 * (1 + std::abs(cosine))), smaller = 0.5 * sine / larger;
  const double sine_half = cosine >= 0 ? smaller : larger, cosine_half = cosine >= 0 ? larger : smaller;
  const double p = sine_half * cosine_half_difference, q = cosine_half * sine_half_difference;
  const double a = sine_half_sum * cosine_half, b = cosine_half_sum * sine_half;
  double s = (p + q) * (p - q), c = (a + b) * (a - b);
  Triangle t;
  if (s <= 0 || c <= 0) {
    const double psi = arc_tangent(sine, cosine);
    const double least = std::abs(alpha - beta);
    const double most = std::numbers::pi - std::abs(std::numbers::pi - (alpha + beta));
    t.missed = std::max({0.0, least - psi, psi - most});
    (s <= 0 ? s : c) = 0;
  }
  const double root_s = std::sqrt(s), root_c = std::sqrt(c);
  t.x = 2 * arc_tangent(root_s, root_c);
  t.sine_x = 2 * root_s * root_c / (s + c);
  t.cosine_x = (c - s) / (s + c);
  t.regularity = 2 * root_s * root_c;
  t.two = root_s > 0 && root_c > 0;
  return t;
}

Vec3 AxisPair::tool_at(const Triangle& t, double side) const {
  return cosine_beta * k2 + sine_beta * (t.cosine_x * f + side * t.sine_x * g);
}

double AxisPair::second(const Triangle& t, double side) const {
  return (side * t.x - zero) / radians_per_degree;
}

Vec3 AxisPair::direction(double first, double second) const {
  const auto x = sine_cosine(second + zero / radians_per_degree);
  const Vec3 v = cosine_beta * k2 + sine_beta * (x.cosine * f + x.sine * g);
  const auto t = sine_cosine(first);
  return t.cosine * v + t.sine * k1.cross(v) + ((1 - t.cosine) * k1.dot(v)) * k1;
}

namespace {

// Derivatives of the azimuth of p, a vector across k, in degrees.
std::array<double, 3> azimuth_rates(const Vec3& k, const std::array<Vec3, 4>& p) {
  const double q = p[0].squaredNorm(), q1 = 2 * p[0].dot(p[1]),
               q2 = 2 * (p[1].squaredNorm() + p[0].dot(p[2]));
  const double r = k.dot(p[0].cross(p[1])), r1 = k.dot(p[0].cross(p[2])),
               r2 = k.dot(p[1].cross(p[2]) + p[0].cross(p[3]));
  const double d1 = r / q, d2 = (r1 - d1 * q1) / q, d3 = (r2 - 2 * d2 * q1 - d1 * q2) / q;
  return {d1 / radians_per_degree, d2 / radians_per_degree, d3 / radians_per_degree};
}

}  // namespace

// With m the direction of axis 2 as axis 1 has turned it, w and r the rates of the two axes:
//   u' = w k1 x u + r m x u,  m' = w k1 x m
// and so on by differentiation. Each order is the same two equations across u.
std::array<std::array<double, 2>, 3> AxisPair::derivatives(const std::array<Vec3, 4>& u, double first) const {
  if (const Vec3 across = k1.cross(u[0]); across.norm() > 1e-9 && triangle(u[0], across).missed > 0) {
    const auto rates = azimuth_rates(k1, {across, k1.cross(u[1]), k1.cross(u[2]), k1.cross(u[3])});
    return {{{rates[0], 0}, {rates[1], 0}, {rates[2], 0}}};
  }
  const auto t = sine_cosine(first);
  const Vec3 m = t.cosine * k2 + t.sine * k1.cross(k2) + ((1 - t.cosine) * k1.dot(k2)) * k1;
  const Vec3 a = k1.cross(u[0]), b = m.cross(u[0]);
  const double determinant = u[0].dot(a.cross(b));
  const auto solve = [&](const Vec3& r) -> std::array<double, 2> {
    if (std::abs(determinant) > 1e-12)
      return {u[0].dot(r.cross(b)) / determinant, u[0].dot(a.cross(r)) / determinant};
    return {0, r.dot(b) / b.squaredNorm()};
  };
  const auto [w1, r1] = solve(u[1]);
  const Vec3 m1 = w1 * k1.cross(m);
  const Vec3 a1 = k1.cross(u[1]), b1 = m1.cross(u[0]) + m.cross(u[1]);
  const auto [w2, r2] = solve(u[2] - w1 * a1 - r1 * b1);
  const Vec3 m2 = w2 * k1.cross(m) + w1 * k1.cross(m1);
  const Vec3 a2 = k1.cross(u[2]), b2 = m2.cross(u[0]) + 2 * m1.cross(u[1]) + m.cross(u[2]);
  const auto [w3, r3] = solve(u[3] - 2 * (w2 * a1 + r2 * b1) - w1 * a2 - r1 * b2);
  constexpr double degrees = 1 / radians_per_degree;
  return {{{w1 * degrees, r1 * degrees}, {w2 * degrees, r2 * degrees}, {w3 * degrees, r3 * degrees}}};
}

}  // namespace trunnion::geometry
