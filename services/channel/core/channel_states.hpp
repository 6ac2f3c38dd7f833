// SPDX-License-Identifier: Apache-2.0
// The states of a channel and how one follows another (docs/channel-states.md). Pure: nothing here moves an
// axis or writes a message, ChannelCore does that beside each transition.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "contracts/types.hpp"
#include "path_progress.hpp"
#include "preparation.hpp"

namespace trunnion::channel {

using idl::channel::RunState;
using program_execution::AuxiliaryMemory;

/// What a channel carries out.
enum class Activity : std::uint8_t { program, mdi, jog, handwheel };

/// One press of a jog key: the movement lasts until its renewals stop.
struct JogPress {
  std::uint32_t number = 0;
  std::uint64_t renewed = 0;  ///< tick of the drive at the start or the last renewal
};

/// The activity moves the axes or reads on.
struct Running {
  Activity activity = Activity::program;
  bool retracing = false;           ///< a program, backwards over its executed path
  bool stopping = false;            ///< a jog whose button was released: its remaining path is dropped
  bool text_missing = false;        ///< it cannot continue before a part of the program's text has arrived
  std::optional<JogPress> press{};  ///< of a jog without an increment
};

/// A program, before it may move: functions and the approach to the point at which it continues.
struct Preparing {
  Preparation preparation;
  bool approaching = false;  ///< the functions are done and the approach is planned
};

/// The two states in which the channel advances. The states below contain the one to which they return.
using Active = std::variant<Running, Preparing>;

/// Nothing is under way.
struct Idle {};
/// At rest until the PLC has finished a function, the owner of a table has changed it, or a line is printed.
struct Waiting {
  Active then;
};
/// Brakes on the path.
struct Holding {
  Active then;
  bool feed_hold = false;  ///< the setpoints brake; false: the remaining path was dropped instead
  bool reset = false;      ///< a reset follows at standstill
};
/// At rest until cycle start.
struct Held {
  Active then;
};
/// The drive has stopped by itself, was switched off or restarted.
struct Interrupted {
  Active then;
  bool feed_hold = false, reset = false;  ///< as in Holding, when it was interrupted in that
  bool drives_off = false;                ///< spindle and coolant are off: only a reset leaves this state
};
/// The held program was left for MDI and manual motion, and nothing of these is under way.
struct Suspended {};

/// A held program that was left. Its motion stays planned.
struct SuspendedProgram {
  AxisValues machine{};            ///< position at which the path was left, machine coordinates
  std::uint32_t tool = 0;          ///< in the spindle then
  PathProgress progress;           ///< of the program
  language::ModalState mdi_modal;  ///< of MDI before, which continues behind the program
  AuxiliaryMemory mdi_functions;   ///< spindle and coolant functions that MDI has commanded since
  bool drives_off = false;         ///< the drives were switched off since: only a reset ends it
};

/// The one place where the state changes. A transition from a state that its comment does not name is a
/// programming error: it throws std::bad_variant_access and changes nothing.
class ChannelStates {
 public:
  using State = std::variant<Idle, Running, Preparing, Waiting, Holding, Held, Interrupted, Suspended>;

  template <class S>
  bool in() const {
    return std::holds_alternative<S>(state_);
  }
  /// Running or preparing.
  bool advances() const { return in<Running>() || in<Preparing>(); }
  /// What is carried out, waits, brakes, is held or interrupted; nothing when idle or suspended.
  std::optional<Activity> activity() const;
  bool busy() const { return !in<Idle>() && !in<Suspended>(); }
  /// A program or an MDI line.
  bool interpreting() const { return is(Activity::program) || is(Activity::mdi); }
  bool is(Activity activity) const { return this->activity() == activity; }
  /// The running or preparing part, also while it waits, brakes, is held or interrupted; else null.
  Running* running() { return part<Running>(*this); }
  const Running* running() const { return part<const Running>(*this); }
  Preparing* preparing() { return part<Preparing>(*this); }
  const Preparing* preparing() const { return part<const Preparing>(*this); }
  bool retracing() const { return running() != nullptr && running()->retracing; }
  /// The setpoints brake for a feed hold.
  bool feed_hold() const;
  /// A reset follows when the axes are at rest.
  bool resetting() const;
  /// The remaining path was dropped: when the axes are at rest the activity is over.
  bool abandoned() const;
  /// The drives were switched off under the program: only a reset helps.
  bool needs_reset() const;
  /// A held program may be left for MDI and manual motion.
  bool may_suspend() const;
  /// The program that was left, also while MDI, manual motion or the return to it is under way; else null.
  SuspendedProgram* suspended() { return suspended_ ? &*suspended_ : nullptr; }
  const SuspendedProgram* suspended() const { return suspended_ ? &*suspended_ : nullptr; }

  RunState published() const;
  /// For documents and tests.
  std::string name() const;

  /// Idle or Suspended -> Running. A program also from Interrupted, to restart it.
  void begin(Activity activity);
  /// Idle -> Interrupted: a process before this one left a program in the middle.
  void begin_interrupted();
  /// Running program -> Preparing, or Held before it when the operator has to confirm.
  void prepare(Preparation preparation, bool confirm);
  /// Suspended -> Preparing: the return to the program.
  void begin_return(Preparation preparation);
  /// Preparing -> Running. The program is no longer suspended.
  void end_preparation();
  /// Running program or MDI, or Preparing -> Waiting.
  void wait();
  /// Waiting -> Running or Preparing, or Held. In other states nothing: it was interrupted meanwhile.
  void end_wait(bool hold);
  /// Running or Preparing -> Holding.
  void hold();
  /// Running or Preparing -> Held, at rest already.
  void pause();
  /// Holding -> Held.
  void come_to_rest();
  /// Held -> Running, forwards, or Preparing.
  void resume();
  /// Interrupted -> Running or Preparing; Holding when the remaining path was dropped before.
  void resume_interrupted();
  /// Running program or Held program -> the same backwards, Running; off: forwards, without a change of
  /// state.
  void retrace(bool on);
  /// Of a jog: its remaining path is dropped.
  void stop_jog();
  /// Running, Preparing or Holding -> Holding, and a reset when at rest.
  void reset_at_rest();
  /// From any busy state -> Interrupted.
  void interrupt(bool drives_off);
  /// From any: a preparation that was interrupted is not continued, its program is restarted.
  void drop_preparation();
  /// Held program -> Suspended.
  void suspend(SuspendedProgram program);
  /// From any -> Suspended, or Idle when no program is suspended.
  void end();
  void forget_suspended() { suspended_.reset(); }

 private:
  /// The state to which this one returns, or null.
  Active* active();
  const Active* active() const;
  Active take_active();
  static void require(bool allowed);
  template <class S, class Self>
  static S* part(Self& self) {
    if (auto* alone = std::get_if<std::remove_const_t<S>>(&self.state_)) return alone;
    auto* inner = self.active();
    return inner == nullptr ? nullptr : std::get_if<std::remove_const_t<S>>(inner);
  }
  void advance(Active active);

  State state_;
  std::optional<SuspendedProgram> suspended_;
};

}  // namespace trunnion::channel
