// SPDX-License-Identifier: Apache-2.0
// What operators ask of a measurement.
#include <cmath>
#include <stdexcept>

#include "calibration/chain_change.hpp"
#include "calibration/ideal_touches.hpp"
#include "calibration/last_calibration.hpp"
#include "calibration/measurement_file.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/kinematics.hpp"
#include "measurement.hpp"
#include "text/utf8.hpp"

namespace trunnion::measurement {
namespace {

using idl::measurement::Operation;

constexpr std::size_t most_reason = 255;

std::vector<calibration::TouchedPose> poses_of(const MeasurementResult& result) {
  std::vector<calibration::TouchedPose> poses;
  for (const auto& kept : result.poses) {
    auto& pose = poses.emplace_back();
    for (std::size_t i = 0; i < pose.angles.size() && i < kept.angles.size(); ++i)
      pose.angles[i] = kept.angles[i];
    for (std::size_t i = 0; i + 2 < kept.touches.size(); i += 3)
      pose.positions.emplace_back(kept.touches[i], kept.touches[i + 1], kept.touches[i + 2]);
  }
  return poses;
}

void put_over(calibration::MeasurementInputs& in, const MeasurementRequest& request) {
  using Asked = idl::measurement::Mode;
  if (request.mode == Asked::MEASURE_ONLY) in.mode = calibration::Mode::measure_only;
  if (request.mode == Asked::CORRECT) in.mode = calibration::Mode::correct;
  if (request.mode == Asked::ONLY_CORRECT) in.mode = calibration::Mode::only_correct;
  for (const auto& values : {request.sphere, request.probe_length})
    for (const double value : values)
      if (!(std::abs(value) <= 1e5)) throw std::runtime_error("a length of the request is beyond 100000 mm");
  if (request.sphere.size() == 3) in.sphere = {request.sphere[0], request.sphere[1], request.sphere[2]};
  if (!request.probe_length.empty()) in.probe_length = request.probe_length[0];
}

}  // namespace

MeasurementReply Measurement::apply(const MeasurementRequest& request, const std::string& time, double now) {
  std::string reason;
  switch (request.operation) {
    case Operation::START:
      reason = start(request, time);
      break;
    case Operation::CONTINUE:
      reason = go_on();
      break;
    case Operation::ABORT:
      reason = abort(now);
      break;
    case Operation::CONFIRM:
      reason = confirm(request);
      break;
    case Operation::DISCARD:
      reason = discard();
      break;
    default:
      reason = "unknown operation";
  }
  MeasurementReply reply;
  reply.accepted = reason.empty();
  if (!reply.accepted) reply.alarm = alarm::request_invalid.number;
  reply.reason = text::shortened(std::move(reason), most_reason);
  reply.measurement = stored_.state.measurement;
  return reply;
}

// The machine by its active parameters. Throws std::runtime_error: one line.
std::shared_ptr<Measurement::Plan> Measurement::machine_to_measure(std::uint16_t channel) const {
  if (!set_) throw std::runtime_error("the parameters have not arrived yet");
  for (const auto& pending : set_->pending)
    if (machine::is_chain_parameter(pending.number))
      throw std::runtime_error("parameter " + machine::number_text(pending.number) +
                               " of the kinematics waits for a reset; reset the channel first");
  auto made = std::make_shared<Plan>();
  made->active = machine::parameters_of(*set_);
  made->measured = calibration::measured_machine(facts_.name, facts_.delivered, made->active, channel);
  made->measured.gauges = facts_.gauges;
  return made;
}

// Everything that can be known before anything moves. Empty, or why it cannot be measured.
std::string Measurement::prepare(const MeasurementRequest& request) {
  try {
    auto made = machine_to_measure(request.channel);
    const auto& measured = made->measured;
    made->inputs = request.inputs.empty() ? calibration::default_inputs(measured)
                                          : calibration::parse_inputs(request.inputs, "inputs", measured);
    put_over(made->inputs, request);
    if (auto fault = calibration::fault_of(made->inputs, measured); !fault.empty()) return fault;
    if (made->inputs.reference == calibration::Reference::adapt && !made->inputs.reference_measurement)
      return "reference adapt needs reference_measurement {sphere_mm, zero_offset_mm} in the inputs, or "
             "`trunnion calibrate kinematics --on-machine --reference FILE`";
    auto plan = calibration::plan_measurement(made->inputs, measured);
    if (auto* fault = std::get_if<std::string>(&plan)) return *fault;
    made->plan = std::get<calibration::MeasurementPlan>(std::move(plan));
    const bool moves = made->inputs.mode != calibration::Mode::only_correct;
    if (moves) {
      const auto corrections = calibration::named_corrections(made->active, request.channel);
      auto fault = calibration::evaluation_fault(made->inputs, measured, made->plan, corrections);
      if (!fault.empty()) return fault;
    }
    if (!request.retract && moves)
      made->ways = facts_.ways(made->inputs, measured, request.channel, made->active);
    plan_ = std::move(made);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

// Why the channel cannot measure now.
std::string Measurement::channel_fault(bool in_program) const {
  const auto name = "channel " + std::to_string(machine_.channel());
  const auto* state = machine_.state();
  if (state == nullptr) return name + " publishes no state";
  if (machine_.stopped()) return machine_.stopping().text;
  if (!in_program && (state->state != idl::channel::RunState::IDLE || state->suspended))
    return name + " is " + bus::to_string(state->state) + " with a program: end or reset it first";
  if (!state->homed) return name + ": an axis has no reference; home the axes first";
  return "";
}

std::string Measurement::start(const MeasurementRequest& request, const std::string& time, bool in_program) {
  if (is_active(stored_.state.phase)) return "a measurement is under way: abort it first";
  machine_.watch(request.channel);
  if (auto reason = prepare(request); !reason.empty()) return reason;
  std::vector<calibration::TouchedPose> done;
  const bool only_correct = plan_->inputs.mode == calibration::Mode::only_correct;
  if (only_correct)
    done = poses_of(stored_.result);
  else if (auto reason = channel_fault(in_program); !reason.empty())
    return reason;
  if (only_correct && done.size() != plan_->plan.poses.size())
    return "the mode is only_correct: " + std::to_string(done.size()) + " of " +
           std::to_string(plan_->plan.poses.size()) + " poses are kept; measure first";
  try {
    touches_ = std::make_unique<calibration::TouchSequence>(plan_->inputs, plan_->measured, plan_->plan,
                                                            std::move(done));
  } catch (const std::exception& e) {
    return e.what();
  }
  const auto number = stored_.state.measurement + 1;
  const auto open_call = stored_.call;
  auto poses = only_correct ? std::move(stored_.result.poses) : std::vector<idl::measurement::Pose>{};
  stored_ = {};
  stored_.in_program = in_program;
  stored_.call = open_call;
  stored_.request = request;
  stored_.result.measurement = stored_.state.measurement = number;
  stored_.result.poses = std::move(poses);
  stored_.state.channel = request.channel;
  stored_.state.who = request.who;
  stored_.state.time = time;
  begin();
  return "";
}

std::string Measurement::go_on() {
  if (stored_.state.phase != Phase::INTERRUPTED) return "no measurement is interrupted";
  if (called()) return "it was called by a program: start that program again";
  machine_.watch(stored_.request.channel);
  if (auto reason = prepare(stored_.request); !reason.empty()) return reason;
  if (plan_->inputs.mode != calibration::Mode::only_correct)
    if (auto reason = channel_fault(false); !reason.empty()) return reason;
  try {
    touches_ = std::make_unique<calibration::TouchSequence>(plan_->inputs, plan_->measured, plan_->plan,
                                                            poses_of(stored_.result));
  } catch (const std::exception& e) {
    return e.what();
  }
  begin();
  return "";
}

void Measurement::begin() {
  auto& state = stored_.state;
  state.poses = static_cast<std::uint32_t>(plan_->plan.poses.size());
  state.complete = static_cast<std::uint32_t>(touches_->done().size());
  state.repeatability = -1;
  state.alarm = 0;
  state.error.clear();
  planned_ = state.complete;
  serial_ = 0;
  from_ = called() ? caller_->position : machine_.position();
  run_.reset();
  request_.reset();
  asked_.reset();
  change(plan_->inputs.mode == calibration::Mode::only_correct ? Phase::ESTIMATING : Phase::PLANNING);
}

std::string Measurement::abort(double now) {
  const auto phase = stored_.state.phase;
  if (phase == Phase::STOPPING) return "";
  if (!is_active(phase)) return "no measurement is under way";
  if (phase == Phase::WRITING) return "the parameters are being written";
  fail("aborted", 0, now);
  return "";
}

std::string Measurement::confirm(const MeasurementRequest& request) {
  const auto& state = stored_.state;
  if (state.phase != Phase::WAITING) return "no result waits for a confirmation";
  if (!state.tolerance_alarm.empty()) {
    if (state.tolerance_needs_reset) return state.tolerance_alarm + "; it cannot be confirmed, discard it";
    if (!request.acknowledge)
      return state.tolerance_alarm + "; nothing written, --acknowledge writes in spite of it";
  }
  if (!set_) return "the parameters have not arrived yet";
  const auto active = machine::parameters_of(*set_);
  for (const auto& change : stored_.result.changes)
    if (active.at(change.number) != change.before)
      return "parameter " + machine::number_text(change.number) +
             " was changed since the measurement; discard the result and measure again";
  restored_write_ = false;
  // The removal of the program of the poses may still be unanswered; what comes now answers the import alone.
  asked_.reset();
  change(Phase::WRITING);
  return "";
}

std::string Measurement::discard() {
  if (is_active(stored_.state.phase)) return "a measurement is under way: abort it first";
  const auto number = stored_.state.measurement;
  stored_ = {};
  stored_.result.measurement = stored_.state.measurement = number;
  plan_.reset();
  touches_.reset();
  change(Phase::NOTHING);
  return "";
}

}  // namespace trunnion::measurement
