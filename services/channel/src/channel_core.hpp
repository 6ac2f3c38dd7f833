// One channel: modes, program flow, holds and restarts. No DDS, no clock: the service brings the messages.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "axis_lock.hpp"
#include "channel_setup/channel_setup.hpp"
#include "channel_snapshot.hpp"
#include "contracts/types.hpp"
#include "exact_stop_check.hpp"
#include "hand_over.hpp"
#include "handwheel.hpp"
#include "machine/alarm_definition.hpp"
#include "preparation.hpp"
#include "program_execution/program_flow.hpp"
#include "program_execution/tapping.hpp"
#include "program_record.hpp"
#include "program_shelf.hpp"
#include "skip_move.hpp"
#include "stream_link.hpp"

namespace trunnion::channel {

using idl::channel::Mode;
using idl::channel::RunState;
using program_execution::AuxiliaryMemory;
using program_execution::Entry;
using program_execution::FlowState;
using program_execution::ProgramFlow;
using program_execution::RestartPoint;
using program_execution::Tapping;

struct Answer {
  bool accepted = true;
  std::uint32_t alarm = 0;
  std::string reason;
};

/// Something to raise as an alarm: one of alarms.yaml, or a number of the NC language.
struct ChannelEvent {
  const machine::AlarmDefinition* alarm = nullptr;  ///< null: `number` is one of the NC language
  std::uint32_t number = 0;
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
  /// The kept variables of the last time.
  void set_variables(const language::VariableStore& variables) { *variables_ = variables; }
  /// The program under way when the control was switched off: its line is offered to start from.
  void set_interrupted(const RunningProgram& program) { interrupted_ = program; }
  void set_programs(const idl::program::ProgramList& programs);
  void on_feedback(const idl::stream::FeedbackFrame& feedback);
  /// A process that has just begun may find that one before it died in the middle of a program. Call it once
  /// the feedback that has arrived is the newest: the first is the drive's history.
  void recover();
  bool recovered() const { return recovered_; }
  void on_auxiliary_done(const idl::plc::AuxiliaryDone& done);
  /// The answer to the request of take_table_order(); `reason` is empty when the table was changed.
  void on_table_changed(const std::string& reason);
  /// Alarms that stop motion, or the PLC's feed hold: `why` is empty when there is none.
  void set_hold(const std::string& why);
  void set_ready(bool ready) { ready_ = ready; }
  /// A motion may start: the copies of every stage are in step. `floor` is the cycle the slowest of them
  /// computes next; nothing is written farther than two leads beyond it.
  void set_copies(bool may_start, std::uint64_t floor) { may_start_ = may_start, floor_ = floor; }
  Answer handle(const idl::channel::ChannelRequest& request);
  std::optional<ChunkWanted> wanted() const;
  void deliver(const std::string& name, std::uint64_t offset, std::vector<std::uint8_t> data);
  void chunk_failed(const std::string& name);

  // What the service takes away. Call advance() first; produce() until it says false.
  void advance();
  bool produce(idl::stream::PathFrame& frame);
  std::optional<idl::stream::StreamRequest> take_stream_request() { return link_.take_request(); }
  std::optional<idl::channel::AuxiliaryRequest> take_auxiliary();
  std::optional<idl::parameters::ParameterRequest> take_table_order() {
    return std::exchange(table_order_, std::nullopt);
  }
  /// The variables, when a program or an MDI line has ended since the last time.
  const language::VariableStore* take_variables() {
    return std::exchange(variables_news_, false) ? variables_.get() : nullptr;
  }
  std::vector<ChannelEvent> take_events() { return std::exchange(events_, {}); }
  const idl::channel::ChannelState& state();
  RunningProgram running_program() const;
  bool program_under_way() const {
    return !lock_.any() && (activity_ == Activity::program || suspended_.has_value());
  }
  /// Motion, or the search for a line, cannot go on before a part of the program's text has arrived.
  bool waits_for_text() const { return run_ == RunState::RUNNING && text_missing_; }

  RunState run_state() const { return run_; }
  const channel_setup::ChannelSetup& machine() const { return machine_; }
  const StreamLink& link() const { return link_; }
  bool configured() const { return program_owner_ != nullptr; }

