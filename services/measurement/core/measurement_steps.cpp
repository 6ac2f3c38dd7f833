// SPDX-License-Identifier: Apache-2.0
// What a measurement does by itself.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "calibration/chain_change.hpp"
#include "calibration/last_calibration.hpp"
#include "calibration/protocol.hpp"
#include "machine/roles.hpp"
#include "measurement.hpp"
#include "metrology/sphere.hpp"
#include "text/utf8.hpp"

namespace trunnion::measurement {
namespace {

using calibration::AxisPosition;
using calibration::Vec3;

constexpr double answer_within = 3;       // s
constexpr double rest_within = 10;        // s: from feed hold to standstill
constexpr double moved_tolerance = 0.02;  // mm: of the sphere since the poses that were measured before
constexpr double um = 1000;               // of a mm
constexpr double planning_share = 0.1;    // of the progress
constexpr std::size_t most_error = 511, most_text = 255, most_protocol = 16383;  // idl/measurement.idl

std::vector<double> values(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

const char* addressee(std::size_t kind) {
  return kind == 0 ? "the channel" : kind == 1 ? "the program service" : "the parameters service";
}

}  // namespace

Measurement::Measurement(MachineFacts facts) : facts_(std::move(facts)) {}

void Measurement::restore(StoredMeasurement kept) {
  stored_ = std::move(kept);
  machine_.watch(stored_.request.channel);
  const auto phase = stored_.state.phase;
  if (phase == Phase::WRITING)
    restored_write_ = true;
  else if (phase == Phase::STOPPING)
    stopping_since_ = -1;
  else if (is_active(phase))
    fail("the measurement process has ended", 0, -1);
}

void Measurement::take(const idl::parameters::ParameterSet& set) { set_ = set; }

bool Measurement::take_change() { return std::exchange(changed_, false); }

std::optional<Request> Measurement::take_request() {
  auto request = std::move(request_);
  request_.reset();
  return request;
}

std::optional<std::function<WayAnswer()>> Measurement::take_work() {
  auto work = std::move(work_);
  work_.reset();
  return work;
}

void Measurement::ask(Request request, double now) {
  asked_ = request.index();
  asked_since_ = now;
  request_ = std::move(request);
}

void Measurement::change(Phase phase) {
  auto& state = stored_.state;
  state.phase = phase;
  stage_ = Stage::way;
  const double poses = std::max<double>(state.poses, 1);
  const bool measured = phase == Phase::RETRACTING || phase == Phase::ESTIMATING || phase == Phase::WAITING ||
                        phase == Phase::WRITING || phase == Phase::FINISHED;
  if (phase == Phase::PLANNING)
    state.progress = planning_share * static_cast<double>(planned_) / poses;
  else if (phase == Phase::NOTHING)
    state.progress = 0;
  else
    state.progress = measured ? 1 : planning_share + (1 - planning_share) * state.complete / poses;
  const bool measuring = phase == Phase::MEASURING && touches_ && !touches_->finished();
  if (phase != Phase::STOPPING && phase != Phase::INTERRUPTED) state.pose = measuring ? touches_->name() : "";
  state.may_continue = phase == Phase::INTERRUPTED && !called();
  state.may_confirm =
      phase == Phase::WAITING && !(state.tolerance_needs_reset && !state.tolerance_alarm.empty());
  state.detail = phase == Phase::PLANNING        ? "plans the ways among the bodies of the machine"
                 : phase == Phase::REPEATABILITY ? "touches one point five times"
                 : phase == Phase::MEASURING
                     ? "pose " + std::to_string(state.complete + 1) + " of " + std::to_string(state.poses)
                 : phase == Phase::RETRACTING ? "retracts the probe"
                 : phase == Phase::WAITING    ? "waits for a confirmation"
                 : phase == Phase::WRITING    ? "writes the parameters"
                 : phase == Phase::STOPPING   ? "waits until the channel is at rest"
                                              : "";
  changed_ = true;
}

// The phase in words, as an operator reads it before a cause.
std::string Measurement::where() const {
  switch (stored_.state.phase) {
    case Phase::PLANNING:
      return "plan";
    case Phase::REPEATABILITY:
      return "repeatability of the probe";
    case Phase::MEASURING:
      return "pose " + stored_.state.pose;
    case Phase::RETRACTING:
      return "end";
    default:
      return "estimation";
  }
}

void Measurement::fail(const std::string& cause, std::uint32_t alarm, double now) {
  const auto prefix = where() + ": ";
  cause_ = (cause.starts_with(prefix) ? "" : prefix) + cause;
  stored_.state.error = text::shortened(cause_, most_error);
  stored_.state.alarm = alarm;
  stopping_since_ = now;
  hold_sent_ = false;
  run_.reset();
  request_.reset();
  asked_.reset();
  work_.reset();
  stale_ = searching_;
  change(Phase::STOPPING);
}

// Until the channel is at rest; a program of ours that runs is held. One that has called the cycle is told
// when it asks.
void Measurement::stop(double now) {
  if (stopping_since_ < 0) stopping_since_ = now;  // restored
  const auto* channel = machine_.state();
  const bool late = now - stopping_since_ > rest_within;
  if (channel == nullptr && !late && !caller_asks()) return;
  const bool executes_part = called() ? caller_ && !caller_->asks && !caller_->ended
                                      : channel != nullptr && channel->program == pose_program;
  if (machine_.running() && executes_part && !late) {
    if (!hold_sent_ && !asked_) {
      idl::channel::ChannelRequest hold;
      hold.channel = machine_.channel();
      hold.command = idl::channel::CommandKind::FEED_HOLD;
      hold_sent_ = true;
      ask(hold, now);
    }
    return;
  }
  auto& state = stored_.state;
  auto text = state.error;
  if (late)
    text += "; the channel does not come to rest";
  else if (channel != nullptr && channel->state != idl::channel::RunState::IDLE &&
           !(called() && machine_.running()))
    text +=
        std::string("; the channel is ") + bus::to_string(channel->state) + ", reset it before anything else";
  text += "; nothing written, " + std::to_string(state.complete) + " of " + std::to_string(state.poses) +
          " poses are complete";
  state.error = text::shortened(std::move(text), most_error);
  change(Phase::INTERRUPTED);
  if (caller_asks()) answer(idl::channel::CycleOutcome::REFUSED, state.error);
}

void Measurement::search(std::function<WayAnswer()> work) {
  work_ = [work = std::move(work)] {
    try {
      return work();
    } catch (const std::exception& e) {
      return WayAnswer{e.what(), {}, {}};
    }
  };
  searching_ = true;
}

void Measurement::plan_next(double) {
  if (searching_) return;
  if (!plan_->ways || planned_ >= plan_->plan.poses.size()) {
    change(Phase::REPEATABILITY);
    return;
  }
  search([plan = plan_, index = planned_, from = from_] {
    return WayAnswer{"", {}, plan->ways->check(plan->plan.poses[index], from)};
  });
}

void Measurement::worked(const WayAnswer& answer, double now) {
  searching_ = false;
  if (std::exchange(stale_, false)) return;
  if (!answer.error.empty()) return fail(answer.error, 0, now);
  if (stored_.state.phase == Phase::PLANNING) {
    ++planned_;
    from_ = answer.end;
    change(Phase::PLANNING);
  } else if (stage_ == Stage::search) {
    way_ = answer.way;
    stage_ = Stage::found;
  }
}

double Measurement::retract_height(const AxisPosition& from) const {
  const auto& travel = plan_->measured.outline.axes[2];
  return travel.present ? travel.high : from[2];
}

// The centre of the sphere at the initial pose: as measured before, or as expected.
Vec3 Measurement::centre_of_first() const {
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(plan_->measured.model));
  const auto& first = plan_->plan.poses.front();
  if (touches_->done().empty())
    return chain.machine_from_tip(plan_->inputs.sphere, first.angles, plan_->inputs.probe_length);
  const auto& positions = touches_->done().front().positions;
  const std::vector<Vec3> newest(positions.end() - static_cast<std::ptrdiff_t>(first.directions.size()),
                                 positions.end());
  const auto fit = metrology::fit_sphere(newest);
  if (const auto* error = std::get_if<metrology::SphereError>(&fit))
    throw std::runtime_error(std::string("stored touches: ") + metrology::to_string(*error));
  return std::get<metrology::SphereFit>(fit).centre;
}

Vec3 Measurement::centre() const {
  return stored_.state.phase == Phase::REPEATABILITY ? centre_of_first() : touches_->centre();
}

AxisPosition Measurement::target() const {
  if (stored_.state.phase == Phase::RETRACTING) {
    auto top = from_;
    top[2] = std::max(from_[2], retract_height(from_));
    return top;
  }
  const auto& pose =
      stored_.state.phase == Phase::REPEATABILITY ? plan_->plan.poses.front() : touches_->pose();
  return calibration::nearest_turns(plan_->measured.outline, from_,
                                    calibration::approach_position(plan_->inputs, pose, centre()));
}

// The second round begins where the first one has ended.
bool Measurement::over_pole() const {
  if (stored_.state.phase != Phase::MEASURING) return false;
  const auto to = target();
  const bool turned = !std::equal(to.begin() + 3, to.end(), from_.begin() + 3,
                                  [](double a, double b) { return std::abs(a - b) < 1e-3; });
  return !turned && (Vec3(from_[0], from_[1], from_[2]) - Vec3(to[0], to[1], to[2])).norm() <
                        plan_->inputs.measuring_path;
}

std::string Measurement::program_text() const {
  const auto& in = plan_->inputs;
  const auto& measured = plan_->measured;
  const calibration::ProgramEnd end{serial_,
                                    called() ? calibration::EndsWith::m99 : calibration::EndsWith::m30};
  switch (stored_.state.phase) {
    case Phase::REPEATABILITY:
      return calibration::repeatability_program(in, measured, plan_->plan.poses.front(), centre(), way_, end);
    case Phase::MEASURING:
      return calibration::measuring_program(in, measured, touches_->pose(), centre(), way_, end);
    default:
      return calibration::positioning_program(in, measured, way_, end);
  }
}

// One motion of a phase: its way, its program, and what it has measured.
void Measurement::drive(double now) {
  using Kind = GeneratedProgram::Kind;
  switch (stage_) {
    case Stage::way: {
      if (searching_) return;
      from_ = called() ? caller_->position : machine_.position();
      const auto to = target();
      if (over_pole()) {
        way_ = {from_, to};
        stage_ = Stage::found;
      } else if (!plan_->ways) {
        way_ = calibration::retract_way(from_, to, retract_height(from_));
        stage_ = Stage::found;
      } else {
        search([plan = plan_, from = from_, to] { return WayAnswer{"", plan->ways->way(from, to), {}}; });
        stage_ = Stage::search;
      }
      return;
    }
    case Stage::search:
      return;
    case Stage::found:
      ++serial_;
      run_.emplace(machine_.channel(), called() ? Kind::store : Kind::execute,
                   called() ? part_program : pose_program, program_text(), serial_);
      stage_ = Stage::program;
      break;
    case Stage::program:
      break;
    case Stage::called:
      if (!caller_->asks) return;
      if (!calibration::completed(caller_->values, serial_))
        throw std::runtime_error("the part of the measurement was not executed to its end");
      stage_ = Stage::way;
      executed(caller_->values, now);
      return;
  }
  run_->step(machine_, now);
  if (auto request = run_->take_request()) return ask(std::move(*request), now);
  if (run_->failed()) return fail(std::string(run_->error()), run_->alarm(), now);
  if (!run_->done()) return;
  if (called()) {
    answer(idl::channel::CycleOutcome::CALL, "", run_->revision());
    run_.reset();
    stage_ = Stage::called;
    return;
  }
  const auto variables = run_->variables();
  run_.reset();
  stage_ = Stage::way;
  executed(variables, now);
}

void Measurement::executed(const calibration::MacroVariables& variables, double now) {
  switch (stored_.state.phase) {
    case Phase::REPEATABILITY:
      check_repeatability(variables);
      change(touches_->finished() ? Phase::RETRACTING : Phase::MEASURING);
      return;
    case Phase::MEASURING:
      if (touches_->take(calibration::measured_positions(variables, touches_->pose().directions.size())))
        pose_done();
      return;
    default: {
      idl::program::ProgramRequest remove;
      remove.operation = idl::program::Operation::REMOVE;
      remove.name = called() ? part_program : pose_program;
      ask(remove, now);
      change(Phase::ESTIMATING);
      return;
    }
  }
}

void Measurement::pose_done() {
  const auto& touched = touches_->done().back();
  auto& pose = stored_.result.poses.emplace_back();
  pose.angles.assign(touched.angles.begin(), touched.angles.end());
  for (const auto& position : touched.positions)
    pose.touches.insert(pose.touches.end(), {position.x(), position.y(), position.z()});
  stored_.state.complete = static_cast<std::uint32_t>(touches_->done().size());
  change(touches_->finished() ? Phase::RETRACTING : Phase::MEASURING);
}

void Measurement::check_repeatability(const calibration::MacroVariables& variables) {
  const auto positions = calibration::measured_positions(variables, calibration::repeated_touches);
  const Vec3& tool = plan_->plan.poses.front().directions.back();
  const double range = calibration::range_along(positions, tool);
  stored_.state.repeatability = range;
  if (!(range <= plan_->inputs.repeatability))
    throw std::runtime_error(
        fmt::format("{} touches of one point differ by {:.2f} um, {:.2f} um is permitted: check the probe",
                    calibration::repeated_touches, um * range, um * plan_->inputs.repeatability));
  if (touches_->done().empty()) return;
  const double moved = (positions.back() - touches_->done().front().positions.back()).dot(tool);
  if (!(std::abs(moved) <= moved_tolerance))
    throw std::runtime_error(fmt::format(
        "the sphere is {:.1f} um from where the touches that are kept have it, {:.0f} um is permitted; "
        "start again",
        um * std::abs(moved), um * moved_tolerance));
}

void Measurement::estimate(double now) {
  const auto& in = plan_->inputs;
  const auto channel = machine_.channel();
  auto& state = stored_.state;
  auto& out = stored_.result;
  try {
    const auto result = calibration::evaluate(in, plan_->measured, touches_->done(),
                                              calibration::named_corrections(plan_->active, channel));
    for (std::size_t i = 0; i < out.poses.size() && i < result.poses.size(); ++i) {
      const auto& from = result.poses[i];
      auto& pose = out.poses[i];
      pose.centre = values(from.centre), pose.difference = values(from.difference);
      pose.residual = values(from.residual), pose.diameter = from.diameter;
    }
    out.vectors.clear();
    for (const auto& v : result.vectors)
      out.vectors.push_back({v.name, values(v.before), values(v.after), values(v.expanded),
                             values(v.direction_before), values(v.direction_after)});
    out.changes.clear();
    if (in.mode != calibration::Mode::measure_only)
      for (const auto& [number, value] :
           calibration::changed_parameters(result.before, result.after, channel))
        out.changes.push_back({number, plan_->active.at(number), value.value});
    out.largest_change = result.largest_change, out.touch_deviation = result.touch_deviation;
    const auto middle = std::min(state.time.find('T'), state.time.size());
    const auto clock = state.time.substr(std::min(middle + 1, state.time.size()), 8);
    out.protocol = text::shortened(
        calibration::protocol_text({state.time.substr(0, middle), clock, "-", "probe of the machine"}, in,
                                   plan_->measured, result),
        most_protocol);
    out.valid = true;
    state.tolerance_alarm = text::shortened(result.tolerance_alarm, most_text);
    state.tolerance_needs_reset = in.tolerance_needs_reset;
  } catch (const std::exception& e) {
    return fail(e.what(), 0, now);
  }
  change(out.changes.empty() ? Phase::FINISHED : Phase::WAITING);
  settle_caller();
}

// A change that waits for a reset is written, too.
bool Measurement::written_already() const {
  if (!set_) return false;
  const auto active = machine::parameters_of(*set_);
  return std::all_of(stored_.result.changes.begin(), stored_.result.changes.end(), [&](const auto& change) {
    for (const auto& pending : set_->pending)
      if (pending.number == change.number) return pending.value == change.after;
    return active.at(change.number) == change.after;
  });
}

void Measurement::write(double now) {
  if (restored_write_) {
    if (!set_) return;
    restored_write_ = false;
    stored_.state.written = written_already();
    if (!stored_.state.written)
      stored_.state.error =
          "the measurement process has ended before it wrote; nothing written, confirm again";
    change(stored_.state.written ? Phase::FINISHED : Phase::WAITING);
    return;
  }
  if (asked_) return;
  idl::parameters::ParameterRequest import;
  import.operation = idl::parameters::Operation::IMPORT;
  import.role = machine::role::builder;  // who has confirmed it is one
  import.who = stored_.state.who + calibration::calibrated_by;
  for (const auto& change : stored_.result.changes)
    import.values.push_back({change.number, change.after, ""});
  ask(import, now);
}

void Measurement::answered(std::size_t kind, const Answer& answer, double now) {
  if (asked_ != kind) return;
  asked_.reset();
  if (stored_.state.phase == Phase::WRITING) {
    stored_.state.written = answer.accepted || written_already();
    stored_.state.error =
        stored_.state.written ? "" : text::shortened("nothing written: " + answer.reason, most_error);
    change(stored_.state.written ? Phase::FINISHED : Phase::WAITING);
    settle_caller();
  } else if (run_) {
    run_->answered(answer, now);
  }
}

void Measurement::step(double now) {
  if (asked_ && now - asked_since_ > answer_within)
    answered(*asked_, {false, std::string(addressee(*asked_)) + " does not answer"}, now);
  watch_caller(now);
  try {
    switch (stored_.state.phase) {
      case Phase::PLANNING:
        return plan_next(now);
      case Phase::REPEATABILITY:
      case Phase::MEASURING:
      case Phase::RETRACTING:
        return drive(now);
      case Phase::ESTIMATING:
        return estimate(now);
      case Phase::WRITING:
        return write(now);
      case Phase::STOPPING:
        return stop(now);
      default:
        return;
    }
  } catch (const std::exception& e) {
    fail(e.what(), 0, now);
  }
}

}  // namespace trunnion::measurement
