// SPDX-License-Identifier: Apache-2.0
// What happens before a program moves, and the return to one that was left.
#include <algorithm>
#include <cmath>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {
// An axis this near to its target, mm or degrees, was stopped on its path and is brought there in a straight
// line.
constexpr double near_distance = 2;

bool is_near(const AxisValues& a, const AxisValues& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > near_distance) return false;
  return true;
}
}  // namespace

// A rotary axis that counts modulo 360 may be whole turns away from where the found line begins. The program
// that begins these turns further on is the same, and its approach takes none of them back. A restart
// interprets it from there, too, so the start is moved and not only what was found.
bool ChannelCore::search_from_other_turns(const AxisValues& target) {
  constexpr double turn = 360, half = turn / 2 + 1e-6;
  const auto before = program_start_;
  for (std::size_t axis = 0; axis < target.size(); ++axis) {
    const double away = machine_start_[axis] - target[axis];
    if (machine_.rotary_way(axis) != canonical::RotaryWay::linear && std::abs(away) > half)
      program_start_[axis] += turn * std::floor(away / turn + 0.5);
  }
  if (program_start_ == before) return false;
  Entry entry;
  entry.line = progress_.executed.line;
  configure_flow(program_flow_);
  program_flow_.start(program_path_.trajectory(), program_cache_.open(selected()), program_start_,
                      power_on_modal(), *variables_, entry);
  return true;
}

// The point at which the program starts or continues has been found: what has to happen before it may move.
void ChannelCore::prepare_entry() {
  const bool by_line = !restart_;
  const auto& modal = program_flow_.executing();
  const auto& place_on_path = by_line ? program_flow_.position() : restart_->position;
  const bool rtcp = modal.transformation == language::Transformation::rtcp;
  const auto target = rtcp ? machine_.machine_from_tip(place_on_path, modal.tool_length) : place_on_path;
  if (by_line && search_from_other_turns(target)) return;
  const auto give_up = [this, at_rest = machine_start_] {
    finish(false);
    machine_start_ = at_rest;
  };
  const auto line = progress_.executed.line;
  Preparation preparation;
  if (by_line) preparation.functions = program_flow_.auxiliaries().functions();
  preparation.moves = approach_moves(machine_start_, target, line);
  if (restart_ && is_near(machine_start_, target) && preparation.moves.size() > 1)
    preparation.moves.erase(preparation.moves.begin());
  const auto* frame =
      by_line ? &program_flow_.interpreter().frame() : program_flow_.frames().at(restart_->sequence);
  const auto error = approach_error(machine_, machine_start_, preparation.moves, frame);
  const auto place = selected().name + ":" + std::to_string(line) + ": ";
  if (by_line && modal.tool != tool_) {
    event(alarm::search_failed, place + "needs tool T" + std::to_string(modal.tool) + ", T" +
                                    std::to_string(tool_) + " is in the spindle: change it by MDI first");
    give_up();
    return;
  }
  if (!error.empty()) {
    event(alarm::travel_limit, selected().name + ":" + error);
    give_up();
    return;
  }
  if (const auto tap = tap_words(machine_start_); !tap.empty() && !preparation.moves.empty()) {
    event(alarm::tap_removal_thread, place + refuse_with_tap(tap).reason);
    give_up();
    return;
  }
  if (const auto obstacle = approach_obstacle(preparation.moves); !obstacle.empty()) {
    event(alarm::bodies_would_meet, place + "on the approach " + obstacle);
    give_up();
    return;
  }
  if (by_line) {
    auto words = words_of(preparation, machine_start_);
    if (program_flow_.auxiliaries().not_repeated() > 0)
      words += (words.empty() ? "" : "; ") + std::to_string(program_flow_.auxiliaries().not_repeated()) +
               " other functions before this line are not repeated";
    event(alarm::search_done, place + (words.empty() ? "ready" : words));
  }
  states_.prepare(std::move(preparation), by_line);
}

// One step of the preparation: a function, the approach, or the end of it, after which the program moves.
// False when something has to happen before the next step.
bool ChannelCore::run_preparation() {
  if (interlock_.holds()) {
    states_.pause();
    return false;
  }
  auto& preparing = *states_.preparing();
  auto& functions = preparing.preparation.functions;
  if (!functions.empty()) {
    const auto function = functions.front();
    functions.erase(functions.begin());
    if (switches_.auxiliary_lock) return true;
    begin_auxiliary(function);
    return false;
  }
  auto& trajectory = manual_path_.trajectory();
  if (!preparing.approaching) {
    preparing.approaching = true;
    manual_path_.start(machine_start_);
    for (const auto& move : preparing.preparation.moves) trajectory.push(move);
    trajectory.finish();
  }
  if (!trajectory.at_rest() || !manual_.offset_at_rest()) {
    stream_.start();
    return false;
  }
  end_preparation();
  return true;
}

void ChannelCore::end_preparation() {
  machine_start_ = machine_position();
  if (const auto* suspended = states_.suspended()) {
    progress_ = suspended->progress;
    progress_.reached = progress_.executed.sequence;
    mdi_.set_modal(suspended->mdi_modal);
    program_path_.trajectory().retrace(false);
    states_.end_preparation();
    return;
  }
  const auto& modal = program_flow_.executing();
  if (restart_)  // the flow has started the trajectory there
    program_path_.adopt_frame(modal.transformation, modal.tool_length);
  else
    program_path_.start(program_flow_.position(), modal.transformation, modal.tool_length);
  restart_.reset();
  states_.end_preparation();
}

// The program is held and stays planned; MDI and jog have a motion of their own.
void ChannelCore::suspend() {
  machine_start_ = machine_position();
  SuspendedProgram program;
  program.machine = machine_start_;
  program.tool = tool_;
  program.progress = progress_;
  program.mdi_modal = mdi_.modal();
  mdi_.set_modal(executed_modal());
  mdi_.set_tool(tool_);
  states_.suspend(program);
  manual_path_.start(machine_start_);
}

Answer ChannelCore::continue_after_suspension() {
  const auto& suspended = *states_.suspended();
  if (mode_ != Mode::AUTO)
    return refuse(alarm::request_invalid, "A program is held: choose mode AUTO to continue it");
  if (states_.needs_reset())
    return refuse(alarm::not_ready, "The drives were switched off in the program: reset the channel");
  if (tool_ != suspended.tool)
    return refuse(alarm::search_failed, "The program was left with tool T" + std::to_string(suspended.tool) +
                                            ", T" + std::to_string(tool_) + " is in the spindle");
  adopt_position();
  Preparation preparation;
  preparation.functions = program_flow_.auxiliaries().functions_changed_by(suspended.mdi_functions);
  preparation.moves = approach_moves(machine_start_, suspended.machine, suspended.progress.executed.line);
  const auto* frame = program_flow_.frames().at(suspended.progress.executed.sequence);
  if (const auto error = approach_error(machine_, machine_start_, preparation.moves, frame); !error.empty())
    return refuse(alarm::travel_limit, "On the return to line " + error);
  if (const auto tap = tap_words(machine_start_); !tap.empty() && !preparation.moves.empty())
    return refuse_with_tap(tap);
  if (const auto obstacle = approach_obstacle(preparation.moves); !obstacle.empty())
    return refuse(
        alarm::bodies_would_meet,
        "On the return to line " + std::to_string(suspended.progress.executed.line) + " " + obstacle);
  states_.begin_return(std::move(preparation));
  return {};
}

}  // namespace trunnion::channel
