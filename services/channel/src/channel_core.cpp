#include "channel_core.hpp"

#include <algorithm>

#include "machine/alarm_constants.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::channel {

ChannelCore::ChannelCore(std::uint16_t channel, bool virtual_time)
    : number_(channel),
      virtual_time_(virtual_time),
      machine_(channel),
      link_(channel),
      program_flow_(machine_),
      mdi_flow_(machine_),
      written_(history) {
  machine_.resolve = [this](std::string_view name) {
    return (activity_ == Activity::mdi ? mdi_shelf_ : program_shelf_).call(programs_, name);
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
  if (!next_parameters_ || activity_ != Activity::none || suspended_ || link_.state() != LinkState::idle)
    return;
  try {
    machine_.configure(*next_parameters_);
  } catch (const std::exception& e) {
    event(machine::alarm_of(e), e.what());
    next_parameters_.reset();
    return;
  }
  parameters_ = std::exchange(next_parameters_, nullptr);
  for (const auto& line : machine::kinematics_warnings(*parameters_, number_))
    event(alarm::direction_not_unit, line);
  exact_stop_.configure(*parameters_, machine_.channel_axes(), machine_.columns());
  build_trajectories();
}

// While a handwheel offset may move, the path keeps to the share of the limits that the offset leaves.
void ChannelCore::build_trajectories() {
  auto limits = machine_.limits();
  AxisValues by_hand{};
  for (std::size_t i = 0; i < by_hand.size(); ++i)
    by_hand[i] = machine_.jog_feed(static_cast<std::uint8_t>(i)) / 60;
  const auto offset = offset_.position();
  const double cycle = machine_.cycle_seconds(), share = machine_.handwheel_share();
  wheel_.configure(limits, by_hand, 1, cycle);
  offset_.configure(limits, by_hand, share, cycle);
  offset_.start(offset);
  if (offset_on_)
    for (auto& axis : limits.axes) {
      axis.velocity *= 1 - share;
      axis.rapid_velocity *= 1 - share;
      axis.acceleration *= 1 - share;
      axis.jerk *= 1 - share;
    }
  path_limits_ = limits;
  program_owner_ = std::make_unique<motion::Trajectory>(limits, &machine_.chain(), cycle);
  manual_owner_ = std::make_unique<motion::Trajectory>(limits, &machine_.chain(), cycle);
  program_trajectory_ = program_owner_.get();
  manual_trajectory_ = trajectory_ = manual_owner_.get();
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
  if (activity_ != Activity::none || suspended_) return;
  for (const auto& entry : programs_.programs)
    if (entry.name == selected_.name) selected_ = entry;
}

void ChannelCore::on_feedback(const idl::stream::FeedbackFrame& feedback) {
  const bool first = !link_.has_feedback();
  const bool was_off = link_.drive_mode() == DriveMode::OFF;
  link_.on_feedback(feedback);
  skip_.on_feedback(feedback, machine_.channel_axes(), machine_.columns());
  exact_stop_.on_feedback(feedback);
  remember_executed();
  if (first) auxiliary_number_ = (link_.epoch() + 1) * 4096;
  const auto mode = link_.drive_mode();
  const bool streaming = link_.state() == LinkState::active || link_.state() == LinkState::ending;
  if (link_.state() == LinkState::lost)
    interrupt("The drive was restarted");
  else if (link_.state() == LinkState::refused)
    interrupt(mode == DriveMode::OFF ? "The drives are off" : "The drive gave no place in the stream");
  else if (streaming && (mode == DriveMode::HELD || mode == DriveMode::OFF) && !link_.resuming() &&
           run_ != RunState::INTERRUPTED)
    interrupt(mode == DriveMode::OFF ? "The drives were switched off" : "The drive stopped on the path");
  else if (mode == DriveMode::OFF && !first && !was_off && !link_.drive_restarted() && !must_reset_)
    interrupt("The drives were switched off");  // while the program was held or waited
}

void ChannelCore::recover() {
  if (recovered_ || !configured() || !link_.has_feedback()) return;
  recovered_ = true;
  const auto own = snapshot_of(link_.snapshot());
  if (own) {
    tool_ = own->tool;
    if (own->offset_on) {
      offset_on_ = true;
      build_trajectories();
      offset_.start(own->offset);
    }
  }
  if (!own || !own->running) {
    if (link_.echo_active()) link_.leave();
    offer_interrupted();
    return;
  }
  for (const auto& entry : programs_.programs)
    if (entry.crc32 == own->crc && entry.revision == own->revision) selected_ = entry;
  if (selected_.name.empty()) {
    link_.leave();
    event(alarm::interrupted, "The interrupted program is not in the store any more");
    return;
  }
  program_start_ = own->start;
  program_flow_.set_skips(own->skips);
  dry_run_ = own->dry_run, auxiliary_lock_ = own->auxiliary_lock, block_skip_ = own->block_skip;
  restart_ = RestartPoint{own->sequence, own->fraction, own->position};
  mode_ = Mode::AUTO;
  activity_ = Activity::program;
  trajectory_ = program_trajectory_;
  run_ = RunState::INTERRUPTED;
  interrupted_ = {};
  shown_.line = own->line;
  event(alarm::interrupted,
        "Program " + selected_.name + " was interrupted in line " + std::to_string(shown_.line));
}

// After a power failure only the line is known: the operator decides whether to start from it.
void ChannelCore::offer_interrupted() {
  if (interrupted_.line == 0) return;
  const auto where = "Program " + interrupted_.name + " was in line " + std::to_string(interrupted_.line) +
                     " when the control was switched off";
  for (const auto& entry : programs_.programs)
    if (entry.name == interrupted_.name && entry.revision == interrupted_.revision &&
        entry.crc32 == interrupted_.crc) {
      selected_ = entry;
      event(alarm::switched_off_in_program, where + ": it can be started from there");
      return;
    }
  event(alarm::switched_off_in_program, where + ", and has been changed or deleted since");
  interrupted_ = {};
}

RunningProgram ChannelCore::running_program() const {
  if (!program_under_way()) return interrupted_;
  return {selected_.name, selected_.revision, selected_.crc32, std::max<std::uint32_t>(shown_.line, 1)};
}

void ChannelCore::interrupt(const std::string& why) {
  must_reset_ = must_reset_ || (link_.drive_mode() == DriveMode::OFF && link_.state() != LinkState::lost &&
                                (activity_ != Activity::none || suspended_));
  if (link_.state() == LinkState::lost || link_.state() == LinkState::refused) {
    // What was written is void: go on from the newest consistent cut, if there is a program to go on with.
    const bool was_lost = link_.state() == LinkState::lost;
    link_.acknowledge();
    const auto own = snapshot_of(link_.snapshot());
    offset_.start(own && own->offset_on ? own->offset : AxisValues{});
    const bool entering = preparation_ && !restart_;
    if (activity_ == Activity::program && !entering && !(was_lost && lock_.any())) {
      preparation_.reset();
      if (own && own->running && own->crc == selected_.crc32)
        restart_ = RestartPoint{own->sequence, own->fraction, own->position};
      else if (!was_lost)
        restart_ = RestartPoint{};
    } else if (activity_ != Activity::none) {
      stop_activity();
      event(alarm::interrupted, why);
      return;
    }
  }
  if (activity_ == Activity::none) return;
  run_ = RunState::INTERRUPTED;
  event(alarm::interrupted, why);
}

// What the program has read ahead counts: a variable is not taken back when the motion behind it is stopped.
// MDI in a held program works on a copy: a restart of the program must find what it began with.
void ChannelCore::keep_variables() {
  if (!interpreting() || (activity_ == Activity::mdi && suspended_)) return;
  *variables_ = flow().variables();
  variables_news_ = true;
}

AxisValues ChannelCore::machine_of(const AxisValues& path) const {
  return frame_ == language::Transformation::rtcp ? machine_.machine_from_tip(path, frame_tool_length_)
                                                  : path;
}

AxisValues ChannelCore::machine_position() const {
  if (activity_ != Activity::handwheel) return machine_of(trajectory_->position());
  auto position = machine_start_;
  for (std::size_t i = 0; i < position.size(); ++i) position[i] += wheel_.position()[i];
  return position;
}

AxisValues ChannelCore::frame_position(const language::ModalState& modal) const {
  return modal.transformation == language::Transformation::rtcp
             ? machine_.tip_from_machine(machine_start_, modal.tool_length)
             : machine_start_;
}

AxisValues ChannelCore::drive_position() const {
  auto position = machine_start_;
  const auto& axes = machine_.channel_axes();
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const int column = machine_.columns()[i];
    if (column >= 0 && static_cast<std::size_t>(column) < link_.positions().size())
      position[axes.index[i]] = link_.positions()[static_cast<std::size_t>(column)];
  }
  return position;
}

