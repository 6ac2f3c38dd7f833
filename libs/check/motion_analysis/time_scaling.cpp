// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/time_scaling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trunnion::analysis {
namespace {

// What of the limits the rows use: between two samples a little more is needed.
constexpr double used_share = 0.9999;
// The iteration begins this far below the given motion, or below what its rows leave.
constexpr double first_share = 0.97;
constexpr int rounds = 16, newtons = 6, most_reductions = 40;
constexpr double widest_use = 0.999;
// Of a window this many samples are solved at once, and this share of them is kept.
constexpr std::size_t window_samples = 1500, kept_samples = 1000;
constexpr std::size_t standstill_samples = 4, fewest_samples = 8;
// A speed counts as the programmed one from this share on. The best motion can leave it only near the ends of
// such a stretch: two margins are solved there, and the outer one, which ends at an assumed b, is not used.
constexpr double full_share = 0.998;
constexpr std::size_t least_margin = 30, most_margin = 160;

// b changes by less than this share from one sample to the next: the central differences need it.
constexpr double steepest = 0.1;

enum class Bound : std::uint8_t { one, tangent, own };

// |c b| over three neighbouring samples is at most 1, the tangent of 1 / sqrt(b) at the middle, or b there.
struct Row {
  std::array<double, 3> c{};
  Bound bound = Bound::one;
};

class Scaling {
 public:
  // The first two and the last two samples keep b where the motion goes on beyond them.
  Scaling(const std::vector<MotionSample>& samples, const motion::Limits& limits, double cycle,
          std::vector<double> begin, bool continues, bool ends)
      : n_(samples.size()),
        first_(continues ? 2 : 0),
        last_(ends ? n_ : n_ - 2),
        cycle_(cycle),
        b_(std::move(begin)),
        cap_(n_, 1e30),
        rows_(n_) {
    const double h = cycle;
    for (std::size_t i = 0; i < canonical::axis_count; ++i) {
      const motion::AxisLimits& axis = limits.axes[i];
      for (std::size_t k = 0; k < n_; ++k) {
        const auto q = [&](std::ptrdiff_t d) {
          const auto at = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(k) + d, 0,
                                                     static_cast<std::ptrdiff_t>(n_) - 1);
          return samples[static_cast<std::size_t>(at)].machine[i];
        };
        const double q1 = (q(1) - q(-1)) / (2 * h), q2 = (q(1) - 2 * q(0) + q(-1)) / (h * h),
                     q3 = (q(2) - 2 * q(1) + 2 * q(-1) - q(-2)) / (2 * h * h * h);
        if (q1 == 0 && q2 == 0 && q3 == 0) continue;
        const double v = samples[k].rapid ? std::max(axis.velocity, axis.rapid_velocity) : axis.velocity;
        if (q1 != 0) cap_[k] = std::min(cap_[k], std::pow(used_share * v / q1, 2));
        if (k < 1 || k + 1 >= n_) continue;
        const double a = 1 / (used_share * axis.acceleration), j = 1 / (used_share * axis.jerk);
        rows_[k].push_back({{-q1 / (4 * h) * a, q2 * a, q1 / (4 * h) * a}, Bound::one});
        const double second = q1 / (2 * h * h), first = 1.5 * q2 / (2 * h);
        rows_[k].push_back(
            {{(second - first) * j, (q3 - 2 * second) * j, (second + first) * j}, Bound::tangent});
      }
    }
    for (std::size_t k = 1; k + 1 < n_; ++k)
      rows_[k].push_back({{-0.5 / steepest, 0, 0.5 / steepest}, Bound::own});
    for (std::size_t k = 0; k < n_; ++k)
      if (samples[k].share > 0) cap_[k] = std::min(cap_[k], 1 / (samples[k].share * samples[k].share));
  }

  std::vector<double> solve() {
    reduce();
    std::size_t count = 0;
    for (const auto& rows : rows_) count += 2 * rows.size() + 1;
    const double gap = 5e-4;  // of the time, at the end
    double weight = 0.03 * static_cast<double>(count) / time();
    const double last = static_cast<double>(count) / (gap * time());
    const double factor = std::pow(last / weight, 1.0 / (rounds - 3));
    for (int round = 0; round < rounds; ++round) {
      base_ = b_;
      for (int k = 0; k < newtons; ++k)
        if (!newton(weight)) break;
      weight = std::min(last, weight * factor);
    }
    return b_;
  }

