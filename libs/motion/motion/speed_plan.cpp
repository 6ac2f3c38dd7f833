// SPDX-License-Identifier: Apache-2.0
#include "motion/speed_plan.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

constexpr int terms = 7;

// x'' = b1 / 2 + b2 x from x = 0 with the speed v: way and speed after `t`, by series in b2 t^2, which is
// small on pieces of some cycles.
struct Moved {
  double way, speed;
};

Moved move(const SpeedPiece& piece, double x, double v, double t) {
  const double pull = piece.b1 / 2 + piece.b2 * x, w = piece.b2 * t * t;
  double odd = 1, even = 0.5, cosine = 1;  // sinh(z) / z, (cosh(z) - 1) / z^2, cosh(z) of z^2 = w
  double a = 1, b = 0.5, c = 1;
  for (int k = 1; k < terms; ++k) {
    a *= w / ((2 * k) * (2 * k + 1));
    b *= w / ((2 * k + 1) * (2 * k + 2));
    c *= w / ((2 * k - 1) * (2 * k));
    odd += a;
    even += b;
    cosine += c;
  }
  return {v * t * odd + pull * t * t * even, v * cosine + pull * t * odd};
}

}  // namespace

double SpeedPiece::duration() const {
  const double middle = std::sqrt(std::max(1e-12, square(at + length / 2)));
  const double first = std::sqrt(std::max(1e-12, b0)), last = std::sqrt(std::max(1e-12, square(end())));
  return length / (first + middle) + length / (middle + last);
}

bool SpeedPlan::replace(std::size_t index, const std::vector<SpeedPiece>& pieces, const SpeedPiece& last) {
  if (index - current_ + pieces.size() + 1 > capacity) return false;
  pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(index), pieces_.end());
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(current_));
  current_ = 0;
  pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  pieces_.push_back(last);
  return true;
}

PathState SpeedPlan::advance(const PathState& state, double time, std::size_t& current) const {
  double s = state.s, v = state.v;
  while (current < pieces_.size()) {
    const SpeedPiece& piece = pieces_[current];
    const double x = s - piece.at;
    const Moved whole = move(piece, x, v, time);
    if (x + whole.way < piece.length) {
      s += whole.way;
      v = std::sqrt(std::max(0.0, piece.square(s)));
      return {s, v, piece.slope(s) / 2};
    }
    double low = 0, high = time;
    double t = std::clamp((piece.length - x) / std::max(whole.way, 1e-12) * time, 0.0, time);
    for (int k = 0; k < 40 && high - low > 1e-15; ++k) {
      const Moved part = move(piece, x, v, t);
      const double missing = piece.length - x - part.way;
      (missing > 0 ? low : high) = t;
      double next = part.speed > 0 ? t + missing / part.speed : 0.5 * (low + high);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (std::abs(next - t) < 1e-16) break;
      t = next;
    }
    time -= std::min(time, t);
    const double end = piece.end();
    v = std::sqrt(std::max(0.0, piece.square(end)));
    s = end;
    if (current + 1 == pieces_.size()) return {s, v, piece.slope(end) / 2};
    ++current;
  }
  return {s, v, 0};
}

void SpeedPlan::slow_down(double rate) {
  const double square = rate * rate;
  for (SpeedPiece& piece : pieces_) piece.b0 *= square, piece.b1 *= square, piece.b2 *= square;
}

}  // namespace trunnion::motion