// Where a new epoch begins: where the drive has the axes.
void ChannelCore::adopt_position() {
  if (!link_.needs_epoch()) return;
  const auto real = drive_position();
  auto path = real;
  for (std::size_t i = 0; i < path.size(); ++i) path[i] -= offset_.position()[i];
  machine_start_ = lock_.show(path, machine_start_);
  lock_.adopt(real);
}

void ChannelCore::stop_activity() {
  // A motion that was held stands where its path was left, and no new epoch will say so.
  const bool moved = !preparation_ || preparing_motion_;
  if (activity_ != Activity::none && link_.state() == LinkState::idle && !link_.needs_epoch() && moved)
    machine_start_ = machine_position();
  skip_.end();
  finish_tapping();
  if (link_.state() == LinkState::active || link_.state() == LinkState::ending ||
      link_.state() == LinkState::requested)
    link_.leave();
  keep_variables();
  const bool by_hand = suspended_ && (activity_ != Activity::program || preparation_);
  if (!by_hand) suspended_.reset();
  activity_ = Activity::none;
  run_ = suspended_ ? RunState::HELD : RunState::IDLE;
  hold_ = aborting_ = table_open_ = text_missing_ = false;
  restart_.reset();
  preparation_.reset();
  preparing_motion_ = false;
  wheel_.start({});
  if (auxiliary_open_) {
    auxiliary_open_ = false;
    auxiliary_.kind = idl::channel::AuxiliaryKind::NO_AUXILIARY;
    outgoing_auxiliary_ = auxiliary_;
  }
  apply_parameters();
}