 private:
  double row(const Row& r, std::size_t k) const {
    return r.c[0] * b_[k - 1] + r.c[1] * b_[k] + r.c[2] * b_[k + 1];
  }
  // The tangent of 1 / sqrt(b) at the base.
  double bound(const Row& r, std::size_t k, double b) const {
    if (r.bound == Bound::own) return b;
    return r.bound == Bound::tangent ? (1.5 - 0.5 * b / base_[k]) / std::sqrt(base_[k]) : 1;
  }

  // A motion that leaves its limits is begun slower. Rows that stay violated, because the motion goes on
  // beyond the samples, are as wide as they have to be.
  void reduce() {
    for (std::size_t k = first_; k < last_; ++k) b_[k] = std::min(b_[k], 0.98 * cap_[k]);
    for (int pass = 0; pass < most_reductions; ++pass) {
      base_ = b_;
      double worst = 0;
      for (std::size_t k = 1; k + 1 < n_; ++k)
        for (const Row& r : rows_[k]) worst = std::max(worst, std::abs(row(r, k)) / bound(r, k, b_[k]));
      if (worst <= widest_use) return;
      if (first_ > 0 || last_ < n_) break;
      for (double& b : b_) b *= 0.9;
    }
    for (std::size_t k = 1; k + 1 < n_; ++k) {
      for (Row& r : rows_[k]) {
        const double used = std::abs(row(r, k)) / bound(r, k, b_[k]);
        if (used > widest_use)
          for (double& c : r.c) c *= widest_use / used;
      }
    }
  }

  double time() const {
    double sum = 0;
    for (const double b : b_) sum += cycle_ / std::sqrt(b);
    return sum;
  }

  double merit(double weight) const {
    double sum = weight * time();
    for (std::size_t k = first_; k < last_; ++k) {
      if (!(b_[k] > 0) || !(b_[k] < cap_[k])) return 1e300;
      sum -= std::log(1 - b_[k] / cap_[k]);
    }
    for (std::size_t k = 1; k + 1 < n_; ++k) {
      double product = 1;
      for (const Row& r : rows_[k]) {
        const double x = row(r, k), limit = bound(r, k, b_[k]);
        if (!(x < limit) || !(-x < limit)) return 1e300;
        product *= (limit - x) * (limit + x);
      }
      sum -= std::log(product);
    }
    return sum;
  }

  bool newton(double weight) {
    const std::size_t n = n_;
    std::vector<std::array<double, 3>> h(n, {0, 0, 0});
    std::vector<double> g(n, 0), step(n, 0);
    for (std::size_t k = first_; k < last_; ++k) {
      const double root = std::sqrt(b_[k]), d = 1 / (cap_[k] - b_[k]);
      g[k] += -weight * cycle_ / (2 * b_[k] * root) + d;
      h[k][0] += weight * cycle_ * 0.75 / (b_[k] * b_[k] * root) + d * d;
    }
    for (std::size_t k = 1; k + 1 < n; ++k) {
      for (const Row& r : rows_[k]) {
        const double x = row(r, k), limit = bound(r, k, b_[k]);
        const double slope = r.bound == Bound::own       ? -1
                             : r.bound == Bound::tangent ? 0.5 / (base_[k] * std::sqrt(base_[k]))
                                                         : 0;
        for (const double sign : {1.0, -1.0}) {
          const double d = 1 / (limit - sign * x);
          const std::array<double, 3> c{sign * r.c[0], sign * r.c[1] + slope, sign * r.c[2]};
          for (std::size_t p = 0; p < 3; ++p) {
            g[k - 1 + p] += d * c[p];
            for (std::size_t q = p; q < 3; ++q) h[k - 1 + p][q - p] += d * d * c[p] * c[q];
          }
        }
      }
    }
    // Pentadiagonal factorisation over the free nodes.
    const std::size_t first = first_, last = last_;
    for (std::size_t k = first; k < last; ++k) {
      const double inverse = 1 / h[k][0];
      for (std::size_t p = 1; p < 3 && k + p < last; ++p) {
        const double factor = h[k][p] * inverse;
        for (std::size_t q = p; q < 3 && k + q < last; ++q) h[k + p][q - p] -= factor * h[k][q];
        g[k + p] -= factor * g[k];
      }
    }
    double decrement = 0;
    for (std::size_t k = last; k-- > first;) {
      double sum = g[k];
      for (std::size_t p = 1; p < 3 && k + p < last; ++p) sum += h[k][p] * step[k + p];
      step[k] = -sum / h[k][0];
      decrement += step[k] * step[k] * h[k][0];
    }
    if (!(decrement > 1e-7)) return false;
    const std::vector<double> from = b_;
    const double before = merit(weight);
    for (double size = 1; size > 1e-6; size *= 0.6) {
      for (std::size_t k = first; k < last; ++k) b_[k] = from[k] + size * step[k];
      if (merit(weight) < before) return true;
    }
    b_ = from;
    return false;
  }

