// SPDX-License-Identifier: Apache-2.0
#include "resources/measurement.hpp"

#include "calibration/offered_inputs.hpp"
#include "core/cluster_state.hpp"
#include "core/manual_calibration_document.hpp"
#include "core/measurement_requests.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/kinematics.hpp"
#include "machine/yaml.hpp"

namespace trunnion::gateway {
namespace {

constexpr std::size_t most_author = 48;  // measurement.idl

const std::string& author(const RequestText& text) { return text.user ? text.user->name : text.peer; }

Answer newest_measurement(const Mailbox& mailbox) {
  const auto cluster = mailbox.newest();
  if (!cluster || !cluster->measurement)
    return problem_answer(504, "the machine has no measurement service, or it has not published yet");
  bus::Json body = {{"state", bus::to_json(*cluster->measurement)}};
  if (cluster->measurement_result) body["result"] = bus::to_json(*cluster->measurement_result);
  return json_answer(200, body);
}

// All values or none. The answer is `document` with how many of them wait for a reset or a restart.
void submit_import(Mailbox& mailbox, idl::parameters::ParameterRequest request, bus::Json document,
                   const Respond& respond) {
  mailbox.post(
      [request = std::move(request), document = std::move(document), respond](Links& links, double now) {
        links.parameters.submit(
            request,
            [document, respond](const auto& asked, const auto& reply) {
              auto body = document;
              if (reply) body["pending"] = reply->pending;
              auto answer = !reply            ? problem_answer(504, "no answer from the parameters service")
                            : reply->accepted ? json_answer(200, body)
                                              : problem_answer(409, reply->reason);
              answer.asked = {asked.client, asked.number, 1};
              respond(std::move(answer));
            },
            now);
      });
}

struct Refused : std::runtime_error {
  Refused(unsigned status_, const std::string& why) : std::runtime_error(why), status(status_) {}
  unsigned status;
};

// What the manual calibration begins from: the active parameters of a channel.
struct ManualStart {
  std::uint16_t channel = 0;
  calibration::ChainParameters chain;
  calibration::ManualKind kind{};
};

ManualStart manual_start(const Mailbox& mailbox, std::uint32_t channel) {
  const auto cluster = mailbox.newest();
  if (!cluster || !cluster->parameters) throw Refused(504, "the parameters service has not published yet");
  ManualStart start{static_cast<std::uint16_t>(channel), {}, {}};
  if (!cluster->channels.contains(start.channel)) throw Refused(404, "no channel " + std::to_string(channel));
  for (const auto& pending : cluster->parameters->pending)
    if (machine::is_chain_parameter(pending.number))
      throw Refused(409, "parameter " + machine::number_text(pending.number) +
                             " of the kinematics waits for a reset: reset the channel first");
  start.chain = machine::chain_parameters(*cluster->values, start.channel);
  const auto kind = calibration::manual_kind(start.chain);
  if (!kind)
    throw Refused(409, std::string(calibration::manual_machines) + ": measure this machine with the probe");
  start.kind = *kind;
  return start;
}

}  // namespace

void KinematicMeasurement::handle(const Match& match, const RequestText& request, const Respond& respond) {
  try {
    switch (match.operation) {
      case Operation::measurement:
        return respond(newest_measurement(mailbox_));
      case Operation::measurement_inputs:
        return answer_inputs(request.query, respond);
      case Operation::measurement_last:
        return with_last(
            respond, [respond](const auto& last) { respond(json_answer(200, calibration_answer(last))); });
      case Operation::measurement_undo:
        return undo(request, respond);
      case Operation::manual_calibration:
        return respond(manual_guide(request.query));
      case Operation::manual_evaluation:
      case Operation::manual_write:
        return manual(match.operation == Operation::manual_write, request, respond);
      default:
        return order(match.operation, request, respond);
    }
  } catch (const BadRequest& bad) {
    respond(problem_answer(400, bad.what(), bad.field));
  }
}

void KinematicMeasurement::order(Operation operation, const RequestText& text, const Respond& respond) {
  auto request = measurement_request(operation, parse_body(text.body));
  request.who = author(text).substr(0, most_author);
  mailbox_.post([request = std::move(request), respond](Links& links, double now) {
    links.measurement.submit(
        request,
        [respond](const auto& asked, const auto& reply) {
          auto answer = !reply ? problem_answer(504, "no answer from the measurement service")
                        : reply->accepted
                            ? json_answer(200, {{"accepted", true}, {"measurement", reply->measurement}})
                            : problem_answer(409, reply->reason);
          answer.asked = {asked.client, asked.number, 1};
          respond(std::move(answer));
        },
        now);
  });
}

void KinematicMeasurement::answer_inputs(const std::string& query, const Respond& respond) {
  const auto text = query_value(query, "channel");
  const auto channel = path_number(text.empty() ? "0" : text, 65535);
  const auto cluster = mailbox_.newest();
  if (!cluster || !cluster->parameters)
    return respond(problem_answer(504, "the parameters service has not published yet"));
  if (!channel || !cluster->channels.contains(static_cast<std::uint16_t>(*channel)))
    return respond(problem_answer(404, "no channel " + text));
  const bool taken = files_.offer([this, cluster, number = static_cast<std::uint16_t>(*channel), respond] {
    try {
      const auto machine = calibration::load_measured_machine(settings_.machine, *cluster->values, number);
      const auto inputs = calibration::default_inputs(machine);
      if (const auto fault = calibration::fault_of(inputs, machine); !fault.empty())
        return respond(problem_answer(409, fault));
      respond(json_answer(200, {{"channel", number},
                                {"inputs", calibration::input_document(inputs)},
                                {"travel", calibration::travel_document(inputs, machine)}}));
    } catch (const std::exception& error) {
      respond(problem_answer(409, error.what()));
    }
  });
  if (!taken) respond(busy_answer());
}

void KinematicMeasurement::with_last(const Respond& respond,
                                     std::function<void(const calibration::LastCalibration&)> then) {
  const bool taken = files_.offer([this, respond, then = std::move(then)] {
    if (!std::filesystem::exists(settings_.journal))
      return respond(problem_answer(
          409,
          "the journal of the parameters is not there: nothing was changed yet, or the service parameters "
          "runs on another computer"));
    calibration::LastCalibration last;
    try {
      last = calibration::last_calibration(machine::read_text(settings_.journal));
    } catch (const std::exception& error) {
      return respond(problem_answer(409, error.what()));
    }
    then(last);
  });
  if (!taken) respond(busy_answer());
}

void KinematicMeasurement::undo(const RequestText& text, const Respond& respond) {
  commands::only(parse_body(text.body), {});
  with_last(respond, [this, who = author(text), respond](const calibration::LastCalibration& last) {
    submit_import(mailbox_, undo_request(last, who), calibration_answer(last), respond);
  });
}

Answer KinematicMeasurement::manual_guide(const std::string& query) const {
  const auto language = guide_language(query_value(query, "language"));
  const auto channel = query_value(query, "channel"), angle = query_value(query, "alpha");
  const auto number = path_number(channel.empty() ? "0" : channel, 65535);
  const auto alpha = path_number(angle.empty() ? "30" : angle, 90);
  if (!number) throw BadRequest("channel", "channel must be a number");
  if (!alpha || *alpha < 5) throw BadRequest("alpha", "alpha must be a whole number within 5 .. 90 deg");
  try {
    const auto start = manual_start(mailbox_, *number);
    auto document = guide_document(start.kind, language, *alpha, start.chain);
    document["channel"] = start.channel;
    return json_answer(200, document);
  } catch (const Refused& refused) {
    return problem_answer(refused.status, refused.what());
  }
}

void KinematicMeasurement::manual(bool write, const RequestText& text, const Respond& respond) {
  const auto body = parse_body(text.body);
  const auto channel = body.contains("channel") ? commands::whole(body["channel"], "channel", 0, 65535) : 0;
  ManualEvaluation result;
  try {
    const auto start = manual_start(mailbox_, static_cast<std::uint32_t>(channel));
    result = evaluate_manual(body, start.kind, start.chain, start.channel);
  } catch (const BadRequest&) {
    throw;
  } catch (const Refused& refused) {
    return respond(problem_answer(refused.status, refused.what()));
  } catch (const std::runtime_error& error) {  // of the catalogue
    return respond(problem_answer(409, error.what()));
  }
  result.document["pending"] = 0;
  if (!write || result.values.empty()) return respond(json_answer(200, result.document));
  submit_import(mailbox_, calibration_request(result.values, author(text)), std::move(result.document),
                respond);
}

}  // namespace trunnion::gateway
