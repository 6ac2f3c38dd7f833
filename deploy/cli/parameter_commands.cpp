// SPDX-License-Identifier: Apache-2.0
// param get|set|list|export|import
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/operating_station.hpp"
#include "commands.hpp"
#include "machine/parameters.hpp"
#include "parameter_request.hpp"

namespace trunnion::cli {
namespace {

using machine::Catalogue;
using machine::number_text;

std::uint32_t parse_number(const std::string& text) {
  if (text.size() != 6 || text.find_first_not_of("0123456789") != std::string::npos)
    throw std::runtime_error("'" + text + "' is not a parameter number of six digits");
  return static_cast<std::uint32_t>(std::stoul(text));
}

// Stored values that wait for reset or restart, by number.
using Pending = std::map<std::uint32_t, machine::ParameterValue>;

machine::Parameters active(cluster::Client& client, Pending* pending = nullptr) {
  const auto set = client.newest(topics::parameter_set);
  if (pending != nullptr)
    for (const auto& value : set.pending) (*pending)[value.number] = {value.value, value.text};
  return machine::parameters_of(set);
}

bus::Json row(std::uint32_t number, const machine::Parameters& parameters) {
  const auto* d = Catalogue::instance().find(number);
  if (d == nullptr) throw std::runtime_error("parameter " + number_text(number) + " does not exist");
  bus::Json json{{"number", number_text(number)}, {"name", d->name}};
  const auto found = parameters.values.find(number);
  if (d->type == machine::ParameterType::text)
    json["value"] = found != parameters.values.end() ? found->second.text : "";
  else
    json["value"] = parameters.at(number);
  json["unit"] = machine::unit_of(number, parameters.values);
  json["activation"] = machine::to_string(d->activation);
  if (d->type != machine::ParameterType::text) {
    json["minimum"] = d->minimum, json["maximum"] = d->maximum;
    json["default"] = Catalogue::instance().default_of(number);
  }
  json["access"] = d->access;
  json["help"] = d->help;
  return json;
}

machine::Parameters parameters_at(const Common& common, const StatePlace& place) {
  if (place.given()) return saved_parameters(state_place(common, place));
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  return active(client);
}

int get_parameters(const Common& common, const StatePlace& place, const std::vector<std::string>& numbers) {
  const auto parameters = parameters_at(common, place);
  bus::Json all = bus::Json::array();
  for (const auto& text : numbers) {
    const auto json = row(parse_number(text), parameters);
    all.push_back(json);
    if (!common.json)
      std::printf("%s %s = %s %s\n", text.c_str(), json["name"].get<std::string>().c_str(),
                  json["value"].dump().c_str(), json["unit"].get<std::string>().c_str());
  }
  if (common.json) std::cout << all.dump(2) << "\n";
  return 0;
}

idl::parameters::ParameterRequest set_request(const std::string& number, const std::string& value) {
  idl::parameters::Parameter parameter;
  parameter.number = parse_number(number);
  const auto* d = Catalogue::instance().find(parameter.number);
  if (d == nullptr) throw std::runtime_error("parameter " + number + " does not exist");
  if (d->type == machine::ParameterType::text) {
    parameter.text = value;
  } else {
    std::size_t used = 0;
    try {
      parameter.value = std::stod(value, &used);
    } catch (const std::exception&) {
    }
    if (used != value.size())
      throw std::runtime_error("parameter " + number + " (" + d->name + "): '" + value + "' is not a number");
  }
  idl::parameters::ParameterRequest request;
  request.operation = idl::parameters::Operation::SET;
  request.values = {parameter};
  return request;
}

int set(const Common& common, const std::string& number, const std::string& value) {
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  return send_parameters(common, client, set_request(number, value));
}

int list_parameters(const Common& common, const std::string& filter) {
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  Pending pending;
  const auto parameters = active(client, &pending);
  bus::Json all = bus::Json::array();
  for (const auto& [number, value] : parameters.values) {
    const auto json = row(number, parameters);
    if (!filter.empty() && number_text(number).rfind(filter, 0) != 0 &&
        json["name"].get<std::string>().find(filter) == std::string::npos)
      continue;
    const auto waiting = pending.find(number);
    all.push_back(json);
    all.back()["pending"] = waiting != pending.end();
    std::string waits;
    if (waiting != pending.end()) {
      const bool is_text = Catalogue::instance().find(number)->type == machine::ParameterType::text;
      auto& pending_value = all.back()["pending_value"];
      if (is_text)
        pending_value = waiting->second.text;
      else
        pending_value = waiting->second.value;
      waits = " (" + pending_value.dump() + " waits)";
    }
    if (!common.json)
      std::printf("%s %-32s %14s %-14s %s%s\n", number_text(number).c_str(),
                  json["name"].get<std::string>().c_str(), json["value"].dump().c_str(),
                  json["unit"].get<std::string>().c_str(), json["activation"].get<std::string>().c_str(),
                  waits.c_str());
  }
  if (common.json)
    std::cout << bus::Json{{"revision", parameters.revision}, {"parameters", all}}.dump(2) << "\n";
  return 0;
}

int export_parameters(const Common& common, const std::string& file) {
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  const auto text = machine::write_parameter_text(active(client).values);
  if (file == "-") {
    std::cout << text;
    return 0;
  }
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
  return 0;
}

int load_parameters(const Common& common, const std::string& file) {
  return import_parameters(common, machine::read_parameter_file(file));
}

}  // namespace

void add_parameter_commands(CLI::App& app, Common& common) {
  auto* param = app.add_subcommand("param", "Read and change parameters");
  param->require_subcommand(1);
  auto numbers = std::make_shared<std::vector<std::string>>();
  auto text = std::make_shared<std::pair<std::string, std::string>>();
  auto place = std::make_shared<StatePlace>();
  auto* command = add_command(*param, common, "get", "Print active values",
                              [&common, place, numbers] { return get_parameters(common, *place, *numbers); });
  command->add_option("number", *numbers, "Six digits")->required();
  add_place_options(*command, *place);
  auto take_right = std::make_shared<bool>(false);
  const auto operating = [&common, take_right](auto act) {
    return [&common, take_right, act] {
      const cluster::OperatingStation station(cluster::find_cluster(common.domain).run.domain, *take_right);
      return act();
    };
  };
  command = add_command(
      *param, common, "set", "Change a value",
      [&common, text, place,
       change = operating([&common, text] { return set(common, text->first, text->second); })] {
        if (!place->given()) return change();
        return save_parameters(common, state_place(common, *place), set_request(text->first, text->second));
      });
  add_place_options(*command, *place);
  command->add_option("number", text->first, "Six digits")->required();
  command->add_option("value", text->second, "New value")->required();
  command->add_flag("--take-right", *take_right, cluster::take_right_help);
  add_command(*param, common, "list", "Values that differ from the defaults", [&common, text] {
    return list_parameters(common, text->first);
  })->add_option("filter", text->first, "Start of the number or part of the name");
  add_command(*param, common, "export", "Write the active values as YAML",
              [&common, text] { return export_parameters(common, text->first); })
      ->add_option("file", text->first, "File, - for standard output")
      ->required();
  command = add_command(*param, common, "import", "Set every value of a YAML file, all or none",
                        operating([&common, text] { return load_parameters(common, text->first); }));
  command->add_option("file", text->first, "File")->required();
  command->add_flag("--take-right", *take_right, cluster::take_right_help);
}

}  // namespace trunnion::cli
