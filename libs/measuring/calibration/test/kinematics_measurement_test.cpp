// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "calibration/chain_change.hpp"
#include "calibration/protocol.hpp"
#include "geometry/test/machines.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/chain_section.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/yaml.hpp"
#include "testing_support/refusal.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

const Vec3 sphere(-120, -130, -420);

MeasurementInputs inputs_of(const TrueMachine& machine) {
  auto in = default_inputs(machine.measured);
  in.sphere = sphere;
  in.probe_length = 150;
  return in;
}

ChainParameters wrong(ChainParameters p) {
  p.table_1->offset.y() += 0.2;
  p.table_2->offset += Vec3(-0.1, 0.3, 0.15);
  return p;
}

std::string fault(const std::function<void()>& run) {
  return testing_support::refusal_of([&] { run(); });
}

TEST(KinematicsMeasurement, FindsTheOffsetsOfATableWithIdealDirections) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  const auto result = machine.measure(inputs_of(machine), {}, sphere);
  for (const auto slot : {metrology::Slot::table_1, metrology::Slot::table_2})
    EXPECT_LT((axis_at(result.after, slot)->offset - axis_at(geometry::ac_table(), slot)->offset).norm(),
              1e-6);
  EXPECT_EQ(result.poses[0].difference, Vec3::Zero());
  EXPECT_NEAR(result.largest_change, Vec3(0.1, 0.3, 0.15).norm(), 1e-6);
  EXPECT_THAT(result.warnings, testing::IsEmpty());
  // One axis alone: the circle of C has the direction of its parameters and the distance of the sphere.
  for (const auto& axis : result.axes)
    if (axis.angle == 2) {
      EXPECT_LT((axis.circle.direction + Vec3::UnitZ()).norm(), 1e-8);
      EXPECT_NEAR(axis.circle.radius, (sphere - geometry::ac_table().table_2->offset).head<2>().norm(), 1e-6);
    }
}

TEST(KinematicsMeasurement, CalibratingTheProbeRemovesItsPreTravel) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  touch_probe::TouchProbeTruth probe;
  probe.pre_travel = 0.012;
  auto in = inputs_of(machine);
  const auto plain = machine.measure(in, probe, sphere);
  in.calibrate_probe = true;
  const auto calibrated = machine.measure(in, probe, sphere);
  EXPECT_NEAR(calibrated.ball_diameter, 6 - 2 * 0.012, 1e-6);
  EXPECT_LT((calibrated.after.table_2->offset - geometry::ac_table().table_2->offset).norm(), 1e-6);
  // Without it the pole, which no touch opposes, puts every centre too low: a longer tool does the same.
  EXPECT_NEAR(plain.after.table_2->offset.z() - calibrated.after.table_2->offset.z(), 0, 0.013);
  EXPECT_GT(std::abs(plain.after.table_2->offset.z() - calibrated.after.table_2->offset.z()), 0.005);
}

TEST(KinematicsMeasurement, LimitsStopItWithOneLineAndNumbers) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  auto in = inputs_of(machine);
  in.confidence_range = 0.1;
  EXPECT_THAT(
      fault([&] { machine.measure(in, {}, sphere); }),
      testing::MatchesRegex("pose A.*: the centre of the sphere is 0\\..* mm from the expected one: the "
                            "confidence range is 0.1000 mm; reset"));
  in = inputs_of(machine);
  in.measuring_path = 0.05;
  EXPECT_THAT(fault([&] { machine.measure(in, {}, sphere + Vec3(0.3, 0, 0)); }),
              testing::HasSubstr("touches before the measuring path of 0.05 mm begins"));
  EXPECT_THAT(fault([&] { machine.measure(in, {}, sphere - Vec3(0.3, 0, 0)); }),
              testing::HasSubstr("pose A0 C0, touch 1: no contact within the measuring path of 0.05 mm"));
  in = inputs_of(machine);
  touch_probe::TouchProbeTruth probe;
  probe.pre_travel = 0.03;
  EXPECT_THAT(
      fault([&] { machine.measure(in, probe, sphere); }),
      testing::HasSubstr(
          "measured diameter of the sphere 24.9400 mm, given 25.0000 mm: the tolerance is 0.0500 mm"));
  in = inputs_of(machine);
  in.least_triangle_angle = 60;
  in.axes[0].points = 4;
  EXPECT_THAT(fault([&] { machine.measure(in, {}, sphere); }), testing::HasSubstr("least 60 deg"));
}

