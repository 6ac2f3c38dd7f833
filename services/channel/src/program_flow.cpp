#include "program_flow.hpp"

namespace trunnion::channel {

using language::CommandKind;

namespace {

/// A line of the started program, or of another text with its name.
std::string place(std::uint32_t program, std::uint32_t line) {
  std::string name;
  if (program != 0) name = std::string(language::ProgramName(program).view()) + ":";
  return name + std::to_string(line);
}

}  // namespace

void ProgramFlow::start(language::TextSource& text, const AxisValues& position,
                        const language::ModalState& initial, const language::VariableStore& variables,
                        const RestartPoint& restart) {
  interpreter_.start(text, position, initial, variables);
  have_command_ = false;
  block_line_ = 0;
  restart_ = restart;
  searching_ = restart.sequence > 0;
  if (!searching_) skips_.clear();
  skips_read_ = 0;
  tapping_ = in_hole_ = refused_ = false;
  executing_ = initial;
  alarm_number_ = 0;
  alarm_text_.clear();
}

FlowState ProgramFlow::push_move() {
  if (command_.kind != CommandKind::dwell) {
    alarm_text_ = machine_.travel_error(trajectory_->end_position(), command_);
    if (!alarm_text_.empty()) {
      alarm_number_ = 140;
      return FlowState::alarm;
    }
  }
  auto move = command_.kind == CommandKind::tap ? Tapping::line(command_) : command_;
  if (move.kind == CommandKind::skip) move.kind = CommandKind::line;
  if (move.modal.feed_mode == language::FeedMode::per_revolution) {
    move.modal.feed *= move.modal.spindle_speed;
    move.modal.feed_mode = language::FeedMode::per_minute;
  }
  const bool partly = restart_.sequence == command_.sequence && restart_.sequence > 0;
  const bool taken = partly ? trajectory_->push_from(move, restart_.fraction) : trajectory_->push(move);
  if (!taken) {
    alarm_number_ = 1112;
    alarm_text_ = std::to_string(command_.line) +
                  ": feed must be above zero (per revolution: with the spindle turning)";
    return FlowState::alarm;
  }
  executing_ = command_.modal;
  have_command_ = false;
  return FlowState::full;
}

FlowState ProgramFlow::push_pending() {
  const auto state = push_move();
  refused_ = state == FlowState::alarm;
  trajectory_->finish();
  return state;
}

void ProgramFlow::refuse_pending(language::AlarmNumber number) {
  fail(number);
  refused_ = true;
}

FlowState ProgramFlow::fail(language::AlarmNumber number) {
  alarm_number_ = static_cast<std::uint32_t>(number);
  alarm_text_ = place(command_.program, command_.line) + ": " + std::string(language::alarm_text(number));
  trajectory_->finish();
  return FlowState::alarm;
}

FlowState ProgramFlow::fill(bool single_block) {
  if (refused_) return FlowState::alarm;
  constexpr int most_commands = 4096;  // a long search for the restart point must not keep the channel deaf
  for (int i = 0; i < most_commands; ++i) {
    if (!searching_ && !trajectory_->can_accept()) return FlowState::full;
    if (!have_command_) {
      switch (interpreter_.next(command_)) {
        case language::Step::command:
          have_command_ = true;
          break;
        case language::Step::working:
          continue;
        case language::Step::pending:
          return FlowState::waiting;
        case language::Step::position:
          if (skips_read_ == skips_.size()) return fail(language::AlarmNumber::not_resumable);
          interpreter_.set_position(skips_[skips_read_].stopped, skips_[skips_read_].touched);
          ++skips_read_;
          continue;
        case language::Step::end:
          return FlowState::end;
        case language::Step::alarm: {
          const auto& alarm = interpreter_.alarm();
          alarm_number_ = static_cast<std::uint32_t>(alarm.number);
          alarm_text_ = place(alarm.program, alarm.line) + ":" + std::to_string(alarm.column) + ": " +
                        alarm.text.data();
          for (std::size_t k = alarm.calls; k-- > 0;)
            alarm_text_ += ", called from " + place(alarm.chain[k].program, alarm.chain[k].line);
          trajectory_->finish();
          return FlowState::alarm;
        }
      }
    }
    if (searching_) {
      if (command_.sequence < restart_.sequence) {
        in_hole_ = command_.kind == CommandKind::tap || (in_hole_ && command_.kind == CommandKind::dwell);
        have_command_ = false;
        continue;
      }
      // The spindle has lost its place in the thread.
      if (command_.kind == CommandKind::tap || (in_hole_ && command_.kind == CommandKind::dwell))
        return fail(language::AlarmNumber::not_resumable);
      searching_ = false;
      trajectory_->start(restart_.position, command_.modal.transformation, command_.modal.tool_length);
    }
    const bool stroke =
        command_.kind == CommandKind::tap || (tapping_ && command_.kind == CommandKind::dwell);
    const bool move = command_.kind == CommandKind::rapid || command_.kind == CommandKind::line ||
                      command_.kind == CommandKind::arc || command_.kind == CommandKind::dwell || stroke;
    if (single_block && block_line_ != 0 && command_.line != block_line_) {
      trajectory_->finish();
      return FlowState::block_end;
    }
    block_line_ = command_.line;
    if (!move || stroke != tapping_) {
      if (command_.kind == CommandKind::skip || stroke) executing_ = command_.modal;
      trajectory_->finish();
      return command_.kind == CommandKind::end && command_.number == 0 ? FlowState::end : FlowState::command;
    }
    if (const auto state = push_move(); state == FlowState::alarm) {
      trajectory_->finish();
      return state;
    }
  }
  return FlowState::waiting;
}

}  // namespace trunnion::channel
