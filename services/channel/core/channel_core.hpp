// SPDX-License-Identifier: Apache-2.0
// One channel: modes, program flow, holds and restarts. No DDS, no clock: the service brings the messages.
// What it is doing is in ChannelStates; the parts have the data of what they do. ProgramSelection and Mdi:
// what is carried out. Interlock: what others let it do. ChannelBodies: what is in the way. ManualMotion,
// Homing and StreamWriter: motion. AuxiliaryHandshake, TableChange, LinePrinter and CycleCall: what is asked
// of others.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "auxiliary_handshake.hpp"
#include "axis_lock.hpp"
#include "bus/json_type.hpp"
#include "channel_bodies.hpp"
#include "channel_path.hpp"
#include "channel_setup/channel_setup.hpp"
#include "channel_snapshot.hpp"
#include "channel_states.hpp"
#include "contracts/types.hpp"
#include "cycle_call.hpp"
#include "exact_stop_check.hpp"
#include "hand_over.hpp"
#include "homing.hpp"
#include "interlock.hpp"
#include "line_printer.hpp"
#include "machine/alarm_definition.hpp"
#include "manual_motion.hpp"
#include "mdi.hpp"
#include "program_cache.hpp"
#include "program_execution/program_flow.hpp"
#include "program_execution/tap_in_hole.hpp"
#include "program_execution/tapping.hpp"
#include "program_homing.hpp"
#include "program_record.hpp"
#include "program_selection.hpp"
#include "skip_move.hpp"
#include "spindle_read.hpp"
#include "spindle_watch.hpp"
#include "stream_writer.hpp"
#include "switches.hpp"
#include "table_change.hpp"
#include "thread_run.hpp"

namespace trunnion::channel {

using idl::channel::Mode;
using program_execution::Entry;
using program_execution::FlowState;
using program_execution::RestartPoint;
using program_execution::Tapping;

/// Something to raise as an alarm, as Refusal.
struct ChannelEvent {
  const machine::AlarmDefinition* alarm;
  std::string text;
};

class ChannelCore {
 public:
  ChannelCore(std::uint16_t channel, bool virtual_time);