TEST(KinematicsMeasurement, AVectorBeyondItsToleranceIsAnAlarm) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  auto in = inputs_of(machine);
  in.vector_tolerance = 0.3;
  EXPECT_THAT(
      machine.measure(in, {}, sphere).tolerance_alarm,
      testing::MatchesRegex("the offset vector of C changes by 0.35.. mm: the tolerance is 0.3000 mm"));
  in.vector_tolerance = 0.4;
  EXPECT_EQ(machine.measure(in, {}, sphere).tolerance_alarm, "");
}

TEST(KinematicsMeasurement, TheNoiseOfEachTouchIsItsOwn) {
  const TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  touch_probe::TouchProbeTruth probe;
  probe.pre_travel = 0.01;  // so that a pre-travel below zero, which there is not, stays out
  probe.repeatability = 0.002;
  auto in = inputs_of(machine);
  in.calibrate_probe = true;
  const auto result = machine.measure(in, probe, sphere);
  // 16 poses of 10 touches less 3 for each centre and 5 for the fit: some 100 degrees of freedom, so the
  // standard deviation is found within 4 / sqrt(200) = 28 %.
  EXPECT_NEAR(result.touch_deviation, 0.002, 0.28 * 0.002);
}

TEST(KinematicsMeasurement, ProbeAndSphereAreThoseOfTheMachineUnlessTheInputsNameOthers) {
  TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  touch_probe::TouchProbeTruth probe;
  probe.length = 143, probe.ball_radius = 2;
  const touch_probe::SphereGauge gauge{sphere, 10, Vec3(0, 0.6, -0.8), 4, 50};
  machine.measured.gauges = probe_and_sphere(probe, {touch_probe::CuboidGauge{}, gauge});
  const auto in = default_inputs(machine.measured);
  EXPECT_EQ(in.probe_length, 143);
  EXPECT_EQ(in.ball_diameter, 4);
  EXPECT_EQ(in.sphere, sphere);
  EXPECT_EQ(in.sphere_diameter, 20);
  EXPECT_EQ(*in.shaft, Vec3(0, 0.6, -0.8));
  EXPECT_EQ(in.shaft_diameter, 8);
  EXPECT_FALSE(probe_and_sphere(probe, {touch_probe::CuboidGauge{}}));
  EXPECT_FALSE(probe_and_sphere(std::nullopt, {gauge}));
  // Where the shaft of the true sphere is not expected, a touch meets it first.
  auto unaware = in;
  unaware.shaft.reset();
  const auto plan = std::get<MeasurementPlan>(plan_measurement(unaware, machine.measured));
  const touch_probe::SphereGauge hidden{sphere, 10, Vec3::UnitX(), 4, 50};
  EXPECT_THAT(
      fault([&] { touch_virtually(machine.report, unaware, machine.measured, plan, probe, {hidden}); }),
      testing::HasSubstr("pose A0 C0, touch 1: the probe touches before the measuring path of 2 mm begins"));
}

TEST(KinematicsMeasurement, GoesOnAfterThePosesThatWereTouchedAndRefusesOthers) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  const auto in = inputs_of(machine);
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto all =
      touch_virtually(machine.report, in, machine.measured, plan, nominal(in), sphere_at(in, sphere));
  std::size_t calls = 0, told = 0;
  const TouchRound again = [&](const PlannedPose& pose, const Vec3&, const std::string&) {
    const auto& stored = *std::find_if(all.begin(), all.end(),
                                       [&](const auto& touched) { return touched.angles == pose.angles; });
    const auto half = static_cast<std::ptrdiff_t>(pose.directions.size());
    const auto from = stored.positions.begin() + (calls++ % 2 == 0 ? 0 : half);
    return std::vector<Vec3>(from, from + half);
  };
  std::vector<TouchedPose> done(all.begin(), all.begin() + 5);
  const auto rest =
      touch_poses(in, machine.measured, plan, again, done, [&](const auto& poses) { told = poses.size(); });
  EXPECT_EQ(text_of(rest, machine.measured.model), text_of(all, machine.measured.model));
  EXPECT_EQ(calls, 2 * (all.size() - 5));
  EXPECT_EQ(told, all.size());
  std::swap(done[2], done[3]);
  EXPECT_THAT(fault([&] { touch_poses(in, machine.measured, plan, again, done); }),
              testing::HasSubstr("is planned; start again"));
  done.resize(2);
  done[1].positions.pop_back();
  EXPECT_THAT(fault([&] { touch_poses(in, machine.measured, plan, again, done); }),
              testing::HasSubstr("has 9 touches, 10 are planned; start again"));
}

