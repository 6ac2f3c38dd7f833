// SPDX-License-Identifier: Apache-2.0
// measure circle: the circular test of ISO 230-4 on a cluster, or of a recording
#include "circle_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "channel_motion.hpp"
#include "circle_report.hpp"
#include "circular_tests/circle_program.hpp"
#include "circular_tests/turns.hpp"
#include "figures.hpp"
#include "identification/circle_points.hpp"
#include "machine/kinematics.hpp"
#include "report/truth_pictures.hpp"
#include "storage/file.hpp"
#include "true_machine.hpp"
#include "truth/measurement.hpp"

namespace trunnion::cli {
namespace {

using circular_tests::ProgrammedCircle;
using truth::Vec3;

constexpr std::uint16_t decimation = 8;  // one sample in a cycle of 1 ms
constexpr double found_within = 1e-4;    // mm: of a recording, the path from its circle

struct CircleOptions {
  std::string machine, plane = "XY", source = "true", recording, plot, output, at;
  double radius = 100, feed = 1000, start = 0, overrun = 45, tool_length = 0;
  std::uint16_t channel = 0;
};

// The circle's centre in machine coordinates: as given, or where the axes stand.
Vec3 centre_of(const CircleOptions& o, const ServoSession& session) {
  Vec3 centre = Vec3::Zero();
  if (!o.at.empty()) return coordinates("--at", o.at);
  for (const auto& axis : session.axes())
    if (axis.letter >= 'X' && axis.letter <= 'Z') centre[axis.letter - 'X'] = axis.place;
  return centre;
}

void check_circle(const CircleOptions& o, const ServoSession& session, const Vec3& centre) {
  for (int i = 0; i < 3; ++i) {
    const auto& axis = session.axis(std::string(1, static_cast<char>('X' + i)));
    const bool moves = o.plane.find(axis.letter) != std::string::npos;
    const double reach = moves ? o.radius : 0;
    if (centre[i] - reach < axis.low || centre[i] + reach > axis.high)
      throw std::runtime_error(
          fmt::format("axis {}: the circle goes from {:.3f} to {:.3f} mm, its travel is {:.3f} .. "
                      "{:.3f}: choose another --at or --radius",
                      axis.letter, centre[i] - reach, centre[i] + reach, axis.low, axis.high));
    if (moves && o.feed > axis.highest_feed)
      throw std::runtime_error(fmt::format("--feed {:g}: axis {} moves with up to {:g} mm/min", o.feed,
                                           axis.letter, axis.highest_feed));
  }
}

std::string program_of(const CircleOptions& o, const ServoSession& session, const Vec3& centre) {
  std::vector<std::pair<char, double>> after;
  for (const auto& axis : session.axes())
    if (axis.letter >= 'X' && axis.letter <= 'Z') after.emplace_back(axis.letter, axis.place);
  return circular_tests::circle_program({o.plane, centre, o.radius, o.feed, o.start, o.overrun}, after);
}

void write_readings(const std::string& path, const std::vector<circular_tests::RadialReading>& ccw,
                    const std::vector<circular_tests::RadialReading>& cw) {
  std::string lines = "sense,angle_deg,deviation_um\n";
  for (const auto* readings : {&ccw, &cw})
    for (const auto& r : *readings)
      lines += fmt::format("{},{:.6f},{:.6f}\n", readings == &ccw ? "ccw" : "cw", r.angle, r.deviation * um);
  storage::replace_file(path, lines);
}

int measure_circle(const CircleOptions& o, const Common& common) {
  const auto plane = circular_tests::plane_of(o.plane);
  const bool from_truth = o.source == "true";
  ChannelMotion motion;
  ProgrammedCircle circle;
  std::string name = o.machine, directory = o.machine;
  machine::Parameters parameters;
  if (!o.recording.empty()) {
    if (from_truth && o.machine.empty())
      throw std::runtime_error(
          "--source true reads truth.yaml: name the machine, or choose --source encoder");
    motion = motion_of_recording(o.recording, o.channel, parameters);
    try {
      circle = circular_tests::find_circle(identification::commanded_points(motion, plane), found_within);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(o.recording + ": plane " + o.plane + ": " + error.what());
    }
    if (name.empty()) name = o.recording;
  } else {
    ServoSession session(o.machine, common.domain, o.channel);
    const auto centre = centre_of(o, session);
    check_circle(o, session, centre);
    motion = run_sampled(session, program_of(o, session, centre), "XYZ", decimation);
    circle = {
        {centre[static_cast<Eigen::Index>(plane.first)], centre[static_cast<Eigen::Index>(plane.second)]},
        o.radius};
    name = session.machine(), directory = session.machine_directory();
    parameters = session.parameters();
  }
  const auto commanded = identification::commanded_points(motion, plane);
  const auto turns = circular_tests::turns_on(commanded, circle);
  if (turns.empty()) throw std::runtime_error("the axes have not made a whole turn");
  truth::BallbarMeasurement measured;
  identification::CirclePoints points;
  truth::InstrumentTruth instrument_truth;
  if (from_truth) {
    auto machine = load_true_machine(directory, o.channel, {});
    machine.report = std::make_unique<truth::PoseReport>(
        machine.report->geometry(), machine::make_chain(parameters, o.channel), machine.outline);
    machine.report->tool_length = o.tool_length;
    points = identification::true_points(motion, plane, circle, *machine.report);
    instrument_truth = identification::instrument(machine, "ballbar");
  } else {
    points = identification::encoder_points(motion, plane);
  }
  truth::Instrument bar(instrument_truth);
  double feed = 0;
  for (const auto& turn : turns) {
    auto& readings = turn.sense > 0 ? measured.ccw : measured.cw;
    if (!readings.empty()) continue;
    readings = circular_tests::readings_of(points, turn, circle);
    for (auto& reading : readings) reading.deviation = bar.read(reading.deviation);
    feed = std::max(feed, circular_tests::feed_reached(commanded, turn, motion.interval));
  }
  if (measured.ccw.empty() || measured.cw.empty())
    throw std::runtime_error(std::string("the circle was run in one sense only (") +
                             (measured.cw.empty() ? "counter-" : "") +
                             "clockwise): a circular test needs both");
  const auto report = circular_tests::circle_report(o.plane, circle.radius, measured.ccw, measured.cw);
  const double lag = feed > 0 ? report.causes.lag_mismatch / (feed / 60) * 1e3 : 0;
  const auto& turn = turns.front();
  if (!o.output.empty()) write_readings(o.output, measured.ccw, measured.cw);
  if (!o.plot.empty())
    storage::replace_file(
        o.plot, report::ballbar_picture(
                    measured, fmt::format("{}, plane {}, R{:g} F{:.0f}, {}", name, o.plane, circle.radius,
                                          feed, from_truth ? "true machine" : "encoders")));
  if (common.json) {
    auto out = report_json(report);
    out["machine"] = name, out["source"] = o.source;
    out["centre_mm"] = {circle.centre.first, circle.centre.second};
    out["feed_mm_per_min"] = feed, out["servo_mismatch_ms"] = lag;
    out["start_deg"] = turn.start, out["overrun_deg"] = turn.overrun, out["interval_s"] = motion.interval;
    out["readings"] = {measured.ccw.size(), measured.cw.size()};
    std::cout << bus::text_of(out) << "\n";
    return 0;
  }
  print_figure("radius", circle.radius, "mm");
  print_figure("feed reached", feed, "mm/min");
  print_figure("start angle", turn.start, "deg");
  print_figure("readings in a second", 1 / motion.interval, "");
  print_report(report);
  print_figure("servo mismatch", lag, "ms");
  for (const auto& file : {o.output, o.plot})
    if (!file.empty()) std::cout << file << "\n";
  return 0;
}

}  // namespace

void add_circle_command(CLI::App& measure, Common& common) {
  auto o = std::make_shared<CircleOptions>();
  auto* command = add_command(measure, common, "circle",
                              "Circular test by ISO 230-4: the axes run a circle in both senses, with servo "
                              "drives; or of a recording",
                              [o, &common] { return measure_circle(*o, common); });
  command->add_option("machine", o->machine,
                      "Name under configs/machines or a directory: a cluster of its own in virtual time; "
                      "without it the cluster that runs");
  command->add_option("--plane", o->plane, "XY (default), XZ or YZ")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}));
  command->add_option("--radius", o->radius, "mm (default 100)")->check(CLI::Range(1.0, 1e4));
  command->add_option("--feed", o->feed, "mm/min (default 1000)")->check(CLI::Range(1.0, 1e6));
  command->add_option("--start", o->start, "Angle at which the reading begins, deg (default 0)")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--overrun", o->overrun, "Before and behind the reading, deg (default 45)")
      ->check(CLI::Range(0.0, 180.0));
  command->add_option("--at", o->at, "Centre X,Y,Z in machine coordinates (default: where the axes are)");
  command
      ->add_option("--source", o->source,
                   "true (default): a ballbar on the true machine of truth.yaml; encoder: the position loops")
      ->check(CLI::IsMember({"true", "encoder"}));
  command->add_option("--tool-length", o->tool_length, "Spindle face to the ball, mm (default 0)")
      ->check(CLI::Range(-1e6, 1e6));
  command->add_option("--recording", o->recording, "Find the circle in this recording; nothing moves");
  command->add_option("--channel", o->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command->add_option("--plot", o->plot, "Write the polar plot (SVG)");
  command->add_option("--output", o->output, "Write the readings (CSV)");
}

}  // namespace trunnion::cli
