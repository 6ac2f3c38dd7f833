#include "channel_core.hpp"

#include <algorithm>
#include <cmath>

#include "machine/alarms.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::channel {
namespace {
// A hold has ended in a standstill when the setpoints have been the same this long: a rounding at a stop may
// still run out after the path speed is 0.
constexpr int standstill_cycles = 3;
// Meaning of the channel's entry in the stream's states, from which a restarted process goes on.
enum StateIndex {
  s_running,
  s_crc,
  s_revision,
  s_sequence,
  s_fraction,
  s_line,
  s_transformation,
  s_tool_length,
  s_tool,
  s_position,
  s_start = s_position + 9,
  s_size = s_start + 9  // then the results of the skip moves so far, 18 values each
};
constexpr std::size_t skip_values = 18, most_skips = 24;

std::vector<SkipResult> skips_of(const std::vector<double>& state) {
  std::vector<SkipResult> skips((state.size() - s_size) / skip_values);
  auto from = state.begin() + s_size;
  for (auto& skip : skips) {
    std::copy_n(from, 9, skip.stopped.begin());
    std::copy_n(from + 9, 9, skip.touched.begin());
    from += skip_values;
  }
  return skips;
}
}  // namespace

ChannelCore::ChannelCore(std::uint16_t channel, bool virtual_time)
    : number_(channel),
      virtual_time_(virtual_time),
      machine_(channel),
      link_(channel),
      flow_(machine_, trajectory_),
      written_(history) {
  machine_.resolve = [this](std::string_view name) -> language::TextSource* {
    const auto matches = [&](const std::string& stored) {
      return stored.rfind(name, 0) == 0 && (stored.size() == name.size() || stored[name.size()] == '.');
    };
    for (const auto& entry : programs_.programs)
      if (matches(entry.name)) {
        subprograms_.push_back(std::make_unique<ProgramText>(entry.name, entry.revision, entry.size));
        return subprograms_.back().get();
      }
    return nullptr;
  };
  modal_ = power_on_modal();
}

language::ModalState ChannelCore::power_on_modal() const {
  language::ModalState modal;
  modal.tool = static_cast<std::uint16_t>(tool_);
  return modal;
}

void ChannelCore::set_parameters(std::shared_ptr<const machine::Parameters> parameters) {
  next_parameters_ = std::move(parameters);
  apply_parameters();
}

// A revision is used from the next start on: setpoints of one motion are all made with one revision.
void ChannelCore::apply_parameters() {
  if (!next_parameters_ || activity_ != Activity::none || link_.state() != LinkState::idle) return;
  try {
    machine_.configure(*next_parameters_);
  } catch (const std::exception& e) {
    event(machine::alarm_of(e), e.what());
    next_parameters_.reset();
    return;
  }
  parameters_ = std::exchange(next_parameters_, nullptr);
  for (const auto& line : machine::kinematics_warnings(*parameters_, number_))
    event("direction_not_unit", line);
  trajectory_owner_ =
      std::make_unique<motion::Trajectory>(machine_.limits(), &machine_.chain(), machine_.cycle_seconds());
  trajectory_ = trajectory_owner_.get();
  frame_ = language::Transformation::none;
  frame_tool_length_ = 0;
  trajectory_->start(machine_start_, frame_, 0);
}

void ChannelCore::set_tools(const idl::parameters::ToolTable& tools) {
  tool_table_ = tools;
  machine_.set_tools(tools);
}
void ChannelCore::set_offsets(const idl::parameters::WorkOffsets& offsets) { machine_.set_offsets(offsets); }

void ChannelCore::set_programs(const idl::program::ProgramList& programs) {
  programs_ = programs;
  if (activity_ != Activity::none) return;
  for (const auto& entry : programs_.programs)
    if (entry.name == selected_.name) selected_ = entry;
}

