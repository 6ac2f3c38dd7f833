// SPDX-License-Identifier: Apache-2.0
#include "measurement_session.hpp"

#include <cstdio>
#include <stdexcept>

#include "figures.hpp"
#include "interrupt_watch.hpp"
#include "parameter_request.hpp"

namespace trunnion::cli {
namespace {

using idl::measurement::MeasurementRequest;
using idl::measurement::MeasurementState;
using idl::measurement::Operation;
using idl::measurement::Phase;

constexpr double heard_within = 15;   // s: of the start
constexpr double answer_within = 30;  // s: planning of the poses before the answer
constexpr std::size_t most_user = 48;

bool at_end(Phase phase) {
  return phase == Phase::NOTHING || phase == Phase::WAITING || phase == Phase::INTERRUPTED ||
         phase == Phase::FINISHED;
}

}  // namespace

MeasurementSession::MeasurementSession(std::uint32_t domain)
    : client_(domain),
      requests_(client_.bus(), topics::measurement_request, topics::measurement_reply),
      states_(client_.bus().reader(topics::measurement_state)) {
  const double until = service::monotonic_seconds() + heard_within;
  while (!states_.take_newest(state_)) {
    if (service::monotonic_seconds() > until)
      throw std::runtime_error(
          "the cluster has no measurement service: add `- {service: measurement}` to its machine.yaml");
    client_.bus().signal().wait(0.01);
  }
}

std::uint64_t MeasurementSession::order(MeasurementRequest request) {
  request.who = user_name().substr(0, most_user);
  const auto operation = request.operation;
  const auto reply = requests_.call(std::move(request), answer_within);
  if (!reply)
    throw std::runtime_error(
        service::silence("the measurement service", answer_within, requests_.connected()));
  if (!reply->accepted) throw std::runtime_error(reply->reason);
  const bool moves = operation == Operation::START || operation == Operation::CONTINUE;
  shown_ = operation == Operation::START ? 0 : state().complete;
  planned_ = repeated_ = !moves;
  return reply->measurement;
}

std::uint64_t MeasurementSession::order(Operation operation) {
  MeasurementRequest request;
  request.operation = operation;
  return order(std::move(request));
}

const MeasurementState& MeasurementSession::state() {
  MeasurementState newer;
  while (states_.take(newer)) state_ = newer;
  return state_;
}

void MeasurementSession::show(const MeasurementState& state) {
  if (!planned_ && state.phase != Phase::PLANNING) {
    planned_ = true;
    if (state.phase == Phase::REPEATABILITY)
      std::fprintf(stderr, "moves between %u poses are planned\n", state.poses);
  }
  if (!repeated_ && state.repeatability >= 0) {
    repeated_ = true;
    std::fprintf(stderr, "repeatability of the probe: %.2f um\n", um * state.repeatability);
  }
  for (; shown_ < state.complete; ++shown_)
    std::fprintf(stderr, "pose %u of %u is complete\n", shown_ + 1, state.poses);
}

void MeasurementSession::follow(std::uint64_t measurement) {
  const InterruptWatch watch;
  bool aborted = false;
  for (;;) {
    MeasurementState newer;
    while (states_.take(newer)) {
      state_ = newer;
      if (state_.measurement == measurement) show(state_);
    }
    if (state_.measurement == measurement && at_end(state_.phase)) break;
    if (InterruptWatch::requested() && !aborted) {
      aborted = true;
      order(Operation::ABORT);
    }
    client_.bus().signal().wait(0.05);
  }
  if (state_.phase == Phase::INTERRUPTED)
    throw std::runtime_error(state_.error + (state_.complete > 0 ? ": --resume continues after them" : ""));
  if (state_.phase == Phase::NOTHING) throw std::runtime_error("the measurement was discarded");
}

idl::measurement::MeasurementResult MeasurementSession::result() {
  return client_.newest(topics::measurement_result);
}

std::vector<calibration::TouchedPose> touched_poses(const idl::measurement::MeasurementResult& result) {
  std::vector<calibration::TouchedPose> poses;
  for (const auto& kept : result.poses) {
    auto& pose = poses.emplace_back();
    std::copy_n(kept.angles.begin(), std::min(kept.angles.size(), pose.angles.size()), pose.angles.begin());
    for (std::size_t i = 0; i + 2 < kept.touches.size(); i += 3)
      pose.positions.emplace_back(kept.touches[i], kept.touches[i + 1], kept.touches[i + 2]);
  }
  return poses;
}

}  // namespace trunnion::cli
