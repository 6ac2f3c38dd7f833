// SPDX-License-Identifier: Apache-2.0
#include "language/hole_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr double no_peck = 1e-6;  // mm

}  // namespace

void HoleCycle::start(const HoleParameters& parameters) {
  p_ = parameters;
  next_ = count_ = 0;
  depth_ = p_.r;
  peck_ = p_.peck;
  since_out_ = 0;
  out_ = true;
  pecking_ = p_.peck > 0 && (p_.cycle == 73 || p_.cycle == 83 || p_.cycle == 74 || p_.cycle == 84);
  if (p_.cycle != 87) add(Kind::rapid, p_.r);
  if (!pecking_) add_whole_hole();
}

bool HoleCycle::next(HoleStep& step) {
  if (next_ == count_) {
    if (!pecking_) return false;
    next_ = count_ = 0;
    add_peck();
  }
  step = steps_[next_++];
  return true;
}

void HoleCycle::add_dwell() {
  if (p_.dwell > 0) add(Kind::dwell, p_.dwell);
}

void HoleCycle::add_return() {
  if (p_.return_to_initial) add(Kind::rapid, p_.initial);
}

void HoleCycle::add_whole_hole() {
  constexpr std::uint32_t stop = 5;
  constexpr std::uint32_t orient = 19;
  const double out = p_.return_to_initial ? p_.initial : p_.r;
  switch (p_.cycle) {
    case 74:
    case 84:
      add(Kind::tap, p_.z);
      add_dwell();
      add(Kind::tap, p_.r, 1);
      if (!p_.linuxcnc) add_dwell();
      add_return();
      return;
    case 76:
      add(Kind::feed, p_.z);
      add_dwell();
      add(Kind::auxiliary, 0, orient);
      add(Kind::shift);
      add(Kind::rapid, out);
      add(Kind::unshift);
      add(Kind::auxiliary, 0, p_.restart);
      return;
    case 87:
      add(Kind::auxiliary, 0, orient);
      add(Kind::shift);
      add(Kind::rapid, p_.r);
      add(Kind::unshift);
      add(Kind::auxiliary, 0, p_.restart);
      add(Kind::feed, p_.z);
      add_dwell();
      add(Kind::auxiliary, 0, orient);
      add(Kind::shift);
      add(Kind::rapid, p_.initial);
      add(Kind::unshift);
      add(Kind::auxiliary, 0, p_.restart);
      return;
    default:
      break;
  }
  add(Kind::feed, p_.z);
  if (p_.cycle != 81 && p_.cycle != 85) add_dwell();
  if (p_.cycle == 86 || p_.cycle == 88) add(Kind::auxiliary, 0, stop);
  if (p_.cycle == 88) add(Kind::auxiliary, 0, 0);
  if (p_.cycle == 89 && p_.linuxcnc) {
    add(Kind::feed, out);
  } else if (p_.cycle == 85 || p_.cycle == 89) {
    add(Kind::feed, p_.r);
    add_return();
  } else {
    add(Kind::rapid, out);
  }
  if (p_.cycle == 86 || p_.cycle == 88) add(Kind::auxiliary, 0, p_.restart);
}

void HoleCycle::add_peck() {
  const double sense = p_.z < p_.r ? -1 : 1;
  const double from = depth_;
  depth_ = sense < 0 ? std::max(depth_ - peck_, p_.z) : std::min(depth_ + peck_, p_.z);
  if (p_.reduction > 0) peck_ = std::max(peck_ - p_.reduction, p_.least_peck);
  // What rounding leaves below the last whole peck is no peck.
  if (std::abs(p_.z - depth_) < no_peck) depth_ = p_.z;
  // Backing out must not go past R.
  const auto back_out = [&](double level, double by) {
    return sense < 0 ? std::min(level + by, p_.r) : std::max(level - by, p_.r);
  };
  const bool last = depth_ == p_.z;
  pecking_ = !last;
  const bool tapping = p_.cycle == 74 || p_.cycle == 84;
  if (out_ && from != p_.r) add(Kind::rapid, back_out(from, p_.clearance));
  add(tapping ? Kind::tap : Kind::feed, depth_);
  if (last) {
    add_dwell();
    if (tapping) {
      add(Kind::tap, p_.r, 1);
      add_dwell();
      add_return();
    } else {
      add(Kind::rapid, p_.return_to_initial ? p_.initial : p_.r);
    }
    return;
  }
  since_out_ = (out_ ? 0 : since_out_) + std::abs(depth_ - from);
  out_ = p_.cycle == 83 || (p_.between_outs > 0 && since_out_ > p_.between_outs - no_peck);
  if (out_) {
    add(Kind::rapid, p_.r);
    return;
  }
  add(tapping ? Kind::tap : Kind::rapid, back_out(depth_, p_.retract));
}

}  // namespace trunnion::language
