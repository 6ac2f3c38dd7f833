// SPDX-License-Identifier: Apache-2.0
// truth: where the tool of a machine with errors truly is, without a cluster
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "report/truth_pictures.hpp"
#include "storage/file.hpp"
#include "true_machine.hpp"

namespace trunnion::cli {
namespace {

struct TruthOptions {
  std::string machine, plot;
  double tool_length = 0;
  std::uint16_t channel = 0;
  std::size_t summary = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> set;
};

void print_summary(const truth::DeviationSummary& summary) {
  const auto line = [](const char* name, const truth::Spread& spread, double unit, const char* unit_name) {
    std::cout << fmt::format("{}: mean {:.2f}, 95 % {:.2f}, maximum {:.2f} {}\n", name, spread.mean * unit,
                             spread.percentile_95 * unit, spread.maximum * unit, unit_name);
  };
  std::cout << summary.count << " random poses in the travel\n";
  line("tip", summary.tip, 1e3, "um");
  line("tool axis", summary.axis, 1e6, "urad");
}

void answer_lines(truth::PoseReport& report, bool json, bus::Json& poses) {
  std::string line;
  for (std::size_t number = 1; std::getline(std::cin, line); ++number) {
    std::optional<truth::PoseAnswer> answer;
    try {
      answer = report.answer(line, number);
    } catch (const std::runtime_error& e) {
      throw std::runtime_error(std::string("standard input:") + e.what());
    }
    if (!answer) continue;
    if (json)
      poses.push_back({{"tip_mm", vector_json(answer->actual.tip, 1)},
                       {"axis", vector_json(answer->actual.axis, 1)},
                       {"tip_deviation_um", vector_json(answer->deviation.tip, 1e3)},
                       {"axis_deviation_urad", vector_json(answer->deviation.axis, 1e6)}});
    else
      std::cout << truth::text_of(*answer) << "\n" << std::flush;
  }
}

int truth_of(const TruthOptions& options, bool json) {
  if (!std::isfinite(options.tool_length)) throw std::runtime_error("--tool-length: not a number");
  const auto machine = load_true_machine(options.machine, options.channel, options.set);
  auto& report = *machine.report;
  report.tool_length = options.tool_length;
  bus::Json out = {{"machine", machine.name}, {"structure", report.geometry().notation()}};
  if (!options.plot.empty()) {
    storage::replace_file(
        options.plot,
        report::truth_picture(report, machine.outline, machine.name + " " + report.geometry().notation()));
    if (!json) std::cout << options.plot << "\n";
  }
  if (options.summary > 0) {
    const auto summary = report.summary(options.summary, options.seed);
    out["summary"] = {{"poses", summary.count},
                      {"seed", options.seed},
                      {"tip_um", spread_json(summary.tip, 1e3)},
                      {"axis_urad", spread_json(summary.axis, 1e6)}};
    if (!json) print_summary(summary);
  }
  if (options.summary == 0 && options.plot.empty()) {
    bus::Json poses = bus::Json::array();
    answer_lines(report, json, poses);
    out["poses"] = std::move(poses);
  }
  if (json) std::cout << bus::text_of(out) << "\n";
  return 0;
}

}  // namespace

void add_truth_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<TruthOptions>();
  auto* command = add_command(app, common, "truth",
                              "Send commanded axis positions on standard input (X100 Y20 A30) through the "
                              "true geometry of a machine: true "
                              "tip in mm and tool axis relative to the workpiece, then their difference from "
                              "the control's in um and urad",
                              [options, &common] { return truth_of(*options, common.json); });
  command
      ->add_option(
          "machine", options->machine,
          "Name under configs/machines, a directory with machine.yaml, or that file; its truth.yaml has "
          "the errors")
      ->required();
  command->add_option("--tool-length", options->tool_length, "Tool length in mm (default 0)")
      ->check(CLI::Range(-1e6, 1e6));
  command->add_option("--channel", options->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command
      ->add_option(
          "--set", options->set,
          "NAME=VALUE of the truth: a location error (C0Y, XOC, AOC; um or urad) or a temperature rise in K "
          "(rise.X, rise.S of the spindle); or of the control's model: NUMBER=VALUE of a parameter, "
          "NAME=X,Y,Z of a correction; may be repeated")
      ->take_all();
  command
      ->add_option("--summary", options->summary,
                   "In place of standard input: this many random poses in the travel; mean, 95 % and maximum")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--seed", options->seed, "Of the random poses (default 1)");
  command->add_option("--plot", options->plot,
                      "In place of standard input: write a picture of the error in three planes (SVG)");
}

}  // namespace trunnion::cli
