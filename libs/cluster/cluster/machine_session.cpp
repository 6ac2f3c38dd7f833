// SPDX-License-Identifier: Apache-2.0
#include "cluster/machine_session.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

namespace trunnion::cluster {

using idl::channel::Mode;
using idl::channel::RunState;

namespace {
constexpr int tries = 50;
constexpr std::chrono::milliseconds between_tries(10), to_rest(300), between_looks(1);
constexpr double longest_selection = 30;  // s
}  // namespace

// The list with a new program may reach the channel after the store's answer has reached us.
void MachineSession::select(const std::string& name) {
  client_.set_mode(channel_, Mode::AUTO);
  for (int i = 0;; ++i) {
    try {
      return client_.select_program(channel_, name);
    } catch (const std::exception&) {
      if (i == tries) throw;
      std::this_thread::sleep_for(between_tries);
    }
  }
}

void MachineSession::take() {
  before_ = state();
  if (before_.state != RunState::IDLE)
    throw std::runtime_error("channel " + std::to_string(channel_) + " is busy: end its program or reset it");
  if (!before_.homed) throw std::runtime_error("axes have no reference: select mode REF and reference them");
}

void MachineSession::select_temporary(const std::string& name, const std::string& text) {
  client_.set_mode(channel_, Mode::AUTO);
  if (name == temporary_ && text == text_) {  // it is stored still; the channel has put back the operator's
    client_.select_program(channel_, name);
    return;
  }
  text_.clear();
  temporary_ = name;
  const auto revision = client_.upload(name, text);
  // Until the list with the new text is there, the channel refuses the program or takes the text of before.
  const double until = service::monotonic_seconds() + longest_selection;
  for (;;) {
    try {
      client_.select_program(channel_, name);
      if (state().program_revision >= revision) break;
    } catch (const std::exception&) {
      if (service::monotonic_seconds() > until) throw;
    }
    if (service::monotonic_seconds() > until)
      throw std::runtime_error("channel " + std::to_string(channel_) + " does not take the program " + name);
    std::this_thread::sleep_for(between_looks);
  }
  text_ = text;
}

MachineSession::End MachineSession::run(const std::function<void()>& meanwhile, double longest) {
  moves_ = true;
  client_.channel(channel_, CommandKind::CYCLE_START);
  auto states = client_.reader_from_now(topics::channel_state);
  const double until = service::monotonic_seconds() + longest;
  while (service::monotonic_seconds() < until) {
    meanwhile();
    for (idl::channel::ChannelState state; states.take(state);) {
      if (state.channel != channel_) continue;
      if (state.state == RunState::HELD || state.state == RunState::INTERRUPTED) return End::stopped;
      if (state.state == RunState::IDLE) {
        moves_ = false;
        return End::idle;
      }
    }
    client_.bus().signal().wait(0.01);
  }
  return End::overdue;
}

void MachineSession::hold() {
  if (moves_) client_.channel(channel_, CommandKind::FEED_HOLD);
}

void MachineSession::end() {
  if (!moves_) return;
  std::this_thread::sleep_for(to_rest);
  client_.channel(channel_, CommandKind::RESET);
}

void MachineSession::restore() {
  if (temporary_.empty()) return;
  if (!before_.program.empty()) client_.select_program(channel_, before_.program);
  client_.set_mode(channel_, before_.mode);
  idl::program::ProgramRequest remove;
  remove.operation = idl::program::Operation::REMOVE;
  remove.name = temporary_;
  client_.program(remove);
}

}  // namespace trunnion::cluster