 private:
  enum class Activity { none, program, mdi, jog, handwheel };

  // What was written, until it is executed and can be shown; and the path points a restart would need.
  struct Written {
    std::uint64_t cycle = ~0ull;
    std::uint32_t line = 0;
    double feed = 0;
    AxisValues distance_to_go{};
    AxisValues position{};  // of the path, in its frame
    AxisValues machine{};   // the same in machine coordinates, when an axis is locked
    bool rapid = false;
    std::uint32_t sequence = 0;
  };
  struct PathPoint {
    std::uint32_t sequence = 0, line = 0;
    double fraction = 0;
  };
  /// A program that is held while the axes are moved by hand or MDI. Its motion stays planned.
  struct Suspended {
    language::Transformation frame = language::Transformation::none;
    double tool_length = 0;
    AxisValues machine{};  // where the path was left
    std::uint32_t tool = 0;
    PathPoint point;
    Written shown;
    language::ModalState mdi_modal;  // of MDI before
    AuxiliaryMemory by_hand;         // what MDI has asked of spindle and coolant since
  };

  // channel_commands.cpp: what an operator may ask, and when.
  Answer refuse(const machine::AlarmDefinition& alarm, std::string reason) const;
  Answer startable() const;
  Answer set_mode(Mode mode);
  Answer select(const std::string& name);
  Answer cycle_start();
  Answer go_on_after_interruption();
  Answer reference(std::uint8_t index);
  Answer jog(const idl::channel::ChannelRequest& request);
  void stop_jog();
  void reset();

  // channel_switches.cpp: dry run, locks, block skip, handwheel.
  Answer set_switch(const idl::channel::ChannelRequest& request);
  Answer lock_axes(std::uint16_t mask);
  Answer set_block_skip(std::uint16_t mask);
  Answer set_handwheel_offset(bool on);
  Answer turn_handwheel(const idl::channel::ChannelRequest& request);
  Answer retrace(bool on);
  void drop_offset();

  // channel_starts.cpp: how programs, lines and moves begin, stop for a while and go on.
  Answer start_program(const Entry& entry);
  Answer start_from_line(std::uint32_t line);
  Answer start_mdi(const std::string& line);
  Answer start_move(std::uint8_t axis, double target, double feed);
  void begin_manual(Activity activity);
  void prepare_entry();
  bool run_preparation();
  void suspend();
  Answer go_on_after_suspension();

  // channel_core.cpp
  void stop_activity();
  void finish(bool program_end);
  void keep_variables();
  void interrupt(const std::string& why);
  void offer_interrupted();
  void apply_parameters();
  void build_trajectories();
  void adopt_position();

  // channel_orders.cpp: what a program asks of the rest of the control.
  void run_pending(FlowState state);
  void begin_auxiliary(const program_execution::AuxiliaryFunction& function);

  // channel_cycles.cpp: moves that a skip input ends, and those a spindle follows.
  void begin_skip();
  void finish_skip();
  void begin_tapping();
  void finish_tapping();
  bool holding() const { return hold_ && !tapping_.active(); }

  // channel_stream.cpp: setpoints.
  void hold();
  FlowState fill();
  void start_stream();
  void step_cycle(idl::stream::PathFrame& frame);
  bool copies_follow(std::uint32_t count);
  AxisValues machine_of(const AxisValues& path) const;
  bool in_machine_coordinates() const { return lock_.any() || offset_on_; }
  void remember_executed();
  void store_state(FlowState state, idl::stream::ChannelSnapshot& out) const;

  ProgramFlow& flow() { return activity_ == Activity::mdi ? mdi_flow_ : program_flow_; }
  const ProgramFlow& flow() const { return activity_ == Activity::mdi ? mdi_flow_ : program_flow_; }
  bool interpreting() const { return activity_ == Activity::program || activity_ == Activity::mdi; }
  language::ModalState power_on_modal() const;
  AxisValues machine_position() const;
  AxisValues frame_position(const language::ModalState& modal) const;
  AxisValues drive_position() const;
  language::ProgramFrame executed_frame(const language::ModalState& modal) const;
  void forget_sequences();
  void show_positions();
  std::string detail() const;
  std::string program_name() const { return activity_ == Activity::program ? selected_.name : "MDI"; }
  void event(const machine::AlarmDefinition& alarm, std::string text) {
    events_.push_back({&alarm, 0, std::move(text)});
  }

