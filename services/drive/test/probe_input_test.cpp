// SPDX-License-Identifier: Apache-2.0
// The touch probe of a machine with a truth.yaml, in motion.
#include <gtest/gtest.h>

#include <cmath>

#include "bus/json.hpp"
#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "simulated_hardware.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::StreamRequestKind;

// X, Y, Z and the table C, which turns about -Z through the machine's zero point.
machine::Parameters machine_xyzc() {
  machine::Parameters p;
  p.revision = 1;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""}, p.values[40003] = {2, ""}, p.values[40006] = {3, ""};
  const char* const names[] = {"X", "Y", "Z", "C"};
  for (std::uint32_t a = 0; a < 4; ++a) {
    p.values[100000 + a * 1000] = {0, names[a]};
    p.values[100034 + a * 1000] = {60000, ""};
    p.values[100036 + a * 1000] = {4000, ""};
  }
  p.values[103001] = {3, ""};
  return p;
}

geometry::ChainParameters design() {
  geometry::ChainParameters p;
  p.table_2 = geometry::RotaryAxis{-truth::Vec3::UnitZ(), truth::Vec3::Zero(), 2};
  return p;
}

// A ball of 3 mm on a probe of 100 mm, a sphere of 25 mm at X100 Z-200 in the workpiece frame.
ProbeSetup setup(const truth::GeometryTruth& errors = {}) {
  touch_probe::TouchProbeTruth probe;
  probe.ball_radius = 3, probe.length = 100;
  return {design(),
          std::get<truth::TrueGeometry>(truth::TrueGeometry::make(design(), errors)),
          probe,
          {touch_probe::SphereGauge{{100, 0, -200}, 12.5}}};
}

struct Probe : ::testing::Test, EncoderRowSink {
  void skip_edge(std::uint64_t number, const idl::stream::SkipEdge& edge) override {
    edges.push_back(edge);
    edges.back().cycle = number;
  }
  void encoder_row(const EncoderRow&) override {}
  void make(const ProbeSetup& of) {
    input.emplace(of);
    input->configure(machine_xyzc(), machine::drive_axes(machine_xyzc()));
  }
  /// The axes are there at the end of the next period.
  void at(std::array<double, 4> place, bool on = true) {
    row.number++;
    row.probe_on = on;
    row.axes.resize(4);
    for (std::size_t i = 0; i < 4; ++i) servos[i].place(place[i]);
    input->step(row, 0.001, servos, {}, *this);
  }
  std::optional<ProbeInput> input;
  std::vector<SimulatedAxis> servos{4};
  std::vector<idl::stream::SkipEdge> edges;
  SetpointRow row;
};

TEST_F(Probe, TheEdgeIsLatchedAtTheTouchWithinThePeriod) {
  make(setup());
  // From above: the ball's centre touches at Z -200 + 12.5 + 3, the spindle face is 100 above.
  at({100, 0, -84, 0});
  at({100, 0, -84.3, 0});
  EXPECT_TRUE(edges.empty());
  at({100, 0, -85, 0});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].input, 1);
  EXPECT_EQ(edges[0].cycle, 4u) << "before the row behind the third";
  EXPECT_NEAR(edges[0].position[2], -84.5, 1e-8);
  EXPECT_TRUE(input->on());
  at({100, 0, -84, 0});
  EXPECT_FALSE(input->on());
  EXPECT_EQ(edges.size(), 1u);
}

// The Z axis grows by 100 um/K and warms up by 1 K within seconds; every touch has noise of its own. A
// second process that takes over what the first keeps finds the next touches at the same places; one that
// does not, at others.
TEST_F(Probe, WhatItKeepsLetsANewProcessGoOnWithTheSameTemperaturesAndNoise) {
  truth::GeometryTruth errors;
  errors.heat[2].constant_rise = 1, errors.heat[2].time_constant = 1, errors.heat[2].shift = {0, 0, 0.1};
  auto of = setup(errors);
  of.probe.repeatability = 0.005, of.probe.pre_travel = 0.03;
  const auto touch = [&] {
    const auto before = edges.size();
    at({100, 0, -80, 0});
    at({100, 0, -85, 0});
    at({100, 0, -80, 0});
    return edges.size() == before + 1 ? edges.back().position[2] : std::nan("");
  };
  make(of);
  servos[2].place(-80);
  for (int i = 0; i < 5; ++i) touch();
  const auto kept = input->memory();
  EXPECT_EQ(kept.touches.touches, 5u);
  const double first = touch(), second = touch();
  ASSERT_TRUE(std::isfinite(first) && std::isfinite(second));
  make(of);
  input->restore(kept);
  EXPECT_EQ(touch(), first);
  EXPECT_EQ(touch(), second);
  make(of);
  EXPECT_NE(touch(), first) << "a cold machine with the first number of the seed";
}

TEST_F(Probe, SwitchedOffItGivesNothingAndSwitchedOnInContactNoEdge) {
  make(setup());
  at({100, 0, -84, 0}, false);
  at({100, 0, -85, 0}, false);
  EXPECT_FALSE(input->on());
  at({100, 0, -85, 0});
  EXPECT_TRUE(input->on());
  EXPECT_TRUE(edges.empty());
  at({100, 0, -85, 0}, false);
  EXPECT_FALSE(input->on());
}

