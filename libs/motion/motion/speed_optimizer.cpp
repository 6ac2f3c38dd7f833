// SPDX-License-Identifier: Apache-2.0
#include "motion/speed_optimizer.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

constexpr int most_iterations = 40, most_rounds = 5;
constexpr double first_barrier = 1e-4, least_slack = 0.5;
// Part of the way to the nearest bound that is gone.
constexpr double to_bound = 0.98;
// The iteration ends when the duality gap is this share of the objective and rows are left by less than this.
constexpr double gap_share = 3e-3, row_rounding = 1.5e-3;
// What the limits may be used by between the places of the rows, and how much more a row is tightened.
constexpr double most_use = 1.0003, tighten_more = 1.0015;
// What a coefficient of b may be left below the square of the programmed speed by the gap.
constexpr double near_cap = 0.01;
// A window that begins there needs room below its bounds.
constexpr double room_below_cap = 2e-5;
// The limits may be used by this much for it: a window that begins near them has little room to find its own
// way.
constexpr double calm_use = 0.5;
constexpr double least_square = 1e-9;
// The time's part of the Hessian: its exact factor.
constexpr double time_factor = 0.75;

}  // namespace

SpeedOptimizer::SpeedOptimizer() {
  const std::size_t m = SpeedWindow::most_pieces + 2;
  for (auto* list : {&b_, &gradient_, &step_, &use_}) list->reserve(m);
  hessian_.reserve(3 * m);
  sides_.reserve(SpeedWindow::most_rows + 128);
  boxes_.reserve(m);
  root_.reserve(SpeedWindow::most_samples + 8);
  gauss_.reserve(7 * m);
  pieces_.reserve(m);
}

bool SpeedOptimizer::begin(const CellRing& cells, const SpeedRequest& request, const SpeedPlan* before) {
  running_ = solved_ = false;
  pieces_.clear();
  if (!window_.build(cells, request, before)) return false;
  const std::size_t n = window_.pieces(), m = n + 2;
  b_ = window_.guess();
  SpeedWindow::Basis value, first, second;
  const auto fix = [&](std::size_t piece, double s, std::size_t one, double square, double slope) {
    window_.basis(piece, s, value, first, second);
    const double determinant = value[one] * first[one + 1] - value[one + 1] * first[one];
    b_[piece + one] = (square * first[one + 1] - value[one + 1] * slope) / determinant;
    b_[piece + one + 1] = (value[one] * slope - square * first[one]) / determinant;
  };
  const double v = request.from.v;
  for (std::size_t k = 2; k + 2 < m; ++k) b_[k] = std::min(b_[k], 0.97 * window_.caps()[k]);
  fix(0, window_.node(0), 0, v * v, 2 * request.from.a);
  fix(n - 1, window_.node(static_cast<std::ptrdiff_t>(n)), 1, window_.end_speed() * window_.end_speed(), 0);
  gauss_.resize(7 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const double a = window_.node(static_cast<std::ptrdiff_t>(k)),
                 h = window_.node(static_cast<std::ptrdiff_t>(k) + 1) - a;
    for (std::size_t e = 0; e < 2; ++e) {
      window_.basis(k, a + h * (e == 0 ? 0.2113248654051871 : 0.7886751345948129), value, first, second);
      std::copy(value.begin(), value.end(), gauss_.begin() + static_cast<std::ptrdiff_t>(7 * k + 3 * e));
    }
    gauss_[7 * k + 6] = h / 2;
  }
  sides_.resize(window_.rows().size());
  boxes_.resize(m);
  root_.resize(window_.samples().size());
  hessian_.assign(3 * m, 0);
  gradient_.assign(m, 0);
  step_.assign(m, 0);
  barrier_ = first_barrier;
  iterations_ = rounds_ = 0;
  fresh_ = running_ = true;
  return true;
}

