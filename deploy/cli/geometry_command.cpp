// SPDX-License-Identifier: Apache-2.0
#include "geometry_command.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "figures.hpp"
#include "identification/measured_geometry.hpp"
#include "machine/yaml.hpp"
#include "parameter_request.hpp"
#include "storage/file.hpp"
#include "true_machine.hpp"

namespace trunnion::cli {
namespace {

constexpr double micro = 1e3, microradian = 1e6;
constexpr std::size_t poses = 200;

struct GeometryOptions {
  std::string machine, plan, output;
  std::uint16_t channel = 0;
  std::uint32_t first = 700000;
  std::uint64_t seed = 1;
  bool write = false;
  std::vector<std::string> set;
};

class Report {
 public:
  Report(const GeometryOptions& options, const identification::MeasuredGeometry& geometry)
      : options_(options), geometry_(geometry) {}

  void text() const {
    print("{:<14} {:>12} {:>12}", "measurement", "before", "after");
    for (const auto& row : geometry_.rows) {
      const double unit = row.angular ? microradian : micro;
      print("{:<14} {:>12.2f} {:>12.2f} {} (root mean square)", row.name, row.before * unit, row.after * unit,
            row.angular ? "urad" : "um");
      if (!row.accuracy_before) continue;
      const auto figures = [](const char* when, const truth::PositionAccuracy& a) {
        print("  ISO 230-2 {:<7} A {:.2f}, E {:.2f}, R {:.2f}, B {:.2f} um", when, a.accuracy * micro,
              a.systematic * micro, a.repeatability * micro, a.reversal * micro);
      };
      figures("before:", *row.accuracy_before);
      figures("after:", *row.accuracy_after);
    }
    for (const auto& error : geometry_.fit.locations) {
      const double unit = error.angle ? microradian : micro;
      print("{:<14} {:>12.2f} +- {:.2f} {} (k = 2)", error.name, error.value * unit,
            2 * error.uncertainty * unit, error.angle ? "urad" : "um");
    }
    print("residuals {:.2f} times their uncertainty", geometry_.fit.residual);
    print("{} random poses, about the mean deviation of the tip:", poses);
    const auto line = [](const char* name, const truth::Spread& b, const truth::Spread& a, double u,
                         double unit, const char* unit_name) {
      print(
          "{:<14} mean {:.2f} -> {:.2f}, 95 % {:.2f} -> {:.2f}, maximum {:.2f} -> {:.2f} {}; uncertainty "
          "{:.2f} (k = 1)",
          name, b.mean * unit, a.mean * unit, b.percentile_95 * unit, a.percentile_95 * unit,
          b.maximum * unit, a.maximum * unit, unit_name, u * unit);
    };
    line("tip", geometry_.before.tip, geometry_.after.tip, geometry_.fit.tip_uncertainty, micro, "um");
    line("tool axis", geometry_.before.direction, geometry_.after.direction,
         geometry_.fit.direction_uncertainty, microradian, "urad");
  }

  bus::Json json(const std::string& machine) const {
    bus::Json out = {{"machine", machine}, {"poses", poses}, {"seed", options_.seed}};
    out["residual"] = geometry_.fit.residual;
    out["tip_um"] = {{"before", spread_json(geometry_.before.tip, micro)},
                     {"after", spread_json(geometry_.after.tip, micro)},
                     {"uncertainty", geometry_.fit.tip_uncertainty * micro}};
    out["axis_urad"] = {{"before", spread_json(geometry_.before.direction, microradian)},
                        {"after", spread_json(geometry_.after.direction, microradian)},
                        {"uncertainty", geometry_.fit.direction_uncertainty * microradian}};
    for (const auto& row : geometry_.rows) {
      const double unit = row.angular ? microradian : micro;
      bus::Json entry = {{"name", row.name},
                         {"unit", row.angular ? "urad" : "um"},
                         {"before", row.before * unit},
                         {"after", row.after * unit}};
      for (const auto& [when, accuracy] :
           {std::pair{"iso_230_2_before", &row.accuracy_before}, {"iso_230_2_after", &row.accuracy_after}})
        if (*accuracy)
          entry[when] = {{"A", (*accuracy)->accuracy * micro},
                         {"E", (*accuracy)->systematic * micro},
                         {"R", (*accuracy)->repeatability * micro},
                         {"B", (*accuracy)->reversal * micro}};
      out["measurements"].push_back(std::move(entry));
    }
    for (const auto& error : geometry_.fit.locations) {
      const double unit = error.angle ? microradian : micro;
      out["location_errors"].push_back({{"name", error.name},
                                        {"value", error.value * unit},
                                        {"uncertainty", error.uncertainty * unit},
                                        {"unit", error.angle ? "urad" : "um"}});
    }
    return out;
  }

 private:
  const GeometryOptions& options_;
  const identification::MeasuredGeometry& geometry_;
};

int geometry(const GeometryOptions& options, const Common& common) {
  const auto machine = load_true_machine(options.machine, options.channel, options.set);
  const auto plan =
      identification::parse_plan(machine::read_text(options.plan), options.plan, machine.outline);
  const auto measured =
      identification::measure_geometry(*machine.report, machine.truth, machine.outline, machine.model, plan,
                                       {options.channel, options.first, poses, options.seed});
  const auto& values = measured.values;
  const Report shown(options, measured);
  if (common.json)
    std::cout << bus::text_of(shown.json(machine.name)) << "\n";
  else
    shown.text();
  if (!options.output.empty()) {
    storage::replace_file(options.output, machine::write_parameter_text(values));
    if (!common.json) std::cout << options.output << ": " << values.size() << " parameters\n";
  }
  if (!options.write) {
    if (!common.json && options.output.empty())
      std::cout
          << "nothing written: --write changes the cluster that runs, --output FILE writes parameters\n";
    return 0;
  }
  const auto running = cluster::find_cluster(common.domain);
  if (running.machine != machine.name)
    throw std::runtime_error("--write: the cluster that runs is " + running.machine + ", measured was " +
                             machine.name);
  return import_parameters(common, values);
}

}  // namespace

void add_geometry_command(CLI::App& measure, Common& common) {
  auto options = std::make_shared<GeometryOptions>();
  auto* command = add_command(
      measure, common, "geometry",
      "Run a plan of measurements, compute the volumetric compensation, show the machine before and after",
      [options, &common] { return geometry(*options, common); });
  command
      ->add_option("machine", options->machine,
                   "Name under configs/machines, or a directory with machine.yaml and truth.yaml")
      ->required();
  command->add_option("--plan", options->plan, "YAML: which instrument along which line")->required();
  command->add_option("--channel", options->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
  command->add_option("--first", options->first, "Parameter of the first table value (default 700000)")
      ->check(CLI::Range(700000, 709999));
  command->add_option("--seed", options->seed, "Of the random poses (default 1)");
  command->add_option("--output", options->output, "Write the parameters into a file");
  command->add_flag("--write", options->write,
                    "Set the parameters in the cluster that runs, which keeps them in its journal; active "
                    "after a reset");
  command->add_option("--set", options->set, "As of `trunnion truth`; may be repeated")->take_all();
}

}  // namespace trunnion::cli
