// SPDX-License-Identifier: Apache-2.0
#include "thread_following.hpp"

#include <cmath>

namespace trunnion::drive {
namespace {

constexpr double least_turn = 1e-6;  // rev in a cycle: a slower spindle stands
constexpr double least_rate = -0.5;  // cycles in a period: the axes go on at no less than half of their speed
constexpr double end_approach = 0.5;  // cycles of the shift for each that is left

// Angles of consecutive setpoints; `at` is that of the cycle that is passed.
struct AngleRow {
  std::array<double, ThreadFollowing::back + ThreadFollowing::most_ahead + 1> value{};
  std::size_t count = 0, at = 0;
};

struct ThreadPlace {
  double shift = 0;
  bool known = true;    // false: it is behind the end of the thread
  bool beyond = false;  // it is farther than a shift reaches
};

ThreadPlace place_of(double angle, const AngleRow& row, std::size_t ahead) {
  const std::size_t last = row.count - 1;
  const double turned = row.value[last] - row.value[0];
  if (last == 0 || std::abs(turned) < least_turn * static_cast<double>(last)) return {};
  const double sense = turned < 0 ? -1 : 1;
  const auto passed = [&](std::size_t k) { return sense * (angle - row.value[k]) >= 0; };
  std::size_t k = row.at;
  while (k < last && passed(k + 1)) ++k;
  while (k > 0 && !passed(k)) --k;
  const double whole = static_cast<double>(k) - static_cast<double>(row.at);
  if (!passed(k)) return {whole, true, row.at == ThreadFollowing::back};
  if (k == last) {
    const bool beyond = angle != row.value[last], reached = last - row.at == ahead;
    return {whole, reached || !beyond, reached && beyond};
  }
  return {whole + (angle - row.value[k]) / (row.value[k + 1] - row.value[k])};
}

double within_reach(double shift) {
  return std::clamp(shift, -static_cast<double>(ThreadFollowing::back),
                    static_cast<double>(ThreadFollowing::most_ahead));
}

}  // namespace

// The rate is that of the place, and what closes up to it: no more than the change of rate can brake again.
// From the rate v with the change s the shift still moves by v^2 / (2 s) + v / 2. It overshoots by at most s
// / 8.
void ThreadFollowing::move(Shift& shift, double place, const ThreadLimits& limits) {
  const double moved = place - shift.place, behind = shift.place - shift.cycles;
  const double slack = limits.change / 2;
  const double braking = std::sqrt(slack * slack + 2 * limits.change * std::abs(behind)) - slack;
  const double closing = std::copysign(std::min(std::abs(behind), braking), behind);
  const double wanted = std::clamp(moved + closing, least_rate, limits.rate);
  shift.rate = std::clamp(wanted, shift.rate - limits.change, shift.rate + limits.change);
  shift.cycles = within_reach(shift.cycles + shift.rate);
  shift.place = place;
}

// The speed is the mean of a period, so the angle of the next one is speed + change farther. The lag is that
// of a position loop, of the first order: the speed at the end of the period makes up for it.
void ThreadFollowing::follow(const ThreadSpindle& spindle, const ThreadAngles& angles,
                             std::span<const double> lags, const ThreadLimits& limits) {
  active_ = true;
  const double change = speed_known_ ? spindle.speed - speed_ : 0;
  speed_ = spindle.speed;
  speed_known_ = true;
  const double periods = spindle.periods;
  const double angle = spindle.angle + periods * (spindle.speed + (periods + 1) / 2 * change);
  const double speed = spindle.speed + (periods + 0.5) * change;

  AngleRow row;
  for (std::size_t k = angles_kept_; k > 0; --k) row.value[row.count++] = angles_[k - 1];
  row.at = row.count;
  const std::size_t reach = std::min(angles.ahead, most_ahead);
  for (std::size_t k = 0; k < std::min(angles.next.size(), reach + 1); ++k)
    row.value[row.count++] = angles.next[k];
  if (row.count == row.at) return hold(lags.size(), limits);

  // A stream that ends does so with its last setpoint.
  const double earliest = -end_approach * static_cast<double>(angles.left);
  bool beyond = false;
  for (std::size_t i = 0; i < std::min(lags.size(), most_columns); ++i) {
    const auto place = place_of(angle + lags[i] * speed, row, reach);
    beyond = beyond || place.beyond;
    move(shifts_[i], std::max(place.known ? place.shift : shifts_[i].place, earliest), limits);
  }
  if (beyond) ++beyond_;
}

void ThreadFollowing::hold(std::size_t columns, const ThreadLimits& limits) {
  speed_known_ = false;
  for (std::size_t i = 0; i < std::min(columns, most_columns); ++i) {
    auto& shift = shifts_[i];
    shift.rate = std::clamp(0.0, shift.rate - limits.change, shift.rate + limits.change);
    shift.cycles = shift.place = within_reach(shift.cycles + shift.rate);
  }
}

void ThreadFollowing::fade(std::size_t columns, const ThreadLimits& limits) {
  speed_known_ = false;
  bool shifted = false;
  for (std::size_t i = 0; i < std::min(columns, most_columns); ++i) {
    auto& shift = shifts_[i];
    shift.place = 0;
    move(shift, 0, limits);
    shifted = shifted || shift.cycles != 0 || shift.rate != 0;
  }
  if (!shifted) clear();
}

void ThreadFollowing::keep(std::uint64_t cycle, std::span<const double> setpoints, const double* angle) {
  for (std::size_t k = back - 1; k > 0; --k) {
    rows_[k] = rows_[k - 1];
    angles_[k] = angles_[k - 1];
  }
  std::copy_n(setpoints.begin(), std::min(setpoints.size(), most_columns), rows_[0].begin());
  rows_kept_ = std::min(rows_kept_ + 1, back);
  angles_kept_ = angle != nullptr ? std::min(angles_kept_ + 1, back) : 0;
  if (angle != nullptr) angles_[0] = *angle;
  next_ = cycle + 1;
}

const double* ThreadFollowing::kept(std::uint64_t cycle) const {
  if (rows_kept_ == 0 || cycle >= next_) return nullptr;
  return rows_[std::min<std::uint64_t>(next_ - cycle, rows_kept_) - 1].data();
}

}  // namespace trunnion::drive
