// SPDX-License-Identifier: Apache-2.0
#include "geometry_command.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "figures.hpp"
#include "identification/geometry_fit.hpp"
#include "identification/improvement.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"
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

// One measurement with the instruments of the machine, before and after.
struct Row {
  std::string name;
  bool angular = false;
  double before = 0, after = 0;  // root mean square of the readings, mm or rad
  std::optional<truth::PositionAccuracy> accuracy_before, accuracy_after;
};

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

std::optional<truth::PositionAccuracy> accuracy_of(truth::PoseReport report,
                                                   const identification::Measurement& m,
                                                   const truth::InstrumentTruth& instrument) {
  if (m.kind != identification::InstrumentKind::laser || m.laser.component != m.laser.axis)
    return std::nullopt;
  report.tool_length = m.tool_length;
  return truth::measure_laser(report, m.laser, instrument).accuracy;
}

class Report {
 public:
  Report(const GeometryOptions& options, const identification::FitResult& fit, std::vector<Row> rows,
         const identification::VolumetricErrors& before, const identification::VolumetricErrors& after)
      : options_(options), fit_(fit), rows_(std::move(rows)), before_(before), after_(after) {}

  void text() const {
    print("%-14s %12s %12s", "measurement", "before", "after");
    for (const auto& row : rows_) {
      const double unit = row.angular ? microradian : micro;
      print("%-14s %12.2f %12.2f %s (root mean square)", row.name.c_str(), row.before * unit,
            row.after * unit, row.angular ? "urad" : "um");
      if (!row.accuracy_before) continue;
      const auto figures = [](const char* when, const truth::PositionAccuracy& a) {
        print("  ISO 230-2 %-7s A %.2f, E %.2f, R %.2f, B %.2f um", when, a.accuracy * micro,
              a.systematic * micro, a.repeatability * micro, a.reversal * micro);
      };
      figures("before:", *row.accuracy_before);
      figures("after:", *row.accuracy_after);
    }
    for (const auto& error : fit_.locations) {
      const double unit = error.angle ? microradian : micro;
      print("%-14s %12.2f +- %.2f %s (k = 2)", error.name.c_str(), error.value * unit,
            2 * error.uncertainty * unit, error.angle ? "urad" : "um");
    }
    print("residuals %.2f times their uncertainty", fit_.residual);
    print("%zu random poses, about the mean deviation of the tip:", poses);
    const auto line = [](const char* name, const truth::Spread& b, const truth::Spread& a, double u,
                         double unit, const char* unit_name) {
      print("%-14s mean %.2f -> %.2f, 95 %% %.2f -> %.2f, maximum %.2f -> %.2f %s; uncertainty %.2f (k = 1)",
            name, b.mean * unit, a.mean * unit, b.percentile_95 * unit, a.percentile_95 * unit,
            b.maximum * unit, a.maximum * unit, unit_name, u * unit);
    };
    line("tip", before_.tip, after_.tip, fit_.tip_uncertainty, micro, "um");
    line("tool axis", before_.direction, after_.direction, fit_.direction_uncertainty, microradian, "urad");
  }

  bus::Json json(const std::string& machine) const {
    bus::Json out = {{"machine", machine}, {"poses", poses}, {"seed", options_.seed}};
    out["residual"] = fit_.residual;
    out["tip_um"] = {{"before", spread_json(before_.tip, micro)},
                     {"after", spread_json(after_.tip, micro)},
                     {"uncertainty", fit_.tip_uncertainty * micro}};
    out["axis_urad"] = {{"before", spread_json(before_.direction, microradian)},
                        {"after", spread_json(after_.direction, microradian)},
                        {"uncertainty", fit_.direction_uncertainty * microradian}};
    for (const auto& row : rows_) {
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
    for (const auto& error : fit_.locations) {
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
  const identification::FitResult& fit_;
  std::vector<Row> rows_;
  identification::VolumetricErrors before_, after_;
};

int geometry(const GeometryOptions& options, const Common& common) {
  auto machine = load_true_machine(options.machine, options.channel, options.set);
  auto& report = *machine.report;
  report.compensation = nullptr;
  const auto plan =
      identification::parse_plan(machine::read_text(options.plan), options.plan, machine.outline);
  std::vector<std::vector<double>> measured;
  std::vector<Row> rows;
  for (const auto& m : plan.measurements) {
    const auto instrument = identification::instrument_of(machine.truth, m);
    measured.push_back(identification::readings(report, m, instrument));
    rows.push_back({m.name, m.angular(), root_mean_square(measured.back()), 0,
                    accuracy_of(report, m, instrument), std::nullopt});
  }
  const identification::GeometryFit model(machine.outline, report.model(), plan);
  const auto fit = model.solve(measured);
  auto values =
      volumetric::parameters_of(machine.model, options.channel, fit.location, fit.tables, options.first);
  bool turns = false;
  for (std::size_t i = 0; i < geometry::angle_count; ++i) turns = turns || report.model().turns(i);
  values[parameter::volumetric_type.number(options.channel)] = {turns ? 2.0 : 1.0, ""};
  if (!plan.structure.empty())
    values[parameter::volumetric_structure.number(options.channel)] = {0, plan.structure};
  auto compensated = machine.model;
  for (const auto& [number, value] : values) compensated.values[number] = value;
  if (!plan.measurements.empty()) report.tool_length = plan.measurements.front().tool_length;
  const auto before = identification::volumetric_errors(report, poses, options.seed, true);
  report.compensation = std::make_shared<volumetric::VolumetricCompensation>(
      *volumetric::compensation_of(compensated, options.channel));
  const auto after = identification::volumetric_errors(report, poses, options.seed, true);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& m = plan.measurements[i];
    auto instrument = identification::instrument_of(machine.truth, m);
    ++instrument.seed;  // measured again
    rows[i].after = root_mean_square(identification::readings(report, m, instrument));
    rows[i].accuracy_after = accuracy_of(report, m, instrument);
  }
  const Report shown(options, fit, std::move(rows), before, after);
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
