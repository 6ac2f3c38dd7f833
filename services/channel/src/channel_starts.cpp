// How programs, lines and moves begin, stop for a while and go on.
#include <algorithm>
#include <cmath>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {
// An axis this near to where it should be, mm or degrees, is brought there in a straight line: it was stopped
// on its path.
constexpr double near_by = 2;

bool is_near(const AxisValues& a, const AxisValues& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > near_by) return false;
  return true;
}
}  // namespace

Answer ChannelCore::start_program(const Entry& entry) {
  const auto& restart = entry.restart;
  for (const auto& stored : programs_.programs)
    if (stored.name == selected_.name) {
      if (restart.sequence != 0 && stored.revision != selected_.revision)
        return refuse(alarm::program_missing,
                      "Program '" + selected_.name + "' has changed since it was interrupted: reset first");
      selected_ = stored;
    }
  apply_parameters();
  adopt_position();
  skip_.end();
  finish_tapping();
  auto& text = program_shelf_.open(selected_);
  const auto modal = power_on_modal();
  if (restart.sequence == 0) program_start_ = machine_start_;
  trajectory_ = program_trajectory_;
  frame_ = modal.transformation;
  frame_tool_length_ = 0;
  trajectory_->start(machine_start_, frame_, 0);
  program_flow_.set_block_skip(block_skip_);
  program_flow_.set_dry_run_feed(dry_run_ ? machine_.dry_run_feed() : 0);
  program_flow_.set_offset(offset_on_ ? std::optional(offset_.target()) : std::nullopt);
  frames_kept_ = false;
  forget_sequences();
  program_flow_.start(*trajectory_, text, program_start_, modal, *variables_, entry);
  restart_ = restart.sequence != 0 ? std::optional(restart) : std::nullopt;
  preparation_.reset();
  preparing_motion_ = retracing_ = false;
  interrupted_ = {};
  activity_ = Activity::program;
  run_ = RunState::RUNNING;
  hold_ = aborting_ = false;
  return {};
}

Answer ChannelCore::start_from_line(double line) {
  if (mode_ != Mode::AUTO) return refuse(alarm::request_invalid, "A start from a line needs mode AUTO");
  if (activity_ != Activity::none || suspended_) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  if (selected_.name.empty()) return refuse(alarm::program_missing, "No program is selected");
  // The last line need not end with a line feed.
  if (!(line >= 1 && line <= selected_.lines + 1.0 && line == std::floor(line)))
    return refuse(alarm::search_failed, "Program " + selected_.name + " has lines 1 to " +
                                            std::to_string(selected_.lines) + ", not " +
                                            std::to_string(line));
  Entry entry;
  entry.line = line;
  shown_ = {};
  shown_.line = entry.line;
  return start_program(entry);
}

// The place at which the program begins or goes on has been found: what has to happen before it may move.
void ChannelCore::prepare_entry() {
  const bool by_line = !restart_;
  const auto& modal = program_flow_.executing();
  const auto& place_on_path = by_line ? program_flow_.position() : restart_->position;
  const bool rtcp = modal.transformation == language::Transformation::rtcp;
  const auto target = rtcp ? machine_.machine_from_tip(place_on_path, modal.tool_length) : place_on_path;
  const auto give_up = [this, stands = machine_start_] {
    finish(false);
    machine_start_ = stands;
  };
  const auto line = shown_.line;
  Preparation preparation;
  if (by_line) preparation.functions = program_flow_.auxiliaries().functions();
  preparation.moves = approach_moves(machine_start_, target, line);
  if (restart_ && is_near(machine_start_, target) && preparation.moves.size() > 1)
    preparation.moves.erase(preparation.moves.begin());
  const auto error = approach_error(machine_, machine_start_, preparation.moves);
  const auto place = selected_.name + ":" + std::to_string(line) + ": ";
  if (by_line && modal.tool != tool_) {
    event(alarm::search_failed, place + "needs tool T" + std::to_string(modal.tool) + ", T" +
                                    std::to_string(tool_) + " is in the spindle: change it by MDI first");
    give_up();
    return;
  }
  if (!error.empty()) {
    event(alarm::travel_limit, selected_.name + ":" + error);
    give_up();
    return;
  }
  preparation_ = std::move(preparation);
  if (!by_line) return;
  auto words = words_of(*preparation_, machine_start_);
  if (program_flow_.auxiliaries().not_repeated() > 0)
    words += (words.empty() ? "" : "; ") + std::to_string(program_flow_.auxiliaries().not_repeated()) +
             " other M functions before this line are not repeated";
  event(alarm::search_done, place + (words.empty() ? "ready" : words));
  run_ = RunState::HELD;
}

