// One channel: modes, program flow, holds and restarts. No DDS, no clock: the service brings the messages.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contracts/types.hpp"
#include "program_flow.hpp"
#include "program_text.hpp"
#include "setup/channel_setup.hpp"
#include "stream_link.hpp"

namespace trunnion::channel {

using idl::channel::Mode;
using idl::channel::RunState;

struct Answer {
  bool accepted = true;
  std::uint32_t alarm = 0;
  std::string reason;
};

/// Something to raise as an alarm: a name of alarms.yaml, or a number of the NC language.
struct ChannelEvent {
  std::string alarm;
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
  /// The kept variables of the last time.
  void set_variables(const language::VariableStore& variables) { *variables_ = variables; }
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

  RunState run_state() const { return run_; }
  const setup::ChannelSetup& machine() const { return machine_; }
  const StreamLink& link() const { return link_; }
  bool configured() const { return trajectory_owner_ != nullptr; }

 private:
  enum class Activity { none, program, mdi, jog };

  Answer refuse(const char* alarm, std::string reason) const;
  Answer startable() const;
  Answer select(const std::string& name);
  Answer cycle_start();
  Answer start_program(const RestartPoint& restart);
  Answer start_mdi(const std::string& line);
  Answer start_move(std::uint8_t axis, double target, double feed);
  Answer jog(const idl::channel::ChannelRequest& request);
  void reset();
  void hold();
  void stop_activity();
  void finish(bool program_end);
  void keep_variables();
  void interrupt(const std::string& why);
  void apply_parameters();
  void adopt_position();
  void run_pending(FlowState flow);
  void begin_skip();
  void finish_skip();
  void begin_tapping();
  void finish_tapping();
  bool holding() const { return hold_ && !tapping_.active(); }
  void begin_auxiliary(std::uint8_t kind, std::uint32_t code, double value);
  FlowState fill();
  bool copies_follow(std::uint32_t count);
  void remember_executed();
  std::vector<double> stage_state(FlowState flow);
  language::ModalState power_on_modal() const;
  AxisValues machine_position() const;
  AxisValues frame_position(const language::ModalState& modal) const;
  void event(std::string alarm, std::string text) {
    events_.push_back({std::move(alarm), 0, std::move(text)});
  }

  std::uint16_t number_;
  bool virtual_time_;
  setup::ChannelSetup machine_;
  StreamLink link_;
  std::unique_ptr<motion::Trajectory> trajectory_owner_;
  motion::Trajectory* trajectory_ = nullptr;
  ProgramFlow flow_;
  std::shared_ptr<const machine::Parameters> parameters_, next_parameters_;
  idl::program::ProgramList programs_;

  Mode mode_ = Mode::JOG;
  RunState run_ = RunState::IDLE;
  Activity activity_ = Activity::none;
  bool ready_ = false, recovered_ = false, hold_ = false, aborting_ = false,
       must_reset_ =
           false;  // the drives were off: spindle and coolant are, so the program must not just go on
  bool may_start_ = true;
  std::uint64_t floor_ = ~0ull, motion_start_ = 0;
  std::string external_hold_;
  int standing_ = 0;
  AxisValues last_position_{};
  bool single_block_ = false, optional_stop_ = false;
  double feed_override_ = 1, rapid_override_ = 1, spindle_override_ = 1;

  idl::program::ProgramEntry selected_;
  std::unique_ptr<ProgramText> text_;
  std::vector<std::unique_ptr<ProgramText>> subprograms_;
  std::string mdi_line_;
  std::optional<language::StringSource> mdi_source_;
  language::ModalState modal_;                                       // of MDI, kept from line to line
  language::Transformation frame_ = language::Transformation::none;  // of the trajectory
  double frame_tool_length_ = 0;
  AxisValues machine_start_{};  // machine coordinates at rest
  AxisValues program_start_{};
  std::optional<RestartPoint> restart_;
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
  Tapping tapping_;
  std::uint32_t tool_ = 0;
  double spindle_programmed_ = 0;
  std::uint32_t reset_count_ = 0;

  // What was written, until it is executed and can be shown; and the path points a restart would need.
  struct Written {
    std::uint64_t cycle = ~0ull;
    std::uint32_t line = 0;
    double feed = 0;
    AxisValues distance_to_go{};
    AxisValues position{};
  };
  static constexpr std::size_t history = 2048;
  std::vector<Written> written_;
  struct PathPoint {
    std::uint32_t sequence = 0, line = 0;
    double fraction = 0;
  };
  PathPoint point_;  // that the newest setpoint has reached
  Written shown_;
  std::vector<ChannelEvent> events_;
  idl::channel::ChannelState state_;
};

}  // namespace trunnion::channel