  // What the service brings.
  void set_parameters(std::shared_ptr<const machine::Parameters> parameters);
  void set_tools(const idl::parameters::ToolTable& tools);
  void set_offsets(const idl::parameters::WorkOffsets& offsets);
  /// For the process that takes this one's place; nothing while the channel moves.
  std::optional<HandOver> hand_over() const;
  /// From the process before. Call it before recover(), once the programs are known.
  void take_over(const HandOver& hand_over);
  /// Everything that determines what follows besides the tables and programs; `why_not` is set, and nothing
  /// given, unless the channel is at rest with nothing under way. Call it when everything has been taken
  /// away.
  bus::Json explicit_state(std::string& why_not) const;
  /// In place of recover(), once tables and programs are known. Throws nlohmann::json::exception when `state`
  /// is of another shape.
  void continue_from(const bus::Json& state);
  /// The kept variables of the last time.
  void set_variables(const language::VariableStore& variables) { *variables_ = variables; }
  /// The program under way when the control was switched off, from whose line it may be continued, and what
  /// else was kept.
  void set_interrupted(const RunningProgram& program) {
    interrupted_ = program, ended_ = program.ended, parts_ = program.parts;
    tool_ = program.tool, tool_since_ = program.tool_since;
    tap_ = program.tap;
    printer_.set_printed(program.printed);
    parts_at_start_ = program.parts - program.parts_since;
  }
  /// Machined since the count was set.
  std::uint32_t parts() const { return parts_; }
  /// In the spindle.
  std::uint32_t tool() const { return tool_; }
  /// The newest line that a program has printed.
  const PrintedLine& printed() const { return printer_.printed(); }
  /// The tap that is in its hole, or was left there.
  const program_execution::TapInHole& tap() const { return tap_; }
  /// `collision: warn` or `stop` of machine.yaml; without it nothing is checked.
  void guard(machine::CollisionMode mode, const collision_guard::BodiesText& bodies);
  void set_programs(const idl::program::ProgramList& programs);
  void on_feedback(const idl::stream::Feedback& feedback);
  /// A process that has just started may find that one before it died in the middle of a program. Call it
  /// once the feedback that has arrived is the newest: the first is the drive's history.
  void recover();
  bool recovered() const { return recovered_; }
  void on_auxiliary_done(const idl::plc::AuxiliaryDone& done);
  /// The answer to an AuxiliaryRequest that reads a signal.
  void on_macro_signal(const idl::plc::MacroSignal& signal);
  /// The answer to the request of take_table_request(); `reason` is empty when the table was changed.
  void on_table_changed(const std::string& reason);
  /// The answer to the request of take_print_request().
  void on_printed(const idl::program::ProgramReply& reply);
  /// A service of the machine carries out the cycles of programs.
  void set_cycle_service(bool present) { cycle_service_ = present; }
  /// The answer to the request of take_cycle_request().
  void on_cycle_reply(const CycleReply& reply);
  /// Whether the service has not said that it has received the call for which the program waits.
  bool cycle_unheard() const { return cycle_call_.unheard(); }
  /// It is given up: the program ends with an alarm.
  void give_up_cycle();
  /// Alarms that stop motion, or the PLC's feed hold: `why` is empty when there is none.
  void set_hold(const std::string& why);
  /// The drive has stopped all axes on the path because setpoints were missing: nothing starts but what that
  /// has interrupted. `why` is empty when it has not.
  void set_drive_stopped(const std::string& why);
  /// What the PLC decides of this channel; its overrides stay when it sets them no longer.
  void set_control(const idl::plc::ChannelControl& control);
  const idl::plc::ChannelControl& control() const { return interlock_.control(); }
  /// Logical numbers of the axes whose position is not known: a reference return gives them their reference.
  void set_unreferenced(std::set<std::uint16_t> axes);
  void set_ready(bool ready) { interlock_.set_ready(ready); }
  /// As StreamWriter::set_replicas().
  void set_replicas(bool may_start, std::uint64_t floor) { stream_.set_replicas(may_start, floor); }
  /// As StreamWriter::set_limit().
  void set_limit(std::uint64_t limit) { stream_.set_limit(limit); }
  Answer handle(const idl::channel::ChannelRequest& request);
  std::optional<ChunkWanted> wanted() const;
  void deliver(const std::string& name, std::uint64_t offset, std::vector<std::uint8_t> data);
  void chunk_failed(const std::string& name);

  // What the service takes away. Call advance() first; produce() until it returns false.
  void advance();
  bool produce(idl::stream::PathBatch& out);
  /// Many lines have brought no motion.
  bool loops() const;
  /// Some thousand lines more, once the axes are at rest. False when there is nothing to do.
  bool read_on();
  std::optional<idl::stream::StreamRequest> take_stream_request() { return stream_.link().take_request(); }
  std::optional<idl::channel::AuxiliaryRequest> take_auxiliary() { return handshake_.take_request(); }
  std::optional<idl::parameters::ParameterRequest> take_table_request() {
    return table_change_.take_request();
  }
  std::optional<CycleRequest> take_cycle_request() { return cycle_call_.take_request(); }
  std::optional<idl::program::ProgramRequest> take_print_request() { return printer_.take_request(); }
  /// The variables, when a program or an MDI line has ended since the last time.
  const language::VariableStore* take_variables() {
    return std::exchange(variables_news_, false) ? variables_.get() : nullptr;
  }
  /// Why it is not configured: the newest parameters cannot be used, and there were no others before.
  const std::optional<ChannelEvent>& unusable() const { return unusable_; }
  std::vector<ChannelEvent> take_events() { return std::exchange(events_, {}); }
  const idl::channel::ChannelState& state();
  RunningProgram running_program() const;
  bool program_under_way() const {
    return !lock_.any() && (states_.is(Activity::program) || states_.suspended() != nullptr);
  }
  /// A program is held where a search has ended, and alarm 171 announces what cycle start does.
  bool held_at_line() const { return states_.in<Held>() && states_.preparing() != nullptr && !restart_; }
  /// Motion, or the search for a line, cannot continue before a part of the program's text has arrived.
  bool waits_for_text() const { return states_.in<Running>() && states_.running()->text_missing; }