// Rows, slacks, gradient and Hessian at the present coefficients.
void SpeedOptimizer::evaluate() {
  const std::size_t n = window_.pieces(), m = n + 2;
  std::fill(hessian_.begin(), hessian_.end(), 0.0);
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  worst_ = 1;
  gap_ = objective_ = 0;
  const std::vector<SpeedRow>& rows = window_.rows();
  const std::vector<SpeedSample>& samples = window_.samples();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double* b = &b_[static_cast<std::size_t>(samples[k].piece)];
    const auto& v = samples[k].basis;
    root_[k] = std::sqrt(std::max(least_square, v[0] * b[0] + v[1] * b[1] + v[2] * b[2]));
  }
  Two gap{0, 0}, worst{1, 1};
  const Two mu{barrier_, barrier_};
  for (std::size_t k = 0; k < n; ++k) {
    const double* b = &b_[k];
    double g[3] = {0, 0, 0}, h[6] = {0, 0, 0, 0, 0, 0};
    for (std::size_t r = window_.rows_from(k); r < window_.rows_from(k + 1); ++r) {
      const SpeedRow& row = rows[r];
      Side& side = sides_[r];
      double q = row.c[0] * b[0] + row.c[1] * b[1] + row.c[2] * b[2];
      if (row.jerk) {
        const auto sample = static_cast<std::size_t>(row.sample);
        const double root = root_[sample], half = 0.5 * q / root;
        const auto& v = samples[sample].basis;
        for (std::size_t x = 0; x < 3; ++x) side.slope[x] = root * row.c[x] + half * v[x];
        q *= root;
      } else {
        for (std::size_t x = 0; x < 3; ++x) side.slope[x] = row.c[x];
      }
      side.value = Two{1 - q, 1 + q};
      if (fresh_) {
        side.slack = Two{std::max(1 - q, least_slack), std::max(1 + q, least_slack)};
        side.factor = mu / side.slack;
      }
      side.inverse = 1.0 / side.slack;
      const Two pull = (mu - side.factor * (side.value - side.slack)) * side.inverse;
      const Two weight = side.factor * side.inverse;
      gap += side.slack * side.factor;
      worst = side.value < worst ? side.value : worst;
      const double w1 = pull[1] - pull[0], w2 = weight[0] + weight[1];
      const double e0 = w2 * side.slope[0], e1 = w2 * side.slope[1];
      g[0] += w1 * side.slope[0];
      g[1] += w1 * side.slope[1];
      g[2] += w1 * side.slope[2];
      h[0] += e0 * side.slope[0];
      h[1] += e0 * side.slope[1];
      h[2] += e0 * side.slope[2];
      h[3] += e1 * side.slope[1];
      h[4] += e1 * side.slope[2];
      h[5] += w2 * side.slope[2] * side.slope[2];
    }
    for (std::size_t e = 0; e < 2; ++e) {
      const double* v = &gauss_[7 * k + 3 * e];
      const double square = std::max(least_square, v[0] * b[0] + v[1] * b[1] + v[2] * b[2]);
      const double time = window_.weight()[k] * gauss_[7 * k + 6] / std::sqrt(square),
                   drawn = window_.pull()[k] * gauss_[7 * k + 6];
      objective_ += time + drawn * square;
      // Of the negative gradient.
      const double p1 = 0.5 * time / square - drawn, p2 = time_factor * time / (square * square);
      g[0] += p1 * v[0], g[1] += p1 * v[1], g[2] += p1 * v[2];
      h[0] += p2 * v[0] * v[0];
      h[1] += p2 * v[0] * v[1];
      h[2] += p2 * v[0] * v[2];
      h[3] += p2 * v[1] * v[1];
      h[4] += p2 * v[1] * v[2];
      h[5] += p2 * v[2] * v[2];
    }
    for (std::size_t x = 0; x < 3; ++x) gradient_[k + x] += g[x];
    double* at = &hessian_[3 * k];
    at[0] += h[0], at[1] += h[1], at[2] += h[2];
    at[3] += h[3], at[4] += h[4];
    at[6] += h[5];
  }
  gap_ = gap[0] + gap[1];
  worst_ = std::min(worst[0], worst[1]);
  for (std::size_t k = 2; k + 2 < m; ++k) {
    Box& box = boxes_[k];
    const double scale = 1 / window_.caps()[k];
    box.value = 1 - b_[k] * scale;
    if (fresh_) box.slack = std::max(box.value, least_slack), box.factor = barrier_ / box.slack;
    box.inverse = 1 / box.slack;
    gradient_[k] -= scale * (barrier_ - box.factor * (box.value - box.slack)) * box.inverse;
    hessian_[3 * k] += scale * scale * box.factor * box.inverse;
    worst_ = std::min(worst_, box.value);
    gap_ += box.slack * box.factor;
  }
  count_ = 2 * rows.size() + m - 4;
  fresh_ = false;
}

