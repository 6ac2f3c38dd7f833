// SPDX-License-Identifier: Apache-2.0
// One machine whose services are lost, and what is seen of it.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "cluster_harness.hpp"
#include "fault_matrix_cells.hpp"
#include "path_follower.hpp"

namespace trunnion::integration {

/// mm and deg together; a path may be rounded by 0.01 mm (parameter 040901) at every speed differently.
inline constexpr double path_tolerance = 0.02;

/// What was seen of one fault.
struct Observation {
  std::set<unsigned> alarms;
  bool stopped = false;
  bool axes_off = false;
  /// Executed cycles from the one at which the channel learnt of the loss to the standstill.
  std::optional<std::int64_t> cycles_of_hold;
  /// Executed cycles from the one at which the drive ran short of setpoints to the standstill, and how many
  /// it had.
  std::optional<std::int64_t> cycles_of_braking, cycles_at_hand;
  std::uint64_t executed_when_struck = 0, executed_at_standstill = 0;
};

class FaultRig {
 public:
  FaultRig(const std::string& layout, bool gateway, std::optional<std::uint32_t> domain,
           Time time = Time::virtual_);
  ~FaultRig();

  Cluster& cluster() { return cluster_; }

  /// Stores one of everything that must survive, and the program with so many rounds.
  void store_keepsakes(int rounds = 15);
  /// Compares all of it; every difference is a failure of the test.
  void check_keepsakes();
  /// Value of a kept variable in the channel's file; nothing when it is vacant.
  std::optional<double> kept_variable(unsigned number) const;

  /// An MDI line to its end.
  void mdi(const std::string& line);
  /// To where every run begins and ends: all axes at machine zero.
  void go_home();
  /// Begins the program at home.
  void begin();
  bool finish();
  /// Rows since begin().
  const Rows& rows() { return cluster_.rows; }
  std::uint64_t lost_rows() const { return cluster_.lost_batches; }
  Judgement judge(const Rows& reference, bool whole) const;
  /// An undisturbed run of which every row was seen; empty when the observer is too slow for that. Counts in
  /// `runs`.
  Rows undisturbed(double& runs);

  /// Remembers every process, then strikes. Returns when the struck process has had its fault.
  void strike(const std::string& service, Fault fault);
  /// Until the cluster is ready and, in motion, the machine stands; checks processes on the way.
  Observation await(const std::string& service, Fault fault, bool in_motion);
  /// What an operator does. Returns what was necessary.
  Way go_on();
  /// Resets alarms until no one stops the machine.
  void reset_alarms();

  void start_recorder();
  /// Ends it in order when it runs; returns the messages in its file.
  std::uint64_t stop_recorder();
  std::uint64_t recorded_messages() const;
  /// Ends it however it is and removes its file.
  void drop_recorder();

 private:
  int pid_of(const std::string& service) const;
  bool stands();
  void settle();
  void watch();
  void wait_for_news(const std::function<void()>& order);
  bool replaced(const std::string& service) const;
  void restart_loop(const std::string& service);
  Cluster cluster_;
  std::string recording_, part_;
  int recorder_ = 0;
  std::map<std::string, int> pids_;
  std::map<std::string, std::uint32_t> restarts_;
  std::size_t history_ = 0;
  std::optional<bus::Reader<idl::channel::ChannelState>> every_state_;
  std::optional<std::uint64_t> hold_began_;
  idl::parameters::ToolTable tools_;
  idl::parameters::WorkOffsets offsets_;
  idl::parameters::ParameterSet parameters_;
};

/// The program of the matrix: about a minute of five axes, `rounds` times to and fro, from home and back.
std::string part_program(int rounds);

}  // namespace trunnion::integration