void ChannelCore::finish(bool program_end) {
  skip_.end();
  finish_tapping();
  machine_start_ = machine_position();
  wheel_.start({});
  if (activity_ == Activity::mdi && !reset_due_) {  // a reset has its own modal state
    modal_ = mdi_flow_.modal();
    frames_kept_ = true;
    modal_.tool = static_cast<std::uint16_t>(tool_);
  }
  if (program_end && activity_ == Activity::program) shown_ = {};
  keep_variables();
  if (activity_ == Activity::program) suspended_.reset();
  activity_ = Activity::none;
  run_ = suspended_ ? RunState::HELD : RunState::IDLE;
  hold_ = aborting_ = text_missing_ = false;
  restart_.reset();
  preparation_.reset();
  preparing_motion_ = false;
  if (reset_due_) drop_offset();
  reset_due_ = false;
  apply_parameters();
}

std::optional<ChunkWanted> ChannelCore::wanted() const {
  if (!interpreting()) return std::nullopt;
  return activity_ == Activity::mdi ? mdi_shelf_.wanted() : program_shelf_.wanted();
}

void ChannelCore::deliver(const std::string& name, std::uint64_t offset, std::vector<std::uint8_t> data) {
  program_shelf_.deliver(name, offset, data);
  mdi_shelf_.deliver(name, offset, data);
}

void ChannelCore::chunk_failed(const std::string& name) {
  program_shelf_.fail(name);
  mdi_shelf_.fail(name);
}

}  // namespace trunnion::channel
