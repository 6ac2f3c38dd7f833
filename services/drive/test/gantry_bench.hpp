// SPDX-License-Identifier: Apache-2.0
// A gantry under the drive's executor without a cluster: X (0), Y1 (1) and its slave Y2 (2); 1 m/s, 10 m/s2.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drive_core.hpp"
#include "machine/parameter_constants.hpp"
#include "simulated_hardware.hpp"

namespace trunnion::drive {

// At the end of a motion friction holds the servo at 0.03 * 15000 mm/s2 / (Kp 600 1/s * Kv 60 1/s) = 12.5 um;
// the integral of 12 ms has left less than this of it after the 250 periods in which the drive settles.
inline constexpr double settled = 0.0015;  // mm

struct GantryMachine {
  machine::Parameters parameters;
  std::map<std::string, truth::DriveTruth> truth;
  std::optional<volumetric::BeamErrors> beam;
  std::unique_ptr<DriveCore> core;
  std::vector<DriveEvent> events;
  idl::stream::Feedback feedback;
  std::uint32_t epoch = 0, number = 0;
  double compensation = 0;     // mm, by which the batches of move() put the slave ahead of its master
  double largest = 0;          // of the synchronization error in executed cycles, mm, by the encoders
  double racked = 0;           // the same in every period, with the drives off as well
  double largest_current = 0;  // share of the rated torque: difference of both sides
  double fastest = 0;          // mm/s

  GantryMachine() {
    parameters.revision = 1;
    set(40001, 0), set(40002, 1), set(10050, 1), set(10051, 2), set(102100, 1), set(102101, 1);
    for (std::uint32_t a = 0; a < 3; ++a) {
      const char* const names[] = {"X", "Y1", "Y2"};
      parameters.values[100000 + a * 1000] = {0, names[a]};
      axis(a, 34, 60000), axis(a, 35, 60000), axis(a, 36, 10000);
      axis(a, 6, 3000), axis(a, 7, -3000);
    }
  }
  void set(std::uint32_t number_, double value) { parameters.values[number_] = {value, ""}; }
  void axis(std::uint32_t a, std::uint32_t offset, double value) { set(100000 + a * 1000 + offset, value); }
  void both(std::uint32_t offset, double value) { axis(1, offset, value), axis(2, offset, value); }

  /// Both sides at rest there, the drives off.
  void build(double master = 0, double slave = 0) {
    core = std::make_unique<DriveCore>(std::make_unique<SimulatedHardware>(truth, std::nullopt, beam));
    core->configure(parameters, true);
    auto memory = core->memory();
    memory.position[1] = master, memory.position[2] = slave;
    for (auto& homed : memory.homed) homed = 1;
    core->restore(memory);
  }
  void configure() {
    ++parameters.revision;
    core->configure(parameters, true);
  }
  void release(bool slave_off = false) {
    core->set_enables({1, 1, static_cast<std::uint8_t>(slave_off ? 3 : 1)}, false);
    run();
  }
  void emergency_stop() {
    core->set_enables({1, 1, 1}, true);
    run();
  }
  void request(idl::stream::StreamRequestKind kind, std::uint16_t axis_number = 0) {
    if (kind == idl::stream::StreamRequestKind::NEW_EPOCH) ++epoch;
    core->request({0, ++number, kind, epoch, axis_number});
  }
  void take() {
    for (auto& event : core->take_events()) events.push_back(std::move(event));
    core->fill(feedback);
    for (std::uint32_t i = 0; i < feedback.count; ++i)
      largest = std::max(largest, std::abs(feedback.actual[3 * i + 2] - feedback.actual[3 * i + 1]));
    if (feedback.position.size() == 3) racked = std::max(racked, std::abs(error()));
    largest_current = std::max(largest_current, std::abs(feedback.torque[2] - feedback.torque[1]));
    fastest = std::max(fastest, std::abs(feedback.velocity[2]));
  }
  void run(int most = 1000000) {
    while (core->can_step(false) && most-- > 0) {
      core->step();
      take();
    }
    take();
  }
  bool started() {
    request(idl::stream::StreamRequestKind::NEW_EPOCH);
    take();
    return core->any_active();
  }
  /// The channel moves Y from `from` by `way` at `speed` mm/s, with a raised cosine as the acceleration. The
  /// batches have the slave where its master is: the gantry stage. False when the drive does not start.
  /// `most`: stops giving setpoints after so many cycles.
  bool move(double from, double way, double speed = 1000, std::uint64_t most = 1000000) {
    if (!started()) return false;
    const double peak = parameters.get(parameter::maximum_acceleration, 1),
                 top = std::min(speed, std::abs(way) / 0.1);
    const double rise = 2 * top / peak, total = std::abs(way) / top + rise;
    const auto risen = [&](double t) {
      if (t >= rise) return top * (t - rise / 2);
      const double w = 2 * std::numbers::pi / rise;
      return top / rise * (t * t / 2 + (std::cos(w * t) - 1) / (w * w));
    };
    const auto cycles = static_cast<std::uint64_t>(std::ceil(total * 1000 / 8)) * 8 + 8;
    const std::uint64_t start = core->next();
    for (std::uint64_t n = 0; n < std::min(cycles, most); n += 8) {
      idl::stream::AxisBatch f;
      f.epoch = epoch, f.first = start + n, f.count = 8, f.revision = parameters.revision, f.axes = {0, 1, 2};
      f.starts = n == 0, f.ends = n + 8 >= cycles;
      for (std::uint64_t k = n; k < n + 8; ++k) {
        const double t = std::min(static_cast<double>(k) * 0.001, total);
        const double done = t < total - rise ? risen(t) : std::abs(way) - risen(total - t);
        const double y = from + std::copysign(done, way);
        f.setpoints.insert(f.setpoints.end(), {0, y, y + compensation});
      }
      if (compensation != 0) f.states = {{idl::stream::Stage::GANTRY, start + n + 7, {compensation}}};
      if (!core->put(f)) return false;
      run();
    }
    return true;
  }
  double error() const { return feedback.position[2] - feedback.position[1]; }
  std::vector<std::uint32_t> alarms() {
    std::vector<std::uint32_t> numbers;
    for (const auto& event : events) numbers.push_back(event.alarm->number);
    events.clear();
    return numbers;
  }
};

inline volumetric::BeamErrors beam_of(double frequency, double misalignment = 0) {
  volumetric::BeamErrors beam;
  beam.racking_frequency = frequency, beam.misalignment = misalignment;
  return beam;
}

}  // namespace trunnion::drive
