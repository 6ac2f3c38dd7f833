// SPDX-License-Identifier: Apache-2.0
// variables: the macro variables of a channel, as the newest program or MDI line has left them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <memory>

#include "bus/json.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "variables_command.hpp"

namespace trunnion::cli {
namespace {

struct VariablesOptions {
  std::vector<std::uint32_t> numbers;
  std::uint16_t channel = 0;
};

}  // namespace

idl::channel::Variables newest_variables(const Common& common, std::uint16_t channel) {
  cluster::Client client(cluster::find_cluster(common.domain).network);
  return client.newest(topics::variables, channel);
}

namespace {

int show_variables(const Common& common, const VariablesOptions& options) {
  const auto variables = newest_variables(common, options.channel);
  bus::Json json = bus::Json::object();
  for (std::size_t i = 0; i < variables.numbers.size(); ++i) {
    const auto number = variables.numbers[i];
    if (!options.numbers.empty() &&
        std::find(options.numbers.begin(), options.numbers.end(), number) == options.numbers.end())
      continue;
    json[std::to_string(number)] = variables.values[i];
    if (common.json) continue;
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, variables.values[i]);
    std::printf("#%u %.*s\n", number, static_cast<int>(end.ptr - text), text);
  }
  if (common.json) std::cout << bus::text_of(json) << "\n";
  return 0;
}

}  // namespace

void add_variables_command(CLI::App& app, Common& common) {
  auto options = std::make_shared<VariablesOptions>();
  auto* command =
      add_command(app, common, "variables",
                  "Macro variables that have a value, as the newest program or MDI line has left them",
                  [options, &common] { return show_variables(common, *options); });
  command->add_option("numbers", options->numbers, "Numbers of variables, for example 500 (default: all)");
  command->add_option("--channel", options->channel, "Channel (default 0)")->check(CLI::Range(0, 31));
}

}  // namespace trunnion::cli
