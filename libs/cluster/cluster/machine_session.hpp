// SPDX-License-Identifier: Apache-2.0
// A channel that executes programs for a command, and gets back what it had.
#pragma once

#include <functional>
#include <string>

#include "cluster/client.hpp"

namespace trunnion::cluster {

class MachineSession {
 public:
  enum class End {
    idle,     ///< the program has come to its end, or was reset
    stopped,  ///< held or interrupted
    overdue   ///< moves still
  };

  MachineSession(Client& client, std::uint16_t channel) : client_(client), channel_(channel) {}

  std::uint16_t number() const { return channel_; }
  idl::channel::ChannelState state() { return client_.newest(topics::channel_state, channel_); }
  /// Selects a stored program in mode AUTO. A program that was stored just now may be refused at first.
  void select(const std::string& name);

  /// The channel is taken as it stands, for restore(). Throws std::runtime_error when it is busy or an axis
  /// has no reference.
  void take();
  /// As the channel was taken.
  const idl::channel::ChannelState& before() const { return before_; }
  /// Stores `text` as a program of this session alone and selects it; returns when the channel has this text.
  /// Throws std::runtime_error.
  void select_temporary(const std::string& name, const std::string& text);
  /// Starts the selected program and waits for its end, `longest` s at most. Calls `meanwhile` at least every
  /// 10 ms; what it throws leaves the program running: moves().
  End run(const std::function<void()>& meanwhile, double longest);
  /// The program of run() has not come to its end, as far as is known.
  bool moves() const { return moves_; }
  /// Feed hold of what moves.
  void hold();
  /// Ends what hold() has stopped, by a reset.
  void end();
  /// Selects the program of before, in the mode of before, and removes the temporary one; nothing when there
  /// was none.
  void restore();

 private:
  Client& client_;
  std::uint16_t channel_;
  idl::channel::ChannelState before_;
  std::string temporary_, text_;  // name of the temporary program, and the text that the channel has of it
  bool moves_ = false;
};

}  // namespace trunnion::cluster
