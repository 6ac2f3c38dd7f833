// SPDX-License-Identifier: Apache-2.0
// calibrate kinematics: touches of a sphere over poses of the rotary axes
#include <CLI/CLI.hpp>
#include <ctime>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "calibration/chain_change.hpp"
#include "calibration/measurement_file.hpp"
#include "calibration/measurement_moves.hpp"
#include "calibration/program_variables.hpp"
#include "calibration/protocol.hpp"
#include "calibration/sphere_check.hpp"
#include "calibration/virtual_gauges.hpp"
#include "calibration_result.hpp"
#include "cluster/cluster.hpp"
#include "cluster/operating_station.hpp"
#include "collision_machine.hpp"
#include "figures.hpp"
#include "machine/yaml.hpp"
#include "measurement_session.hpp"
#include "report/residual_picture.hpp"
#include "storage/file.hpp"
#include "text/instant.hpp"
#include "variables_command.hpp"

namespace trunnion::cli {
namespace {

using calibration::Mode;
using calibration::Vec3;

struct KinematicsOptions {
  CalibrationTarget target;
  std::string inputs, mode, sphere, true_sphere, touches, save_touches, protocol, plot, date, reference;
  std::optional<double> probe_length, repeatability, pre_travel, lobing;  // mm, um
  std::optional<std::uint64_t> seed;
  std::size_t check = 0;
  bool virtual_probe = false, resume = false, retract = false, propose = false, acknowledge = false;
  bool detach = false, take_right = false, variables = false;
};

void check_source(const KinematicsOptions& o) {
  if (o.propose) return;
  if (o.virtual_probe + o.target.running + o.variables + !o.touches.empty() != 1)
    throw std::runtime_error(
        "give one of --virtual, --on-machine, --variables and --touches FILE as the source of the touches");
  if (o.resume && !o.target.running)
    throw std::runtime_error("--resume continues a measurement --on-machine");
  if (o.detach && !o.target.running) throw std::runtime_error("--detach leaves a measurement --on-machine");
}

calibration::MeasurementInputs inputs_of(const KinematicsOptions& o,
                                         const calibration::MeasuredMachine& machine) {
  auto in = o.inputs.empty() ? calibration::default_inputs(machine)
                             : calibration::parse_inputs(machine::read_text(o.inputs), o.inputs, machine);
  if (!o.mode.empty())
    in.mode = o.mode == "correct"        ? Mode::correct
              : o.mode == "only_correct" ? Mode::only_correct
                                         : Mode::measure_only;
  if (!o.sphere.empty()) in.sphere = vector_option("--sphere", o.sphere);
  if (o.probe_length) in.probe_length = *o.probe_length;
  if (const auto fault = fault_of(in, machine); !fault.empty()) throw std::runtime_error(fault);
  if (in.mode == Mode::measure_only && (o.target.write || !o.target.output.empty()))
    throw std::runtime_error("the mode is measure_only: nothing may be written; give --mode correct");
  if (in.mode == Mode::only_correct && o.touches.empty() && !o.variables)
    throw std::runtime_error("the mode is only_correct: give the stored touches with --touches FILE");
  return in;
}

// "2026-01-31T12:00:00", by the clock when it is not given.
std::pair<std::string, std::string> date_of(const std::string& given) {
  const std::string date = given.empty() ? text::whole_second(std::time(nullptr)).substr(0, 19) : given;
  std::tm parts{};
  const char* end = strptime(date.c_str(), "%Y-%m-%dT%H:%M:%S", &parts);
  if (end == nullptr || *end != 0 || date.size() != 19)
    throw std::runtime_error("--date " + date + ": expected YYYY-MM-DDTHH:MM:SS");
  return {date.substr(0, 10), date.substr(11)};
}

// That of the file, unless the inputs have it.
void take_reference(const KinematicsOptions& o, calibration::MeasurementInputs& in) {
  if (in.reference == calibration::Reference::without || in.reference_measurement) return;
  if (o.reference.empty()) throw std::runtime_error("a reference needs its file: --reference FILE");
  if (in.reference == calibration::Reference::adapt)
    in.reference_measurement = calibration::parse_reference(machine::read_text(o.reference), o.reference);
}

bus::Json json_of(const calibration::KinematicsResult& r, const calibration::MeasuredMachine& machine,
                  const calibration::MeasurementInputs& in) {
  bus::Json out = {{"machine", machine.name},
                   {"type", metrology::to_string(metrology::kinematic_type(machine.model))},
                   {"sphere_mm", vector_json(r.sphere)},
                   {"ball_diameter_mm", r.ball_diameter},
                   {"touch_deviation_mm", r.touch_deviation},
                   {"degrees_of_freedom", r.freedom},
                   {"condition", r.condition},
                   {"largest_change_mm", r.largest_change},
                   {"directions_written", in.write_directions},
                   {"tolerance_alarm", r.tolerance_alarm},
                   {"warnings", r.warnings},
                   {"not_observed", r.not_observed}};
  for (const auto& pose : r.poses)
    out["poses"].push_back({{"pose", calibration::pose_name(pose.angles, machine.model)},
                            {"touches", pose.touches},
                            {"centre_mm", vector_json(pose.centre)},
                            {"difference_mm", vector_json(pose.difference)},
                            {"residual_mm", vector_json(pose.residual)},
                            {"diameter_mm", pose.diameter}});
  for (const auto& one : r.corrections)
    out["corrections"].push_back({{"name", one.name},
                                  {"axis", std::string(1, "ABCUVW"[one.angle])},
                                  {"before_mm", vector_json(one.before)},
                                  {"circles_mm", vector_json(one.circles)},
                                  {"all_poses_mm", vector_json(one.all_poses)}});
  for (const auto& v : r.vectors)
    out["vectors"].push_back({{"axis", v.name},
                              {"offset_before_mm", vector_json(v.before)},
                              {"offset_after_mm", vector_json(v.after)},
                              {"offset_uncertainty_95_mm", vector_json(v.expanded)},
                              {"offset_with_real_directions_mm", vector_json(v.with_directions)},
                              {"observed", v.observed},
                              {"direction_ideal", vector_json(v.direction_before)},
                              {"direction_real", vector_json(v.direction_after)},
                              {"direction_uncertainty_95", vector_json(v.direction_expanded)}});
  return out;
}

bus::Json json_of(const calibration::CheckSummary& s) {
  return {{"largest_um", vector_json(Vec3(um * s.largest))},
          {"root_mean_square_um", um * s.root_mean_square}};
}

void print_rtcp(const calibration::RtcpCheck& check) {
  print("RTCP with the sphere over {} random poses, displacement from the initial pose:", check.poses);
  for (const auto& [name, s] : {std::pair{"before", &check.before}, {"after", &check.after}})
    print("{:<7} largest X {:.1f}, Y {:.1f}, Z {:.1f} um; root mean square {:.1f} um", name,
          um * s->largest.x(), um * s->largest.y(), um * s->largest.z(), um * s->root_mean_square);
}

// Of the virtual probe and sphere, in mm.
calibration::GaugeChanges changes_of(const KinematicsOptions& o) {
  const auto in_mm = [](std::optional<double> value) {
    if (value) *value /= um;
    return value;
  };
  calibration::GaugeChanges changes{in_mm(o.repeatability), in_mm(o.pre_travel), in_mm(o.lobing), o.seed, {}};
  if (!o.true_sphere.empty()) changes.sphere = vector_option("--true-sphere", o.true_sphere);
  return changes;
}

idl::measurement::MeasurementRequest measurement_request(const KinematicsOptions& o,
                                                         const calibration::MeasurementInputs& in) {
  using idl::measurement::Mode;
  using idl::measurement::Operation;
  idl::measurement::MeasurementRequest request;
  request.operation = o.resume ? Operation::CONTINUE : Operation::START;
  request.channel = o.target.channel;
  if (!o.inputs.empty()) request.inputs = machine::read_text(o.inputs);
  if (in.reference == calibration::Reference::adapt && !o.reference.empty())
    request.inputs += "\nreference_measurement: " + calibration::text_of(*in.reference_measurement);
  constexpr std::size_t most_inputs = 16384;  // idl/measurement.idl
  if (request.inputs.size() > most_inputs)
    throw std::runtime_error(o.inputs + ": has " + std::to_string(request.inputs.size()) +
                             " bytes; at most " + std::to_string(most_inputs) + " are permitted");
  if (o.mode == "correct") request.mode = Mode::CORRECT;
  if (o.mode == "measure_only") request.mode = Mode::MEASURE_ONLY;
  if (!o.sphere.empty()) {
    const auto sphere = vector_option("--sphere", o.sphere);
    request.sphere = {sphere.x(), sphere.y(), sphere.z()};
  }
  if (o.probe_length) request.probe_length = {*o.probe_length};
  request.retract = o.retract;
  return request;
}

// Writes what the service has found; it must be what was printed.
void confirm_on_machine(MeasurementSession& session, const KinematicsOptions& o,
                        const std::map<std::uint32_t, machine::ParameterValue>& values) {
  std::map<std::uint32_t, machine::ParameterValue> found;
  for (const auto& change : session.result().changes) found[change.number] = {change.after, ""};
  if (found != values)
    throw std::runtime_error(
        "the measurement was started with other inputs; nothing written: give the same inputs, or write with "
        "`trunnion calibrate confirm`");
  idl::measurement::MeasurementRequest request;
  request.operation = idl::measurement::Operation::CONFIRM;
  request.acknowledge = o.acknowledge;
  session.follow(session.order(std::move(request)));
  if (!session.state().written) throw std::runtime_error(session.state().error);
}

// The ranges in which the probe reaches the sphere, as a file of inputs has them.
void propose_ranges(const calibration::MeasurementMoves& moves,
                    const calibration::MeasuredMachine& measured) {
  const auto in = moves.proposal();
  const auto plan = calibration::plan_measurement(in, measured);
  if (const auto* fault = std::get_if<std::string>(&plan)) throw std::runtime_error(*fault);
  std::fputs("axes:\n", stdout);
  for (const auto& range : in.axes)
    print("  {}: {{start_deg: {:.6g}, end_deg: {:.6g}, points: {}, other_deg: {:.6g}}}",
          "ABCUVW"[range.angle], range.start, range.end, range.points, range.other);
}

int detached(const Common& common, std::uint64_t number) {
  if (common.json)
    std::cout << bus::Json{{"measurement", number}}.dump() << "\n";
  else
    print("measurement {} is under way: trunnion calibrate status, abort, confirm", number);
  return 0;
}

int kinematics(const KinematicsOptions& o, const Common& common) {
  check_source(o);
  const auto date = date_of(o.date);
  const auto machine = load_calibrated_machine(o.target, common);
  const auto measured = measured_machine(machine, o.target.channel);
  auto in = inputs_of(o, measured);
  if (o.propose) {
    propose_ranges(calibration::MeasurementMoves(load_bodies(machine, o.target.machine, o.target.channel),
                                                 machine.truth.solids, machine.truth.probe, in, measured),
                   measured);
    return 0;
  }
  take_reference(o, in);
  if (o.check > 0 && (!o.touches.empty() || o.variables))
    throw std::runtime_error("--check needs the true machine: --virtual or a simulated one --on-machine");
  std::optional<cluster::OperatingStation> station;
  std::optional<MeasurementSession> session;
  std::vector<calibration::TouchedPose> touched;
  if (o.target.running) {
    const auto domain = cluster::find_cluster(common.domain).run.domain;
    station.emplace(domain, o.take_right);
    session.emplace(domain);
    const auto number = session->order(measurement_request(o, in));
    if (o.detach) return detached(common, number);
    session->follow(number);
    touched = touched_poses(session->result());
  } else if (o.variables) {
    const auto variables = newest_variables(common, o.target.channel);
    std::map<std::uint32_t, double> values;
    for (std::size_t i = 0; i < variables.numbers.size(); ++i)
      values[variables.numbers[i]] = variables.values[i];
    auto measured_by_program = calibration::measurement_of(values, std::move(in), measured);
    in = std::move(measured_by_program.inputs), touched = std::move(measured_by_program.touched);
    if (const auto fault = fault_of(in, measured); !fault.empty()) throw std::runtime_error(fault);
  } else if (o.touches.empty()) {
    const auto made = calibration::plan_measurement(in, measured);
    if (const auto* fault = std::get_if<std::string>(&made)) throw std::runtime_error(*fault);
    const auto changes = changes_of(o);
    touched = calibration::touch_virtually(*machine.report, in, measured,
                                           std::get<calibration::MeasurementPlan>(made),
                                           calibration::true_probe(machine.truth, in, changes),
                                           calibration::true_solids(machine.truth, in, changes));
  } else {
    touched = calibration::parse_touches(machine::read_text(o.touches), o.touches, measured.model);
  }
  if (!o.save_touches.empty())
    storage::replace_file(o.save_touches, calibration::text_of(touched, measured.model));
  const auto result = calibration::evaluate(in, measured, touched,
                                            calibration::named_corrections(machine.model, o.target.channel));
  const auto text =
      calibration::protocol_text({date.first, date.second, o.protocol.empty() ? "-" : o.protocol,
                                  o.virtual_probe    ? "virtual probe"
                                  : o.target.running ? "probe of the machine"
                                  : o.variables      ? "program %001"
                                                     : o.touches},
                                 in, measured, result);
  if (!o.protocol.empty()) storage::replace_file(o.protocol, text);
  if (!o.plot.empty())
    storage::replace_file(
        o.plot, report::residual_picture(result, measured.name + ": measurement of the kinematics"));
  auto out = json_of(result, measured, in);
  if (!common.json) std::fputs(text.c_str(), stdout);
  if (o.check > 0) {
    const auto check = calibration::check_rtcp(*machine.report, measured, in, result.before, result.after,
                                               o.check, o.seed.value_or(1));
    out["rtcp_check"] = {
        {"poses", check.poses}, {"before", json_of(check.before)}, {"after", json_of(check.after)}};
    if (!common.json) print_rtcp(check);
  }
  std::fflush(stdout);
  if (in.reference == calibration::Reference::measure)
    storage::replace_file(o.reference, calibration::text_of({result.sphere, in.zero_offset}));
  if (!result.tolerance_alarm.empty() && in.mode != Mode::measure_only) {
    if (in.tolerance_needs_reset)
      throw std::runtime_error(result.tolerance_alarm + "; nothing written, reset");
    if (!o.acknowledge)
      throw std::runtime_error(result.tolerance_alarm +
                               "; nothing written, --acknowledge writes in spite of it");
  }
  int status = 0;
  if (in.mode != Mode::measure_only)
    status = write_change(
        o.target, common, result.before, result.after,
        session ? [&](const auto& values) { confirm_on_machine(*session, o, values); } : ChangeWriter());
  if (common.json) std::cout << bus::text_of(out) << "\n";
  return status;
}

}  // namespace

void add_calibrate_kinematics(CLI::App& calibrate, Common& common) {
  auto options = std::make_shared<KinematicsOptions>();
  auto& o = *options;
  auto* command = add_command(calibrate, common, "kinematics",
                              "Measure the rotary axes with a probe and a sphere (as CYCLE9960), compute "
                              "offset and direction vectors with "
                              "their uncertainty, write the offsets",
                              [options, &common] { return kinematics(*options, common); });
  add_target_options(*command, o.target);
  command->add_option("--inputs", o.inputs,
                      "YAML with inputs and settings (docs/calibration.md); without it 8 "
                      "points of every rotary axis");
  command->add_option("--mode", o.mode, "measure_only (default), correct, only_correct (from stored touches)")
      ->check(CLI::IsMember({"measure_only", "correct", "only_correct"}));
  command->add_option("--sphere", o.sphere, "Expected centre X,Y,Z of the sphere in the workpiece frame, mm");
  command->add_option("--probe-length", o.probe_length, "Spindle face to the centre of the ball, mm")
      ->check(CLI::Range(0.0, 1e4));
  command->add_flag("--virtual", o.virtual_probe,
                    "Touch with the probe and the solids of truth.yaml on the machine of truth.yaml");
  command->add_flag(
      "--on-machine", o.target.running,
      "The measurement service of the cluster that runs touches with the probe of the machine: checks the "
      "probe, then moves from pose to pose. Ctrl-C aborts it: the channel is held, nothing is written");
  command->add_flag("--detach", o.detach,
                    "With --on-machine: return when the measurement has started; then trunnion calibrate "
                    "status, abort, confirm");
  command->add_flag("--take-right", o.take_right, cluster::take_right_help);
  command->add_flag(
      "--propose", o.propose,
      "Measure nothing: print the widest ranges of the rotary axes in which the probe reaches the "
      "sphere without a collision, as inputs");
  command->add_flag(
      "--retract", o.retract,
      "With --on-machine: between the poses only Z up, turn, X and Y, Z down, without regard to "
      "bodies (docs/collision.md)");
  command->add_flag(
      "--resume", o.resume,
      "With --on-machine: continue the measurement that was interrupted, after its complete poses");
  command->add_option("--touches", o.touches, "Touches from a file");
  command->add_flag(
      "--variables", o.variables,
      "The touches of the program %001, from the macro variables of the channel of the cluster that "
      "runs (docs/calibration-programs.md)");
  command->add_option("--save-touches", o.save_touches, "Write the touches into a file, for --touches");
  command->add_option("--true-sphere", o.true_sphere,
                      "Where the sphere truly is, mm, in place of that of truth.yaml");
  command
      ->add_option("--repeatability", o.repeatability,
                   "Of the virtual probe, um, in place of that of truth.yaml")
      ->check(CLI::Range(0.0, 1000.0));
  command
      ->add_option("--pre-travel", o.pre_travel, "Of the virtual probe, um, in place of that of truth.yaml")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--lobing", o.lobing, "Of the virtual probe, um, in place of that of truth.yaml")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--seed", o.seed,
                      "Of the virtual probe, in place of that of truth.yaml, and of --check (default 1)");
  command
      ->add_option("--check", o.check,
                   "Then hold the sphere with RTCP at this many random poses, before and after")
      ->check(CLI::Range(2, 100000));
  command->add_option("--protocol", o.protocol, "Write the protocol into a file, too");
  command->add_option("--date", o.date, "Of the protocol, YYYY-MM-DDTHH:MM:SS (default: the clock, UTC)");
  command->add_option("--plot", o.plot, "Write differences and residuals of every pose (SVG)");
  command->add_option("--reference", o.reference,
                      "File of the reference head: written or read as the inputs say");
  command->add_flag("--acknowledge", o.acknowledge,
                    "Write although a vector changes by more than its tolerance");
}

}  // namespace trunnion::cli
