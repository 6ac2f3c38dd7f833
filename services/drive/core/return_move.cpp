// SPDX-License-Identifier: Apache-2.0
#include "return_move.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trunnion::drive {

double quintic_seconds(double distance, double velocity, double acceleration) {
  return std::max(1.875 * distance / velocity, std::sqrt(5.774 * distance / acceleration));
}

void ReturnMove::start(const std::vector<double>& from, const std::vector<double>& to, double seconds,
                       double period) {
  from_ = from;
  to_ = to;
  periods_ = static_cast<std::uint32_t>(
      std::min<double>(std::ceil(seconds / period), std::numeric_limits<std::uint32_t>::max()));
  done_ = 0;
}

bool ReturnMove::step(std::vector<double>& place) {
  ++done_;
  const double u = static_cast<double>(done_) / periods_;
  const double s = u * u * u * (10 + u * (6 * u - 15));
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = from_[i] + s * (to_[i] - from_[i]);
  if (done_ < periods_) return false;
  place = to_;
  return true;
}

}  // namespace trunnion::drive