void ChannelCore::on_feedback(const idl::stream::FeedbackFrame& feedback) {
  const bool first = !link_.has_feedback();
  const bool was_off = link_.drive_mode() == DriveMode::off;
  link_.on_feedback(feedback);
  skip_.on_feedback(feedback, machine_.channel_axes(), machine_.columns());
  remember_executed();
  if (first) auxiliary_number_ = (link_.epoch() + 1) * 4096;
  const auto mode = link_.drive_mode();
  const bool streaming = link_.state() == LinkState::active || link_.state() == LinkState::ending;
  if (link_.state() == LinkState::lost)
    interrupt("The drive was restarted");
  else if (link_.state() == LinkState::refused)
    interrupt(mode == DriveMode::off ? "The drives are off" : "The drive gave no place in the stream");
  else if (streaming && (mode == DriveMode::held || mode == DriveMode::off) && !link_.resuming() &&
           run_ != RunState::INTERRUPTED)
    interrupt(mode == DriveMode::off ? "The drives were switched off" : "The drive stopped on the path");
  else if (mode == DriveMode::off && !first && !was_off && !link_.drive_restarted() && !must_reset_)
    interrupt("The drives were switched off");  // while the program was held or waited
}

void ChannelCore::recover() {
  if (recovered_ || !configured() || !link_.has_feedback()) return;
  recovered_ = true;
  const auto* own = stream::find_state(link_.states(), stream::stage_channel);
  const bool was_running = own != nullptr && own->values.size() >= s_size && own->values[s_running] != 0;
  if (!was_running) {
    if (link_.echo_active()) link_.leave();
    return;
  }
  const auto& v = own->values;
  tool_ = static_cast<std::uint32_t>(v[s_tool]);
  for (const auto& entry : programs_.programs)
    if (entry.crc32 == static_cast<std::uint32_t>(v[s_crc]) &&
        entry.revision == static_cast<std::uint64_t>(v[s_revision]))
      selected_ = entry;
  if (selected_.name.empty()) {
    link_.leave();
    event("interrupted", "The interrupted program is not in the store any more");
    return;
  }
  RestartPoint point;
  point.sequence = static_cast<std::uint32_t>(v[s_sequence]);
  point.fraction = v[s_fraction];
  std::copy_n(&v[s_position], 9, point.position.begin());
  std::copy_n(&v[s_start], 9, program_start_.begin());
  flow_.set_skips(skips_of(v));
  restart_ = point;
  mode_ = Mode::AUTO;
  activity_ = Activity::program;
  run_ = RunState::INTERRUPTED;
  shown_.line = static_cast<std::uint32_t>(v[s_line]);
  event("interrupted",
        "Program " + selected_.name + " was interrupted in line " + std::to_string(shown_.line));
}

void ChannelCore::interrupt(const std::string& why) {
  must_reset_ = must_reset_ || (link_.drive_mode() == DriveMode::off && link_.state() != LinkState::lost &&
                                activity_ != Activity::none);
  if (link_.state() == LinkState::lost || link_.state() == LinkState::refused) {
    // What was written is void: go on from the newest consistent cut, if there is a program to go on with.
    const bool was_lost = link_.state() == LinkState::lost;
    link_.acknowledge();
    if (activity_ == Activity::program) {
      const auto* own = stream::find_state(link_.states(), stream::stage_channel);
      RestartPoint point;
      if (own != nullptr && own->values.size() >= s_size && own->values[s_running] != 0 &&
          static_cast<std::uint32_t>(own->values[s_crc]) == selected_.crc32) {
        point.sequence = static_cast<std::uint32_t>(own->values[s_sequence]);
        point.fraction = own->values[s_fraction];
        std::copy_n(&own->values[s_position], 9, point.position.begin());
        restart_ = point;
      } else if (!was_lost) {
        restart_ = RestartPoint{};
      }
    } else if (activity_ != Activity::none) {
      stop_activity();
      event("interrupted", why);
      return;
    }
  }
  if (activity_ == Activity::none) return;
  run_ = RunState::INTERRUPTED;
  event("interrupted", why);
}

void ChannelCore::set_hold(const std::string& why) {
  external_hold_ = why;
  if (!why.empty() && run_ == RunState::RUNNING && activity_ != Activity::none) hold();
}

void ChannelCore::hold() {
  hold_ = true;
  run_ = RunState::HOLDING;
}

// What the program has read ahead counts: a variable is not taken back when the motion behind it is stopped.
void ChannelCore::keep_variables() {
  if (activity_ != Activity::program && activity_ != Activity::mdi) return;
  *variables_ = flow_.variables();
  variables_news_ = true;
}

AxisValues ChannelCore::machine_position() const {
  return frame_ == language::Transformation::rtcp
             ? machine_.machine_from_tip(trajectory_->position(), frame_tool_length_)
             : trajectory_->position();
}

