// SPDX-License-Identifier: Apache-2.0
#include "compensation/reversal_jump.hpp"

#include <cmath>

#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {
namespace {

// From 0 at u = 0 to 1 at u = 1, with no velocity and acceleration at both.
double blend(double u) { return u * u * u * (10 + u * (6 * u - 15)); }

}  // namespace

ReversalJump ReversalJump::read(const machine::Parameters& p, std::uint32_t a) {
  ReversalJump jump;
  const double cycles = 1000.0 / p.integer(parameter::interpolation_cycle);  // in 1 ms
  jump.amount = p.integer(parameter::reversal_type, a) != 0 ? p.get(parameter::reversal_amount, a) : 0;
  jump.delay = p.get(parameter::reversal_delay, a) * cycles;
  jump.rise = p.get(parameter::reversal_acceleration_time, a) * cycles;
  jump.fall = p.get(parameter::reversal_deceleration_time, a) * cycles;
  return jump;
}

double ReversalJump::add(bool reversed, double direction) {
  if (amount == 0) {
    age = -1;
    return 0;
  }
  if (reversed)
    age = 0;
  else if (age >= 0)
    ++age;
  const double time = age - delay;
  if (age < 0 || time <= 0) return 0;
  if (time < rise) return direction * amount * blend(time / rise);
  if (time < rise + fall) return direction * amount * (1 - blend((time - rise) / fall));
  age = -1;
  return 0;
}

}  // namespace trunnion::compensation
