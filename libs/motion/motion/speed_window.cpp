// SPDX-License-Identifier: Apache-2.0
#include "motion/speed_window.hpp"

#include <algorithm>
#include <cmath>

#include "motion/axis_limits.hpp"

namespace trunnion::motion {
namespace {

// Least time of a piece, s, and the share of the horizon that it is.
constexpr double least_piece_time = 2.5e-3, piece_share = 1.0 / 150;
// What rows use of the limits; the rest is for what lies between the places of the rows.
constexpr double acceleration_share = 0.996, jerk_share = 0.992;
// Windows end at this speed, mm/s or degrees/s, or at a share of the slowest speed on them.
constexpr double creep = 2, slowest_share = 0.5;
// The reference speed that the pieces are cut by accelerates with this share of what the axes permit.
constexpr double reference_share = 0.4;
// The first guess as a share of the reference speed.
constexpr double guess_share = 0.6;
// Of the plan in force this part is taken as the first guess.
constexpr double trusted_share = 0.4;
// Third derivatives that differ by less than this share of the largest are the same.
constexpr double same_third = 1e-4;
// Places of a check lie this far apart, s.
constexpr double check_time = 6e-4;
// A cap beside what the plan in force has.
constexpr double drawn_share = 1.02;
constexpr std::size_t fewest_pieces = 6;
constexpr double shortest_piece = 1e-6;

// Highest speed under an override, by feed and velocity.
double highest(const LimitCell& cell, const SpeedRequest& request) {
  if (cell.rapid) return cell.reachable * std::max(request.rapid, 1e-3);
  return std::min(cell.reachable, cell.feed * request.feed);
}

bool continues(const LimitCell& a, const LimitCell& b) {
  if (a.known_axes != b.known_axes || a.rapid != b.rapid) return false;
  if (std::abs(a.feed - b.feed) > 1e-4 * a.feed || std::abs(a.reachable - b.reachable) > 0.02 * a.reachable)
    return false;
  float largest = 0, different = 0;
  for (int i = 0; i < a.known_axes; ++i) {
    const auto &p = a.axes[static_cast<std::size_t>(i)], &q = b.axes[static_cast<std::size_t>(i)];
    largest = std::max({largest, std::abs(p.end[2]), std::abs(q.begin[2])});
    different = std::max({different, std::abs(p.end[2] - q.begin[2]), std::abs(p.begin[2] - p.end[2])});
  }
  return different <= static_cast<float>(same_third) * largest;
}

}  // namespace

SpeedWindow::SpeedWindow() {
  spans_.reserve(most_cells);
  nodes_.reserve(most_pieces + 1);
  for (auto* list : {&caps_, &guess_, &pull_, &feed_, &reach_, &weight_}) list->reserve(most_pieces + 2);
  samples_.reserve(most_samples + 8);
  rows_.reserve(most_rows + 128);
  row_from_.reserve(most_pieces + 2);
  span_of_.reserve(most_pieces + 1);
}

bool SpeedWindow::scan(const CellRing& cells, const SpeedRequest& request) {
  spans_.clear();
  double time = 0, before = std::max(request.from.v, creep), slowest = 1e9;
  std::uint64_t c = request.cell, counted = 0;
  end_ = request.from.s;
  ramp_ = 1e9;
  reaches_end_ = false;
  bool full = false;
  for (;; ++c) {
    if (c >= cells.size() || (c > request.cell && cells[c].stop) || cells[c].known_axes == 0) {
      reaches_end_ = true;
      break;
    }
    if (full || ++counted > most_cells) break;
    const LimitCell& cell = cells[c];
    double speed = highest(cell, request), ramp = 1e9;
    const double cap = speed;
    for (int i = 0; i < cell.known_axes; ++i) {
      const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
      const auto most = [&](std::size_t n) {
        return static_cast<double>(std::max(std::abs(axis.begin[n]), std::abs(axis.end[n])));
      };
      const auto acceleration = static_cast<double>(axis.acceleration);
      if (most(0) > 0) ramp = std::min(ramp, acceleration / most(0));
      if (most(1) > 0) speed = std::min(speed, std::sqrt(acceleration / most(1)));
      if (most(2) > 0) speed = std::min(speed, std::cbrt(static_cast<double>(axis.jerk) / most(2)));
    }
    ramp_ = std::min(ramp_, reference_share * ramp);
    const double from = std::max(cell.at, request.from.s), length = cell.end - from;
    if (!(length > 0)) continue;
    slowest = std::min(slowest, speed);
    double reach = cell.end;
    const double reached = std::min(speed, std::sqrt(before * before + 2 * ramp_ * length));
    const double lasts = length / std::max(reached, 1e-3);
    if (time + lasts > request.horizon) {
      full = true;
      reach = from + std::min(length, std::max(0.0, request.horizon - time) * reached);
    }
    time += lasts;
    before = reached;
    if (!spans_.empty() && c > request.cell && spans_.back().end == from && continues(cells[c - 1], cell)) {
      Span& span = spans_.back();
      span.end = reach;
      span.speed = std::min(span.speed, speed);
      span.cap = std::min(span.cap, cap);
      span.reachable = std::min(span.reachable, cell.reachable);
    } else {
      spans_.push_back({from, reach, c, speed, cap, cell.reachable});
    }
    end_ = reach;
  }
  if (spans_.empty()) return false;
  end_speed_ = std::min(creep, slowest_share * slowest);
  // Room to stop behind the end, where the path ends or stops.
  const LimitCell& last = cells[reaches_end_ ? c - 1 : spans_.back().cell];
  end_speed_ = std::min(end_speed_, slowest_share * last.speed);
  const RampLimits& ramp = last.ramps[0];
  const double stop = 1.5 * braking_distance(end_speed_, 0, 0,
                                             {std::max(ramp.acceleration, 1e-3), std::max(ramp.jerk, 1e-3)}) +
                      0.004 * end_speed_;
  double known = cells[c - 1].end;
  for (std::uint64_t k = c; !reaches_end_ && known - end_ < stop; ++k) {
    if (k >= cells.size() || cells[k].stop) break;
    known = cells[k].end;
  }
  if (known - end_ < stop) {
    end_ = known - stop;
    reaches_end_ = true;
  }
  while (!spans_.empty() && spans_.back().at >= end_) spans_.pop_back();
  if (spans_.empty()) return false;
  spans_.back().end = end_;
  return end_ - request.from.s > 8 * shortest_piece;
}

// The reference speed at a place of a span, from those of the spans beside it.
double SpeedWindow::near_speed(const Span& span, double s) const {
  const auto index = static_cast<std::size_t>(&span - spans_.data());
  const double v0 = index == 0 ? std::max(from_.v, end_speed_) : spans_[index - 1].speed;
  const double v1 = index + 1 == spans_.size() ? end_speed_ : spans_[index + 1].speed;
  return std::min({span.speed, std::sqrt(v0 * v0 + 2 * ramp_ * (s - span.at + shortest_piece)),
                   std::sqrt(v1 * v1 + 2 * ramp_ * std::max(0.0, span.end - s))});
}

bool SpeedWindow::cut(const SpeedRequest& request) {
  from_ = request.from;
  double v = std::max(from_.v, end_speed_);
  for (Span& span : spans_) {
    span.speed = std::min(span.speed, std::sqrt(v * v + 2 * ramp_ * (span.end - span.at)));
    v = span.speed;
  }
  v = end_speed_;
  for (std::size_t k = spans_.size(); k-- > 0;) {
    Span& span = spans_[k];
    span.speed = std::min(span.speed, std::sqrt(v * v + 2 * ramp_ * (span.end - span.at)));
    v = span.speed;
  }
  const double piece_time = std::max(least_piece_time, piece_share * request.horizon);
  nodes_.assign(1, from_.s);
  span_of_.clear();
  std::size_t i = 0;
  double s = from_.s;
  while (s < end_ - shortest_piece) {
    if (nodes_.size() > most_pieces) {
      reaches_end_ = false;
      end_ = s;
      break;
    }
    while (i + 1 < spans_.size() && spans_[i].end <= s + 1e-12) ++i;
    span_of_.push_back(i);
    const double step = std::max(shortest_piece, near_speed(spans_[i], s) * piece_time);
    const double left = spans_[i].end - s;
    double next = s + step;
    if (left <= 1.5 * step) {
      next = spans_[i].end;
      for (std::size_t j = i + 1; j < spans_.size() && spans_[j].end - s <= step; ++j) next = spans_[j].end;
    }
    next = std::min(next, end_);
    if (end_ - next < 0.3 * step) next = end_;
    nodes_.push_back(next);
    s = next;
  }
  return nodes_.size() > fewest_pieces;
}

double SpeedWindow::node(std::ptrdiff_t k) const {
  const auto n = static_cast<std::ptrdiff_t>(nodes_.size()) - 1;
  if (k < 0) return nodes_[0] + static_cast<double>(k) * (nodes_[1] - nodes_[0]);
  if (k > n) return nodes_.back() + static_cast<double>(k - n) * (nodes_.back() - nodes_[nodes_.size() - 2]);
  return nodes_[static_cast<std::size_t>(k)];
}

void SpeedWindow::basis(std::size_t k, double s, Basis& value, Basis& first, Basis& second) const {
  const auto i = static_cast<std::ptrdiff_t>(k);
  const double a = node(i - 1), b = nodes_[k], c = nodes_[k + 1], d = node(i + 2);
  const double p = 1 / ((c - a) * (c - b)), r = 1 / ((d - b) * (c - b));
  value = {(c - s) * (c - s) * p, 0, (s - b) * (s - b) * r};
  value[1] = 1 - value[0] - value[2];
  first = {-2 * (c - s) * p, 0, 2 * (s - b) * r};
  first[1] = -first[0] - first[2];
  second = {2 * p, -2 * (p + r), 2 * r};
}

void SpeedWindow::add_sample(const CellRing& cells, std::uint64_t& c, double s, double inside,
                             std::size_t piece, bool acceleration) {
  while (cells[c].end < inside && cells[c].end < s + 1e-9 && c + 1 < cells.size()) ++c;
  while (cells[c].end < s - 1e-9 && c + 1 < cells.size()) ++c;
  const LimitCell& cell = cells[c];
  Basis value, first, second;
  basis(piece, s, value, first, second);
  const auto sample = static_cast<std::int16_t>(samples_.size());
  samples_.push_back({value, static_cast<std::int16_t>(piece)});
  for (int i = 0; i < cell.known_axes; ++i) {
    const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
    const AxisRates q = exact_rates(axis, part_of(cell, s), cell.end - cell.at);
    const double a = 1 / (acceleration_share * static_cast<double>(axis.acceleration)),
                 j = 1 / (jerk_share * static_cast<double>(axis.jerk));
    SpeedRow row;
    row.sample = sample;
    if (acceleration) {
      for (std::size_t x = 0; x < 3; ++x) row.c[x] = (0.5 * q.first * first[x] + q.second * value[x]) * a;
      rows_.push_back(row);
    }
    row.jerk = true;
    for (std::size_t x = 0; x < 3; ++x)
      row.c[x] = (q.third * value[x] + 1.5 * q.second * first[x] + 0.5 * q.first * second[x]) * j;
    rows_.push_back(row);
  }
}

bool SpeedWindow::add_rows(const CellRing& cells) {
  samples_.clear();
  rows_.clear();
  row_from_.clear();
  feed_.clear();
  reach_.clear();
  std::size_t first = 0;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    row_from_.push_back(rows_.size());
    const double begin = nodes_[k], end = nodes_[k + 1];
    if (samples_.size() + 40 > most_samples && k > fewest_pieces) {  // shorter than it might be
      nodes_.resize(k + 1);
      span_of_.resize(k);
      row_from_.pop_back();
      reaches_end_ = false;
      break;
    }
    while (first + 1 < spans_.size() && spans_[first].end <= begin + 1e-12) ++first;
    std::size_t inside = 0;
    for (std::size_t i = first; i < spans_.size() && spans_[i].at < end - 1e-12; ++i) ++inside;
    const std::size_t stride = 1 + inside / 12;
    double cap = 1e9, reachable = 1e9;
    for (std::size_t i = first; i < first + inside; ++i) {
      const Span& span = spans_[i];
      cap = std::min(cap, span.cap);
      reachable = std::min(reachable, span.reachable);
      if ((i - first) % stride != 0) continue;
      const double low = std::max(begin, span.at), high = std::min(end, span.end);
      const double middle = 0.5 * (low + high);
      std::uint64_t cell = span.cell;
      add_sample(cells, cell, low, middle, k, k > 0 || low > begin);
      if (high - low > 0.4 * (end - begin)) add_sample(cells, cell, middle, middle, k, false);
      // The last place of a cell counts as inside it.
      add_sample(cells, cell, high, low, k, false);
    }
    feed_.push_back(cap * cap);
    reach_.push_back(reachable * reachable);
  }
  row_from_.push_back(rows_.size());
  return nodes_.size() > fewest_pieces;
}

