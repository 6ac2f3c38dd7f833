// What an operator may ask of a channel, and when.
#include <algorithm>
#include <cmath>

#include "channel_core.hpp"
#include "machine/alarms.hpp"
#include "modal_codes.hpp"

namespace trunnion::channel {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

Answer ChannelCore::refuse(const char* alarm, std::string reason) const {
  return {false, machine::alarm_definition(alarm).number, std::move(reason)};
}

Answer ChannelCore::startable() const {
  if (!configured()) return refuse("not_ready", "The channel has no parameters yet");
  if (!ready_) return refuse("not_ready", "The cluster is not ready: see the services");
  if (!external_hold_.empty()) return refuse("not_ready", external_hold_);
  if (!link_.has_feedback()) return refuse("not_ready", "The drive has not answered yet");
  if (link_.drive_mode() == DriveMode::off) return refuse("not_ready", "The drives are off");
  return {};
}

Answer ChannelCore::handle(const ChannelRequest& request) {
  const bool idle = activity_ == Activity::none;
  const auto finite = std::isfinite(request.value) && std::isfinite(request.increment);
  if (!finite) return refuse("request_invalid", "A value is not a finite number");
  const auto limited = [&](double& out, double low, double high) -> Answer {
    if (request.value < low || request.value > high)
      return refuse("request_invalid", "override " + std::to_string(request.value * 100) + " % is outside " +
                                           std::to_string(low * 100) + " .. " + std::to_string(high * 100) +
                                           " %");
    out = request.value;
    return {};
  };
  switch (request.command) {
    case CommandKind::SET_MODE:
      if (!idle)
        return refuse("request_invalid",
                      "The mode cannot change while the channel is busy: stop or reset it first");
      mode_ = request.mode;
      return {};
    case CommandKind::SELECT_PROGRAM:
      return select(request.text);
    case CommandKind::CYCLE_START:
      return cycle_start();
    case CommandKind::FEED_HOLD:
      if (run_ == RunState::RUNNING) hold();
      return {};
    case CommandKind::RESET:
      reset();
      return {};
    case CommandKind::MDI_LINE:
      return start_mdi(request.text);
    case CommandKind::JOG_AXIS:
      return jog(request);
    case CommandKind::JOG_STOP:
      if (activity_ == Activity::jog && !aborting_) {
        aborting_ = true;
        trajectory_->abort();
      }
      return {};
    case CommandKind::REFERENCE_AXIS: {
      if (mode_ != Mode::REF) return refuse("request_invalid", "Reference return needs mode REF");
      const auto& axes = machine_.channel_axes().index;
      if (request.axis >= axes.size())
        return refuse("request_invalid", "The channel has no axis number " + std::to_string(request.axis));
      const auto axis = axes[request.axis];
      return start_move(axis, machine_.reference_position()[axis], machine_.reference_feed(axis));
    }
    case CommandKind::FEED_OVERRIDE:
      return limited(feed_override_, 0, 1.5);
    case CommandKind::RAPID_OVERRIDE:
      return limited(rapid_override_, 0, 1);
    case CommandKind::SPINDLE_OVERRIDE:
      return limited(spindle_override_, 0.5, 1.5);
    case CommandKind::SINGLE_BLOCK:
      single_block_ = request.value != 0;
      return {};
    case CommandKind::OPTIONAL_STOP:
      optional_stop_ = request.value != 0;
      return {};
  }
  return refuse("request_invalid", "Unknown command");
}

Answer ChannelCore::select(const std::string& name) {
  if (activity_ != Activity::none)
    return refuse("request_invalid", "A program cannot be selected while the channel is busy");
  for (const auto& entry : programs_.programs)
    if (entry.name == name) {
      selected_ = entry;
      shown_ = {};
      return {};
    }
  return refuse("program_missing", "Program '" + name + "' is not in the store");
}

Answer ChannelCore::cycle_start() {
  if (auto answer = startable(); !answer.accepted) return answer;
  switch (run_) {
    case RunState::IDLE:
      if (mode_ != Mode::AUTO)
        return refuse("request_invalid", "Cycle start needs mode AUTO (or an MDI line)");
      if (selected_.name.empty()) return refuse("program_missing", "No program is selected");
      return start_program({});
    case RunState::HELD:
      hold_ = false;
      run_ = RunState::RUNNING;
      return {};
    case RunState::INTERRUPTED:
      if (must_reset_)
        return refuse("not_ready", "The drives were switched off in the program: reset the channel");
      if (restart_) {  // the stream was lost: begin anew at the newest point that was executed
        const auto point = *restart_;
        return start_program(point);
      }
      link_.request_resume();
      hold_ = false;
      run_ = aborting_ ? RunState::HOLDING : RunState::RUNNING;
      return {};
    default:
      return refuse("request_invalid", "The channel is busy");
  }
}

Answer ChannelCore::start_program(const RestartPoint& restart) {
  for (const auto& entry : programs_.programs)
    if (entry.name == selected_.name) {
      if (restart.sequence != 0 && entry.revision != selected_.revision)
        return refuse("program_missing",
                      "Program '" + selected_.name + "' has changed since it was interrupted: reset first");
      selected_ = entry;
    }
  apply_parameters();
  adopt_position();
  skip_.end();
  finish_tapping();
  subprograms_.clear();
  text_ = std::make_unique<ProgramText>(selected_.name, selected_.revision, selected_.size);
  const auto modal = power_on_modal();
  if (restart.sequence == 0) program_start_ = machine_start_;
  frame_ = modal.transformation;
  frame_tool_length_ = 0;
  trajectory_->start(machine_start_, frame_, 0);
  flow_.start(*text_, program_start_, modal, *variables_, restart);
  restart_ = restart.sequence != 0 ? std::optional(restart) : std::nullopt;
  activity_ = Activity::program;
  run_ = RunState::RUNNING;
  hold_ = aborting_ = false;
  return {};
}

Answer ChannelCore::start_mdi(const std::string& line) {
  if (mode_ != Mode::MDI) return refuse("request_invalid", "An MDI line needs mode MDI");
  if (activity_ != Activity::none) return refuse("request_invalid", "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  apply_parameters();
  adopt_position();
  mdi_line_ = line;
  mdi_source_.emplace(mdi_line_);
  subprograms_.clear();
  text_.reset();
  frame_ = modal_.transformation;
  frame_tool_length_ = modal_.tool_length;
  modal_.tool = static_cast<std::uint16_t>(tool_);
  const auto position = frame_position(modal_);
  trajectory_->start(position, frame_, frame_tool_length_);
  flow_.start(*mdi_source_, position, modal_, *variables_);
  activity_ = Activity::mdi;
  run_ = RunState::RUNNING;
  hold_ = aborting_ = false;
  // What is wrong with the line is the answer to whoever typed it.
  const auto flow = flow_.fill(false);
  if (flow == FlowState::alarm && trajectory_->at_rest()) {
    activity_ = Activity::none;
    run_ = RunState::IDLE;
    return {false, flow_.alarm_number(), "MDI:" + flow_.alarm_text()};
  }
  return {};
}

Answer ChannelCore::start_move(std::uint8_t axis, double target, double feed) {
  if (activity_ != Activity::none) return refuse("request_invalid", "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  apply_parameters();
  adopt_position();
  frame_ = language::Transformation::none;
  frame_tool_length_ = 0;
  trajectory_->start(machine_start_, frame_, 0);
  language::Command move;
  move.kind = language::CommandKind::line;
  move.target = machine_start_;
  move.target[axis] = std::clamp(target, machine_.travel(axis).negative, machine_.travel(axis).positive);
  move.modal.feed = feed;
  if (move.target[axis] == machine_start_[axis]) return {};
  trajectory_->push(move);
  trajectory_->finish();
  activity_ = Activity::jog;
  run_ = RunState::RUNNING;
  hold_ = aborting_ = false;
  return {};
}

Answer ChannelCore::jog(const ChannelRequest& request) {
  if (mode_ != Mode::JOG) return refuse("request_invalid", "Jog needs mode JOG");
  const auto& axes = machine_.channel_axes().index;
  if (request.axis >= axes.size())
    return refuse("request_invalid", "The channel has no axis number " + std::to_string(request.axis));
  if (request.value == 0) return refuse("request_invalid", "Jog needs a speed other than 0");
  const auto axis = axes[request.axis];
  const double fastest = machine_.jog_feed(axis);
  if (std::abs(request.value) > fastest * 1.0001)
    return refuse("request_invalid", "Jog speed " + std::to_string(std::abs(request.value)) +
                                         " is above the axis' " + std::to_string(fastest));
  adopt_position();
  const auto& travel = machine_.travel(axis);
  const double direction = request.value > 0 ? 1 : -1;
  const double from = machine_start_[axis];
  const double end = direction > 0 ? travel.positive : travel.negative;
  if ((end - from) * direction <= 0)
    return refuse("travel_limit",
                  std::string("Axis ") + language::axis_letters[axis] + " is at its travel limit");
  const double target = request.increment > 0 ? from + direction * request.increment : end;
  return start_move(axis, target, std::abs(request.value));
}

void ChannelCore::reset() {
  ++reset_count_;
  must_reset_ = false;
  modal_ = power_on_modal();
  if (activity_ == Activity::none) {
    apply_parameters();
    return;
  }
  const bool moving =
      link_.state() == LinkState::active && run_ != RunState::INTERRUPTED && run_ != RunState::HELD;
  if (!moving) {
    stop_activity();
    return;
  }
  aborting_ = true;
  run_ = RunState::HOLDING;
  trajectory_->abort();
}

const idl::channel::ChannelState& ChannelCore::state() {
  auto& s = state_;
  s.channel = number_;
  s.name = parameters_ ? parameters_->text("channel_name", number_) : "";
  if (s.name.empty()) s.name = "CH" + std::to_string(number_);
  s.cycle = link_.executed();
  s.mode = mode_;
  s.state = run_;
  s.program = selected_.name;
  s.program_revision = selected_.revision;
  s.line = shown_.line;
  s.lines_total = selected_.lines;
  s.progress = selected_.lines > 0 ? std::min(1.0, static_cast<double>(shown_.line) / selected_.lines) : 0;
  const auto& modal =
      activity_ == Activity::program || activity_ == Activity::mdi ? flow_.executing() : modal_;
  s.modal = modal_codes(modal);
  const bool moving = link_.state() == LinkState::active || link_.state() == LinkState::ending;
  s.feed = moving ? shown_.feed * 60 : 0;
  s.programmed_feed = modal.feed;
  s.spindle_programmed = spindle_programmed_;
  s.feed_override = feed_override_, s.rapid_override = rapid_override_,
  s.spindle_override = spindle_override_;
  s.tool = tool_;
  s.length_offset = modal.length_offset;
  s.tool_length = modal.tool_length;
  s.work_offset = modal.work_offset;
  s.rtcp = modal.transformation == language::Transformation::rtcp;
  s.single_block = single_block_, s.optional_stop = optional_stop_;
  s.axes = machine_.channel_axes().number;
  s.letters = machine_.channel_axes().letters;
  const auto& index = machine_.channel_axes().index;
  s.machine.resize(index.size());
  s.workpiece.resize(index.size());
  s.distance_to_go.resize(index.size());
  if (machine_.configured()) {
    AxisValues position{};
    for (std::size_t i = 0; i < index.size(); ++i) {
      const int column = machine_.columns()[i];
      if (column >= 0 && static_cast<std::size_t>(column) < link_.positions().size())
        position[index[i]] = link_.positions()[static_cast<std::size_t>(column)];
    }
    AxisValues tip = position;
    if (s.rtcp)
      tip = machine_.tip_from_machine(position, modal.tool_length);
    else
      tip[language::Z] -= modal.tool_length;
    const auto offset = machine_.work_offset(modal.work_offset);
    for (std::size_t i = 0; i < index.size(); ++i) {
      s.machine[i] = position[index[i]];
      s.workpiece[i] = tip[index[i]] - offset[index[i]];
      s.distance_to_go[i] = moving ? shown_.distance_to_go[index[i]] : 0;
    }
  }
  s.reset_count = reset_count_;
  s.revision = machine_.revision();
  s.frames_ahead =
      static_cast<std::uint32_t>(link_.next() > link_.executed() ? link_.next() - link_.executed() : 0);
  s.homed = true;  // absolute encoders
  return s;
}

}  // namespace trunnion::channel
