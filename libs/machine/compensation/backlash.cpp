// SPDX-License-Identifier: Apache-2.0
#include "compensation/backlash.hpp"

#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

Backlash Backlash::read(const machine::Parameters& p, std::uint32_t a) {
  Backlash backlash;
  const int type = p.integer(parameter::backlash_type, a);
  backlash.amount = type != 0 ? p.get(parameter::backlash, a) : 0;
  backlash.rate = p.get(parameter::backlash_rate, a);
  backlash.has_rapid = type == 2;
  backlash.rapid = p.get(parameter::backlash_rapid, a);
  const double seconds = p.integer(parameter::interpolation_cycle) * 1e-6;
  // A move at the maximum feed itself is no rapid traverse, whatever its setpoints are rounded to.
  backlash.rapid_step = p.get(parameter::maximum_feed, a) / 60 * seconds * (1 + 1e-6);
  return backlash;
}

}  // namespace trunnion::compensation
