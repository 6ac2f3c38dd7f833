// SPDX-License-Identifier: Apache-2.0
// The calls of the manual's sample programs, and what is refused.
#include "calibration/cycle_arguments.hpp"

#include <gmock/gmock.h>

#include "calibration/measurement_file.hpp"
#include "geometry/test/machines.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

using testing::HasSubstr;

// Argument 2 is a text and never a number.
CycleArguments arguments(std::vector<double> numbers) {
  CycleArguments result;
  unsigned place = 1;
  for (const double value : numbers) {
    if (place == 2) ++place;
    result[place++] = value;
  }
  return result;
}

const TrueMachine table(geometry::ac_table(), geometry::ac_table());

MeasurementInputs taken(const CycleArguments& given, const MeasuredMachine& machine) {
  return parse_inputs(inputs_text(given, machine), "inputs", machine);
}
std::string refused(CycleArguments given) {
  try {
    inputs_text(given, table.measured);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "taken";
}
CycleArguments sample_of_table() {
  return arguments({11400, 1, 30, 0, -90, 0, 3, 0, 0, 0, 240, 3, 0, 0.001, 2, 2, 1, 1, 0, 1});
}

TEST(CycleArguments, SampleProgramOfAMachineWithTable) {
  const auto in = taken(sample_of_table(), table.measured);
  EXPECT_EQ(in.mode, Mode::correct);
  EXPECT_EQ(in.positioning, Positioning::circular);
  EXPECT_EQ(in.reference, Reference::without);
  EXPECT_EQ(in.plane, Plane::active);
  EXPECT_FALSE(in.calibrate_probe || in.vector_tolerance);
  EXPECT_EQ(in.sphere_diameter, 30);
  EXPECT_EQ(in.measuring_path, 2);
  EXPECT_EQ(in.confidence_range, 2);
  // Its protocol: A start -90 final 0 no. 3, C start 0 final 240 no. 3.
  ASSERT_EQ(in.axes.size(), 2u);
  EXPECT_EQ(in.axes[0].angle, 0u);
  EXPECT_EQ(in.axes[0].start, -90);
  EXPECT_EQ(in.axes[0].end, 0);
  EXPECT_EQ(in.axes[0].points, 3u);
  EXPECT_EQ(in.axes[0].other, 0);
  EXPECT_EQ(in.axes[1].angle, 2u);
  EXPECT_EQ(in.axes[1].end, 240);
}

TEST(CycleArguments, SampleProgramOfAMachineWithHead) {
  const TrueMachine head(geometry::ca_head(), geometry::ca_head());
  const auto in = taken(
      arguments({11400, 1, 30, 0, 0, 240, 3, 90, 0, -90, 90, 3, 0, 0.001, 2, 2, 1, 1, 0, 1}), head.measured);
  // Its protocol: rotary axis 1: C 0 to 240 with rotary axis 2 at 90; rotary axis 2: A -90 to 90 with C at 0.
  ASSERT_EQ(in.axes.size(), 2u);
  EXPECT_EQ(in.axes[0].angle, 2u);
  EXPECT_EQ(in.axes[0].end, 240);
  EXPECT_EQ(in.axes[0].other, 90);
  EXPECT_EQ(in.axes[1].angle, 0u);
  EXPECT_EQ(in.axes[1].start, -90);
  EXPECT_EQ(in.axes[1].other, 0);
}

TEST(CycleArguments, SampleProgramOfAMixedMachineCountsTheHeadFirst) {
  const TrueMachine mixed(geometry::nutating_b_head_c_table(), geometry::nutating_b_head_c_table());
  // B within 120 degrees of this machine, otherwise as printed.
  const auto in = taken(arguments({11400, 1, 30, 0, 0, 90, 3, 0, 0, 0, 240, 3, 0, 0.001, 2, 2, 1, 1, 0, 1}),
                        mixed.measured);
  ASSERT_EQ(in.axes.size(), 2u);
  EXPECT_EQ(in.axes[0].angle, 1u);
  EXPECT_EQ(in.axes[0].end, 90);
  EXPECT_EQ(in.axes[1].angle, 2u);
  EXPECT_EQ(in.axes[1].end, 240);
}

TEST(CycleArguments, SampleProgramOfADividingUnitHasATolerance) {
  const TrueMachine unit(geometry::a_table(), geometry::a_table());
  const auto in = taken(arguments({11400, 1, 30, 0, -90, 90, 6, 0, 0, 0, 0, 3, 0, 0.1, 3, 2, 1, 1, 10, 1}),
                        unit.measured);
  ASSERT_EQ(in.axes.size(), 1u);
  EXPECT_EQ(in.axes[0].angle, 0u);
  EXPECT_EQ(in.axes[0].points, 6u);
  EXPECT_EQ(in.measuring_path, 3);
  EXPECT_EQ(*in.vector_tolerance, 0.1);
}

TEST(CycleArguments, EveryDigitOfTheVariant) {
  auto given = sample_of_table();
  given[1] = 20411;  // measure the reference, measure only, paraxial, calibrate
  const auto in = taken(given, table.measured);
  EXPECT_EQ(in.reference, Reference::measure);
  EXPECT_EQ(in.mode, Mode::measure_only);
  EXPECT_EQ(in.positioning, Positioning::paraxial);
  EXPECT_TRUE(in.calibrate_probe);
}

TEST(CycleArguments, LeftOutOnesAreThoseOfTheMachine) {
  const auto in = taken({{1, 10400}}, table.measured), defaults = default_inputs(table.measured);
  ASSERT_EQ(in.axes.size(), defaults.axes.size());
  EXPECT_EQ(in.axes[0].start, defaults.axes[0].start);
  EXPECT_EQ(in.sphere_diameter, defaults.sphere_diameter);
}

TEST(CycleArguments, NameWhatIsRefused) {
  const auto with = [](unsigned place, double value) {
    auto given = sample_of_table();
    given[place] = value;
    return refused(given);
  };
  EXPECT_EQ(with(1, 11402), "CYCLE9960, argument 1 (S_MVAR): 11402: digit 2 of the ones is not known");
  EXPECT_THAT(with(1, 11420), HasSubstr("digit 2 of the tens"));
  EXPECT_THAT(with(1, 11300), HasSubstr("digit 3 of the hundreds"));
  EXPECT_THAT(with(1, 13400), HasSubstr("digit 3 of the thousands"));
  EXPECT_THAT(with(1, 1400), HasSubstr("digit 0 of the ten thousands"));
  EXPECT_THAT(with(1, 111400), HasSubstr("is no whole number from 0 to 99999"));
  EXPECT_THAT(with(1, -1), HasSubstr("is no whole number"));
  EXPECT_THAT(with(3, 2), HasSubstr("argument 3 (number of the probe): 2 is not 1"));
  EXPECT_EQ(with(4, 250), "CYCLE9960, argument 4 (diameter of the sphere): 250 is not within 1 .. 200");
  EXPECT_THAT(with(8, 13),
              HasSubstr("argument 8 (rotary axis 1, number of points): 13 is not within 3 .. 12"));
  EXPECT_THAT(with(8, 3.5), HasSubstr("argument 8"));
  EXPECT_THAT(with(16, 0), HasSubstr("argument 16 (measuring path): 0 is not within 0.01 .. 100"));
  EXPECT_THAT(with(20, 4), HasSubstr("argument 20 (plane and tolerance): 4: digit 4 of the ones"));
  EXPECT_EQ(with(7, -95), "CYCLE9960: axis A: start angle -90 deg is not below end angle -95 deg");
  EXPECT_THAT(refused({}), HasSubstr("argument 1 (S_MVAR): it is missing"));
}

TEST(CycleArguments, TheProbeStandsOverThePoleAsInTheSamplePrograms) {
  auto in = taken(sample_of_table(), table.measured);
  in.ball_diameter = 6, in.probe_length = 100;
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(table.measured.model));
  // The tip is 20 mm over the centre: G0 Z20 with the zero of the workpiece in it.
  const Vec3 centre(-120, -130, -420);
  const Vec3 at = chain.machine_from_tip(centre + Vec3(0, 0, 20), {}, in.probe_length);
  const auto found = sphere_under_probe(in, table.measured, {at.x(), at.y(), at.z()});
  EXPECT_LT((found - centre).norm(), 1e-9);
}

}  // namespace
}  // namespace trunnion::calibration
