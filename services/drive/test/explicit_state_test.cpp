// SPDX-License-Identifier: Apache-2.0
// A drive that continues from the explicit state of another does what that one does, bit for bit.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "bus/json.hpp"
#include "drive_core.hpp"
#include "simulated_hardware.hpp"
#include "two_axes.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::Feedback;
using idl::stream::StreamRequestKind;

idl::stream::AxisBatch batch(std::uint32_t epoch, std::uint64_t first, std::uint64_t start, bool ends) {
  idl::stream::AxisBatch f;
  f.epoch = epoch, f.first = first, f.count = 8, f.starts = first == start, f.ends = ends, f.revision = 1;
  f.axes = {0, 1};
  for (std::uint64_t n = first; n < first + 8; ++n) {
    const double x = 3 * std::sin(0.004 * static_cast<double>(n - start));
    f.setpoints.insert(f.setpoints.end(), {x, x / 3});
  }
  f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {0.1 * static_cast<double>(first)}}};
  f.snapshot.cycle = first + 7;
  return f;
}

// One drive, to which the same happens as to another by the same random numbers.
struct Machine {
  Machine() {
    core.configure(two_axes(), true);
    core.set_enables({1, 1}, false);
  }
  void act(unsigned choice) {
    switch (choice % 16) {
      case 0:
        core.stop();
        break;
      case 1:
        core.request({0, ++number, StreamRequestKind::RESUME, epoch});
        break;
      case 2:
        core.set_enables({1, 1}, true);
        break;
      case 3:
        core.set_enables({1, 1}, false);
        break;
      case 4:
        core.request({0, ++number, StreamRequestKind::NEW_EPOCH, ++epoch});
        written = start = core.next();
        break;
      case 5:
        core.set_spindle_speed({choice * 10.0});
        break;
      default:
        if (epoch == 0 || written > core.next() + 64) break;
        auto next = batch(epoch, written, start, choice % 64 == 63);
        written += 8;
        core.put(next);
    }
    for (unsigned i = 0; i < choice % 23 && core.can_step(choice % 5 == 0); ++i) core.step();
    core.fill(feedback);
    core.take_events();
  }
  void continue_as(const Machine& other) {
    core.continue_from(bus::Json::parse(bus::text_of(other.core.explicit_state())));
    epoch = other.epoch, number = other.number, written = other.written, start = other.start;
  }

  DriveCore core{std::make_unique<SimulatedHardware>()};
  Feedback feedback;
  std::uint32_t epoch = 0, number = 0;
  std::uint64_t written = 0, start = 0;
};

TEST(ExplicitState, ADriveContinuesWithTheSameBitsWhereverAnotherIs) {
  std::uint64_t cycles = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    Machine one, other;
    const auto before = random() % 400;
    for (unsigned i = 0; i < before; ++i) one.act(static_cast<unsigned>(random()));
    other.continue_as(one);
    EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(one.core.explicit_state()))
        << "seed " << seed;
    for (int i = 0; i < 300; ++i) {
      const auto choice = static_cast<unsigned>(random());
      one.act(choice);
      other.act(choice);
      ASSERT_EQ(other.feedback, one.feedback) << "seed " << seed << ", " << i << " behind the state";
      cycles += one.feedback.count;
    }
    EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(one.core.explicit_state()))
        << "seed " << seed;
  }
  EXPECT_GT(cycles, 10000u) << "there was motion to compare";
}

std::string names_of(const bus::Json& state) {
  std::string names;
  for (const auto& [name, value] : state.items()) names += name + " ";
  return names;
}

// A state is compared as text with that of another build.
TEST(ExplicitState, HasItsFieldsInTheOrderOfRecordings) {
  const std::string always =
      "channels row rows probe_contact probe_watched mode enabled control_lost next tick starved command "
      "target velocity rate rate_step phase dip_step dip_depth dip_periods off_path reserve settle homing "
      "homing_axis return_from return_to return_periods return_done spindles orientations reported ";
  auto p = two_axes();
  p.values[40002] = {-1, ""}, p.values[41002] = {1, ""};  // Y is the axis of a second channel
  p.values[100920] = {1, ""};                             // X has a home switch
  DriveCore core(std::make_unique<SimulatedHardware>());
  core.configure(p, true);
  EXPECT_EQ(names_of(core.explicit_state()), always + "hardware ");
  core.set_enables({1, 1}, false);
  core.request({1, 1, StreamRequestKind::HOME, 0, 0});
  ASSERT_EQ(core.mode(), Mode::HOMING);
  EXPECT_EQ(names_of(core.explicit_state()), always + "homing_members homing_channel hardware ");
}

TEST(ExplicitState, HardwareWithoutOneGivesNone) {
  struct Other : SimulatedHardware {
    bus::Json explicit_state() const override { return DriveHardware::explicit_state(); }
  };
  DriveCore core(std::make_unique<Other>());
  core.configure(two_axes(), true);
  EXPECT_TRUE(core.explicit_state().is_null());
}

}  // namespace
}  // namespace trunnion::drive