TEST(KinematicsMeasurement, TheShaftOfTheSphereIsNotTouched) {
  const TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  auto in = inputs_of(machine);
  in.shaft = Vec3(0, -1, -1);
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto chain = geometry::make(machine.measured.model);
  for (const auto& pose : plan.poses) {
    const Vec3 shaft = (chain.jacobian(sphere, pose.angles, 150).tip * *in.shaft).normalized();
    for (const auto& direction : pose.directions)
      // Ball centre at 15.5 mm, ball and shaft together 7 mm: sin(angle) >= 7 / 15.5 where they face.
      EXPECT_GE(direction.dot(shaft) > 0 ? 15.5 * direction.cross(shaft).norm() : 15.5, 7)
          << pose_name(pose.angles, machine.measured.model);
  }
  in.shaft = Vec3(0, 0, 1);
  EXPECT_THAT(std::get<std::string>(plan_measurement(in, machine.measured)),
              testing::StartsWith("pose A0 C0: the probe would meet the shaft of the sphere by 7.00 mm"));
}

TEST(KinematicsMeasurement, APoseBeyondTheTravelIsNamedBeforeAnyTouch) {
  TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  machine.measured.outline.axes[1] = {true, -300, 300};
  EXPECT_THAT(std::get<std::string>(plan_measurement(inputs_of(machine), machine.measured)),
              testing::MatchesRegex("pose A.*: Y -3..\\.... mm is not within its travel -300 .. 300 mm"));
}

TEST(KinematicsMeasurement, NormalizationKeepsOrSetsTheComponentOfTheRootVector) {
  auto real = geometry::nutating_b_head_c_table();
  auto model = real;
  model.head_2->offset += Vec3(0.2, 0.1, -0.3);
  const TrueMachine machine(real, model);
  auto in = inputs_of(machine);
  in.sphere = Vec3(60, 80, -300);
  in.confidence_range = 2;
  for (auto& range : in.axes)
    if (range.angle == 1) range.normalization = 3, range.normalized_value = -200;
  const auto result = machine.measure(in, {}, in.sphere);
  // The vector counts from B to the spindle: minus the offset. Slid along (0, 1, 1) until Z is -200.
  const Vec3 vector = -result.after.head_2->offset, slid = vector + real.head_2->offset;
  EXPECT_NEAR(vector.z(), -200, 1e-9);
  EXPECT_LT(slid.cross(Vec3(0, 1, 1)).norm() / std::sqrt(2.0), 1e-6) << "the axis is the same";
  for (auto& range : in.axes)
    if (range.angle == 1) range.normalization = 1;
  EXPECT_THAT(fault([&] { machine.measure(in, {}, in.sphere); }),
              testing::HasSubstr("normalizations do not fix"));
}

// The chain of the nutating machine as machine.yaml has it, with two named corrections.
constexpr const char* named_chain = R"(- elements:
    - {name: TABLE_OFFSET, offset: [10, 20, 0]}
    - {name: CORR_C_OFFSET, correction: [0.1, 0, 0]}
    - {name: C_AXIS, rotary: C, direction: [0, 0, -1]}
    - {name: X_AXIS, linear: X}
    - {name: Y_AXIS, linear: Y}
    - {name: Z_AXIS, linear: Z}
    - {name: B_AXIS, rotary: B, direction: [0, 0.7071067811865476, 0.7071067811865476]}
    - {name: CORR_SP1_OFFSET, correction: [0, 0, 0]}
    - {name: SP1_OFFSET, offset: [-0.1, 0.2, -190]}
)";

// Both chains put the ball into the sphere at the same positions of X, Y and Z; each has its own place of the
// sphere in the workpiece frame.
void expect_same_motion(const ChainParameters& found, const Vec3& found_sphere, const ChainParameters& real,
                        const Vec3& real_sphere) {
  const auto a = geometry::make(found), b = geometry::make(real);
  for (double angle = -80; angle <= 80; angle += 16) {
    const Angles angles{angle, angle, -2.5 * angle};
    EXPECT_LT(
        (a.machine_from_tip(found_sphere, angles, 150) - b.machine_from_tip(real_sphere, angles, 150)).norm(),
        1e-6)
        << angle;
  }
}

