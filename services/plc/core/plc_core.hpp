// SPDX-License-Identifier: Apache-2.0
// The PLC: inputs into the image, tasks by the drive's ticks, outputs and finished auxiliary functions from
// it.
#pragma once

#include <bitset>
#include <optional>
#include <vector>

#include "address.hpp"
#include "contracts/types.hpp"
#include "machine/parameters.hpp"
#include "panel_orders.hpp"
#include "programs.hpp"
#include "scan_trace.hpp"
#include "task_times.hpp"

namespace trunnion::plc {

inline constexpr std::uint64_t main_period = 10;  ///< ms of the main task; the fast task runs every ms
inline constexpr std::uint64_t most_catch_up =
    200;                                      ///< scans at once; older ones are skipped, timers stay correct
inline constexpr int most_settling = 16;      ///< scans at the same time until the image is stable
inline constexpr std::size_t gear_count = 5;  ///< of a spindle, M41 .. M45

/// Of m_angle and spindle_orient_angle: none.
inline constexpr std::int32_t no_angle = 65535;
/// Whole hundredths of a degree, 0 .. 35999.
std::int32_t hundredths(double degrees);

/// An order for a spindle as the registers e_order, e_spindle and e_value have it.
struct SpindleOrder {
  std::int32_t order = 0;  ///< 0: none that is known
  std::int32_t spindle = 0;
  std::int32_t value = 0;
};
/// Of `code` and `value` of an AuxiliaryRequest.
SpindleOrder spindle_order(std::uint32_t code, double value);

inline constexpr std::size_t message_words = st::most_messages / 16;

class PlcCore {
 public:
  PlcCore();

  /// Axes, spindles and the interpolation period. May be called again with another revision.
  void configure(const machine::Parameters& parameters, bool virtual_time);
  bool configured() const { return period_us_ > 0; }
  /// No programs: the outputs are safe (emergency stop).
  void load(StructuredText structured);
  void load(Programs programs);
  /// Between two scans: `next` runs from now on, with the values of the variables that `change` moves, with
  /// all registers, and with the forces whose variable is kept. Afterwards `next` has what ran before. A
  /// fault is forgotten.
  void take_over(Programs& next, const st::Changeover& change);
  /// Of the axes of configure(); others have no effect.
  void set_position_switches(std::vector<st::PositionSwitch> switches);
  /// After a restart of the process in a running cluster: everything as it was.
  /// After load().
  void restore(const Memory& memory);
  /// After a restart of the cluster: only retained registers, RETAIN variables, permanent forces and the time
  /// of the PLC. After load().
  void power_up(const Memory& memory);
  const Memory& memory() const { return memory_; }
  /// Valid after take_done() has returned the finished functions.
  PlcState state() const { return {memory_, view_}; }
  /// Whether the variables are those of the loaded programs in Structured Text.
  bool accepts(const ProgramVariables& variables) const { return structured_.fits(variables); }
  /// Continues like the core that gave `state`, given the same programs and parameters.
  void adopt(const PlcState& state);
  /// Why the programs were stopped; empty while they run. file:line:column: ...
  std::string program_fault() const { return structured_.fault_text(memory_.program); }
  bool has_program_fault() const { return memory_.program.fault.kind != 0; }
  /// The registers as they would be if the main task ran once more until they are stable.
  Registers rescanned() const;

  void set_channel(const idl::channel::ChannelState& state);
  void set_request(const idl::channel::AuxiliaryRequest& request);
  void set_feedback(const idl::stream::Feedback& feedback);
  void set_alarms(bool any, bool stops);
  /// Returns an empty text or why the request is refused. The programs see every change of an input byte: a
  /// second one of the same byte scans the first before.
  std::string panel(const idl::plc::PanelRequest& request);
  /// Also starts programs again that a fault has stopped.
  void press_reset();
  /// The drive does not confirm the standstill that a request waits for: continue without.
  void give_up_waiting();
  bool waits_for_standstill() const;
  /// The stream's cycles that the drive has executed are all below this; 0: none yet.
  std::uint64_t executed() const { return view_.executed; }

  /// Keeps a value whatever the programs write: before and after each task of every scan. False when
  /// most_forces others are forced already.
  bool force(const Force& force);
  /// False when it is not forced.
  bool release(std::uint32_t cell, int bit);
  void release_all();
  /// Is told of every scan from now on; null for none. It must outlive its use.
  void set_trace(ScanTrace* trace) { trace_ = trace; }
  /// Measures every scan from now on; null for none. It must outlive its use.
  void set_task_times(TaskTimes* times) { times_ = times; }
  /// Is told of every scan from now on; null for none. It must outlive its use.
  void set_orders(PanelOrders* orders) { orders_ = orders; }
  /// As of a copy that only computes: nobody is told of its scans.
  void scan_unseen() { trace_ = nullptr, times_ = nullptr, orders_ = nullptr; }
  /// The most statements of each task in one scan, by TaskName; 0: the machine has no such task.
  std::array<std::uint64_t, 3> statement_budgets() const;