  const ChannelStates& states() const { return states_; }
  RunState run_state() const;
  const channel_setup::ChannelSetup& machine() const { return machine_; }
  const StreamLink& link() const { return stream_.link(); }
  bool configured() const { return parameters_ != nullptr; }

  /// The state of a channel that is idle; everything else is empty then, or made when something starts.
  // No fields, explicit_state() writes what counts of them: stream_, manual_, program_flow_, variables_. No
  // fields, the constructor sets them or they are received again: number_, virtual_time_, machine_,
  // parameters_, next_parameters_, cycle_service_. No field, nothing is under way and the state of the
  // service has the axes: homing_. No fields, nothing is under way: states_, table_change_,
  // parts_at_start_, hold_waits_, skip_, read_, exact_stop_, tapping_, thread_, program_homing_,
  // homed_at_start_, restart_, recovered_, variables_news_, events_. No field, feedback tells it: spindles_.
  // No fields, they are made again: program_path_, manual_path_, program_cache_, bodies_, unusable_, state_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("link", self.stream_.link()), visit("handshake", self.handshake_),
        visit("cycle_call", self.cycle_call_), visit("lock", self.lock_);
    visit("mode", self.mode_), visit("switches", self.switches_);
    Interlock::fields(self.interlock_, visit);
    visit("reset_count", self.reset_count_);
    ProgramSelection::fields(self.selection_, visit);
    visit("program_start", self.program_start_), visit("interrupted", self.interrupted_);
    Mdi::fields(self.mdi_, visit);
    visit("position", self.machine_start_), visit("progress", self.progress_);
    visit("tool", self.tool_), visit("spindle_programmed", self.spindle_programmed_);
    visit("ended", self.ended_), visit("parts", self.parts_);
    // Written where there is something: older recordings have no such state.
    constexpr bool reads = !std::is_const_v<Self>;
    if (reads || self.tool_since_ != 0) visit("tool_since", self.tool_since_);
    if (reads || self.tap_.lead != 0) visit("tap", self.tap_);
    if (reads || self.synchronized_ != 0) visit("synchronized", self.synchronized_);
    if (reads || self.printer_.has_printed()) visit("printer", self.printer_);
  }

 private:
  // channel_commands.cpp: what an operator may ask, and when.
  Answer refuse(const machine::AlarmDefinition& alarm, std::string reason) const;
  Answer refuse(Refusal refusal) const { return refuse(*refusal.alarm, std::move(refusal.reason)); }
  Answer operable() const;
  Answer startable() const;
  std::string names_without_reference() const;
  Answer set_override(double& override_, double fraction);
  Answer set_mode(Mode mode);
  Answer select(const std::string& name);
  Answer cycle_start();
  Answer state_tool(std::uint32_t tool);
  void put_into_spindle(std::uint32_t tool);
  Answer continue_after_interruption();
  Answer reference(std::uint8_t index);
  Answer begin_homing(std::uint16_t axis);
  void advance_homing() { homing_.advance(stream_.link(), switches_.feed_override > 0); }
  void end_homing() { homing_.end(stream_.link(), switches_.feed_override > 0); }
  Answer jog(const idl::channel::ChannelRequest& request);
  Answer renew_jog(std::uint32_t press);
  void stop_jog_without_renewal();
  void stop_jog();
  void reset();

  // channel_switches.cpp: dry run, locks, block skip, handwheel, retrace.
  Answer set_switch(const idl::channel::ChannelRequest& request);
  Answer lock_axes(std::uint16_t mask);
  Answer set_block_skip(std::uint16_t mask);
  Answer set_handwheel_offset(bool on);
  Answer turn_handwheel(const idl::channel::ChannelRequest& request);
  Answer retrace(bool on);
  void drop_offset();

  // channel_starts.cpp: how programs, lines and moves start.
  Answer start_program(const Entry& entry);
  Answer start_from_line(std::uint32_t line);
  Answer start_mdi(const idl::channel::ChannelRequest& request);
  Answer start_move(const AxisMove& move);
  void begin_manual(Activity activity);
  void configure_flow(ProgramFlow& flow);