bool SpeedOptimizer::factorise() {
  const std::size_t m = b_.size(), first = 2, last = m - 2;
  double* h = hessian_.data();
  for (std::size_t k = first; k < last; ++k) {
    if (!(h[3 * k] > 0)) return false;
    const double inverse = 1 / h[3 * k];
    for (std::size_t p = 1; p < 3 && k + p < last; ++p) {
      const double factor = h[3 * k + p] * inverse;
      for (std::size_t q = p; q < 3 && k + q < last; ++q) h[3 * (k + p) + q - p] -= factor * h[3 * k + q];
      gradient_[k + p] -= factor * gradient_[k];
    }
    h[3 * k] = inverse;
  }
  for (std::size_t k = last; k-- > first;) {
    double sum = gradient_[k];
    for (std::size_t p = 1; p < 3 && k + p < last; ++p) sum -= h[3 * k + p] * step_[k + p];
    step_[k] = sum * h[3 * k];
  }
  return true;
}

// Own lengths for coefficients and multipliers, so that slacks, multipliers and b stay above zero.
void SpeedOptimizer::step() {
  const std::size_t n = window_.pieces(), m = n + 2;
  const Two mu{barrier_, barrier_};
  double primal = to_bound, dual = to_bound;  // the largest relative decrease of a full step
  for (std::size_t k = 2; k + 2 < m; ++k) {
    if (step_[k] < 0)
      primal = std::max(primal, -step_[k] / b_[k] * (to_bound / 0.7));
    else
      primal = std::max(primal, step_[k] / b_[k] * (to_bound / 2.5));
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double* d = &step_[k];
    for (std::size_t r = window_.rows_from(k); r < window_.rows_from(k + 1); ++r) {
      Side& side = sides_[r];
      const double q = side.slope[0] * d[0] + side.slope[1] * d[1] + side.slope[2] * d[2];
      side.change = Two{-q, q} + side.value - side.slack;
      const Two share = side.change * side.inverse;
      side.factor_change = (mu - side.factor * side.change) * side.inverse - side.factor;
      for (int e = 0; e < 2; ++e) {
        if (-share[e] > primal) primal = -share[e];
        if (-side.factor_change[e] > dual * side.factor[e]) dual = -side.factor_change[e] / side.factor[e];
      }
    }
  }
  for (std::size_t k = 2; k + 2 < m; ++k) {
    Box& box = boxes_[k];
    box.change = -step_[k] / window_.caps()[k] + box.value - box.slack;
    box.factor_change = (barrier_ - box.factor * box.change) * box.inverse - box.factor;
    primal = std::max(primal, -box.change * box.inverse);
    dual = std::max(dual, -box.factor_change / box.factor);
  }
  const double length = to_bound / primal, factor_length = to_bound / dual;
  const Two along{length, length}, factor_along{factor_length, factor_length};
  for (Side& side : sides_) {
    side.slack += along * side.change;
    side.factor += factor_along * side.factor_change;
  }
  for (std::size_t k = 2; k + 2 < m; ++k) {
    Box& box = boxes_[k];
    box.slack += length * box.change;
    box.factor += factor_length * box.factor_change;
    b_[k] += length * step_[k];
  }
  const double least = std::min(length, factor_length), rest = (1 - least) * (1 - least);
  const auto count = static_cast<double>(count_);
  barrier_ = std::max(gap_ / count * std::clamp(rest, 0.08, 0.9), 0.3 * gap_share * objective_ / count);
}