  std::size_t n_, first_, last_;
  double cycle_;
  std::vector<double> b_, base_, cap_;
  std::vector<std::vector<Row>> rows_;
};

}  // namespace

std::vector<double> least_time_scaling(const std::vector<MotionSample>& samples, const motion::Limits& limits,
                                       double cycle, std::vector<double> begin, bool continues, bool ends) {
  return Scaling(samples, limits, cycle, std::move(begin), continues, ends).solve();
}

void LeastTime::add(const MotionSample& sample) {
  constant_ = sample.share >= full_share ? constant_ + 1 : 0;
  if (add_at_constant_speed(sample)) return;
  const bool rests = !window_.empty() && sample.machine == window_.back().machine;
  resting_ = rests ? resting_ + 1 : 0;
  if (resting_ > standstill_samples) {
    if (window_.size() > standstill_samples + 2) solve(true);
    window_.assign(1, sample);
    return;
  }
  window_.push_back(sample);
  if (constant_ >= 3 * least_margin && constant_ >= 3 * margin()) {
    margin_ = margin();
    solve_up_to_constant_speed();
  }
  if (window_.size() >= window_samples) solve(false);
}

// Twice what the slowest axis needs to stop, in samples.
std::size_t LeastTime::margin() const {
  const MotionSample &now = window_.back(), &before = window_[window_.size() - 2];
  double longest = 0;
  for (std::size_t i = 0; i < canonical::axis_count; ++i) {
    const motion::AxisLimits& axis = limits_.axes[i];
    const double v = std::abs(now.machine[i] - before.machine[i]) / cycle_;
    longest = std::max(longest, v / axis.acceleration + 2 * std::sqrt(v / axis.jerk));
  }
  return std::clamp(static_cast<std::size_t>(2 * longest / cycle_), least_margin, most_margin);
}

// Keeps the newest samples of a stretch at the programmed speed: the next window begins with them.
bool LeastTime::add_at_constant_speed(const MotionSample& sample) {
  if (!between_windows_) return false;
  if (constant_ == 0) {
    between_windows_ = false;
    known_ = window_.size() - margin_;
    before_.assign(2, first_share);
    return false;
  }
  window_.push_back(sample);
  if (window_.size() > 3 * margin_) {
    known_ = margin_;
    count({}, margin_);
    window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(margin_));
  }
  return true;
}

void LeastTime::solve_up_to_constant_speed() {
  std::vector<double> b = before_;
  b.resize(window_.size(), first_share);
  b = least_time_scaling(window_, limits_, cycle_, std::move(b), !before_.empty(), false);
  const std::size_t solved = window_.size() - 2 * margin_;
  count(b, solved);
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(solved));
  before_.clear();
  known_ = 0;
  between_windows_ = true;
}

void LeastTime::count(const std::vector<double>& b, std::size_t samples) {
  for (std::size_t k = 0; k < samples; ++k)
    time_ += cycle_ * (k < known_ ? window_[k].share : 1 / std::sqrt(b[k]));
  known_ -= std::min(known_, samples);
}

void LeastTime::solve(bool ends) {
  if (ends) window_.resize(window_.size() - std::min(window_.size(), resting_));
  const bool continues = !before_.empty();
  std::vector<double> b = before_;
  b.resize(window_.size(), first_share);
  if (window_.size() >= fewest_samples)
    b = least_time_scaling(window_, limits_, cycle_, std::move(b), continues, ends);
  count(b, ends ? b.size() : kept_samples);
  if (ends) {
    before_.clear();
    window_.clear();
    return;
  }
  before_.assign(b.begin() + kept_samples, b.end());
  window_.erase(window_.begin(), window_.begin() + kept_samples);
}

double LeastTime::finish() {
  if (between_windows_) {
    known_ = window_.size();
    count({}, known_);
  } else if (window_.size() > 1) {
    solve(true);
  }
  window_.clear();
  between_windows_ = false;
  return time_;
}

}  // namespace trunnion::analysis