  /// Scans up to the drive's tick, then until the image is stable.
  void advance(std::uint64_t tick);
  idl::plc::Outputs outputs() const;
  idl::plc::Image image() const;
  /// Functions finished since the last call, and finished ones that are requested again.
  std::vector<idl::plc::AuxiliaryDone> take_done();
  /// Whether the programs show the message of this number, below most_messages.
  bool shows_message(std::size_t number) const;
  /// The bits of all messages: message n is bit n % 16 of word n / 16.
  std::array<std::uint16_t, message_words> shown_messages() const;
  /// messages.yaml, by their numbers.
  const st::MessageFile& messages() const { return messages_; }
  /// The signal that this finished function has read; nothing when it is another function.
  std::optional<idl::plc::MacroSignal> signal_read(const idl::plc::AuxiliaryDone& done) const;
  /// Every finished function: for a restarted process, whose publications are lost.
  std::vector<idl::plc::AuxiliaryDone> all_done() const;
  bool emergency_stop() const;
  /// The programs ask for a reset of all alarms.
  bool external_reset() const;

 private:
  struct ChannelSymbols {
    Address running, held, idle, homed, rtcp, reset, mode_auto, mode_mdi, mode_jog, mode_ref;
    Address m_strobe, s_strobe, t_strobe, e_strobe, m_code, m_angle, s_value, t_code;
    Address e_order, e_spindle, e_value;
    Address feed_override, rapid_override, spindle_override, tool, fin, fin_failed;
    Address s_surface_speed, s_limit, s_radius;
    Address macro_input, macro_output;
  };
  struct ControlSymbols {
    Address start_inhibit, manual_inhibit, sets_overrides, feed_override, rapid_override, spindle_override;
    Address refused, alarm, tap_stop;
  };
  struct SpindleSymbols {
    Address at_speed, actual, oriented, homed, synchronized, position;
    Address speed, enable, counterclockwise, orient, orient_by_angle, orient_angle;
    Address gear, master, master_angle, reverse, integral, surface_speed, surface_channel;
  };
  void input(Address address, std::int64_t value);
  void press_emergency_stop(const View::Press& press);
  void scan_before(std::size_t byte);
  void scan(bool main, bool present);
  void run_task(TaskName task);
  bool continues_main() const { return memory_.program.main.interrupted != 0; }
  /// A request waits for the end of that run alone.
  bool waits_for_run() const;
  void settle();
  void find_control();
  void set_control(idl::plc::Outputs& outputs) const;
  bool controls() const;
  idl::plc::ChannelControl control(std::size_t channel) const;
  std::string order_answered(const idl::plc::PanelRequest& request);
  void apply_forces();
  void drop_forces_of_variables();
  void actuate_switches(const std::vector<double>& position);
  void set_strobes(bool present);
  void begin_order(const Handshake& handshake, const ChannelSymbols& symbols);
  void find_spindles();
  void take_spindles(const idl::stream::Feedback& feedback);
  void restore_spindles();
  double reachable_speed(std::size_t spindle) const;
  void check_spindles();
  bool check_orientation(std::size_t spindle);
  void check_coupling(std::size_t spindle);
  SurfaceOrder ordered_surface_speed(std::size_t spindle) const;
  void check_surface_speed(std::size_t spindle, bool on);
  std::int32_t ordered_orientation(std::size_t spindle) const;
  std::uint8_t ordered_master(std::size_t spindle) const;
  bool follows(std::size_t spindle) const;
  bool spindle_moves(std::size_t spindle) const;
  void set_spindles(idl::plc::Outputs& outputs) const;
  void finish();
  /// Whether the function has failed; nothing while it is carried out.
  std::optional<bool> failure(const Handshake& handshake, const ChannelSymbols& symbols) const;
  void read_signal(Handshake& handshake, const ChannelSymbols& symbols) const;
  bool at_speed(std::size_t spindle) const;
  bool at_standstill(std::size_t channel) const;

  StructuredText structured_;
  bool loaded_ = false, virtual_time_ = false;
  std::array<ChannelSymbols, channel_count> channel_symbols_;
  std::array<ControlSymbols, channel_count> control_symbols_;
  std::array<SpindleSymbols, spindle_count> spindle_symbols_;
  std::array<Address, st::most_messages> message_bits_;
  Address emergency_button_, reset_button_, drive_present_, drives_on_, alarm_active_, alarm_stops_,
      probe_contact_;
  Address emergency_stop_, feed_hold_, axes_enable_, probe_on_, external_reset_;
  std::array<Address, 2> milling_tool_;
  std::array<Address, 16> axis_inhibit_, slave_off_;
  std::array<Address, 8> coolant_;

  std::vector<std::uint8_t> axis_exists_;
  std::vector<std::string> axis_names_;  ///< in the order of the drive's feedback
  std::vector<st::PositionSwitch> switches_;
  st::MessageFile messages_;
  std::size_t spindles_ = 0;
  std::array<double, spindle_count> speed_window_{};   ///< share of the commanded speed: 10a970
  std::array<double, spindle_count> highest_speed_{};  ///< 1/min: 10a948; 0: no limit
  std::array<std::array<double, gear_count>, spindle_count> gear_speeds_{};  ///< 1/min: 10a985 ..; 0: no gear
  std::uint64_t period_us_ = 0;
  std::int64_t main_part_ = StructuredText::most_statements;  ///< statements of the main task in one scan
  Memory memory_;
  View view_;
  std::bitset<register_count> unscanned_;  ///< bytes of X that the panel has set since the last scan
  ProgramVariables settling_;              ///< before the scan
  ScanTrace* trace_ = nullptr;
  TaskTimes* times_ = nullptr;
  PanelOrders* orders_ = nullptr;
  std::vector<idl::plc::AuxiliaryDone> done_;
};

}  // namespace trunnion::plc