void SpeedOptimizer::finish(bool good) {
  running_ = false;
  solved_ = good;
  pieces_.clear();
  if (!good) return;
  SpeedWindow::Basis value, first, second;
  for (std::size_t k = 0; k < window_.pieces(); ++k) {
    const double s = window_.node(static_cast<std::ptrdiff_t>(k));
    window_.basis(k, s, value, first, second);
    SpeedPiece piece{s, window_.node(static_cast<std::ptrdiff_t>(k) + 1) - s, 0, 0, 0};
    for (std::size_t x = 0; x < 3; ++x) {
      piece.b0 += value[x] * b_[k + x];
      piece.b1 += first[x] * b_[k + x];
      piece.b2 += 0.5 * second[x] * b_[k + x];
    }
    const double middle = piece.square(s + piece.length / 2);
    if (!(piece.b0 > 0 && middle > 0 && piece.square(piece.end()) > 0 && std::isfinite(middle))) {
      solved_ = false;
      pieces_.clear();
      return;
    }
    pieces_.push_back(piece);
  }
}

// An interior point ends a little below the programmed speed. Where nothing else bounds the motion, that
// speed is kept but for room_below_cap.
void SpeedOptimizer::keep_programmed_speed(const CellRing& cells) {
  if (window_.drawn()) return;
  const std::size_t n = window_.pieces(), m = n + 2;
  const auto& caps = window_.caps();
  // Coefficient k acts on the pieces k - 2 to k.
  const auto near = [&](std::size_t k) {
    return b_[k] > (1 - near_cap) * caps[k] && use_[k - 2] < calm_use && use_[k - 1] < calm_use &&
           use_[k] < calm_use;
  };
  step_ = b_;  // the last step is no longer needed
  for (std::size_t first = 2; first + 2 < m;) {
    std::size_t end = first;
    while (end + 2 < m && near(end) && caps[end] == caps[first]) ++end;
    // Three coefficients hold a piece.
    if (end >= first + 3) {
      std::fill(b_.begin() + static_cast<std::ptrdiff_t>(first),
                b_.begin() + static_cast<std::ptrdiff_t>(end), (1 - room_below_cap) * caps[first]);
      bool within = true;
      for (std::size_t k = first - 2; k < std::min(end, n) && within; ++k)
        within = window_.use(cells, k, &b_[k]) <= calm_use;
      if (!within)
        std::copy(step_.begin() + static_cast<std::ptrdiff_t>(first),
                  step_.begin() + static_cast<std::ptrdiff_t>(end),
                  b_.begin() + static_cast<std::ptrdiff_t>(first));
    }
    first = std::max(end, first + 1);
  }
}

// Tightens the rows of pieces that use more than the limits between their places.
void SpeedOptimizer::check(const CellRing& cells) {
  bool good = true;
  const std::size_t n = window_.pieces();
  use_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double use = use_[k] = window_.use(cells, k, &b_[k]);
    if (use <= most_use) continue;
    good = false;
    for (std::size_t r = window_.rows_from(k); r < window_.rows_from(k + 1); ++r)
      for (double& c : window_.rows()[r].c) c *= use * tighten_more;
  }
  if (good) {
    keep_programmed_speed(cells);
    return finish(true);
  }
  if (++rounds_ > most_rounds) return finish(false);
  // From a barrier large enough to move away from the bounds.
  barrier_ = std::max(barrier_, 10 * gap_share * objective_ / static_cast<double>(count_));
  iterations_ = std::min(iterations_, most_iterations - 12);
}

bool SpeedOptimizer::work(const CellRing& cells) {
  if (!running_) return true;
  evaluate();
  const bool kept = worst_ > -row_rounding;
  if (kept && gap_ < gap_share * objective_) {
    check(cells);
    if (!running_) return true;
    evaluate();
  }
  if (++iterations_ > most_iterations) {
    if (kept && rounds_ == 0) check(cells);
    if (running_) finish(false);
    return true;
  }
  if (!factorise()) {
    finish(false);
    return true;
  }
  step();
  return false;
}

}  // namespace trunnion::motion