TEST(KinematicsMeasurement, NamedCorrectionsTakeWhatIsFoundAndTheOffsetsStay) {
  machine::Parameters parameters;
  parameters.values = machine::read_chain_parameters(machine::parse_yaml(named_chain, "m"), "m");
  const auto model = machine::chain_parameters(parameters, 0);
  const auto named = named_corrections(parameters, 0);
  EXPECT_EQ(std::count(named.begin(), named.end(), true), 2);
  auto real = model;
  real.head_2->offset += Vec3(0.2, 0, -0.3);
  real.table_2->offset += Vec3(-0.15, 0.25, 0);
  const TrueMachine machine(real, model);
  auto in = inputs_of(machine);
  in.sphere = Vec3(60, 80, -300);
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto touched =
      touch_virtually(machine.report, in, machine.measured, plan, nominal(in), sphere_at(in, in.sphere));
  const auto result = evaluate(in, machine.measured, touched, named);
  for (const auto slot : {metrology::Slot::table_2, metrology::Slot::head_2}) {
    const auto &before = *axis_at(model, slot), &after = *axis_at(result.after, slot);
    EXPECT_EQ(after.offset, before.offset);
    EXPECT_LT(
        (after.offset + after.correction - axis_at(real, slot)->offset - axis_at(real, slot)->correction)
            .norm(),
        1e-6);
  }
  expect_same_motion(result.after, result.sphere, real, in.sphere);
  // The protocol's vectors are offset and correction together, before and after.
  for (const auto& vector : result.vectors) {
    const auto &before = *axis_at(model, vector.slot), &now = *axis_at(real, vector.slot);
    EXPECT_LT((vector.before - before.offset - before.correction).norm(), 1e-12);
    EXPECT_LT((vector.after - now.offset - now.correction).norm(), 1e-6);
  }
  // Only 040960 .. 962 and 040969 .. 971 are written.
  const auto written = changed_parameters(result.before, result.after, 0);
  EXPECT_FALSE(written.empty());
  for (const auto& [number, value] : written)
    EXPECT_TRUE((number >= 40960 && number <= 40962) || (number >= 40969 && number <= 40971)) << number;
}

TEST(KinematicsMeasurement, AnOpenChainTakesWhatIsFoundAsCorrectionsAndDoesNotEndWhereItBegan) {
  const auto model = geometry::cb_head();
  auto real = model;
  real.head_2->offset += Vec3(0.2, 0, -0.3);
  real.head_1->offset += Vec3(0.1, -0.25, 0);
  const TrueMachine machine(real, model);
  auto in = inputs_of(machine);
  in.sphere = Vec3(60, 80, -300);
  // 0 of each axis keeps the change across it, 10 more open the chain.
  for (auto& range : in.axes) range.normalization = 10;
  const auto result = machine.measure(in, {}, in.sphere);
  EXPECT_TRUE(result.after.open);
  for (const auto slot : {metrology::Slot::head_1, metrology::Slot::head_2}) {
    EXPECT_EQ(axis_at(result.after, slot)->offset, axis_at(model, slot)->offset);
    EXPECT_LT(
        (axis_at(result.after, slot)->correction - axis_at(real, slot)->offset + axis_at(model, slot)->offset)
            .norm(),
        1e-6);
  }
  expect_same_motion(result.after, result.sphere, real, in.sphere);
  // The corrections move the workpiece frame: with every axis at zero the tip is by their sum elsewhere.
  Vec3 sum = Vec3::Zero();
  for (const auto* axis : {&result.after.head_1, &result.after.head_2}) sum += (*axis)->correction;
  EXPECT_LT((geometry::make(result.after).tip_from_machine(Vec3::Zero(), {}, 150) -
             geometry::make(model).tip_from_machine(Vec3::Zero(), {}, 150) + sum)
                .norm(),
            1e-9);
  const auto written = changed_parameters(result.before, result.after, 0);
  EXPECT_EQ(written.at(parameter::chain_open.number(0)).value, 1);
  for (const auto& [number, value] : written)
    EXPECT_TRUE(number == parameter::chain_open.number(0) || (number >= 40960 && number <= 40980)) << number;
  in.axes[0].normalization = 0;
  EXPECT_THAT(fault([&] { machine.measure(in, {}, in.sphere); }),
              testing::HasSubstr("the chain is open for all axes or for none"));
}

