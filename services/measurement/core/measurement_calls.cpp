// SPDX-License-Identifier: Apache-2.0
// A measurement that a program calls: CYCLE9960.
#include <algorithm>
#include <stdexcept>

#include "calibration/cycle_arguments.hpp"
#include "calibration/measurement_file.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/roles.hpp"
#include "measurement.hpp"
#include "text/utf8.hpp"

namespace trunnion::measurement {
namespace {

using idl::channel::CycleCaller;
using idl::channel::CycleOutcome;
using idl::channel::CycleRequest;

constexpr std::uint32_t measure_kinematics = 9960, part_done = 0;
constexpr double seen_late = 0.5;   // s: an ended program, its alarm and its state come by different topics
constexpr double unheard_for = 10;  // s without a state of the channel
constexpr std::size_t most_reply = 255, most_who = 47;
constexpr const char* process_ended = "the measurement process has ended";

// NAME line N, in what the name of a client may have.
std::string name_of(const CycleRequest& request) {
  const auto line = " line " + std::to_string(request.line);
  return "program " + request.program.substr(0, most_who - 8 - line.size()) + line;
}

calibration::MacroVariables values_of(const CycleRequest& request) {
  calibration::MacroVariables values;
  for (std::size_t i = 0; i < std::min(request.numbers.size(), request.values.size()); ++i)
    values[request.numbers[i]] = request.values[i];
  return values;
}

calibration::AxisPosition position_of(const CycleRequest& request) {
  calibration::AxisPosition position{};
  for (std::size_t i = 0; i < std::min(request.machine.size(), position.size()); ++i)
    position[i] = request.machine[i];
  return position;
}

}  // namespace

std::optional<idl::channel::CycleReply> Measurement::take_reply() {
  auto reply = std::move(reply_);
  reply_.reset();
  return reply;
}

void Measurement::answer(CycleOutcome outcome, const std::string& reason, std::uint64_t revision) {
  idl::channel::CycleReply reply;
  reply.channel = machine_.channel();
  reply.number = caller_->number;
  reply.outcome = outcome;
  reply.reason = text::shortened(reason, most_reply);
  if (outcome == CycleOutcome::REFUSED) reply.alarm = stored_.state.alarm;
  if (outcome == CycleOutcome::CALL) reply.program = part_program, reply.revision = revision;
  reply_ = reply;
  if (outcome == CycleOutcome::RECEIVED) return;
  caller_->asks = false;
  stored_.call = 0;
  changed_ = true;
}

void Measurement::call(const CycleRequest& request, const std::string& time) {
  const bool ours = called() && request.channel == machine_.channel();
  if (request.caller != CycleCaller::ASKS) {
    // Answered by another process than this one: the request was one of the past.
    const bool stale = caller_asks() && request.number == caller_->number;
    if (ours && caller_ && (request.caller == CycleCaller::ENDED || stale))
      caller_->asks = false, caller_->ended = true;
    return;
  }
  if (is_active(stored_.state.phase) && !(ours && caller_ && request.cycle == part_done)) {
    // Another channel, or a process before this one has begun it: the measurement under way is not touched.
    idl::channel::CycleReply reply;
    reply.channel = request.channel;
    reply.number = request.number;
    reply.outcome = CycleOutcome::REFUSED;
    reply.reason = ours ? process_ended : "a measurement is under way: abort it first";
    reply_ = reply;
    if (stored_.call == request.number) stored_.call = 0, changed_ = true;
    return;
  }
  const bool began_before = !caller_ && stored_.call == request.number && stored_.call != 0;
  machine_.watch(request.channel);
  caller_ = Caller{request.number, true, false, position_of(request), values_of(request), request.role};
  away_since_ = -1;
  stored_.call = request.number;
  changed_ = true;
  answer(CycleOutcome::RECEIVED);
  if (is_active(stored_.state.phase)) return;  // step() goes on with what the part has measured
  std::string reason;
  if (request.cycle == measure_kinematics && !began_before)
    reason = start_called(request, time);
  else if (request.cycle == part_done || began_before)
    reason = stored_.state.error.empty() ? process_ended : stored_.state.error;
  else
    reason = "there is no cycle " + std::to_string(request.cycle);
  if (!reason.empty()) answer(CycleOutcome::REFUSED, reason);
}

std::string Measurement::start_called(const CycleRequest& request, const std::string& time) {
  MeasurementRequest start;
  start.operation = idl::measurement::Operation::START;
  start.who = name_of(request);
  start.channel = request.channel;
  try {
    const auto machine = machine_to_measure(request.channel);
    start.inputs = calibration::inputs_text(caller_->values, machine->measured);
    auto inputs = calibration::parse_inputs(start.inputs, "CYCLE9960", machine->measured);
    if (request.tool_length != 0) {
      inputs.probe_length = request.tool_length;
      start.probe_length = {request.tool_length};
    }
    const auto sphere = calibration::sphere_under_probe(inputs, machine->measured, caller_->position);
    start.sphere = {sphere.x(), sphere.y(), sphere.z()};
  } catch (const std::exception& e) {
    return e.what();
  }
  return this->start(start, time, true);
}

// The program that has called must be seen executing it. After 0.5 s it has ended, or the drive has stopped
// it.
void Measurement::watch_caller(double now) {
  using idl::channel::RunState;
  const auto phase = stored_.state.phase;
  if (!called() || !caller_ || !is_active(phase) || phase == Phase::WRITING || phase == Phase::STOPPING)
    return;
  const auto* channel = machine_.state();
  if (channel == nullptr) return;
  const bool away =
      caller_->ended || channel->state == RunState::IDLE || channel->state == RunState::INTERRUPTED;
  if (!away) {
    away_since_ = -1;
    if (now - machine_.heard() > unheard_for)
      fail("channel " + std::to_string(machine_.channel()) + " does not answer", 0, now);
    return;
  }
  if (away_since_ < 0) away_since_ = now;
  if (now - away_since_ < seen_late) return;
  const auto cause = machine_.stopping();
  if (cause.number != 0) return fail(cause.text, cause.number, now);
  fail(channel->state == RunState::INTERRUPTED
           ? "the motion was interrupted in line " + std::to_string(channel->line)
           : "the program has ended before its end",
       0, now);
}

// What it has found: a result within its tolerance is written without a confirmation, unless the caller may
// not change the parameters of the kinematics.
void Measurement::settle_caller() {
  if (!called() || !caller_asks()) return;
  const auto& state = stored_.state;
  if (state.phase == Phase::FINISHED) return answer(CycleOutcome::FINISHED);
  if (state.phase != Phase::WAITING) return;
  if (!state.error.empty()) return answer(CycleOutcome::REFUSED, state.error);
  if (!state.tolerance_alarm.empty())
    return answer(CycleOutcome::REFUSED,
                  state.tolerance_alarm + (state.tolerance_needs_reset
                                               ? "; nothing written, discard the result and measure again"
                                               : "; nothing written: confirm or discard the result"));
  if (caller_->role < machine::role::builder)
    return answer(CycleOutcome::REFUSED,
                  "nothing written: the parameters of the kinematics need the role builder, and this is "
                  "measured for a lower one; a builder confirms the result or discards it");
  if (const auto reason = confirm({}); !reason.empty()) answer(CycleOutcome::REFUSED, reason);
}

}  // namespace trunnion::measurement
