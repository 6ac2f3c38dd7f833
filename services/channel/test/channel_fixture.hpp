// SPDX-License-Identifier: Apache-2.0
// One channel core, its program, a drive and a PLC, for its unit tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "canonical/macro_signal.hpp"
#include "fake_drive.hpp"

namespace trunnion::channel::testing {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

/// M, S and T as the PLC is asked for them.
using Codes = std::vector<std::pair<idl::channel::AuxiliaryKind, std::uint32_t>>;

/// X Y Z of 400 mm to either side.
inline std::shared_ptr<machine::Parameters> three_axes(std::uint64_t revision = 1) {
  auto p = std::make_shared<machine::Parameters>();
  p->revision = revision;
  p->values[902] = {16, ""}, p->values[903] = {32, ""};  // as in real time, nothing beyond the lead
  for (std::uint32_t a = 0; a < 3; ++a) {
    p->values[40001 + a] = {static_cast<double>(a), ""};
    p->values[100000 + a * 1000] = {0, std::string(1, "XYZ"[a])};
    p->values[100006 + a * 1000] = {400, ""};
    p->values[100007 + a * 1000] = {-400, ""};
  }
  return p;
}

/// A channel with the fake drive and a PLC that answers at once.
struct Channel : ::testing::Test {
  FakeDrive drive{3};
  std::unique_ptr<ChannelCore> core;
  std::string text;
  struct Subprogram {
    std::string text;
    std::uint64_t revision = 0;
    std::uint8_t role = 1;  ///< of who stored it
  };
  std::map<std::string, Subprogram> subprograms;  ///< stored beside it
  std::vector<ChannelEvent> events;
  std::vector<idl::channel::AuxiliaryRequest> auxiliaries;
  bool answer_plc = true;
  std::uint16_t signals_in = 0, signals_out = 0;  ///< of the PLC: #1032 and #1132
  std::uint64_t cycles_per_round = ~0ull;
  std::shared_ptr<machine::Parameters> parameters = three_axes();

  void SetUp() override { begin(); }
  /// A new process, which has received parameters, tool 1 of 50 mm and no offsets.
  void start_process() {
    core = std::make_unique<ChannelCore>(0, true);
    core->set_parameters(parameters);
    idl::parameters::ToolTable tools;
    tools.tools.resize(1);
    tools.tools[0].number = 1, tools.tools[0].length = 50;
    core->set_tools(tools);
    core->set_offsets({});
  }
  /// A new process, which finds the record that the one before kept.
  void begin(const RunningProgram& kept = {}) {
    start_process();
    core->set_interrupted(kept);
    core->set_ready(true);
    store();
    core->on_feedback(drive.run(0));
    core->recover();
  }
  void store() {
    idl::program::ProgramList list;
    list.programs.push_back({"part.nc", 3, text.size(), 77,
                             static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n')), 1});
    for (const auto& [name, one] : subprograms)
      list.programs.push_back({name, one.revision, one.text.size(), 78, 1, one.role});
    core->set_programs(list);
  }
  Answer ask(const ChannelRequest& request) { return core->handle(request); }
  /// `argument` and `value` are what the command's own field of the request holds.
  Answer ask(CommandKind command, const std::string& argument = "", double value = 0, double increment = 0,
             Mode mode = Mode::AUTO, std::uint8_t axis = 0) {
    ChannelRequest request;
    request.command = command, request.mode = mode, request.axis = axis, request.increment = increment;
    request.program = command == CommandKind::SELECT_PROGRAM ? argument : "";
    request.block = command == CommandKind::MDI_LINE ? argument : "";
    switch (command) {
      case CommandKind::FEED_OVERRIDE:
      case CommandKind::RAPID_OVERRIDE:
      case CommandKind::SPINDLE_OVERRIDE:
      case CommandKind::FEED_OVERRIDE_STEP:
      case CommandKind::RAPID_OVERRIDE_STEP:
      case CommandKind::SPINDLE_OVERRIDE_STEP:
        request.fraction = value;
        break;
      case CommandKind::JOG_AXIS:
        request.speed = value;
        break;
      case CommandKind::START_FROM_LINE:
        request.line = static_cast<std::uint32_t>(value);
        break;
      case CommandKind::AXIS_LOCK:
        request.axes = static_cast<std::uint16_t>(value);
        break;
      case CommandKind::BLOCK_SKIP:
        request.levels = static_cast<std::uint16_t>(value);
        break;
      case CommandKind::HANDWHEEL:
        request.counts = static_cast<std::int32_t>(value);
        break;
      default:
        request.on = value != 0;
        break;
    }
    return core->handle(request);
  }
  void load(const std::string& program) {
    text = program;
    store();
    ASSERT_TRUE(ask(CommandKind::SET_MODE).accepted);
    ASSERT_TRUE(ask(CommandKind::SELECT_PROGRAM, "part.nc").accepted);
  }
  /// A round up to the first batch.
  void begin_round() {
    core->advance();
    if (const auto chunk = core->wanted()) {
      const auto other = subprograms.find(chunk->name);
      const auto& from = other == subprograms.end() ? text : other->second.text;
      core->deliver(
          chunk->name, chunk->offset,
          {from.begin() + static_cast<long>(chunk->offset),
           from.begin() + static_cast<long>(std::min(from.size(), chunk->offset + ProgramText::chunk_size))});
    }
    core->advance();
    if (const auto request = core->take_stream_request()) drive.request(*request);
  }
  /// As the PLC: what it is asked is done, and a signal is read.
  void answer(const idl::channel::AuxiliaryRequest& asked) {
    const bool signal =
        asked.kind == idl::channel::AuxiliaryKind::E && canonical::is_macro_signal(asked.code);
    if (signal && !asked.has_value) {
      const auto word = canonical::is_macro_input(asked.code) ? signals_in : signals_out;
      core->on_macro_signal({0, asked.number, canonical::macro_value(asked.code, word)});
      return;
    }
    if (signal)
      signals_out =
          canonical::with_macro_output(signals_out, asked.code, static_cast<std::int32_t>(asked.value));
    core->on_auxiliary_done({0, asked.number, false});
  }
  /// A round from behind the last batch on.
  void end_round() {
    if (const auto auxiliary = core->take_auxiliary();
        auxiliary && auxiliary->kind != idl::channel::AuxiliaryKind::NO_AUXILIARY) {
      auxiliaries.push_back(*auxiliary);
      if (answer_plc) answer(*auxiliary);
    }
    for (auto& event : core->take_events()) events.push_back(event);
    core->on_feedback(drive.run(cycles_per_round));
  }
  void round() {
    begin_round();
    idl::stream::PathBatch batch;
    while (core->produce(batch)) drive.put(batch);
    end_round();
  }
  void run(int rounds = 100000) {
    for (int i = 0; i < rounds; ++i) {
      round();
      if (core->run_state() == RunState::IDLE || core->run_state() == RunState::HELD ||
          core->run_state() == RunState::INTERRUPTED)
        break;
    }
  }
  void start_and_go_on_after_a_restart_of_the_drive() {
    cycles_per_round = 8;
    ask(CommandKind::CYCLE_START);
    for (int i = 0; i < 20; ++i) round();
    drive.forget();
    round();
    EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
  }
};

}  // namespace trunnion::channel::testing
