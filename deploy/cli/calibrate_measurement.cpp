// SPDX-License-Identifier: Apache-2.0
// calibrate status, continue, abort, confirm, discard: the measurement of the cluster that runs
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "calibration_result.hpp"
#include "cluster/cluster.hpp"
#include "cluster/operating_station.hpp"
#include "figures.hpp"
#include "machine/parameters.hpp"
#include "measurement_session.hpp"

namespace trunnion::cli {
namespace {

using idl::measurement::MeasurementResult;
using idl::measurement::MeasurementState;
using idl::measurement::Operation;
using idl::measurement::Phase;

void print_state(const MeasurementState& state, const MeasurementResult* result) {
  if (state.phase == Phase::NOTHING) {
    print("no measurement");
    return;
  }
  print("measurement {} of channel {}, {} by {}: {}, {} of {} poses are complete, {:.0f} %",
        state.measurement, state.channel, state.time, state.who.empty() ? "-" : state.who,
        bus::to_string(state.phase), state.complete, state.poses, 100 * state.progress);
  if (!state.detail.empty()) print("{}", state.detail);
  if (!state.error.empty()) print("{}", state.error);
  if (!state.tolerance_alarm.empty()) print("{}", state.tolerance_alarm);
  if (result != nullptr && result->valid) {
    std::fputs(result->protocol.c_str(), stdout);
    for (const auto& change : result->changes)
      print("{}: {:.6f} -> {:.6f}", machine::number_text(change.number), change.before, change.after);
  }
  if (state.may_continue) print("trunnion calibrate continue measures the other poses, discard gives it up");
  if (state.may_confirm) print("trunnion calibrate confirm writes the parameters, discard gives them up");
  if (state.phase == Phase::FINISHED)
    print("{}", state.written ? "written; active after a reset of the channel" : "nothing was to be written");
}

int status(const Common& common) {
  MeasurementSession session(cluster::find_cluster(common.domain).run.domain);
  const auto& state = session.state();
  std::optional<MeasurementResult> result;
  if (state.measurement > 0) result = session.result();
  if (common.json) {
    bus::Json json = {{"state", bus::to_json(state)}};
    if (result) json["result"] = bus::to_json(*result);
    std::cout << bus::text_of(json, 2) << "\n";
  } else {
    print_state(state, result ? &*result : nullptr);
  }
  return 0;
}

struct Order {
  Operation operation = Operation::ABORT;
  bool acknowledge = false, detach = false, take_right = false;
};

int carry_out(const Common& common, const Order& order) {
  const auto domain = cluster::find_cluster(common.domain).run.domain;
  const cluster::OperatingStation station(domain, order.take_right);
  MeasurementSession session(domain);
  idl::measurement::MeasurementRequest request;
  request.operation = order.operation;
  request.acknowledge = order.acknowledge;
  const auto number = session.order(std::move(request));
  if (!order.detach) {
    try {
      session.follow(number);
    } catch (const std::exception&) {
      // An abort ends so, and a discarded measurement is gone.
      if (order.operation != Operation::ABORT && order.operation != Operation::DISCARD) throw;
    }
  }
  const auto& state = session.state();
  if (order.operation == Operation::CONFIRM && !order.detach && !state.written)
    throw std::runtime_error(state.error);
  if (common.json)
    std::cout << bus::text_of(bus::to_json(state)) << "\n";
  else
    print_state(state, nullptr);
  return 0;
}

}  // namespace

void add_calibrate_measurement(CLI::App& calibrate, Common& common) {
  add_command(calibrate, common, "status",
              "Phase, poses, result and error of the measurement in the cluster that runs",
              [&common] { return status(common); });
  const auto add = [&](const char* name, const char* about, Operation operation) {
    auto order = std::make_shared<Order>();
    order->operation = operation;
    auto* command =
        add_command(calibrate, common, name, about, [order, &common] { return carry_out(common, *order); });
    command->add_flag("--take-right", order->take_right, cluster::take_right_help);
    return std::pair(command, order);
  };
  const auto [go_on, going] = add("continue",
                                  "Continue the measurement that was interrupted, after its complete poses; "
                                  "Ctrl-C aborts it",
                                  Operation::CONTINUE);
  go_on->add_flag("--detach", going->detach, "Return when it has started");
  add("abort", "Hold the channel and interrupt the measurement; nothing is written, complete poses are kept",
      Operation::ABORT);
  const auto [confirm, confirming] =
      add("confirm", "Write the parameters that the measurement has found; active after a reset",
          Operation::CONFIRM);
  confirm->add_flag("--acknowledge", confirming->acknowledge,
                    "Although a vector changes by more than its tolerance");
  add("discard", "Give up what is kept of a measurement; no parameter is changed", Operation::DISCARD);
}

}  // namespace trunnion::cli
