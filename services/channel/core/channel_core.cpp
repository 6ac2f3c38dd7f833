// SPDX-License-Identifier: Apache-2.0
#include "channel_core.hpp"

#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
ChannelCore::ChannelCore(std::uint16_t channel, bool virtual_time)
    : number_(channel),
      virtual_time_(virtual_time),
      machine_(channel),
      stream_(channel),
      handshake_(channel),
      table_change_(channel),
      cycle_call_(channel),
      manual_(machine_),
      program_path_(machine_),
      manual_path_(machine_),
      program_flow_(machine_),
      mdi_(machine_),
      bodies_(machine_) {
  machine_.resolve = [this](std::string_view name) {
    return (states_.is(Activity::mdi) ? mdi_.texts() : program_cache_).call(selection_.programs(), name);
  };
  mdi_.set_modal(power_on_modal());
}

language::ModalState ChannelCore::power_on_modal() const {
  auto modal = machine_.power_on();
  modal.tool = static_cast<std::uint16_t>(tool_);
  return modal;
}

void ChannelCore::set_parameters(std::shared_ptr<const machine::Parameters> parameters) {
  next_parameters_ = std::move(parameters);
  apply_parameters();
}

// A revision is used from the next start on: setpoints of one motion are all made with one revision.
void ChannelCore::apply_parameters() {
  if (!next_parameters_ || !states_.in<Idle>() || !stream_.idle() || homing_.active()) return;
  const bool first = !machine_.configured();
  try {
    machine_.configure(*next_parameters_);
    if (first) mdi_.set_modal(power_on_modal());
  } catch (const std::exception& e) {
    if (first)
      unusable_ = {&machine::alarm_of(e), e.what()};
    else
      event(machine::alarm_of(e), e.what());
    next_parameters_.reset();
    return;
  }
  unusable_.reset();
  parameters_ = std::exchange(next_parameters_, nullptr);
  for (const auto& line : machine::kinematics_warnings(*parameters_, number_))
    event(alarm::direction_not_unit, line);
  exact_stop_.configure(*parameters_, machine_.channel_axes(), machine_.columns());
  configure_guards();
  build_paths();
}

// While a handwheel offset may move, the path keeps to the share of the limits that the offset leaves.
void ChannelCore::build_paths() {
  manual_.configure();
  program_path_.build(manual_.path_limits());
  manual_path_.build(manual_.path_limits());
  manual_path_.start(machine_start_);
}

void ChannelCore::set_tools(const idl::parameters::ToolTable& tools) {
  table_change_.set_tools(tools);
  machine_.set_tools(tools);
  bodies_.tools_changed();
}
void ChannelCore::set_offsets(const idl::parameters::WorkOffsets& offsets) { machine_.set_offsets(offsets); }

void ChannelCore::set_programs(const idl::program::ProgramList& programs) {
  selection_.set_programs(programs);
  settle_cycle();
  if (states_.in<Idle>()) selection_.renew();
}

RunningProgram ChannelCore::running_program() const {
  auto left = interrupted_;
  std::uint32_t parts_since = 0;
  if (program_under_way()) {
    left = {selected().name, selected().revision, selected().crc32,
            std::max<std::uint32_t>(program_line(), 1)};
    parts_since = parts_ - parts_at_start_.value_or(parts_);
  }
  return {left, ended_, parts_, tool_, tool_since_, tap_, printer_.printed(), parts_since};
}

// What the program has read ahead counts: a variable is not restored when the motion behind it is stopped.
// MDI in a held program works on its own variables: a restart of the program must find what it started with.
void ChannelCore::keep_variables() {
  if (!states_.interpreting() || (states_.is(Activity::mdi) && states_.suspended() != nullptr)) return;
  if (!flow().started()) return;  // interrupted before this process
  *variables_ = flow().variables();
  variables_news_ = true;
}