void SpeedWindow::bound(const SpeedRequest& request, const SpeedPlan* before) {
  const std::size_t n = pieces(), m = n + 2;
  drawn_ = false;
  caps_.assign(m, 1e18);
  pull_.assign(n, 0);
  weight_.assign(n, 1);
  guess_.assign(m, 0);
  std::vector<double>& free = feed_;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t x = 0; x < 3; ++x) caps_[k + x] = std::min(caps_[k + x], free[k]);
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t piece = std::clamp<std::size_t>(k, 1, n) - 1;
    const double s =
        std::clamp(0.5 * (node(static_cast<std::ptrdiff_t>(k) - 1) + node(static_cast<std::ptrdiff_t>(k))),
                   nodes_.front(), nodes_.back());
    const double v = guess_share * near_speed(spans_[span_of_[piece]], s);
    guess_[k] = std::max(v * v, 0.5 * end_speed_ * end_speed_);
  }
  if (before == nullptr || before->empty()) {
    const double v2 = from_.v * from_.v;
    for (std::size_t k = 0; k < std::min<std::size_t>(12, m); ++k) {
      const double part = static_cast<double>(k) / 12;
      guess_[k] = v2 * (1 - part) + guess_[k] * part;
    }
    return;
  }
  std::size_t piece = before->current();
  const auto fast = [&](double s) {
    while (piece + 1 < before->size() && (*before)[piece].end() < s) ++piece;
    return (*before)[piece].square(s);
  };
  // Where the plan in force is faster than the feed and the override permit, the new one may begin faster,
  // too, and is drawn down to them.
  for (std::size_t k = 0; request.lower && k < n; ++k) {
    if (nodes_[k] >= before->end()) break;
    const double b = std::max(fast(nodes_[k]), fast(std::min(nodes_[k + 1], before->end())));
    if (b <= free[k] * 1.0005) continue;
    drawn_ = true;
    for (std::size_t x = 0; x < 3; ++x)
      caps_[k + x] = std::max(caps_[k + x], std::min(drawn_share * b, reach_[k]));
    const double v = std::max(std::sqrt(free[k]), 1e-3);
    pull_[k] = std::min(0.6 / (v * v * v), 3 / (b * std::sqrt(b)));
    weight_[k] = pull_[k] * v * v * v / 0.6;
  }
  std::size_t covered = 0;
  while (covered < m && node(static_cast<std::ptrdiff_t>(covered)) < before->end()) ++covered;
  const double trusted = trusted_share * static_cast<double>(covered);
  piece = before->current();
  for (std::size_t k = 0; k < covered; ++k) {
    const double s =
        std::clamp(0.5 * (node(static_cast<std::ptrdiff_t>(k) - 1) + node(static_cast<std::ptrdiff_t>(k))),
                   nodes_.front(), before->end());
    const double b = std::max(0.25 * end_speed_ * end_speed_, fast(s));
    double part = 0;
    if (static_cast<double>(k) > trusted)
      part = std::min(1.0, (static_cast<double>(k) - trusted) /
                               std::max(1.0, 0.5 * (static_cast<double>(covered) - trusted)));
    part = part * part * (3 - 2 * part);
    guess_[k] = b * (1 - part) + part * std::max(b, guess_[k]);
  }
}