  std::uint16_t number_;
  bool virtual_time_;
  channel_setup::ChannelSetup machine_;
  StreamLink link_;
  // The program's motion stays planned while the axes are moved by MDI, by hand or to the program's start.
  std::unique_ptr<motion::Trajectory> program_owner_, manual_owner_;
  motion::Trajectory* program_trajectory_ = nullptr;
  motion::Trajectory* manual_trajectory_ = nullptr;
  motion::Trajectory* trajectory_ = nullptr;  // one of the two
  motion::Limits path_limits_;                // what a handwheel offset leaves of the axes' limits
  ProgramFlow program_flow_, mdi_flow_;
  ProgramShelf program_shelf_, mdi_shelf_;
  std::shared_ptr<const machine::Parameters> parameters_, next_parameters_;
  idl::program::ProgramList programs_;

  Mode mode_ = Mode::JOG;
  RunState run_ = RunState::IDLE;
  Activity activity_ = Activity::none;
  bool ready_ = false, recovered_ = false, hold_ = false, aborting_ = false, text_missing_ = false,
       must_reset_ =
           false;  // the drives were off: spindle and coolant are, so the program must not just go on
  bool may_start_ = true;
  std::uint64_t floor_ = ~0ull, motion_start_ = 0;
  std::string external_hold_;
  int standing_ = 0;
  AxisValues last_position_{};
  bool single_block_ = false, optional_stop_ = false, dry_run_ = false, auxiliary_lock_ = false;
  language::SkipLevels block_skip_ = 0;
  double feed_override_ = 1, rapid_override_ = 1, spindle_override_ = 1;

  idl::program::ProgramEntry selected_;
  std::string mdi_line_;
  std::optional<language::StringSource> mdi_source_;
  language::ModalState modal_;  // of MDI, kept from line to line
  bool frames_kept_ = false;    // the interpreter still has those of the MDI line before
  language::Transformation frame_ = language::Transformation::none;  // of the trajectory
  double frame_tool_length_ = 0;
  AxisValues machine_start_{};  // of the path at rest, in machine coordinates
  AxisValues program_start_{};
  std::optional<RestartPoint> restart_;
  std::optional<Preparation> preparation_;
  bool preparing_motion_ = false;
  std::optional<Suspended> suspended_;
  RunningProgram interrupted_;  // before this process began, by the end of the control
  AxisLock lock_;
  bool offset_on_ = false;
  Handwheel offset_;  // added to the path
  Handwheel wheel_;   // in place of a path
  bool retracing_ = false;
  bool reset_due_ = false;  // when the motion has stopped
  bool auxiliary_open_ = false;
  std::uint32_t auxiliary_number_ = 0;
  idl::channel::AuxiliaryRequest auxiliary_;
  idl::parameters::ToolTable tool_table_;
  std::optional<idl::parameters::ParameterRequest> table_order_;
  bool table_open_ = false;  // the owner of the tables has not answered yet
  // As they were when the program began: a restart interprets it again with the same.
  std::unique_ptr<language::VariableStore> variables_ = std::make_unique<language::VariableStore>();
  bool variables_news_ = false;
  std::optional<idl::channel::AuxiliaryRequest> outgoing_auxiliary_;
  SkipMove skip_;
  ExactStopCheck exact_stop_;
  Tapping tapping_;
  std::uint32_t tool_ = 0;
  double spindle_programmed_ = 0;
  std::uint32_t reset_count_ = 0;

  static constexpr std::size_t history = 2048;
  std::vector<Written> written_;
  PathPoint point_;  // that the newest setpoint has reached
  Written shown_;
  std::uint32_t reached_ = 0;  // command that is carried out with the axes at rest
  std::vector<ChannelEvent> events_;
  idl::channel::ChannelState state_;
};

}  // namespace trunnion::channel
