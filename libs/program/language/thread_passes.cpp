// SPDX-License-Identifier: Apache-2.0
#include "language/thread_passes.hpp"

#include <cmath>

#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

/// mm. A pass that rounding leaves this far above the full height would cut nothing.
constexpr double no_depth = 1e-9;

}  // namespace

double ThreadPasses::passes_before_full(const Words& words) {
  return std::pow(words.height / words.first, words.degression);
}

void ThreadPasses::start(const Words& words) {
  w_ = words;
  count_ = 0;
  springs_left_ = words.springs;
  done_ = false;
}

bool ThreadPasses::next(Pass& pass) {
  if (done_) return false;
  double cut = w_.first * std::pow(count_ + 1, 1 / w_.degression);
  if (cut + no_depth >= w_.height) {
    cut = w_.height;
    done_ = springs_left_ == 0;
    if (!done_) --springs_left_;
  } else {
    count_ += 1;
  }
  const double inwards = w_.peak > 0 ? 1 : -1;
  const double forwards = w_.end_z < w_.start_z ? -1 : 1;
  const double slope = std::tan(w_.angle / degrees_per_radian);
  const auto x_at = [&](double depth) { return w_.start_x + inwards * depth; };
  const double depth = std::abs(w_.peak) + cut;
  pass = Pass{};
  pass.away_x = x_at(cut - w_.height);
  pass.bottom_x = x_at(depth);
  pass.begin_z = w_.start_z + forwards * cut * slope;
  pass.end_z = w_.end_z - forwards * (w_.height - cut) * slope;
  pass.tapered_in = w_.taper_in && w_.taper > 0;
  pass.tapered_out = w_.taper_out && w_.taper > 0;
  pass.begin_x = pass.tapered_in ? x_at(depth - w_.height) : pass.bottom_x;
  pass.end_x = pass.tapered_out ? x_at(depth - w_.height) : pass.bottom_x;
  pass.bottom_from_z = pass.begin_z + (pass.tapered_in ? forwards * w_.taper : 0);
  pass.bottom_to_z = pass.end_z - (pass.tapered_out ? forwards * w_.taper : 0);
  return true;
}

}  // namespace trunnion::language