AxisValues ChannelCore::machine_position() const {
  if (thread_.cutting()) return path().machine_of(thread_.position());
  if (!states_.is(Activity::handwheel)) return path().machine_position();
  auto position = machine_start_;
  for (std::size_t i = 0; i < position.size(); ++i) position[i] += manual_.wheel()[i];
  return position;
}

AxisValues ChannelCore::drive_position() const {
  auto position = machine_start_;
  const auto& axes = machine_.channel_axes();
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const int column = machine_.columns()[i];
    if (column >= 0 && static_cast<std::size_t>(column) < link().positions().size())
      position[axes.index[i]] = link().positions()[static_cast<std::size_t>(column)];
  }
  return position;
}

AxisValues ChannelCore::path_of_drive(const AxisValues& real) const {
  auto path = real;
  for (std::size_t i = 0; i < path.size(); ++i) path[i] -= manual_.offset()[i];
  return path;
}

// Where a new epoch begins: at the position the drive reports.
void ChannelCore::adopt_position() {
  if (!link().needs_epoch()) return;
  const auto real = drive_position();
  const auto path = path_of_drive(real);
  machine_start_ = lock_.show(path, machine_start_);
  lock_.adopt(real);
}

void ChannelCore::stop_activity() {
  // A motion that was held is at rest where its path was left, and no new epoch will report that.
  const auto* preparing = states_.preparing();
  const bool moved = preparing == nullptr || preparing->approaching;
  if (states_.busy() && stream_.idle() && !link().needs_epoch() && moved) machine_start_ = machine_position();
  skip_.end();
  read_.end();
  spindles_.end();
  program_homing_.end();
  finish_tapping();
  finish_thread();
  if (stream_.moving() || link().state() == LinkState::requested) stream_.link().leave();
  keep_variables();
  if (states_.is(Activity::program) && preparing == nullptr) states_.forget_suspended();
  states_.end();
  end_cycle();
  leave_temporary_program();
  restart_.reset();
  hold_waits_ = false;
  bodies_.forget_jog();
  manual_.end_wheel();
  handshake_.cancel();
  table_change_.cancel();
  printer_.cancel();
  apply_parameters();
}

void ChannelCore::finish(bool program_end) {
  const bool reset = states_.resetting();
  hold_waits_ = false;
  skip_.end();
  read_.end();
  spindles_.end();
  program_homing_.end();
  finish_tapping();
  finish_thread();
  machine_start_ = machine_position();
  manual_.end_wheel();
  bodies_.forget_jog();
  if (states_.is(Activity::mdi) && !reset) mdi_.end(tool_);  // a reset has its own modal state
  if (program_end && states_.is(Activity::program)) progress_.executed = {};
  keep_variables();
  if (states_.is(Activity::program)) {
    states_.forget_suspended();
    end_snapshot();
  }
  states_.end();
  end_cycle();
  leave_temporary_program();
  restart_.reset();
  if (reset) drop_offset();
  apply_parameters();
}

void ChannelCore::leave_temporary_program() {
  if (states_.in<Idle>()) selection_.leave_temporary();
}

// A program that is suspended for MDI has not ended.
void ChannelCore::end_cycle() {
  if (states_.in<Idle>()) cycle_call_.end();
}

// What a program does at rest behind its last motion is written nowhere: the drive keeps a snapshot in which
// it runs, for whoever comes after.
void ChannelCore::end_snapshot() {
  if (link().snapshot().valid) ended_ = link().snapshot().cycle;
}

std::optional<ChunkWanted> ChannelCore::wanted() const {
  if (!states_.interpreting()) return std::nullopt;
  return states_.is(Activity::mdi) ? mdi_.texts().wanted() : program_cache_.wanted();
}

void ChannelCore::deliver(const std::string& name, std::uint64_t offset, std::vector<std::uint8_t> data) {
  program_cache_.deliver(name, offset, data);
  mdi_.texts().deliver(name, offset, data);
}

void ChannelCore::chunk_failed(const std::string& name) {
  program_cache_.fail(name);
  mdi_.texts().fail(name);
}

}  // namespace trunnion::channel