  // channel_preparation.cpp: what happens before a program moves, and the return to one that was left.
  void prepare_entry();
  bool search_from_other_turns(const AxisValues& target);
  bool run_preparation();
  void end_preparation();
  void suspend();
  Answer continue_after_suspension();

  // channel_recovery.cpp: what the drive stopped, lost or kept.
  void interrupt(const std::string& why);
  void offer_interrupted();
  std::string with_tap(const std::string& what) const;

  // channel_core.cpp
  void stop_activity();
  void end_snapshot();
  void leave_temporary_program();
  void end_cycle();
  void finish(bool program_end);
  void keep_variables();
  void apply_parameters();
  void build_paths();
  void adopt_position();

  // channel_guard.cpp: bodies of the machine.
  void configure_guards();
  void hold_guarded_axes() { bodies_.hold_axes(lock_.mask(), lock_.hold({})); }
  void report_guard();
  void report_jog_obstacle();
  std::string approach_obstacle(const std::vector<language::Command>& moves);
  std::optional<Refusal> guard_jog(AxisMove& move);
  std::optional<Refusal> guard_reference(const AxisMove& move);
  double guard_handwheel(std::uint8_t axis, double distance);
  language::ModalState by_hand_modal() const;

  // channel_requests.cpp: what a program asks of the rest of the control.
  void run_pending(FlowState state);
  void execute(const language::Command& command);
  /// "part.nc:12", of a called program "part.nc:O0020:3": where a command is.
  std::string place_of(const language::Command& command) const;
  std::string message_of(const language::Command& command) const;
  std::uint8_t role() const;
  void change_table(const language::Command& command);
  void begin_print(const language::Command& command);
  void count_part();
  void begin_auxiliary(program_execution::AuxiliaryFunction function);

  void begin_cycle(const language::Command& command);
  void settle_cycle();
  void refuse_cycle(const std::string& reason);

  // channel_cycles.cpp: moves that a skip input ends, and those a spindle follows.
  void begin_skip();
  void finish_skip();
  void begin_read(const language::Command& command);
  bool finish_read();
  void begin_tapping();
  bool may_couple(const channel_setup::TappingSpindle& spindle, const language::Command& stroke,
                  std::size_t column);
  std::size_t column_of(const channel_setup::TappingSpindle& spindle) const;
  void finish_tapping();
  double tapping_override() const;
  std::string tap_words(const AxisValues& position) const;
  Answer refuse_with_tap(const std::string& words) const;
  void forget_removed_tap();
  void begin_thread();
  void cut_thread();
  StreamCycle step_thread(std::uint64_t cycle);
  void finish_thread();

  // channel_homing.cpp: axes that a program homes.
  void begin_program_homing(const language::Command& command);
  void home_next();
  void advance_program_homing();
  bool has_home_switch(std::uint16_t axis) const;
  /// Logical numbers of the slaves that move with the axis.
  std::vector<std::uint16_t> coupled_slaves(std::uint16_t axis) const;
  void note_found(std::uint16_t axis);
  void end_program_homing();
  void tell_references();
  std::uint16_t homed_axes() const;

  // channel_stream.cpp: setpoints.
  void hold();
  void hold_for_operator();
  void hold_when_permitted();
  bool suppresses(std::uint8_t what) const;
  double feed_override() const;
  FlowState fill();
  bool motion_at_rest() const;
  void check_exact_stop(std::uint64_t cycle);
  StreamCycle step_cycle(std::uint64_t cycle);
  void add_offset(StreamCycle& out, const AxisValues& machine);
  bool in_machine_coordinates() const { return lock_.any() || manual_.offset_on(); }
  void remember_executed();
  void store_state(FlowState state, idl::stream::ChannelSnapshot& out) const;

  // channel_state.cpp: what the operator sees.
  void follow_cut();
  std::uint32_t executed_sequence() const;
  std::uint32_t program_line() const;
  const language::ModalState& executed_modal() const;
  language::ProgramFrame executed_frame(const language::ModalState& modal) const;
  void show_positions();
  std::string detail() const;

