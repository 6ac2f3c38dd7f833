// SPDX-License-Identifier: Apache-2.0
#include "report/stream_timing.hpp"

#include <gtest/gtest.h>

#include "bus/json.hpp"

namespace trunnion::report {
namespace {

constexpr std::uint64_t lead = 32, batch = 4, batches = 1000;
constexpr double period = 0.001;
constexpr std::int64_t us = 1000;  // ns

/// A motion of 4000 cycles from cycle 100 on. The drive reports every batch at the end of its last period;
/// the channel needs 100 us for the batch that this allows, each stage 50 us.
struct Motion {
  static std::int64_t end_of(std::uint64_t cycle) {  // its period, ns
    return static_cast<std::int64_t>(cycle + 1) * 1000 * us;
  }
  Capture capture;

  Motion() {
    std::uint64_t first = 100;
    for (std::uint64_t i = 0; i < batches; ++i, first += batch) {
      capture.feedback.push_back({first, batch, first + batch, end_of(first + batch - 1)});
      BatchTimes times;
      times.last_cycle = first + batch - 1;
      times.starts = i == 0;
      // The feedback that allows this batch: executed up to last + 1 - lead.
      const auto allowed = end_of(times.last_cycle - lead);
      for (std::size_t stage = 0; stage < times.written.size(); ++stage)
        times.written[stage] = allowed + 100 * us + static_cast<std::int64_t>(stage) * 50 * us;
      capture.batches[{1, first}] = times;
    }
  }
  BatchTimes& times_of(std::uint64_t number) { return capture.batches.at({1, 100 + number * batch}); }
};

const Delays& process(const StreamTiming& timing, const std::string& name) {
  for (const auto& delays : timing.processes())
    if (delays.name() == name) return delays;
  throw std::out_of_range(name);
}

TEST(StreamTiming, GivesTheDelayOfEveryProcessAndOfTheWholeStream) {
  StreamTiming timing(lead, period);
  timing.add(Motion().capture);
  EXPECT_NEAR(process(timing, "channel").quantile(0.5), 100e-6, 1e-9);
  EXPECT_NEAR(process(timing, "kinematics").quantile(0.5), 50e-6, 1e-9);
  EXPECT_NEAR(process(timing, "gantry").largest(), 50e-6, 1e-9);
  EXPECT_NEAR(timing.whole().largest(), 100e-6 + 3 * 50e-6, 1e-9);
  EXPECT_EQ(process(timing, "drive").largest(), 0);
  EXPECT_EQ(timing.cycles(), batches * batch);
  // The first two leads are filled without waiting for the drive: 16 batches of 4 less the one that ends
  // there.
  EXPECT_EQ(process(timing, "channel").count(), batches - 15);
  EXPECT_EQ(process(timing, "kinematics").count(), batches);
}

TEST(StreamTiming, OneLateStageDeterminesTheLead) {
  Motion motion;
  auto& late = motion.times_of(500);
  for (std::size_t stage = 1; stage < late.written.size(); ++stage) late.written[stage] += 8000 * us;
  StreamTiming timing(lead, period);
  timing.add(motion.capture);
  EXPECT_NEAR(process(timing, "kinematics").largest(), 8050e-6, 1e-9);
  EXPECT_NEAR(process(timing, "kinematics").quantile(0.99), 50e-6, 1e-9);
  EXPECT_NEAR(process(timing, "compensation").largest(), 50e-6, 1e-9) << "it was not the late one";
  EXPECT_EQ(timing.usable_lead(), 18u) << "8.25 ms are 9 cycles; twice that";
  const auto histogram = process(timing, "kinematics").histogram({100e-6, 5e-3, 10e-3});
  EXPECT_EQ(histogram, (std::vector<std::uint64_t>{batches - 1, 0, 1, 0}));
}

TEST(StreamTiming, ALongPeriodOfTheDriveIsItsDelayAndARestIsNot) {
  Motion motion;
  auto& feedback = motion.capture.feedback;
  for (std::size_t i = 300; i < feedback.size(); ++i) feedback[i].written += 2000 * us;  // one period of 3 ms
  for (std::size_t i = 600; i < feedback.size(); ++i)  // at rest for 5 s: ticks pass and cycles do not
    feedback[i].written += 5'000'000 * us, feedback[i].tick += 5000;
  StreamTiming timing(lead, period);
  timing.add(motion.capture);
  EXPECT_NEAR(process(timing, "drive").largest(), 2e-3, 1e-9);
  EXPECT_EQ(process(timing, "drive").histogram({1e-3}), (std::vector<std::uint64_t>{batches - 2, 1}));
}

TEST(StreamTiming, RecordingsAddUpAndTheTextNamesUnitsAndTheLead) {
  StreamTiming timing(lead, period);
  EXPECT_EQ(timing.usable_lead(), 0u) << "nothing was measured";
  Motion motion;
  motion.capture.starved = 3;
  motion.capture.lost["gantry_batch"] = 4;
  timing.add(motion.capture);
  timing.add(motion.capture);
  EXPECT_EQ(timing.starved(), 6u);
  EXPECT_EQ(timing.lost(), 8u);
  EXPECT_EQ(timing.usable_lead(), 8u) << "the smallest of parameter 000900";
  const auto text = terminal_text(timing);
  EXPECT_NE(text.find("delay in us"), std::string::npos);
  EXPECT_NE(text.find("6 starved periods"), std::string::npos);
  EXPECT_NE(text.find("lead (000900) of 8 cycles"), std::string::npos);
  const auto json = bus::Json::parse(json_text(timing));
  EXPECT_EQ(json.at("usable_lead_cycles"), 8);
  EXPECT_EQ(json.at("processes").size(), batch_stages.size() + 2);
}

}  // namespace
}  // namespace trunnion::report
