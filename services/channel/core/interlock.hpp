// SPDX-License-Identifier: Apache-2.0
// What others let a channel do: the cluster, alarms that stop motion, the drive, the PLC.
#pragma once

#include <optional>
#include <string>

#include "answer.hpp"
#include "contracts/types.hpp"

namespace trunnion::channel {

class Interlock {
 public:
  void set_ready(bool ready) { ready_ = ready; }
  /// `why` is empty when nothing holds the channel.
  void set_hold(const std::string& why) { hold_ = why; }
  /// `why` is empty when the drive has not stopped all axes.
  void set_drive_stopped(const std::string& why) { drive_stopped_ = why; }
  /// True when manual motion is inhibited from now on.
  bool set_control(const idl::plc::ChannelControl& control);

  const idl::plc::ChannelControl& control() const { return control_; }
  bool holds() const { return !hold_.empty(); }
  /// For the operator; empty when nothing holds the channel.
  const std::string& hold() const { return hold_; }
  bool drive_stopped() const { return !drive_stopped_.empty(); }

  /// Why nothing may move. What the drive has `interrupted` may continue though it has stopped all axes.
  std::optional<Refusal> motion(bool interrupted) const;
  /// Why there is no cycle start and no MDI line.
  std::optional<Refusal> start() const;
  /// Why there is no jog, handwheel and reference return.
  std::optional<Refusal> manual_motion() const;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("ready", self.ready_), visit("hold", self.hold_), visit("drive_stopped", self.drive_stopped_);
    visit("control", self.control_);
  }

 private:
  bool ready_ = false;
  std::string hold_, drive_stopped_;
  idl::plc::ChannelControl control_;
};

}  // namespace trunnion::channel