TEST_F(Probe, TheSphereTurnsWithTheTrueAxisOfTheTable) {
  truth::GeometryTruth errors;
  errors.axes[5].displacement = {0.05, -0.02, 0};
  make(setup(errors));
  // By half a turn about (0.05, -0.02) the centre comes to (2 * 0.05 - 100, 2 * -0.02). Touched along +X at
  // its height: 15.5 before it.
  const double y = -0.04, z = -100;
  at({-120, y, z, 180});
  at({-110, y, z, 180});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].position[0], -99.9 - 15.5, 1e-8);
}

TEST_F(Probe, ItContinuesFromItsExplicitStateWithTheSameBits) {
  auto noisy = setup();
  noisy.probe.repeatability = 0.01, noisy.probe.delay = 0.0025, noisy.probe.pre_travel = 0.05;
  make(noisy);
  const auto z = [](int k) { return -84.5 + 0.9 * std::cos(0.31 * k); };
  for (int k = 0; k < 57; ++k) at({100, 0, z(k), 0});
  const auto state = bus::Json::parse(bus::text_of(snapshot::written(*input)));
  edges.clear();
  for (int k = 57; k < 300; ++k) at({100, 0, z(k), 0});
  const auto expected = std::exchange(edges, {});
  EXPECT_GT(expected.size(), 5u);
  make(noisy);
  snapshot::read(state, *input);
  row.number = 57;
  for (int k = 57; k < 300; ++k) at({100, 0, z(k), 0});
  EXPECT_EQ(edges, expected);
}

// The whole drive: Z comes down on the sphere at 0.05 mm in a cycle.
struct Contact : ::testing::Test {
  DriveCore core{std::make_unique<SimulatedHardware>(std::map<std::string, truth::DriveTruth>{}, setup())};
  std::vector<DriveEvent> events;
  std::vector<idl::stream::SkipEdge> edges;
  idl::stream::Feedback feedback;
  double lowest = 0;

  void come_down(bool skip_move, bool on = true, double from = -80) {
    auto p = machine_xyzc();
    p.values[100012] = {100, ""}, p.values[102012] = {from, ""};
    core.configure(p, true);
    core.set_enables({1, 1, 1, 1}, false);
    core.set_probe(on);
    core.request({0, 1, StreamRequestKind::NEW_EPOCH, 1});
    // 0.05 mm a cycle after 100 cycles: Z-84.5 is reached within 140.
    const auto z = [from](std::uint64_t n) {
      return from - (n < 100 ? 0.00025 * static_cast<double>(n * n) : 0.05 * (static_cast<double>(n) - 50));
    };
    for (std::uint64_t first = 0; first < 400; first += 8) {
      idl::stream::AxisBatch f;
      f.epoch = 1, f.first = first, f.count = 8, f.starts = first == 0, f.revision = 1, f.axes = {2};
      f.ends = first == 392, f.skip_move = skip_move;
      for (std::uint64_t n = first; n < first + 8; ++n) f.setpoints.push_back(z(n));
      f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {}}};
      core.put(f);
    }
    for (int i = 0; i < 1000 && core.can_step(false); ++i) {
      core.step();
      core.fill(feedback);
      edges.insert(edges.end(), feedback.skips.begin(), feedback.skips.end());
      lowest = std::min(lowest, feedback.position[2]);
      for (auto& event : core.take_events()) events.push_back(std::move(event));
    }
  }
};

TEST_F(Contact, OutsideASkipMoveStopsTheAxesAndNamesThePlace) {
  come_down(false);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm->number, alarm::probe_contact.number);
  EXPECT_NE(events[0].text.find("outside a skip move at X 100.0000 mm, Y 0.0000 mm, Z -84.5"),
            std::string::npos)
      << events[0].text;
  EXPECT_EQ(core.mode(), Mode::HELD);
  // From 50 mm/s at 4 m/s2: 0.3 mm, and the period in which it was seen.
  EXPECT_GT(lowest, -84.5 - 0.3 - 0.1);
  EXPECT_EQ(feedback.skip_inputs, 1);
}

TEST_F(Contact, InASkipMoveIsItsEdge) {
  come_down(true);
  EXPECT_TRUE(events.empty());
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_NEAR(edges[0].position[2], -84.5, 1e-3) << "the load less what the encoder counts";
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_EQ(feedback.skip_inputs, 1);
}

TEST_F(Contact, ThatIsThereWhenTheProbeIsSwitchedOnIsNoAlarm) {
  come_down(false, true, -84.6);
  EXPECT_TRUE(events.empty());
  EXPECT_TRUE(edges.empty());
  EXPECT_EQ(feedback.skip_inputs, 1);
}

TEST_F(Contact, WithTheProbeSwitchedOffIsNotSeen) {
  come_down(false, false);
  EXPECT_TRUE(events.empty());
  EXPECT_TRUE(edges.empty());
  EXPECT_EQ(feedback.skip_inputs, 0);
}

}  // namespace
}  // namespace trunnion::drive