TEST(KinematicsMeasurement, AdaptPutsAnotherHeadsEndWhereTheReferenceHadIt) {
  auto real = geometry::cb_head(), model = real;
  real.origin = Vec3(0.4, -0.2, 0.1);  // the other head sits elsewhere on its flange
  const TrueMachine machine(real, model);
  auto in = inputs_of(machine);
  in.sphere = Vec3(60, 80, -300);
  in.reference = Reference::adapt;
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto touched =
      touch_virtually(machine.report, in, machine.measured, plan, nominal(in), sphere_at(in, in.sphere));
  in.reference_measurement = {in.sphere, Vec3::Zero()};
  const auto result = evaluate(in, machine.measured, touched);
  EXPECT_LT((result.after.origin - real.origin).norm(), 1e-6);
  in.reference_measurement->zero_offset.x() = 5;
  EXPECT_THAT(fault([&] { evaluate(in, machine.measured, touched); }),
              testing::HasSubstr("is not the one of the reference, 5.0000 0.0000 0.0000 mm"));
  in.reference_measurement.reset();
  EXPECT_THAT(fault([&] { evaluate(in, machine.measured, touched); }),
              testing::HasSubstr("no reference was measured"));
}

TEST(KinematicsMeasurement, ProtocolHasPosesVectorsAndTheSameBytesForTheSameInputs) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  const auto in = inputs_of(machine);
  touch_probe::TouchProbeTruth probe;
  probe.repeatability = 0.001;
  const auto result = machine.measure(in, probe, sphere);
  const ProtocolHead head{"2026-01-31", "12:00:00", "p.txt", "virtual"};
  const auto text = protocol_text(head, in, machine.measured, result);
  EXPECT_EQ(text, protocol_text(head, in, machine.measured, machine.measure(in, probe, sphere)));
  for (const char* part :
       {"Date     : 2026-01-31   Time: 12:00:00", "type P, measure only", "Rotary axis 1   : A",
        "Difference of measure:", "C after", "A uncertainty (95 %)", "A real"})
    EXPECT_THAT(text, testing::HasSubstr(part));
}

TEST(KinematicsMeasurement, TouchesReadFromTheirTextGiveTheSameResult) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  const auto in = inputs_of(machine);
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto touched =
      touch_virtually(machine.report, in, machine.measured, plan, nominal(in), sphere_at(in, sphere));
  const auto again = parse_touches(text_of(touched, machine.measured.model), "t", machine.measured.model);
  ASSERT_EQ(again.size(), touched.size());
  EXPECT_EQ(again[3].positions.size(), 10u) << "2 x (4 + 1)";
  const auto a = evaluate(in, machine.measured, touched), b = evaluate(in, machine.measured, again);
  EXPECT_LT((a.after.table_2->offset - b.after.table_2->offset).norm(), 2e-6) << "the text has 1e-6 mm";
  // A pose by other turns of its axes is the same pose.
  auto turned = again;
  for (auto& pose : turned) pose.angles[2] -= 360;
  EXPECT_LT((evaluate(in, machine.measured, turned).after.table_2->offset - b.after.table_2->offset).norm(),
            2e-6);
  auto less = again;
  less.erase(less.begin() + 4);
  EXPECT_THAT(fault([&] { evaluate(in, machine.measured, less); }),
              testing::HasSubstr("is missing among the touches"));
  less = again;
  less.erase(less.begin());
  EXPECT_THAT(fault([&] { evaluate(in, machine.measured, less); }),
              testing::HasSubstr("begins at the initial pose A0 C0"));
}

TEST(KinematicsMeasurement, AWholeTurnHasAPoseAtBothItsEnds) {
  const TrueMachine machine(geometry::ac_table(), wrong(geometry::ac_table()));
  auto in = inputs_of(machine);
  for (auto& range : in.axes)
    if (range.angle == 2) range.start = -180, range.end = 180, range.points = 5;
  const auto result = machine.measure(in, {}, sphere);
  const auto& c = result.axes[in.axes[0].angle == 2 ? 0 : 1];
  EXPECT_NE(c.rows.front(), c.rows.back());
}

TEST(ChainChange, OnlyChangedComponentsBecomeParameters) {
  auto before = geometry::ac_table(), after = before;
  after.table_1->offset.y() += 0.01;
  after.table_2->correction.x() = 0.2;
  after.table_2->direction = Vec3(1e-4, 0, -1);
  const auto values = changed_parameters(before, after, 1);
  std::string numbers;
  for (const auto& [number, value] : values) numbers += machine::number_text(number) + " ";
  EXPECT_EQ(numbers, "041429 041433 041960 ");
  after.table_2->correction.x() = 2000;
  EXPECT_THAT(fault([&] { changed_parameters(before, after, 0); }), testing::StartsWith("nothing written: "));
}

}  // namespace
}  // namespace trunnion::calibration