  ProgramFlow& flow() { return states_.is(Activity::mdi) ? mdi_.flow() : program_flow_; }
  const ProgramFlow& flow() const { return states_.is(Activity::mdi) ? mdi_.flow() : program_flow_; }
  ChannelPath& path() { return on_program_path() ? program_path_ : manual_path_; }
  const ChannelPath& path() const { return on_program_path() ? program_path_ : manual_path_; }
  bool on_program_path() const {
    const auto* preparing = states_.preparing();
    return states_.is(Activity::program) && (preparing == nullptr || !preparing->approaching);
  }
  bool uses_feedback() const;
  bool braking() const { return states_.feed_hold() && !tapping_.active() && !thread_.cutting(); }
  /// The PLC has stopped spindle and axis of a tap.
  bool tap_stopped() const { return tapping_.active() && control().tap_stop; }
  language::ModalState power_on_modal() const;
  AxisValues machine_position() const;
  AxisValues drive_position() const;
  AxisValues path_of_drive(const AxisValues& real) const;
  std::string program_name() const { return states_.is(Activity::program) ? selected().name : "MDI"; }
  const idl::program::ProgramEntry& selected() const { return selection_.selected(); }
  void event(const machine::AlarmDefinition& alarm, std::string text) {
    events_.push_back({&alarm, std::move(text)});
  }

  const std::uint16_t number_;
  const bool virtual_time_;
  channel_setup::ChannelSetup machine_;
  std::shared_ptr<const machine::Parameters> parameters_, next_parameters_;

  ChannelStates states_;
  StreamWriter stream_;
  AuxiliaryHandshake handshake_;
  TableChange table_change_;
  LinePrinter printer_;
  CycleCall cycle_call_;
  bool cycle_service_ = false;
  ManualMotion manual_;
  Homing homing_;
  ProgramHoming program_homing_;
  // The program's motion stays planned while the axes are moved by MDI, by hand or to the program's start.
  ChannelPath program_path_, manual_path_;
  ProgramFlow program_flow_;
  Mdi mdi_;
  ProgramCache program_cache_;
  ChannelBodies bodies_;
  SkipMove skip_;
  SpindleRead read_;
  std::uint32_t synchronized_ = 0;  // spindles of the newest feedback, as synchronized_spindles()
  SpindleWatch spindles_;
  ExactStopCheck exact_stop_;
  Tapping tapping_;
  ThreadRun thread_;
  AxisLock lock_;

  Mode mode_ = Mode::JOG;
  Switches switches_;
  Interlock interlock_;
  bool recovered_ = false;
  std::uint32_t reset_count_ = 0;

  ProgramSelection selection_;
  std::optional<RestartPoint> restart_;  // of the program, until it is reached
  AxisValues program_start_{};           // machine coordinates
  std::uint64_t ended_ = 0;              // newest cycle of the drive's snapshot when a program ended
  std::uint32_t parts_ = 0;
  std::optional<std::uint32_t> parts_at_start_;  // as they were when the program started
  bool hold_waits_ = false;                      // a feed hold, until the program permits it (#3004)
  LeftProgram interrupted_;     // by an emergency stop or the end of the control: its line is offered
  AxisValues machine_start_{};  // of the path at rest, in machine coordinates
  PathProgress progress_;
  std::uint32_t tool_ = 0;        // in the spindle
  std::uint64_t tool_since_ = 0;  // cycle from which on the drive's snapshot knows of it
  program_execution::TapInHole tap_;
  double spindle_programmed_ = 0;
  // As they were when the program started; nothing in a process that has not started it.
  std::optional<std::uint16_t> homed_at_start_;
  // As they were when the program started: a restart interprets it again with the same.
  std::unique_ptr<language::VariableStore> variables_ = std::make_unique<language::VariableStore>();
  bool variables_news_ = false;

  std::vector<ChannelEvent> events_;
  std::optional<ChannelEvent> unusable_;
  idl::channel::ChannelState state_;
};

}  // namespace trunnion::channel