// One step of the preparation: an order, the approach, or the end of it, after which the program moves. False
// when something has to happen before the next step.
bool ChannelCore::run_preparation() {
  if (!external_hold_.empty()) {
    run_ = RunState::HELD;
    return false;
  }
  auto& functions = preparation_->functions;
  if (!functions.empty()) {
    const auto function = functions.front();
    functions.erase(functions.begin());
    if (!auxiliary_lock_) begin_auxiliary(function);
    return run_ == RunState::RUNNING;
  }
  if (!preparing_motion_) {
    preparing_motion_ = true;
    trajectory_ = manual_trajectory_;
    frame_ = language::Transformation::none;
    frame_tool_length_ = 0;
    trajectory_->start(machine_start_, frame_, 0);
    for (const auto& move : preparation_->moves) trajectory_->push(move);
    trajectory_->finish();
  }
  if (!trajectory_->at_rest() || !offset_.at_rest()) {
    start_stream();
    return false;
  }
  machine_start_ = machine_position();
  preparation_.reset();
  preparing_motion_ = false;
  trajectory_ = program_trajectory_;
  if (suspended_) {
    frame_ = suspended_->frame;
    frame_tool_length_ = suspended_->tool_length;
    point_ = suspended_->point;
    shown_ = suspended_->shown;
    reached_ = shown_.sequence;
    modal_ = suspended_->mdi_modal;
    suspended_.reset();
    trajectory_->retrace(false);
    return true;
  }
  const auto& modal = program_flow_.executing();
  frame_ = modal.transformation;
  frame_tool_length_ = modal.tool_length;
  if (!restart_) trajectory_->start(program_flow_.position(), frame_, frame_tool_length_);
  restart_.reset();
  return true;
}

// The program is held and stays planned; MDI and jog have a motion of their own.
void ChannelCore::suspend() {
  machine_start_ = machine_position();
  suspended_ = Suspended{frame_, frame_tool_length_, machine_start_, tool_, point_, shown_, modal_, {}};
  modal_ = program_flow_.executing();
  modal_.tool = static_cast<std::uint16_t>(tool_);
  activity_ = Activity::none;
  begin_manual(Activity::none);
  run_ = RunState::HELD;
}

Answer ChannelCore::go_on_after_suspension() {
  if (mode_ != Mode::AUTO)
    return refuse(alarm::request_invalid, "A program is held: choose mode AUTO to go on with it");
  if (must_reset_)
    return refuse(alarm::not_ready, "The drives were switched off in the program: reset the channel");
  if (tool_ != suspended_->tool)
    return refuse(alarm::search_failed, "The program was left with tool T" +
                                            std::to_string(suspended_->tool) + ", T" + std::to_string(tool_) +
                                            " is in the spindle");
  adopt_position();
  Preparation preparation;
  preparation.functions = program_flow_.auxiliaries().functions_changed_by(suspended_->by_hand);
  preparation.moves = approach_moves(machine_start_, suspended_->machine, suspended_->shown.line);
  if (const auto error = approach_error(machine_, machine_start_, preparation.moves); !error.empty())
    return refuse(alarm::travel_limit, "On the way back to line " + error);
  preparation_ = std::move(preparation);
  activity_ = Activity::program;
  run_ = RunState::RUNNING;
  hold_ = aborting_ = false;
  return {};
}

void ChannelCore::begin_manual(Activity activity) {
  trajectory_ = manual_trajectory_;
  frame_ = language::Transformation::none;
  frame_tool_length_ = 0;
  trajectory_->start(machine_start_, frame_, 0);
  activity_ = activity;
  run_ = RunState::RUNNING;
  hold_ = aborting_ = false;
}

Answer ChannelCore::start_mdi(const std::string& line) {
  if (mode_ != Mode::MDI) return refuse(alarm::request_invalid, "An MDI line needs mode MDI");
  if (activity_ != Activity::none) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  apply_parameters();
  adopt_position();
  mdi_line_ = line;
  mdi_source_.emplace(mdi_line_);
  mdi_shelf_.clear();
  begin_manual(Activity::mdi);
  frame_ = modal_.transformation;
  frame_tool_length_ = modal_.tool_length;
  modal_.tool = static_cast<std::uint16_t>(tool_);
  const auto position = frame_position(modal_);
  trajectory_->start(position, frame_, frame_tool_length_);
  mdi_flow_.set_block_skip(block_skip_);
  mdi_flow_.set_dry_run_feed(dry_run_ ? machine_.dry_run_feed() : 0);
  mdi_flow_.set_offset(offset_on_ ? std::optional(offset_.target()) : std::nullopt);
  forget_sequences();
  mdi_flow_.start(*trajectory_, *mdi_source_, position, modal_,
                  suspended_ ? program_flow_.variables() : *variables_, {},
                  frames_kept_ ? language::Beginning::line : language::Beginning::program);
  // What is wrong with the line is the answer to whoever typed it.
  const auto state = mdi_flow_.fill(false);
  if (state == FlowState::alarm && trajectory_->at_rest()) {
    activity_ = Activity::none;
    run_ = suspended_ ? RunState::HELD : RunState::IDLE;
    return {false, mdi_flow_.alarm_number(), "MDI:" + mdi_flow_.alarm_text()};
  }
  return {};
}

Answer ChannelCore::start_move(std::uint8_t axis, double target, double feed) {
  if (activity_ != Activity::none) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  apply_parameters();
  adopt_position();
  language::Command move;
  move.kind = language::CommandKind::line;
  move.target = machine_start_;
  const double offset = offset_.target()[axis];
  const auto& travel = machine_.travel(axis);
  const double low = std::min(travel.negative - offset, machine_start_[axis]),
               high = std::max(travel.positive - offset, machine_start_[axis]);
  move.target[axis] = std::clamp(target, low, high);
  move.modal.feed = feed;
  if (move.target[axis] == machine_start_[axis]) return {};
  begin_manual(Activity::jog);
  trajectory_->push(move);
  trajectory_->finish();
  return {};
}

}  // namespace trunnion::channel
