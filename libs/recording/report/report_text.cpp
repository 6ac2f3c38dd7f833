// SPDX-License-Identifier: Apache-2.0
// The report in words and as JSON.
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/report.hpp"

namespace trunnion::report {
namespace {

std::string row(const std::string& label, const std::string& value) {
  return fmt::format("  {:<28} {}\n", label, value);
}

// Millimetres as micrometres, from nanometres to where they are millimetres again.
std::string length(double mm) {
  if (mm < 1e-9) return "below 0.001 nm";
  if (mm < 1e-5) return fmt::format("{:.3g} nm", mm * 1e6);
  if (mm < 1) return fmt::format("{:.3f} um", mm * 1e3);
  return fmt::format("{:.4f} mm", mm);
}

std::string seconds(double s) {
  if (std::abs(s) < 1e-3) return fmt::format("{:.1f} us", s * 1e6);
  if (std::abs(s) < 1) return fmt::format("{:.3f} ms", s * 1e3);
  return fmt::format("{:.3f} s", s);
}

std::string contour(const ContourError& error) {
  if (error.cycles == 0) return "no cycles";
  return "max " + length(error.largest) + ", RMS " + length(error.rms) +
         fmt::format(" over {} cycles (largest in line {})", error.cycles, error.line);
}

nlohmann::ordered_json contour_json(const ContourError& error) {
  return {{"cycles", error.cycles},
          {"max_mm", error.largest},
          {"rms_mm", error.rms},
          {"max_at_cycle", error.cycle},
          {"max_at_line", error.line}};
}

std::string hash_text(const Report& report) { return fmt::format("{:016x}", report.command_hash); }

std::uint64_t lost_in_all(const Report& report) {
  std::uint64_t sum = 0;
  for (const auto& [handle, lost] : report.lost) sum += lost;
  return sum;
}

}  // namespace

std::string terminal_text(const Report& report) {
  std::string text =
      "Program " + report.program + (report.machine.empty() ? "" : " on " + report.machine) + "\n";
  if (!report.problem.empty()) text += row("PROBLEM", report.problem);
  text += row("Programmed", fmt::format("{} commands, {:.1f} mm at feed", report.programmed.commands,
                                        report.programmed.feed_length));
  text += row("Executed",
              fmt::format("{} of {} cycles of {:.3f} ms: {:.3f} s of motion", report.executed, report.cycles,
                          report.period * 1e3, static_cast<double>(report.cycles) * report.period));
  text += row("Feed of the tool tip",
              fmt::format("mean {:.0f} mm/min, max {:.0f} mm/min", report.mean_feed, report.largest_feed));
  text += row("Contour error, commands", contour(report.commanded_feed));
  text += row("Contour error, encoders", contour(report.actual_feed));
  if (report.true_feed.cycles > 0) text += row("Contour error, true tip", contour(report.true_feed));
  text += row("  rapids, commands", contour(report.commanded_rapid));
  text += row("  rapids, encoders", contour(report.actual_rapid));
  if (report.true_rapid.cycles > 0) text += row("  rapids, true tip", contour(report.true_rapid));
  // Rounding is far below a nanometre: what is more was added by compensation or gantry.
  const bool compensated = report.residual_largest > 1e-6;
  text += row(compensated ? "Compensation of the tip" : "Forward(inverse) kinematics",
              report.residual_cycles == 0
                  ? "no axis batches"
                  : "max " + length(report.residual_largest) + ", RMS " + length(report.residual_rms));
  if (report.speed > 0)
    text += row("Speed", fmt::format("{:.2f} x real time ({:.3f} s of wall clock)", report.speed,
                                     report.wall_seconds));
  text += row("Cycles lost", fmt::format("{} (batches late: {}, from replicas: {})", lost_in_all(report),
                                         report.late_batches, report.repeated_batches));
  text += row("Drive starved", fmt::format("{} periods", report.starved));
  for (const auto& latency : report.latencies) {
    if (latency.batches == 0) continue;
    text += row("Latency to " + latency.to, "median " + seconds(latency.median) + ", p99 " +
                                                seconds(latency.p99) + ", max " + seconds(latency.largest));
  }
  text += row("Drive commands, FNV-1a", hash_text(report));
  return text;
}

std::string json_text(const Report& report) {
  nlohmann::ordered_json json = {
      {"program", report.program},
      {"machine", report.machine},
      {"recording", report.recording},
      {"version", report.version},
      {"contract", report.contract},
      {"problem", report.problem},
      {"messages", report.messages},
      {"programmed",
       {{"commands", report.programmed.commands}, {"feed_length_mm", report.programmed.feed_length}}},
      {"cycles", report.cycles},
      {"executed_cycles", report.executed},
      {"period_s", report.period},
      {"wall_s", report.wall_seconds},
      {"times_real_time", report.speed},
      {"contour_error",
       {{"commands_feed", contour_json(report.commanded_feed)},
        {"commands_rapid", contour_json(report.commanded_rapid)},
        {"encoders_feed", contour_json(report.actual_feed)},
        {"encoders_rapid", contour_json(report.actual_rapid)}}},
      {"forward_inverse_residual",
       {{"cycles", report.residual_cycles},
        {"max_mm", report.residual_largest},
        {"rms_mm", report.residual_rms}}},
      {"feed", {{"mean_mm_min", report.mean_feed}, {"max_mm_min", report.largest_feed}}},
      {"lost_cycles", report.lost},
      {"late_batches", report.late_batches},
      {"repeated_batches", report.repeated_batches},
      {"starved_periods", report.starved},
      {"command_hash_fnv1a64", hash_text(report)}};
  if (report.true_feed.cycles + report.true_rapid.cycles > 0) {
    json["contour_error"]["true_tip_feed"] = contour_json(report.true_feed);
    json["contour_error"]["true_tip_rapid"] = contour_json(report.true_rapid);
  }
  auto& latencies = json["latencies"] = nlohmann::ordered_json::array();
  for (const auto& latency : report.latencies)
    latencies.push_back({{"from", latency.from},
                         {"to", latency.to},
                         {"batches", latency.batches},
                         {"median_s", latency.median},
                         {"p99_s", latency.p99},
                         {"max_s", latency.largest}});
  return json.dump(2) + "\n";
}

}  // namespace trunnion::report