AxisValues ChannelCore::frame_position(const language::ModalState& modal) const {
  return modal.transformation == language::Transformation::rtcp
             ? machine_.tip_from_machine(machine_start_, modal.tool_length)
             : machine_start_;
}

// Where a new epoch begins: where the drive has the axes.
void ChannelCore::adopt_position() {
  if (!link_.needs_epoch()) return;
  const auto& axes = machine_.channel_axes();
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const int column = machine_.columns()[i];
    if (column >= 0 && static_cast<std::size_t>(column) < link_.positions().size())
      machine_start_[axes.index[i]] = link_.positions()[static_cast<std::size_t>(column)];
  }
}

void ChannelCore::stop_activity() {
  skip_.end();
  finish_tapping();
  if (link_.state() == LinkState::active || link_.state() == LinkState::ending ||
      link_.state() == LinkState::requested)
    link_.leave();
  keep_variables();
  activity_ = Activity::none;
  run_ = RunState::IDLE;
  hold_ = aborting_ = table_open_ = false;
  restart_.reset();
  if (auxiliary_open_) {
    auxiliary_open_ = false;
    auxiliary_.kind = 0;
    outgoing_auxiliary_ = auxiliary_;
  }
  apply_parameters();
}

void ChannelCore::finish(bool program_end) {
  skip_.end();
  finish_tapping();
  machine_start_ = machine_position();
  if (activity_ == Activity::mdi) {
    modal_ = flow_.modal();
    modal_.tool = static_cast<std::uint16_t>(tool_);
  }
  if (program_end && activity_ == Activity::program) shown_ = {};
  keep_variables();
  activity_ = Activity::none;
  run_ = RunState::IDLE;
  hold_ = aborting_ = false;
  restart_.reset();
  apply_parameters();
}

FlowState ChannelCore::fill() {
  if (activity_ == Activity::jog || aborting_ || skip_.active()) return FlowState::full;
  flow_.set_cycle(link_.next());
  return flow_.fill(single_block_ && activity_ == Activity::program);
}

void ChannelCore::advance() {
  if (!configured()) return;
  apply_parameters();
  if (activity_ == Activity::none || link_.state() != LinkState::idle) return;
  if (run_ == RunState::HOLDING) {  // the motion has stopped and was executed
    hold_ = false;
    if (aborting_)
      finish(false);
    else
      run_ = RunState::HELD;
    return;
  }
  for (int i = 0; i < 1000 && run_ == RunState::RUNNING && activity_ != Activity::none; ++i) {
    const auto flow = fill();
    if (flow == FlowState::waiting) return;
    const bool searching = flow_.searching() && activity_ != Activity::jog;
    if (searching && flow != FlowState::alarm) return;
    if (restart_ && activity_ == Activity::program && !searching) {  // the restart point has been found
      frame_ = flow_.executing().transformation;
      frame_tool_length_ = flow_.executing().tool_length;
      restart_.reset();
    }
    if (!trajectory_->at_rest()) {
      if (!external_hold_.empty()) {
        run_ = RunState::HELD;
        return;
      }
      if (!may_start_) return;
      standing_ = 0;
      link_.request_start();
      return;
    }
    if (activity_ == Activity::jog || aborting_) {
      finish(false);
      return;
    }
    if (skip_.active()) {
      finish_skip();
      continue;
    }
    run_pending(flow);
  }
}

// The slowest copy of a stage is near enough for `count` setpoints more. It may not have heard of this
// motion.
bool ChannelCore::copies_follow(std::uint32_t count) {
  if (link_.starts()) motion_start_ = link_.next();
  const auto end = link_.next() + count, distance = 2 * machine_.lead();
  return end <= distance || end - distance <= std::max(floor_, motion_start_);
}

