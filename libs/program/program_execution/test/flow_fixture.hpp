// SPDX-License-Identifier: Apache-2.0
// A flow, its trajectory and its program, for the unit tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "motion/trajectory.hpp"
#include "program_execution/program_flow.hpp"

namespace trunnion::program_execution::flow_test {

inline std::uint32_t number(language::AlarmNumber alarm) { return static_cast<std::uint32_t>(alarm); }

/// A text whose bytes behind `arrived` are still on their way.
class SlowText final : public language::TextSource {
 public:
  explicit SlowText(std::string text) : text_(std::move(text)) {}
  language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    if (offset >= text_.size()) return {language::ReadStatus::end, 0};
    if (offset >= arrived) return {language::ReadStatus::pending, 0};
    const std::size_t size =
        std::min({capacity, arrived - static_cast<std::size_t>(offset), text_.size() - offset});
    std::memcpy(buffer, text_.data() + offset, size);
    return {language::ReadStatus::bytes, size};
  }
  std::size_t arrived = 0;

 private:
  std::string text_;
};

/// X Y Z of 400 mm to either side, a flow and its trajectory.
struct Flow : ::testing::Test {
  Flow() : machine(0) {
    machine.configure(axes());
    flow.on_move = [this](const language::Command& move) { moves.push_back(move); };
  }
  static machine::Parameters axes() {
    machine::Parameters parameters;
    for (std::uint32_t a = 0; a < 3; ++a) {
      parameters.values[40001 + a] = {static_cast<double>(a), ""};
      parameters.values[100000 + a * 1000] = {0, std::string(1, "XYZ"[a])};
      parameters.values[100006 + a * 1000] = {400, ""};
      parameters.values[100007 + a * 1000] = {-400, ""};
    }
    return parameters;
  }
  void start(const std::string& program, const Entry& entry = {}) {
    text = program;
    source = std::make_unique<language::StringSource>(text);
    start(*source, entry);
  }
  void start(language::TextSource& from, const Entry& entry = {}) {
    moves.clear();
    setpoints.clear();
    trajectory = std::make_unique<motion::Trajectory>(machine.limits(), &machine.chain(), 0.001);
    trajectory->start({}, language::Transformation::none, 0);
    flow.start(*trajectory, from, {}, {}, variables, entry);
  }
  /// Fills and steps until the motion has come to rest and the flow needs attention: the state it is in.
  FlowState run() {
    for (int cycle = 0; cycle < 200000; ++cycle) {
      const auto state = flow.fill(single_block);
      if (state == FlowState::waiting && !flow.text_missing()) continue;
      if (state == FlowState::waiting || state == FlowState::found) return state;
      if (trajectory->at_rest()) return state;
      setpoints.push_back(trajectory->step(1, 1, false));
    }
    ADD_FAILURE() << "the motion does not end";
    return FlowState::waiting;
  }
  double x() const { return trajectory->position()[language::X]; }

  channel_setup::ChannelSetup machine;
  language::VariableStore variables;
  ProgramFlow flow{machine};
  std::unique_ptr<motion::Trajectory> trajectory;
  std::string text;
  std::unique_ptr<language::StringSource> source;
  std::vector<language::Command> moves;
  std::vector<motion::Setpoint> setpoints;
  bool single_block = false;
};

/// With a spindle.
struct ThreadFlow : Flow {
  ThreadFlow() {
    auto parameters = axes();
    parameters.values[103000] = {0, "S"}, parameters.values[103001] = {10, ""};
    machine.configure(parameters);
  }
  /// Up to the first thread; what comes before is done.
  void reach_thread(const std::string& program) {
    start(program);
    for (int i = 0;
         i < 5 && run() == FlowState::command && flow.pending().kind != canonical::CommandKind::thread; ++i)
      flow.finish_pending();
    ASSERT_EQ(flow.pending().kind, canonical::CommandKind::thread);
  }
};

/// The same with the NUM dialect.
struct NumThreadFlow : ThreadFlow {
  NumThreadFlow() {
    auto parameters = axes();
    parameters.values[103000] = {0, "S"}, parameters.values[103001] = {10, ""};
    parameters.values[40959] = {1, ""};
    machine.configure(parameters);
    flow.set_coupled_threads(true);
  }
};

}  // namespace trunnion::program_execution::flow_test
