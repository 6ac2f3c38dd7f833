// SPDX-License-Identifier: Apache-2.0
#include "core/measurement_requests.hpp"

#include "machine/roles.hpp"

namespace trunnion::gateway {
namespace {

using Order = idl::measurement::Operation;
using MeasurementMode = idl::measurement::Mode;

// Bounds of measurement.idl, and of the inputs of a measurement.
constexpr std::size_t most_inputs = 16384;
constexpr std::size_t most_author = 64;                // parameters.idl
constexpr double most_length = 1e5, most_probe = 1e4;  // mm

// Text of many lines, so not as commands::text.
std::string inputs_of(const bus::Json& value) {
  if (!value.is_string() || value.get_ref<const std::string&>().size() > most_inputs)
    throw BadRequest("inputs", "inputs must be YAML of at most " + std::to_string(most_inputs) + " bytes");
  return value.get<std::string>();
}

MeasurementMode mode_of(const bus::Json& value) {
  const auto name = commands::text(value, "mode", 20);
  if (name == "measure_only") return MeasurementMode::MEASURE_ONLY;
  if (name == "correct") return MeasurementMode::CORRECT;
  if (name == "only_correct") return MeasurementMode::ONLY_CORRECT;
  throw BadRequest("mode", "mode must be measure_only, correct or only_correct");
}

void fill_start(const bus::Json& body, idl::measurement::MeasurementRequest& request) {
  commands::only(body, {"channel", "inputs", "mode", "sphere_mm", "probe_length_mm", "retract"});
  if (body.contains("channel"))
    request.channel = static_cast<std::uint16_t>(commands::whole(body["channel"], "channel", 0, 65535));
  if (body.contains("inputs")) request.inputs = inputs_of(body["inputs"]);
  if (body.contains("mode")) request.mode = mode_of(body["mode"]);
  if (body.contains("sphere_mm")) {
    const auto& sphere = body["sphere_mm"];
    if (!sphere.is_array() || sphere.size() != 3)
      throw BadRequest("sphere_mm", "sphere_mm must be X, Y and Z");
    for (const auto& value : sphere)
      request.sphere.push_back(commands::number(value, "sphere_mm", -most_length, most_length));
  }
  if (body.contains("probe_length_mm"))
    request.probe_length = {commands::number(body["probe_length_mm"], "probe_length_mm", 0, most_probe)};
  if (body.contains("retract")) request.retract = commands::boolean(body["retract"], "retract");
}

idl::parameters::ParameterRequest import_by(const std::string& who, const std::string& suffix) {
  idl::parameters::ParameterRequest request;
  request.role = machine::role::builder;  // who may write these is one
  request.operation = idl::parameters::Operation::IMPORT;
  request.who = who.substr(0, most_author - suffix.size()) + suffix;
  return request;
}

}  // namespace

idl::measurement::MeasurementRequest measurement_request(Operation operation, const bus::Json& body) {
  idl::measurement::MeasurementRequest request;
  switch (operation) {
    case Operation::measurement_start:
      request.operation = Order::START;
      fill_start(body, request);
      return request;
    case Operation::measurement_confirm:
      request.operation = Order::CONFIRM;
      commands::only(body, {"acknowledge"});
      request.acknowledge =
          body.contains("acknowledge") && commands::boolean(body["acknowledge"], "acknowledge");
      return request;
    case Operation::measurement_continue:
      request.operation = Order::CONTINUE;
      break;
    case Operation::measurement_abort:
      request.operation = Order::ABORT;
      break;
    default:
      request.operation = Order::DISCARD;
  }
  commands::only(body, {});
  return request;
}

idl::parameters::ParameterRequest calibration_request(
    const std::map<std::uint32_t, machine::ParameterValue>& values, const std::string& who) {
  auto request = import_by(who, calibration::calibrated_by);
  for (const auto& [number, value] : values) request.values.push_back({number, value.value, ""});
  return request;
}

idl::parameters::ParameterRequest undo_request(const calibration::LastCalibration& last,
                                               const std::string& who) {
  auto request = import_by(who, calibration::undone_by);
  for (const auto& [number, value] : last.before) request.values.push_back({number, value, ""});
  return request;
}

bus::Json calibration_answer(const calibration::LastCalibration& last) {
  auto changes = bus::Json::array();
  for (const auto& [number, value] : last.before)
    changes.push_back({{"number", number}, {"before", value}, {"after", last.after.at(number)}});
  return {{"time", last.time}, {"who", last.who}, {"changes", std::move(changes)}};
}

}  // namespace trunnion::gateway
