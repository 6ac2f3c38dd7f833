// SPDX-License-Identifier: Apache-2.0
// compensation import|export|show: the tables of a machine as text in um and 0.001 deg
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "canonical/axes.hpp"
#include "cluster/cluster.hpp"
#include "commands.hpp"
#include "compensation/table_parameters.hpp"
#include "machine/machine.hpp"
#include "machine/yaml.hpp"
#include "machine_directory.hpp"
#include "parameter_request.hpp"
#include "storage/file.hpp"

namespace trunnion::cli {
namespace {

struct TableOptions {
  std::string file, machine, output;
  std::uint16_t channel = 0;
  std::uint32_t first = 700000;
};

// Of the directory that is named, otherwise those in force in the running cluster.
machine::Parameters parameters_of(const TableOptions& options, const Common& common) {
  machine::Parameters parameters;
  if (!options.machine.empty()) {
    parameters.values =
        machine::machine_parameters(machine::load_machine(machine_directory(options.machine)));
    return parameters;
  }
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  return machine::parameters_of(client.newest(topics::parameter_set));
}

int import_tables(const TableOptions& options, const Common& common) {
  if (!options.machine.empty() && options.output.empty())
    throw std::runtime_error(
        "--machine needs --output FILE: without a cluster the parameters go into a file");
  const auto tables = error_tables::parse_tables(machine::read_text(options.file), options.file);
  const auto values =
      error_tables::parameters_of(tables, parameters_of(options, common), options.channel, options.first);
  if (options.output.empty()) return import_parameters(common, values);
  storage::replace_file(options.output, machine::write_parameter_text(values));
  if (!common.json) std::cout << options.output << ": " << values.size() << " parameters\n";
  return 0;
}

int export_tables(const TableOptions& options, const Common& common) {
  const auto text =
      error_tables::text_of(error_tables::tables_of(parameters_of(options, common), options.channel));
  if (options.file == "-")
    std::cout << text;
  else
    storage::replace_file(options.file, text);
  return 0;
}

int show_tables(const TableOptions& options, const Common& common) {
  const auto tables = error_tables::tables_of(parameters_of(options, common), options.channel);
  bus::Json all = bus::Json::array();
  for (const auto& table : tables.tables) {
    const double start = -table.offset * table.spacing,
                 end = start + static_cast<double>(table.points - 1) * table.spacing;
    const auto [low, high] = std::minmax_element(table.values.begin(), table.values.end());
    const char* position = table.moving < 3 ? "mm" : "deg";
    const char* unit = table.arm || table.compensated > 2 ? "0.001 deg" : "um";
    const char* kind = table.arm ? "angle" : table.moving == table.compensated ? "pitch" : "straightness";
    all.push_back({{"kind", kind},
                   {"table", error_tables::name_of(table)},
                   {"direction", static_cast<int>(table.direction)},
                   {"points", table.points},
                   {"from", start},
                   {"to", end},
                   {"position_unit", position},
                   {"least", *low * 1e3},
                   {"largest", *high * 1e3},
                   {"unit", unit}});
    if (common.json) continue;
    std::cout << fmt::format(
        "{:<12} {:<6} direction {}, {} points, {:.3f} .. {:.3f} {}: {:.3f} .. {:.3f} {}\n", kind,
        error_tables::name_of(table), static_cast<int>(table.direction), table.points, start, end, position,
        *low * 1e3, *high * 1e3, unit);
  }
  for (const auto& one : tables.squareness) {
    const std::string name = {canonical::axis_letters[one.moving], '_',
                              canonical::axis_letters[one.compensated]};
    all.push_back(
        {{"kind", "squareness"}, {"table", name}, {"angle", one.angle * 1e3}, {"unit", "0.001 deg"}});
    if (common.json) continue;
    std::cout << fmt::format("{:<12} {:<6} {:.3f} 0.001 deg\n", "squareness", name, one.angle * 1e3);
  }
  if (common.json)
    std::cout << all.dump(2) << "\n";
  else if (all.empty())
    std::cout << "no tables\n";
  return 0;
}

}  // namespace

void add_compensation_command(CLI::App& app, Common& common) {
  auto* group = app.add_subcommand("compensation", "Compensation tables as text in um and 0.001 deg");
  group->require_subcommand(1);
  auto options = std::make_shared<TableOptions>();
  const auto add = [&](const char* name, const char* about, int (*run)(const TableOptions&, const Common&)) {
    auto* command =
        add_command(*group, common, name, about, [options, &common, run] { return run(*options, common); });
    command->add_option("--machine", options->machine,
                        "Name under configs/machines or directory (default: the cluster that runs)");
    command->add_option("--channel", options->channel, "Channel (default 0)")->check(CLI::Range(0, 9));
    return command;
  };
  auto* import =
      add("import",
          "Replace the pitch, straightness, squareness and angle tables of a channel, all or none; "
          "active after a reset",
          &import_tables);
  import->add_option("file", options->file, "Text with tables")->required();
  import->add_option("--first", options->first, "Parameter of the first value (default 700000)")
      ->check(CLI::Range(700000, 709999));
  import->add_option("--output", options->output, "Write a parameter file in place of changing the cluster");
  add("export", "Write the tables that are on", &export_tables)
      ->add_option("file", options->file, "File, - for standard output")
      ->required();
  add("show", "One line for each table: travel, points, smallest and largest value", &show_tables);
}

}  // namespace trunnion::cli