bool ChannelCore::produce(idl::stream::PathFrame& frame) {
  if (link_.state() != LinkState::active) return false;
  const std::uint32_t count = machine_.frame_cycles(virtual_time_);
  if (!link_.credit(count, machine_.lead()) || !copies_follow(count)) return false;
  frame.setpoints.clear();
  frame.lines.clear();
  frame.spindle.clear();
  frame.ends = false;
  frame.count = 0;
  auto flow = FlowState::full;
  while (frame.count < count && !frame.ends) {
    const std::uint64_t cycle = link_.next() + frame.count;
    if (!holding() && !aborting_) {
      flow = fill();
      if (flow == FlowState::waiting) break;
    }
    if (skip_.active()) skip_.moves_from(cycle);
    if (skip_.active() && skip_.brakes_in(cycle, machine_.lead())) trajectory_->abort();
    const double feed_override = tapping_.active() ? 1 : feed_override_;
    const auto setpoint = trajectory_->step(feed_override, rapid_override_, holding());
    frame.setpoints.insert(frame.setpoints.end(), setpoint.position.begin(), setpoint.position.end());
    frame.lines.push_back(setpoint.line);
    if (tapping_.active()) frame.spindle.push_back(tapping_.revolutions(setpoint.position));
    written_[cycle % history] = {cycle, setpoint.line, setpoint.feed, setpoint.distance_to_go,
                                 setpoint.position};
    point_ = {setpoint.sequence, setpoint.line, setpoint.fraction};
    ++frame.count;
    standing_ = setpoint.path_speed == 0 && setpoint.position == last_position_ ? standing_ + 1 : 0;
    last_position_ = setpoint.position;
    frame.ends = setpoint.at_rest || (holding() && standing_ > standstill_cycles);
  }
  if (frame.count == 0) return false;
  frame.channel = number_;
  frame.copy = 0;
  frame.epoch = link_.epoch();
  frame.first = link_.next();
  frame.revision = machine_.revision();
  frame.starts = link_.starts();
  frame.transformation = frame_ == language::Transformation::rtcp ? 1 : 0;
  frame.tool_length = frame_tool_length_;
  frame.spindle_axis = machine_.tapping_spindle().axis.value_or(0);
  frame.states.clear();
  if (frame.starts) frame.states = link_.states();
  auto& own = stream::state_of(frame.states, stream::stage_channel);
  own.cycle = frame.first + frame.count - 1;
  own.values = stage_state(flow);
  link_.written(frame.count, frame.ends);
  return true;
}

std::vector<double> ChannelCore::stage_state(FlowState flow) {
  std::vector<double> v(s_size, 0.0);
  const auto& point = point_;
  const bool last = flow == FlowState::end ||
                    (flow == FlowState::command && flow_.pending().kind == language::CommandKind::end);
  v[s_running] = activity_ == Activity::program && !aborting_ && !(last && trajectory_->at_rest()) ? 1 : 0;
  v[s_crc] = selected_.crc32;
  v[s_revision] = static_cast<double>(selected_.revision);
  v[s_sequence] = point.sequence;
  v[s_fraction] = point.fraction;
  v[s_line] = point.line;
  v[s_transformation] = frame_ == language::Transformation::rtcp ? 1 : 0;
  v[s_tool_length] = frame_tool_length_;
  v[s_tool] = tool_;
  std::copy(trajectory_->position().begin(), trajectory_->position().end(), v.begin() + s_position);
  std::copy(program_start_.begin(), program_start_.end(), v.begin() + s_start);
  // More than the state has room for are lost with this process; the program is then not resumable.
  for (const auto& skip : flow_.skips()) {
    if (flow_.skips().size() > most_skips) break;
    v.insert(v.end(), skip.stopped.begin(), skip.stopped.end());
    v.insert(v.end(), skip.touched.begin(), skip.touched.end());
  }
  return v;
}

void ChannelCore::remember_executed() {
  if (link_.executed() == 0) return;
  const auto& written = written_[(link_.executed() - 1) % history];
  if (written.cycle == link_.executed() - 1 && (written.line != 0 || activity_ != Activity::program))
    shown_ = written;
}

std::optional<ChunkWanted> ChannelCore::wanted() const {
  if (activity_ != Activity::program && activity_ != Activity::mdi) return std::nullopt;
  if (text_)
    if (auto w = text_->wanted()) return w;
  for (const auto& text : subprograms_)
    if (auto w = text->wanted()) return w;
  return std::nullopt;
}

void ChannelCore::deliver(const std::string& name, std::uint64_t offset, std::vector<std::uint8_t> data) {
  if (text_ && text_->name() == name) return text_->deliver(offset, std::move(data));
  for (const auto& text : subprograms_)
    if (text->name() == name) return text->deliver(offset, std::move(data));
}

void ChannelCore::chunk_failed(const std::string& name) {
  if (text_ && text_->name() == name) text_->fail();
  for (const auto& text : subprograms_)
    if (text->name() == name) text->fail();
}

}  // namespace trunnion::channel
