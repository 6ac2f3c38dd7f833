// SPDX-License-Identifier: Apache-2.0
// The planner allocates when it is constructed and never afterwards.
#include <gtest/gtest.h>

#include "motion_fixture.hpp"
#include "testing_support/allocation_count.hpp"

namespace trunnion::motion::test {
namespace {

using testing_support::allocations;

TEST(Allocation, none_while_planning_stepping_holding_going_back_and_aborting) {
  const geometry::Chain chain = ac_table();
  const Limits limits = uniform_limits(300, 3000, 4);
  Trajectory t(limits, &chain, cycle);
  const std::size_t before = allocations;
  for (const auto frame : {canonical::Transformation::none, canonical::Transformation::rtcp}) {
    AxisValues p{};
    t.start(p, frame, 80);
    for (std::uint32_t k = 1; k <= 300; ++k) {
      p[0] += 0.2;
      p[1] = std::sin(0.1 * k);
      p[canonical::C] += 0.2;
      ASSERT_TRUE(t.push(line_to(p, 3000, k)));
    }
    const double x = p[0], y = p[1];
    p[0] += 10;
    ASSERT_TRUE(t.push(arc_to(p, x + 5, y, 180, false, 20000)));
    Command dwell;
    dwell.kind = CommandKind::dwell;
    dwell.dwell_seconds = 0.01;
    ASSERT_TRUE(t.push(dwell));
    t.finish();
    for (int k = 0; k < 2200; ++k) {
      if (k == 700) t.retrace(true);
      if (k == 1100) t.retrace(false);
      if (k == 2150) t.abort();
      t.step(k % 300 < 100 ? 1.5 : 1, 1, k % 400 > 350);
    }
    EXPECT_GT(t.position()[0], 1);
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace trunnion::motion::test
