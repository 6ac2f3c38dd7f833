// SPDX-License-Identifier: Apache-2.0
#include "generated_program.hpp"

#include <algorithm>

#include "machine/roles.hpp"
#include "storage/crc32.hpp"

namespace trunnion::measurement {
namespace {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;
using idl::channel::RunState;
using Upload = idl::program::Operation;
using idl::program::ProgramRequest;

constexpr std::size_t chunk = 32768;  // bytes
constexpr double silence = 10;        // s without a state of a running channel
constexpr double late_news = 0.5;     // s: alarms come on another topic than the state
constexpr double variables_wait = 5;  // s
constexpr double list_wait = 1;       // s: the list with a new program may reach the channel after the answer
constexpr double list_wait_between = 0.01;

}  // namespace

GeneratedProgram::GeneratedProgram(std::uint16_t channel, Kind kind, std::string name, std::string text,
                                   std::uint32_t serial)
    : channel_(channel), kind_(kind), name_(std::move(name)), text_(std::move(text)), serial_(serial) {}

void GeneratedProgram::ask(Request request) {
  request_ = std::move(request);
  waits_ = true;
}

std::optional<Request> GeneratedProgram::take_request() {
  auto request = std::move(request_);
  request_.reset();
  return request;
}

void GeneratedProgram::fail(std::string otherwise, double now) {
  error_ = std::move(otherwise);
  step_ = Step::news;
  since_ = now;
}

void GeneratedProgram::ask_next() {
  ProgramRequest program;
  program.name = name_;
  ChannelRequest command;
  command.channel = channel_;
  switch (step_) {
    case Step::begin:
      program.operation = Upload::BEGIN_UPLOAD;
      return ask(program);
    case Step::write: {
      program.operation = Upload::WRITE;
      program.offset = written_;
      const auto part = std::string_view(text_).substr(written_, chunk);
      program.data.assign(part.begin(), part.end());
      return ask(program);
    }
    case Step::commit:
      program.operation = Upload::COMMIT_UPLOAD;
      program.size = text_.size();
      program.crc32 = storage::crc32(text_);
      program.role = machine::role::builder;  // its own text, which moves and sets macro variables
      return ask(program);
    case Step::mode:
      command.command = CommandKind::SET_MODE;
      command.mode = idl::channel::Mode::AUTO;
      return ask(command);
    case Step::select:
      command.command = CommandKind::SELECT_PROGRAM;
      command.program = name_;
      return ask(command);
    case Step::start:
      command.command = CommandKind::CYCLE_START;
      return ask(command);
    default:
      return;
  }
}

void GeneratedProgram::answered(const Answer& answer, double now) {
  waits_ = false;
  if (!answer.accepted) {
    if (step_ == Step::select && now - since_ < list_wait) {
      ++tries_;
      return;
    }
    return fail(answer.reason, now);
  }
  switch (step_) {
    case Step::begin:
      step_ = Step::write;
      break;
    case Step::write:
      written_ += std::min(chunk, text_.size() - written_);
      if (written_ == text_.size()) step_ = Step::commit;
      break;
    case Step::commit:
      revision_ = answer.revision;
      step_ = kind_ == Kind::store ? Step::done : Step::mode;
      break;
    case Step::mode:
      step_ = Step::select;
      break;
    case Step::select:
      step_ = Step::start;
      break;
    case Step::start:
      step_ = Step::settle;
      states_before_ = 0;
      break;
    default:
      break;
  }
  since_ = now;
}

void GeneratedProgram::watch(const MachineView& machine, double now) {
  const auto& state = *machine.state();
  if (state.state == RunState::IDLE) {
    step_ = Step::variables;
    since_ = now;
  } else if (state.state == RunState::INTERRUPTED) {
    fail("the motion was interrupted in line " + std::to_string(state.line) + " of " + name_ + " (" +
             (state.detail.empty() ? std::string("a process of the stream has ended") : state.detail) + ")",
         now);
  } else if (state.state == RunState::HELD) {
    // A hold and its alarm come by different topics; without one an operator has pressed feed hold.
    if (machine.stopped()) fail("", now);
  } else if (now - machine.heard() > silence) {
    fail("channel " + std::to_string(channel_) + " does not answer", now);
  }
}

void GeneratedProgram::step(MachineView& machine, double now) {
  if (waits_ || done() || failed()) return;
  switch (step_) {
    case Step::select:
      // The first try at once.
      if (tries_ > 0 && now - since_ < list_wait_between * tries_) return;
      break;
    case Step::start:
      machine.forget_variables();
      break;
    case Step::settle:
      // The first state after the answer may have been on its way before, the second cannot.
      if (states_before_ == 0) states_before_ = machine.states();
      if (machine.states() >= states_before_ + 2) {
        step_ = Step::running;
        since_ = now;
      } else if (now - since_ > silence) {
        fail("channel " + std::to_string(channel_) + " does not answer", now);
      }
      return;
    case Step::running:
      return watch(machine, now);
    case Step::variables:
      if (machine.stopped() || now - since_ > variables_wait) {
        fail(name_ + " was ended before its last touch, by a reset", now);
      } else if (calibration::completed(machine.variables(), serial_)) {
        variables_ = machine.variables();
        step_ = Step::done;
      }
      return;
    case Step::news:
      if (now - since_ < late_news) return;
      if (const auto cause = machine.stopping(); cause.number != 0)
        error_ = cause.text, alarm_ = cause.number;
      step_ = Step::failed;
      return;
    default:
      break;
  }
  ask_next();
}

}  // namespace trunnion::measurement
