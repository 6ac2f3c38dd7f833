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
  pair.sine_half_sum = std::sin(0.5 * (pair.alpha + pair.beta));
  pair.cosine_half_sum = std::cos(0.5 * (pair.alpha + pair.beta));
  pair.sine_half_difference = std::sin(0.5 * (pair.alpha - pair.beta));
  pair.cosine_half_difference = std::cos(0.5 * (pair.alpha - pair.beta));
  pair.zero = std::atan2(pair.g.dot(tool), pair.f.dot(tool));
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
    const double psi = std::atan2(sine, cosine);
    const double least = std::abs(alpha - beta);
    const double most = std::numbers::pi - std::abs(std::numbers::pi - (alpha + beta));
    t.missed = std::max({0.0, least - psi, psi - most});
    (s <= 0 ? s : c) = 0;
  }
  const double root_s = std::sqrt(s), root_c = std::sqrt(c);
  t.x = 2 * std::atan2(root_s, root_c);
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

}  // namespace trunnion::geometry
