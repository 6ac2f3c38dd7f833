// SPDX-License-Identifier: Apache-2.0
#include "identification/k_test.hpp"

#include <cmath>

#include "identification/r_test_evaluation.hpp"

namespace trunnion::identification {

std::optional<char> axis_of_test(const geometry::Chain& model, KTest test) {
  for (std::size_t i = 0; i < model.rotary_count(); ++i) {
    const auto axis = model.orienting_axis(i);
    const bool along = std::abs(axis.direction.dot(model.tool_direction())) > 0.5;
    if (along == (test == KTest::k2)) return "ABCUVW"[axis.angle];
  }
  return std::nullopt;
}

char annex_of(const machine::MachineOutline& machine) {
  const bool head = machine.design.head_1 || machine.design.head_2;
  const bool table = machine.design.table_1 || machine.design.table_2;
  return head && table ? 'C' : head ? 'A' : 'B';
}

SenseFigures figures_of(const TurnedBall& set, const BallTurn& turn) {
  SenseFigures figures;
  figures.positive = turn.speed > 0;
  std::vector<truth::Vec3> places;
  for (const auto& sample : turn.samples) {
    places.push_back(sample.place);
    figures.angles.push_back(sample.turned);
    figures.deviations.push_back(sample.deviation);
  }
  figures.range = circular_tests::direction_ranges(places, figures.deviations, set.direction, set.centre);
  figures.span = span_of(figures.deviations);
  return figures;
}

}  // namespace trunnion::identification