bool SpeedWindow::build(const CellRing& cells, const SpeedRequest& request, const SpeedPlan* before) {
  if (!scan(cells, request) || !cut(request) || !add_rows(cells)) return false;
  bound(request, before);
  return true;
}

double SpeedWindow::use(const CellRing& cells, std::size_t k, const double* b) const {
  const double whole = nodes_[k + 1] - nodes_[k];
  const double time = whole / std::sqrt(std::max(1e-9, std::min(b[0], b[2])));
  const int places = static_cast<int>(std::clamp(time / check_time, 5.0, 20.0));
  std::uint64_t c = spans_[span_of_[k]].cell;
  double most = 0;
  for (int n = 0; n < places; ++n) {
    const double s = nodes_[k] + whole * (n + 0.5) / places;
    while (c + 1 < cells.size() && cells[c].end < s) ++c;
    const LimitCell& cell = cells[c];
    Basis value, first, second;
    basis(k, s, value, first, second);
    const auto sum = [b](const Basis& x) { return x[0] * b[0] + x[1] * b[1] + x[2] * b[2]; };
    const double square = sum(value), slope = sum(first), bend = sum(second);
    const double v = std::sqrt(std::max(0.0, square));
    for (int i = 0; i < cell.known_axes; ++i) {
      const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
      const AxisRates q = exact_rates(axis, part_of(cell, s), cell.end - cell.at);
      const double a = std::abs(q.second * square + 0.5 * q.first * slope);
      const double j = std::abs(q.third * square + 1.5 * q.second * slope + 0.5 * q.first * bend) * v;
      most = std::max({most, a / static_cast<double>(axis.acceleration), j / static_cast<double>(axis.jerk)});
    }
  }
  return most;
}

}  // namespace trunnion::motion
