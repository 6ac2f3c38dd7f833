// SPDX-License-Identifier: Apache-2.0
#include "verification/alignment.hpp"

#include <gtest/gtest.h>

#include "sample_recording.hpp"
#include "verification/difference.hpp"

namespace trunnion::verification {
namespace {

using idl::channel::CommandKind;
using idl::channel::RunState;

// A life with runs of a program: each has 4 batches of 8 cycles and two functions.
class Alignment : public testing::Test {
 protected:
  template <class T>
  void write(const bus::Topic<T>& topic, const T& value) {
    recording_.messages.push_back(stored(topic, value, ++time_));
  }
  void state(RunState run, std::uint64_t cycle) {
    idl::channel::ChannelState state;
    state.state = run;
    state.cycle = cycle;
    write(topics::channel_state, state);
  }
  void ask(CommandKind command) {
    idl::channel::ChannelRequest request;
    request.client = 1, request.number = ++number_, request.command = command;
    write(topics::channel_request, request);
    idl::channel::ChannelReply reply;
    reply.client = 1, reply.number = number_, reply.accepted = true;
    write(topics::channel_reply, reply);
  }
  void function(std::uint64_t cycle) {
    ++function_;
    write(topics::auxiliary_request, {0, function_, idl::channel::AuxiliaryKind::M, 3, 0, false, cycle});
    write(topics::auxiliary_done, {0, function_, false});
  }
  // Moves from `cycle` on; the setpoints are those of the run's own cycles, plus `off` in the last.
  std::uint64_t motion(std::uint64_t cycle, int batches, double off = 0) {
    for (int i = 0; i < batches; ++i) {
      auto batch = path_batch(static_cast<std::uint64_t>(i) * batch_cycles, i == 0, i + 1 == batches);
      batch.first = cycle + static_cast<std::uint64_t>(i) * batch_cycles;
      batch.snapshot.valid = true;
      batch.snapshot.cycle = batch.first + batch_cycles - 1;
      batch.revision = cycle;
      if (i + 1 == batches) batch.setpoints.back() += off;
      write(topics::path_batch, batch);
    }
    return cycle + static_cast<std::uint64_t>(batches) * batch_cycles;
  }
  std::uint64_t run(std::uint64_t cycle, double off = 0) {
    state(RunState::IDLE, cycle);
    ask(CommandKind::CYCLE_START);
    state(RunState::RUNNING, cycle);
    function(cycle);
    cycle = motion(cycle, 2);
    function(cycle);
    cycle = motion(cycle, 2, off);
    state(RunState::IDLE, cycle);
    return cycle;
  }
  Difference between(unsigned a, unsigned b) {
    DiffOptions options;
    options.topics = aligned_topics();
    return difference(aligned(recording_, 0, a), aligned(recording_, 0, b), options);
  }
  StoredRecording recording_;
  std::uint64_t time_ = 1000, number_ = 0;
  std::uint32_t function_ = 0;
};

TEST_F(Alignment, TwoRunsInOneLifeCompareFromTheirStarts) {
  auto cycle = run(0);
  cycle = motion(cycle, 3);  // a jog, which belongs to neither
  run(cycle);
  const auto d = between(1, 2);
  EXPECT_TRUE(d.equal()) << text_of(d, "first", "second");
  EXPECT_EQ(d.cycles, 32u) << "4 batches of 8 cycles";
  ASSERT_EQ(d.topics.size(), 3u);
  EXPECT_EQ(d.topics[1].compared, 2u) << "functions";
}

TEST_F(Alignment, ADifferenceIsNamedByTheCycleOfTheRun) {
  run(run(0), 1e-9);
  const auto d = between(1, 2);
  ASSERT_TRUE(d.first);
  EXPECT_EQ(d.first->index, 31u) << "the last of 32";
  EXPECT_EQ(d.first->field, "setpoint.W");
}

TEST_F(Alignment, AContinuedProgramIsNoStart) {
  state(RunState::IDLE, 0);
  ask(CommandKind::CYCLE_START);
  state(RunState::RUNNING, 0);
  const auto half = motion(0, 2);
  state(RunState::HELD, half);
  ask(CommandKind::CYCLE_START);
  const auto cycle = motion(half, 2);
  state(RunState::IDLE, cycle);
  EXPECT_EQ(aligned(recording_, 0, 1).size(), 4u);
  EXPECT_THROW(aligned(recording_, 0, 2), std::runtime_error);
}

TEST_F(Alignment, ARunThatIsNotThereIsOneLine) {
  run(0);
  try {
    aligned(recording_, 0, 3);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the recording has no start 3 of a program in channel 0, it has 1");
  }
}

}  // namespace
}  // namespace trunnion::verification
